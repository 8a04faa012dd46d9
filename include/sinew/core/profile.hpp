// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/core/phase.hpp>

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

namespace sinew {

/// What a profile is told of a component of a typed scene, when its table is made.
struct ProfiledClass {
  std::string (*path)();
  std::string (*name)();
};

/// What is timed: a phase (`what` is null), a component of a typed scene (`what` is its ProfiledClass,
/// `which` its place in the node), or one that a profile has named itself (`what` is the profile).
struct ProfileKey {
  void const* what = nullptr;
  int which = 0;

  ProfileKey() = default;
  ProfileKey(Phase phase) : which(int(phase)) {}
  ProfileKey(void const* w, int n) : what(w), which(n) {}
  bool operator==(ProfileKey const&) const = default;
};

/// The number by which a profile knows a component of a runtime tree.
struct ProfileNumber {
  void const* by = nullptr;
  int number = 0;
};

/// Where the time of steps goes: a tree of phases and components, with calls and times. Only what happens in
/// Simulation::animate and updateVisual is counted. With room for events it also keeps when each call was.
/// All memory is taken at the start; what does not fit any more is counted as part of what is around it, in
/// `leftOut` and `eventsLeftOut`. Times are those of std::chrono::steady_clock [ns]: tens of ns a reading,
/// monotone, and without a unit to be found out, as the counter of a processor has one. One thread at a time
/// writes to a profile.
class Profile {
 public:
  struct Row {
    ProfileKey key{};
    int parent = -1, child = -1, next = -1, last = -1;  // the first below, the next beside, the last one seen
    long calls = 0;
    std::int64_t total = 0, begin = 0;  // [ns]
    long event = -1;
  };
  struct Event {
    int row;
    std::int64_t begin, end;  // [ns] since the first one
  };
  struct Name {
    std::string path, className;
  };

  explicit Profile(std::size_t maxEvents = 0, std::size_t maxRows = 4096) : rows_(maxRows + 1) {
    events_.resize(maxEvents);
    clear();
  }

  /// Forgets all calls. Names, and the memory, stay.
  void clear() {
    rows_[0] = {};
    count_ = 1;
    current_ = 0;
    taken_ = 0;
    leftOut_ = eventsLeftOut_ = 0;
  }
  /// Room for as many rows as a tree of so many components may need.
  void reserveFor(std::size_t components) {
    if (rows_.size() < 64 * components) rows_.resize(64 * components);
  }
  /// A component of a runtime tree, at a path such as "/root/liver/fem".
  ProfileNumber add(std::string const& path, std::string className) {
    names_.push_back({path.substr(path.find('/', 1) + 1), std::move(className)});
    return {this, int(names_.size()) - 1};
  }

  // while the scene runs

  /// Begins a call. False, and leave() must not follow, where it is counted as part of what is around it.
  bool enter(ProfileKey key) {
    Row& around = rows_[std::size_t(current_)];
    if (current_ == 0 ? key.what || (key.which != int(Phase::step) && key.which != int(Phase::visual))
                      : key.what && whole(around.key))
      return false;
    const int found = find(around, key);
    if (found < 0) return false;
    around.last = current_ = found;
    Row& row = rows_[std::size_t(found)];
    ++row.calls;
    row.begin = now();
    if (!events_.empty()) {
      if (taken_ < events_.size()) {
        row.event = long(taken_);
        events_[taken_++] = {found, row.begin, row.begin};
      } else {
        row.event = -1;
        ++eventsLeftOut_;
      }
    }
    return true;
  }
  void leave() {
    const std::int64_t end = now();
    Row& row = rows_[std::size_t(current_)];
    row.total += end - row.begin;
    if (row.event >= 0) events_[std::size_t(row.event)].end = end;
    current_ = row.parent;
  }

  /// Adds calls whose times are not known to what runs now.
  void count(ProfileKey key, long calls) {
    if (current_ == 0 || calls <= 0) return;
    const int found = find(rows_[std::size_t(current_)], key);
    if (found >= 0) rows_[std::size_t(found)].calls += calls;
  }

