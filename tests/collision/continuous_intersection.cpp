// SPDX-License-Identifier: BSL-1.0
// Nothing is passed through, however fast it is: contacts found by continuous collision detection.
#include <sinew/collision/continuous_intersection.hpp>

#include "contact_scene.hpp"

namespace test_continuous_intersection {

using namespace sinew;

namespace {

constexpr ContinuousIntersection ahead{.alarmDistance = 0.02, .contactDistance = 0.01};

// a fixed wall in the plane x = 0, a net of triangles
auto wall(double stiffness) {
  std::vector<Eigen::Vector3d> p;
  MeshTopology topology;
  for (int j = 0; j < 5; ++j)
    for (int i = 0; i < 5; ++i) p.push_back({0, i - 2.0, j - 2.0});
  for (int j = 0; j < 4; ++j)
    for (int i = 0; i < 4; ++i) {
      const int a = 5 * j + i;
      topology.triangles.push_back({a, a + 1, a + 6});
      topology.triangles.push_back({a, a + 6, a + 5});
    }
  return node<"wall">(
      topology,
      MechanicalObject<Vec3d>{.position = p},
      TriangleCollisionModel<Vec3d>{
          .moving = false, .simulated = false, .bothSide = true, .contactStiffness = stiffness});
}

}  // namespace

TEST_CASE("balls of all sizes and speeds stay on their side of a thin wall") {
  // 1 m/s to 1e6 m/s: up to a million wall thicknesses in a step; in all directions towards the wall
  for (const double speed : {1.0, 30.0, 1e3, 1e6})
    for (const double radius : {0.001, 0.1}) {
      const double along = std::min(0.2 * speed, 1.0);  // the wall is 4 m wide
      auto sim = contact_scene(
          ahead,
          0,
          wall(1e6),
          node<"balls">(EulerImplicitSolver{},
                        CGLinearSolver<>{.iterations = 50, .tolerance = 1e-14},
                        MechanicalObject<Vec3d>{
                            .position = {{-1, 0.1, 0.2}, {-0.7, -0.5, 0}, {-0.5, 1, 1}, {-1.3, 0, -1}},
                            .velocity = {{speed, 0, 0},
                                         {speed, along, 0.5 * along},
                                         {0.9 * speed, 0, -along},
                                         {speed, 1e-3 * along, 0}}},
                        UniformMass<Vec3d>{.vertexMass = 1e-3},
                        SphereCollisionModel<Vec3d>{.contactStiffness = 1e3, .radius = radius}));
      sim.init();
      for (int i = 0; i < 100; ++i) {
        sim.animate(0.01);
        auto const& x = sim.at<"balls">().state().position;
        for (std::size_t b = 0; b < x.size(); ++b) {
          INFO("speed " << speed << ", radius " << radius << ", ball " << b << ", step " << i);
          REQUIRE(x[b][0] < 0);
        }
      }
    }
}

TEST_CASE("without looking ahead the same ball is on the other side: the test above can fail") {
  auto sim = contact_scene(
      MinProximityIntersection{.alarmDistance = 0.02, .contactDistance = 0.01},
      0,
      wall(1e6),
      node<"balls">(EulerImplicitSolver{},
                    CGLinearSolver<>{},
                    MechanicalObject<Vec3d>{.position = {{-1, 0.1, 0.2}}, .velocity = {{1e3, 0, 0}}},
                    UniformMass<Vec3d>{.vertexMass = 1e-3},
                    SphereCollisionModel<Vec3d>{.contactStiffness = 1e3, .radius = 0.1}));
  sim.init();
  sim.animate(0.01);
  CHECK(sim.at<"balls">().state().position[0][0] > 0);
}

TEST_CASE("two fast edges that cross are stopped by each other") {
  auto bar = [](Eigen::Vector3d const& a, Eigen::Vector3d const& b, Eigen::Vector3d const& v) {
    MeshTopology topology;
    topology.edges = {{0, 1}};
    return std::tuple(topology,
                      MechanicalObject<Vec3d>{.position = {a, b}, .velocity = {v, v}},
                      UniformMass<Vec3d>{.vertexMass = 0.5},
                      LineCollisionModel<Vec3d>{.contactStiffness = 1e4});
  };
  auto [ta, sa, ma, ca] = bar({-1, 0, 0}, {1, 0, 0}, {0, 0, 500});
  auto [tb, sb, mb, cb] = bar({0, -1, 1}, {0, 1, 1}, {0, 0, -500});
  auto sim = contact_scene(ahead,
                           0,
                           node<"bars">(EulerImplicitSolver{},
                                        CGLinearSolver<>{.iterations = 50, .tolerance = 1e-14},
                                        node<"a">(ta, sa, ma, ca),
                                        node<"b">(tb, sb, mb, cb)));
  sim.init();
  for (int i = 0; i < 50; ++i) {
    sim.animate(0.01);
    auto const& a = sim.at<"bars/a">().state();
    auto const& b = sim.at<"bars/b">().state();
    REQUIRE(a.position[0][2] + a.position[1][2] < b.position[0][2] + b.position[1][2]);
    REQUIRE(std::abs(a.velocity[0][2] + a.velocity[1][2] + b.velocity[0][2] + b.velocity[1][2]) <
            1e-9 * 1000);
  }
}

TEST_CASE("a tool that is driven through a ball within a step takes it along") {
  // the wall comes 2 m in a step, from the left of the ball to its right
  auto sim = contact_scene(ahead,
                           0,
                           wall(1e6),
                           node<"ball">(EulerImplicitSolver{},
                                        CGLinearSolver<>{.iterations = 50, .tolerance = 1e-14},
                                        MechanicalObject<Vec3d>{.position = {{1, 0.1, 0.2}}},
                                        UniformMass<Vec3d>{.vertexMass = 1e-3},
                                        SphereCollisionModel<Vec3d>{.contactStiffness = 1e3, .radius = 0.1}));
  sim.init();
  auto& tool = sim.at<"wall">().state();
  for (std::size_t i = 0; i < tool.position.size(); ++i) {
    tool.position[i][0] += 2;
    tool.velocity[i] = Eigen::Vector3d(200, 0, 0);
  }
  sim.animate(0.01);
  CHECK(sim.at<"ball">().state().position[0][0] > 2);
}

}  // namespace test_continuous_intersection
