// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/scene/carving.hpp>
#include <sinew/scene/changing_points.hpp>
#include <sinew/scene/collision.hpp>
#include <sinew/scene/cutting.hpp>
#include <sinew/scene/fluid_boundaries.hpp>
#include <sinew/scene/immersed_bodies.hpp>
#include <sinew/scene/loose_interactions.hpp>
#include <sinew/scene/mechanical_operations.hpp>
#include <sinew/scene/solvers.hpp>
#include <sinew/scene/states_of.hpp>
#include <sinew/scene/topological_changes.hpp>

#include <algorithm>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace sinew {

/// The init of a scene, or that of what has changed in one. Fields are checked, states sized from the root
/// on, then components initialised, and solvers last. Throws Error, naming node, component and field.
template <class RootScope>
class Initialisation {
 public:
  explicit Initialisation(RootScope const& root, InitAgain again = {})
      : root_(root), again_(std::move(again)) {}

  void run();
  /// The solvers alone: of a scene whose elements have come back.
  void initSolvers();

 private:
  RootScope const& root_;
  const InitAgain again_;
  std::vector<void const*> served_{};  // linear solvers that have a matrix
  bool constrained_ = false;           // the scene solves constraints by multipliers

  void checkFields();
  // steps in parts
  void checkDivision();
  // topologies are made first; then states, parents before children
  void initStates();
  template <class S>
  void initStatesBelow(S const& scope);
  // what acts on them
  void initComponents();

  template <class C, class S>
  static void initState(C& c, S const& scope) {
    if constexpr (HasRole<C, role::Mapping>) {
      initMappedState(c, scope);
    } else if (!scope.mapped()) {
      if constexpr (HasRole<C, role::State>) c.place(scope.path(), scope.topology().positions);
      c.init(scope.path());
    }
  }
  // a mapping sizes and places the state of its node, and its rest positions where it is given none
  template <class C, class S>
  static void initMappedState(C& c, S const& scope) {
    bool mapsRest = true;
    scope.withChild(c, [&](auto& child) {
      if constexpr (HasRole<std::decay_t<decltype(child)>, role::VisualModel>) {
        child.init(scope.path());
        initMapping(c, scope, child.position, child.position, child.mesh.triangles);
      } else {
        if constexpr (MakesFaces<C>)
          throw Error(
              text(scope.path(), ": ", component_name<C>()),
              "it makes a surface to look at, which no state can follow; put a visual model in the place "
              "of the state of its node");
        child.place(scope.path(), scope.topology().positions);
        child.takeGiven();
        mapsRest = child.restPosition.empty();
        initMapping(c,
                    scope,
                    mapsRest ? child.position : child.restPosition,
                    child.position,
                    scope.topology().triangles);
        if (mapsRest) child.restPosition.assign(child.position.size(), C::Out::zero());
      }
    });
    if (mapsRest)
      scope.withMapped(c, [&](auto& mapping, auto& child, auto& parent) {
        if constexpr (HasRole<std::decay_t<decltype(child)>, role::State>)
          mapping.apply(child.restPosition, parent.restPosition);
      });
    scope.withMapped(c, [&](auto& mapping, auto& child, auto& parent) {
      if constexpr (HasRole<std::decay_t<decltype(child)>, role::State>) {
        mapping.apply(child.position, parent.position);
      } else {
        follow_mapping(mapping, child, parent);
      }
    });
    scope.withChild(c, [&](auto& child) {
      if constexpr (HasRole<std::decay_t<decltype(child)>, role::State>) child.init(scope.path());
    });
  }
  template <class C, class S, class VecCoord>
  static void initMapping(C& c, S const& scope, VecCoord const& rest, VecCoord& positions,
                          std::span<Triangle const> faces) {
    using In = typename C::In;
    InitContext<typename C::Out> own{scope.path(), rest, scope.topology()};
    own.faces = faces;
    if constexpr (HasTwoKindsOfParents<C>) {
      std::optional<InitContext<In>> first;
      scope.forEachParent(c, [&](auto k, auto const& parent) {
        if constexpr (k == 0)
          first.emplace(parent.template context<In>());
        else
          c.init(*first, parent.template context<typename C::In2>(), own, positions);
      });
    } else if constexpr (HasParents<C>) {
      std::vector<InitContext<In>> parents;
      scope.forEachParent(
          c, [&](std::size_t, auto const& parent) { parents.push_back(parent.template context<In>()); });
      c.init(parents, own, positions);
    } else {
      c.init(Given<C, In>(scope.parentScope()).context, own, positions);
    }
  }

