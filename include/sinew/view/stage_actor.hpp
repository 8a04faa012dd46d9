// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/core/profile.hpp>
#include <sinew/scene/mouse_interactor.hpp>
#include <sinew/view/fields.hpp>
#include <sinew/view/seen_scene.hpp>
#include <sinew/view/stage_state.hpp>

#include <Eigen/Core>
#include <array>
#include <memory>
#include <string>

namespace sinew::view {

namespace detail {

/// What a stage does with a simulation of whatever class.
struct StageActor {
  virtual ~StageActor() = default;
  virtual void animate(double dt) = 0;
  virtual void reset() = 0;
  virtual void press(Eigen::Vector3d const& origin, Eigen::Vector3d const& direction, double stiffness) = 0;
  virtual void move(Eigen::Vector3d const& origin, Eigen::Vector3d const& direction) = 0;
  virtual void release() = 0;
  virtual std::array<double, 2> energies() = 0;
  virtual void profile(bool on) = 0;
  virtual StepProfile takeProfile() = 0;
  virtual void keep() = 0;
  virtual bool restore() = 0;
  virtual void keepForces(bool keep) = 0;
  virtual SeenScene see(SeenSettings const& settings) = 0;
  virtual SeenComponent component(int line) = 0;
  virtual std::string fieldText(int line, std::string const& field) = 0;
  virtual FieldChange setField(int line, std::string const& field, std::string const& words) = 0;
  virtual void tell(StageState& state) = 0;
};
template <class Simulation>
struct StageActorOf final : StageActor {
  Simulation& simulation;
  std::unique_ptr<Simulation> kept{};
  KnownBorders borders{};
  MouseInteractor mouse{};
  std::unique_ptr<Profile> timer{};  // of a runtime tree, while it is timed

  StageActorOf(Simulation& s, bool forces) : simulation(s) {
    if (forces) simulation.keepForces(true);
  }
  ~StageActorOf() override {
    if constexpr (canBeTimed)
      if (timer) simulation.root().profileWith(nullptr);
  }
  static constexpr bool canBeTimed = requires(Simulation& s) { s.root().profileWith(nullptr); };
  static constexpr bool isTimed = requires(Simulation& s) { s.root().profile().clear(); };
  void profile(bool on) override {
    if constexpr (canBeTimed) {
      if (on == bool(timer)) return;
      timer = on ? std::make_unique<Profile>() : nullptr;
      simulation.root().profileWith(timer.get());
    } else if constexpr (isTimed) {
      simulation.root().profile().clear();
    } else if (on) {
      throw Error(
          "view",
          "this typed scene has no timers; write Simulation sim{profiled(node<...>(...))} to see where "
          "its time goes");
    }
  }
  StepProfile takeProfile() override {
    Profile* now = nullptr;
    if constexpr (canBeTimed)
      now = timer.get();
    else if constexpr (isTimed)
      now = &simulation.root().profile();
    if (!now) return {};
    StepProfile made = step_profile(*now);
    now->clear();
    return made;
  }
  void animate(double dt) override {
    if constexpr (canBeTimed)  // a scene that has changed, or that was gone back to, is another one
      if (timer && simulation.root().profile != timer.get()) simulation.root().profileWith(timer.get());
    simulation.animate(dt);
  }
  void reset() override {
    mouse.release(simulation);
    simulation.reset();
  }
  void press(Eigen::Vector3d const& origin, Eigen::Vector3d const& direction, double stiffness) override {
    mouse.spring.stiffness = stiffness;
    mouse.press(simulation, origin, direction);
  }
  void move(Eigen::Vector3d const& origin, Eigen::Vector3d const& direction) override {
    mouse.move(simulation, origin, direction);
  }
  void release() override { mouse.release(simulation); }
  std::array<double, 2> energies() override {
    return {simulation.kineticEnergy(), simulation.potentialEnergy()};
  }
  void keep() override {
    kept = std::make_unique<Simulation>(simulation);
    MouseInteractor(mouse).release(*kept);  // nobody holds it there
  }
  bool restore() override {
    mouse.release(simulation);
    if (kept) simulation = *kept;
    return bool(kept);
  }
  void keepForces(bool keep) override { simulation.keepForces(keep); }
  SeenScene see(SeenSettings const& settings) override { return seen_scene(simulation, settings, &borders); }
  SeenComponent component(int line) override { return seen_component(simulation, line); }
  std::string fieldText(int line, std::string const& field) override {
    return field_text(simulation, line, field);
  }
  FieldChange setField(int line, std::string const& field, std::string const& words) override {
    return set_field(simulation, line, field, words);
  }
  void tell(StageState& state) override {
    state.time = simulation.time();
    state.step = simulation.step();
    state.held.reset();
    if (!mouse.held) return;
    if (Attachment const* a = simulation.attachment(mouse.attachment))
      state.held = Held{.path = mouse.held->path,
                        .point = a->target - a->contact.evaluated / a->stiffness,
                        .target = a->target,
                        .force = a->contact.force};
  }
};

}  // namespace detail

}  // namespace sinew::view
