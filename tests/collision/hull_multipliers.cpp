// SPDX-License-Identifier: BSL-1.0
// Boxes, capsules and solids of tetrahedra in contact by multipliers: what sticks, slides, rolls and stands.
#include <sinew/collision/continuous_intersection.hpp>
#include <sinew/collision/obb_collision_model.hpp>
#include <sinew/collision/rigid_capsule_collision_model.hpp>
#include <sinew/collision/tetrahedron_collision_model.hpp>
#include <sinew/lagrangian.hpp>
#include <sinew/solver/euler_explicit.hpp>

#include "collision/contact_scene.hpp"
#include "hulls.hpp"

namespace test_hull_multipliers {

using namespace sinew;
using V = Eigen::Vector3d;

namespace {

constexpr double g = 10, dt = 0.005, slope = 0.3, skin = 0.01;

/// A slab whose upper side is z = 0, with gravity as on a slope down along x.
template <class Body, class Intersection = MinProximityIntersection>
auto on_slope(double angle, double mu, Body body,
              Intersection intersection = {.alarmDistance = 0.1, .contactDistance = skin}) {
  return Simulation{node<"root">(
      FreeMotionAnimationLoop{},
      BlockGaussSeidelConstraintSolver{.maxIterations = 20000, .tolerance = 1e-12},
      DefaultPipeline{},
      BruteForceBroadPhase{},
      BVHNarrowPhase{},
      intersection,
      Contacts{.response = "FrictionContactConstraint", .responseParams = text("mu=", mu)},
      Gravity{{g * std::sin(angle), 0, -g * std::cos(angle)}},
      node<"slab">(
          MechanicalObject<Rigid3d>{.position = {rigid_at({0, 0, -0.5})}},
          OBBCollisionModel<Rigid3d>{.moving = false, .simulated = false, .extents = {{100, 100, 0.5}}}),
      body)};
}
template <class Model>
auto rigid(RigidCoord3<double> const& x, RigidMass<double, 3> const& mass, Model model) {
  return node<"body">(EulerExplicitSolver{},
                      MechanicalObject<Rigid3d>{.position = {x}},
                      UniformMass<Rigid3d>{.vertexMass = mass},
                      model);
}
template <class Sim>
V force_on_slab(Sim& sim) {
  V sum(0, 0, 0);
  for (Contact const& c : sim.root().template get<Contacts>().contacts) sum += c.force;
  return sum;
}

}  // namespace

TEST_CASE("a box on a slope sticks below the angle of friction, and slides above it as a point does") {
  const RigidMass<double, 3> mass{2, 0.1 * Eigen::Matrix3d::Identity()};
  for (const double mu : {0.5, 0.1}) {
    INFO(mu);
    auto sim = on_slope(
        slope,
        mu,
        rigid(rigid_at({0, 0, 0.1 + skin}), mass, OBBCollisionModel<Rigid3d>{.extents = {{0.4, 0.3, 0.1}}}));
    sim.init();
    for (int i = 0; i < 200; ++i) sim.animate(dt);
    auto const& s = sim.at<"body">().state();
    const double a = mu < std::tan(slope) ? g * (std::sin(slope) - mu * std::cos(slope)) : 0;
    CHECK(s.velocity[0][0] == Approx(a * 200 * dt).margin(1e-6));
    CHECK(s.velocity[0].tail<3>().norm() < 1e-6);
    CHECK(s.position[0].center[2] == Approx(0.1 + skin).margin(1e-6));
    CHECK(sim.root().get<Contacts>().contacts.size() == 4);
    CHECK(std::abs(force_on_slab(sim)[2]) == Approx(2 * g * std::cos(slope)).epsilon(1e-6));
  }
}

TEST_CASE("a box that starts to fall through a slab within a step is stopped on the way of its free motion") {
  const RigidMass<double, 3> mass{2, 0.1 * Eigen::Matrix3d::Identity()};
  auto sim = on_slope(
      0,
      0,
      rigid(rigid_at({0, 0, 2}), mass, OBBCollisionModel<Rigid3d>{.extents = {{0.4, 0.3, 0.1}}}),
      ContinuousIntersection{
          .alarmDistance = 0.02, .contactDistance = skin, .continuousCollisionType = StepMotion::freeMotion});
  sim.root().get<Gravity>().gravity = {0, 0, -1000};  // 10 m in a step
  sim.init();
  auto const& s = sim.at<"body">().state();
  for (int i = 0; i < 4; ++i) {
    sim.animate(0.1);
    INFO(i);
    CHECK(s.position[0].center[2] == Approx(0.1 + skin).margin(1e-6));
    CHECK(s.velocity[0].tail<3>().norm() < 1e-6);
  }
  CHECK(std::abs(force_on_slab(sim)[2]) == Approx(2 * 1000).epsilon(1e-6));
}

TEST_CASE("a capsule rolls down a slope with g sin / (1 + I / (m r^2))") {
  const double m = 2, r = 0.2, inertia = 0.03;
  auto sim = on_slope(slope,
                      0.9,
                      rigid(rigid_at({0, 0, r + skin}),
                            RigidMass<double, 3>{m, inertia * Eigen::Matrix3d::Identity()},
                            CapsuleCollisionModel<Rigid3d>{.radii = {r}, .heights = {0.6}}));
  sim.init();
  for (int i = 0; i < 200; ++i) sim.animate(dt);
  auto const& s = sim.at<"body">().state();
  const double a = g * std::sin(slope) / (1 + inertia / (m * r * r));
  // the lever of a step is that of its start: of first order in the angle of a step
  CHECK(s.velocity[0][0] == Approx(a * 200 * dt).epsilon(0.02));
  CHECK(s.velocity[0][4] * r == Approx(s.velocity[0][0]).epsilon(0.02));
  CHECK(s.position[0].center[2] == Approx(r + skin).margin(1e-3));
}

TEST_CASE("a capsule of points stands on both ends, and a point leaves a solid, at the contact distance") {
  MeshTopology rod;
  rod.edges = {{0, 1}};
  auto sim = on_slope(0,
                      0,
                      node<"body">(EulerExplicitSolver{},
                                   rod,
                                   MechanicalObject<Vec3d>{.position = {{-0.5, 0, 0.25}, {0.5, 0, 0.2}}},
                                   UniformMass<Vec3d>{.vertexMass = 1},
                                   CapsuleCollisionModel<Vec3d>{.defaultRadius = 0.1}));
  sim.init();
  for (int i = 0; i < 400; ++i) sim.animate(dt);
  for (V const& x : sim.at<"body">().state().position) CHECK(x[2] == Approx(0.1 + skin).margin(1e-6));
  CHECK(std::abs(force_on_slab(sim)[2]) == Approx(2 * g).epsilon(1e-6));

  MeshTopology one;
  one.tetrahedra = {{0, 1, 2, 3}};
  auto solid = on_slope(
      0,
      0,
      node<"both">(
          node<"solid">(one,
                        MechanicalObject<Vec3d>{.position = {{0, 0, 5}, {1, 0, 5}, {0, 1, 5}, {0, 0, 6}}},
                        TetrahedronCollisionModel<Vec3d>{.moving = false, .simulated = false}),
          node<"point">(EulerExplicitSolver{},
                        MechanicalObject<Vec3d>{.position = {{0.2, 0.2, 5.05}}},
                        UniformMass<Vec3d>{.vertexMass = 1},
                        PointCollisionModel<Vec3d>{})));
  solid.init();
  solid.animate(dt);
  // out of the nearest face, z = 5, by its depth of 0.05 and the contact distance, in one step
  auto const& x = solid.at<"both/point">().state().position[0];
  CHECK(x[2] <= 5 - skin + 1e-6);
  CHECK(x.head<2>() == Eigen::Vector2d(0.2, 0.2));
}

}  // namespace test_hull_multipliers