  template <class C, class S>
  void initComponent(C& c, S const& scope) {
    if constexpr (HasRole<C, role::Execution>) {
      c.init();
    } else if constexpr (HasRole<C, role::BehaviorModel>) {
      c.init(scope.path());
    } else if constexpr (ActsOnState<C>) {
      if constexpr (CorrectsState<C>)
        if (scope.stateScope().mapped())
          throw Error(text(scope.path(), ": ", component_name<C>()),
                      "the state follows another by a mapping, so that it is that one which answers to "
                      "multipliers; put the correction into its node");
      with_scopes_of(
          c, scope, [&](auto const&... at) { c.init(Given<C, typename C::DataTypes>(at).context...); });
    }
    if constexpr (requires { c.warning(); }) warn(c, scope);
  }
  // Warnings: the simulation goes on, but perhaps not as it was meant. In a typed scene it is not reported,
  // and where elements have gone it is no mistake.
  template <class C, class S>
  void warn(C const& c, S const& scope) const {
    const std::string warning(c.warning());
    if (warning.empty()) return;
    if constexpr (requires { scope.warn(&c, std::string_view()); })
      scope.warn(&c, warning);
    else if (!again_)
      throw Error(text(scope.path(), ": ", component_name<C>()), warning);
  }

  // what a component of class C is given at init of the state of a scope
  template <class C, class D>
  struct Given {
    InitContext<D> context;
    std::vector<double> masses{};
    std::vector<Eigen::Vector3d> places{};

    template <class S>
    explicit Given(S const& scope) : context(scope.template context<D>()) {
      if constexpr (needs_masses<C>) context.masses = masses = massesOf(scope, context);
      if constexpr (over_body<C>)
        if (const BodyView body = scope.body(); body.state) {
          body.placesOf(body.state, places);
          context.topology = body.topology;
          context.body = places;
        }
    }
  };
  // of the points of a state: the sums of the rows of M; empty where there is no mass
  template <class S, class D>
  static std::vector<double> massesOf(S const& scope, InitContext<D> const& context) {
    std::vector<double> masses;
    scope.stateScope().withMass([&](auto& mass) {
      if constexpr (std::is_same_v<typename std::decay_t<decltype(mass)>::DataTypes, D>) {
        mass.init(Given<std::decay_t<decltype(mass)>, D>(scope).context);
        typename D::VecDeriv along(context.rest.size(), D::Deriv::Unit(0)),
            sums(along.size(), D::Deriv::Zero());
        mass.addMDx(sums, context.rest, along, 1.0);
        for (auto const& sum : sums) masses.push_back(double(sum[0]));
      }
    });
    return masses;
  }

