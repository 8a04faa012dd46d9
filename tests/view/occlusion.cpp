// SPDX-License-Identifier: BSL-1.0
// Corners are darker than planes, by how much of the half ball above a place is behind a wall.
#include "catch.hpp"

#include <sinew/view/picture.hpp>

#include <cmath>

namespace test_occlusion {

using namespace sinew;
using view::Camera;
using view::Image;
using view::SeenScene;

constexpr int size = 300;

// light from all sides alone: what is seen is white where nothing hides it
SeenScene lit(std::vector<Eigen::Vector3d> points, std::vector<Quad> quads, bool occlusion = true) {
  SeenScene scene;
  scene.bodies.push_back({.path = "/root",
                          .kind = view::SeenBody::Kind::visual,
                          .points = std::move(points),
                          .quads = std::move(quads),
                          .colour = {1, 1, 1}});
  scene.settings.lights = {{.colour = {0, 0, 0}}};
  scene.settings.ambient = Eigen::Vector3d(1, 1, 1);
  scene.settings.occlusion = occlusion;
  return scene;
}
Camera camera() {
  Camera looks;
  looks.toEye = Eigen::Vector3d(-0.5, -0.2, 1).normalized();
  looks.up = {0, 1, 0};
  looks.fit({0, 0, 0.25}, 1.5, 1);
  return looks;
}
Image pictured(SeenScene const& scene) {
  return view::Painter({.width = size, .height = size, .camera = camera(), .seen = {}}).paint(scene);
}
// the light at a place, as the mean of 8 x 8 pixels
double light_at(Image const& image, Eigen::Vector3d const& place) {
  const Eigen::Vector3d at = camera().project(place, size, size);
  double sum = 0;
  for (int y = 0; y < 8; ++y)
    for (int x = 0; x < 8; ++x)
      sum += std::pow(image.at(int(at[0]) + x - 4, int(at[1]) + y - 4)[1] / 255., 2.2);
  return sum / 64;
}

// a floor, and a wall at x = 0.8
const std::vector<Eigen::Vector3d> corner{
    {-1, -1, 0}, {0.8, -1, 0}, {0.8, 1, 0}, {-1, 1, 0}, {0.8, -1, 1}, {0.8, 1, 1}};

TEST_CASE("a floor is as dark beside a wall as the wall hides of the half ball above it") {
  const Image image = pictured(lit(corner, {{0, 1, 2, 3}, {1, 2, 5, 4}}));
  const double radius =
      view::Renderer::occlusionRadius * (Eigen::Vector3d(0.8, 1, 1) - Eigen::Vector3d(-1, -1, 0)).norm() / 2;
  // The part of a ball of radius R that is farther than d from its middle: (1 - d/R)^2 (2 + d/R) / 4, and as
  // much of the half ball, of which the wall cuts the same. 16 points of it at 16 angles are 256, of which
  // neighbours stand for the same place: off by 1/16 at the most, and the mean of pixels at distances that
  // differ by 0.1 R adds 0.04 of the slope of 3/4.
  for (const double part : {0.15, 0.3, 0.5, 0.7, 0.9}) {
    INFO(part);
    const double hidden = (1 - part) * (1 - part) * (2 + part) / 4;
    CHECK(light_at(image, {0.8 - part * radius, 0, 0}) == Approx(1 - hidden).margin(0.09));
  }
  // far from it nothing is hidden, nor on the wall above
  CHECK(light_at(image, {0.8 - 1.3 * radius, 0.1, 0}) == Approx(1).margin(0.01));
  CHECK(light_at(image, {-0.5, -0.5, 0}) == Approx(1).margin(0.01));
  // both sides of the corner are as dark
  const double floor = light_at(image, {0.8 - 0.4 * radius, 0, 0}),
               wall = light_at(image, {0.8, 0, 0.4 * radius});
  CHECK(floor < 0.9);
  CHECK(wall == Approx(floor).margin(0.1));
}

TEST_CASE(
    "a free plane and a picture without occlusion have all of the light, and a body behind hides none") {
  const Image plane = pictured(lit(corner, {{0, 1, 2, 3}}));
  for (double x = -0.8; x < 0.8; x += 0.2) CHECK(light_at(plane, {x, 0.2, 0}) == Approx(1).margin(0.01));
  const Image without = pictured(lit(corner, {{0, 1, 2, 3}, {1, 2, 5, 4}}, false));
  CHECK(light_at(without, {0.75, 0, 0}) == Approx(1).margin(0.01));
  // a plate far above the floor, seen in front of it, is not beside it
  std::vector<Eigen::Vector3d> points = corner;
  for (auto const& p : {Eigen::Vector3d(-0.3, -0.3, 0.9),
                        Eigen::Vector3d(0.1, -0.3, 0.9),
                        Eigen::Vector3d(0.1, 0.3, 0.9),
                        Eigen::Vector3d(-0.3, 0.3, 0.9)})
    points.push_back(p);
  const Image above = pictured(lit(points, {{0, 1, 2, 3}, {6, 7, 8, 9}}));
  CHECK(light_at(above, {-0.1, 0, 0.9}) == Approx(1).margin(0.01));
  const Eigen::Vector3d edge = camera().project({0.1, 0, 0.9}, size, size);
  double least = 1;
  for (int x = int(edge[0]) + 4; x < int(edge[0]) + 20; ++x)
    least = std::min(least, std::pow(above.at(x, int(edge[1]))[1] / 255., 2.2));
  CHECK(least == Approx(1).margin(0.01));
}

}  // namespace test_occlusion
