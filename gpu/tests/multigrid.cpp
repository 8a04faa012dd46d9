// SPDX-License-Identifier: BSL-1.0
// MultigridLinearSolver over points on the device, against that of the processor.
#include "catch.hpp"

#include <sinew/gpu/gpu.hpp>
#include <sinew/gpu/recorded_step.hpp>

#include <sinew/constraint/fixed_constraint.hpp>
#include <sinew/constraint/partial_fixed.hpp>
#include <sinew/constraint/project_to_plane.hpp>
#include <sinew/context/gravity.hpp>
#include <sinew/force/plane_force_field.hpp>
#include <sinew/force/tetrahedron_fem.hpp>
#include <sinew/mass/diagonal_mass.hpp>
#include <sinew/mass/uniform_mass.hpp>
#include <sinew/scene/simulation.hpp>
#include <sinew/solver/euler_implicit.hpp>
#include <sinew/solver/multigrid_linear_solver.hpp>
#include <sinew/solver/pcg_linear_solver.hpp>
#include <sinew/state/mechanical_object.hpp>
#include <sinew/topology/mesh_topology.hpp>
#include <sinew/topology/regular_grid.hpp>

#include <Eigen/Dense>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace test_gpu_multigrid {

using namespace sinew;
using Catch::Matchers::Contains;

namespace {

struct Beam {
  int cells = 4;
  bool held = true, rails = false, contrast = false, plane = false;
  double poisson = 0.3;
};

template <class D>
auto vectors(std::vector<Eigen::Vector3d> const& from) {
  typename D::VecCoord to;
  for (auto const& p : from) to.push_back(p.template cast<typename D::Real>());
  return to;
}

/// A beam, four times as long as wide, that is held at one end.
template <class D, class Linear>
auto scene(Beam const& beam, Linear linear) {
  const int n = beam.cells;
  const Mesh mesh = regular_grid_tetrahedra(4 * n + 1, n + 1, n + 1, {0, 0, 0}, {4, 1, 1});
  std::vector<int> fixed, rails;
  std::vector<typename D::Real> young;
  for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
    if (beam.held && mesh.positions[i][0] < 1e-9) fixed.push_back(int(i));
    if (beam.rails && mesh.positions[i][0] > 0.9 && mesh.positions[i][0] < 1.1) rails.push_back(int(i));
  }
  for (auto const& t : mesh.tetrahedra)
    young.push_back(typename D::Real(
        beam.contrast && int(4 * mesh.positions[std::size_t(t[0])][0]) % 2 == 0 ? 1e9 : 1e6));
  return Simulation{node<"root">(
      Gravity{{0, -9.81, 0}},
      EulerImplicitSolver{.rayleighStiffness = 0.01, .rayleighMass = 0.1},
      linear,
      MeshTopology{.tetrahedra = mesh.tetrahedra},
      MechanicalObject<D>{vectors<D>(mesh.positions)},
      DiagonalMass<D>{.massDensity = 1000},
      TetrahedronFEMForceField<D>{.youngModulus = {young.begin(), young.end()}, .poissonRatio = beam.poisson},
      PlaneForceField<D>{
          .normal = {0, 1, 0}, .d = beam.plane ? -0.05 : -1000, .stiffness = 1e4, .damping = 10},
      FixedConstraint<D>{.indices = fixed},
      PartialFixedConstraint<D>{.indices = rails, .fixedDirections = {true, false, false}})};
}

template <class Sim>
auto& solver_of(Sim& sim) {
  return sim.root().template get<MultigridLinearSolver<>>();
}
template <class Sim>
std::vector<double> velocities(Sim& sim) {
  std::vector<double> all;
  for (auto const& v : sim.root().state().velocity)
    for (int c = 0; c < 3; ++c) all.push_back(double(v[c]));
  return all;
}
double difference(std::vector<double> const& a, std::vector<double> const& b) {
  REQUIRE(a.size() == b.size());
  double off = 0, size = 0;
  for (std::size_t i = 0; i < a.size(); ++i) off += (a[i] - b[i]) * (a[i] - b[i]), size += b[i] * b[i];
  return std::sqrt(off / size);
}
template <class D, class Linear>
std::vector<double> course(Beam const& beam, Linear linear, int steps = 3) {
  auto sim = scene<D>(beam, linear);
  sim.init();
  for (int i = 0; i < steps; ++i) sim.animate(0.02);
  return velocities(sim);
}

