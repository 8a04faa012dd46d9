// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/constraint/fixed_constraint.hpp>
#include <sinew/context/gravity.hpp>
#include <sinew/gpu/fused/components.hpp>
#include <sinew/gpu/fused/field.hpp>
#include <sinew/gpu/fused/launch.hpp>
#include <sinew/gpu/fused/plan.hpp>
#include <sinew/gpu/fused/standing.hpp>
#include <sinew/gpu/gpu.hpp>
#include <sinew/scene/components_of.hpp>
#include <sinew/scene/simulation.hpp>

#include <cmath>
#include <tuple>
#include <vector>

namespace sinew::gpu {

/// Copies of a typed scene whose whole step is one kernel of the GPU, made by the compiler from the scene:
/// the matrix and the vectors of a copy stay in the registers and the shared memory of one block, of a
/// cluster of up to 16, or, of a single copy, of blocks all over the GPU; nothing is launched or waited for
/// within a step. Several steps may be made at once. All copies have the elements of the scene; state,
/// masses, materials and gravity are their own (load).
///
/// The scene has one body of points on the device (CudaVec3f or CudaVec3d), a lumped mass, force fields that
/// are element laws, fixed points, EulerImplicitSolver and CGLinearSolver<GraphScattered>. What else it has
/// (visual models) is left to the Simulation: store() brings a copy's state back to it. The result is that of
/// Simulation::animate but for rounding: the sums of the method are in another order.
///
/// The points or spheres of the body may touch surfaces that no solver moves, with friction, by the
/// multipliers of FreeMotionAnimationLoop and ConvexConstraintSolver: contacts are found and answered in the
/// kernel, by the functions of the Simulation, from the first step on. The result is that of the Simulation
/// to the tolerance of the solver.
///
/// Throws Error where a field of a component is given that has no place in a fused step (fused_fields), where
/// models may meet otherwise, and where the body is too large for the shared memory there is.
template <class Root>
class FusedSimulation {
  template <template <class> class Test, class Pointers>
  static auto* only(Pointers const& all) {
    const auto found = components_that<Test>(all);
    static_assert(
        std::tuple_size_v<decltype(found)> == 1,
        "Sinew: a fused step is for a scene with one state, one mass, one EulerImplicitSolver and one "
        "CGLinearSolver<>; others are stepped by Simulation.");
    return std::get<0>(found);
  }
  using All = decltype(components_of(std::declval<Root&>()));
  using State = std::remove_pointer_t<decltype(only<detail::IsState>(std::declval<All>()))>;
  using D = typename State::DataTypes;
  static_assert(OnDevice<D> && !D::rigid && D::size == 3,
                "Sinew: a fused step is for points in space on the device: CudaVec3f or CudaVec3d.");
  using Real = typename D::Real;
  using Coord = typename D::Coord;
  using Deriv = typename D::Deriv;
  template <class T>
  using Array = DeviceVector<T>;
  template <template <class> class Test>
  static constexpr std::size_t count =
      std::tuple_size_v<decltype(components_that<Test>(std::declval<All>()))>;
  static constexpr bool touches = count<detail::IsCollisionModel> > 0;
  static auto contactsOf() {
    if constexpr (touches) {
      constexpr bool whole = count<detail::IsLoop> == 1 && count<detail::IsConstraintSolver> == 1 &&
                             count<detail::IsPipeline> == 1 && count<detail::IsContactManager> == 1 &&
                             count<detail::IsIntersection> == 1 && count<detail::IsPointModel> == 1;
      static_assert(
          whole,
          "Sinew: in a fused step the points or spheres of a body touch what stands, by multipliers: it "
          "needs one PointCollisionModel or SphereCollisionModel over the DataTypes of the device, one each "
          "of FreeMotionAnimationLoop, ConvexConstraintSolver, DefaultPipeline, MinProximityIntersection "
          "and DefaultContactManager; other contacts are for Simulation.");
      if constexpr (whole)
        return std::type_identity<
            FusedContactsOf<D, Component<detail::IsIntersection>, Component<detail::IsContactManager>>>{};
      else
        return std::type_identity<NoFusedContacts>{};
    } else {
      static_assert(count<detail::IsStanding> == 0 && count<detail::IsLoop> == 0 &&
                        count<detail::IsConstraintSolver> == 0,
                    "Sinew: a fused step has one state; further ones, FreeMotionAnimationLoop and "
                    "ConvexConstraintSolver are for its contacts with what stands: give both collision "
                    "models, or step the scene by Simulation.");
      return std::type_identity<NoFusedContacts>{};
    }
  }
  template <template <class> class Test>
  using Component =
      std::remove_pointer_t<std::tuple_element_t<0, decltype(components_that<Test>(std::declval<All>()))>>;

