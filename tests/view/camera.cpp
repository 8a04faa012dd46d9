// SPDX-License-Identifier: BSL-1.0
#include "catch.hpp"

#include <sinew/view/camera.hpp>

#include <random>

namespace test_camera {

using sinew::view::Camera;

TEST_CASE("a ray through the pixel of a point meets that point") {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> in(-1, 1);
  Camera camera{
      .target = {1, 2, 3}, .toEye = Eigen::Vector3d(1, 2, -0.5).normalized(), .distance = 7, .angle = 35};
  for (int i = 0; i < 100; ++i) {
    const Eigen::Vector3d p = camera.target + Eigen::Vector3d(in(random), in(random), in(random));
    const Eigen::Vector3d pixel = camera.project(p, 640, 480);
    const auto [origin, direction] = camera.ray(pixel[0], pixel[1], 640, 480);
    CHECK((p - origin).cross(direction).norm() < 1e-12 * 7);
    CHECK((p - origin).dot(direction) > 0);
  }
  // what is in the middle, to the right, and above
  CHECK((camera.project(camera.target, 640, 480).head<2>() - Eigen::Vector2d(320, 240)).norm() < 1e-10);
  CHECK(camera.project(camera.target + camera.right(), 640, 480)[0] > 320);
  CHECK(camera.project(camera.target + camera.above(), 640, 480)[1] < 240);
  CHECK(camera.project(camera.target + camera.toEye, 640, 480)[2] <
        camera.project(camera.target, 640, 480)[2]);
}

TEST_CASE("a sphere that fits touches the narrower edges of the picture") {
  for (const double aspect : {0.5, 1., 2.}) {
    Camera camera{.toEye = Eigen::Vector3d(1, 1, 1).normalized()};
    const Eigen::Vector3d centre(0.1, 0.2, 0.3);
    camera.fit(centre, 2, aspect);
    const int width = int(1000 * aspect), height = 1000;
    // the tangents from the eye: the outline is where they touch
    double reach = 0;
    for (int i = 0; i < 3600; ++i) {
      const double a = i * 3.14159265358979 / 1800, sine = 2 / camera.distance;
      const Eigen::Vector3d touch =
          centre + 2 * (sine * camera.toEye + std::sqrt(1 - sine * sine) * (std::cos(a) * camera.right() +
                                                                            std::sin(a) * camera.above()));
      const Eigen::Vector3d at = camera.project(touch, width, height);
      reach = std::max({reach, std::abs(at[0] / width * 2 - 1), std::abs(at[1] / height * 2 - 1)});
      CHECK((at[2] > 0 && at[2] < 1));
    }
    CHECK(reach == Approx(1).epsilon(1e-4));
  }
}

TEST_CASE("turning keeps the distance, and stops before the pole") {
  Camera camera{.toEye = {0, 0, 1}, .distance = 3};
  camera.orbit(0.3, 0.2);
  CHECK(camera.toEye.norm() == Approx(1));
  CHECK(std::asin(camera.toEye.dot(camera.up)) == Approx(0.2));
  for (int i = 0; i < 20; ++i) camera.orbit(0.1, 0.5);
  CHECK(std::asin(camera.toEye.dot(camera.up)) == Approx(89. / 180 * 3.14159265358979));
  CHECK(camera.right().allFinite());
}

}  // namespace test_camera
