// SPDX-License-Identifier: BSL-1.0
#pragma once

// first, since their sentences come behind "In file included from"
#include <sinew/scene/node.hpp>

#include <sinew/scene/mistakes.hpp>

#include <sinew/core/step_warnings.hpp>
#include <sinew/scene/force_report.hpp>
#include <sinew/scene/initialise.hpp>
#include <sinew/scene/picking.hpp>
#include <sinew/scene/step.hpp>
#include <sinew/scene/topology_edit.hpp>
#include <sinew/scene/visuals.hpp>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <optional>
#include <string_view>
#include <type_traits>
#include <utility>
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
  template <bool Asked = false>
  void animate() {
    static_assert(Asked,
                  "Sinew: animate(dt) takes the time step in seconds; write sim.animate(0.01), or what your "
                  "scene needs.");
  }

  /// Back to the scene as it was after init, at time 0, so that the next steps have the bits of the first
  /// ones: points, positions and velocities (those that states were given for a reset), springs that were
  /// cut, what materials and solvers remember. Contacts are forgotten, what was attached is released. What
  /// was changed from outside stays: by change() and removeElements(), and so what tools have carved; fields,
  /// and targets of couplings.
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
  /// What the steps since init or reset have noticed, each thing once with its count: bodies that started in
  /// each other, constraints that were not solved.
  StepWarnings const& warnings() const { return warnings_; }
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
  template <bool Asked = false>
  Root& at(std::string_view) {
    static_assert(Asked,
                  "Sinew: the path of a node is a part of the call's type; write sim.at<\"liver\">().");
    return root_;
  }
  Root& root() { return root_; }

  /// Visual models follow their mappings.
  void updateVisual();

  /// f(component, scope) for each component with one of the roles, from the root on.
  template <class... Roles, class F>
  void visit(F&& f) {
    traverse(rootScope(), on<Roles...>(std::forward<F>(f)));
  }

  /// Changes the scene in the middle of the simulation: edit(root) is given a copy, in which runtime nodes
  /// come, go and move, and fields take other values. What is new is initialised, and so are the components
  /// whose addresses edit returns, in a std::vector<void const*>; then the copy takes the place of the scene.
  /// Where edit or the new scene is wrong, Error is thrown and nothing has changed.
  template <class F>
  void change(F&& edit) {
    initialisedFor("change");
    Root next(root_);
    scopeOf(next).settled();
    InitAgain again{.again = true};
    if constexpr (std::is_void_v<decltype(edit(next))>)
      edit(next);
    else
      again.touched = edit(next);
    std::sort(again.touched.begin(), again.touched.end(), std::less<>{});
    Initialisation<RootScope>(scopeOf(next), std::move(again)).run();
    root_ = std::move(next);
    propagate();
  }

  /// The same of all of the scene where it is, without a copy of what it was: edit(root) leaves less of it,
  /// lists get as much memory as they have entries, and every component is initialised again. Where edit or
  /// the new scene is wrong, Error is thrown, and the simulation is of no use any more.
  template <class F>
  void reduce(F&& edit) {
    initialisedFor("reduce");
    initialised_ = false;
    edit(root_);
    root_ = Root(root_);
    const auto scope = rootScope();
    scope.settled();
    InitAgain all{.again = true};
    traverse(scope, on<AnyRole>([&](auto& c, auto const&) { all.touched.push_back(&c); }));
    std::sort(all.touched.begin(), all.touched.end(), std::less<>{});
    Initialisation<RootScope>(scope, std::move(all)).run();
    propagate();
    initialised_ = true;
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

  /// Puts elements behind those of the topology of the node at a path from the root, over its points and new
  /// ones between these. A point comes where it lies between its own, in place, at rest and in velocity; an
  /// element has its shape at rest from the rest positions, and the values of its ancestor, where it has one.
  /// What was there before moves on as it did. Masses by density grow by what comes, which has the velocities
  /// of its points. All that refers to the body follows: topologies and visual models with the same elements,
  /// with its whole border, or with two triangles for each of its quads get those that come (plan_addition),
  /// constraints hold points between those that they held, and the rest is initialised again from the rest
  /// positions. Returns what became of points and elements. Throws Error where a number leads nowhere, an
  /// element has a point twice or is there already, is flat or inside out, or something has a value for each
  /// element or point that what comes would not have: nothing has changed then.
  TopologyChange addElements(std::string_view path, AddedElements const& elements);

  /// Parts elements of the topology of the node at a path from the root at the middles of their edges
  /// (plan_refinement): edges in 2, triangles and quads in 4, tetrahedra and hexahedra in 8, and of their
  /// neighbours what has one of these edges, or one of a sheet of opposite sides with it; all where no number
  /// is given. Points and parts come as those of addElements do, with the values of the elements that go, so
  /// that length, area, volume, strain, mass, and, of masses by density, momentum stay. Returns what became
  /// of points and elements. Throws Error as addElements does, and where a pyramid, a prism or an element of
  /// second order would be parted: nothing has changed then.
  TopologyChange refineElements(std::string_view path, ElementNumbers const& elements = {});

  /// Cuts the topology of the node at a path from the root ("liver"), tetrahedra or else triangles, along
  /// what a blade sweeps, where the body is now (plan_cut): elements through which it goes are parted, their
  /// points are there twice, and what comes is between what there was, in place, at rest and in velocity. All
  /// that refers to them follows: parts of an element have its material, constraints hold points between
  /// those that they held, states with the same points are cut with them, the surface that collides, and one
  /// that is looked at or listed whole beside the volume, get the faces that are laid bare; the rest is
  /// initialised again. Volume and strain stay, and so do mass and momentum of masses by density. Throws
  /// Error where the blade is none, where something stands on the points that cannot follow, and where there
  /// would be too many points: nothing has changed then. A blade that misses does nothing.
  Cut cut(std::string_view path, Blade const& blade, CutRules const& rules = {}) {
    return cut(path, CutOrder{.stroke = {SweptBlade("Simulation::cut", blade)}, .rules = rules});
  }
  /// The same with what a blade was not done with, and is not now.
  Cut cut(std::string_view path, CutOrder const& order);

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
  /// Releases an attachment. False where there was none with this number.
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
  StepWarnings warnings_{};
  static constexpr NoScope above_{};

  static RootScope scopeOf(Root& root) {
    if constexpr ((RootScope::profiled || RootScope::distributed) && requires { root.aboveRoot; })
      return {root, root.aboveRoot};
    else
      return {root, above_};
  }
  RootScope rootScope() { return scopeOf(root_); }

  void initialisedFor(std::string_view what) const {
    if (!initialised_)
      throw Error(text("Simulation::", what), "the scene is not initialised; call init() first");
  }
  template <class Order>
  TopologyChange editTopology(std::string_view path, Order const& order);
  template <class StepOf>
  void changeTopology(StepOf const& step);
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
  // a part of a step
  void advance(Step<RootScope> const& step, bool detects);
};

