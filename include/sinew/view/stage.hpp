// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/core/error.hpp>
#include <sinew/view/fields.hpp>
#include <sinew/view/plots.hpp>
#include <sinew/view/seen_scene.hpp>
#include <sinew/view/stage_actor.hpp>
#include <sinew/view/stage_state.hpp>
#include <sinew/view/user_actions.hpp>

#include <algorithm>
#include <array>
#include <charconv>
#include <chrono>
#include <cmath>
#include <condition_variable>
#include <cstddef>
#include <exception>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <utility>
#include <vector>

namespace sinew::view {

/// A simulation in a thread of its own, and what others see of it and tell it to do. Nobody waits for a step:
/// what is asked for is done before the next one, and what is seen is the scene as it was after the last. A
/// scene that nobody looks at makes no pictures.
class Stage {
 public:
  using Scene = std::shared_ptr<SeenScene const>;

  /// The simulation is initialised and stays with this thread until the stage is gone. Its steps are dt
  /// seconds long and, where it is fast enough, go at `speed` times the time of the clock; 0: as fast as they
  /// can.
  template <class Simulation>
  Stage(Simulation& simulation, double dt, double speed = 1, SeenSettings const& seen = {})
      : Stage(simulation, dt, speed, seen, WithoutThread{}) {
    thread_ = std::thread([this] { go(); });
  }
  /// Where there are no threads, as in WebAssembly, turn() does the work.
  struct WithoutThread {};
  template <class Simulation>
  Stage(Simulation& simulation, double dt, double speed, SeenSettings const& seen, WithoutThread)
      : tree(scene_tree(simulation)),
        dt_(dt),
        speed_(speed),
        seen_(seen),
        actor_(new detail::StageActorOf<Simulation>(simulation, seen.needsForces())),
        forcesKept_(seen.needsForces()),
        scene_(std::make_shared<SeenScene>(actor_->see(seen_))) {}
  Stage(Stage const&) = delete;
  Stage& operator=(Stage const&) = delete;
  ~Stage() {
    {
      const std::lock_guard lock(mutex_);
      ends_ = true;
    }
    wake_.notify_all();
    if (thread_.joinable()) thread_.join();
  }

  /// The components of the scene.
  const std::vector<TreeLine> tree;

  /// The latest scene; the next one is made after the step that is going on.
  Scene scene() {
    const std::lock_guard lock(mutex_);
    wanted_ = true;
    wake_.notify_all();
    return scene_;
  }
  StageState state() const {
    const std::lock_guard lock(mutex_);
    return state_;
  }
  double dt() const { return dt_; }
  /// Of a stage without a thread: does what it was asked for, and a step if it is time for one.
  void turn() {
    std::unique_lock lock(mutex_);
    work(lock);
  }

  void play(bool on) {
    ask([on](Stage& s) { s.playing_ = on; });
  }
  /// One step, after which it stands.
  void step() {
    ask([](Stage& s) {
      s.playing_ = false;
      s.animate();
    });
  }
  /// Back to the start.
  void reset() { act({.kind = ActionKind::reset}); }
  void setSpeed(double speed) {
    ask([speed](Stage& s) { s.speed_ = speed; });
  }
  /// Takes hold of what a ray meets first, by a spring [N/m].
  void press(Eigen::Vector3d const& origin, Eigen::Vector3d const& direction, double stiffness) {
    act({.kind = ActionKind::press, .origin = origin, .direction = direction, .stiffness = stiffness});
  }
  /// The end of the spring comes under another ray.
  void move(Eigen::Vector3d const& origin, Eigen::Vector3d const& direction) {
    act({.kind = ActionKind::move, .origin = origin, .direction = direction});
  }
  void release() { act({.kind = ActionKind::release}); }

