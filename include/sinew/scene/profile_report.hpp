// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/core/compiled.hpp>
#include <sinew/core/profile.hpp>

#include <string>
#include <string_view>
#include <vector>

namespace sinew {

/// One line of a profile. `own` is the time outside of the lines below it.
struct ProfileLine {
  int depth;
  bool isPhase;
  std::string name, className;
  long calls;
  double seconds, own;
};

/// The lines of a profile, in the order of the first calls, what is inside below what is around it.
std::vector<ProfileLine> profile_lines(Profile const& profile);

/// A table of a profile: phases and components, nested, with calls, time, time in a step, share of the steps,
/// and the share that is not in the lines below. Lines with a smaller share than `minimum` are left out.
std::string profile_table(Profile const& profile, double minimum = 0.001);

/// The events of a profile as a trace that chrome://tracing and ui.perfetto.dev open: the Trace Event Format,
/// complete events ("X") in the order of their beginnings, microseconds since the first.
std::string profile_trace(Profile const& profile, std::string_view title = "sinew");

}  // namespace sinew

#if SINEW_DEFINES
#include <sinew/core/error.hpp>

#include <algorithm>
#include <cstdio>

namespace sinew::detail {

inline void add_json_text(std::string& out, std::string_view words) {
  out += '"';
  for (const char c : words) {
    if (c == '"' || c == '\\') out += '\\';
    if (static_cast<unsigned char>(c) < ' ') {
      char code[8];
      std::snprintf(code, sizeof code, "\\u%04x", unsigned(c));
      out += code;
    } else {
      out += c;
    }
  }
  out += '"';
}

}  // namespace sinew::detail

namespace sinew {

SINEW_ONCE std::vector<ProfileLine> profile_lines(Profile const& profile) {
  std::vector<ProfileLine> lines;
  auto add = [&](auto const& self, int at, int depth) -> void {
    auto const& row = profile.row(at);
    const std::size_t mine = lines.size();
    if (at > 0) {
      auto name = profile.nameOf(at);
      const double seconds = 1e-9 * double(row.total);
      lines.push_back({depth,
                       profile.isPhase(at),
                       std::move(name.path),
                       std::move(name.className),
                       row.calls,
                       seconds,
                       seconds});
    }
    for (int i = row.child; i >= 0; i = profile.row(i).next) {
      if (at > 0) lines[mine].own -= 1e-9 * double(profile.row(i).total);
      self(self, i, depth + (at > 0));
    }
  };
  add(add, 0, 0);
  return lines;
}

SINEW_ONCE std::string profile_table(Profile const& profile, double minimum) {
  const auto lines = profile_lines(profile);
  const double whole = std::max(1e-9, profile.seconds(Phase::step)),
               steps = double(std::max(1L, profile.calls(Phase::step)));
  std::size_t nameWidth = 18, classWidth = 5, hidden = 0;
  auto shown = [&](ProfileLine const& line) {
    return line.depth == 0 || line.seconds == 0 || line.seconds >= minimum * whole;
  };
  auto indented = [](ProfileLine const& line) {
    return std::string(2 * std::size_t(line.depth), ' ') + line.name;
  };
  for (auto const& line : lines) {
    if (!shown(line)) continue;
    nameWidth = std::max(nameWidth, indented(line).size());
    classWidth = std::max(classWidth, line.className.size());
  }
  std::string table;
  auto add = [&](std::string const& name, std::string const& className, std::string const& numbers) {
    table += name + std::string(nameWidth + 2 - name.size(), ' ') + className +
             std::string(classWidth - className.size(), ' ') + numbers + '\n';
  };
  char numbers[128];
  std::snprintf(
      numbers, sizeof numbers, "%10s %12s %12s %8s %8s", "calls", "total [ms]", "step [us]", "share", "own");
  add("phase or component", "class", numbers);
  for (auto const& line : lines) {
    if (!shown(line)) {
      ++hidden;
      continue;
    }
    // what is only counted has no time
    if (line.seconds > 0)
      std::snprintf(numbers,
                    sizeof numbers,
                    "%10ld %12.3f %12.2f %6.1f %% %6.1f %%",
                    line.calls,
                    1e3 * line.seconds,
                    1e6 * line.seconds / steps,
                    100 * line.seconds / whole,
                    100 * line.own / whole);
    else
      std::snprintf(numbers, sizeof numbers, "%10ld", line.calls);
    add(indented(line), line.className, numbers);
  }
  if (hidden > 0)
    table += text(hidden, hidden == 1 ? " line" : " lines", " of less than ", 100 * minimum, " %\n");
  if (profile.leftOut() > 0)
    table += text(profile.leftOut(),
                  " calls had no room for a line of their own and are part of those around them\n");
  return table;
}

SINEW_ONCE std::string profile_trace(Profile const& profile, std::string_view title) {
  std::vector<std::string> heads;  // name, category and arguments of each row
  for (int i = 0; i < profile.rowCount(); ++i) {
    std::string head = "{\"name\":";
    if (i > 0) {
      const auto name = profile.nameOf(i);
      detail::add_json_text(head, name.path);
      head += profile.isPhase(i) ? ",\"cat\":\"phase\"" : ",\"cat\":\"component\",\"args\":{\"class\":";
      if (!profile.isPhase(i)) {
        detail::add_json_text(head, name.className);
        head += '}';
      }
    }
    heads.push_back(std::move(head));
  }
  std::string out = "{\"displayTimeUnit\":\"ns\",\"otherData\":{\"eventsLeftOut\":";
  out += std::to_string(profile.eventsLeftOut());
  out +=
      "},\"traceEvents\":[\n{\"name\":\"process_name\",\"ph\":\"M\",\"pid\":1,\"tid\":1,\"args\":{\"name\":";
  detail::add_json_text(out, title);
  out += "}}";
  const auto first = profile.eventCount() > 0 ? profile.event(0).begin : 0;
  for (std::size_t i = 0; i < profile.eventCount(); ++i) {
    auto const& event = profile.event(i);
    const long long begin = event.begin - first, length = event.end - event.begin;
    char times[120];
    std::snprintf(times,
                  sizeof times,
                  ",\"ph\":\"X\",\"pid\":1,\"tid\":1,\"ts\":%lld.%03lld,\"dur\":%lld.%03lld}",
                  begin / 1000,
                  begin % 1000,
                  length / 1000,
                  length % 1000);
    out += ",\n";
    out += heads[std::size_t(event.row)];
    out += times;
  }
  out += "\n]}\n";
  return out;
}

}  // namespace sinew
#endif
