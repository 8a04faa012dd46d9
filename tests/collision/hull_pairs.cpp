// SPDX-License-Identifier: BSL-1.0
// Single contacts of hulls with everything, against geometry worked out by hand; and what is refused.
#include <sinew/collision/continuous_intersection.hpp>
#include <sinew/collision/convex_collision_model.hpp>
#include <sinew/collision/discrete_intersection.hpp>

#include "collision/contact_scene.hpp"
#include "hulls.hpp"

namespace test_hull_pairs {

using namespace sinew;
using V = Eigen::Vector3d;

namespace {

constexpr MinProximityIntersection near{.alarmDistance = 0.2, .contactDistance = 0.05};

auto still(std::vector<V> const& points, RigidCoord3<double> const& place = rigid_at({0, 0, 0})) {
  return node<"still">(MechanicalObject<Rigid3d>{.position = {place}},
                       ConvexCollisionModel<Rigid3d>{
                           .moving = false, .simulated = false, .contactStiffness = 100, .points = points});
}
/// A body above, of the model, that takes part in the dynamics.
template <class D, class Model>
auto free_body(typename D::VecCoord const& x, Model model, MeshTopology topology = {}) {
  return node<"free">(EulerImplicitSolver{},
                      CGLinearSolver<>{.iterations = 50, .tolerance = 1e-12},
                      topology,
                      MechanicalObject<D>{.position = x},
                      UniformMass<D>{},
                      model);
}
template <class Intersection, class Body>
std::vector<Contact> contacts_of(Intersection method, Body body, RigidCoord3<double> const& place) {
  auto sim = contact_scene(method, 0, still(box_corners({1, 1, 0.5}), place), body);
  sim.init();
  sim.animate(1e-9);
  return sim.root().template get<Contacts>().contacts;
}
std::vector<V> in_world(std::vector<V> p, RigidCoord3<double> const& place) {
  for (V& x : p) x = place.orientation * x + place.center;
  return p;
}
RigidCoord3<double> askew() { return rigid_at({3, -2, 1}, {0.7, {1, 2, -1}}); }

}  // namespace

TEST_CASE("a hull meets points and spheres at their nearest places, or as deep as they are") {
  const auto place = askew();
  for (const double gap : {0.1, 0.01, -0.03}) {
    auto check = [&](std::vector<Contact> const& contacts, double distance) {
      REQUIRE(contacts.size() == 1);
      Contact const& c = contacts[0];
      CHECK(c.distance == Approx(distance).margin(1e-9));
      CHECK((c.normal - place.orientation * V(0, 0, 1)).norm() < 1e-7);
      CHECK((c.a.lever - V(0.2, 0.3, 0.5)).norm() < 1e-7);
    };
    auto at = [&](double r) { return in_world({{0.2, 0.3, 0.5 + gap + r}}, place); };
    check(contacts_of(near, free_body<Vec3d>(at(0), PointCollisionModel<Vec3d>{}), place), gap);
    check(contacts_of(near, free_body<Vec3d>(at(0.3), SphereCollisionModel<Vec3d>{.radius = 0.3}), place),
          gap);
    RigidCoord3<double> ball = rigid_at(at(0.3)[0], {1, {1, 0, 0}});
    const auto onSkin =
        contacts_of(near, free_body<Rigid3d>({ball}, SphereCollisionModel<Rigid3d>{.radius = 0.3}), place);
    check(onSkin, gap);
    CHECK((ball.orientation * onSkin[0].b.lever + 0.3 * onSkin[0].normal).norm() < 1e-7);
  }
}

TEST_CASE("a segment over a face touches it at two places, a triangle at three") {
  const auto place = askew();
  MeshTopology line, triangle;
  line.edges = {{0, 1}};
  triangle.triangles = {{0, 1, 2}};
  // from inside the face to beyond its edge at x = 1
  auto contacts = contacts_of(
      near,
      free_body<Vec3d>(
          in_world({{0.2, 0.3, 0.52}, {1.2, 0.3, 0.52}}, place), LineCollisionModel<Vec3d>{}, line),
      place);
  REQUIRE(contacts.size() == 2);
  std::vector<V> levers;
  for (Contact const& c : contacts) {
    CHECK(c.distance == Approx(0.02).margin(1e-9));
    levers.push_back(c.a.lever);
  }
  std::sort(levers.begin(), levers.end(), [](V const& x, V const& y) { return x[0] < y[0]; });
  CHECK((levers[0] - V(0.2, 0.3, 0.5)).norm() < 1e-7);
  CHECK((levers[1] - V(1, 0.3, 0.5)).norm() < 1e-7);

  for (const bool bothSide : {true, false}) {
    contacts =
        contacts_of(near,
                    free_body<Vec3d>(in_world({{0.2, 0.3, 0.52}, {0.1, 0.6, 0.53}, {0.6, 0.3, 0.54}}, place),
                                     TriangleCollisionModel<Vec3d>{.bothSide = bothSide},
                                     triangle),
                    place);
    REQUIRE(contacts.size() == 3);
    for (Contact const& c : contacts) {
      REQUIRE(c.b.vertices[1] == -1);
      CHECK(c.a.feature == Feature::face());
      CHECK(c.distance == Approx(0.02 + 0.01 * c.b.vertices[0]).margin(1e-3));
    }
  }
}

TEST_CASE("two hulls meet by their faces, edges or corners") {
  const auto place = askew();
  auto box = [&](RigidCoord3<double> local) {
    RigidCoord3<double> x;
    x.center = place.orientation * local.center + place.center;
    x.orientation = place.orientation * local.orientation;
    return contacts_of(
        near,
        free_body<Rigid3d>({x}, ConvexCollisionModel<Rigid3d>{.points = box_corners({0.3, 0.3, 0.3})}),
        place);
  };
  auto deepest = [](std::vector<Contact> const& contacts) {
    double minimum = 1e9;
    for (Contact const& c : contacts) minimum = std::min(minimum, c.distance);
    return minimum;
  };
  const double quarter = std::acos(0.0) / 2;
  for (const double gap : {0.01, -0.02}) {
    auto contacts = box(rigid_at({0.1, 0.2, 0.8 + gap}));
    CHECK(contacts.size() == 4);
    for (Contact const& c : contacts) CHECK(c.distance == Approx(gap).margin(1e-9));
    // partly beyond the edge
    contacts = box(rigid_at({1, 0.2, 0.8 + gap}));
    CHECK(contacts.size() == 4);
    double farthest = 0;
    for (Contact const& c : contacts) farthest = std::max(farthest, c.a.lever[0]);
    CHECK(farthest == Approx(1).margin(1e-9));
    // turned by 45 degrees over a corner: that corner, two of its own, and two crossings of edges
    contacts = box(rigid_at({0.9, 0.9, 0.8 + gap}, {quarter, {0, 0, 1}}));
    CHECK(contacts.size() == 5);
    // on its edge
    contacts = box(rigid_at({0.1, 0.2, 0.5 + 0.3 * std::sqrt(2.0) + gap}, {quarter, {1, 0, 0}}));
    CHECK(contacts.size() == 2);
    for (Contact const& c : contacts) CHECK(c.distance == Approx(gap).margin(1e-9));
    // on its corner
    RigidCoord3<double> tip;
    tip.orientation = Eigen::Quaterniond::FromTwoVectors(V(-1, -1, -1), V(0, 0, -1));
    tip.center = V(0.1, 0.2, 0.5 + 0.3 * std::sqrt(3.0) + gap);
    contacts = box(tip);
    REQUIRE(contacts.size() == 1);
    CHECK(contacts[0].distance == Approx(gap).margin(1e-9));
    CHECK((contacts[0].a.lever - V(0.1, 0.2, 0.5)).norm() < 1e-6);
    // its edge across the edge of the other
    RigidCoord3<double> cross;
    const V out = V(1, 0, 1).normalized();
    cross.center = V(1, 0, 0.5) + (0.3 * std::sqrt(2.0) + gap) * out;
    cross.orientation = Eigen::Quaterniond::FromTwoVectors(V(0, 1, 1), out);
    contacts = box(cross);
    CHECK(deepest(contacts) == Approx(gap).margin(1e-9));
  }
}

TEST_CASE("discrete intersection sees hulls that overlap, and no others") {
  auto count = [&](double gap) {
    return contacts_of(
               DiscreteIntersection{},
               free_body<Rigid3d>({rigid_at({0, 0, 0.8 + gap})},
                                  ConvexCollisionModel<Rigid3d>{.points = box_corners({0.3, 0.3, 0.3})}),
               rigid_at({0, 0, 0}))
        .size();
  };
  CHECK(count(0.001) == 0);
  CHECK(count(-0.001) == 4);
}

TEST_CASE("a plate, a needle and a point are hulls, too") {
  auto check = [&](std::vector<V> points, std::size_t expected) {
    const auto contacts = contacts_of(near,
                                      free_body<Rigid3d>({rigid_at({0.1, 0.2, 0.5 + 0.01})},
                                                         ConvexCollisionModel<Rigid3d>{.points = points}),
                                      rigid_at({0, 0, 0}));
    CHECK(contacts.size() == expected);
    for (Contact const& c : contacts) CHECK(c.distance == Approx(0.01).margin(1e-9));
  };
  check({{0, 0, 0}, {0.3, 0, 0}, {0.3, 0.3, 0}, {0, 0.3, 0}, {0.1, 0.1, 0}}, 4);
  check({{0, 0, 0}, {0.3, 0.1, 0}, {0.15, 0.05, 0}}, 2);
  check({{0, 0, 0}, {0, 0, 0}}, 1);
}

TEST_CASE("a ray picks a hull where it enters it, or leaves it") {
  const auto place = askew();
  auto sim = contact_scene(near, 0, still(box_corners({1, 1, 0.5}), place));
  sim.init();
  auto pick = [&](V const& from, V const& along) {
    return sim.pick(place.orientation * from + place.center, place.orientation * along);
  };
  const auto top = pick({0.2, 0.3, 4}, {0, 0, -1});
  REQUIRE(top);
  CHECK(top->distance == Approx(3.5).margin(1e-9));
  CHECK((top->place.lever - V(0.2, 0.3, 0.5)).norm() < 1e-9);
  const V to(1, -0.4, 0.2), from(5, 1, 2);
  const auto side = pick(from, to - from);
  REQUIRE(side);
  CHECK((side->place.lever - to).norm() < 1e-9);
  const auto inside = pick({0.2, 0.3, 0.1}, {1, 0, 0});
  REQUIRE(inside);
  CHECK(inside->distance == Approx(0.8).margin(1e-9));
  CHECK(!pick({0.2, 0.3, 4}, {0, 0, 1}));
  CHECK(!pick({1.01, 0.3, 4}, {0, 0, -1}));
}

TEST_CASE("a hull without points, or with wrong ones, says so") {
  auto message = [](ConvexCollisionModel<Rigid3d> model) {
    auto sim = contact_scene(near, 0, free_body<Rigid3d>({rigid_at({0, 0, 0})}, model));
    try {
      sim.init();
    } catch (Error const& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  auto says = [](std::string const& message, std::string_view what) {
    INFO(message);
    return message.find("free") != std::string::npos &&
           message.find("ConvexCollisionModel") != std::string::npos &&
           message.find(what) != std::string::npos;
  };
  const double nan = std::numeric_limits<double>::quiet_NaN();
  CHECK(message({.points = box_corners({1, 1, 1})}).empty());
  CHECK(says(message({}), "no points"));
  CHECK(says(message({.points = {{0, 0, 0}, {0, nan, 0}}}), "finite"));
  CHECK(says(message({.points = {{0, 0, 0}}, .filename = {"hull.obj"}}), "give one of them"));
  CHECK(says(message({.filename = {"no such file.obj"}}), "no such file.obj"));
  CHECK(says(message({.contactStiffness = -1, .points = {{0, 0, 0}}}), "contactStiffness"));
}

}  // namespace test_hull_pairs
