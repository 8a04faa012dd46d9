// SPDX-License-Identifier: BSL-1.0
// Bodies that lose elements while contacts by multipliers touch them: removed, cut, carved.
#include "lagrangian/contact_scenes.hpp"

#include <sinew/collision/carving_manager.hpp>
#include <sinew/topology/regular_grid.hpp>

#include <algorithm>

namespace test_contact_cuts {

using namespace sinew;
using Eigen::Vector3d;

namespace {

constexpr double dt = 0.01;

template <class State>
bool is_finite(State const& s) {
  return std::all_of(s.position.begin(), s.position.end(), [](auto const& x) { return x.allFinite(); });
}

const BlockGaussSeidelConstraintSolver gaussSeidel{.maxIterations = 5000, .tolerance = 1e-10};
const ConvexConstraintSolver convex{.tolerance = 1e-9, .momentumTolerance = 1e-9, .maxUpdates = 200};

}  // namespace

TEST_CASE(
    "elements are removed from a body while it lies: what is left goes on, with its weight on the floor") {
  const Mesh mesh = regular_grid_tetrahedra(4, 4, 3, {-0.15, -0.15, 0.01}, {0.15, 0.15, 0.21});
  auto lies = [&](auto solver) {
    auto sim = constrained_scene_by(
        solver,
        near_by(),
        0.3,
        fixed_floor(),
        node<"block">(EulerImplicitSolver{.rayleighStiffness = 0.02, .rayleighMass = 1},
                      SparseLDLSolver<>{},
                      TetrahedronTopology{mesh.tetrahedra},
                      MechanicalObject<Vec3d>{mesh.positions},
                      DiagonalMass<Vec3d>{.massDensity = 1000},
                      TetrahedronFEMForceField<Vec3d>{.youngModulus = {1e5}, .poissonRatio = 0.3},
                      TriangleCollisionModel<Vec3d>{.bothSide = false},
                      PointCollisionModel<Vec3d>{}));
    sim.init();
    for (int i = 0; i < 20; ++i) sim.animate(dt);
    for (int k = 0; k < 10; ++k) {
      // some that touch the floor, too
      std::vector<int> out{0, 3, 7};
      sim.removeElements("block", {.tetrahedra = out});
      for (int i = 0; i < 5; ++i) sim.animate(dt);
      REQUIRE(is_finite(sim.template at<"block">().state()));
    }
    for (int i = 0; i < 100; ++i) sim.animate(dt);
    double volume = 0;
    auto const& rest = sim.template at<"block">().state().restPosition;
    for (auto const& t : sim.template at<"block">().template get<TetrahedronTopology>().tetrahedra) {
      auto x = [&](std::size_t k) { return rest[std::size_t(t[k])]; };
      volume += std::abs((x(1) - x(0)).cross(x(2) - x(0)).dot(x(3) - x(0))) / 6;
    }
    CHECK(sim.template at<"block">().template get<TetrahedronTopology>().tetrahedra.size() ==
          mesh.tetrahedra.size() - 30);
    const double force = force_on(sim.root().template get<DefaultContactManager>(), "/root/block")[2];
    CHECK(force == Approx(1000 * g * volume).epsilon(1e-3));
  };
  lies(gaussSeidel);
  lies(convex);
}

TEST_CASE("where springs of a net are cut that lies on a ball, its edge slides down", "[long]") {
  // 9 x 9 points, held by nothing but friction
  auto falls = [](auto solver) {
    std::vector<Vector3d> points;
    MeshTopology net;
    const int n = 9;
    for (int j = 0; j < n; ++j)
      for (int i = 0; i < n; ++i) {
        points.push_back({0.1 * (i - 4), 0.1 * (j - 4), 0.52});
        if (i + 1 < n) net.edges.push_back({i + n * j, i + 1 + n * j});
        if (j + 1 < n) net.edges.push_back({i + n * j, i + n * (j + 1)});
      }
    auto sim = constrained_scene_by(
        solver,
        MinProximityIntersection{.alarmDistance = 0.05, .contactDistance = 0.01},
        0.8,
        node<"ball">(MechanicalObject<Vec3d>{.position = {{0, 0, 0}}},
                     SphereCollisionModel<Vec3d>{.moving = false, .simulated = false, .radius = 0.5}),
        node<"net">(EulerImplicitSolver{.rayleighStiffness = 0.01, .rayleighMass = 0.5},
                    SparseLDLSolver<>{},
                    net,
                    MechanicalObject<Vec3d>{.position = points},
                    UniformMass<Vec3d>{.vertexMass = 0.01},
                    MeshSpringForceField<Vec3d>{.stiffness = 200},
                    PointCollisionModel<Vec3d>{}));
    sim.init();
    for (int i = 0; i < 100; ++i) sim.animate(dt);
    auto place = [&](std::size_t i) { return sim.template at<"net">().state().position[i]; };
    const double before = place(8 + 9 * 4)[2];
    // the springs between the columns 6 and 7
    auto const& edges = sim.template at<"net">().template get<MeshTopology>().edges;
    std::vector<int> out;
    for (std::size_t e = 0; e < edges.size(); ++e) {
      const int a = edges[e][0] % n, b = edges[e][1] % n;
      if (std::min(a, b) == 6 && std::max(a, b) == 7) out.push_back(int(e));
    }
    REQUIRE(out.size() == 9);
    sim.removeElements("net", {.edges = out});
    for (int i = 0; i < 100; ++i) {
      sim.animate(dt);
      auto const& state = sim.template at<"net">().state();  // which a removal has moved
      REQUIRE(is_finite(state));
      for (auto const& x : state.position) CHECK(x.norm() > 0.51 - 2e-3);
    }
    CHECK(place(8 + 9 * 4)[2] < before - 0.1);
    CHECK(place(40)[2] > 0.5);
  };
  falls(gaussSeidel);
  falls(convex);
}

TEST_CASE("what a tool carves goes on to touch it, by multipliers") {
  const Mesh mesh = regular_grid_tetrahedra(5, 5, 4, {-0.2, -0.2, 0}, {0.2, 0.2, 0.3});
  std::vector<int> bottom;
  for (int i = 0; i < 25; ++i) bottom.push_back(i);
  auto carves = [&](auto solver) {
    RegistryScene sim{node<"root">(
        FreeMotionAnimationLoop{},
        solver,
        DefaultPipeline{},
        BruteForceBroadPhase{},
        BVHNarrowPhase{},
        MinProximityIntersection{.alarmDistance = 0.05, .contactDistance = 0.01},
        DefaultContactManager{.response = "FrictionContactConstraint", .responseParams = "mu=0.3"},
        CarvingManager{.active = false, .toolModel = "tool"},
        Gravity{{0, 0, -g}},
        node<"block">(EulerImplicitSolver{.rayleighStiffness = 0.05},
                      SparseLDLSolver<>{},
                      TetrahedronTopology{mesh.tetrahedra},
                      MechanicalObject<Vec3d>{mesh.positions},
                      DiagonalMass<Vec3d>{.massDensity = 1000},
                      TetrahedronFEMForceField<Vec3d>{.youngModulus = {1e5}, .poissonRatio = 0.3},
                      FixedConstraint<Vec3d>{.indices = bottom},
                      TriangleCollisionModel<Vec3d>{.bothSide = false}),
        node<"tool">(MechanicalObject<Vec3d>{.position = {{0.02, 0.03, 0.42}}},
                     SphereCollisionModel<Vec3d>{.simulated = false, .radius = 0.1}))};
    sim.init();
    auto press = [&](int steps, double by) {
      double force = 0;
      for (int i = 0; i < steps; ++i) {
        sim.template at<"tool">().state().position[0][2] -= by;  // which a removal may have moved
        sim.animate(dt);
        REQUIRE(is_finite(sim.template at<"block">().state()));
        force =
            std::max(force, -force_on(sim.root().template get<DefaultContactManager>(), "/root/block")[2]);
      }
      return force;
    };
    const double pressed = press(20, 0.001);
    auto carving = [&]() -> CarvingManager& { return sim.root().template get<CarvingManager>(); };
    carving().active = true;
    press(5, 0.001);
    carving().active = false;
    const long removed = carving().removed;
    const double again = press(60, 0.001);
    CHECK(pressed > 1);
    CHECK(removed > 0);
    CHECK(again > 1);
  };
  carves(gaussSeidel);
  carves(convex);
}

}  // namespace test_contact_cuts