  /// Keeps the simulation as it is now; restore() goes back there, as often as wanted.
  void keep() {
    ask([](Stage& s) { s.actor_->keep(); });
  }
  void restore() {
    ask([](Stage& s) {
      if (!s.actor_->restore()) throw Error("view", "nothing was kept to go back to");
      s.stopActions();
    });
  }
  /// Goes back to the start, and records from there what is done to the simulation; or ends that.
  void record(bool on) {
    ask([on](Stage& s) {
      s.stopActions();
      if (!on) return;
      s.actor_->reset();
      s.recorded_ = UserActions{.dt = s.dt_};
      for (std::size_t k = 0; k < s.changesDone_; ++k)
        s.recorded_.actions.push_back({0,
                                       {.kind = ActionKind::set,
                                        .line = s.changes_[k].line,
                                        .field = s.changes_[k].field,
                                        .words = s.changes_[k].after}});
      s.records_ = true;
    });
  }
  /// answer(what the last record has).
  void recorded(std::function<void(UserActions const&)> answer) {
    ask([answer = std::move(answer)](Stage& s) { answer(s.recorded_); });
  }
  /// Goes back to the start, with the fields that it had, and does all of that again at the same steps, which
  /// makes the same motion bit by bit; then it stands. What a user does meanwhile ends it.
  void replay(UserActions actions) {
    ask([actions = std::move(actions)](Stage& s) {
      if (actions.dt != s.dt_)
        throw Error("view",
                    text("the actions were recorded with steps of ",
                         actions.dt,
                         " s, and those of the scene are ",
                         s.dt_,
                         " s; start it with --dt ",
                         actions.dt));
      s.stopActions();
      while (s.changesDone_ > 0) {
        FieldChange const& last = s.changes_[--s.changesDone_];
        s.actor_->setField(last.line, last.field, last.before);
      }
      s.changes_.clear();
      s.actor_->reset();
      s.replayed_ = actions;
      s.replays_ = s.playing_ = true;
    });
  }

  /// What is to be seen from the next picture on; forces are kept while they are asked for.
  void show(SeenSettings settings) {
    ask([settings = std::move(settings)](Stage& s) {
      if (const bool needs = settings.needsForces(); needs != s.forcesKept_)
        s.actor_->keepForces(s.forcesKept_ = needs);
      s.seen_ = settings;
    });
  }
  /// act() by the thread of the simulation, between two steps, when it may look at the simulation; then
  /// answer(error).
  void between(std::function<void()> act, std::function<void(std::string const& error)> answer) {
    ask([act = std::move(act), answer = std::move(answer)](Stage&) { answer(error_of(act)); });
  }
  /// Measures the simulation after each step from now on, or no more: how long a step takes, and the energies
  /// of what moves and of the force fields. Those cost about as much as forces.
  void measure(bool on) {
    ask([on](Stage& s) {
      s.beginMeasures();
      s.measuring_ = on;
    });
  }
  /// Measures a field, too: the first number of its value.
  void measureField(int line, std::string field) {
    ask([line, field = std::move(field)](Stage& s) {
      const SeenComponent component = s.actor_->component(line);
      for (SeenField const& one : component.fields)
        if (one.name == field) {
          s.beginMeasures();
          s.measuredFields_.emplace_back(line, field);
          s.clearMeasures();
          s.measures_.series.push_back(
              {text(component.path, ": ", component.className, ": ", field), one.unit});
          return;
        }
      throw Error("view", text("there is no field '", field, "' to measure"));
    });
  }
  /// answer(all that was measured).
  void measures(std::function<void(Measures const&)> answer) {
    ask([answer = std::move(answer)](Stage& s) { answer(s.measures_); });
  }
  /// Times all components during steps from now on, or no more (StageState::profile). An error is that of the
  /// state: a typed scene has timers where it is `profiled(...)`.
  void profile(bool on) {
    ask([on](Stage& s) {
      s.profiling_ = false;
      s.profile_.reset();
      s.actor_->profile(on);
      s.profiling_ = on;
      s.pace_.nextProfile = Clock::now() + std::chrono::milliseconds(500);
    });
  }
  /// The component at a line of the tree is looked at from now on (StageState::selected); -1: none is.
  void select(int line) {
    ask([line](Stage& s) {
      s.selectedLine_ = -1;
      s.selected_.reset();
      if (line < 0) return;
      s.selected_ = std::make_shared<SeenComponent const>(s.actor_->component(line));
      s.selectedLine_ = line;
    });
  }
  /// answer(component, error) with the fields of the component at a line as they are between two steps; the
  /// error is empty where there is one. The thread of the simulation calls it.
  void component(int line, std::function<void(SeenComponent const&, std::string const& error)> answer) {
    ask([line, answer = std::move(answer)](Stage& s) {
      SeenComponent seen;
      const std::string error = error_of([&] { seen = s.actor_->component(line); });
      answer(seen, error);
    });
  }
  /// The same with the whole value of one field, however long.
  void fieldText(int line, std::string field,
                 std::function<void(std::string const& value, std::string const& error)> answer) {
    ask([line, field = std::move(field), answer = std::move(answer)](Stage& s) {
      std::string value;
      const std::string error = error_of([&] { value = s.actor_->fieldText(line, field); });
      answer(value, error);
    });
  }
  /// Gives a field of the component at a line another value, in the words of a scene file, between two steps
  /// (set_field). answer(error) is called then, where it is given; otherwise an error is that of the state.
  void setField(int line, std::string field, std::string words,
                std::function<void(std::string const& error)> answer = {}) {
    ask([line, field = std::move(field), words = std::move(words), answer = std::move(answer)](Stage& s) {
      auto change = [&] {
        s.endReplay();
        s.perform({.kind = ActionKind::set, .line = line, .field = field, .words = words});
      };
      if (!answer) return change();
      answer(error_of(change));
    });
  }
  /// Takes back the last change of a field; and does again what was taken back last.
  void undo() {
    ask([](Stage& s) {
      if (s.changesDone_ == 0) return;
      FieldChange const& last = s.changes_[s.changesDone_ - 1];
      s.endReplay();
      s.setRecorded(last.line, last.field, last.before);
      --s.changesDone_;
    });
  }
  void redo() {
    ask([](Stage& s) {
      if (s.changesDone_ == s.changes_.size()) return;
      FieldChange const& next = s.changes_[s.changesDone_];
      s.endReplay();
      s.setRecorded(next.line, next.field, next.after);
      ++s.changesDone_;
    });
  }
  /// Waits until all that was asked for is done.
  void settle() {
    std::unique_lock lock(mutex_);
    idle_.wait(lock, [this] { return asked_.empty() && !busy_; });
  }

