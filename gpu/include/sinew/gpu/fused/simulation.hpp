// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/constraint/fixed_constraint.hpp>
#include <sinew/context/gravity.hpp>
#include <sinew/gpu/assembled_system.hpp>
#include <sinew/gpu/fused/field.hpp>
#include <sinew/gpu/fused/plan.hpp>
#include <sinew/gpu/fused/step.hpp>
#include <sinew/gpu/gpu.hpp>
#include <sinew/scene/components_of.hpp>
#include <sinew/scene/simulation.hpp>
#include <sinew/solver/cg_linear_solver.hpp>
#include <sinew/solver/euler_implicit.hpp>

#include <cmath>
#include <optional>
#include <string>
#include <tuple>
#include <vector>

namespace sinew::gpu {

namespace detail {

#if SINEW_CUDA
/// Threads of a block, and how many entries of a row each keeps in so many of the registers that are then
/// there for it (128 and 168).
inline constexpr int cluster_threads = 512, grid_threads = 384;
template <class Body, int Registers>
inline constexpr int kept_in = std::min(Body::keptEntries,
                                        Registers /
                                            (Body::components * int(sizeof(typename Body::Real) / 4)));

template <int Lanes, class Body>
using FusedCluster = ClusterTeam<Lanes, kept_in<Body, 36>>;
template <int Lanes, class Body>
using FusedGrid = GridTeam<Lanes, kept_in<Body, 64>>;

template <int Lanes, class Body>
__global__ void __launch_bounds__(cluster_threads, 1) fused_kernel(Body body) {
  extern __shared__ __align__(16) unsigned char shared[];
  fused_steps(FusedCluster<Lanes, Body>(), body, shared);
}
template <int Lanes, class Body>
__global__ void __launch_bounds__(grid_threads, 1) fused_grid_kernel(Body body, GridMemory memory) {
  extern __shared__ __align__(16) unsigned char shared[];
  fused_steps(FusedGrid<Lanes, Body>(memory), body, shared);
}
#endif

template <class C>
struct IsState : std::bool_constant<HasRole<C, role::State>> {};
template <class C>
struct IsMass : std::bool_constant<HasRole<C, role::Mass>> {};
template <class C>
struct IsForceField : std::bool_constant<HasRole<C, role::ForceField>> {};
template <class C>
struct IsConstraint : std::bool_constant<HasRole<C, role::ProjectiveConstraint>> {};
template <class C>
struct IsGravity : std::is_same<C, Gravity> {};
template <class C>
struct IsOdeSolver : std::is_same<C, EulerImplicitSolver> {};
template <class C>
struct IsLinearSolver : std::is_same<C, CGLinearSolver<GraphScattered>> {};
/// What takes part in mechanics and has no place in a fused step. (A mapping has, where it leads to no
/// state.)
template <class C>
struct IsForeign
    : std::bool_constant<HasRole<C, role::InteractionForceField> || HasRole<C, role::CollisionModel> ||
                         HasRole<C, role::Carving> || ActsBeforeStep<C>> {};

}  // namespace detail

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
/// Throws Error where a setting of a component has no place in a fused step, and where the body is too large
/// for the shared memory there is.
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

 public:
  /// Copies of an initialised simulation, each run by so many blocks; 0 chooses.
  explicit FusedSimulation(Simulation<Root>& simulation, int copies = 1, int blocks = 0) : copies_(copies) {
    const All all = components_of(simulation.root());
    static_assert(
        std::tuple_size_v<decltype(components_that<detail::IsForeign>(all))> == 0,
        "Sinew: a fused step has no place for interactions, collision and what acts before a step; such "
        "a scene is stepped by Simulation.");
    nodes_ = only<detail::IsState>(all)->size();
    ode_ = *only<detail::IsOdeSolver>(all);
    cg_ = *only<detail::IsLinearSolver>(all);
    if (ode_.firstOrder || ode_.trapezoidalScheme || ode_.maxNbIterationsNewton != 1)
      throw Error(
          "FusedSimulation",
          "the fused step is that of EulerImplicitSolver with one Newton iteration, without firstOrder and "
          "trapezoidalScheme; take Simulation for these");
    if (copies < 1) throw Error("FusedSimulation", text(copies, " copies; give at least 1"));

    // which nodes share an element
    std::vector<std::vector<int>> neighbours(nodes_);
    std::apply([&](auto*... field) { (addNeighbours(neighbours, field->driver.elements), ...); },
               fieldsOf(all));
    for (auto& list : neighbours) {
      std::sort(list.begin(), list.end());
      list.erase(std::unique(list.begin(), list.end()), list.end());
    }
    const FusedPlan plan = choose(neighbours, blocks);
    order_ = plan.order;
    rowBegin_ = plan.rowBegin;
    entryFirst_ = plan.entryFirst;
    column_ = plan.column;
    columnRow_ = plan.columnRow;
    if (shape_.grid) {
      vectors_.resize(2 * 4 * nodes_);
      sums_.resize(2 * 2 * std::size_t(shape_.blocks));
      arrived_ = Array<unsigned long long>(2, 0ull);
      announced_.resize(std::size_t(shape_.blocks));
      nearFirst_ = plan.nearFirst;
      near_ = plan.near;
    }
    sendFirst_ = plan.sendFirst;
    sends_ = plan.sends;

    std::vector<int> held(nodes_, 0);
    std::apply([&](auto*... c) { (hold(*c, held), ...); }, components_that<detail::IsConstraint>(all));
    held_ = std::move(held);
    const auto n = std::size_t(copies) * nodes_;
    x_ = Array<Coord>(n, Coord(Coord::Zero()));
    v_ = Array<Deriv>(n, Deriv(Deriv::Zero()));
    mass_ = Array<Real>(n, Real(1));
    gravity_ = Array<Deriv>(std::size_t(copies), Deriv(Deriv::Zero()));
    wrong_ = Array<int>(std::size_t(copies), 0);
    withFields(all, [&](auto& data, auto const& field) { data.init(field, plan, copies); });
    load(0, simulation);
    repeat(x_.device(), nodes_);
    repeat(v_.device(), nodes_);
    repeat(mass_.device(), nodes_);
    repeat(gravity_.device(), 1);
    withFields(all, [&](auto& data, auto const&) { repeat(data.rest.data(), data.elements.size()); });
  }

