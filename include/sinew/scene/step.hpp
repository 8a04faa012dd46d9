// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/core/step_warnings.hpp>
#include <sinew/scene/carving.hpp>
#include <sinew/scene/changing_points.hpp>
#include <sinew/scene/collision.hpp>
#include <sinew/scene/cutting.hpp>
#include <sinew/scene/fluid_boundaries.hpp>
#include <sinew/scene/immersed_bodies.hpp>
#include <sinew/scene/live_engines.hpp>
#include <sinew/scene/loose_interactions.hpp>
#include <sinew/scene/mechanical_operations.hpp>
#include <sinew/scene/overlap_warnings.hpp>
#include <sinew/scene/solvers.hpp>
#include <sinew/scene/topological_changes.hpp>

#include <string>
#include <string_view>
#include <vector>

namespace sinew {

/// scene/constrained_step.hpp, which sinew/lagrangian.hpp includes.
template <class RootScope>
struct ConstrainedStep;
template <class T>
concept IsComplete = requires { sizeof(T); };

/// The stages of one step of a scene, in the order in which Simulation::animate takes them.
template <class RootScope>
struct Step {
  RootScope const& root;
  long number;      // of the step, from 1
  double time, dt;  // at its start, and its length [s]
  StepWarnings& warnings;
  bool first = number == 1;  // nothing was integrated before since init or reset

  /// What acts before a step: all may look at the scene, points go and come, then it may be moved.
  void begin() const {
    [[maybe_unused]] const auto span = root.span(Phase::beforeStep);
    const StepAhead ahead{number, time, time + dt, dt, false};
    forEachAhead(root, ahead, [](auto& c, auto& state, StepAhead const& step) {
      if constexpr (requires { c.beforeStep(step, state); }) c.beforeStep(step, state);
    });
    ChangingPoints<RootScope>{root}.change(ahead);
    bool moved = false;
    forEachAhead(root, ahead, [&](auto& c, auto& state, StepAhead const& step) {
      if constexpr (requires { c.beginStep(step, state); }) moved = c.beginStep(step, state) || moved;
    });
    placeUnsolved(root, moved);
    if (!moved) return;
    MechanicalOperations(root, time, dt).propagate(vec_id::position, vec_id::velocity);
    with_first<role::AnimationLoop>(root, [&](auto const&) {
      traverse(root, on<role::State>([](auto& s, auto const&) {
                 if constexpr (requires { s.freePosition; }) s.freePosition = s.position;
               }));
    });
  }

  /// Finds the contacts of the step; a matrix in which other points are joined is formed anew. It warns of
  /// bodies that start in each other, or come there before a contact is seen.
  void detectContacts() const;

  /// Changes topologies where the time has come, or elements are where none may be, by edit(path, order).
  template <class Edit>
  void changeTopology(Edit&& edit) const {
    try {
      TopologicalChanges<RootScope>{root}.make(time, notes(), edit);
    } catch (Error const& error) {
      throw Error(text("the topological change at step ", number - 1, " (time ", time, " s)"), error.what());
    }
  }

  /// Removes what tools touch, by remove(path, elements); says whether something went.
  template <class Remove>
  bool carve(Remove&& remove) const {
    if (!any_below<role::Carving>(root)) return false;
    [[maybe_unused]] const auto span = root.span(Phase::carving);
    const std::vector<Carved> all = Carving<RootScope>{root}.touched();
    long removed = 0;
    for (Carved const& c : all) {
      if (c.count == 0) continue;
      try {
        remove(c.path, c.elements);
      } catch (Error const& error) {
        throw Error(text("carving at step ", number - 1, " (time ", time, " s)"),
                    text(c.count, " elements of '", c.path, "' cannot be removed: ", error.what()));
      }
      removed += long(c.count);
    }
    if (removed > 0)
      traverse(root, on<role::Carving>([&](auto& carving, auto const&) {
                 if (carving.active) carving.removed += removed;
               }));
    return removed > 0;
  }

  /// Cuts what blades have gone through, by cut(path, order).
  template <class F>
  void cut(F&& f) const {
    if (!any_below<role::Cutting>(root)) return;
    [[maybe_unused]] const auto span = root.span(Phase::carving);
    Cutting<RootScope>{root}.make(notes(), f);
  }

  /// The external forces of interactions between solvers.
  void computeLoose() const { LooseInteractions<RootScope>{root}.compute({.time = time, .dt = dt}); }