 private:
  using Clock = std::chrono::steady_clock;

  double dt_, speed_;
  SeenSettings seen_;
  std::unique_ptr<detail::StageActor> actor_;
  bool forcesKept_;
  mutable std::mutex mutex_{};
  std::condition_variable wake_{}, idle_{};
  std::vector<std::function<void(Stage&)>> asked_{};
  Scene scene_;
  StageState state_{};
  // of the thread alone
  int selectedLine_ = -1;
  std::shared_ptr<SeenComponent const> selected_{};
  std::vector<FieldChange> changes_{};
  std::size_t changesDone_ = 0;
  Measures measures_{};
  std::vector<std::pair<int, std::string>> measuredFields_{};
  bool measuring_ = false, profiling_ = false;
  bool changed_ = false;  // since the scene was last looked at
  std::shared_ptr<StepProfile const> profile_{};
  UserActions recorded_{}, replayed_{};
  bool records_ = false, replays_ = false;
  long stepped_ = 0;            // since a record or a replay has begun
  std::size_t replayedTo_ = 0;  // of its actions
  struct Pace {
    // when a step is due; since when steps count; when measures are shown again
    Clock::time_point next = Clock::now(), measured = next, nextMeasures = next, nextProfile = next;
    long steps = 0;
    double rate = 0;
    std::string error{};
  } pace_{};
  bool ends_ = false, wanted_ = true, busy_ = false, playing_ = false;
  std::thread thread_;  // the last, since it uses all of them

  void act(UserAction action) {
    ask([action = std::move(action)](Stage& s) {
      s.endReplay();
      s.perform(action);
    });
  }
  // what a user does to the simulation
  void perform(UserAction const& action) {
    switch (action.kind) {
      case ActionKind::press:
        actor_->press(action.origin, action.direction, action.stiffness);
        break;
      case ActionKind::move:
        actor_->move(action.origin, action.direction);
        break;
      case ActionKind::release:
        actor_->release();
        break;
      case ActionKind::reset:
        actor_->reset();
        break;
      case ActionKind::set: {
        FieldChange change = actor_->setField(action.line, action.field, action.words);
        changes_.resize(changesDone_);
        if (change.before != change.after) changes_.push_back(std::move(change));
        changesDone_ = changes_.size();
        break;
      }
    }
    if (records_) recorded_.actions.push_back({stepped_, action});
  }
  // without a place among the changes that can be taken back
  void setRecorded(int line, std::string const& field, std::string const& words) {
    actor_->setField(line, field, words);
    if (records_)
      recorded_.actions.push_back(
          {stepped_, {.kind = ActionKind::set, .line = line, .field = field, .words = words}});
  }
  void stopActions() {
    if (records_) recorded_.steps = stepped_;
    records_ = replays_ = false;
    stepped_ = 0;
    replayedTo_ = 0;
  }
  void endReplay() {
    if (replays_) stopActions();
  }
  void animate() {
    auto& actions = replayed_.actions;
    while (replays_ && replayedTo_ < actions.size() && actions[replayedTo_].step <= stepped_)
      perform(actions[replayedTo_++].action);
    if (replays_ && stepped_ >= replayed_.steps) {
      stopActions();
      playing_ = false;
      return;
    }
    const auto start = Clock::now();
    actor_->animate(dt_);
    ++stepped_;
    if (measuring_) measureStep(std::chrono::duration<double>(Clock::now() - start).count());
  }
  void beginMeasures() {
    if (measures_.series.empty())
      measures_.series = {
          {"time of a step", "ms"}, {"kinetic energy", "J"}, {"energy of the force fields", "J"}};
  }
  void clearMeasures() {
    measures_.times.clear();
    for (Series& one : measures_.series) one.values.clear();
  }
  void measureStep(double seconds) {
    StageState now;
    actor_->tell(now);
    // behind a reset, time begins anew
    if (!measures_.times.empty() && now.time < measures_.times.back()) {
      clearMeasures();
    }
    measures_.drop();
    measures_.times.push_back(now.time);
    const auto [kinetic, potential] = actor_->energies();
    std::size_t k = 0;
    for (const double value : {1000 * seconds, kinetic, potential})
      measures_.series[k++].values.push_back(value);
    for (auto const& [line, field] : measuredFields_) {
      const std::string words = actor_->fieldText(line, field);
      double value = std::nan("");
      std::from_chars(words.data(), words.data() + words.size(), value);
      measures_.series[k++].values.push_back(value);
    }
  }
  // what an act throws, in words; empty where it throws nothing
  template <class Act>
  static std::string error_of(Act&& act) {
    try {
      act();
    } catch (std::exception const& e) {
      return e.what();
    }
    return {};
  }
  void ask(std::function<void(Stage&)> what) {
    {
      const std::lock_guard lock(mutex_);
      asked_.push_back(std::move(what));
    }
    wake_.notify_all();
  }

