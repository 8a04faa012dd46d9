// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/scene/checks.hpp>
#include <sinew/scene/mechanical_operations.hpp>

namespace sinew {

/// A typed scene that runs: init(), then animate(dt) as often as wanted. After init a step neither allocates
/// nor makes an indirect call. Copies of a simulation are independent of each other.
template <class Root>
class Simulation {
 public:
  /// The scene fulfils scene/checks.hpp. Where it does not, an assertion has said why, and the rest stays
  /// away.
  static constexpr bool proved = checks::scene<Scope<Root, NoScope>>();

  explicit Simulation(Root root) : root_(std::move(root)) {}

  /// Checks all fields, sizes all states, initialises all components. Throws Error, naming node, component
  /// and field; the simulation then stays uninitialised.
  void init() {
    if constexpr (proved) {
      initialised_ = false;
      const auto scope = rootScope();
      traverse(scope, [](auto& c, auto const& s) { check_fields(c, s.path()); });
      initStates(scope);
      traverse(scope, [](auto& c, auto const& s) { initComponent(c, s); });
      initSolvers(scope);
      time_ = 0;
      step_ = 0;
      propagate();
      initialised_ = true;
    }
  }

  /// Advances the scene by dt seconds. Throws Error where dt is not a positive number, and where a state is
  /// no longer finite after the step.
  void animate(double dt) {
    if (!initialised_) throw Error("Simulation::animate", "the scene is not initialised; call init() first");
    if (!(dt > 0) || !std::isfinite(dt))
      throw Error("Simulation::animate",
                  text("dt is ", dt, " s, but must be a finite number greater than 0"));
    if constexpr (proved) {
      const auto scope = rootScope();
      integrate(scope, dt);
      time_ += dt;
      ++step_;
      visualsAreCurrent_ = false;
      traverse(scope, [&](auto& c, auto const& s) { endStep(c, s, dt); });
    }
  }

  /// Back to positions and velocities as they were after init, at time 0.
  void reset() {
    if (!initialised_) throw Error("Simulation::reset", "the scene is not initialised; call init() first");
    MechanicalOperations<decltype(rootScope())>(rootScope()).forEachState([](auto& s) { s.reset(); });
    time_ = 0;
    step_ = 0;
    propagate();
  }

  double time() const { return time_; }
  long step() const { return step_; }
  double kineticEnergy() {
    return over([](auto& o) { return o.kineticEnergy(); });
  }
  /// Energy of the force fields at the current positions, gravity left out [J].
  double potentialEnergy() {
    return over([](auto& o) { return o.potentialEnergy(); });
  }

  /// The node at a path from the root, resolved by the compiler: sim.at<"liver/skin">(). A visual model in it
  /// is brought up to date; animate() leaves them behind, since they are looked at less often than the scene
  /// is stepped.
  template <FixedString Path>
  auto& at() {
    using Found = checks::AtPath<Scope<Root, NoScope>, Path>;
    constexpr bool found = !std::is_same_v<Found, NoScope>;
    static_assert(found,
                  "Sinew: no node has this path. Paths are names joined by '/', from the children of the "
                  "root on; look for a "
                  "misspelt name.");
    if constexpr (!found) {
      return root_;
    } else {
      if constexpr (Found::isVisual && proved) updateVisual();
      return rootScope().template descend<Path>([](auto const& s) -> auto& { return s.node; });
    }
  }
  Root& root() { return root_; }

  /// Visual models follow their mappings.
  void updateVisual() {
    if (visualsAreCurrent_) return;
    traverse(rootScope(), [](auto& c, auto const& scope) {
      using C = std::decay_t<decltype(c)>;
      if constexpr (HasRole<C, role::Mapping> && std::decay_t<decltype(scope)>::isVisual)
        c.apply(scope.node.visual().position, scope.template parentState<typename C::In>().position);
    });
    visualsAreCurrent_ = true;
  }

 private:
  Root root_;
  double time_ = 0;
  long step_ = 0;
  bool initialised_ = false, visualsAreCurrent_ = false;
  static constexpr NoScope above_{};

  Scope<Root, NoScope> rootScope() { return {root_, above_}; }

  template <class F>
  auto over(F&& f) {
    const auto scope = rootScope();
    MechanicalOperations<std::decay_t<decltype(scope)>> operations(scope, time_);
    return f(operations);
  }

