// SPDX-License-Identifier: BSL-1.0
#pragma once

// first, since their sentences come behind "In file included from"
#include <sinew/scene/node.hpp>

#include <sinew/scene/mistakes.hpp>

#include <sinew/scene/carving.hpp>
#include <sinew/scene/collision.hpp>
#include <sinew/scene/element_removal.hpp>
#include <sinew/scene/force_report.hpp>
#include <sinew/scene/mechanical_operations.hpp>
#include <sinew/scene/picking.hpp>

#include <algorithm>
#include <vector>

namespace sinew {

/// A typed scene that runs: init(), then animate(dt) as often as wanted. After init a step neither allocates
/// nor makes an indirect call. Copies of a simulation are independent of each other. A runtime tree runs in
/// the same way (runtime/node.hpp).
template <class Root>
class Simulation {
 public:
  using RootScope = typename ScopeOf<Root, NoScope>::type;
  /// The scene fulfils scene/checks.hpp. Where it does not, the constructor says why, and the rest stays
  /// away.
  using Verdict = checks::Verdict<typename ScopeOf<typename RootScope::NodeType, NoScope>::type>;
  static constexpr bool proved = std::is_same_v<Verdict, checks::Right>;

  explicit Simulation(Root root, Verdict = {}) : root_(std::move(root)) {}

  /// Checks all fields, sizes all states, initialises all components. Throws Error, naming node, component
  /// and field; the simulation then stays uninitialised. Another time and step than 0 are those of a
  /// checkpoint.
  void init(double time = 0, long step = 0);

  /// Advances the scene by dt seconds. Throws Error where dt is not a positive number, and where a state is
  /// no longer finite after the step.
  void animate(double dt);

  /// Back to the scene as it was after init, at time 0, so that the next steps have the bits of the first
  /// ones: positions and velocities (those that states were given for a reset), springs that were cut, what
  /// materials and solvers remember. Contacts are forgotten, what was attached is released. What was changed
  /// from outside stays: by change() and removeElements(), and so what tools have carved; fields, and targets
  /// of couplings.
  void reset();

  /// What records completes its files. Throws Error where one could not be written. Without that, the end of
  /// the simulation completes them, as well as it can.
  void finish();

  double time() const { return time_; }
  long step() const { return step_; }
  /// Goes on counting from another time and step: those of a checkpoint.
  void continueFrom(double time, long step) {
    time_ = time;
    step_ = step;
  }
  double kineticEnergy();
  /// Energy of the force fields at the current positions, gravity left out [J].
  double potentialEnergy();

  /// The node at a path from the root, resolved by the compiler: sim.at<"liver/skin">(). A visual model in it
  /// is brought up to date; animate() leaves them behind, since they are looked at less often than the scene
  /// is stepped.
  template <FixedString Path>
  auto& at() {
    using Found = checks::AtPath<RootScope, Path>;
    constexpr bool found = !std::is_same_v<Found, NoScope>;
    static_assert(found,
                  "Sinew: no node has this path. Paths are names joined by '/', from the children of the "
                  "root on; look for a "
                  "misspelt name.");
    if constexpr (!found) {
      return root_;
    } else {
      if constexpr (Found::isVisual && proved) updateVisual();
      return detail::node_at<Path>(root_);
    }
  }
  Root& root() { return root_; }

  /// Visual models follow their mappings.
  void updateVisual();

  /// Changes the scene in the middle of the simulation: edit(root) is given a copy, in which runtime nodes
  /// come, go and move. What is new is initialised, and the copy takes the place of the scene; where edit or
  /// the new scene is wrong, Error is thrown and nothing has changed.
  template <class F>
  void change(F&& edit) {
    if (!initialised_) throw Error("Simulation::change", "the scene is not initialised; call init() first");
    Root next(root_);
    scopeOf(next).settled();
    edit(next);
    initScene(scopeOf(next), {.again = true});
    root_ = std::move(next);
    propagate();
  }

  /// Removes elements of the topology of the node at a path from the root ("liver"), and with them faces and
  /// edges that are left without an element, and points (plan_element_removal). All that refers to them
  /// follows: states lose the points, components the entries of their lists, mapped states what was mapped
  /// from there; the surface that collides, and one that is looked at or listed whole beside the volume,
  /// becomes that of what is left; contacts and attachments of what stays go on; what stays keeps its order,
  /// and everything around it is initialised again from the rest positions. Returns what became of points and
  /// elements. Throws Error where there is no such topology or element, and where what is left is no scene:
  /// nothing has changed then.
  TopologyChange removeElements(std::string_view path, ElementNumbers const& elements);

