// SPDX-License-Identifier: BSL-1.0
#include "catch.hpp"

#include <sinew/view/picture.hpp>
#include <sinew/view/view_settings.hpp>

namespace test_lights {

using namespace sinew;
using view::SeenLight;
using view::SeenScene;

// a white square of 2 m in the plane z = 0, and a small one that may stand in the light
SeenScene plate(bool shade = false) {
  SeenScene scene;
  auto add = [&](double half, double x, double z) {
    view::SeenBody body{.path = "/root/plate", .kind = view::SeenBody::Kind::visual, .colour = {1, 1, 1}};
    body.points = {{x - half, -half, z}, {x + half, -half, z}, {x + half, half, z}, {x - half, half, z}};
    body.triangles = {{0, 1, 2}, {0, 2, 3}};
    scene.bodies.push_back(body);
  };
  add(1, 0, 0);
  if (shade) add(0.2, 0.8, 0.8);
  scene.settings.background = Eigen::Vector3d(0, 0, 0);
  scene.settings.ambient = Eigen::Vector3d(0, 0, 0);
  scene.settings.shadows = false;
  return scene;
}
// from the front, a pixel at a place of the plate
struct Seen {
  view::Camera camera{.target = {0, 0, 0}, .toEye = {0, 0, 1}, .distance = 4, .angle = 40};
  view::Image image;
  explicit Seen(SeenScene const& scene)
      : image(view::Painter({.width = 200, .height = 200, .camera = camera}).paint(scene)) {}
  std::array<unsigned char, 3> at(double x, double y) const {
    const Eigen::Vector3d p = camera.project({x, y, 0}, 200, 200);
    return image.at(int(p[0]), int(p[1]));
  }
};
int brightness(std::array<unsigned char, 3> pixel) { return (pixel[0] + pixel[1] + pixel[2]) / 3; }

TEST_CASE("what is behind a body shows through by what its opacity leaves, in the order of depth") {
  // a white plate, and before it others at z, listed in any order
  struct Pane {
    double z, opacity;
    Eigen::Vector3d colour;
  };
  auto seen = [](std::vector<Pane> const& panes, bool shadows = false) {
    SeenScene scene = plate();
    for (Pane const& pane : panes) {
      scene.bodies.push_back(scene.bodies[0]);
      view::SeenBody& body = scene.bodies.back();
      for (auto& p : body.points) p = {p[0] / 2, p[1] / 2, pane.z};
      body.colour = pane.colour, body.opacity = pane.opacity;
    }
    scene.settings.ambient = Eigen::Vector3d::Constant(shadows ? 0.1 : 0.8);
    scene.settings.shadows = shadows;
    if (shadows) scene.settings.lights = {{.direction = Eigen::Vector3d(-1, 0, 1).normalized()}};
    return Seen(scene);
  };
  auto alone = [&](Eigen::Vector3d const& colour, double z) { return seen({{z, 1, colour}}).at(0, 0); };
  const Eigen::Vector3d red(1, 0.1, 0.1), blue(0.1, 0.2, 1);
  const auto white = seen({}).at(0, 0);
  for (const double opacity : {0., 0.25, 0.7}) {
    const auto through = seen({{0.3, opacity, red}}).at(0, 0), front = alone(red, 0.3);
    for (std::size_t c = 0; c < 3; ++c)
      CHECK(through[c] == Approx(opacity * front[c] + (1 - opacity) * white[c]).margin(1.5));
  }
  // the far one first, whichever is listed first
  for (const bool farFirst : {true, false}) {
    const Pane far{0.2, 0.5, red}, near{0.4, 0.5, blue};
    const auto both = (farFirst ? seen({far, near}) : seen({near, far})).at(0, 0);
    const auto ofFar = alone(red, 0.2), ofNear = alone(blue, 0.4);
    for (std::size_t c = 0; c < 3; ++c)
      CHECK(both[c] == Approx(0.5 * ofNear[c] + 0.25 * ofFar[c] + 0.25 * white[c]).margin(1.5));
  }
  // what is opaque before it hides it, and it throws no shadow
  CHECK(seen({{0.2, 0.5, red}, {0.4, 1, blue}}).at(0, 0) == alone(blue, 0.4));
  const double aside = 0.5 + 0.3 / 2;  // beside the pane, in the middle of its shadow there
  CHECK(brightness(seen({{0.3, 1, red}}, true).at(aside, 0)) < brightness(seen({}, true).at(aside, 0)) - 40);
  CHECK(seen({{0.3, 0.5, red}}, true).at(aside, 0) == seen({}, true).at(aside, 0));
}

TEST_CASE("lights of a scene shine from where they are, in their colours") {
  SeenScene scene = plate();
  // none, and nothing from all sides: the light of the eye alone; a parallel one from the front is brighter
  // than one askew, by the cosine
  scene.settings.lights = {{.direction = {0, 0, 1}}};
  const int front = brightness(Seen(scene).at(0.5, 0.5));
  scene.settings.lights = {{.direction = Eigen::Vector3d(2, 0, 1).normalized()}};
  const int askew = brightness(Seen(scene).at(0.5, 0.5));
  CHECK(front > 180);
  // 0.75 cos(angle) in linear light, without the shine that lies elsewhere
  CHECK(askew == Approx(255 * std::pow(0.75 / std::sqrt(5.), 1 / 2.2)).margin(4));
  scene.settings.lights = {{.direction = Eigen::Vector3d(2, 0, 0.001).normalized()}};
  CHECK(brightness(Seen(scene).at(0.5, 0.5)) < 30);
  // a red one
  scene.settings.lights = {{.colour = {1, 0, 0}, .direction = Eigen::Vector3d(1, 0, 1).normalized()}};
  auto red = Seen(scene).at(0.5, 0.5);
  CHECK(red[0] > 150);
  CHECK(red[1] == 0);
  // two add up
  scene.settings.lights.push_back({.colour = {0, 1, 0}, .direction = Eigen::Vector3d(-1, 0, 1).normalized()});
  red = Seen(scene).at(0.5, 0.5);
  CHECK(red[0] > 150);
  CHECK(red[1] > 150);
  CHECK(red[2] == 0);
  // a point near a corner lights that; with attenuation less
  SeenLight point{.kind = SeenLight::Kind::point, .position = {0.8, 0.8, 0.5}};
  scene.settings.lights = {point};
  const Seen near(scene);
  CHECK(brightness(near.at(0.8, 0.8)) > brightness(near.at(-0.8, -0.8)) + 80);
  point.attenuation = 2;
  scene.settings.lights = {point};
  CHECK(brightness(Seen(scene).at(0.8, 0.8)) < brightness(near.at(0.8, 0.8)) - 40);
  // a spot lights its cone alone
  scene.settings.lights = {{.kind = SeenLight::Kind::spot,
                            .position = {-0.5, 0, 1},
                            .direction = {0, 0, -1},
                            .cutoff = 20,
                            .exponent = 1}};
  const Seen spot(scene);
  CHECK(brightness(spot.at(-0.5, 0.1)) > 150);
  CHECK(brightness(spot.at(-0.5, 0.5)) < 10);  // tan(20 degrees) is 0.36
  CHECK(brightness(spot.at(0.5, 0)) < 10);
  // one that moves with the camera is at the eye, 4 m before the plate
  scene.settings.lights = {{.kind = SeenLight::Kind::spot,
                            .position = {0, 0, 0},
                            .direction = {0, 0, -1},
                            .cutoff = 5,
                            .exponent = 0,
                            .movesWithCamera = true}};
  const Seen eye(scene);
  CHECK(brightness(eye.at(0.1, 0.2)) > 150);
  CHECK(brightness(eye.at(0.6, 0)) < 10);
  // what comes from all sides
  scene.settings.lights = {{.colour = {0, 0, 0}}};
  scene.settings.ambient = Eigen::Vector3d(0, 0, 0.5);
  const auto blue = Seen(scene).at(0, 0);
  CHECK(blue[0] == 0);
  CHECK(int(blue[2]) == Approx(255 * std::pow(0.5, 1 / 2.2)).margin(3));
}

TEST_CASE("the first parallel light of a scene throws shadows") {
  SeenScene scene = plate(true);
  scene.settings.lights = {{.kind = SeenLight::Kind::point, .colour = {0, 0, 0}},
                           {.direction = Eigen::Vector3d(1, 0, 1).normalized()}};
  // the small plate at x = 0.8, z = 0.8 stands before x = 0
  CHECK(brightness(Seen(scene).at(0, 0)) > 150);
  scene.settings.shadows = true;
  const Seen shaded(scene);
  CHECK(brightness(shaded.at(0, 0)) < 20);
  CHECK(brightness(shaded.at(-0.6, 0)) > 150);
}

TEST_CASE("light computed at the corners of small faces is that of the pixels of large ones") {
  SeenScene coarse = plate(true);
  coarse.settings.shadows = true;
  coarse.settings.lights = {
      {.colour = {1, 0.8, 0.6}, .direction = Eigen::Vector3d(1, 0.3, 1).normalized()},
      {.kind = SeenLight::Kind::point, .colour = {0.1, 0.15, 0.2}, .position = {0.5, 0.5, 2}}};
  coarse.settings.ambient = Eigen::Vector3d(0.1, 0.1, 0.1);
  SeenScene fine = coarse;
  view::SeenBody& body = fine.bodies[0];
  body.points.clear();
  body.triangles.clear();
  constexpr Index n = 120;
  for (Index i = 0; i <= n; ++i)
    for (Index j = 0; j <= n; ++j) body.points.push_back({2. * i / n - 1, 2. * j / n - 1, 0});
  for (Index i = 0; i < n; ++i)
    for (Index j = 0; j < n; ++j) {
      const Index a = i * (n + 1) + j, b = a + n + 1;
      body.triangles.insert(body.triangles.end(), {{a, b, b + 1}, {a, b + 1, a + 1}});
    }
  // from each side, with lights there
  for (const double side : {1., -1.}) {
    for (SeenScene* scene : {&coarse, &fine})
      for (SeenLight& light : scene->settings.lights)
        light.direction[2] = side * std::abs(light.direction[2]), light.position[2] = 2 * side;
    const view::Camera camera{.target = {0, 0, 0}, .toEye = {0, 0, side}, .distance = 4, .angle = 40};
    view::Painter painter({.width = 200, .height = 200, .camera = camera});
    const view::Image expected = painter.paint(coarse), image = painter.paint(fine);
    int bright = 0, dark = 0;
    double apart = 0;
    for (int y = 50; y < 150; ++y)
      for (int x = 50; x < 150; ++x) {
        (brightness(expected.at(x, y)) > 150 ? bright : dark) += 1;
        for (std::size_t c = 0; c < 3; ++c)
          apart += std::abs(int(expected.at(x, y)[c]) - int(image.at(x, y)[c])) / 30000.;
      }
    CHECK(bright > 1000);
    if (side > 0) CHECK(dark > 100);  // the shadow
    CHECK(apart < 2);                 // of 255; the edges of the shadow are less sharp between corners
  }
}

}  // namespace test_lights
