// SPDX-License-Identifier: BSL-1.0
// A body over several devices, and copies over several, against one. On Thrust's backends for the host parts
// are one after the other in one thread; on a GPU they are on all there are, and on the first twice.
#include "catch.hpp"

#include <sinew/constraint/partial_fixed.hpp>
#include <sinew/force/plane_force_field.hpp>
#include <sinew/force/stiff_spring.hpp>
#include <sinew/force/tetrahedron_fem.hpp>
#include <sinew/gpu/distributed/copies.hpp>
#include <sinew/gpu/distributed/simulation.hpp>
#include <sinew/mass/diagonal_mass.hpp>
#include <sinew/mass/uniform_mass.hpp>
#include <sinew/state/mechanical_object.hpp>
#include <sinew/topology/regular_grid.hpp>
#include <sinew/topology/tetrahedron_topology.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>
#include <vector>

namespace test_gpu_distributed {

using namespace sinew;
using Catch::Matchers::Contains;

namespace {

constexpr double dt = 0.02;

// those that a test goes through: on a machine with several GPUs all of these, too
std::vector<std::vector<int>> teams() {
  std::vector<std::vector<int>> all{{0}, {0, 0}, {0, 0, 0, 0, 0}};
  const std::vector<int> each = gpu::all_devices();
  if (each.size() > 1) all.push_back(each);
  return all;
}

struct Settings {
  double young = 1e5, gravity = -9.81, tolerance = 0;
  int iterations = 200;
  bool held = true;
};

template <class D>
typename D::VecCoord points(Mesh const& mesh) {
  typename D::VecCoord all;
  for (auto const& p : mesh.positions) all.push_back(p.template cast<typename D::Real>());
  return all;
}
Mesh mesh() { return regular_grid_tetrahedra(11, 4, 4, {0, 0, 0}, {3, 1, 1}); }

// a bar that is held at one end and bends down to a plane, with springs from end to end
template <class D, class Ode, class... Linear>
auto bar(Settings const& s, Ode ode, Linear... linear) {
  const Mesh of = mesh();
  std::vector<int> fixed, sliding;
  for (std::size_t i = 0; i < of.positions.size(); ++i)
    if (s.held && of.positions[i][0] < 0.01) (of.positions[i][1] < 0.01 ? fixed : sliding).push_back(int(i));
  Simulation sim{node<"root">(
      Gravity{{0, s.gravity, 0}},
      ode,
      linear...,
      node<"bar">(
          TetrahedronTopology{of.tetrahedra},
          MechanicalObject<D>{.position = points<D>(of)},
          DiagonalMass<D>{.massDensity = 1000},
          TetrahedronFEMForceField<D>{.youngModulus = {s.young}, .poissonRatio = 0.4},
          PlaneForceField<D>{.d = -0.5, .stiffness = s.held ? 5000. : 0., .damping = s.held ? 100. : 0.},
          StiffSpringForceField<D>{{{0, 10, 500, 5, {}}, {3, 170, 500, 5, {}}}},
          FixedConstraint<D>{.indices = fixed},
          PartialFixedConstraint<D>{.indices = sliding, .fixedDirections = {1, 0, 1}}))};
  sim.init();
  return sim;
}
template <class D>
auto implicit_bar(Settings const& s = {}) {
  return bar<D>(
      s,
      EulerImplicitSolver{.rayleighStiffness = 0.01, .rayleighMass = 0.1, .vdamping = 0.2},
      CGLinearSolver<CompressedRowSparseMatrixMat3x3d>{.iterations = s.iterations, .tolerance = s.tolerance});
}
template <class D>
auto explicit_bar(Settings const& s = {}, bool symplectic = true) {
  return bar<D>(s, EulerExplicitSolver{.symplectic = symplectic});
}

// (nvcc cannot spell the type of a scene in a function that is no template)
template <class Root>
gpu::DistributedSimulation<Root> parts_of(Simulation<Root>& sim, std::vector<int> devices) {
  return gpu::DistributedSimulation<Root>(sim, std::move(devices));
}

template <class Sim>
auto const& positions(Sim& sim) {
  return std::as_const(sim.template at<"bar">().state()).position;
}
template <class Sim>
auto const& velocities(Sim& sim) {
  return std::as_const(sim.template at<"bar">().state()).velocity;
}
// largest distance of two bodies, over the size of the body
template <class X, class Y>
double difference(X const& x, Y const& y) {
  REQUIRE(x.size() == y.size());
  double far = 0;
  for (std::size_t i = 0; i < x.size(); ++i) {
    const double d = double((x[i].template cast<double>() - y[i].template cast<double>()).norm());
    far = d <= far ? far : d;  // a NaN stays
  }
  return far / 3;
}
template <class Sim>
void walk(Sim& sim, int n, double h = dt) {
  for (int i = 0; i < n; ++i) sim.animate(h);
}

}  // namespace

TEST_CASE("a body is cut into parts that have all that acts on their points") {
  const Mesh of = mesh();
  for (const std::size_t count : {1u, 2u, 3u, 7u}) {
    const gpu::BodyPartition cut(of.positions, count, [&](auto&& f) {
      for (auto const& t : of.tetrahedra) f(t);
    });
    std::vector<std::set<int>> neighbours(of.positions.size());
    for (auto const& t : of.tetrahedra)
      for (const int i : t)
        for (const int j : t) neighbours[std::size_t(i)].insert(j);
    std::vector<int> owners(of.positions.size(), 0);
    std::size_t largest = 0, smallest = of.positions.size();
    for (std::size_t p = 0; p < count; ++p) {
      auto const& part = cut.parts[p];
      largest = std::max(largest, std::size_t(part.own));
      smallest = std::min(smallest, std::size_t(part.own));
      std::set<int> own, needed;
      for (int i = 0; i < part.own; ++i) {
        const int point = part.points[std::size_t(i)];
        ++owners[std::size_t(point)];
        own.insert(point);
        CHECK(cut.part(point) == p);
        // inner points are in no halo, others are where it is said
        bool seen = false;
        for (const int j : neighbours[std::size_t(point)]) {
          needed.insert(j);
          seen = seen || cut.part(j) != p;
        }
        CHECK(seen == (i >= part.inner));
        if (i < part.inner) continue;
        std::set<std::size_t> there, wanted;
        for (int k = part.first[std::size_t(i - part.inner)]; k < part.first[std::size_t(i - part.inner) + 1];
             ++k) {
          auto const& place = part.places[std::size_t(k)];
          auto const& other = cut.parts[std::size_t(place.part)];
          CHECK(place.point >= other.own);
          CHECK(other.points[std::size_t(place.point)] == point);
          there.insert(std::size_t(place.part));
        }
        for (const int j : neighbours[std::size_t(point)])
          if (cut.part(j) != p) wanted.insert(cut.part(j));
        CHECK(there == wanted);
      }
      for (const int i : own) needed.erase(i);
      CHECK(std::set<int>(part.points.begin() + part.own, part.points.end()) == needed);
    }
    CHECK(std::count(owners.begin(), owners.end(), 1) == std::ptrdiff_t(owners.size()));
    CHECK(largest - smallest <= 1 + count / 2);
  }
}

TEMPLATE_TEST_CASE("an implicit step over several devices is that of the Simulation", "", CudaVec3d,
                   CudaVec3f) {
  using D = TestType;
  constexpr bool single = sizeof(typename D::Real) == 4;
  const Settings s{.iterations = single ? 60 : 300};
  auto alone = implicit_bar<D>(s);
  walk(alone, 60);
  REQUIRE(difference(positions(alone), alone.template at<"bar">().state().restPosition) > 0.05);
  for (auto const& devices : teams()) {
    INFO(devices.size() << " parts");
    auto sim = implicit_bar<D>(s);
    gpu::DistributedSimulation parts(sim, devices);
    CHECK(parts.parts() == devices.size());
    parts.animate(dt, 25);
    parts.animate(dt, 35);
    parts.finish();
    parts.store(sim);
    CHECK(difference(positions(sim), positions(alone)) < (single ? 2e-5 : 1e-10));
    CHECK(difference(velocities(sim), velocities(alone)) < (single ? 2e-4 : 1e-9));
    CHECK(sim.step() == 60);
    CHECK(sim.time() == Approx(60 * dt));

    // again: the same bits
    auto again = implicit_bar<D>(s);
    gpu::DistributedSimulation second(again, devices);
    second.animate(dt, 60);
    second.store(again);
    CHECK(positions(again) == positions(sim));
  }
}

TEST_CASE("conjugate gradients over several devices end at their tolerance") {
  auto reference = implicit_bar<CudaVec3d>({.iterations = 400});
  walk(reference, 10);
  std::vector<double> off;
  for (const double tolerance : {1e-2, 1e-5, 1e-8}) {
    auto sim = implicit_bar<CudaVec3d>({.tolerance = tolerance, .iterations = 400});
    gpu::DistributedSimulation parts(sim, {0, 0, 0});
    parts.animate(dt, 10);
    parts.store(sim);
    off.push_back(difference(velocities(sim), velocities(reference)));
  }
  CHECK(off[0] > 1e-7);
  CHECK(off[1] < 1e-2 * off[0]);
  CHECK(off[2] < 1e-8);
}

TEST_CASE("an explicit step over several devices is that of the Simulation") {
  constexpr double small = 2e-4;
  for (const bool symplectic : {true, false}) {
    auto alone = explicit_bar<CudaVec3d>({}, symplectic);
    walk(alone, 400, small);
    REQUIRE(difference(positions(alone), alone.at<"bar">().state().restPosition) > 0.005);
    for (auto const& devices : teams()) {
      auto sim = explicit_bar<CudaVec3d>({}, symplectic);
      gpu::DistributedSimulation parts(sim, devices);
      parts.animate(small, 400);
      parts.finish();
      parts.store(sim);
      CHECK(difference(positions(sim), positions(alone)) < 1e-12);
      CHECK(difference(velocities(sim), velocities(alone)) < 1e-11);
    }
  }
}

TEST_CASE("momentum and the centre of mass of a free body over several devices") {
  // internal forces have none, across the borders of parts either: all falls with g, to rounding
  auto sim = explicit_bar<CudaVec3d>({.held = false});
  auto& state = sim.at<"bar">().state();
  for (std::size_t i = 0; i < state.size(); ++i) state.velocity[i] = {0, 0.3 * std::sin(double(i)), 0};
  auto const& mass = sim.at<"bar">().get<DiagonalMass<CudaVec3d>>().lumped;
  auto momentum = [&] {
    Eigen::Vector3d sum = Eigen::Vector3d::Zero();
    for (std::size_t i = 0; i < state.size(); ++i) sum += mass.at(i) * velocities(sim)[i];
    return sum;
  };
  const Eigen::Vector3d before = momentum();
  gpu::DistributedSimulation parts(sim, {0, 0, 0});
  parts.animate(2e-4, 300);
  parts.store(sim);
  const Eigen::Vector3d gained = momentum() - before,
                        expected(0, -9.81 * 0.06 * mass.totalMass(state.size()), 0);
  CHECK((gained - expected).norm() < 1e-10 * expected.norm());
}

TEST_CASE("parts take what a simulation has, and go on with it") {
  const Settings stiff{.young = 4e5, .gravity = -1.6};
  auto host = implicit_bar<CudaVec3d>(stiff);
  walk(host, 20);
  auto start = implicit_bar<CudaVec3d>(), other = implicit_bar<CudaVec3d>(stiff);
  gpu::DistributedSimulation parts(start, {0, 0});
  parts.animate(dt, 5);
  parts.load(other);
  parts.animate(dt, 12);
  parts.finish();
  parts.store(other);
  walk(other, 8);  // and on with the Simulation's own step
  CHECK(other.step() == 20);
  CHECK(difference(positions(other), positions(host)) < 1e-10);
  CHECK(difference(positions(start), positions(host)) > 1e-3);
}

TEST_CASE("what a body over several devices cannot do is said") {
  auto sim = implicit_bar<CudaVec3d>();
  CHECK_THROWS_WITH(parts_of(sim, std::vector<int>{}), Contains("give one at least"));
  CHECK_THROWS_WITH(parts_of(sim, {0, 99}), Contains("no GPU 99"));
  CHECK_THROWS_WITH(parts_of(sim, {-1}), Contains("no GPU -1"));
  CHECK_THROWS_WITH(parts_of(sim, std::vector<int>(17, 0)), Contains("17 devices"));
  gpu::DistributedSimulation parts(sim, {0, 0});
  CHECK_THROWS_WITH(parts.animate(0), Contains("greater than 0"));
  CHECK_THROWS_WITH(parts.animate(std::nan("")), Contains("finite"));
  CHECK_THROWS_WITH(parts.animate(dt, -1), Contains("-1 steps"));
  auto& ode = sim.root().get<EulerImplicitSolver>();
  ode.firstOrder = true;
  CHECK_THROWS_WITH(
      parts.load(sim),
      Contains("EulerImplicitSolver: firstOrder") && Contains("all that DistributedSimulation knows"));
  ode.firstOrder = false;
  parts.animate(dt, 3);  // nothing was lost by the errors
  parts.finish();
  CHECK(parts.step() == 3);

  sim.at<"bar">().state().velocity[100][0] = std::numeric_limits<double>::infinity();
  parts.load(sim);
  parts.animate(dt, 2);
  CHECK_THROWS_WITH(parts.finish(), Contains("point ") && Contains("not a finite number"));
  sim.at<"bar">().state().position[7][0] = std::numeric_limits<double>::quiet_NaN();
  CHECK_THROWS_WITH(parts_of(sim, {0, 0}), Contains("point 7") && Contains("not a finite number"));
}

TEST_CASE("a body of fewer points than parts is refused") {
  Simulation sim{node<"root">(Gravity{},
                              EulerExplicitSolver{},
                              node<"bar">(MechanicalObject<CudaVec3d>{.position = {{0, 0, 0}, {1, 0, 0}}},
                                          UniformMass<CudaVec3d>{.totalMass = 1}))};
  sim.init();
  CHECK_THROWS_WITH(parts_of(sim, {0, 0, 0}), Contains("2 points") && Contains("3 devices"));
  // points without elements fall
  gpu::DistributedSimulation parts(sim, {0, 0});
  parts.animate(0.1);
  parts.store(sim);
  CHECK(positions(sim)[1][1] == Approx(-9.81 * 0.01));
}

TEST_CASE("copies over several devices are those of one") {
  auto one = [](Settings const& s) {
    return bar<CudaVec3d>(s,
                          EulerImplicitSolver{.rayleighStiffness = 0.01, .rayleighMass = 0.1},
                          CGLinearSolver<>{.iterations = 100, .tolerance = 0});
  };
  const Settings plain{}, stiff{.young = 4e5, .gravity = -1.6};
  auto first = one(plain), second = one(stiff);
  gpu::FusedSimulation alone(first, 2);
  alone.load(1, second);
  alone.animate(dt, 30);
  alone.finish();
  auto soft = one(plain), hard = one(stiff);
  alone.store(0, soft);
  alone.store(1, hard);
  for (auto const& devices : teams()) {
    gpu::DistributedCopies copies(first, 7, devices);
    for (const int c : {1, 3, 6}) copies.load(c, second);
    copies.animate(dt, 10);
    copies.animate(dt, 20);
    copies.finish();
    auto result = one(plain);
    for (int c = 0; c < 7; ++c) {
      copies.store(c, result);
      const bool is = c == 1 || c == 3 || c == 6;
      CHECK(difference(positions(result), positions(is ? hard : soft)) < 1e-10);
    }
    CHECK_THROWS_WITH(copies.load(7, second), Contains("no copy 7"));
    auto broken = one(plain);
    broken.at<"bar">().state().velocity[5][0] = std::numeric_limits<double>::infinity();
    copies.load(6, broken);
    copies.animate(dt, 2);
    CHECK_THROWS_WITH(copies.finish(), Contains("whose first copy is") && Contains("not a finite number"));
  }
  CHECK_THROWS_WITH(gpu::DistributedCopies(first, 1, {0, 0}), Contains("1 copies are to be on 2 devices"));
}

}  // namespace test_gpu_distributed