struct Count {
  int iterations, levels;
  double residual;
};
template <class D>
Count count(Beam const& beam, MultigridLinearSolver<> linear = {}) {
  auto sim = scene<D>(beam, linear);
  sim.init();
  for (int i = 0; i < 3; ++i) sim.animate(0.02);
  auto const& residuals = solver_of(sim).residuals;
  int levels = solver_of(sim).multigrid.levels();
  if constexpr (OnDevice<D>) levels = sim.root().state().solverWorkspace.multigrid.cycle.levels();
  return {int(residuals.size()) - 1, levels, residuals.back()};
}

/// Solves are one kernel, where these are bodies of so many points at most; on the host by so many threads.
struct Whole {
  std::size_t points = gpu::most_points_of_whole_multigrid();
  explicit Whole(bool is) { gpu::most_points_of_whole_multigrid() = is ? 1000000 : 0; }
  Whole(Whole const&) = delete;
  ~Whole() { gpu::most_points_of_whole_multigrid() = points; }
};

}  // namespace

TEST_CASE("multigrid on the device finds what the processor's finds") {
  const bool whole = GENERATE(true, false);
  const Whole kernel(whole);
  for (const int coarsestSize : {30, 200, 100000})
    for (const Beam beam : {Beam{},
                            Beam{.held = false},
                            Beam{.rails = true},
                            Beam{.rails = true, .contrast = true},
                            Beam{.plane = true, .poisson = 0.45}}) {
      const MultigridLinearSolver<> linear{
          .iterations = 300, .tolerance = 1e-12, .coarsestSize = coarsestSize};
      INFO("coarsest " << coarsestSize << ", held " << beam.held << ", contrast " << beam.contrast);
      CHECK(difference(course<CudaVec3d>(beam, linear), course<Vec3d>(beam, linear)) < 1e-8);
    }
}

TEST_CASE("a cycle on the device is the processor's: as many iterations, flat with the mesh") {
  const bool whole = GENERATE(true, false);
  const Whole kernel(whole);
  for (const int cells : {4, 6, 10, 14}) {
    const Beam beam{.cells = cells};
    const Count device = count<CudaVec3d>(beam), host = count<Vec3d>(beam), floats = count<CudaVec3f>(beam);
    INFO(cells << " cells: " << device.iterations << " of the device, " << floats.iterations << " in float, "
               << host.iterations << " of the processor, levels " << device.levels);
    CHECK(device.residual <= 1e-6);
    CHECK(device.levels == host.levels);
    CHECK(std::abs(device.iterations - host.iterations) <= 1);
    CHECK(device.iterations <= 20);
    CHECK(floats.residual <= 1e-6);
    CHECK(floats.iterations <= device.iterations + 2);
  }
  const Beam hard{.cells = 6, .contrast = true};
  CHECK(std::abs(count<CudaVec3d>(hard).iterations - count<Vec3d>(hard).iterations) <= 2);
}

TEST_CASE("a cycle on the device has the same bits in two runs") {
  const Beam beam{.rails = true, .contrast = true};
  for (const bool whole : {true, false}) {
    const Whole kernel(whole);
    CHECK(course<CudaVec3d>(beam, MultigridLinearSolver<>{}, 10) ==
          course<CudaVec3d>(beam, MultigridLinearSolver<>{}, 10));
  }
}

