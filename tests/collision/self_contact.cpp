// SPDX-License-Identifier: BSL-1.0
// What is in front of a triangle of its own body touches it; what is behind it has the body between.
#include <sinew/collision/continuous_intersection.hpp>

#include "contact_scene.hpp"

namespace test_self_contact {

using namespace sinew;
using Eigen::Vector3d;

namespace {

constexpr double dt = 0.01;
constexpr MinProximityIntersection near{.alarmDistance = 0.1, .contactDistance = 0.05};
constexpr ContinuousIntersection ahead{.alarmDistance = 0.1, .contactDistance = 0.05};

/// A triangle in the plane z = 0, which faces up, and a point above or below its middle, of one state.
auto flap(Vector3d const& point, Vector3d const& velocity) {
  MeshTopology triangle;
  triangle.triangles = {{0, 1, 2}};
  const Vector3d zero(0, 0, 0);
  return node<"flap">(
      EulerImplicitSolver{},
      CGLinearSolver<>{.iterations = 50, .tolerance = 1e-14},
      triangle,
      MechanicalObject<Vec3d>{.position = {{-1, -1, 0}, {1, -1, 0}, {0, 1, 0}, point},
                              .velocity = {zero, zero, zero, velocity}},
      UniformMass<Vec3d>{.vertexMass = 1},
      TriangleCollisionModel<Vec3d>{.selfCollision = true, .bothSide = false, .contactStiffness = 1000},
      PointCollisionModel<Vec3d>{.selfCollision = true, .contactStiffness = 1000});
}
template <class Sim>
std::vector<Contact> const& contacts_of(Sim& sim) {
  return sim.root().template get<DefaultContactManager>().contacts;
}
template <class Sim>
Vector3d point_of(Sim& sim) {
  return sim.template at<"flap">().state().position[3];
}

}  // namespace

TEST_CASE("what is behind a triangle of its own body, within reach, is neither held nor moved") {
  auto rests = [](auto method) {
    const Vector3d start(0, -0.3, -0.02);
    auto sim = contact_scene(method, 0, flap(start, {0, 0, 0}));
    sim.init();
    for (int i = 0; i < 5; ++i) {
      sim.animate(dt);
      CHECK(contacts_of(sim).empty());
      CHECK(point_of(sim) == start);
    }
  };
  rests(near);
  rests(ahead);
}

TEST_CASE("what comes through its own body from behind a triangle goes on as it was") {
  // 1 m in the step in which it meets the triangle
  auto sim = contact_scene(ahead, 0, flap({0, -0.3, -0.5}, {0, 0, 100}));
  sim.init();
  sim.animate(dt);
  CHECK(contacts_of(sim).empty());
  CHECK((point_of(sim) - Vector3d(0, -0.3, 0.5)).norm() < 1e-14);
}

TEST_CASE("what gets behind a triangle of its own body from the front is driven back") {
  auto returns = [](auto method) {
    auto sim = contact_scene(method, 0, flap({0, -0.3, 0.08}, {0, 0, 0}));
    sim.init();
    sim.animate(dt);
    REQUIRE(contacts_of(sim).size() == 1);
    sim.template at<"flap">().state().position[3][2] = -0.02;
    sim.animate(dt);
    REQUIRE(contacts_of(sim).size() == 1);
    auto const& v = sim.template at<"flap">().state().velocity;
    CHECK((contacts_of(sim)[0].normal - Vector3d(0, 0, 1)).norm() < 1e-14);
    CHECK(v[3][2] > 0.1);
    CHECK(std::abs((v[0] + v[1] + v[2] + v[3])[2]) < 1e-12);
  };
  returns(near);
  returns(ahead);
}

TEST_CASE("continuous detection lets out what comes from behind a one-sided triangle of another body") {
  auto out = [](bool bothSide) {
    MeshTopology triangle;
    triangle.triangles = {{0, 1, 2}};
    auto sim = contact_scene(
        ahead,
        0,
        node<"wall">(triangle,
                     MechanicalObject<Vec3d>{.position = {{-1, -1, 0}, {1, -1, 0}, {0, 1, 0}}},
                     TriangleCollisionModel<Vec3d>{
                         .moving = false, .simulated = false, .bothSide = bothSide, .contactStiffness = 1e6}),
        node<"point">(EulerImplicitSolver{},
                      CGLinearSolver<>{.iterations = 50, .tolerance = 1e-14},
                      MechanicalObject<Vec3d>{.position = {{0, -0.3, -0.5}}, .velocity = {{0, 0, 100}}},
                      UniformMass<Vec3d>{.vertexMass = 1},
                      PointCollisionModel<Vec3d>{.contactStiffness = 1e6}));
    sim.init();
    sim.animate(dt);
    return sim.template at<"point">().state().position[0][2];
  };
  CHECK(std::abs(out(false) - 0.5) < 1e-14);
  CHECK(out(true) < 0);
}

TEST_CASE("where an edge crosses a one-sided triangle, it is driven to the front, wherever most of it is") {
  for (const double middle : {-0.25, 0.25}) {
    MeshTopology triangle;
    triangle.triangles = {{0, 1, 2}};
    auto sim = contact_scene(
        near,
        0,
        node<"wall">(triangle,
                     MechanicalObject<Vec3d>{.position = {{-1, -1, 0}, {1, -1, 0}, {0, 1, 0}}},
                     TriangleCollisionModel<Vec3d>{.moving = false, .simulated = false, .bothSide = false}),
        node<"blade">(
            EulerImplicitSolver{},
            CGLinearSolver<>{},
            triangle,
            MechanicalObject<Vec3d>{
                .position = {{0, -0.25, middle - 0.5}, {0, -0.25, middle + 0.5}, {0.25, -0.25, middle}}},
            UniformMass<Vec3d>{.vertexMass = 1},
            TriangleCollisionModel<Vec3d>{.bothSide = false}));
    sim.init();
    sim.animate(dt);
    int crossing = 0;
    for (Contact const& c : contacts_of(sim)) {
      if (c.start.norm() > 1e-12 || c.a.corners() != 3) continue;
      ++crossing;
      CHECK((c.normal - Vector3d(0, 0, 1)).norm() < 1e-12);
    }
    CHECK(crossing == 1);
  }
}

}  // namespace test_self_contact