  /// What the ray from `origin` along `direction` meets first of the collision models, where they are now, up
  /// to maxDistance [m]: triangles and spheres, from outside or inside, and lines and points that it passes
  /// within `tolerance` of. Throws Error where the ray is not one.
  std::optional<Pick> pick(Eigen::Vector3d const& origin, Eigen::Vector3d const& direction,
                           double maxDistance = std::numeric_limits<double>::infinity(),
                           double tolerance = 0) {
    initialisedFor("pick");
    return picking([&](auto const& p) { return p.pick(origin, direction, maxDistance, tolerance); });
  }
  /// Holds a picked place by a spring whose other end, at first where the place is, pull() moves. It acts as
  /// a contact does, through mappings and implicitly under an implicit solver. change() releases it. Returns
  /// the number by which it is pulled and released; throws Error where the settings are wrong, where the
  /// place is gone, and where no solver moves the model.
  int attach(Pick const& place, AttachSettings const& settings = {}) {
    initialisedFor("attach");
    return picking([&](auto const& p) { return p.attach(place, settings); });
  }
  /// Moves the other end of an attachment, which has this velocity there (its damping asks for it). False,
  /// and nothing is done, where there is no such attachment: it was released, or what it held was removed.
  bool pull(int attachment, Eigen::Vector3d const& target,
            Eigen::Vector3d const& velocity = Eigen::Vector3d::Zero()) {
    return picking([&](auto const& p) { return p.pull(attachment, target, velocity); });
  }
  /// Lets go. False where there was no such attachment.
  bool release(int attachment) {
    return picking([&](auto const& p) { return p.release(attachment); });
  }
  /// An attachment as it is, with its force on the body over the last step; null where there is none.
  Attachment const* attachment(int id) {
    return picking([&](auto const& p) { return p.find(id); });
  }

  /// From the next step on, states keep which forces acted over the last one, as impulse over dt [N]:
  /// `applied`, without those of constraints, and `reaction`, what constraints did to each point, zero where
  /// a point is free (MechanicalObject; reaction_force() and net_force() sum them up). M (v1 - v0) / dt =
  /// applied + reaction then holds to the tolerance of the solver; under Newmark's method and BDF they are
  /// the forces at the end of the step, with which their own accelerations are in balance; without inertia
  /// (StaticSolver, firstOrder) without it. It takes some products of the system matrix with a vector a step.
  /// Contacts and attachments keep theirs in any case.
  void keepForces(bool keep) { keepsForces_ = keep; }
  /// The forces over the last step of contacts and attachments, and where they are kept those of constraints
  /// and the whole ones on rigid bodies, with the places where they acted.
  std::vector<ForceOnBody> forces() {
    initialisedFor("forces");
    const auto scope = rootScope();
    return ForceReport<RootScope>{scope}.list();
  }

 private:
  Root root_;
  double time_ = 0;
  long step_ = 0;
  bool initialised_ = false, visualsAreCurrent_ = false, keepsForces_ = false;
  static constexpr NoScope above_{};
  static constexpr bool collides = detail::primitive_kinds<RootScope>() != 0,
                        carves = holds<Root, role::Carving>();

  static RootScope scopeOf(Root& root) {
    if constexpr (RootScope::profiled && requires { root.aboveRoot; })
      return {root, root.aboveRoot};
    else
      return {root, above_};
  }
  RootScope rootScope() { return scopeOf(root_); }

  void initialisedFor(std::string_view what) const {
    if (!initialised_)
      throw Error(text("Simulation::", what), "the scene is not initialised; call init() first");
  }
  template <class F>
  auto picking(F&& f) {
    const auto scope = rootScope();
    return f(Picking<RootScope>{scope});
  }
  template <class F>
  auto over(F&& f) {
    const auto scope = rootScope();
    MechanicalOperations<RootScope> operations(scope, time_);
    return f(operations);
  }

  void propagate();

  static void initScene(RootScope const& scope, InitAgain const& again);
  static void checkFields(RootScope const& scope, InitAgain const& again);
  // topologies are made first; then states, parents before children
  static void initStates(RootScope const& scope, InitAgain const& again);
  template <class S>
  static void initStatesBelow(S const& scope, InitAgain const& again);
  // what acts on them
  static void initComponents(RootScope const& scope, InitAgain const& again);

