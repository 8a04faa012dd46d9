// SPDX-License-Identifier: BSL-1.0
// A step of the scene in smaller ones.
#include <sinew/contact.hpp>
#include <sinew/control/multi_step_animation_loop.hpp>
#include <sinew/lagrangian.hpp>
#include <sinew/mechanics.hpp>

#include "catch.hpp"
#include "error_of.hpp"

namespace test_multi_step {

using namespace sinew;
using Eigen::Vector3d;

namespace {

/// All pairs, and how often it was asked for them.
struct CountingPhase : BruteForceBroadPhase {
  static constexpr std::string_view className = "CountingPhase";
  int asked = 0;

  template <class F>
  void pairs(std::span<CollisionSurface* const> surfaces, F&& f) {
    ++asked;
    BruteForceBroadPhase::pairs(surfaces, f);
  }
};

/// Counts what is called after steps, and keeps the last.
struct Watch {
  using Role = role::StepCallback;
  static constexpr std::string_view className = "Watch";
  static constexpr auto fields() { return field_list(); }
  int calls = 0;
  StepInfo last{};
  void call(StepInfo const& step) { ++calls, last = step; }
};

/// A particle that falls onto a triangle that stands.
template <class... More>
auto drop(More... more) {
  MeshTopology triangle;
  triangle.triangles = {{0, 1, 2}};
  return Simulation(
      node<"root">(more...,
                   Gravity{.gravity = {0, 0, -10}},
                   DefaultPipeline{},
                   CountingPhase{},
                   BVHNarrowPhase{},
                   MinProximityIntersection{.alarmDistance = 0.1, .contactDistance = 0.05},
                   DefaultContactManager{},
                   Watch{},
                   node<"floor">(triangle,
                                 MechanicalObject<Vec3d>{.position = {{-1, -1, 0}, {1, -1, 0}, {0, 1, 0}}},
                                 TriangleCollisionModel<Vec3d>{.contactStiffness = 500}),
                   node<"ball">(EulerImplicitSolver{},
                                CGLinearSolver<>{.iterations = 10, .tolerance = 1e-14},
                                MechanicalObject<Vec3d>{.position = {{0, 0, 0.12}}},
                                UniformMass<Vec3d>{.vertexMass = 0.1},
                                PointCollisionModel<Vec3d>{.contactStiffness = 500})));
}
template <class Sim>
Vector3d place(Sim& sim) {
  return sim.template at<"ball">().state().position[0];
}
template <class Sim>
int detections(Sim& sim) {
  return sim.root().template get<CountingPhase>().asked;
}

}  // namespace

TEST_CASE("a step of six parts is six steps, with contacts found before each two or all of them") {
  auto whole = drop();
  whole.init();
  for (const int each : {1, 2}) {
    auto parted = drop(MultiStepAnimationLoop{.collisionSteps = 6 / each, .integrationSteps = each});
    auto stepped = drop();
    parted.init(), stepped.init();
    double highest = 0;
    for (int step = 1; step <= 30; ++step) {
      parted.animate(0.012);
      for (int i = 0; i < 6; ++i) stepped.animate(0.002);
      // a contact that is found one small step later, at 1 m/s
      CHECK((place(parted) - place(stepped)).norm() < (each == 1 ? 1e-12 : 2e-3));
      CHECK(detections(parted) == step * 6 / each);
      auto const& watch = parted.root().template get<Watch>();
      CHECK(watch.calls == step);
      CHECK(watch.last.step == step);
      CHECK(watch.last.dt == 0.012);
      CHECK(watch.last.time == parted.time());
      CHECK_THAT(parted.time(), Catch::Matchers::WithinRel(0.012 * step, 1e-12));
      if (step > 15) highest = std::max(highest, place(parted)[2]);
    }
    CHECK(highest > 0.03);  // the floor has held it
  }
}

TEST_CASE("a free fall in parts has the error of the smaller steps") {
  // symplectic Euler: z - g t^2/2 = g t h/2 with h the step that is integrated
  const double t = 1, dt = 0.1, g = 10;
  for (const int n : {1, 4, 10}) {
    Simulation sim(node<"root">(MultiStepAnimationLoop{.collisionSteps = 1, .integrationSteps = n},
                                Gravity{.gravity = {0, 0, -g}},
                                node<"ball">(EulerExplicitSolver{},
                                             MechanicalObject<Vec3d>{.position = {{0, 0, 0}}},
                                             UniformMass<Vec3d>{.vertexMass = 1})));
    sim.init();
    for (int i = 0; i < 10; ++i) sim.animate(dt);
    const double error = -g * t * t / 2 - sim.at<"ball">().state().position[0][2];
    CHECK_THAT(error, Catch::Matchers::WithinRel(g * t * dt / n / 2, 1e-10));
  }
}

TEST_CASE("a division of steps that cannot be is said") {
  auto says = [](auto& sim, std::string_view words) {
    return error_of([&] { sim.init(); }).find(words) != std::string::npos;
  };
  auto none = drop(MultiStepAnimationLoop{.collisionSteps = 0});
  CHECK(says(none, "collisionSteps"));
  auto negative = drop(MultiStepAnimationLoop{.integrationSteps = -3});
  CHECK(says(negative, "integrationSteps"));

  auto joined = [](MultiStepAnimationLoop const& division) {
    return Simulation(node<"root">(division,
                                   FreeMotionAnimationLoop{},
                                   BlockGaussSeidelConstraintSolver{},
                                   node<"ball">(EulerImplicitSolver{},
                                                SparseLDLSolver<>{},
                                                MechanicalObject<Vec3d>{.position = {{0, 0, 0}}},
                                                UniformMass<Vec3d>{.vertexMass = 1},
                                                LinearSolverConstraintCorrection{},
                                                FixedLagrangianConstraint<Vec3d>{.indices = {0}})));
  };
  auto several = joined({.collisionSteps = 1, .integrationSteps = 2});
  CHECK(says(several, "constraints by multipliers are those of one integration"));
  CHECK(says(several, "raise collisionSteps"));
  auto one = joined({.collisionSteps = 2, .integrationSteps = 1});
  one.init();
  one.animate(0.01);
  CHECK(one.at<"ball">().state().position[0].norm() < 1e-9);
}

}  // namespace test_multi_step
