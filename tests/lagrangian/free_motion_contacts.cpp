// SPDX-License-Identifier: BSL-1.0
// Contacts that are found on the way of the free motion of a step (continuousCollisionType freeMotion).
#include "lagrangian/contact_scenes.hpp"

namespace test_free_motion_contacts {

using namespace sinew;
using Eigen::Vector3d;

namespace {

constexpr double dt = 0.1, strong = 1000;  // [s], [m/s^2]: what is at rest falls 10 m in a step
constexpr ContinuousIntersection seen(StepMotion motion) { return {0.02, 0.01, motion}; }

// a point of 2 kg over a floor, which is an element of no thickness and without another side
auto point_over_floor(StepMotion motion, double velocity) {
  return constrained_scene(
      seen(motion),
      0,
      fixed_floor(),
      node<"point">(EulerImplicitSolver{},
                    CGLinearSolver<>{.iterations = 50, .tolerance = 1e-14},
                    MechanicalObject<Vec3d>{.position = {{0.3, 0.2, 0.5}}, .velocity = {{0, 0, velocity}}},
                    UniformMass<Vec3d>{.totalMass = 2},
                    PointCollisionModel<Vec3d>{}));
}

}  // namespace

TEST_CASE("what starts to fall through a floor within a step is stopped by it, with the force of that") {
  // velocities see nothing: the point is at rest at the start, and behind the floor at the end of the step
  auto missed = point_over_floor(StepMotion::inertia, 0);
  missed.root().template get<Gravity>().gravity = {0, 0, -strong};
  missed.init();
  missed.animate(dt);
  CHECK(missed.at<"point">().state().position[0][2] == Approx(0.5 - strong * dt * dt));

  auto sim = point_over_floor(StepMotion::freeMotion, 0);
  sim.root().template get<Gravity>().gravity = {0, 0, -strong};
  sim.init();
  sim.animate(dt);
  auto const& s = sim.at<"point">().state();
  auto const& manager = sim.root().template get<DefaultContactManager>();
  // it stands at the contact distance, where the time of impact is early by no more than a thousandth of the
  // way
  const double speed = (0.5 - 0.01) / dt;
  CHECK(s.position[0][2] == Approx(0.01).margin(1e-9));
  CHECK(s.velocity[0][2] == Approx(-speed).epsilon(1e-9));
  REQUIRE(manager.contacts.size() == 1);
  CHECK(force_on(manager, "/root/point")[2] == Approx(2 * (strong - speed / dt)).epsilon(1e-9));
  // and rests: the contact goes on, with the weight as its force, behind the impact
  for (int i = 0; i < 3; ++i) sim.animate(dt);
  CHECK(s.position[0][2] == Approx(0.01).margin(1e-9));
  CHECK(force_on(manager, "/root/point")[2] == Approx(2 * strong).epsilon(1e-9));
}

TEST_CASE("what forces hold back before a floor has no contact") {
  // at 10 m/s it would be behind the floor after half a step; gravity upwards takes it back
  for (const auto motion : {StepMotion::inertia, StepMotion::freeMotion}) {
    auto sim = point_over_floor(motion, -10);
    sim.root().template get<Gravity>().gravity = {0, 0, 80};
    sim.init();
    sim.animate(dt);
    INFO(enum_names(motion)[std::size_t(motion)]);
    auto const& s = sim.at<"point">().state();
    CHECK(s.position[0][2] == Approx(0.5 + dt * (-10 + 80 * dt)));
    auto const& manager = sim.root().template get<DefaultContactManager>();
    CHECK(manager.contacts.size() == (motion == StepMotion::inertia ? 1u : 0u));
    CHECK(force_on(manager, "/root/point").norm() < 1e-9);
  }
}

TEST_CASE("without motion a method that is continuous sees what is near") {
  auto sim = point_over_floor(StepMotion::none, -10);
  sim.root().template get<Gravity>().gravity.setZero();
  sim.init();
  sim.animate(dt);
  CHECK(sim.at<"point">().state().position[0][2] == Approx(-0.5));
}

TEST_CASE("states that follow others go as far as these by their Jacobian") {
  // a sheet that a rigid carries falls onto a point, from rest
  MeshTopology sheet;
  sheet.triangles = {{0, 1, 2}, {0, 2, 3}};
  auto sim = constrained_scene(
      seen(StepMotion::freeMotion),
      0,
      fixed_floor(),
      node<"carrier">(
          EulerImplicitSolver{},
          CGLinearSolver<>{.iterations = 50, .tolerance = 1e-14},
          MechanicalObject<Rigid3d>{.position = {{{10, 0, 5}, Eigen::Quaterniond::Identity()}}},
          UniformMass<Rigid3d>{.vertexMass = RigidMass<double, 3>{2, Eigen::Matrix3d::Identity()}},
          node<"sheet">(sheet,
                        MechanicalObject<Vec3d>{.position = {{-1, -1, 0}, {1, -1, 0}, {1, 1, 0}, {-1, 1, 0}}},
                        TriangleCollisionModel<Vec3d>{.bothSide = true},
                        RigidMapping<Rigid3d, Vec3d>{})),
      node<"tip">(MechanicalObject<Vec3d>{.position = {{10, 0, 4}}},
                  PointCollisionModel<Vec3d>{.moving = false, .simulated = false}));
  sim.root().template get<Gravity>().gravity = {0, 0, -strong};
  sim.init();
  sim.animate(dt);
  CHECK(sim.at<"carrier/sheet">().state().position[0][2] == Approx(4.01).margin(1e-9));
}

TEST_CASE("the way of the free motion is refused where it is not known, or comes too late") {
  auto scene = [](auto... more) {
    return node<"root">(DefaultPipeline{},
                        BruteForceBroadPhase{},
                        BVHNarrowPhase{},
                        seen(StepMotion::freeMotion),
                        more...,
                        fixed_floor(),
                        node<"point">(EulerExplicitSolver{},
                                      MechanicalObject<Vec3d>{.position = {{0, 0, 1}}},
                                      UniformMass<Vec3d>{},
                                      PointCollisionModel<Vec3d>{}));
  };
  const DefaultContactManager forces{.response = "PenalityContactForceField"};
  RegistryScene loose{scene(forces)};
  CHECK_THROWS_WITH(loose.init(),
                    Catch::Contains("nothing moves freely here: put a FreeMotionAnimationLoop") &&
                        Catch::Contains("or say inertia"));
  RegistryScene late{scene(forces, FreeMotionAnimationLoop{}, BlockGaussSeidelConstraintSolver{})};
  CHECK_THROWS_WITH(late.init(), Catch::Contains("such as FrictionContactConstraint, or say inertia"));
}

}  // namespace test_free_motion_contacts
