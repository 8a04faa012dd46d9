// SPDX-License-Identifier: BSL-1.0
#include "catch.hpp"
#include "view/triangle.hpp"

#include <sinew/collision/contact_responses.hpp>
#include <sinew/contact.hpp>
#include <sinew/mechanics.hpp>
#include <sinew/view/controls.hpp>
#include <sinew/view/picture.hpp>
#include <sinew/view/stage.hpp>

#include <chrono>
#include <thread>

namespace test_stage {

using namespace sinew;
using test_view::triangle;
using view::Controls;

TEST_CASE("a stage does what it is told, and shows what there is") {
  auto sim = triangle();
  sim.init();
  view::Stage stage(sim, 0.01, 0);
  CHECK(stage.scene()->bodies.size() == 1);
  stage.step();
  stage.step();
  stage.settle();
  CHECK(stage.state().step == 2);
  CHECK(stage.state().time == Approx(0.02));
  CHECK_FALSE(stage.state().playing);
  stage.play(true);
  while (stage.state().step < 20) std::this_thread::yield();
  stage.play(false);
  stage.settle();
  const long stands = stage.state().step;
  stage.settle();
  CHECK(stage.state().step == stands);
  stage.reset();
  stage.settle();
  CHECK(stage.state().step == 0);
  // the tree of the scene
  REQUIRE(stage.tree.size() == 13);
  CHECK(stage.tree[0].name == "root");
  CHECK(stage.tree[8].name == "body");
  CHECK(stage.tree[8].depth == 1);
  CHECK(stage.tree[10].className == "MechanicalObject<Vec3d>");
}

TEST_CASE("a pointer that pulls moves a body, by the force that is shown") {
  auto sim = triangle();
  sim.init();
  view::Stage stage(sim, 0.01);
  const view::SeenScene first = *stage.scene();
  Controls controls(stage, view::camera_of(first, 400, 300));
  controls.stiffness = 200;
  const Eigen::Vector3d place(0.3, 0.3, 0);
  const Eigen::Vector3d at = controls.camera.project(place, 400, 300);
  const auto [origin, direction] = controls.camera.ray(at[0], at[1], 400, 300);
  REQUIRE(view::meets(first, origin, direction));
  controls.press(Controls::Button::left, at[0], at[1], 400, 300, true);
  stage.settle();
  REQUIRE(stage.state().held);
  CHECK((stage.state().held->target - place).norm() < 1e-9);
  controls.move(at[0] + 20, at[1], 400, 300);
  stage.settle();
  const Eigen::Vector3d target = stage.state().held->target;
  // the target is under the pointer, in the plane through the place that faces the eye
  CHECK((controls.camera.project(target, 400, 300).head<2>() - Eigen::Vector2d(at[0] + 20, at[1])).norm() <
        1e-6);
  auto momentum = [&] {
    Eigen::Vector3d sum = Eigen::Vector3d::Zero();
    for (auto const& v : sim.at<"body">().state().velocity) sum += v;
    return sum;
  };
  for (int i = 0; i < 5; ++i) {
    const Eigen::Vector3d before = momentum();
    stage.step();
    stage.settle();
    const Eigen::Vector3d force = stage.state().held->force;
    CHECK((momentum() - before - 0.01 * force).norm() < 1e-9);
    CHECK(force.dot(target - place) > 0);
  }
  controls.release();
  stage.settle();
  CHECK_FALSE(stage.state().held);
  // beside the body the camera turns, and nothing is pulled
  const Eigen::Vector3d eye = controls.camera.toEye;
  controls.press(Controls::Button::left, 2, 2, 400, 300, false);
  controls.move(30, 2, 400, 300);
  controls.release();
  stage.settle();
  CHECK((controls.camera.toEye - eye).norm() > 0.01);
  CHECK_FALSE(stage.state().held);
  // what is shifted stays below the pointer
  const Eigen::Vector2d was = controls.camera.project(controls.camera.target, 400, 300).head<2>();
  const Eigen::Vector3d middle = controls.camera.target;
  controls.press(Controls::Button::right, 200, 150, 400, 300, true);
  controls.move(230, 140, 400, 300);
  controls.release();
  CHECK((controls.camera.project(middle, 400, 300).head<2>() - was - Eigen::Vector2d(30, -10)).norm() < 1e-6);
}

TEST_CASE("what goes wrong stops a stage, which says so and goes on to be told") {
  auto sim = triangle();
  sim.init();
  view::Stage stage(sim, -1);
  stage.play(true);
  while (stage.state().error.empty()) std::this_thread::yield();
  CHECK(stage.state().error.find("dt") != std::string::npos);
  stage.reset();
  stage.settle();
  CHECK(stage.state().error.empty());
  CHECK_FALSE(stage.state().playing);
}

TEST_CASE("a scene that stands is not made again for those who look") {
  auto sim = test_view::triangle();
  sim.init();
  view::Stage stage(sim, 0.01, 0);
  auto looked = [&] {
    stage.scene();
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
    stage.settle();
    return stage.scene();
  };
  const view::Stage::Scene first = looked();
  CHECK(looked() == first);
  stage.step();
  stage.settle();
  const view::Stage::Scene second = looked();
  CHECK(second != first);
  CHECK(second->step == 1);
  CHECK(looked() == second);
  stage.show({.axes = true});
  stage.settle();
  CHECK(looked()->settings.axes);
}

TEST_CASE("a stage without a thread does what it is told when it has its turn") {
  auto sim = triangle();
  sim.init();
  view::Stage stage(sim, 0.01, 0, {}, view::Stage::WithoutThread{});
  stage.step();
  CHECK(stage.state().step == 0);
  stage.turn();
  CHECK(stage.state().step == 1);
  CHECK(stage.scene()->step == 1);
  stage.play(true);
  for (int i = 0; i < 5; ++i) stage.turn();
  CHECK(stage.state().step == 6);
  stage.scene();
  stage.turn();
  CHECK(stage.scene()->step == 7);
  stage.play(false);
  stage.turn();
  stage.turn();
  CHECK(stage.state().step == 7);
}

TEST_CASE("watching a simulation changes none of its bits") {
  auto watched = triangle(), alone = triangle();
  watched.at<"body">().state().velocity =
      alone.at<"body">().state().velocity = {{1, 0, 0}, {0, 2, 0}, {0, 0, 3}};
  watched.init();
  alone.init();
  {
    view::Stage stage(watched, 0.01, 0);
    stage.play(true);
    while (stage.state().step < 30) stage.scene();
    stage.play(false);
    stage.settle();
  }
  while (alone.step() < watched.step()) alone.animate(0.01);
  CHECK(watched.at<"body">().state().position == alone.at<"body">().state().position);
}

}  // namespace test_stage