  void go() {
    while (true) {
      std::unique_lock lock(mutex_);
      auto called = [this] { return ends_ || !asked_.empty() || wanted_; };
      // what is late does not wait, which would give the processor away
      if (!playing_)
        wake_.wait(lock, called);
      else if (Clock::now() < pace_.next)
        wake_.wait_until(lock, pace_.next, [this] { return ends_ || !asked_.empty(); });
      if (ends_) return;
      work(lock);
    }
  }
  // The lock is held at first and at the end.
  void work(std::unique_lock<std::mutex>& lock) {
    auto careful = [&](auto&& act) {
      if (const std::string wrong = error_of(act); !wrong.empty()) {
        pace_.error = wrong;
        return false;
      }
      return true;
    };
    auto& [next, measured, nextMeasures, nextProfile, steps, rate, error] = pace_;
    std::vector<std::function<void(Stage&)>> mine = std::exchange(asked_, {});
    busy_ = true;
    const bool look = std::exchange(wanted_, false);
    lock.unlock();
    const bool stood = !playing_, told = !mine.empty();
    if (told) error.clear();
    for (auto const& what : mine) careful([&] { what(*this); });
    if (stood) next = measured = Clock::now(), steps = 0;
    if (playing_ && Clock::now() >= next) {
      changed_ = true;
      if (!careful([&] { animate(); })) playing_ = false;
      ++steps;
      // after a slow step the time that is lost is not made up for
      const auto pause = std::chrono::duration_cast<Clock::duration>(
          std::chrono::duration<double>(speed_ > 0 ? dt_ / speed_ : 0));
      next = std::max(next + pause, Clock::now() - pause);
      const double since = std::chrono::duration<double>(Clock::now() - measured).count();
      if (since > 0.5) rate = double(steps) / since, steps = 0, measured = Clock::now();
    }
    if (profiling_ && Clock::now() >= nextProfile) {
      if (StepProfile latest = actor_->takeProfile(); latest.steps > 0)
        profile_ = std::make_shared<StepProfile const>(std::move(latest));
      nextProfile = Clock::now() + std::chrono::milliseconds(500);
    }
    Scene seen;
    changed_ = changed_ || told;
    if ((look || told) && std::exchange(changed_, false))
      careful([&] {
        seen = std::make_shared<SeenScene>(actor_->see(seen_));
        if (selectedLine_ >= 0)
          selected_ = std::make_shared<SeenComponent const>(actor_->component(selectedLine_));
      });
    lock.lock();
    if (seen) scene_ = std::move(seen);
    actor_->tell(state_);
    state_.selected = selected_;
    if (measuring_ && (look || told) && Clock::now() > nextMeasures) {
      state_.measures = std::make_shared<Measures const>(measures_);
      nextMeasures = Clock::now() + std::chrono::milliseconds(200);
    }
    state_.measuring = measuring_;
    state_.profiling = profiling_;
    state_.profile = profile_;
    state_.recording = records_;
    state_.replaying = replays_;
    if (told) {
      state_.undo = changesDone_ > 0 ? std::optional(changes_[changesDone_ - 1]) : std::nullopt;
      state_.redo = changesDone_ < changes_.size() ? std::optional(changes_[changesDone_]) : std::nullopt;
    }
    state_.playing = playing_;
    state_.stepsPerSecond = playing_ ? rate : 0;
    state_.error = error;
    busy_ = false;
    idle_.notify_all();
  }
};

}  // namespace sinew::view
