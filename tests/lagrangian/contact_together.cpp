// SPDX-License-Identifier: BSL-1.0
// Contacts by multipliers together with what else a scene may have: explicit solvers, statics, self-contact,
// springs of the mouse.
#include "lagrangian/contact_scenes.hpp"

#include <sinew/topology/regular_grid.hpp>

#include <algorithm>

namespace test_contact_together {

using namespace sinew;
using Eigen::Vector3d;

namespace {

constexpr double dt = 0.01;

template <class Ode, class... More>
auto block(Mesh const& mesh, double young, double mass, Ode ode, More... more) {
  return node<"block">(ode,
                       more...,
                       TetrahedronTopology{mesh.tetrahedra},
                       MechanicalObject<Vec3d>{mesh.positions},
                       UniformMass<Vec3d>{.totalMass = mass},
                       TetrahedronFEMForceField<Vec3d>{.youngModulus = {young}, .poissonRatio = 0.3},
                       TriangleCollisionModel<Vec3d>{.bothSide = false},
                       PointCollisionModel<Vec3d>{});
}
const BlockGaussSeidelConstraintSolver gaussSeidel{.maxIterations = 5000, .tolerance = 1e-8};
const ConvexConstraintSolver convex{.tolerance = 1e-8, .momentumTolerance = 1e-8, .maxUpdates = 200};

}  // namespace

TEST_CASE("explicit solvers: a soft block lands on the floor, which has its weight at the end", "[long]") {
  // the time step is a tenth of what 1e4 Pa and 1000 kg/m^3 allow for cells of 0.1 m
  const Mesh mesh = regular_grid_tetrahedra(4, 4, 3, {-0.15, -0.15, 0.02}, {0.15, 0.15, 0.22});
  auto lands = [&](auto solver, auto ode, double tolerance) {
    auto sim = constrained_scene_by(
        solver,
        near_by(),
        0.3,
        fixed_floor(),
        block(mesh, 1e4, 18, ode, UniformVelocityDampingForceField<Vec3d>{.dampingCoefficient = 10}));
    sim.init();
    auto const& manager = sim.root().template get<DefaultContactManager>();
    double low = 1, force = 0;
    const double h = 2e-3;
    for (int i = 0; i < 1000; ++i) {
      sim.animate(h);
      for (auto const& x : sim.template at<"block">().state().position) low = std::min(low, x[2]);
      if (i >= 900) force += force_on(manager, "/root/block")[2] / 100;
    }
    CHECK(low > 0.01 - 1e-6);
    CHECK(force == Approx(18 * g).epsilon(tolerance));
  };
  lands(gaussSeidel, EulerExplicitSolver{}, 1e-3);
  lands(convex, EulerExplicitSolver{}, 1e-3);
  // Where positions are held whose free motion is of a higher order, points that lie keep the velocity g h /
  // 2, against which the damping of 48 points acts: 10 N s/m * 0.01 to 0.02 m/s each
  lands(gaussSeidel, RungeKutta4Solver{}, 0.06);
  lands(gaussSeidel, CentralDifferenceSolver{}, 1e-3);
}

TEST_CASE(
    "statics: a block that hangs is pressed by a floor in one step, also where it is in equilibrium before") {
  const Mesh mesh = regular_grid_tetrahedra(4, 4, 3, {-0.15, -0.15, 0.005}, {0.15, 0.15, 0.205});
  std::vector<int> top;
  for (int i = 32; i < 48; ++i) top.push_back(i);
  for (const double weight : {0., 1.}) {
    INFO(weight);
    auto sim = constrained_scene_by(
        gaussSeidel, near_by(), 0, fixed_floor(), static_block(mesh, FixedConstraint<Vec3d>{.indices = top}));
    sim.root().get<Gravity>().gravity *= weight;
    sim.init();
    double force = 0;
    for (int i = 0; i < 3; ++i) {
      sim.animate(dt);
      const double now = force_on(sim.root().get<DefaultContactManager>(), "/root/block")[2];
      if (i > 0) CHECK(now == Approx(force).epsilon(1e-5));
      force = now;
      for (auto const& x : sim.at<"block">().state().position) CHECK(x[2] > 0.01 - 1e-7);
    }
    // 5 mm of 0.2 m, 1e5 Pa, 0.09 m^2
    CHECK(force > 100);
    CHECK(force < 500);
  }
}

TEST_CASE("self-contact: a soft C closes under its weight, and its lips touch", "[long]") {
  // two arms, 0.4 m long and 0.1 m high, of one body that is held at its back
  const Mesh lower = regular_grid_tetrahedra(9, 3, 3, {0, 0, 0}, {0.4, 0.1, 0.1}),
             upper = regular_grid_tetrahedra(9, 3, 3, {0, 0, 0.13}, {0.4, 0.1, 0.23});
  std::vector<Vector3d> points = lower.positions;
  std::vector<Tetrahedron> tetrahedra = lower.tetrahedra;
  const int n = int(points.size());
  points.insert(points.end(), upper.positions.begin(), upper.positions.end());
  for (Tetrahedron t : upper.tetrahedra) {
    for (int& i : t) i += n;
    tetrahedra.push_back(t);
  }
  std::vector<int> held;
  for (int i = 0; i < 2 * n; ++i)
    if (points[std::size_t(i)][0] < 1e-9 || (i < n && points[std::size_t(i)][2] < 1e-9)) held.push_back(i);
  auto closes = [&](auto solver) {
    auto sim = constrained_scene_by(
        solver,
        MinProximityIntersection{.alarmDistance = 0.03, .contactDistance = 0.01},
        0.3,
        node<"body">(EulerImplicitSolver{.rayleighStiffness = 0.05},
                     SparseLDLSolver<>{},
                     TetrahedronTopology{tetrahedra},
                     MechanicalObject<Vec3d>{points},
                     UniformMass<Vec3d>{.totalMass = 8},
                     TetrahedronFEMForceField<Vec3d>{.youngModulus = {1e4}, .poissonRatio = 0.3},
                     FixedConstraint<Vec3d>{.indices = held},
                     TriangleCollisionModel<Vec3d>{.selfCollision = true, .bothSide = false},
                     PointCollisionModel<Vec3d>{.selfCollision = true}));
    sim.init();
    auto const& manager = sim.root().template get<DefaultContactManager>();
    double nearest = 1, most = 0;
    for (int i = 0; i < 80; ++i) {
      sim.animate(dt);
      most = 0;
      for (Contact const& c : manager.contacts) {
        most += c.force.norm();
      }
    }
    for (Contact const& c : manager.contacts) nearest = std::min(nearest, c.distance);
    CHECK(most > 1);
    // the next detection finds what the last step has left; lips turn by some 1e-3 in a step
    CHECK(nearest > 0.01 - 1e-3);
  };
  closes(gaussSeidel);
  closes(convex);
}

TEST_CASE("the mouse lifts a soft block off the floor, and lets it go") {
  const Mesh mesh = regular_grid_tetrahedra(4, 4, 3, {-0.15, -0.15, 0.01}, {0.15, 0.15, 0.21});
  auto lifts = [&](auto solver) {
    auto sim = constrained_scene_by(
        solver,
        near_by(),
        0.3,
        fixed_floor(),
        block(mesh, 1e5, 2, EulerImplicitSolver{.rayleighStiffness = 0.02}, SparseLDLSolver<>{}));
    sim.init();
    auto const& manager = sim.root().template get<DefaultContactManager>();
    auto weight = [&] { return force_on(manager, "/root/block")[2]; };
    for (int i = 0; i < 60; ++i) sim.animate(dt);
    CHECK(weight() == Approx(2 * g).epsilon(1e-2));
    const auto pick = sim.pick({0.01, 0.02, 3}, {0, 0, -1});
    REQUIRE(pick);
    const int spring = sim.attach(*pick, {.stiffness = 400, .damping = 20});
    for (int i = 0; i < 100; ++i) {
      sim.pull(spring, pick->point + Vector3d(0, 0, 0.002 * i));
      sim.animate(dt);
    }
    CHECK(weight() == 0);
    sim.release(spring);
    for (int i = 0; i < 200; ++i) {
      sim.animate(dt);
      for (auto const& x : sim.template at<"block">().state().position) CHECK(x[2] > 0.01 - 1e-3);
    }
    CHECK(weight() == Approx(2 * g).epsilon(1e-2));
  };
  lifts(gaussSeidel);
  lifts(convex);
}

}  // namespace test_contact_together