 public:
  /// Copies of an initialised simulation, each run by so many blocks; 0 chooses.
  explicit FusedSimulation(Simulation<Root>& simulation, int copies = 1, int blocks = 0) : copies_(copies) {
    const All all = components_of(simulation.root());
    static_assert(
        std::tuple_size_v<decltype(components_that<detail::IsForeign>(all))> == 0,
        "Sinew: a fused step has no place for lists of constraints by multipliers, interactions, tools that "
        "carve, further solvers, forces that steps change, and what acts before a step; such a scene is "
        "stepped by Simulation.");
    refuseMoving(all);
    nodes_ = only<detail::IsState>(all)->size();
    ode_ = *only<detail::IsOdeSolver>(all);
    cg_ = *only<detail::IsLinearSolver>(all);
    refuseOtherFields(all);
    if (copies < 1) throw Error("FusedSimulation", text(copies, " copies; give at least 1"));

    // which nodes share an element
    std::vector<std::vector<int>> neighbours(nodes_);
    std::apply([&](auto*... field) { (addNeighbours(neighbours, field->driver.elements), ...); },
               fieldsOf(all));
    for (auto& list : neighbours) {
      std::sort(list.begin(), list.end());
      list.erase(std::unique(list.begin(), list.end()), list.end());
    }
    const FusedPlan plan = launcher_.choose(neighbours, copies, blocks);
    order_ = plan.order;
    rowBegin_ = plan.rowBegin;
    entryFirst_ = plan.entryFirst;
    column_ = plan.column;
    columnRow_ = plan.columnRow;
    if (shape().grid) vectors_.resize(2 * 4 * nodes_);
    sendFirst_ = plan.sendFirst;
    sends_ = plan.sends;

    std::vector<int> held(nodes_, 0);
    std::apply([&](auto*... c) { (detail::note_held<D>(*c, held), ...); },
               components_that<detail::IsConstraint>(all));
    held_ = std::move(held);
    const auto n = std::size_t(copies) * nodes_;
    x_ = Array<Coord>(n, Coord(Coord::Zero()));
    v_ = Array<Deriv>(n, Deriv(Deriv::Zero()));
    mass_ = Array<Real>(n, Real(1));
    gravity_ = Array<Deriv>(std::size_t(copies), Deriv(Deriv::Zero()));
    wrong_ = Array<int>(std::size_t(copies), 0);
    withFields(all, [&](auto& data, auto const& field) { data.init(field, plan, copies); });
    contacts_.init(simulation, all, plan.order, copies);
    load(0, simulation);
    repeat(x_.device(), nodes_);
    repeat(v_.device(), nodes_);
    repeat(mass_.device(), nodes_);
    repeat(gravity_.device(), 1);
    withFields(all, [&](auto& data, auto const&) { repeat(data.rest.data(), data.elements.size()); });
  }