// Outside the class, so that a program may have them instantiated in one place: runtime/precompiled.hpp.

template <class Root>
void Simulation<Root>::init(double time, long step) {
  if constexpr (proved) {
    initialised_ = false;
    Initialisation<RootScope>(rootScope()).run();
    time_ = time;
    step_ = step;
    warnings_.clear();
    propagate();
    initialised_ = true;
  }
}

template <class Root>
TopologyChange Simulation<Root>::removeElements(std::string_view path, ElementNumbers const& elements) {
  initialisedFor("removeElements");
  return editTopology(path, elements);
}

template <class Root>
TopologyChange Simulation<Root>::addElements(std::string_view path, AddedElements const& elements) {
  initialisedFor("addElements");
  return editTopology(path, elements);
}

template <class Root>
TopologyChange Simulation<Root>::refineElements(std::string_view path, ElementNumbers const& elements) {
  initialisedFor("refineElements");
  TopologyChange change;
  if constexpr (proved) {
    Root next(root_);
    const auto scope = scopeOf(next);
    scope.settled();
    auto edit = [&](auto const& order) {
      TopologyEdit edits(scope, path, order);
      edits.apply();
      Initialisation<RootScope>(scope, edits.touched()).run();
      change = edits.change();
      return edits.whole();
    };
    const ElementNumbers whole = edit(RefineOrder{elements});
    TopologyChange both = change;
    edit(whole);
    both.points = both.points.then(change.points);
    for (std::size_t k = 0; k < element_kinds; ++k)
      both.elements[k] = both.elements[k].then(change.elements[k]);
    change = std::move(both);
    root_ = std::move(next);
    propagate();
  }
  return change;
}

template <class Root>
template <class Order>
TopologyChange Simulation<Root>::editTopology(std::string_view path, Order const& order) {
  TopologyChange change;
  if constexpr (proved) {
    Root next(root_);
    const auto scope = scopeOf(next);
    scope.settled();
    TopologyEdit edit(scope, path, order);
    edit.apply();
    Initialisation<RootScope>(scope, edit.touched()).run();
    change = edit.change();
    root_ = std::move(next);
    propagate();
  }
  return change;
}