TEST_CASE("a solve that is one kernel has the iterations and residuals of one with many") {
  for (const Beam beam : {Beam{}, Beam{.rails = true, .contrast = true}, Beam{.cells = 7, .poisson = 0.45}}) {
    auto run = [&](bool whole) {
      const Whole kernel(whole);
      auto sim = scene<CudaVec3d>(beam, MultigridLinearSolver<>{.coarsestSize = 60});
      sim.init();
      for (int i = 0; i < 3; ++i) sim.animate(0.02);
      return std::pair(std::vector(solver_of(sim).residuals), velocities(sim));
    };
    const auto one = run(true), many = run(false);
    REQUIRE(one.first.size() == many.first.size());
    for (std::size_t i = 0; i < one.first.size(); ++i)
      CHECK(one.first[i] == Approx(many.first[i]).epsilon(0.02));  // sums of the cycle are in float
    CHECK(difference(one.second, many.second) < 1e-6);
  }
#if !SINEW_CUDA
  // by several threads
  auto& threads = gpu::host_team_threads();
  const std::vector<double> alone = course<CudaVec3d>(Beam{}, MultigridLinearSolver<>{});
  threads = 3;
  const std::vector<double> three = course<CudaVec3d>(Beam{}, MultigridLinearSolver<>{});
  threads = 1;
  CHECK(difference(three, alone) < 1e-6);
#endif
}

TEST_CASE("the coarsest matrix is inverted") {
  for (const int n : {1, 3, 54, 64, 66, 128, 156, 198, 224, 231, 300}) {
    CAPTURE(n);
    // symmetric, positive definite, with unit diagonal
    Eigen::MatrixXd root(n, n);
    for (int i = 0; i < n; ++i)
      for (int j = 0; j < n; ++j) root(i, j) = std::sin(1 + 3.7 * i + 1.3 * j * j) + (i == j ? 4 : 0);
    Eigen::MatrixXd a = root * root.transpose();
    const Eigen::VectorXd scale = a.diagonal().cwiseSqrt().cwiseInverse();
    a = scale.asDiagonal() * a * scale.asDiagonal();
    auto inverted = [n](Eigen::MatrixXd of) {
      gpu::DeviceArray<double> there;
      there.resize(std::size_t(n) * std::size_t(n + 2));
      gpu::copy_to_device(there.data(), of.data(), std::size_t(n) * std::size_t(n));
      gpu::multigrid::invert(there.data(), n, there.data() + std::ptrdiff_t(n) * n);
      gpu::copy_to_host(of.data(), there.data(), std::size_t(n) * std::size_t(n));
      return of;
    };
    const double condition = a.norm() * a.inverse().norm();
    CHECK((inverted(a) * a - Eigen::MatrixXd::Identity(n, n)).norm() < 1e-14 * condition);
    if (n < 3) continue;
    // an unknown without a pivot gets nothing, and the others what they had without it
    Eigen::MatrixXd without = a;
    without.row(1).setZero(), without.col(1).setZero();
    const Eigen::MatrixXd inverse = inverted(without);
    CHECK(inverse.row(1).norm() + inverse.col(1).norm() == 0);
    Eigen::MatrixXd one = inverse * without;
    one(1, 1) += 1;
    CHECK((one - Eigen::MatrixXd::Identity(n, n)).norm() < 1e-14 * condition);
  }
}

TEST_CASE("a cycle on the device is kept, and its modes too") {
  const Beam beam{.cells = 5};
  const std::vector<double> exact =
      course<Vec3d>(beam, MultigridLinearSolver<>{.iterations = 300, .tolerance = 1e-12}, 12);
  for (const int refresh : {0, 1, 5})
    for (const bool updateModes : {true, false})
      CHECK(difference(course<CudaVec3d>(beam,
                                         MultigridLinearSolver<>{.iterations = 300,
                                                                 .tolerance = 1e-12,
                                                                 .refresh = refresh,
                                                                 .updateModes = updateModes},
                                         12),
                       exact) < 1e-8);
}

TEST_CASE("in a step with multigrid on the device only held points and residuals cross") {
  auto sim = scene<CudaVec3d>(Beam{}, MultigridLinearSolver<>{});
  sim.init();
  for (int i = 0; i < 3; ++i) sim.animate(0.02);
  gpu::transfers() = {};
  for (int i = 0; i < 3; ++i) sim.animate(0.02);
  CHECK(gpu::transfers().toHost + gpu::transfers().toDevice == 0);
}

