// SPDX-License-Identifier: BSL-1.0
#include "catch.hpp"
#include "error_of.hpp"

#include <sinew/mechanics.hpp>
#include <sinew/view/window.hpp>

#include <cstdlib>

namespace test_window {

using namespace sinew;

auto triangle() {
  return Simulation{node<"root">(
      EulerExplicitSolver{},
      node<"body">(MeshTopology{.position = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, .triangles = {{0, 1, 2}}},
                   MechanicalObject<Vec3d>{},
                   UniformMass<Vec3d>{}))};
}

TEST_CASE("a window shows the scene beside its panel, and goes on while a simulation runs") {
  auto sim = triangle();
  sim.init();
  view::Stage stage(sim, 0.001);
  if (!std::getenv("DISPLAY")) {
    const std::string wrong = error_of([&] { view::Window window(stage); });
    CHECK(wrong.starts_with("view: there is no display to open a window on"));
    CHECK(wrong.ends_with("(sinew run --png)"));
    return;
  }
  view::Window window(stage, {.width = 800, .height = 600});
  window.frame();
  view::Image image = window.image();
  REQUIRE(image.width == 800);
  REQUIRE(image.height == 600);
  // the middle of the triangle, and a place that has nothing
  const Eigen::Vector3d at = window.controls().camera.project({1. / 3, 1. / 3, 0}, 800 - 340, 600);
  const auto face = image.at(340 + int(at[0]), int(at[1]));
  CHECK(face[0] > face[2] + 50);  // orange
  const auto beside = image.at(798, 2);
  CHECK(beside == std::array<unsigned char, 3>{255, 255, 255});
  CHECK(image.at(2, 598) != beside);  // the panel
  // a component is selected, and has its fields in the panel; its mass is changed, and that is taken back
  const auto without = window.image();
  window.scenePanel().select(5);
  stage.setField(5, "totalMass", "4");
  stage.settle();
  window.frame();
  const auto with = window.image();
  REQUIRE(stage.state().selected);
  CHECK(stage.state().selected->className == "UniformMass<Vec3d>");
  int changed = 0;
  for (int y = 300; y < 600; ++y)
    for (int x = 0; x < 340; ++x) changed += without.at(x, y) != with.at(x, y);
  CHECK(changed > 500);
  stage.undo();
  stage.settle();
  CHECK(stage.state().redo->after == "4");
  // what is shown, without the colour of the body
  view::SeenSettings settings;
  settings.looks = {{.path = "/root/body", .visible = false}};
  window.showPanel().set(settings);
  stage.settle();
  window.frame();
  CHECK(window.image().at(340 + int(at[0]), int(at[1])) == std::array<unsigned char, 3>{255, 255, 255});
  window.showPanel().set({});
  // each part of the panel is another one
  stage.measure(true);
  stage.step();
  stage.settle();
  view::Image last = window.image();
  for (char const* part : {"Show", "Tools", "Plots", "Scene"}) {
    window.open(part);
    window.frame();
    view::Image now = window.image();
    CHECK(now.rgb != last.rgb);
    last = std::move(now);
  }
  window.controls().lookAlong(1);
  CHECK(window.controls().camera.right().allFinite());
  stage.play(true);
  while (stage.state().step < 10) window.frame();
  stage.play(false);
  stage.settle();
  CHECK(stage.state().error.empty());
}

}  // namespace test_window
