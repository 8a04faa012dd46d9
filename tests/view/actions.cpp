// SPDX-License-Identifier: BSL-1.0
#include "catch.hpp"
#include "error_of.hpp"

#include <sinew/collision/contact_responses.hpp>
#include <sinew/contact.hpp>
#include <sinew/mechanics.hpp>
#include <sinew/topology/regular_grid.hpp>
#include <sinew/view/stage.hpp>

namespace test_actions {

using namespace sinew;
using view::ActionKind;
using view::UserActions;

// soft tissue that hangs on one side, and may be grasped
auto tissue() {
  Mesh mesh = regular_grid_tetrahedra(4, 3, 3, {0, 0, 0}, {1, 0.5, 0.5});
  mesh.triangles = border_of(mesh.tetrahedra, {}).triangles;
  return Simulation{node<"root">(
      Gravity{{0, -9.81, 0}},
      DefaultPipeline{},
      BruteForceBroadPhase{},
      BVHNarrowPhase{},
      MinProximityIntersection{.alarmDistance = 0.02, .contactDistance = 0.01},
      DefaultContactManager{},
      EulerImplicitSolver{.rayleighStiffness = 0.05, .rayleighMass = 0.1},
      CGLinearSolver<>{.iterations = 30, .tolerance = 1e-8},
      node<"body">(
          MeshTopology{
              .position = mesh.positions, .triangles = mesh.triangles, .tetrahedra = mesh.tetrahedra},
          MechanicalObject<Vec3d>{},
          UniformMass<Vec3d>{.totalMass = 1},
          TetrahedronFEMForceField<Vec3d>{.youngModulus = {3000}, .poissonRatio = 0.3},
          FixedConstraint<Vec3d>{.indices = {0, 4, 8, 12}},
          TriangleCollisionModel<Vec3d>{}))};
}
template <class Simulation>
int line_of(Simulation& sim, std::string_view className) {
  const auto tree = view::scene_tree(sim);
  for (std::size_t i = 0; i < tree.size(); ++i)
    if (tree[i].className == className) return int(i);
  return -1;
}
// until a replay has ended
void wait_for(view::Stage& stage) {
  stage.settle();
  while (stage.state().replaying) std::this_thread::yield();
  stage.settle();
}

TEST_CASE("what was done is done again, to the same bits") {
  auto sim = tissue();
  sim.init();
  const int fem = line_of(sim, "TetrahedronFEMForceField<Vec3d>"), mass = line_of(sim, "UniformMass<Vec3d>");
  UserActions actions;
  Vec3d::VecCoord expected;
  {
    view::Stage stage(sim, 0.01, 0);
    auto steps = [&](int n) {
      for (int i = 0; i < n; ++i) stage.step();
    };
    stage.setField(mass, "totalMass", "2");
    steps(3);
    stage.record(true);
    stage.settle();
    CHECK(stage.state().recording);
    CHECK(stage.state().step == 0);
    steps(5);
    stage.press({0.6, 0.2, 3}, {0, 0, -1}, 100);
    stage.move({0.8, 0.4, 3}, {0, 0.01, -1});
    steps(4);
    stage.settle();
    CHECK(stage.state().held);
    stage.setField(fem, "youngModulus", "1500");
    steps(4);
    stage.undo();
    stage.setField(fem, "poissonRatio", "0.25");
    stage.setField(fem, "poissonRatio", "0.75");  // is refused
    stage.release();
    steps(6);
    stage.record(false);
    stage.recorded([&](UserActions const& all) { actions = all; });
    stage.settle();
    CHECK_FALSE(stage.state().recording);
    CHECK(actions.steps == 19);
    CHECK(actions.actions.size() == 7);
    CHECK(actions.actions[0].action.words == "2");
    CHECK(actions.actions[1].step == 5);
    expected = sim.at<"body">().state().position;
    // here again
    stage.step();
    stage.replay(actions);
    wait_for(stage);
    CHECK(stage.state().error.empty());
    CHECK(stage.state().step == 19);
    CHECK_FALSE(stage.state().playing);
    CHECK(sim.at<"body">().state().position == expected);
  }
  // through a file, in another program
  auto other = tissue();
  other.init();
  view::Stage stage(other, 0.01, 0);
  stage.replay(view::read_actions(view::actions_text(actions), "a.actions"));
  wait_for(stage);
  CHECK(other.at<"body">().state().position == expected);
  // what a user does meanwhile ends a replay
  UserActions endless = actions;
  endless.steps = 1000000;
  stage.replay(endless);
  stage.settle();
  CHECK(stage.state().replaying);
  stage.reset();
  stage.settle();
  CHECK_FALSE(stage.state().replaying);
  endless.dt = 0.02;
  stage.play(false);
  stage.replay(endless);
  stage.settle();
  CHECK(stage.state().error.find("start it with --dt 0.02") != std::string::npos);
}

TEST_CASE("a simulation that was kept goes on from there to the same bits") {
  auto sim = tissue();
  sim.init();
  view::Stage stage(sim, 0.01, 0);
  auto go_on = [&] {
    for (int i = 0; i < 10; ++i) stage.step();
    stage.settle();
    return sim.at<"body">().state().position;
  };
  stage.restore();
  stage.settle();
  CHECK(stage.state().error.find("nothing was kept") != std::string::npos);
  go_on();
  stage.press({0.6, 0.2, 3}, {0, 0, -1}, 100);
  stage.keep();
  stage.settle();
  CHECK(stage.state().held);  // here, and not in what is kept
  stage.restore();
  stage.settle();
  CHECK_FALSE(stage.state().held);
  const auto first = go_on();
  stage.setField(line_of(sim, "UniformMass<Vec3d>"), "totalMass", "3");
  CHECK(go_on() != first);
  stage.restore();
  stage.settle();
  CHECK(stage.state().step == 10);
  CHECK(go_on() == first);
  stage.restore();
  CHECK(go_on() == first);
}

TEST_CASE("files of actions say what is wrong in them") {
  auto wrong = [](std::string_view content) { return error_of([&] { view::read_actions(content, "a"); }); };
  CHECK(wrong("") == "a: the file is not whole: its last line says when it ends, as in '100 end'");
  CHECK(wrong("sinew record 1\n").starts_with("a:1: this is no file of actions"));
  CHECK(wrong("sinew actions 1\ndt 0\n").starts_with("a:2: dt is"));
  CHECK(wrong("sinew actions 1\ndt nan\n").starts_with("a:2: dt is"));
  const std::string head = "sinew actions 1\ndt 0.01\n";
  CHECK(wrong(head + "5 pull 1 2 3\n").starts_with("a:3: 'pull' is not one of press, move"));
  CHECK(wrong(head + "x release\n").starts_with("a:3: 'x' is no whole number"));
  CHECK(wrong(head + "5 release\n4 release\n").starts_with("a:4: step 4 comes behind step 5"));
  CHECK(wrong(head + "5 press 0 0 0 0 0 1\n").starts_with("a:3: ends where"));
  CHECK(wrong(head + "5 release now\n").starts_with("a:3: goes on with 'now'"));
  CHECK(wrong(head + "5 release\n").starts_with("a: the file is not whole"));
  const UserActions all = view::read_actions(
      head + "5 set 3 lists [1, 2] 3\n6 set 3 empty\n7 move 1 2 3 4 5 6e-300\n9 end\n", "a");
  REQUIRE(all.actions.size() == 3);
  CHECK(all.actions[0].action.words == "[1, 2] 3");
  CHECK(all.actions[1].action.words.empty());
  CHECK(all.actions[2].action.direction == Eigen::Vector3d(4, 5, 6e-300));
  CHECK(all.steps == 9);
  CHECK(view::actions_text(view::read_actions(view::actions_text(all), "b")) == view::actions_text(all));
}

}  // namespace test_actions