TEST_CASE("points that come to be held have another hierarchy on the device") {
  auto fix = [](auto& sim, std::vector<int> indices) {
    auto& constraint =
        sim.root()
            .template get<FixedConstraint<typename std::decay_t<decltype(sim.root().state())>::DataTypes>>();
    constraint.indices = {indices.begin(), indices.end()};
  };
  auto run = [&]<class D>(D) {
    auto sim = scene<D>(Beam{}, MultigridLinearSolver<>{.iterations = 300, .tolerance = 1e-12});
    sim.init();
    sim.animate(0.02);
    std::vector<int> some;
    for (int i = 0; i < 100; ++i) some.push_back(i);
    fix(sim, some);
    sim.animate(0.02);
    sim.animate(0.02);
    return velocities(sim);
  };
  CHECK(difference(run(CudaVec3d{}), run(Vec3d{})) < 1e-8);
}

TEST_CASE("several bodies under multigrid on the device, and what it leaves to the host") {
  auto two = []<class D>(D, bool mixed) {
    const Mesh mesh = regular_grid_tetrahedra(5, 3, 3, {0, 0, 0}, {2, 1, 1});
    auto body = [&](double young) {
      return std::tuple(MeshTopology{.tetrahedra = mesh.tetrahedra},
                        MechanicalObject<D>{vectors<D>(mesh.positions)},
                        UniformMass<D>{.totalMass = 100},
                        TetrahedronFEMForceField<D>{.youngModulus = {young}, .poissonRatio = 0.3},
                        FixedConstraint<D>{.indices = {0, 5, 10}});
    };
    const ProjectToPlaneConstraint<D> plane{.indices = mixed ? std::vector<int>{44} : std::vector<int>{},
                                            .origin = {2, 1, 1},
                                            .normal = {1, 1, 0}};
    Simulation sim{
        node<"root">(Gravity{{0, -9.81, 0}},
                     EulerImplicitSolver{.rayleighStiffness = 0.01},
                     MultigridLinearSolver<>{.iterations = 300, .tolerance = 1e-12, .coarsestSize = 30},
                     std::apply([](auto... c) { return node<"a">(c...); }, body(1e6)),
                     std::apply([&](auto... c) { return node<"b">(c..., plane); }, body(1e5)))};
    sim.init();
    for (int i = 0; i < 5; ++i) sim.animate(0.02);
    std::vector<double> all;
    for (auto const& x : sim.template at<"a">().state().position)
      for (int c = 0; c < 3; ++c) all.push_back(x[c]);
    for (auto const& x : sim.template at<"b">().state().position)
      for (int c = 0; c < 3; ++c) all.push_back(x[c]);
    return std::pair(all, solver_of(sim).onStates);
  };
  for (const bool mixed : {false, true}) {
    const auto device = two(CudaVec3d{}, mixed), host = two(Vec3d{}, mixed);
    CHECK(difference(device.first, host.first) < 1e-9);
    CHECK(device.second == !mixed);
    CHECK(!host.second);
  }
  // a cycle that turns
  auto sim =
      scene<CudaVec3d>(Beam{}, MultigridLinearSolver<>{.tolerance = 1e-12, .refresh = 5, .warp = true});
  sim.init();
  for (int i = 0; i < 3; ++i) sim.animate(0.02);
  CHECK(!solver_of(sim).onStates);
  CHECK(difference(velocities(sim), course<Vec3d>(Beam{}, MultigridLinearSolver<>{.tolerance = 1e-12})) <
        1e-8);
}

TEST_CASE("a step with multigrid on the device is not recorded") {
  auto sim = scene<CudaVec3d>(Beam{.held = false}, MultigridLinearSolver<>{});
  sim.init();
  CHECK_THROWS_WITH(gpu::RecordedStep(sim, 0.02), Contains("animate() the simulation"));
}

TEST_CASE("what is not finite is said by the state, with multigrid on the device too") {
  auto sim = scene<CudaVec3d>(Beam{}, MultigridLinearSolver<>{});
  sim.init();
  sim.animate(0.02);
  sim.root().state().velocity[7][1] = std::numeric_limits<double>::quiet_NaN();
  CHECK_THROWS_WITH(sim.animate(0.02), Contains("not a finite number"));
  const Whole kernel(false);
  auto other = scene<CudaVec3d>(Beam{}, MultigridLinearSolver<>{});
  other.init();
  other.animate(0.02);
  other.root().state().velocity[7][1] = std::numeric_limits<double>::quiet_NaN();
  CHECK_THROWS_WITH(other.animate(0.02), Contains("not a finite number"));
}

}  // namespace test_gpu_multigrid