  /// Copy number `copy` takes state, masses, materials and gravity of a simulation of the same scene. Throws
  /// Error where its elements are others, or how many they are, and where a field has no place in a fused
  /// step.
  void load(int copy, Simulation<Root>& from) {
    checkCopy(copy);
    const All all = components_of(from.root());
    refuseOtherFields(all);
    auto const& state = *only<detail::IsState>(all);
    if (state.size() != nodes_)
      throw Error("FusedSimulation::load",
                  text("the body has ",
                       state.size(),
                       " points, that of the copies ",
                       nodes_,
                       "; load a simulation of the same scene"));
    withFields(all, [&](auto& data, auto const& field) { data.load(copy, field); });
    const std::size_t begin = std::size_t(copy) * nodes_;
    copy_on_device(x_.device() + begin, state.position.device(), nodes_);
    copy_on_device(v_.device() + begin, state.velocity.device(), nodes_);
    std::vector<Real> masses(nodes_);
    for (std::size_t i = 0; i < nodes_; ++i) masses[i] = only<detail::IsMass>(all)->lumped.at(i);
    copy_to_device(mass_.device() + begin, masses.data(), nodes_);
    Deriv g = Deriv::Zero();
    std::apply([&](auto*... c) { ((g = c->gravity.template cast<Real>()), ...); },
               components_that<detail::IsGravity>(all));
    copy_to_device(gravity_.device() + copy, &g, 1);
    contacts_.load(copy, from);
    time_ = from.time();
    step_ = from.step();
  }
  /// A simulation of the same scene takes the state and the time of a copy.
  void store(int copy, Simulation<Root>& to) const {
    checkCopy(copy);
    auto& state = *only<detail::IsState>(components_of(to.root()));
    copy_on_device(state.position.overwrite(), x_.device() + std::size_t(copy) * nodes_, nodes_);
    copy_on_device(state.velocity.overwrite(), v_.device() + std::size_t(copy) * nodes_, nodes_);
    to.continueFrom(time_, step_);
  }

  /// What load() and store() copy of a simulation is in memory of the current device, and there when this
  /// returns, so that another device may copy it.
  static void settle(Simulation<Root>& simulation) {
    const All all = components_of(simulation.root());
    auto& state = *only<detail::IsState>(all);
    std::as_const(state.position).device();
    std::as_const(state.velocity).device();
    std::apply(
        [](auto const*... field) { ((field->driver.rest.device(), field->driver.index.device()), ...); },
        fieldsOf(all));
    wait();
  }

  /// Makes steps of dt seconds in all copies. Returns before they are done; throws Error where dt is no
  /// positive number.
  void animate(double dt, int steps = 1) {
    if (!(dt > 0) || !std::isfinite(dt))
      throw Error("FusedSimulation::animate",
                  text("dt is ", dt, " s, but must be a finite number greater than 0"));
    if (steps < 0) throw Error("FusedSimulation::animate", text(steps, " steps; give 0 or more"));
    launcher_.run(body(dt, steps));
    time_ += steps * dt;
    step_ += steps;
  }
  /// Waits for the steps that were asked for. Throws Error where a position is not finite, where a point
  /// touched in more places than there is room for, and where contacts were not solved, if stopsUnsolved.
  void finish() {
    auto const& wrong = std::as_const(wrong_).host();
    for (std::size_t c = 0; c < wrong.size(); ++c) {
      if constexpr (touches) contacts_.check(c);
      if (wrong[c] != 0)
        throw Error(
            text("copy ", c, ", before step ", step_ + 1, " (time ", time_, " s)"),
            "a position is not a finite number: the simulation diverged; take a smaller dt, more damping "
            "or a softer material");
    }
  }

  /// The contacts of a copy in its last step with their forces, each with its node, in the order of rows.
  std::vector<std::pair<int, FusedContact>> contacts(int copy) const {
    static_assert(touches, "Sinew: this scene has no collision models.");
    checkCopy(copy);
    return contacts_.contacts(copy);
  }
  /// Steps of a copy, since its state was loaded, whose contacts were not solved to the tolerances of the
  /// ConvexConstraintSolver, and went on with the best that was found.
  int unsolved(int copy) const {
    static_assert(touches, "Sinew: this scene has no collision models.");
    checkCopy(copy);
    return contacts_.unsolved(copy);
  }

  int copies() const { return copies_; }
  double time() const { return time_; }
  long step() const { return step_; }
  FusedShape const& shape() const { return launcher_.shape(); }