  template <class Ode, class S>
  void initSolver(Ode& ode, S const& scope) {
    MechanicalOperations<S> operations(scope);
    const Auxiliary beside = constrained_ ? MultiplierResponse::auxiliary : Auxiliary{};
    operations.reserve(Ode::auxiliary + beside);
    if (constrained_) operations.numberDofs(1);
    operations.template withLinearSolverOf<Ode>([&](auto& linear) {
      using Linear = std::decay_t<decltype(linear)>;
      if constexpr (needs_pattern<Linear>) serveOne<Ode>(linear, scope);
      operations.reserve(Ode::auxiliary + Linear::auxiliary + beside);
      linear.init(operations);
    });
    if constexpr (requires { ode.init(operations); }) ode.init(operations);
    operations.split();
    // what a solver remembers of the last step is not that of a scene that has changed
    if constexpr (requires { ode.lastEnd; })
      if (again_) ode.lastEnd = -1;
  }
  // what a scene needs that solves constraints by multipliers
  template <class Ode, class S, class Motion>
  static void initConstrained([[maybe_unused]] Ode& ode, S const& scope, Motion& motion) {
    if constexpr (!takes_multipliers<Ode>) {
      throw Error(
          text(scope.path(), ": ", component_name<Ode>()),
          "this solver does not say what multipliers do in its step, and the scene solves constraints by "
          "them; take EulerImplicitSolver, NewmarkImplicitSolver, BDFOdeSolver, StaticSolver, "
          "VariationalSymplecticSolver or an explicit one, or leave out the FreeMotionAnimationLoop");
    } else {
      if constexpr (requires { ode.changesFactors(); })
        if (ode.changesFactors()) refuseKeptCompliance(scope, component_name<Ode>());
      MechanicalOperations<S> operations(scope);
      const int number = int(motion.systems.size());
      int dofs = 0;
      operations.forEachState([&](auto& s) { s.solver = number; });
      operations.forEachMapped([](auto& s) {
        if constexpr (requires { s.multiplierForce; }) s.multiplierForce.reserve(s.size());
      });
      operations.forEachIndependent([&](auto& s) {
        using D = typename std::decay_t<decltype(s)>::DataTypes;
        dofs = std::max(dofs, s.dofOffset + int(s.size()) * D::size);
      });
      auto& system = motion.systems.emplace_back();
      system.force.setZero(dofs + 1);
      system.motion.setZero(dofs + 1);
    }
  }
  // a correction that makes its compliance once
  template <class S>
  static void refuseKeptCompliance(S const& scope, std::string_view solver) {
    traverse(scope, on<role::ConstraintCorrection>([&](auto& c, auto const& at) {
               using C = std::decay_t<decltype(c)>;
               if constexpr (KeepsCompliance<C>)
                 throw Error(text(at.path(), ": ", at.node.labelOf(c)),
                             text("the compliance is made once, and that of ",
                                  solver,
                                  " is another one in the first steps than behind them; give it order=1, or "
                                  "leave out the correction"));
             }));
  }
  template <class Ode, class Linear, class S>
  void serveOne(Linear const& linear, S const& scope) {
    if (std::find(served_.begin(), served_.end(), &linear) != served_.end())
      throw Error(text(scope.path(), ": ", component_name<Ode>()),
                  text("the ",
                       component_name<Linear>(),
                       " above is that of another ODE solver already, and has one matrix; give each an "
                       "assembled linear solver of its own, or both a CGLinearSolver without matrix"));
    served_.push_back(&linear);
  }
};

// Outside the class, so that a program may have them instantiated in one place: runtime/precompiled.hpp.

template <class RootScope>
void Initialisation<RootScope>::run() {
  root_.check();
  root_.raise();
  checkFields();
  ChangingPoints<RootScope>{root_}.begin();
  if constexpr (holds<typename RootScope::NodeType, role::TopologicalChange>())
    if (again_.touched.empty()) TopologicalChanges<RootScope>{root_}.begin();
  initStates();
  initComponents();
  ChangingPoints<RootScope>{root_}.init();
  Collision<RootScope>{root_}.init(bool(again_));
  if constexpr (holds<typename RootScope::NodeType, role::Carving>())
    if (again_.touched.empty()) Carving<RootScope>{root_}.check();
  if constexpr (holds<typename RootScope::NodeType, role::Cutting>())
    if (again_.touched.empty()) Cutting<RootScope>{root_}.check();
  if constexpr (holds<typename RootScope::NodeType, role::TopologicalChange>())
    if (again_.touched.empty()) TopologicalChanges<RootScope>{root_}.prepare();
  FluidBoundaries<RootScope>{root_}.init();
  ImmersedBodies<RootScope>{root_}.init();
  initSolvers();
  checkDivision();
  root_.raise();
  if constexpr (collides<RootScope>) Collision<RootScope>{root_}.findCarriers();
  LooseInteractions<RootScope>{root_}.init();
  root_.settled();
}

