// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/core/error.hpp>
#include <sinew/runtime/value_text.hpp>

#include <Eigen/Core>
#include <array>
#include <cmath>
#include <string>
#include <string_view>
#include <vector>

namespace sinew::view {

// What a user did to a simulation, between which steps: a text file, whose numbers read back as the same
// bits, so that a replay makes the same motion bit by bit.
//
//   sinew actions 1
//   dt 0.01
//   12 press 0 0 2 0 0 -1 1000      steps done since the start; ray: origin, direction; stiffness [N/m]
//   13 move 0 0 2 0.1 0 -0.99       another ray
//   20 release
//   25 set 5 youngModulus 3000      line of the tree, field, words
//   30 reset
//   100 end                         how long it went on; a file without it is not whole

enum class ActionKind { press, move, release, reset, set };
constexpr std::array<std::string_view, 5> enum_names(ActionKind) {
  return {"press", "move", "release", "reset", "set"};
}

/// One thing that a user did.
struct UserAction {
  ActionKind kind = ActionKind::release;
  Eigen::Vector3d origin{0, 0, 0}, direction{0, 0, 1};  // of a ray
  double stiffness = 0;
  int line = -1;  // of a component in the tree
  std::string field{}, words{};
};
struct TimedAction {
  long step = 0;  // how many steps were done before
  UserAction action{};
};
struct UserActions {
  double dt = 0;
  std::vector<TimedAction> actions{};
  long steps = 0;  // in all
};

inline std::string actions_text(UserActions const& all) {
  std::string words = text("sinew actions 1\ndt ", write_value(all.dt), '\n');
  for (auto const& [step, action] : all.actions) {
    words += text(step, ' ', enum_names(ActionKind{})[std::size_t(action.kind)]);
    if (action.kind == ActionKind::press || action.kind == ActionKind::move)
      words += text(' ', write_value(action.origin), ' ', write_value(action.direction));
    if (action.kind == ActionKind::press) words += text(' ', write_value(action.stiffness));
    if (action.kind == ActionKind::set) {
      std::string one = action.words;  // on one line
      for (char& c : one)
        if (c == '\n' || c == '\r') c = ' ';
      words += text(' ', action.line, ' ', action.field, ' ', one);
    }
    words += '\n';
  }
  return words + text(all.steps, " end\n");
}

/// Throws Error that says which line is wrong and how; `name`: of the file.
inline UserActions read_actions(std::string_view content, std::string_view name) {
  UserActions all;
  int number = 0;
  bool ended = false;
  auto next_line = [&] {
    const std::size_t end = std::min(content.find('\n'), content.size());
    const std::string_view line = content.substr(0, end);
    content.remove_prefix(std::min(end + 1, content.size()));
    ++number;
    return line;
  };
  auto read_line = [&](std::string_view line) {
    if (number == 1) {
      if (line != "sinew actions 1")
        throw Error("", "this is no file of actions, which begins with 'sinew actions 1'");
      return;
    }
    if (number == 2) {
      if (!line.starts_with("dt ")) throw Error("", "here stands 'dt' with the length of a step");
      read_value(line.substr(3), all.dt);
      if (!(all.dt > 0) || !std::isfinite(all.dt)) throw Error("", "dt is a number greater than 0");
      return;
    }
    Words words(line);
    const long step = sinew::detail::read_number<long>(sinew::detail::need_word(words, "a step"));
    const long last = all.actions.empty() ? 0 : all.actions.back().step;
    if (step < last) throw Error("", text("step ", step, " comes behind step ", last));
    const std::string_view word = sinew::detail::need_word(words, "an action");
    if (word == "end") {
      all.steps = step;
      ended = true;
      return;
    }
    TimedAction timed{.step = step};
    UserAction& action = timed.action;
    read_value(word, action.kind);
    auto numbers = [&](auto& to) { sinew::detail::read_words(words, to); };
    if (action.kind == ActionKind::press || action.kind == ActionKind::move)
      numbers(action.origin), numbers(action.direction);
    if (action.kind == ActionKind::press) numbers(action.stiffness);
    if (action.kind == ActionKind::set) {
      numbers(action.line);
      action.field = std::string(sinew::detail::need_word(words, "a field"));
      // as it stands, with brackets and commas
      const std::size_t at = line.find(action.field, line.find("set ") + 4) + action.field.size();
      action.words = std::string(line.substr(std::min(at + 1, line.size())));
    } else if (!words.end()) {
      throw Error("", text("goes on with ", sinew::detail::shown(words.next()), " where it should end"));
    }
    all.actions.push_back(std::move(timed));
  };
  while (!content.empty() && !ended) {
    const std::string_view line = next_line();
    try {
      read_line(line);
    } catch (Error const& error) {
      throw Error(text(name, ':', number), error.what());
    }
  }
  if (!ended) throw Error(name, "the file is not whole: its last line says when it ends, as in '100 end'");
  return all;
}

}  // namespace sinew::view