  /// What has degrees of freedom of its own goes on by the step.
  void stepModels() const {
    if constexpr (holds<typename RootScope::NodeType, role::BehaviorModel>()) {
      const StepAhead ahead{number, time, time + dt, dt, false};
      const ImmersedBodies<RootScope> immersed{root};
      immersed.gather(dt);
      traverse(root, on<role::BehaviorModel>([&](auto& model, auto const& scope) {
                 model.step(ahead, scope.gravity(), scope.workers());
                 immersed.giveForces(model);
                 if constexpr (Notices<std::decay_t<decltype(model)>>)
                   if (const std::string_view what = model.notice(); !what.empty())
                     notes().warn(scope.path(), what, [&] { return std::string(what); });
               }));
    }
  }

  /// Each ODE solver integrates its subtree and propagates; where the scene has an animation loop,
  /// constraints by multipliers hold at the end.
  void integrate(bool keepsForces) const {
    FluidBoundaries<RootScope>{root}.gather();
    const bool constrained =
        with_first<role::AnimationLoop>(root, [&](auto& loop) { integrateConstrained(loop, keepsForces); });
    if (!constrained)
      for_each_solver(root, [&](auto& ode, auto const& scope) { solve(ode, scope, keepsForces); });
    if (first) warnOfThresholds();
  }

  /// What follows other values takes those at the end of the step.
  void follow() const {
    if constexpr (holds<typename RootScope::NodeType, role::DataLink>()) {
      try {
        LiveEngines<RootScope>{root, time + dt}.update(false);
      } catch (Error const& error) {
        const StepInfo info{number, time + dt, dt};
        traverse(root, on<role::State>([&](auto& state, auto const& s) { end(state, s, info); }));
        throw Error(text("step ", number, " (time ", time + dt, " s)"), error.what());
      }
    }
  }

  /// Checks states, and calls what watches them. The time is that of the end of the step.
  void end() const {
    [[maybe_unused]] const auto span = root.span(Phase::endStep);
    const StepInfo info{number, time + dt, dt};
    traverse(root, on<role::State, role::StepCallback>([&](auto& c, auto const& s) { end(c, s, info); }));
  }

 private:
  StepNotes notes() const { return {warnings, number, time + dt}; }
  void warnOfOverlaps() const {
    traverse(root, on<role::CollisionPipeline>([&](auto& pipeline, auto const& scope) {
               if (Collision<RootScope>::isToCome(pipeline)) return;
               with_first<role::ContactManager>(
                   scope, [&](auto& manager) { warn_of_overlaps(notes(), pipeline, manager); });
             }));
  }

  // A threshold above all that a light body may have leaves it where it is; later it may mean equilibrium.
  void warnOfThresholds() const {
    traverse(root, on<role::LinearSolver>([&](auto const& linear, auto const& scope) {
               if constexpr (requires { linear.notBegun; })
                 if (linear.notBegun)
                   notes().warn(scope.path(), "the linear solver did not begin", [&] {
                     return text(
                         "the linear solver did not begin, since p.A p of its first direction is not "
                         "above its threshold, ",
                         linear.threshold,
                         "; forces move nothing then: give a smaller one");
                   });
             }));
  }

  // (a function, since the body of a generic lambda is looked at where there is no loop)
  template <class Loop>
  void integrateConstrained(Loop& loop, bool keepsForces) const {
    static_assert(IsComplete<ConstrainedStep<RootScope>>,
                  "Sinew: a scene with an animation loop needs what solves constraints; include "
                  "<sinew/lagrangian.hpp>, or <sinew/scene/constrained_step.hpp>.");
    if constexpr (requires { loop.newtonIterations, loop.newtonTolerance; }) {
      loop.motion.newtonIterations = loop.newtonIterations;
      loop.motion.newtonTolerance = loop.newtonTolerance;
    }
    if constexpr (IsComplete<ConstrainedStep<RootScope>>)
      ConstrainedStep<RootScope>{root, time, dt, notes()}.integrate(
          loop.motion, loop.solveVelocityConstraintFirst, keepsForces);
  }