  void propagate() {
    over([](auto& o) { return o.propagate(vec_id::position, vec_id::velocity), 0; });
    visualsAreCurrent_ = false;
  }

  // parents before children, since a mapping sizes and places the state of its node
  template <class S>
  static void initStates(S const& scope) {
    if constexpr (S::isMapped) {
      auto& mapping = scope.node.template first<role::Mapping>();
      using M = std::decay_t<decltype(mapping)>;
      auto const& parent = scope.above.stateScope();
      auto& parentState = parent.node.state();
      auto place = [&](auto& child, auto& rest) {
        mapping.init(parent.template context<typename M::In>(),
                     {scope.path(), rest, scope.topology()},
                     child.position);
      };
      if constexpr (S::isVisual) {
        auto& visual = scope.node.visual();
        visual.init(scope.path());
        place(visual, visual.position);
        mapping.apply(visual.position, parentState.position);
      } else {
        auto& child = scope.node.state();
        place(child, child.position);
        child.restPosition.assign(child.position.size(), M::Out::zero());
        mapping.apply(child.restPosition, parentState.restPosition);
        mapping.apply(child.position, parentState.position);
        child.init(scope.path());
      }
    } else if constexpr (S::ownsState) {
      scope.node.state().init(scope.path());
    } else if constexpr (S::isVisual) {
      scope.node.visual().init(scope.path());
    }
    scope.forEachChild([](auto const& child) { initStates(child); });
  }

  template <class C, class S>
  static void initComponent(C& c, S const& scope) {
    if constexpr (HasRole<C, role::Topology>) {
      if constexpr (S::hasState) c.init(scope.template context<checks::DataTypesAt<S>>());
    } else if constexpr (HasRole<C, role::ForceField> || HasRole<C, role::Mass> ||
                         HasRole<C, role::ProjectiveConstraint>) {
      c.init(scope.template context<typename C::DataTypes>());
    } else if constexpr (HasRole<C, role::InteractionForceField>) {
      using D = typename C::DataTypes;
      scope.withEnds(
          c, [&](auto const& a, auto const& b) { c.init(a.template context<D>(), b.template context<D>()); });
    }
  }

  template <class S>
  static void initSolvers(S const& scope) {
    if constexpr (S::NodeType::template count < role::OdeSolver >> 0) {
      MechanicalOperations<S> operations(scope);
      using Ode = std::decay_t<decltype(scope.node.template first<role::OdeSolver>())>;
      if constexpr (Ode::implicit)
        scope.withLinearSolver([&](auto& linear) {
          operations.reserve(Ode::auxiliary + std::decay_t<decltype(linear)>::auxiliary);
          linear.init(operations);
        });
      else
        operations.reserve(Ode::auxiliary);
    }
    scope.forEachChild([](auto const& child) { initSolvers(child); });
  }

  // each ODE solver integrates its subtree and propagates; where there is none, the children are looked at
  template <class S>
  void integrate(S const& scope, double dt) {
    if constexpr (S::NodeType::template count < role::OdeSolver >> 0) {
      MechanicalOperations<S> operations(scope, time_, dt);
      scope.node.template first<role::OdeSolver>().solve(operations, dt);
      operations.propagate(vec_id::position, vec_id::velocity);
    } else {
      scope.forEachChild([&](auto const& child) { integrate(child, dt); });
    }
  }

  template <class C, class S>
  void endStep(C& c, S const& scope, double dt) const {
    if constexpr (HasRole<C, role::State>) checkFinite(c, scope);
    if constexpr (HasRole<C, role::StepCallback>) {
      const StepInfo info{step_, time_, dt};
      if constexpr (std::is_invocable_v<decltype(c.call)&, StepInfo const&, decltype(scope.node)>)
        c.call(info, scope.node);
      else
        c.call(info);
    }
  }

  template <class C, class S>
  void checkFinite(C const& state, S const& scope) const {
    using D = typename C::DataTypes;
    if constexpr (S::isMapped) return;
    const int x = vec::find_not_finite<D>(state.position);
    if (x < 0) return;
    throw Error(text("step ", step_, " (time ", time_, " s), ", scope.path()),
                text(component_name<C>(),
                     ": the position of point ",
                     x,
                     " is not a finite number: the simulation diverged; take a smaller dt, an implicit "
                     "solver, more damping "
                     "or a softer material"));
  }
};

}  // namespace sinew