  /// Copy number `copy` takes state, masses, materials and gravity of a simulation of the same scene. Throws
  /// Error where its elements are others, or how many they are.
  void load(int copy, Simulation<Root>& from) {
    checkCopy(copy);
    const All all = components_of(from.root());
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

  /// Makes steps of dt seconds in all copies. Returns before they are done; throws Error where dt is no
  /// positive number.
  void animate(double dt, int steps = 1) {
    if (!(dt > 0) || !std::isfinite(dt))
      throw Error("FusedSimulation::animate",
                  text("dt is ", dt, " s, but must be a finite number greater than 0"));
    if (steps < 0) throw Error("FusedSimulation::animate", text(steps, " steps; give 0 or more"));
    Body body = this->body(dt, steps);
#if SINEW_CUDA
    if (shape_.grid)
      launch(gridKernel(),
             body,
             GridMemory{arrived_.device(),
                        turn_,
                        announced_.data(),
                        sums_.data(),
                        std::as_const(nearFirst_).device(),
                        std::as_const(near_).device()});
    else
      launch(clusterKernel(), body);
    turn_ = 1 - turn_;
#else
    std::vector<double> shared(shape_.shared / sizeof(double) + 1);
    for (int c = 0; c < copies_; ++c)
      fused_steps(SerialTeam{.copy = c}, body, reinterpret_cast<unsigned char*>(shared.data()));
#endif
    time_ += steps * dt;
    step_ += steps;
  }
  /// Waits for the steps that were asked for. Throws Error where a position is not finite.
  void finish() {
    auto const& wrong = std::as_const(wrong_).host();
    for (std::size_t c = 0; c < wrong.size(); ++c)
      if (wrong[c] != 0)
        throw Error(
            text("copy ", c, ", before step ", step_ + 1, " (time ", time_, " s)"),
            "a position is not a finite number: the simulation diverged; take a smaller dt, more damping "
            "or a softer material");
  }

  int copies() const { return copies_; }
  double time() const { return time_; }
  long step() const { return step_; }
  /// How a copy runs: by the blocks of a launch, or those of a cluster; threads of a block, threads a row,
  /// bytes of shared memory a block.
  struct Shape {
    bool grid = false;
    int blocks = 1, threads = 1, lanes = 1;
    std::size_t shared = 0;
  };
  Shape shape() const { return shape_; }

 private:
  static auto fieldsOf(All const& all) { return components_that<detail::IsForceField>(all); }
  template <class... F>
  static std::tuple<FusedField<F>...> dataOf(std::tuple<F*...> const&);
  using Data = decltype(dataOf(fieldsOf(std::declval<All>())));
  template <class... F>
  static FusedBody<D, typename FusedField<F>::Elements...> bodyOf(std::tuple<F*...> const&);
  using Body = decltype(bodyOf(fieldsOf(std::declval<All>())));

  int copies_;
  std::size_t nodes_ = 0;
  Data fields_{};
  Array<int> order_{}, rowBegin_{}, entryFirst_{}, sharedFirst_{}, sendFirst_{}, held_{}, wrong_{};
  Array<unsigned> sends_{};
  Array<std::uint16_t> column_{};
  Array<int> columnRow_{};
  DeviceArray<Real> vectors_{};
  // of a grid (GridMemory)
  DeviceArray<double> sums_{};
  DeviceArray<unsigned> announced_{};
  Array<int> nearFirst_{}, near_{};
  Array<unsigned long long> arrived_{};
  int turn_ = 0;
  Array<Coord> x_{};
  Array<Deriv> v_{}, gravity_{};
  Array<Real> mass_{};
  EulerImplicitSolver ode_{};
  CGLinearSolver<GraphScattered> cg_{};
  double time_ = 0;
  long step_ = 0;
  Shape shape_{};
  Body sizes_{};  // of the plan

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
    [&]<std::size_t... I>(std::index_sequence<I...>) { (f(std::get<I>(fields_), *std::get<I>(fields)), ...); }
    (std::make_index_sequence<std::tuple_size_v<Data>>{});
  }
  template <class Elements>
  static void addNeighbours(std::vector<std::vector<int>>& neighbours, Elements const& elements) {
    for (auto const& e : elements)
      for (const int i : e)
        for (const int j : e)
          if (i != j) neighbours[std::size_t(i)].push_back(j);
  }
  template <class C>
  static void hold(C const& constraint, std::vector<int>& held) {
    if constexpr (requires { constraint.fixedDirections; }) {
      for (const int i : constraint.held)
        for (int c = 0; c < 3; ++c) held[std::size_t(i)] |= constraint.fixedDirections[std::size_t(c)] << c;
    } else {
      static_assert(
          std::is_same_v<C, FixedConstraint<D>>,
          "Sinew: a fused step knows FixedConstraint and PartialFixedConstraint; a scene with others is "
          "stepped by Simulation.");
      for (const int i : constraint.held) held[std::size_t(i)] = 7;
    }
  }
  void checkCopy(int copy) const {
    if (copy < 0 || copy >= copies_)
      throw Error("FusedSimulation",
                  text("there is no copy ", copy, "; the ", copies_, " are numbered from 0"));
  }