template <class Root>
Cut Simulation<Root>::cut(std::string_view path, CutOrder const& order) {
  initialisedFor("cut");
  Cut done;
  if constexpr (proved) {
    check_rules(text("cut of '", path, "'"), order.rules);
    {
      const auto here = rootScope();
      TopologyEdit edit(here, path, order);
      done = {edit.change(), edit.cut().elements, edit.cut().faces, edit.cut().front};
      if (!edit.cut().changes()) return done;
    }
    editTopology(path, order);
  }
  return done;
}

// all that a step changes, or nothing of it
template <class Root>
template <class StepOf>
void Simulation<Root>::changeTopology(StepOf const& step) {
  std::optional<Root> before;
  try {
    step.changeTopology([&](auto const& path, auto const& order) {
      if (!before) before.emplace(root_);
      using Order = std::decay_t<decltype(order)>;
      if constexpr (std::is_same_v<Order, CutOrder>)
        return cut(path, order);
      else if constexpr (std::is_same_v<Order, AddedElements>)
        addElements(path, order);
      else
        removeElements(path, order);
    });
  } catch (...) {
    if (before) root_ = std::move(*before);
    throw;
  }
}

template <class Root>
void Simulation<Root>::animate(double dt) {
  initialisedFor("animate");
  if (!(dt > 0) || !std::isfinite(dt))
    throw Error("Simulation::animate", text("dt is ", dt, " s, but must be a finite number greater than 0"));
  if constexpr (proved) {
    const auto scope = rootScope();
    [[maybe_unused]] const auto span = scope.span(Phase::step);
    long detections = 1, integrations = 1;
    with_first<role::StepDivision>(scope, [&](auto const& division) {
      detections = division.collisionSteps, integrations = division.integrationSteps;
    });
    const double begin = time_, parts = double(detections) * double(integrations);
    long part = 0;
    for (long i = 0; i < detections; ++i)
      for (long k = 0; k < integrations; ++k) {
        advance({scope, step_ + 1, time_, dt / parts, warnings_, step_ + part == 0}, k == 0);
        time_ = begin + dt * (double(++part) / parts);
      }
    ++step_;
    visualsAreCurrent_ = false;
    const Step<RootScope> whole{scope, step_, begin, dt, warnings_};
    whole.follow();
    whole.end();
  }
}

template <class Root>
void Simulation<Root>::advance(Step<RootScope> const& step, bool detects) {
  if constexpr (holds<Root, role::TopologicalChange>()) changeTopology(step);
  step.begin();
  if constexpr (holds<Root, role::Cutting>())
    step.cut([&](auto const& path, auto const& order) { return cut(path, order); });
  if constexpr (collides<RootScope>)
    if (detects) step.detectContacts();
  if constexpr (collides<RootScope> && holds<Root, role::Carving>())
    if (step.carve([&](auto const& path, auto const& elements) { removeElements(path, elements); }))
      step.detectContacts();
  step.computeLoose();
  step.stepModels();
  step.integrate(keepsForces_);
}

template <class Root>
void Simulation<Root>::reset() {
  initialisedFor("reset");
  bool regained = false;
  traverse(rootScope(), on<WithReset>([&](auto& c, auto const&) {
             if constexpr (std::is_same_v<decltype(c.reset()), bool>)
               regained = c.reset() || regained;
             else
               c.reset();
           }));
  if constexpr (proved) ChangingPoints<RootScope>{rootScope()}.reset();
  traverse(rootScope(), on<role::LagrangianConstraint>([](auto& c, auto const&) {
             if constexpr (KeepsMultipliers<std::decay_t<decltype(c)>>) c.multipliers.clear();
           }));
  if constexpr (proved)
    if (regained) Initialisation<RootScope>(rootScope(), {.again = true}).initSolvers();
  time_ = 0;
  step_ = 0;
  warnings_.clear();
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
  double models = 0;
  if constexpr (holds<Root, role::BehaviorModel>())
    traverse(rootScope(),
             on<role::BehaviorModel>([&](auto& model, auto const&) { models += model.kineticEnergy(); }));
  return models + over([](auto& o) { return o.kineticEnergy(); });
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
  update_visuals(root);
  visualsAreCurrent_ = true;
}

template <class Root>
void Simulation<Root>::propagate() {
  over([&](auto& o) {
    o.projectPositionAndVelocity(time_, vec_id::position, vec_id::velocity);
    o.propagate(vec_id::position, vec_id::velocity);
    return 0;
  });
  if constexpr (proved) {
    const auto scope = rootScope();
    LiveEngines<RootScope>{scope, time_}.update(true);
  }
  visualsAreCurrent_ = false;
}

}  // namespace sinew
