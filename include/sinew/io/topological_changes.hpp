// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/core/compiled.hpp>

#include <string>
#include <string_view>
#include <vector>

namespace sinew::io {

/// Elements that go at a time [s].
struct TopologicalRemoval {
  double time = 0;
  std::vector<int> elements{};
  bool isShort = false;  // fewer numbers follow than the count says
};

/// The changes in `content`; `path` is for messages. See read_topological_changes().
std::vector<TopologicalRemoval> parse_topological_changes(std::string_view path, std::string_view content);

/// Reads SOFA's text format of topological changes: "T= seconds", then "REMOVE= count" and as many numbers of
/// elements, any number of times; where fewer follow, those missing are 0, as in SOFA. Throws Error with the
/// line on anything else, times that fall, changes of other kinds (ADD, INCISE), and a file without any.
std::vector<TopologicalRemoval> read_topological_changes(std::string const& path);

}  // namespace sinew::io

#if SINEW_DEFINES
#include <sinew/io/text_reader.hpp>

#include <utility>

namespace sinew::io {

SINEW_ONCE std::vector<TopologicalRemoval> parse_topological_changes(std::string_view path,
                                                                     std::string_view content) {
  TextReader in(path, content);
  in.rejectBinary();
  std::vector<TopologicalRemoval> changes;
  double time = 0;
  bool timed = false;
  std::string_view key;  // the next one, where a list of numbers has ended with it
  while (!key.empty() || in.more()) {
    if (key.empty()) key = in.word();
    const std::string_view now = std::exchange(key, std::string_view());
    if (now == "T=") {
      const double next = in.real("a time");
      if (timed && next < time)
        throw in.error(text("the time ", next, " s follows ", time, " s; times rise"));
      time = next;
      timed = true;
    } else if (now == "REMOVE=") {
      if (!timed) throw in.error("a change has no time; put \"T= seconds\" before it");
      TopologicalRemoval change{time, {}};
      const std::int64_t count = in.integer("numbers of elements");
      if (count < 0) throw in.expected("how many numbers of elements follow");
      while (std::int64_t(change.elements.size()) < count) {
        const std::string_view word = in.more() ? in.word() : std::string_view();
        int e = 0;
        change.isShort = word.empty() || word == "T=" || word == "REMOVE=";
        if (!change.isShort && (!parse_number(word, e) || e < 0))
          throw in.expected(text("the number of an element, from 0 on (", count, " follow REMOVE=)"));
        change.elements.push_back(e);
        if (!change.isShort) continue;
        key = word;  // all that are missing are 0
        break;
      }
      changes.push_back(std::move(change));
    } else if (now == "ADD=" || now == "INCISE=") {
      throw in.error(text(now.substr(0, now.size() - 1),
                          " is not simulated: elements may be removed only; leave it out"));
    } else {
      throw in.expected("T= or REMOVE=");
    }
  }
  if (changes.empty()) throw Error(path, "there is no change (\"T= seconds\", \"REMOVE= count\"); add one");
  return changes;
}

SINEW_ONCE std::vector<TopologicalRemoval> read_topological_changes(std::string const& path) {
  return parse_topological_changes(path, read_file(path));
}

}  // namespace sinew::io
#endif
