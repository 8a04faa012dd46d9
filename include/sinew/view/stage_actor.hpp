// SPDX-License-Identifier: BSL-1.0
#pragma once

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

  StageActorOf(Simulation& s, bool forces) : simulation(s) {
    if (forces) simulation.keepForces(true);
  }
  void animate(double dt) override { simulation.animate(dt); }
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
