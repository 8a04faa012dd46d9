// SPDX-License-Identifier: BSL-1.0
// Contacts by multipliers do not depend on the order of bodies, nor on threads.
#include "lagrangian/contact_scenes.hpp"

#include <sinew/topology/regular_grid.hpp>

#include <sinew/control/threads.hpp>

#include <algorithm>
#include <cstring>

namespace test_contact_orders {

using namespace sinew;
using Eigen::Vector3d;

namespace {

constexpr double dt = 0.01;

using Motion = std::vector<Vector3d>;  // positions, then velocities

// 12 balls that lie and roll on each other and on a floor; `order` says which comes where in the state
template <class Solver>
Motion heap(Solver solver, std::vector<int> const& order) {
  std::vector<Rigid3d::Coord> places(order.size());
  std::vector<Rigid3d::Deriv> velocities(order.size());
  for (std::size_t k = 0; k < order.size(); ++k) {
    const int i = order[k];
    places[k] = {
        {0.43 * (i % 3) + 0.02 * (i / 3), 0.43 * (i / 3 % 2) - 0.013 * i, 0.22 + 0.43 * double(i / 6)},
        Eigen::Quaterniond::Identity()};
    velocities[k] << 0.3 * (i % 2), -0.2 * (i % 3), 0, 0, 0.5 * (i % 2), 0;
  }
  auto sim = constrained_scene_by(
      solver,
      near_by(),
      0.3,
      fixed_floor(),
      node<"balls">(
          EulerExplicitSolver{},
          MechanicalObject<Rigid3d>{.position = places, .velocity = velocities},
          UniformMass<Rigid3d>{.vertexMass = RigidMass<double, 3>{1, 0.016 * Eigen::Matrix3d::Identity()}},
          SphereCollisionModel<Rigid3d>{.selfCollision = true, .radius = 0.2}));
  sim.init();
  for (int i = 0; i < 40; ++i) sim.animate(dt);
  auto const& s = sim.template at<"balls">().state();
  Motion all(2 * order.size());
  for (std::size_t k = 0; k < order.size(); ++k) {
    all[std::size_t(order[k])] = s.position[k].center;
    all[std::size_t(order[k]) + order.size()] = s.velocity[k].template head<3>();
  }
  return all;
}
double difference(Motion const& a, Motion const& b) {
  double most = 0;
  for (std::size_t i = 0; i < a.size(); ++i) most = std::max(most, (a[i] - b[i]).norm());
  return most;
}

// 1,210 points and 5,400 tetrahedra on a floor, with a rigid ball on them
template <class Solver, class Linear>
auto soft_on_floor(Solver solver, Linear linear, int threads) {
  const Mesh mesh = regular_grid_tetrahedra(11, 11, 10, {-0.2, -0.2, 0.012}, {0.2, 0.2, 0.3});
  auto sim = constrained_scene_by(
      solver,
      near_by(),
      0.3,
      Threads{.count = threads},
      fixed_floor(),
      node<"block">(
          EulerImplicitSolver{.rayleighStiffness = 0.01},
          linear,
          TetrahedronTopology{mesh.tetrahedra},
          MechanicalObject<Vec3d>{.position = mesh.positions,
                                  .velocity = std::vector<Vector3d>(mesh.positions.size(), {0.5, 0, -0.3})},
          UniformMass<Vec3d>{.totalMass = 5},
          TetrahedronFEMForceField<Vec3d>{.youngModulus = {1e5}, .poissonRatio = 0.3},
          TriangleCollisionModel<Vec3d>{},
          PointCollisionModel<Vec3d>{}),
      node<"ball">(
          EulerExplicitSolver{},
          MechanicalObject<Rigid3d>{.position = {{{0.02, 0.03, 0.515}, Eigen::Quaterniond::Identity()}}},
          UniformMass<Rigid3d>{.vertexMass = RigidMass<double, 3>{1, 0.016 * Eigen::Matrix3d::Identity()}},
          SphereCollisionModel<Rigid3d>{.radius = 0.2}));
  sim.init();
  for (int i = 0; i < 2; ++i) sim.animate(dt);
  return sim;
}
template <class List>
std::vector<unsigned char> bits(List const& list) {
  std::vector<unsigned char> all(list.size() * sizeof list[0]);
  std::memcpy(all.data(), list.data(), all.size());
  return all;
}

}  // namespace

TEST_CASE("another order of bodies, and so of contacts, has the same motion to the tolerance of the solver") {
  std::vector<int> order(12), other;
  for (int i = 0; i < 12; ++i) order[std::size_t(i)] = i;
  other = order;
  std::reverse(other.begin(), other.begin() + 7);
  std::rotate(other.begin(), other.begin() + 4, other.end());
  auto check = [&](auto solver) {
    const Motion one = heap(solver, order), two = heap(solver, other);
    // velocities of 1e-12 m in a step of 0.01 s, which impacts and slides of 40 steps make more
    CHECK(difference(one, two) < 1e-6);
    return one;
  };
  const Motion sweeps = check(BlockGaussSeidelConstraintSolver{.maxIterations = 20000, .tolerance = 1e-14});
  const Motion gradients = check(NNCGConstraintSolver{.maxIterations = 20000, .tolerance = 1e-14});
  const Motion convex =
      check(ConvexConstraintSolver{.tolerance = 1e-12, .momentumTolerance = 1e-12, .maxUpdates = 500});
  CHECK(difference(sweeps, gradients) < 1e-6);
  CHECK(difference(sweeps, convex) < 1e-6);
}

TEST_CASE("a step with contacts by multipliers has the same bits with any number of threads, and twice",
          "[long]") {
  auto check = [](auto solver, auto linear) {
    const auto one = soft_on_floor(solver, linear, 1);
    auto copy = one;
    REQUIRE(copy.root().template get<DefaultContactManager>().contacts.size() > 100);
    for (const int threads : {1, 3}) {
      INFO(threads);
      auto sim = soft_on_floor(solver, linear, threads);
      auto const &a = copy.template at<"block">().state(), &b = sim.template at<"block">().state();
      CHECK(bits(a.position) == bits(b.position));
      CHECK(bits(a.velocity) == bits(b.velocity));
      CHECK(bits(copy.template at<"ball">().state().velocity) ==
            bits(sim.template at<"ball">().state().velocity));
    }
  };
  check(BlockGaussSeidelConstraintSolver{.tolerance = 1e-6}, SparseLDLSolver<>{});
  check(ConvexConstraintSolver{.tolerance = 1e-5, .momentumTolerance = 1e-4},
        CGLinearSolver<>{.iterations = 20});
}

}  // namespace test_contact_orders