  // what came out

  /// Rows, parents before children; the first stands for all and has no times.
  std::vector<Row> rows() const { return {rows_.begin(), rows_.begin() + count_}; }
  Row const& row(int i) const { return rows_[std::size_t(i)]; }
  int rowCount() const { return count_; }
  std::size_t eventCount() const { return taken_; }
  Event const& event(std::size_t i) const { return events_[i]; }
  long leftOut() const { return leftOut_; }
  long eventsLeftOut() const { return eventsLeftOut_; }

  bool isPhase(int i) const { return !row(i).key.what; }
  /// Path and class of a component, or the name of a phase.
  Name nameOf(int i) const {
    const ProfileKey key = row(i).key;
    if (!key.what) return {std::string(enum_names(Phase{})[std::size_t(key.which)]), ""};
    if (key.which < 0) return names_[std::size_t(-1 - key.which)];
    auto const& typed = *static_cast<ProfiledClass const*>(key.what);
    return {typed.path(), typed.name()};
  }
  /// How often a phase was begun, wherever.
  long calls(Phase phase) const {
    long sum = 0;
    for (int i = 1; i < count_; ++i)
      if (row(i).key == ProfileKey(phase)) sum += row(i).calls;
    return sum;
  }
  /// The time in a phase, wherever [s].
  double seconds(Phase phase) const {
    double sum = 0;
    for (int i = 1; i < count_; ++i)
      if (row(i).key == ProfileKey(phase)) sum += 1e-9 * double(row(i).total);
    return sum;
  }

 private:
  std::vector<Row> rows_;
  std::vector<Event> events_{};
  std::vector<Name> names_{};
  int count_ = 1, current_ = 0;
  std::size_t taken_ = 0;
  long leftOut_ = 0, eventsLeftOut_ = 0;

  static std::int64_t now() {
    return std::chrono::duration_cast<std::chrono::nanoseconds>(
               std::chrono::steady_clock::now().time_since_epoch())
        .count();
  }
  // phases in which components are looked at several times for one thing
  static bool whole(ProfileKey key) {
    if (key.what) return false;
    const auto phase = Phase(key.which);
    return (phase >= Phase::collision && phase <= Phase::carving) || phase == Phase::contacts;
  }
  // calls come in the same order from step to step: the next one is looked at first
  int find(Row const& around, ProfileKey key) {
    if (around.last >= 0) {
      const int next = rows_[std::size_t(around.last)].next, guess = next >= 0 ? next : around.child;
      if (rows_[std::size_t(guess)].key == key) return guess;
    }
    int last = -1;
    for (int i = around.child; i >= 0; last = i, i = rows_[std::size_t(i)].next)
      if (rows_[std::size_t(i)].key == key) return i;
    if (std::size_t(count_) == rows_.size()) return ++leftOut_, -1;
    rows_[std::size_t(count_)] = {};
    rows_[std::size_t(count_)].key = key;
    rows_[std::size_t(count_)].parent = current_;
    (last < 0 ? rows_[std::size_t(current_)].child : rows_[std::size_t(last)].next) = count_;
    return count_++;
  }
};

/// Counts the iterations of the linear solver that runs, which has one residual more.
template <class Solver>
void count_iterations([[maybe_unused]] Profile& profile, [[maybe_unused]] Solver const& solver) {
  if constexpr (requires { solver.residuals.size(); })
    profile.count(Phase::iteration, long(solver.residuals.size()) - 1);
}

/// Times a call from here to the end of a block.
class Span {
 public:
  Span(Profile* profile, ProfileKey key) : profile_(profile && profile->enter(key) ? profile : nullptr) {}
  Span(Span const&) = delete;
  ~Span() {
    if (profile_) profile_->leave();
  }

 private:
  Profile* profile_;
};

}  // namespace sinew
