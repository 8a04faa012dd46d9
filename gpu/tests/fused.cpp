// SPDX-License-Identifier: BSL-1.0
// The fused step and the recorded one, against the steps of Simulation.
#include "catch.hpp"

#include <sinew/constraint/partial_fixed.hpp>
#include <sinew/force/plane_force_field.hpp>
#include <sinew/force/regular_grid_spring.hpp>
#include <sinew/force/stiff_spring.hpp>
#include <sinew/force/tetrahedron_fem.hpp>
#include <sinew/gpu/fused/simulation.hpp>
#include <sinew/gpu/recorded_step.hpp>
#include <sinew/mass/diagonal_mass.hpp>
#include <sinew/mass/uniform_mass.hpp>
#include <sinew/state/mechanical_object.hpp>
#include <sinew/topology/regular_grid.hpp>
#include <sinew/topology/regular_grid_topology.hpp>
#include <sinew/topology/tetrahedron_topology.hpp>

namespace test_fused {

using namespace sinew;
using Catch::Matchers::Contains;

namespace {

struct Settings {
  double youngModulus = 1e5, gravity = -9.81, tolerance = 0;
};

// a bar that is held at one end and bends down to a plane, with a few springs across it
template <class D>
auto bar(Settings const& s = {}) {
  const Mesh mesh = regular_grid_tetrahedra(7, 3, 3, {0, 0, 0}, {3, 1, 1});
  std::vector<int> fixed, sliding;
  for (std::size_t i = 0; i < mesh.positions.size(); ++i)
    if (mesh.positions[i][0] < 0.01) (mesh.positions[i][1] < 0.01 ? fixed : sliding).push_back(int(i));
  typename D::VecCoord points;
  for (auto const& p : mesh.positions) points.push_back(p.template cast<typename D::Real>());
  Simulation sim{node<"root">(
      Gravity{{0, s.gravity, 0}},
      EulerImplicitSolver{.rayleighStiffness = 0.01, .rayleighMass = 0.1, .vdamping = 0.2},
      CGLinearSolver<>{.iterations = 25, .tolerance = s.tolerance},
      node<"bar">(TetrahedronTopology{mesh.tetrahedra},
                  MechanicalObject<D>{.position = points},
                  DiagonalMass<D>{.massDensity = 1000},
                  TetrahedronFEMForceField<D>{.youngModulus = {s.youngModulus}, .poissonRatio = 0.4},
                  PlaneForceField<D>{.d = -0.5, .stiffness = 5000, .damping = 100},
                  StiffSpringForceField<D>{{{0, 30, 500, 5, {}}, {3, 60, 500, 5, {}}}},
                  FixedConstraint<D>{.indices = fixed},
                  PartialFixedConstraint<D>{.indices = sliding, .fixedDirections = {1, 0, 1}}))};
  sim.init();
  return sim;
}

// a grid of springs alone, held at one end, that bends down to the plane; solved to the end, since a solution
// that is cut off carries rounding along
template <class D>
auto net() {
  Simulation sim{node<"root">(Gravity{},
                              EulerImplicitSolver{.rayleighStiffness = 0.01, .rayleighMass = 0.1},
                              CGLinearSolver<>{.iterations = 60, .tolerance = 0},
                              node<"bar">(RegularGridTopology{.n = {7, 4, 4}, .max = {3, 1, 1}},
                                          MechanicalObject<D>{},
                                          UniformMass<D>{.totalMass = 10},
                                          RegularGridSpringForceField<D>{.stiffness = 50, .damping = 1},
                                          PlaneForceField<D>{.d = -0.5, .stiffness = 500, .damping = 10},
                                          FixedConstraint<D>{.indices = {0, 7, 14, 21, 28, 56, 84}}))};
  sim.init();
  return sim;
}

template <class Sim>
auto const& positions(Sim& sim) {
  return std::as_const(sim.template at<"bar">().state()).position;
}
// largest distance of two bodies, over the size of the body
template <class X, class Y>
double difference(X const& x, Y const& y) {
  double far = 0;
  for (std::size_t i = 0; i < x.size(); ++i)
    far = std::max(far, double((x[i].template cast<double>() - y[i].template cast<double>()).norm()));
  return far / 3;
}

constexpr double dt = 0.02;
constexpr int steps = 100;

template <class Sim>
void walk(Sim& sim, int n = steps) {
  for (int i = 0; i < n; ++i) sim.animate(dt);
}

}  // namespace

TEST_CASE("the fused step is that of the Simulation", "[long]") {
  auto host = bar<Vec3d>();
  walk(host);
  REQUIRE(difference(positions(host), host.at<"bar">().state().restPosition) > 0.05);
  // of a copy: chosen, one block, clusters, blocks of a launch, all of a GPU; on the host they are all one
  // thread
  const int blocks = GENERATE(0, 1, 2, 4, 8, 20, 1000);
  DYNAMIC_SECTION("blocks " << blocks) {
    auto sim = bar<CudaVec3d>();
    gpu::FusedSimulation fused(sim, 1, blocks);
    fused.animate(dt, 60);
    fused.animate(dt, steps - 60);
    fused.finish();
    fused.store(0, sim);
    CHECK(difference(positions(sim), positions(host)) < 1e-10);
    CHECK(sim.step() == steps);
    CHECK(sim.time() == Approx(steps * dt));

    // step by step and again: the same bits
    auto again = bar<CudaVec3d>();
    gpu::FusedSimulation second(again, 1, blocks);
    for (int i = 0; i < steps; ++i) second.animate(dt);
    second.finish();
    second.store(0, again);
    CHECK(positions(again) == positions(sim));
    // and on with the Simulation's own step
    walk(sim, 1);
    walk(again, 1);
    CHECK(positions(again) == positions(sim));
  }
}

TEST_CASE("the fused step of springs, whose rows find their forces themselves", "[long]") {
  auto host = net<Vec3d>();
  walk(host);
  REQUIRE(difference(positions(host), host.at<"bar">().state().restPosition) > 0.05);
  const int blocks = GENERATE(0, 1, 4, 1000);
  DYNAMIC_SECTION("blocks " << blocks) {
    auto sim = net<CudaVec3d>(), again = net<CudaVec3d>();
    gpu::FusedSimulation fused(sim, 1, blocks), second(again, 1, blocks);
    fused.animate(dt, steps);
    fused.finish();
    fused.store(0, sim);
    CHECK(difference(positions(sim), positions(host)) < 1e-10);
    for (int i = 0; i < steps; ++i) second.animate(dt);
    second.finish();
    second.store(0, again);
    CHECK(positions(again) == positions(sim));
  }
}

TEST_CASE("the fused step in float") {
  auto exact = bar<Vec3d>(), first = bar<Vec3d>();
  auto host = bar<Vec3f>();
  auto sim = bar<CudaVec3f>();
  walk(exact);
  walk(host);
  gpu::FusedSimulation fused(sim);
  fused.animate(dt, steps);
  fused.finish();
  fused.store(0, sim);
  // CG in float is off by its residual, which pipelining lets drift by some iterations' rounding more
  const double rounding = difference(positions(host), positions(exact));
  CHECK(rounding < 1e-4);
  CHECK(difference(positions(sim), positions(exact)) < 10 * rounding);
}

TEST_CASE("the fused step ends iterations as CGLinearSolver does") {
  const Settings early{.tolerance = 1e-3};
  auto host = bar<Vec3d>(early);
  auto sim = bar<CudaVec3d>(early);
  walk(host, 20);
  gpu::FusedSimulation fused(sim);
  fused.animate(dt, 20);
  fused.store(0, sim);
  CHECK(difference(positions(sim), positions(host)) < 1e-10);
  auto full = bar<Vec3d>();
  walk(full, 20);
  CHECK(difference(positions(full), positions(host)) > 1e-9);  // it ended early
}

TEST_CASE("copies of a scene have their own material, gravity and state", "[long]") {
  auto plain = bar<Vec3d>(), stiff = bar<Vec3d>({.youngModulus = 3e5}), moon = bar<Vec3d>({.gravity = -1.62});
  auto sim = bar<CudaVec3d>(), stiffSim = bar<CudaVec3d>({.youngModulus = 3e5}),
       moonSim = bar<CudaVec3d>({.gravity = -1.62});
  walk(moon, 10);
  walk(moonSim, 10);
  for (const int blocks : {0, 1, 4}) {
    gpu::FusedSimulation fused(sim, 37, blocks);
    fused.load(3, stiffSim);
    fused.load(36, moonSim);
    fused.animate(dt, 50);
    fused.finish();
    if (blocks == 0) {
      walk(plain, 50);
      walk(stiff, 50);
      walk(moon, 50);
    }
    auto result = bar<CudaVec3d>();
    auto same = [&](int copy, auto& host) {
      fused.store(copy, result);
      return difference(positions(result), positions(host)) < 1e-10;
    };
    for (const int copy : {0, 1, 2, 4, 20, 35}) CHECK(same(copy, plain));
    CHECK(same(3, stiff));
    CHECK(same(36, moon));
    CHECK_FALSE(same(3, plain));
  }
}

TEST_CASE("a recorded step is a step") {
  auto sim = bar<CudaVec3d>(), recordedSim = bar<CudaVec3d>();
  walk(sim, 21);
  gpu::RecordedStep recorded(recordedSim, dt);  // makes the first
  recorded.animate(15);
  recorded.animate(5);
  recorded.finish();
  CHECK(positions(recordedSim) == positions(sim));
  CHECK(recordedSim.step() == 21);
  CHECK(recordedSim.time() == Approx(21 * dt));
}

TEST_CASE("what a fused step cannot do is said") {
  auto sim = bar<CudaVec3d>();
  gpu::FusedSimulation fused(sim, 2);
  CHECK_THROWS_WITH(fused.store(2, sim), Contains("no copy 2") && Contains("numbered from 0"));
  CHECK_THROWS_WITH(fused.load(-1, sim), Contains("no copy -1"));
  CHECK_THROWS_WITH(fused.animate(0), Contains("greater than 0"));
  CHECK_THROWS_WITH(fused.animate(std::nan("")), Contains("finite"));
  CHECK_THROWS_WITH(fused.animate(dt, -1), Contains("-1 steps"));
  CHECK_THROWS_WITH(gpu::FusedSimulation(sim, 0), Contains("0 copies"));
  // nothing was lost by the errors
  fused.animate(dt, 3);
  fused.finish();
  CHECK(fused.step() == 3);

  SECTION("a simulation that diverges") {
    auto broken = bar<CudaVec3d>();
    broken.at<"bar">().state().velocity[5][0] = std::numeric_limits<double>::infinity();
    fused.load(1, broken);
    fused.animate(dt, 5);
    CHECK_THROWS_WITH(fused.finish(), Contains("copy 1") && Contains("not a finite number"));
    // the other copy went on
    fused.store(0, sim);
    for (auto const& x : positions(sim)) CHECK(x.allFinite());
  }
}

TEST_CASE("a field that the fused step does not honour must have its default") {
  auto sim = bar<CudaVec3d>();
  auto& solver = sim.root().get<EulerImplicitSolver>();
  auto& linear = sim.root().get<CGLinearSolver<>>();
  auto& fixed = sim.at<"bar">().get<FixedConstraint<CudaVec3d>>();
  auto& sliding = sim.at<"bar">().get<PartialFixedConstraint<CudaVec3d>>();
  gpu::FusedSimulation fused(sim);
  auto refused = [&](auto& field, auto value, std::string const& component, std::string const& name) {
    const auto plain = std::exchange(field, value);
    INFO(component << ": " << name);
    const std::string said = component + ": " + name + " (";
    CHECK_THROWS_WITH(gpu::FusedSimulation(sim), Contains(said) && Contains("take Simulation"));
    CHECK_THROWS_WITH(fused.load(0, sim), Contains(said) && Contains("take Simulation"));
    field = plain;
  };
  const std::string euler = "EulerImplicitSolver", cg = component_name<CGLinearSolver<>>();
  refused(solver.firstOrder, true, euler, "firstOrder");
  refused(solver.trapezoidalScheme, true, euler, "trapezoidalScheme");
  refused(solver.maxNbIterationsNewton, 3, euler, "maxNbIterationsNewton");
  refused(solver.maxNbIterationsLineSearch, 5, euler, "maxNbIterationsLineSearch");
  refused(solver.lineSearchCoefficient, 0.25, euler, "lineSearchCoefficient");
  refused(linear.warmStart, true, cg, "warmStart");
  refused(fixed.activateProjectVelocity, true, "FixedConstraint<CudaVec3d>", "activate_projectVelocity");
  refused(sliding.activateProjectVelocity, true, "PartialFixedConstraint<CudaVec3d>", "projectVelocity");
  // those that it honours, and those of components that it does not run, are free
  solver.vdamping = 0.7;
  linear.threshold = 1e-30;
  sliding.fixedDirections = {0, 1, 0};
  sim.at<"bar">().get<TetrahedronFEMForceField<CudaVec3d>>().poissonRatio = 0.3;
  gpu::FusedSimulation again(sim);
  again.animate(dt, 2);
  again.finish();
}

}  // namespace test_fused
