// SPDX-License-Identifier: BSL-1.0
// Engines in typed scenes: data links bring them what they follow, and take from them what they make.
#include "catch.hpp"
#include "error_of.hpp"

#include <sinew/sinew.hpp>

namespace test_scene_live_engines {

using namespace sinew;
using Catch::Matchers::Contains;
using Points = std::vector<Eigen::Vector3d>;
using State = MechanicalObject<Vec3d>;
using Chosen = PointsFromIndices<Vec3d>;
using Mean = AverageCoord<Vec3d>;

namespace {

auto body() {
  return node<"body">(EulerImplicitSolver{},
                      CGLinearSolver<>{.iterations = 50, .tolerance = 1e-14, .threshold = 1e-14},
                      State{.position = {{0, 0, 0}, {1, 0.5, 0}, {2, 0, 1}}},
                      UniformMass<Vec3d>{.totalMass = 3.0},
                      Chosen{.indices = {2, 0}});
}

}  // namespace

TEST_CASE("links of a typed scene carry values through engines after init, each step and reset") {
  Simulation sim{
      node<"root">(Gravity{{0, -10, 0}},
                   Mean{},
                   body(),
                   node<"selection">(State{.position = {{0, 0, 0}, {0, 0, 0}}},
                                     node<"seen">(VisualModel{.mesh = {.positions = {{0, 0, 0}}}})),
                   DataLink<At<"body", &State::position>, At<"body", &Chosen::position>>{},
                   DataLink<At<"body", &Chosen::chosen>, At<"selection", &State::position>>{},
                   DataLink<At<"selection", &State::position>, At<"", &Mean::position>>{},
                   DataLink<At<"", &Mean::average>, At<"selection/seen", &VisualModel::position>>{})};
  sim.init();
  auto check = [](auto& s) {
    Points const& x = s.template at<"body">().state().position;
    CHECK(s.template at<"selection">().state().position == Points{x[2], x[0]});
    const Eigen::Vector3d mean = s.root().template get<Mean>().average;
    CHECK(mean == Eigen::Vector3d((x[2] + x[0]) / 2.));
    CHECK(s.template at<"selection/seen">().visual().position[0] == Eigen::Vector3f(mean.cast<float>()));
  };
  check(sim);
  for (int step = 0; step < 10; ++step) {
    sim.animate(0.01);
    check(sim);
  }
  const Points there = sim.at<"selection">().state().position;
  auto copy = sim;
  copy.animate(0.01);
  check(copy);
  check(sim);
  sim.reset();
  check(sim);
  for (int step = 0; step < 10; ++step) sim.animate(0.01);
  CHECK(sim.at<"selection">().state().position == there);
}

TEST_CASE("links of a typed scene stand in the order in which values go") {
  Simulation wrong{node<"root">(body(),
                                node<"selection">(State{.position = {{0, 0, 0}, {0, 0, 0}}}),
                                DataLink<At<"body", &Chosen::chosen>, At<"selection", &State::position>>{},
                                DataLink<At<"body", &State::position>, At<"body", &Chosen::position>>{})};
  CHECK_THAT(
      error_of([&] { wrong.init(); }),
      Contains("/root") && Contains("leads into PointsFromIndices<Vec3d> behind one that leads out of it"));
  Simulation fewer{node<"root">(body(),
                                node<"selection">(State{.position = {{0, 0, 0}}}),
                                DataLink<At<"body", &State::position>, At<"body", &Chosen::position>>{},
                                DataLink<At<"body", &Chosen::chosen>, At<"selection", &State::position>>{})};
  CHECK_THAT(
      error_of([&] { fewer.init(); }),
      Contains("/root/selection: MechanicalObject<Vec3d>") && Contains("has 3 numbers and would have 6"));
  Simulation far{
      node<"root">(body(), DataLink<At<"body", &State::position>, At<"body", &Chosen::position>>{})};
  far.at<"body">().get<Chosen>().indices = {7};
  CHECK_THAT(error_of([&] { far.init(); }), Contains("/root/body: PointsFromIndices<Vec3d>: indices has 7"));
}

TEST_CASE("a force of a typed scene takes what is linked to it, and refuses what is wrong") {
  Simulation sim{
      node<"root">(Gravity{{0, 0, 0}},
                   body(),
                   node<"pulled">(EulerImplicitSolver{},
                                  CGLinearSolver<>{.iterations = 50, .tolerance = 1e-14, .threshold = 1e-14},
                                  State{.position = {{0, 0, 0}}},
                                  UniformMass<Vec3d>{.totalMass = 1.0},
                                  ConstantForceField<Vec3d>{.indices = {0}, .forces = {{0, 0, 0}}}),
                   Mean{},
                   DataLink<At<"body", &State::velocity>, At<"", &Mean::position>>{},
                   DataLink<At<"", &Mean::average>, At<"pulled", &ConstantForceField<Vec3d>::forces>>{})};
  sim.at<"body">().state().velocity = {{3, 0, 0}, {3, 0, 0}, {3, 0, 0}};
  sim.init();
  sim.animate(0.1);
  CHECK(sim.at<"pulled">().state().velocity[0][0] == Approx(0.3));
  Simulation two{node<"root">(
      body(),
      node<"pulled">(State{.position = {{0, 0, 0}}},
                     ConstantForceField<Vec3d>{.indices = {0}, .forces = {{0, 0, 0}}}),
      DataLink<At<"body", &State::velocity>, At<"pulled", &ConstantForceField<Vec3d>::forces>>{})};
  CHECK_THAT(error_of([&] { two.init(); }),
             Contains("/root/pulled: ConstantForceField<Vec3d>: forces has 3 entries for 1 indices"));
}

}  // namespace test_scene_live_engines
