// SPDX-License-Identifier: BSL-1.0
#include <sinew/constraint/fixed_constraint.hpp>
#include <sinew/force/constant_force.hpp>
#include <sinew/solver/sparse_ldl_solver.hpp>

#include "contact_scene.hpp"

namespace test_contact_scenes {

using namespace sinew;

namespace {

constexpr MinProximityIntersection near{.alarmDistance = 0.2, .contactDistance = 0.1};

template <class LinearSolver>
auto ball_on_floor() {
  return contact_scene(near,
                       10,
                       floor_node(1000, 0),
                       node<"ball">(EulerImplicitSolver{},
                                    LinearSolver{},
                                    MechanicalObject<Vec3d>{.position = {{0, 0.3, 0.65}}},
                                    UniformMass<Vec3d>{.vertexMass = 2},
                                    SphereCollisionModel<Vec3d>{
                                        .contactStiffness = 100, .contactDamping = 50, .radius = 0.5}));
}

}  // namespace

TEST_CASE("a ball under gravity rests on a floor, as deep in it as its weight presses") {
  auto sim = ball_on_floor<CGLinearSolver<>>();
  sim.init();
  for (int i = 0; i < 2000; ++i) sim.animate(0.01);
  // k = 1000 * 100 / (0.1 + 0.5), weight 20 N: m g / k deep, below the contact distance 0.1
  const double k = 1000 * 100 / 0.6, height = 0.5 + 0.1 - 2 * 10 / k;
  CHECK(sim.at<"ball">().state().position[0][2] == Approx(height).margin(1e-9));
  CHECK(sim.at<"ball">().state().velocity[0].norm() < 1e-9);
}

TEST_CASE("a floor that no solver moves is found where it has been put, also when it was picked on the way") {
  // a ball without weight touches what comes within 0.1 m of it
  auto sim = contact_scene(near,
                           0,
                           floor_node(1000, 0),
                           node<"ball">(EulerImplicitSolver{},
                                        CGLinearSolver<>{},
                                        MechanicalObject<Vec3d>{.position = {{0, 0.3, 2}}},
                                        UniformMass<Vec3d>{.vertexMass = 2},
                                        SphereCollisionModel<Vec3d>{.contactStiffness = 100, .radius = 0.5}));
  sim.init();
  auto& floor = sim.at<"floor">().state().position;
  auto const& ball = sim.at<"ball">().state();
  auto put = [&](double z) {
    for (auto& x : floor) x[2] = z;
  };
  for (int i = 0; i < 3; ++i) sim.animate(0.01);
  CHECK(ball.velocity[0].norm() == 0);
  put(1.45);
  // sees where the floor is, before detection does
  const auto pick = sim.pick({3, 1, 1.6}, {0, 0, -1});
  REQUIRE(pick);
  CHECK(pick->point[2] == Approx(1.45));
  sim.animate(0.01);
  CHECK(ball.velocity[0][2] > 0);
  put(0);
  const double leaving = ball.velocity[0][2];
  for (int i = 0; i < 3; ++i) sim.animate(0.01);
  CHECK(ball.velocity[0][2] == leaving);
}

TEST_CASE("weight holds a contact, and does not glue: what is lifted or let go leaves at once") {
  const double dt = 0.01, g = 10;
  auto way = [&](double a, int steps) { return a * dt * dt * steps * (steps + 1) / 2; };
  auto body = [](std::vector<Eigen::Vector3d> positions, std::vector<int> fixed, double lift) {
    return node<"balls">(
        EulerImplicitSolver{},
        CGLinearSolver<>{.iterations = 50, .tolerance = 1e-14},
        MechanicalObject<Vec3d>{.position = positions},
        UniformMass<Vec3d>{.vertexMass = 2},
        FixedConstraint<Vec3d>{.indices = fixed},
        ConstantForceField<Vec3d>{.indices = {int(positions.size()) - 1}, .forces = {{0, 0, lift}}},
        SphereCollisionModel<Vec3d>{.selfCollision = true, .contactStiffness = 3000, .radius = 0.5});
  };
  for (const double k : {100.0, 3000.0}) {
    // on the floor, with a force of 1.05 times the weight: it may lose two steps of its rise
    auto lifted = contact_scene(near, g, floor_node(k, 0), body({{0, 0, 0.599}}, {}, 0));
    lifted.init();
    for (int i = 0; i < 500; ++i) lifted.animate(dt);
    const double start = lifted.at<"balls">().state().position[0][2];
    lifted.at<"balls">().get<ConstantForceField<Vec3d>>().forces[0][2] = 2 * g * 1.05;
    for (int i = 0; i < 50; ++i) lifted.animate(dt);
    CHECK(lifted.at<"balls">().state().position[0][2] - start > way(0.05 * g, 48));

    // below a ball that is held, against which it goes up: it may lose four steps of its fall
    for (const double up : {0.0, 0.5, 1.0, 2.0, 5.0}) {
      auto below = contact_scene(near, g, floor_node(k, 0), body({{0, 0, 5}, {0, 0, 3.901}}, {0}, 0));
      below.init();
      below.at<"balls">().state().velocity[1][2] = up * g * dt;
      for (int i = 0; i < 30; ++i) below.animate(dt);
      CHECK(3.901 - below.at<"balls">().state().position[1][2] > way(g, 26));
    }
  }
}

TEMPLATE_TEST_CASE("an assembled system has the contacts that come and go", "",
                   SparseLDLSolver<CompressedRowSparseMatrixMat3x3d>,
                   CGLinearSolver<CompressedRowSparseMatrixMat3x3d>) {
  auto sim = ball_on_floor<TestType>();
  auto matrixFree = ball_on_floor<CGLinearSolver<>>();
  sim.init();
  matrixFree.init();
  bool touched = false;
  for (int i = 0; i < 300; ++i) {
    sim.animate(0.01);
    matrixFree.animate(0.01);
    touched = touched || !sim.root().template get<Contacts>().contacts.empty();
    // one point: conjugate gradients solve the 3 x 3 system but for rounding and their tolerance, 1e-5 of the
    // change of velocity in a step
    REQUIRE(
        (sim.template at<"ball">().state().position[0] - matrixFree.template at<"ball">().state().position[0])
            .norm() < 1e-6);
  }
  CHECK(touched);
}

TEST_CASE("two balls that collide keep their momentum, and so does a third that is hit") {
  auto sim = contact_scene(
      near,
      0,
      node<"balls">(
          EulerImplicitSolver{},
          CGLinearSolver<>{.iterations = 50, .tolerance = 1e-14},
          node<"a">(
              MechanicalObject<Vec3d>{.position = {{0, 0, 0}}, .velocity = {{3, 0.1, 0}}},
              UniformMass<Vec3d>{.vertexMass = 2},
              SphereCollisionModel<Vec3d>{.contactStiffness = 30, .contactFriction = 0.3, .radius = 0.5}),
          node<"b">(
              MechanicalObject<Vec3d>{.position = {{1.3, 0.2, 0}, {2.6, 0, 0.1}}},
              UniformMass<Vec3d>{.vertexMass = 3},
              SphereCollisionModel<Vec3d>{
                  .selfCollision = true, .contactStiffness = 30, .contactFriction = 0.2, .radius = 0.5})));
  sim.init();
  auto momentum = [&] {
    auto& a = sim.at<"balls/a">().state();
    auto& b = sim.at<"balls/b">().state();
    return Eigen::Vector3d(2 * a.velocity[0] + 3 * (b.velocity[0] + b.velocity[1]));
  };
  const Eigen::Vector3d before = momentum();
  std::size_t maximum = 0;
  for (int i = 0; i < 400; ++i) {
    sim.animate(0.005);
    maximum = std::max(maximum, sim.root().get<Contacts>().contacts.size());
    REQUIRE((momentum() - before).norm() < 1e-12 * 400);
  }
  CHECK(maximum == 2);
  CHECK(sim.at<"balls/b">().state().velocity[1][0] > 0.5);  // the third one moves
}

}  // namespace test_contact_scenes
