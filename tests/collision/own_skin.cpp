// SPDX-License-Identifier: BSL-1.0
// What one frame carries moves as one, and does not collide with itself; how deep others are in each other.
#include <sinew/force/stiff_spring.hpp>
#include <sinew/mapping/identity_mapping.hpp>
#include <sinew/mapping/rigid_mapping.hpp>
#include <sinew/solver/euler_explicit.hpp>

#include "contact_scene.hpp"

namespace test_own_skin {

using namespace sinew;
using Eigen::Vector3d;

namespace {

constexpr MinProximityIntersection near{.alarmDistance = 0.1, .contactDistance = 0.01};
constexpr double radius = 0.2;

// a closed surface through the ends of three axes and their opposites, that far from the origin
MeshTopology octahedron_surface() {
  MeshTopology surface;
  for (int p = 0; p < 4; ++p) {
    const int q = (p + 1) % 4;
    surface.triangles.push_back({p, q, 4});
    surface.triangles.push_back({q, p, 5});
  }
  return surface;
}
std::vector<Vector3d> octahedron(double r, Vector3d const& centre = {0, 0, 0}) {
  std::vector<Vector3d> p{{r, 0, 0}, {0, r, 0}, {-r, 0, 0}, {0, -r, 0}, {0, 0, r}, {0, 0, -r}};
  for (Vector3d& x : p) x += centre;
  return p;
}
auto skin_of(std::vector<Vector3d> const& points, std::vector<int> bodies = {0}) {
  return node<"skin">(octahedron_surface(),
                      MechanicalObject<Vec3d>{.position = points},
                      RigidMapping<Rigid3d, Vec3d>{.rigidIndices = bodies},
                      TriangleCollisionModel<Vec3d>{},
                      LineCollisionModel<Vec3d>{},
                      PointCollisionModel<Vec3d>{});
}
// a tool of a ball, which has a skin around it, and another one that passes through that
template <class... More>
auto tool_alone(More... more) {
  return contact_scene(
      near,
      0,
      node<"tool">(EulerExplicitSolver{},
                   MechanicalObject<Rigid3d>{.position = {{}}},
                   UniformMass<Rigid3d>{},
                   SphereCollisionModel<Rigid3d>{.radius = radius},
                   skin_of(octahedron(radius)),
                   node<"handle">(octahedron_surface(),
                                  MechanicalObject<Vec3d>{.position = octahedron(radius, {0.15, 0.02, 0.01})},
                                  RigidMapping<Rigid3d, Vec3d>{},
                                  TriangleCollisionModel<Vec3d>{},
                                  node<"again">(octahedron_surface(),
                                                MechanicalObject<Vec3d>{},
                                                IdentityMapping<Vec3d, Vec3d>{},
                                                TriangleCollisionModel<Vec3d>{}))),
      more...);
}
template <class Sim>
auto const& contacts_of(Sim& sim) {
  return sim.root().template get<DefaultContactManager>().contacts;
}

}  // namespace

TEST_CASE("a tool that is in its own skin has no contacts with it, and no warning") {
  auto sim = tool_alone();
  sim.init();
  for (int i = 0; i < 3; ++i) sim.animate(0.01);
  CHECK(contacts_of(sim).empty());
  CHECK(sim.warnings().list().empty());
  CHECK(sim.at<"tool">().state().velocity[0].norm() == 0);
}

TEST_CASE("what is in the skin of a tool and no part of it is found, and warned of") {
  auto sim = tool_alone(node<"ball">(EulerExplicitSolver{},
                                     MechanicalObject<Vec3d>{.position = {{0, 0, 0.35}}},
                                     UniformMass<Vec3d>{},
                                     SphereCollisionModel<Vec3d>{.radius = radius}));
  sim.init();
  sim.animate(0.01);
  REQUIRE_FALSE(contacts_of(sim).empty());
  for (Contact const& c : contacts_of(sim)) {
    auto const& surfaces = sim.root().get<DefaultContactManager>().surfaces;
    CHECK((surfaces[std::size_t(c.a.surface)]->path == "/root/ball" ||
           surfaces[std::size_t(c.b.surface)]->path == "/root/ball"));
  }
  REQUIRE_FALSE(sim.warnings().list().empty());
  for (StepWarning const& w : sim.warnings().list()) CHECK_THAT(w.where, Catch::Contains("/root/ball"));
  // two balls of 0.2 m, 0.35 m apart
  CHECK(sim.warnings().list()[0].message ==
        "they start in each other, by 0.05 m, and will be driven apart at once; move one of them away");
}

TEST_CASE("skins of two frames of one state collide with each other, and neither with itself") {
  auto contacts = [](double apart) {
    std::vector<Vector3d> points = octahedron(radius);
    const std::vector<Vector3d> copy = points;
    points.insert(points.end(), copy.begin(), copy.end());
    std::vector<int> bodies(12, 0);
    std::fill(bodies.begin() + 6, bodies.end(), 1);
    MeshTopology both = octahedron_surface();
    for (Triangle t : octahedron_surface().triangles) {
      for (int& i : t) i += 6;
      both.triangles.push_back(t);
    }
    RigidCoord3<double> second;
    second.center[0] = apart;
    auto sim = contact_scene(near,
                             0,
                             node<"bodies">(EulerExplicitSolver{},
                                            MechanicalObject<Rigid3d>{.position = {{}, second}},
                                            UniformMass<Rigid3d>{},
                                            node<"skin">(both,
                                                         MechanicalObject<Vec3d>{.position = points},
                                                         RigidMapping<Rigid3d, Vec3d>{.rigidIndices = bodies},
                                                         TriangleCollisionModel<Vec3d>{.selfCollision = true},
                                                         PointCollisionModel<Vec3d>{.selfCollision = true})));
    sim.init();
    sim.animate(1e-4);
    for (Contact const& c : contacts_of(sim)) CHECK((c.a.vertices[0] < 6) != (c.b.vertices[0] < 6));
    return contacts_of(sim).size();
  };
  CHECK(contacts(2) == 0);
  CHECK(contacts(2 * radius + 0.05) > 0);
}

TEST_CASE("skins of one body that bends collide where their points are not the same") {
  // two points on a spring, each a ball; those of the skin are the same points, and the ball of the one
  // reaches the other
  auto sim =
      contact_scene(near,
                    0,
                    node<"string">(EulerExplicitSolver{},
                                   MechanicalObject<Vec3d>{.position = {{0, 0, 0}, {1.5 * radius, 0, 0}}},
                                   UniformMass<Vec3d>{},
                                   StiffSpringForceField<Vec3d>{{{0, 1, 10, 0, 1.5 * radius}}},
                                   SphereCollisionModel<Vec3d>{.radius = radius},
                                   node<"skin">(MechanicalObject<Vec3d>{},
                                                IdentityMapping<Vec3d, Vec3d>{},
                                                SphereCollisionModel<Vec3d>{.radius = radius})));
  sim.init();
  sim.animate(1e-4);
  REQUIRE(contacts_of(sim).size() == 2);
  for (Contact const& c : contacts_of(sim)) {
    CHECK(c.a.vertices[0] != c.b.vertices[0]);
    CHECK(c.distance == Approx(-0.5 * radius));
  }
}

TEST_CASE(
    "a ball is as deep in a triangle as its radius says, also where its centre is near the plane or behind") {
  MeshTopology one;
  one.triangles = {{0, 1, 2}};
  for (const bool bothSide : {true, false})
    for (const double height : {-0.19, -0.1, -0.01, -1e-6, 0., 1e-6, 0.01, 0.1, 0.19}) {
      INFO(bothSide << ' ' << height);
      auto sim = contact_scene(
          near,
          0,
          node<"plate">(
              one,
              MechanicalObject<Vec3d>{.position = {{-2, -1, 0}, {2, -1, 0}, {0, 2, 0}}},
              TriangleCollisionModel<Vec3d>{.moving = false, .simulated = false, .bothSide = bothSide}),
          node<"ball">(EulerExplicitSolver{},
                       MechanicalObject<Vec3d>{.position = {{0, 0, height}}},
                       UniformMass<Vec3d>{},
                       SphereCollisionModel<Vec3d>{.radius = radius}));
      sim.init();
      sim.animate(1e-6);
      REQUIRE(contacts_of(sim).size() == 1);
      Contact const& c = contacts_of(sim)[0];
      // out of a two-sided plate towards the side on which the centre is, out of a one-sided one upwards
      CHECK(c.distance == Approx((bothSide ? std::abs(height) : height) - radius));
      auto const& surfaces = sim.root().get<DefaultContactManager>().surfaces;
      const double up = (surfaces[std::size_t(c.b.surface)]->path == "/root/ball" ? 1 : -1) * c.normal[2];
      CHECK(std::abs(up) == Approx(1));
      if (!bothSide || height != 0) CHECK(up == Approx(bothSide && height < 0 ? -1 : 1));
      REQUIRE(sim.warnings().list().size() == 1);
      CHECK_THAT(sim.warnings().list()[0].message,
                 Catch::StartsWith(text("they start in each other, by ", -c.distance)));
    }
}

}  // namespace test_own_skin