  // a mapping sizes and places the state of its node
  template <class C, class S>
  static void initState(C& c, S const& scope) {
    if constexpr (HasRole<C, role::Mapping>) {
      scope.withChild(c, [&](auto& child) {
        if constexpr (HasRole<std::decay_t<decltype(child)>, role::VisualModel>) {
          child.init(scope.path());
          initMapping(c, scope, child.position, child.position);
        } else {
          child.place(scope.path(), scope.topology().positions);
          child.takeGiven();
          initMapping(c, scope, child.position, child.position);
          child.restPosition.assign(child.position.size(), C::Out::zero());
        }
      });
      scope.withMapped(c, [&](auto& mapping, auto& child, auto& parent) {
        if constexpr (HasRole<std::decay_t<decltype(child)>, role::State>)
          mapping.apply(child.restPosition, parent.restPosition);
        mapping.apply(child.position, parent.position);
      });
      scope.withChild(c, [&](auto& child) {
        if constexpr (HasRole<std::decay_t<decltype(child)>, role::State>) child.init(scope.path());
      });
    } else if (!scope.mapped()) {
      if constexpr (HasRole<C, role::State>) c.place(scope.path(), scope.topology().positions);
      c.init(scope.path());
    }
  }

  // f(what a component of class C is given at init of the state of a scope); the masses of its points are the
  // sums of the rows of M
  template <class C, class D, class S, class F>
  static void withContext(S const& scope, F&& f) {
    auto context = scope.template context<D>();
    std::vector<double> masses;
    if constexpr (needs_masses<C>)
      scope.stateScope().withMass([&](auto& mass) {
        if constexpr (std::is_same_v<typename std::decay_t<decltype(mass)>::DataTypes, D>) {
          mass.init(context);
          typename D::VecDeriv along(context.rest.size(), D::Deriv::Unit(0)),
              sums(along.size(), D::Deriv::Zero());
          mass.addMDx(sums, context.rest, along, 1.0);
          for (auto const& sum : sums) masses.push_back(double(sum[0]));
        }
      });
    context.masses = masses;
    f(context);
  }

  // a mapping sizes its child
  template <class C, class S, class VecCoord>
  static void initMapping(C& c, S const& scope, VecCoord const& rest, VecCoord& positions) {
    using In = typename C::In;
    const InitContext<typename C::Out> own{scope.path(), rest, scope.topology()};
    if constexpr (HasParents<C>) {
      std::vector<InitContext<In>> parents;
      scope.forEachParent(
          c, [&](std::size_t, auto const& parent) { parents.push_back(parent.template context<In>()); });
      c.init(parents, own, positions);
    } else {
      withContext<C, In>(scope.parentScope(), [&](auto const& parent) { c.init(parent, own, positions); });
    }
  }

  template <class C, class S>
  static void initComponent(C& c, S const& scope, [[maybe_unused]] InitAgain const& again) {
    if constexpr (HasRole<C, role::Execution>) {
      c.init();
    } else if constexpr (HasRole<C, role::CollisionModel>) {
      c.init(scope.template context<typename C::DataTypes>());
    } else if constexpr (JoinsTwo<C>) {
      using D = typename C::DataTypes;
      scope.withEnds(c, [&](auto const& a, auto const& b) {
        withContext<C, D>(a, [&](auto const& first) {
          withContext<C, D>(b, [&](auto const& second) { c.init(first, second); });
        });
      });
    } else if constexpr (HasRole<C, role::ForceField> || HasRole<C, role::Mass> ||
                         HasRole<C, role::ProjectiveConstraint> || WatchesState<C>) {
      withContext<C, typename C::DataTypes>(scope, [&](auto const& context) { c.init(context); });
    }
    // What goes on, but not as it may have been meant. In a typed scene nobody hears of it, and where
    // elements have gone it is no mistake.
    if constexpr (requires { c.warning(); })
      if (const std::string said(c.warning()); !said.empty()) {
        if constexpr (requires { scope.warn(&c, std::string_view()); })
          scope.warn(&c, said);
        else if (!again)
          throw Error(text(scope.path(), ": ", component_name<C>()), said);
      }
  }

  template <class S>
  static void initSolvers(S const& scope, InitAgain const& again, std::vector<void const*>& served);
  template <class Ode, class Operations, class F>
  static void withLinearSolverOf(Operations& operations, F&& f);