 private:
  static void refuseOtherFields(All const& all) {
    std::apply([](auto*... c) { (detail::refuse_other_fields(*c), ...); },
               components_that<detail::IsFused>(all));
  }
  static void refuseMoving(All const& all) {
    std::apply([](auto*... state) { (refuseMoved(*state), ...); }, components_that<detail::IsStanding>(all));
  }
  template <class State>
  static void refuseMoved(State const& state) {
    if (state.solver >= 0)
      throw Error("FusedSimulation",
                  text(component_name<State>(),
                       " is moved by a solver; a fused step moves the one state on the "
                       "device, and others stand; take Simulation"));
  }
  static auto fieldsOf(All const& all) { return components_that<detail::IsForceField>(all); }
  template <class... F>
  static std::tuple<FusedField<F>...> dataOf(std::tuple<F*...> const&);
  using Data = decltype(dataOf(fieldsOf(std::declval<All>())));
  using Contacts = typename decltype(contactsOf())::type;
  template <class... F>
  static FusedBody<D, typename Contacts::View, typename FusedField<F>::Elements...> bodyOf(
      std::tuple<F*...> const&);
  using Body = decltype(bodyOf(fieldsOf(std::declval<All>())));

  int copies_;
  std::size_t nodes_ = 0;
  Data fields_{};
  Contacts contacts_{};
  Array<int> order_{}, rowBegin_{}, entryFirst_{}, sendFirst_{}, held_{}, wrong_{};
  Array<unsigned> sends_{};
  Array<std::uint16_t> column_{};
  Array<int> columnRow_{};
  DeviceArray<Real> vectors_{};
  Array<Coord> x_{};
  Array<Deriv> v_{}, gravity_{};
  Array<Real> mass_{};
  EulerImplicitSolver ode_{};
  CGLinearSolver<GraphScattered> cg_{};
  double time_ = 0;
  long step_ = 0;
  FusedLauncher<Body> launcher_{};

  // all copies get the `count` values of the first
  template <class T>
  void repeat(T* values, std::size_t count) const {
    const auto copies = std::size_t(copies_);
    for (std::size_t done = 1; done < copies; done *= 2)
      copy_on_device(values + done * count, values, std::min(done, copies - done) * count);
  }
  template <class F>
  void withFields(All const& all, F&& f) {
    const auto fields = fieldsOf(all);
    [&]<std::size_t... I>(std::index_sequence<I...>) {
      (f(std::get<I>(fields_), *std::get<I>(fields)), ...);
    }(std::make_index_sequence<std::tuple_size_v<Data>>{});
  }
  template <class Elements>
  static void addNeighbours(std::vector<std::vector<int>>& neighbours, Elements const& elements) {
    for (auto const& e : elements)
      for (const int i : e)
        for (const int j : e)
          if (i != j) neighbours[std::size_t(i)].push_back(j);
  }
  void checkCopy(int copy) const {
    if (copy < 0 || copy >= copies_)
      throw Error("FusedSimulation",
                  text("there is no copy ", copy, "; the ", copies_, " are numbered from 0"));
  }

  Body body(double dt, int steps) {
    Body b = launcher_.sizes();
    b.fields = std::apply([](auto&... data) { return std::make_tuple(data.view()...); }, fields_);
    b.contacts = contacts_.view();
    b.order = std::as_const(order_).device();
    b.rowBegin = std::as_const(rowBegin_).device();
    b.entryFirst = std::as_const(entryFirst_).device();
    b.sendFirst = std::as_const(sendFirst_).device();
    b.sends = std::as_const(sends_).device();
    b.column = std::as_const(column_).device();
    b.columnRow = std::as_const(columnRow_).device();
    b.x = x_.device();
    b.v = v_.device();
    b.mass = std::as_const(mass_).device();
    b.held = std::as_const(held_).device();
    b.gravity = std::as_const(gravity_).device();
    b.wrong = wrong_.device();
    b.vectors = vectors_.data();
    b.h = Real(dt);
    b.rayleighStiffness = Real(ode_.rayleighStiffness);
    b.rayleighMass = Real(ode_.rayleighMass);
    b.keptSpeed = Real(std::exp(-dt * ode_.vdamping));
    b.iterations = cg_.iterations;
    b.steps = steps;
    b.tolerance2 = cg_.tolerance * cg_.tolerance;
    b.threshold = cg_.threshold;
    return b;
  }
};

}  // namespace sinew::gpu
