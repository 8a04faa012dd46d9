// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/core/compiled.hpp>
#include <sinew/core/error.hpp>

#include <string>
#include <string_view>
#include <vector>

namespace sinew {

/// What a scene has noticed in a step: it goes on, but perhaps not as it was meant.
struct StepWarning {
  std::string where{};      // a node, or what meets
  std::string_view what{};  // in short, the same in each step: "the constraints are not solved"
  std::string message{};    // with its figures, as it was the first time, and what to do
  long step = 0, last = 0;  // the first and the last step in which it was so
  double time = 0;          // at the end of the first [s]
  long count = 0;           // in how many steps it was so

  /// "step 3 (time 0.03 s), /root: <message>"
  std::string text() const;
  /// "/root: <what> in 39 steps, from step 3 to 80"
  std::string summary() const;
};

/// The warnings of a scene that runs. The same one, in the same place, is kept once and counted; what is
/// nothing new allocates nothing. Beyond `capacity` others are counted only.
class StepWarnings {
 public:
  static constexpr std::size_t capacity = 100;

  std::vector<StepWarning> const& list() const { return list_; }
  /// How many found no room.
  long leftOut() const { return leftOut_; }

  /// Adds one, whose message `message()` makes where it is new. `what` is a literal.
  template <class F>
  void add(long step, double time, std::string_view where, std::string_view what, F&& message) {
    if (StepWarning* known = find(where, what)) {
      known->count += known->last != step;
      known->last = step;
    } else if (list_.size() < capacity) {
      list_.push_back({std::string(where), what, message(), step, step, time, 1});
    } else {
      ++leftOut_;
    }
  }
  void clear() {
    list_.clear();
    leftOut_ = 0;
  }

 private:
  std::vector<StepWarning> list_{};
  long leftOut_ = 0;

  StepWarning* find(std::string_view where, std::string_view what) {
    for (StepWarning& w : list_)
      if (w.what == what && w.where == where) return &w;
    return nullptr;
  }
};

/// Where a step adds its warnings.
struct StepNotes {
  StepWarnings& warnings;
  long step;    // from 1
  double time;  // at its end [s]

  template <class F>
  void warn(std::string_view where, std::string_view what, F&& message) const {
    warnings.add(step, time, where, what, message);
  }
};

}  // namespace sinew

#if SINEW_DEFINES

namespace sinew {

SINEW_ONCE std::string StepWarning::text() const {
  return sinew::text("step ", step, " (time ", time, " s), ", where, ": ", message);
}

SINEW_ONCE std::string StepWarning::summary() const {
  return sinew::text(where, ": ", what, " in ", count, " steps, from step ", step, " to ", last);
}

}  // namespace sinew
#endif