  // What no solver moves is, during a step, where its constraints put it at the end of the step, unless they
  // have put it before the step themselves.
  template <class S>
  void placeUnsolved(S const& scope, bool& moved) const {
    if (scope.template has<role::OdeSolver>()) return;
    auto visit = on<role::ProjectiveConstraint>([&](auto& c) {
      using C = std::decay_t<decltype(c)>;
      if constexpr (!JoinsTwo<C> && !ActsBeforeStep<C>) {
        auto& s = scope.template state<typename C::DataTypes>();
        if constexpr (requires { c.projectVelocity(time, s.velocity); })
          c.projectVelocity(time + dt, s.velocity);
        if constexpr (requires { c.projectPosition(time, s.position); }) {
          c.projectPosition(time + dt, s.position);
          moved = true;
        }
      }
    });
    scope.forEachComponent(visit);
    scope.template forEachChild<role::ProjectiveConstraint>(
        [&](auto const& child) { placeUnsolved(child, moved); });
  }

  // f(component, state, step) for what acts before a step
  template <class S, class F>
  static void forEachAhead(S const& scope, StepAhead ahead, F&& f) {
    if (scope.template has<role::OdeSolver>()) ahead.solved = true;
    auto visit = on<BeforeStep>(
        [&](auto& c) { f(c, scope.template state<typename std::decay_t<decltype(c)>::DataTypes>(), ahead); });
    scope.forEachComponent(visit);
    scope.template forEachChild<BeforeStep>([&](auto const& child) { forEachAhead(child, ahead, f); });
  }

  template <class Ode, class S>
  void solve(Ode& ode, S const& scope, bool keepsForces) const {
    MechanicalOperations<S> operations(scope, time, dt);
    if constexpr (!stands_beside<Ode>) operations.acted.begin(keepsForces);
    ode.solve(operations, dt);
    operations.projectPositionAndVelocity(time + dt, vec_id::position, vec_id::velocity);
    operations.propagate(vec_id::position, vec_id::velocity);
    end_acted_forces<Ode>(operations);
    FluidBoundaries<RootScope>{root}.giveForces(scope);
  }

  template <class C, class S>
  static void end(C& c, S const& scope, StepInfo const& info) {
    if constexpr (HasRole<C, role::State>) {
      if (!scope.mapped()) checkFinite(c, scope, info);
    } else if constexpr (WatchesState<C>) {
      using D = typename C::DataTypes;
      auto& state = scope.template state<D>();
      c.endStep(info, state, [&] {
        double energy = 0;
        scope.stateScope().withMass([&](auto& mass) {
          if constexpr (std::is_same_v<typename std::decay_t<decltype(mass)>::DataTypes, D>)
            energy = mass.kineticEnergy(state.position, state.velocity);
        });
        return energy;
      });
    } else if constexpr (requires { c.call(info, scope.node); }) {
      c.call(info, scope.node);
    } else {
      c.call(info);
    }
  }
  template <class C, class S>
  static void checkFinite(C const& state, S const& scope, StepInfo const& info) {
    const int x = VectorOperations<typename C::DataTypes>::findNotFinite(state.position);
    if (x < 0) return;
    throw Error(text("step ", info.step, " (time ", info.time, " s), ", scope.path()),
                text(component_name<C>(),
                     ": the position of point ",
                     x,
                     " is not a finite number: the simulation diverged; take a smaller dt, an implicit "
                     "solver, more damping "
                     "or a softer material"));
  }
};

// Outside the class, so that a program may have it instantiated in one place: runtime/precompiled.hpp.
template <class RootScope>
void Step<RootScope>::detectContacts() const {
  [[maybe_unused]] const auto span = root.span(Phase::collision);
  auto newPattern = [&](auto const& solved, bool) {
    auto visit = on<role::OdeSolver>([&](auto& ode) {
      MechanicalOperations<std::decay_t<decltype(solved)>> operations(solved, time, dt);
      if (operations.template hasSystem<std::decay_t<decltype(ode)>>()) operations.formPattern();
    });
    solved.forEachComponent(visit);
    // a constraint solver that has the matrices of all systems
    with_first<role::AnimationLoop>(root, [](auto& loop) {
      if constexpr (requires { loop.motion.systems; })
        for (auto& system : loop.motion.systems) system.hasPattern = false;
    });
  };
  // in the first step the host looks at all that may start in each other
  Collision<RootScope>{root}.detect(dt, !first, newPattern, [&](auto const& where, std::string_view why) {
    notes().warn(where, "contacts of bodies on a device are found on the host", [&] {
      return text("contacts of bodies on a device are found on the host, from copies: ", why);
    });
  });
  warnOfOverlaps();
}

}  // namespace sinew