  // f(interaction, a, b) with the states of the ends of each interaction that no solver sees
  template <class S, class F>
  static void forEachLoose(S const& scope, F&& f) {
    if constexpr (!S::template always<role::OdeSolver>) {
      if (scope.template has<role::OdeSolver>()) return;
      auto visit = on<role::InteractionForceField>([&](auto& c) {
        using D = typename std::decay_t<decltype(c)>::DataTypes;
        scope.withEnds(
            c, [&](auto const& a, auto const& b) { f(c, a.template state<D>(), b.template state<D>()); });
      });
      scope.forEachComponent(visit);
      scope.template forEachChild<role::InteractionForceField>(
          [&](auto const& child) { forEachLoose(child, f); });
    }
  }
  // An interaction above the solvers of its ends is for each of them a force that stays as it is at the start
  // of the step (as in SOFA): explicit, and stable only at steps small enough for it.
  static void initLoose(RootScope const& scope) {
    traverse(scope, on<role::State>([](auto& s, auto const&) { s.externalForce.clear(); }));
    forEachLoose(scope, [](auto&, auto& a, auto& b) {
      using VecDeriv = std::decay_t<decltype(a.velocity)>;
      for (auto* end : {&a, &b}) end->externalForce = VecDeriv(end->size(), VecDeriv::value_type::Zero());
    });
    // contacts may come to be between any two
    int solvers = 0;
    traverse(scope, on<role::CollisionModel>([&](auto& model, auto const&) {
               solvers = std::max(solvers, model.surface.solver + 1);
             }));
    if (solvers > 1)
      traverse(scope, on<role::CollisionModel>([](auto& model, auto const& s) {
                 using D = typename std::decay_t<decltype(model)>::DataTypes;
                 auto& state = s.template state<D>();
                 if (model.surface.solver >= 0) state.externalForce.assign(state.size(), D::Deriv::Zero());
               }));
  }
  void computeLoose(RootScope const& scope, double dt) const {
    [[maybe_unused]] const auto span = scope.span(Phase::externalForces);
    traverse(scope, on<role::State>([](auto& s, auto const&) {
               VectorOperations<typename std::decay_t<decltype(s)>::DataTypes>::clear(OneThread{},
                                                                                      s.externalForce);
             }));
    const MechanicalParams p{.time = time_, .dt = dt};
    forEachLoose(scope, [&](auto& c, auto& a, auto& b) {
      add_force(c, p, a.externalForce, b.externalForce, a.position, b.position, a.velocity, b.velocity);
    });
    if constexpr (collides) addLooseContacts(scope);
  }
  // contacts between two solvers are such interactions
  static void addLooseContacts(RootScope const& scope) {
    auto withModels = [&](auto&& f) {
      traverse(scope, on<role::CollisionModel>([&](auto& model, auto const& s) {
                 using D = typename std::decay_t<decltype(model)>::DataTypes;
                 auto& state = s.template state<D>();
                 if (!state.externalForce.empty()) f(model, state, std::type_identity<D>{});
               }));
    };
    traverse(scope, on<role::ContactManager>([&](auto& manager, auto const&) {
               withModels([]<class D>(auto& model, auto& state, std::type_identity<D>) {
                 see_touched<D>(model.surface, state.position, state.velocity);
               });
               auto loose = [](auto const& contact) { return contact.loose; };
               manager.addForces(loose);
               manager.forEachChosen(loose, [](auto& contact) { contact.force = contact.evaluated; });
               withModels([]<class D>(auto& model, auto& state, std::type_identity<D>) {
                 if (model.simulated) add_forces<D>(state.externalForce, model.surface);
               });
             }));
  }
  // contacts of a step that begins; a matrix in which other points are joined is formed anew
  void detectContacts(RootScope const& scope, double dt) const;