template <class RootScope>
void Initialisation<RootScope>::checkDivision() {
  bool impacts = false;
  traverse(root_, on<role::Intersection>([&](auto const& intersection, auto const&) {
             impacts = impacts || motion_seen_by(intersection) != StepMotion::none;
           }));
  with_first<role::StepDivision>(root_, [&](auto const& division) {
    if (division.integrationSteps > 1 && (constrained_ || impacts))
      throw Error(text(root_.path(), ": ", component_name<std::decay_t<decltype(division)>>()),
                  text("integrationSteps is ",
                       division.integrationSteps,
                       constrained_ ? ", but constraints by multipliers" : ", but contacts by impacts",
                       " are those of one integration; leave it at 1, and raise collisionSteps"));
  });
}

template <class RootScope>
void Initialisation<RootScope>::checkFields() {
  if constexpr (requires { root_.checkFields(again_); })
    root_.checkFields(again_);
  else
    traverse(root_, on<AnyRole>([this](auto& c, auto const& s) {
               s.ifNew(c, again_, [&] { check_fields(c, s.path()); });
             }));
  root_.raise();
}

template <class RootScope>
void Initialisation<RootScope>::initStates() {
  traverse(root_, on<role::Topology>([this](auto& c, auto const& s) {
             if constexpr (requires { c.generate(s.path()); })
               s.ifNew(c, again_, [&] { c.generate(s.path()); });
           }));
  initStatesBelow(root_);
}

// What reads a topology is initialised after the check of that topology: mappings of children, and what acts
// on the states.
template <class RootScope>
template <class S>
void Initialisation<RootScope>::initStatesBelow(S const& scope) {
  auto states = on<role::Mapping, role::State, role::VisualModel>([&](auto& c) {
    scope.ifNew(c, again_, [&] { initState(c, scope); });
    scope.raise();  // what follows a wrong state has nothing to stand on
  });
  scope.forEachComponent(states);
  // beside a visual model alone it is of faces over the points of that, as a tube has them
  bool state = false, visual = false;
  scope.forEachComponent(on<role::State>([&](auto&) { state = true; }));
  scope.forEachComponent(on<role::VisualModel>([&](auto&) { visual = true; }));
  auto topologies = on<role::Topology>([&](auto& c) {
    if (!state && visual) return;
    scope.ifNew(c, again_, [&] { scope.withContext([&](auto const& context) { c.init(context); }); });
  });
  scope.forEachComponent(topologies);
  scope.raise();
  scope.template forEachChild<role::Topology, role::Mapping, role::State, role::VisualModel>(
      [&](auto const& child) { initStatesBelow(child); });
}

template <class RootScope>
void Initialisation<RootScope>::initComponents() {
  traverse(root_,
           on<AnyRole>([this](auto& c, auto const& s) { s.ifNew(c, again_, [&] { initComponent(c, s); }); }));
  root_.raise();
}

template <class RootScope>
void Initialisation<RootScope>::initSolvers() {
  served_.clear();
  constrained_ = with_first<role::AnimationLoop>(root_, [](auto&) {});
  for_each_solver(root_,
                  [&](auto& ode, auto const& scope) { scope.located(ode, [&] { initSolver(ode, scope); }); });
  with_first<role::AnimationLoop>(root_, [&](auto& loop) {
    loop.motion.systems.clear();
    for_each_integrator(root_, [&](auto& ode, auto const& scope) {
      scope.located(ode, [&] { initConstrained(ode, scope, loop.motion); });
    });
  });
}

}  // namespace sinew
