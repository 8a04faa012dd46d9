// SPDX-License-Identifier: BSL-1.0
// What a ray meets first in a scene.
#include <sinew/mapping/rigid_mapping.hpp>

#include "collision/contact_scene.hpp"

namespace test_picking {

using namespace sinew;
using Point = Eigen::Vector3d;

namespace {

constexpr MinProximityIntersection near{.alarmDistance = 0.2, .contactDistance = 0.1};
constexpr double inf = std::numeric_limits<double>::infinity();

// a floor at z = 0, a ball of radius 1 at z = 3, a wire at z = 5, two points at z = 6
auto scene() {
  return contact_scene(
      near,
      0,
      floor_node(100, 0),
      node<"things">(EulerImplicitSolver{},
                     CGLinearSolver<>{},
                     node<"ball">(MechanicalObject<Vec3d>{.position = {{5, 5, 3}, {0, 0, 3}}},
                                  UniformMass<Vec3d>{},
                                  SphereCollisionModel<Vec3d>{.radius = 1}),
                     node<"wire">(MeshTopology{.edges = {{0, 1}, {1, 2}}},
                                  MechanicalObject<Vec3d>{.position = {{-1, 0, 5}, {3, 0, 5}, {3, 4, 5}}},
                                  UniformMass<Vec3d>{},
                                  LineCollisionModel<Vec3d>{}),
                     node<"points">(MechanicalObject<Vec3d>{.position = {{-2, -2, 6}, {2, 2, 6}}},
                                    UniformMass<Vec3d>{},
                                    PointCollisionModel<Vec3d>{}),
                     node<"away">(MechanicalObject<Vec3d>{.position = {{0, 0, 8}}},
                                  UniformMass<Vec3d>{},
                                  SphereCollisionModel<Vec3d>{.active = false, .radius = 1})));
}

}  // namespace

TEST_CASE("a ray picks the nearest of several models") {
  auto sim = scene();
  CHECK_THROWS_AS(sim.pick({0, 0, 10}, {0, 0, -1}), Error);
  sim.init();
  // the wire is seen with a tolerance only, the ball behind it without
  auto hit = sim.pick({0, 0.05, 10}, {0, 0, -2}, inf, 0.1);
  REQUIRE(hit);
  CHECK(hit->path == "/root/things/wire");
  CHECK(hit->model == 2);
  CHECK(hit->place.element == 0);
  CHECK(hit->place.vertices == std::array{0, 1, -1});
  CHECK(hit->place.weights[1] == Approx(0.25));
  CHECK(hit->distance == Approx(5));
  CHECK((hit->point - Point(0, 0, 5)).norm() < 1e-12);
  hit = sim.pick({0, 0, 10}, {0, 0, -2});
  REQUIRE(hit);
  CHECK(hit->path == "/root/things/wire");  // exactly through it
  hit = sim.pick({0, 0.6, 10}, {0, 0, -2});
  REQUIRE(hit);
  CHECK(hit->path == "/root/things/ball");
  CHECK(hit->place.element == 1);
  CHECK(hit->place.vertices == std::array{1, -1, -1});
  CHECK(hit->distance == Approx(10 - 3 - 0.8));  // z = 3 + sqrt(1 - 0.6^2)
  CHECK((hit->point - Point(0, 0.6, 3.8)).norm() < 1e-12);
  CHECK(hit->simulated);
  // beside all of them the floor, which nothing moves
  hit = sim.pick({1, 2, 10}, {0, 0, -1}, inf, 0.1);
  REQUIRE(hit);
  CHECK(hit->path == "/root/floor");
  CHECK(!hit->simulated);
  Point there(0, 0, 0);
  for (std::size_t c = 0; c < 3; ++c)
    there += hit->place.weights[c] * sim.at<"floor">().state().position[std::size_t(hit->place.vertices[c])];
  CHECK((there - Point(1, 2, 0)).norm() < 1e-12);
  CHECK(hit->place.weights[0] + hit->place.weights[1] + hit->place.weights[2] == Approx(1));
  // and points
  hit = sim.pick({-2, -2.05, 10}, {0, 0, -1}, inf, 0.1);
  REQUIRE(hit);
  CHECK(hit->path == "/root/things/points");
  CHECK(hit->point == Point(-2, -2, 6));
}

TEST_CASE("nothing is picked behind the origin, beyond the range, and beside all") {
  auto sim = scene();
  sim.init();
  CHECK(!sim.pick({0, 0.6, 10}, {0, 0, 1}, inf, 0.1));
  CHECK(!sim.pick({0, 0.6, 10}, {0, 0, -1}, 6.19));
  CHECK(sim.pick({0, 0.6, 10}, {0, 0, -1}, 6.21));
  CHECK(!sim.pick({30, 0, 10}, {0, 0, -1}, inf, 0.1));
  CHECK(!sim.pick({-20, 0.5, 0}, {1, 0, 0}));  // the floor from its edge
  CHECK(sim.pick({0, 0.5, -1}, {0, 0, 1})->path == "/root/floor");
}

TEST_CASE("a ray that is none is refused") {
  auto sim = scene();
  sim.init();
  const double nan = std::numeric_limits<double>::quiet_NaN();
  CHECK_THROWS_AS(sim.pick({0, 0, nan}, {0, 0, 1}), Error);
  CHECK_THROWS_AS(sim.pick({0, 0, 0}, {0, 0, 0}), Error);
  CHECK_THROWS_AS(sim.pick({0, 0, 0}, {0, nan, 1}), Error);
  CHECK_THROWS_AS(sim.pick({0, 0, 0}, {0, 0, 1}, -1), Error);
  CHECK_THROWS_AS(sim.pick({0, 0, 0}, {0, 0, 1}, inf, nan), Error);
  CHECK_THROWS_AS(sim.pick({0, 0, 0}, {0, 0, 1}, inf, -1), Error);
}

TEST_CASE("all of a wavy sheet is picked where it is after steps, as by brute force") {
  std::vector<Point> p;
  MeshTopology sheet;
  const int n = 30;
  for (int j = 0; j <= n; ++j)
    for (int i = 0; i <= n; ++i) p.push_back({i / 3.0, j / 3.0, std::sin(i * 0.7) * std::cos(j * 0.5)});
  for (int j = 0; j < n; ++j)
    for (int i = 0; i < n; ++i) {
      const int a = j * (n + 1) + i;
      sheet.triangles.push_back({a, a + 1, a + n + 2});
      sheet.triangles.push_back({a, a + n + 2, a + n + 1});
    }
  auto sim = contact_scene(near,
                           5,
                           node<"sheet">(EulerImplicitSolver{},
                                         CGLinearSolver<>{},
                                         sheet,
                                         MechanicalObject<Vec3d>{.position = p},
                                         UniformMass<Vec3d>{},
                                         TriangleCollisionModel<Vec3d>{}));
  sim.init();
  int hits = 0;
  for (int k = 0; k < 500; ++k) {
    if (k % 50 == 0)
      for (int i = 0; i < 5; ++i) sim.animate(0.01);
    auto const& x = sim.at<"sheet">().state().position;
    const Point eye(5 + 3 * std::sin(k), 5 + 3 * std::cos(1.3 * k), 4);
    const Point aim(5 + 5 * std::sin(1.7 * k), 5 + 5 * std::cos(2.3 * k), x[0][2]);
    const Ray ray{eye, (aim - eye).normalized()};
    double nearest = inf;
    for (auto const& t : sheet.triangles)
      nearest = std::min(
          nearest,
          ray_triangle(
              ray, {x[std::size_t(t[0])], x[std::size_t(t[1])], x[std::size_t(t[2])]}, {t[0], t[1], t[2]})
              .distance);
    const auto hit = sim.pick(eye, aim - eye);
    REQUIRE(bool(hit) == (nearest < inf));
    if (!hit) continue;
    ++hits;
    REQUIRE(hit->distance == Approx(nearest).epsilon(1e-12));
  }
  CHECK(hits > 300);
}

}  // namespace test_picking