  // `blocks` above 16 asks for the blocks of a launch. Where it is 0: a single copy takes these, unless one
  // block has a thread for every entry; several the smallest of the clusters whose memory holds the body, or
  // a larger one, up to a thread for every entry, where all copies still run at once.
  FusedPlan choose(std::vector<std::vector<int>> const& neighbours, int blocks) {
#if SINEW_CUDA
    char const* const what = "FusedSimulation";
    int device = 0, most = 0, processors = 0, clusters = 0;
    gpu::check(cudaGetDevice(&device), what);
    gpu::check(cudaDeviceGetAttribute(&most, cudaDevAttrMaxSharedMemoryPerBlockOptin, device), what);
    gpu::check(cudaDeviceGetAttribute(&processors, cudaDevAttrMultiProcessorCount, device), what);
    gpu::check(cudaDeviceGetAttribute(&clusters, cudaDevAttrClusterLaunch, device), what);
    std::size_t entries = nodes_;
    for (auto const& n : neighbours) entries += n.size();
    auto fits = [&](FusedPlan const& plan, bool grid, int least) {
      using Cluster = detail::FusedCluster<1, Body>;
      using Grid = detail::FusedGrid<1, Body>;
      for (const int lanes : {8, 4, 2, 1}) {
        if (lanes < least || (!grid && !plan.possible())) return false;
        take(plan, lanes * (grid ? Grid::keptEntries : Cluster::keptEntries));
        const std::size_t shared = grid ? sizes_.template shared<Grid>() : sizes_.template shared<Cluster>();
        const int threads = (plan.widest * lanes + 31) / 32 * 32 + (grid ? Grid::helpers : 0);
        shape_ = {grid, plan.ranks, threads, lanes, shared};
        if (threads <= (grid ? detail::grid_threads : detail::cluster_threads) && shared <= std::size_t(most))
          return true;
      }
      return false;
    };
    if (copies_ == 1 && (blocks == 0 ? entries > detail::cluster_threads : blocks > 16)) {
      // 16 rows a block while that leaves a quarter of the GPU idle, since many blocks exchange sums slower
      // than few; else as few as have eight threads a row, or all
      struct Wish {
        int blocks, lanes;
      };
      constexpr int rows = (detail::grid_threads - detail::FusedGrid<1, Body>::helpers) / 8;
      const int nodes = int(nodes_);
      const std::vector<Wish> wishes =
          blocks == 0 ? std::vector<Wish>{{std::min((nodes + 15) / 16, std::max(1, processors * 3 / 4)), 8},
                                          {(nodes + rows - 1) / rows, 8},
                                          {processors, 2}}
                      : std::vector<Wish>{{std::min(blocks, processors), 2}};
      for (const Wish wish : wishes) {
        if (wish.blocks > processors) continue;
        FusedPlan plan(neighbours, wish.blocks);
        if (fits(plan, true, wish.lanes)) return plan;
      }
    }
    std::optional<FusedPlan> chosen;
    for (const int more : {1, 2, 4, 8, 16}) {
      if (blocks != 0 && more != blocks) continue;
      const bool enough = chosen && std::size_t(chosen->ranks) * detail::cluster_threads >= entries;
      if (enough || (more > 1 && !clusters)) break;
      FusedPlan plan(neighbours, more);
      if (fits(plan, false, 1) && (!chosen || copies_ <= copiesAtOnce())) chosen = std::move(plan);
    }
    if (chosen) {
      fits(*chosen, false, 1);
      return *std::move(chosen);
    }
    throw Error(what,
                text("a body of ",
                     nodes_,
                     " points and ",
                     entries,
                     " blocks of the matrix does not fit into the shared memory of ",
                     blocks == 0 ? std::string("the GPU's blocks") : text(blocks, " blocks"),
                     "; take Simulation, whose memory is that of the GPU, or CudaVec3f for CudaVec3d"));
#else
    (void)blocks;
    FusedPlan plan(neighbours, 1);
    take(plan, 0);
    shape_.shared = sizes_.template shared<SerialTeam>();
    return plan;
#endif
  }
  void take(FusedPlan const& plan, int kept) {
    FusedPlan::Shared shared = plan.shared(kept);
    sharedFirst_ = std::move(shared.first);
    sizes_.rows = plan.rows;
    sizes_.widest = plan.widest;
    sizes_.entriesOfWidest = shared.most;
    sizes_.longestVector = plan.longestVector;
  }
  Body body(double dt, int steps) {
    Body b = sizes_;
    b.fields = std::apply([](auto&... data) { return std::make_tuple(data.view()...); }, fields_);
    b.order = std::as_const(order_).device();
    b.rowBegin = std::as_const(rowBegin_).device();
    b.entryFirst = std::as_const(entryFirst_).device();
    b.sharedFirst = std::as_const(sharedFirst_).device();
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
#if SINEW_CUDA
  auto clusterKernel() const {
    return shape_.lanes == 8   ? detail::fused_kernel<8, Body>
           : shape_.lanes == 4 ? detail::fused_kernel<4, Body>
           : shape_.lanes == 2 ? detail::fused_kernel<2, Body>
                               : detail::fused_kernel<1, Body>;
  }
  auto gridKernel() const {
    return shape_.lanes == 8   ? detail::fused_grid_kernel<8, Body>
           : shape_.lanes == 4 ? detail::fused_grid_kernel<4, Body>
                               : detail::fused_grid_kernel<2, Body>;
  }
  // `attribute` is what the configuration refers to
  template <class Kernel>
  cudaLaunchConfig_t configuration(Kernel kernel, cudaLaunchAttribute& attribute) const {
    char const* const what = "FusedSimulation";
    gpu::check(cudaFuncSetAttribute(kernel, cudaFuncAttributeMaxDynamicSharedMemorySize, int(shape_.shared)),
               what);
    cudaLaunchConfig_t config{};
    config.gridDim = dim3(unsigned(copies_ * shape_.blocks));
    config.blockDim = dim3(unsigned(shape_.threads));
    config.dynamicSmemBytes = shape_.shared;
    config.stream = stream();
    config.attrs = &attribute;
    config.numAttrs = shape_.blocks > 1;
    if (shape_.grid) {
      attribute.id = cudaLaunchAttributeCooperative;
      attribute.val.cooperative = 1;
    } else {
      if (shape_.blocks > 8)
        gpu::check(cudaFuncSetAttribute(kernel, cudaFuncAttributeNonPortableClusterSizeAllowed, 1), what);
      attribute.id = cudaLaunchAttributeClusterDimension;
      attribute.val.clusterDim.x = unsigned(shape_.blocks);
      attribute.val.clusterDim.y = attribute.val.clusterDim.z = 1;
    }
    return config;
  }
  // how many clusters of the shape the GPU runs at the same time
  int copiesAtOnce() const {
    cudaLaunchAttribute attribute{};
    const cudaLaunchConfig_t config = configuration(clusterKernel(), attribute);
    int count = 0;
    gpu::check(cudaOccupancyMaxActiveClusters(&count, clusterKernel(), &config), "FusedSimulation");
    return count;
  }
  template <class... Arguments>
  void launch(void (*kernel)(Arguments...), std::type_identity_t<Arguments>... arguments) const {
    cudaLaunchAttribute attribute{};
    const cudaLaunchConfig_t config = configuration(kernel, attribute);
    gpu::check(cudaLaunchKernelEx(&config, kernel, arguments...), "FusedSimulation::animate");
  }
#endif
};

}  // namespace sinew::gpu
