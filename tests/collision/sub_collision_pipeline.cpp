// SPDX-License-Identifier: BSL-1.0
// Pipelines among some of the models: each as if the others were not there; and what is refused.
#include <sinew/collision/sub_collision_pipeline.hpp>
#include <sinew/lagrangian.hpp>

#include "collision/contact_scene.hpp"
#include "error_of.hpp"

namespace test_sub_collision_pipeline {

using namespace sinew;
using V = Eigen::Vector3d;
using Method = MinProximityIntersection;

namespace {

template <FixedString Name>
auto ball(V const& x, V const& v = {0, 0, 0}) {
  return node<Name>(EulerImplicitSolver{},
                    CGLinearSolver<>{.iterations = 50, .tolerance = 1e-12},
                    MechanicalObject<Vec3d>{.position = {x}, .velocity = {v}},
                    UniformMass<Vec3d>{.vertexMass = 1},
                    SphereCollisionModel<Vec3d>{.contactStiffness = 100, .contactDamping = 20, .radius = 0.5});
}
template <FixedString Name>
auto pipeline(std::string const& models, Method method,
              std::string const& response = "PenalityContactForceField") {
  return node<Name>(SubCollisionPipeline{.collisionModels = models},
                    BruteForceBroadPhase{},
                    BVHNarrowPhase{},
                    method,
                    Contacts{.response = response});
}
constexpr Method wide{.alarmDistance = 0.6, .contactDistance = 0.5},
    narrow{.alarmDistance = 0.2, .contactDistance = 0.1};

template <class Sim>
std::vector<V> motion(Sim& sim, auto&& state, int steps = 200) {
  std::vector<V> all;
  sim.init();
  for (int i = 0; i < steps; ++i) {
    sim.animate(0.005);
    all.push_back(state(sim));
  }
  return all;
}
auto of_a = [](auto& sim) -> V { return sim.template at<"a">().state().position[0]; };
auto of_b = [](auto& sim) -> V { return sim.template at<"b">().state().position[0]; };

}  // namespace

TEST_CASE("each pipeline has its models, distances and response, and the floor is in both") {
  // the balls go through each other, since no pipeline has both
  const V fromA(0, 0, 1.2), fromB(0.1, 0, 1.4), down(0, 0, -1);
  auto both = [&](auto&& state) {
    Simulation sim{node<"root">(Gravity{{0, 0, -10}},
                                pipeline<"wide">("a floor", wide),
                                pipeline<"narrow">("b/SphereCollisionModel floor", narrow),
                                floor_node(100, 0),
                                ball<"a">(fromA),
                                ball<"b">(fromB, down))};
    return motion(sim, state);
  };
  auto alone = [&](Method method, auto const& body, auto&& state) {
    Simulation sim{node<"root">(Gravity{{0, 0, -10}},
                                DefaultPipeline{},
                                BruteForceBroadPhase{},
                                BVHNarrowPhase{},
                                method,
                                Contacts{},
                                floor_node(100, 0),
                                body)};
    return motion(sim, state);
  };
  const auto a = both(of_a), b = both(of_b);
  CHECK(a == alone(wide, ball<"a">(fromA), of_a));
  CHECK(b == alone(narrow, ball<"b">(fromB, down), of_b));
  CHECK(a.back()[2] > 0.9);  // above the contact distances: by what they have been pushed
  double least = 10;
  for (V const& x : b) least = std::min(least, x[2]);
  CHECK(least < 0.65);
}

TEST_CASE("multipliers and penalties stand side by side, and balls of one pipeline meet") {
  Simulation sim{node<"root">(FreeMotionAnimationLoop{},
                              BlockGaussSeidelConstraintSolver{.maxIterations = 1000, .tolerance = 1e-10},
                              Gravity{{0, 0, -10}},
                              pipeline<"hard">("a floor", narrow, "FrictionContactConstraint"),
                              pipeline<"soft">("a b", wide),
                              floor_node(100, 0),
                              ball<"a">({0, 0, 0.7}),
                              ball<"b">({0, 0, 2.3}))};
  sim.init();
  for (int i = 0; i < 4000; ++i) sim.animate(0.005);
  // the lower one stands at the contact distance, with the weight of both; between them 10 N at
  // 100 * 100 / (0.5 + 1) N/m
  CHECK(of_a(sim)[2] == Approx(0.6).margin(1e-6));
  CHECK(of_b(sim)[2] == Approx(0.6 + 1.5 - 10 / (100 * 100 / 1.5)).margin(1e-5));
  double onFloor = 0;
  for (Contact const& c : sim.at<"hard">().get<Contacts>().contacts) onFloor += c.force[2];
  CHECK(onFloor == Approx(20).margin(1e-3));
}

TEST_CASE("an attachment pulls what a pipeline that lists models has") {
  Simulation sim{node<"root">(pipeline<"one">("a", narrow),
                              pipeline<"two">("a b", narrow),
                              ball<"a">({0, 0, 0}),
                              ball<"b">({5, 0, 0}))};
  sim.init();
  const auto pick = sim.pick({0, 0, 3}, {0, 0, -1});
  REQUIRE(pick);
  const int id = sim.attach(*pick, {.stiffness = 100, .damping = 5});
  CHECK(sim.pull(id, {1, 0, 0.5}));
  for (int i = 0; i < 2000; ++i) sim.animate(0.005);
  CHECK((of_a(sim) - V(1, 0, 0)).norm() < 1e-3);
  CHECK(sim.release(id));
}

TEST_CASE("wrong lists say what is wrong") {
  using Catch::Contains;
  auto with = [](auto const& pipelines) {
    Simulation sim{node<"root">(pipelines, floor_node(100, 0), ball<"a">({0, 0, 1}))};
    return error_of([&] { sim.init(); });
  };
  CHECK(with(pipeline<"p">("a floor", narrow)).empty());
  CHECK(with(pipeline<"p">("/a @floor/TriangleCollisionModel", narrow)).empty());
  CHECK(with(pipeline<"p">("/", narrow)).empty());
  CHECK_THAT(with(pipeline<"p">("", narrow)),
             Contains("p: SubCollisionPipeline") && Contains("collisionModels is empty"));
  CHECK_THAT(with(pipeline<"p">("a flor", narrow)),
             Contains("'flor'") && Contains("floor/TriangleCollisionModel"));
  CHECK_THAT(with(pipeline<"p">("a/TriangleCollisionModel", narrow)),
             Contains("where there is no collision model"));
  Simulation sim{node<"root">(pipeline<"p">("a", narrow),
                              node<"other">(DefaultPipeline{},
                                            BruteForceBroadPhase{},
                                            BVHNarrowPhase{},
                                            Method{},
                                            Contacts{},
                                            ball<"b">({0, 0, 1})),
                              ball<"a">({0, 0, 1}))};
  CHECK_THAT(error_of([&] { sim.init(); }),
             Contains("other") && Contains("another pipeline of the scene lists"));
}

}  // namespace test_sub_collision_pipeline