  // f(component, state, step) for what acts before a step
  template <class S, class F>
  static void forEachAhead(S const& scope, StepAhead ahead, F&& f) {
    if (scope.template has<role::OdeSolver>()) ahead.solved = true;
    auto visit = on<BeforeStep>(
        [&](auto& c) { f(c, scope.template state<typename std::decay_t<decltype(c)>::DataTypes>(), ahead); });
    scope.forEachComponent(visit);
    scope.template forEachChild<BeforeStep>([&](auto const& child) { forEachAhead(child, ahead, f); });
  }
  void beginStep(RootScope const& scope, double dt) {
    [[maybe_unused]] const auto span = scope.span(Phase::beforeStep);
    const StepAhead ahead{step_ + 1, time_, time_ + dt, dt, false};
    forEachAhead(scope, ahead, [](auto& c, auto& state, StepAhead const& step) {
      if constexpr (requires { c.beforeStep(step, state); }) c.beforeStep(step, state);
    });
    bool moved = false;
    forEachAhead(scope, ahead, [&](auto& c, auto& state, StepAhead const& step) {
      if constexpr (requires { c.beginStep(step, state); }) moved = c.beginStep(step, state) || moved;
    });
    if (moved) MechanicalOperations(scope, time_, dt).propagate(vec_id::position, vec_id::velocity);
  }
  // removes what tools touch; says whether something went
  bool carve() {
    const auto scope = rootScope();
    [[maybe_unused]] const auto span = scope.span(Phase::carving);
    const std::vector<Carved> all = Carving<RootScope>{scope}.touched();
    long removed = 0;
    for (Carved const& c : all) {
      if (c.count == 0) continue;
      try {
        removeElements(c.path, c.elements);
      } catch (Error const& error) {
        throw Error(text("carving at step ", step_, " (time ", time_, " s)"),
                    text(c.count, " elements of '", c.path, "' cannot be removed: ", error.what()));
      }
      removed += long(c.count);
    }
    if (removed > 0)
      traverse(scope, on<role::Carving>([&](auto& carving, auto const&) {
                 if (carving.active) carving.removed += removed;
               }));
    return removed > 0;
  }

  // each ODE solver integrates its subtree and propagates; where there is none, the children are looked at
  template <class S>
  void integrate(S const& scope, double dt) {
    bool solved = false;
    auto visit = on<role::OdeSolver>([&](auto& ode) {
      using Ode = std::decay_t<decltype(ode)>;
      MechanicalOperations<S> operations(scope, time_, dt);
      if constexpr (!stands_beside<Ode>) operations.acted.begin(keepsForces_);
      ode.solve(operations, dt);
      operations.projectPositionAndVelocity(time_ + dt, vec_id::position, vec_id::velocity);
      operations.propagate(vec_id::position, vec_id::velocity);
      if constexpr (!stands_beside<Ode>)
        if (!operations.acted.end(vec_id::force))
          throw Error(
              scope.path(),
              text(
                  component_name<Ode>(),
                  ": forces cannot be kept, since this solver does not say which acted over its step; let it "
                  "call operations.acted.add(), or leave out Simulation::keepForces"));
      solved = true;
    });
    if (scope.integrates()) scope.forEachComponent(visit);
    if constexpr (!S::template always<role::OdeSolver>)
      if (!solved)
        scope.template forEachChild<role::OdeSolver>([&](auto const& child) { integrate(child, dt); });
  }

