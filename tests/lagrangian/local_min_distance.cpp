// SPDX-License-Identifier: BSL-1.0
// What the cones of LocalMinDistance leave of the places where primitives are near, in closed form.
#include "lagrangian/contact_scenes.hpp"

namespace test_local_min_distance {

using namespace sinew;

namespace {

constexpr double pi = 3.14159265358979323846;
using Points = std::vector<Eigen::Vector3d>;

// a body that does not move, with models of triangles, lines and points
auto fixed_body(Points points, std::vector<Triangle> triangles, bool bothSide = false) {
  MeshTopology topology;
  topology.triangles = triangles;
  return node<"body">(
      topology,
      MechanicalObject<Vec3d>{.position = points},
      TriangleCollisionModel<Vec3d>{.moving = false, .simulated = false, .bothSide = bothSide},
      LineCollisionModel<Vec3d>{.moving = false, .simulated = false, .bothSide = bothSide},
      PointCollisionModel<Vec3d>{.moving = false, .simulated = false, .bothSide = bothSide});
}
template <class Body>
std::vector<Contact> contacts_of_point(LocalMinDistance method, Body body, Eigen::Vector3d const& place) {
  method.alarmDistance = 0.2;
  method.contactDistance = 0.01;
  auto sim = constrained_scene(method,
                               0,
                               body,
                               node<"point">(EulerExplicitSolver{},
                                             MechanicalObject<Vec3d>{.position = {place}},
                                             UniformMass<Vec3d>{.totalMass = 1},
                                             PointCollisionModel<Vec3d>{}));
  sim.init();
  sim.animate(1e-6);
  return sim.root().template get<DefaultContactManager>().contacts;
}

// two faces that fall by an angle on both sides of a ridge along y
auto roof(double angle, bool bothSide = false) {
  const double c = std::cos(angle), s = std::sin(angle);
  return fixed_body({{0, -1, 0}, {0, 1, 0}, {-c, -1, -s}, {-c, 1, -s}, {c, -1, -s}, {c, 1, -s}},
                    {{0, 1, 3}, {0, 3, 2}, {0, 4, 5}, {0, 5, 1}},
                    bothSide);
}
Eigen::Vector3d above_ridge(double angle) { return {0.1 * std::sin(angle), 0.3, 0.1 * std::cos(angle)}; }

const Points cubeCorners = [] {
  Points p;
  for (int i = 0; i < 8; ++i) p.push_back({(i & 1) - 0.5, ((i >> 1) & 1) - 0.5, ((i >> 2) & 1) - 0.5});
  return p;
}();
// outwards; the diagonal of the lower face goes from (-, +) to (+, -)
const std::vector<Triangle> cubeTriangles{{0, 2, 1},
                                          {1, 2, 3},
                                          {4, 5, 6},
                                          {5, 7, 6},
                                          {0, 1, 5},
                                          {0, 5, 4},
                                          {2, 6, 7},
                                          {2, 7, 3},
                                          {0, 4, 6},
                                          {0, 6, 2},
                                          {1, 3, 7},
                                          {1, 7, 5}};

auto cube_on_floor(double x, double height) {
  MeshTopology topology;
  topology.triangles = cubeTriangles;
  RigidCoord3<double> start;
  start.center = Eigen::Vector3d(x, 0, 0.5 + height);
  return constrained_scene(
      LocalMinDistance{.alarmDistance = 0.1, .contactDistance = 0.01},
      0.5,
      fixed_body({{-20, -20, 0}, {20, -20, 0}, {20, 20, 0}, {-20, 20, 0}}, {{0, 1, 2}, {0, 2, 3}}),
      node<"cube">(
          EulerExplicitSolver{},
          MechanicalObject<Rigid3d>{.position = {start}},
          UniformMass<Rigid3d>{.vertexMass = RigidMass<double, 3>{2, Eigen::Matrix3d::Identity() / 3}},
          node<"surface">(topology,
                          MechanicalObject<Vec3d>{.position = cubeCorners},
                          RigidMapping<Rigid3d, Vec3d>{},
                          TriangleCollisionModel<Vec3d>{},
                          LineCollisionModel<Vec3d>{},
                          PointCollisionModel<Vec3d>{})));
}

}  // namespace

TEST_CASE(
    "of a ridge every direction between its faces is a contact, and of one more only what the cone has") {
  const double slope = 0.4;
  for (const auto& [factor, angle] : {std::pair{0.0, 0.0}, {0.5, 0.0}, {0.5, 0.1}, {1.0, 0.0}}) {
    const LocalMinDistance method{.angleCone = angle, .coneFactor = factor};
    CAPTURE(factor, angle);
    for (const double t : {0.0, 0.2, 0.39}) {
      const auto found = contacts_of_point(method, roof(slope), above_ridge(t));
      REQUIRE(found.size() == 1);  // the ridge
      CHECK((found[0].normal - above_ridge(t).cwiseProduct(Eigen::Vector3d(10, 0, 10))).norm() < 1e-12);
      CHECK(found[0].distance == Approx(0.1).epsilon(1e-12));
    }
    // beside it the face, and the ridge up to sin(t - slope) = k sin(slope) + a
    const double last = slope + std::asin(factor * std::sin(slope) + angle);
    CHECK(contacts_of_point(method, roof(slope), above_ridge(last + 1e-6)).size() == 1);
    if (last > slope) CHECK(contacts_of_point(method, roof(slope), above_ridge(last - 1e-6)).size() == 2);
  }
}

TEST_CASE("of a corner every direction that leads away along its edges is a contact, and what its cone has") {
  const Points corners{{0, 0, 0}, {1, 0, -1}, {0, 1, -1}, {-1, 0, -1}, {0, -1, -1}};
  const std::vector<Triangle> faces{{0, 1, 2}, {0, 2, 3}, {0, 3, 4}, {0, 4, 1}};
  auto count = [&](LocalMinDistance method, double t) {
    return contacts_of_point(method, fixed_body(corners, faces), {0.1 * std::sin(t), 0, 0.1 * std::cos(t)})
        .size();
  };
  for (const double factor : {0.0, 0.5}) {
    const LocalMinDistance method{.coneFactor = factor};
    CAPTURE(factor);
    CHECK(count(method, 0) == 1);
    CHECK(count(method, pi / 4 - 1e-6) == 1);
    // then the edge, too, and the corner up to sin(t - pi/4) = k n.l, with n.l = sin(pi/4)
    const double last = pi / 4 + std::asin(factor * std::sin(pi / 4));
    CHECK(count(method, last + 1e-5) == 1);
    if (factor > 0) CHECK(count(method, last - 1e-5) == 2);
  }
}

TEST_CASE("what is behind one-sided triangles, or below their edges, is no contact; with both sides it is") {
  const Points square{{-1, -1, 0}, {1, -1, 0}, {1, 1, 0}, {-1, 1, 0}};
  const std::vector<Triangle> halves{{0, 1, 2}, {0, 2, 3}};
  for (Eigen::Vector3d place : {Eigen::Vector3d(0.5, 0, 0.1), Eigen::Vector3d(0.5, 0.5, 0.1)}) {
    const LocalMinDistance method{};
    const auto above = contacts_of_point(method, fixed_body(square, halves), place);
    REQUIRE(above.size() == 1);  // of a face, or of the diagonal
    CHECK((above[0].normal - Eigen::Vector3d::UnitZ()).norm() < 1e-12);
    place[2] = -place[2];
    CHECK(contacts_of_point(method, fixed_body(square, halves), place).empty());
    const auto below = contacts_of_point(method, fixed_body(square, halves, true), place);
    REQUIRE(below.size() == 1);
    CHECK((below[0].normal + Eigen::Vector3d::UnitZ()).norm() < 1e-12);
    CHECK(contacts_of_point({.filterIntersection = false}, fixed_body(square, halves), place).size() == 1);
    CHECK(contacts_of_point({.useLMDFilters = true}, fixed_body(square, halves), place).size() == 1);
  }
}

TEST_CASE("a cube above a floor has its four lower corners, wherever they are above it") {
  // above one triangle; across the diagonal of the floor; with two corners above it
  for (const double x : {3.0, 0.2, 0.0}) {
    auto sim = cube_on_floor(x, 0.05);
    sim.init();
    sim.animate(1e-6);
    auto const& contacts = sim.root().get<DefaultContactManager>().contacts;
    CHECK(contacts.size() == 4);
    for (Contact const& c : contacts) {
      CHECK(std::abs(c.normal[2]) == Approx(1).epsilon(1e-12));
      CHECK(c.distance == Approx(0.05).epsilon(1e-9));
    }
  }
}

TEST_CASE("a cube falls on a floor and rests there at the contact distance, held by its weight") {
  for (const double x : {3.0, 0.2, 0.0}) {
    auto sim = cube_on_floor(x, 0.04);
    sim.init();
    for (int i = 0; i < 100; ++i) sim.animate(0.01);
    auto const& s = sim.at<"cube">().state();
    CHECK((s.position[0].center - Eigen::Vector3d(x, 0, 0.51)).norm() < 1e-9);
    CHECK(s.velocity[0].norm() < 1e-9);
    CHECK((force_on(sim.root().get<DefaultContactManager>(), "/root/cube/surface") -
           Eigen::Vector3d(0, 0, 2 * g))
              .norm() < 1e-8);
  }
}

TEST_CASE("parallel edges meet at their middles, and not where these are beside each other") {
  using Segment = std::array<Eigen::Vector3d, 2>;
  const Segment a{{{0, 0, 0}, {2, 0, 0}}};
  const auto across = inner_closest_points(a, Segment{{{0, 0, 1}, {2, 0, 1}}});
  REQUIRE(across);
  CHECK((across->pointA - Eigen::Vector3d(1, 0, 0)).norm() == 0);
  CHECK(across->squaredDistance == 1);
  CHECK(!inner_closest_points(a, Segment{{{1, 0, 1}, {3, 0, 1}}}));
  CHECK(!inner_closest_points(a, Segment{{{1, 0, 1}, {1, 0, 1}}}));  // no length
  const auto crossing = inner_closest_points(a, Segment{{{0.5, -1, 1}, {0.5, 1, 1}}});
  REQUIRE(crossing);
  CHECK((crossing->pointB - Eigen::Vector3d(0.5, 0, 1)).norm() < 1e-15);
  const auto end = inner_closest_points(a, Segment{{{0.5, 1e-12, 1}, {0.5, 1, 1}}});
  REQUIRE(end);
  CHECK(end->weightsB == Eigen::Vector3d(1, 0, 0));
  CHECK(!inner_closest_points(a, Segment{{{0.5, 1e-6, 1}, {0.5, 1, 1}}}));
}

}  // namespace test_local_min_distance