  void endStep(RootScope const& scope, double dt) const {
    [[maybe_unused]] const auto span = scope.span(Phase::endStep);
    traverse(scope, on<role::State, role::StepCallback>([&](auto& c, auto const& s) { endStep(c, s, dt); }));
  }
  template <class C, class S>
  void endStep(C& c, S const& scope, double dt) const {
    if constexpr (HasRole<C, role::State>) {
      if (!scope.mapped()) checkFinite(c, scope);
    } else if constexpr (WatchesState<C>) {
      using D = typename C::DataTypes;
      auto& state = scope.template state<D>();
      c.endStep(StepInfo{step_, time_, dt}, state, [&] {
        double energy = 0;
        scope.stateScope().withMass([&](auto& mass) {
          if constexpr (std::is_same_v<typename std::decay_t<decltype(mass)>::DataTypes, D>)
            energy = mass.kineticEnergy(state.position, state.velocity);
        });
        return energy;
      });
    } else {
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
    const int x = VectorOperations<D>::findNotFinite(state.position);
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

// Outside the class, so that a program may have them instantiated in one place: runtime/precompiled.hpp.

template <class Root>
void Simulation<Root>::init(double time, long step) {
  if constexpr (proved) {
    initialised_ = false;
    initScene(rootScope(), {});
    time_ = time;
    step_ = step;
    propagate();
    initialised_ = true;
  }
}

template <class Root>
TopologyChange Simulation<Root>::removeElements(std::string_view path, ElementNumbers const& elements) {
  if (!initialised_)
    throw Error("Simulation::removeElements", "the scene is not initialised; call init() first");
  TopologyChange change;
  if constexpr (proved) {
    Root next(root_);
    const auto scope = scopeOf(next);
    scope.settled();
    ElementRemoval removal(scope, path, elements);
    removal.apply();
    initScene(scope, removal.touched());
    change = removal.change();
    root_ = std::move(next);
    propagate();
  }
  return change;
}

template <class Root>
void Simulation<Root>::animate(double dt) {
  if (!initialised_) throw Error("Simulation::animate", "the scene is not initialised; call init() first");
  if (!(dt > 0) || !std::isfinite(dt))
    throw Error("Simulation::animate", text("dt is ", dt, " s, but must be a finite number greater than 0"));
  if constexpr (proved) {
    const auto scope = rootScope();
    [[maybe_unused]] const auto span = scope.span(Phase::step);
    beginStep(scope, dt);
    if constexpr (collides) detectContacts(scope, dt);
    if constexpr (collides && carves)
      if (carve()) detectContacts(scope, dt);
    computeLoose(scope, dt);
    integrate(scope, dt);
    time_ += dt;
    ++step_;
    visualsAreCurrent_ = false;
    endStep(scope, dt);
  }
}

template <class Root>
void Simulation<Root>::reset() {
  if (!initialised_) throw Error("Simulation::reset", "the scene is not initialised; call init() first");
  bool regained = false;
  traverse(rootScope(), on<WithReset>([&](auto& c, auto const&) {
             if constexpr (std::is_same_v<decltype(c.reset()), bool>)
               regained = c.reset() || regained;
             else
               c.reset();
           }));
  if constexpr (proved)
    if (std::vector<void const*> served; regained) initSolvers(rootScope(), {.again = true}, served);
  time_ = 0;
  step_ = 0;
  propagate();
}

template <class Root>
void Simulation<Root>::finish() {
  traverse(rootScope(), on<role::StepCallback>([](auto& c, auto const&) {
             if constexpr (requires { c.finish(); }) c.finish();
           }));
}

template <class Root>
double Simulation<Root>::kineticEnergy() {
  return over([](auto& o) { return o.kineticEnergy(); });
}

template <class Root>
double Simulation<Root>::potentialEnergy() {
  return over([](auto& o) { return o.potentialEnergy(); });
}

template <class Root>
void Simulation<Root>::updateVisual() {
  if (visualsAreCurrent_) return;
  const auto root = rootScope();
  [[maybe_unused]] const auto span = root.span(Phase::visual);
  auto each = [&](auto&& f) {
    traverse(root, on<role::Mapping>([&](auto& mapping, auto const& scope) {
               scope.withMapped(mapping, [&](auto& m, auto& child, auto& parent) {
                 if constexpr (HasRole<std::decay_t<decltype(child)>, role::VisualModel>) f(m, child, parent);
               });
             }));
  };
  // a device makes all of them before the first is waited for
  each([](auto& m, auto& child, auto& parent) {
    if constexpr (requires { m.ask(child.position, parent.position); })
      m.ask(child.position, parent.position);
  });
  each([](auto& m, auto& child, auto& parent) { m.apply(child.position, parent.position); });
  visualsAreCurrent_ = true;
}

template <class Root>
void Simulation<Root>::initScene(RootScope const& scope, InitAgain const& again) {
  scope.check();
  scope.raise();
  checkFields(scope, again);
  initStates(scope, again);
  initComponents(scope, again);
  Collision<RootScope>{scope}.init(bool(again));
  if constexpr (carves)
    if (again.touched.empty()) Carving<RootScope>{scope}.check();
  std::vector<void const*> served;
  initSolvers(scope, again, served);
  scope.raise();
  initLoose(scope);
  scope.settled();
}

template <class Root>
void Simulation<Root>::checkFields(RootScope const& scope, InitAgain const& again) {
  if constexpr (requires { scope.checkFields(again); })
    scope.checkFields(again);
  else
    traverse(scope, on<AnyRole>([&again](auto& c, auto const& s) {
               s.ifNew(c, again, [&] { check_fields(c, s.path()); });
             }));
  scope.raise();
}

template <class Root>
void Simulation<Root>::initStates(RootScope const& scope, InitAgain const& again) {
  traverse(scope, on<role::Topology>([&again](auto& c, auto const& s) {
             if constexpr (requires { c.generate(s.path()); })
               s.ifNew(c, again, [&] { c.generate(s.path()); });
           }));
  initStatesBelow(scope, again);
}

// Whoever reads through a topology comes after its check: mappings of children, and what acts on the states.
template <class Root>
template <class S>
void Simulation<Root>::initStatesBelow(S const& scope, InitAgain const& again) {
  auto states = on<role::Mapping, role::State, role::VisualModel>([&](auto& c) {
    scope.ifNew(c, again, [&] { initState(c, scope); });
    scope.raise();  // what follows a wrong state has nothing to stand on
  });
  scope.forEachComponent(states);
  auto topologies = on<role::Topology>([&](auto& c) {
    scope.ifNew(c, again, [&] { scope.withContext([&](auto const& context) { c.init(context); }); });
  });
  scope.forEachComponent(topologies);
  scope.raise();
  scope.template forEachChild<role::Topology, role::Mapping, role::State, role::VisualModel>(
      [&](auto const& child) { initStatesBelow(child, again); });
}

template <class Root>
void Simulation<Root>::initComponents(RootScope const& scope, InitAgain const& again) {
  traverse(scope, on<AnyRole>([&again](auto& c, auto const& s) {
             s.ifNew(c, again, [&] { initComponent(c, s, again); });
           }));
  scope.raise();
}

// f(linear solver) of the systems that an ODE solver has solved, if there are some.
template <class Root>
template <class Ode, class Operations, class F>
void Simulation<Root>::withLinearSolverOf([[maybe_unused]] Operations& operations, [[maybe_unused]] F&& f) {
  if constexpr (Ode::implicit)
    operations.root.withLinearSolver(f);
  else if constexpr (requires { Ode::solvesMass; })
    if (!operations.massIsDiagonal()) operations.root.withLinearSolverIfAny(f);
}

template <class Root>
template <class S>
void Simulation<Root>::initSolvers(S const& scope, InitAgain const& again, std::vector<void const*>& served) {
  bool solved = false;
  auto visit = on<role::OdeSolver>([&](auto& ode) {
    using Ode = std::decay_t<decltype(ode)>;
    solved = true;
    scope.located(ode, [&] {
      MechanicalOperations<S> operations(scope);
      operations.reserve(Ode::auxiliary);
      withLinearSolverOf<Ode>(operations, [&](auto& linear) {
        using Linear = std::decay_t<decltype(linear)>;
        if constexpr (needs_pattern<Linear>) {
          if (std::find(served.begin(), served.end(), &linear) != served.end())
            throw Error(text(scope.path(), ": ", component_name<Ode>()),
                        text("the ",
                             component_name<Linear>(),
                             " above is that of another ODE solver already, and has one matrix; give each an "
                             "assembled linear solver of its own, or both a CGLinearSolver without matrix"));
          served.push_back(&linear);
        }
        operations.reserve(Ode::auxiliary + Linear::auxiliary);
        linear.init(operations);
      });
      if constexpr (requires { ode.init(operations); }) ode.init(operations);
      operations.split();
      // what a solver remembers of the last step is not that of a scene that has changed
      if constexpr (requires { ode.lastEnd; })
        if (again) ode.lastEnd = -1;
    });
  });
  if (scope.integrates()) scope.forEachComponent(visit);
  if constexpr (!S::template always<role::OdeSolver>)
    if (!solved)
      scope.template forEachChild<role::OdeSolver>(
          [&](auto const& child) { initSolvers(child, again, served); });
}

template <class Root>
void Simulation<Root>::detectContacts(RootScope const& scope, double dt) const {
  [[maybe_unused]] const auto span = scope.span(Phase::collision);
  Collision<RootScope>{scope}.detect(dt, [&](auto const& solved, bool) {
    auto visit = on<role::OdeSolver>([&](auto& ode) {
      MechanicalOperations<std::decay_t<decltype(solved)>> operations(solved, time_, dt);
      withLinearSolverOf<std::decay_t<decltype(ode)>>(operations, [&](auto& linear) {
        if constexpr (needs_pattern<std::decay_t<decltype(linear)>>) linear.init(operations);
      });
    });
    solved.forEachComponent(visit);
  });
}

template <class Root>
void Simulation<Root>::propagate() {
  over([&](auto& o) {
    o.projectPositionAndVelocity(time_, vec_id::position, vec_id::velocity);
    o.propagate(vec_id::position, vec_id::velocity);
    return 0;
  });
  visualsAreCurrent_ = false;
}

}  // namespace sinew
