// SPDX-License-Identifier: BSL-1.0
// Oriented boxes and capsules: distances against sampled ones, contacts by hand, momenta, frames, bad input.
#include <sinew/collision/capsule_collision_model.hpp>
#include <sinew/collision/continuous_intersection.hpp>
#include <sinew/collision/discrete_intersection.hpp>
#include <sinew/collision/local_min_distance.hpp>
#include <sinew/collision/obb_collision_model.hpp>
#include <sinew/collision/rigid_capsule_collision_model.hpp>
#include <sinew/solver/euler_explicit.hpp>

#include "collision/contact_scene.hpp"
#include "error_of.hpp"
#include "hulls.hpp"

#include <random>

namespace test_hull_obb_capsule {

using namespace sinew;
using V = Eigen::Vector3d;

namespace {

constexpr MinProximityIntersection near{.alarmDistance = 0.2, .contactDistance = 0.05};

struct Random {
  std::mt19937 engine{7};
  double number(double low, double high) { return std::uniform_real_distribution(low, high)(engine); }
  V vector(double size) { return {number(-size, size), number(-size, size), number(-size, size)}; }
  RigidCoord3<double> pose(double away) { return rigid_at(vector(away), {number(0, 6), vector(1)}); }
};

// the smallest motion that parts two bodies, among a few thousand directions on the ball
template <class A, class B>
double sampled_depth(A const& a, B const& b) {
  const V origin = detail::convex_origin(a);
  const detail::ConvexView viewA = detail::convex_view(a, origin), viewB = detail::convex_view(b, origin);
  double depth = std::numeric_limits<double>::infinity();
  constexpr int n = 4000;
  for (int i = 0; i < n; ++i) {  // spiral of Fibonacci
    const double z = 1 - (2 * i + 1.0) / n, angle = i * 2.399963229728653, r = std::sqrt(1 - z * z);
    depth =
        std::min(depth, detail::depth_along(viewA, viewB, V(r * std::cos(angle), r * std::sin(angle), z)));
  }
  return depth;
}
// in the scene of two states, contacts of the first step, which moves nothing
template <class Method, class First, class Second>
std::vector<Contact> contacts_of(Method method, First first, Second second) {
  auto sim = contact_scene(method, 0, first, second);
  sim.init();
  sim.animate(1e-9);
  return sim.root().template get<Contacts>().contacts;
}
auto box(RigidCoord3<double> const& at, V const& half) {
  return node<"box">(MechanicalObject<Rigid3d>{.position = {at}},
                     OBBCollisionModel<Rigid3d>{
                         .moving = false, .simulated = false, .contactStiffness = 100, .extents = {half}});
}
template <FixedString Name, class D, class Model>
auto free_body(typename D::VecCoord const& x, Model model, MeshTopology topology = {}) {
  return node<Name>(EulerImplicitSolver{},
                    CGLinearSolver<>{.iterations = 50, .tolerance = 1e-12},
                    topology,
                    MechanicalObject<D>{.position = x},
                    UniformMass<D>{},
                    model);
}
MeshTopology edges(std::vector<Edge> const& all) {
  MeshTopology t;
  t.edges = all;
  return t;
}
RigidCoord3<double> moved(RigidCoord3<double> const& by, RigidCoord3<double> const& x) {
  RigidCoord3<double> to;
  to.center = by.orientation * x.center + by.center;
  to.orientation = by.orientation * x.orientation;
  return to;
}
// its two ends
std::array<V, 2> axis(RigidCoord3<double> const& x, double height) {
  const V half = x.orientation * V(0, height / 2, 0);
  return {x.center - half, x.center + half};
}

}  // namespace

TEST_CASE("boxes, segments and triangles in one another are as deep as the best of many directions") {
  Random random;
  auto check = [](auto const& a, auto const& b, auto const& shifted) {
    const ConvexContact c = convex_contact(a, b);
    if (c.distance >= 0) return false;
    const double sampled = sampled_depth(a, b);
    // 4,000 directions are 0.03 apart: the depth changes by no more than the size of 4 m times half of that
    CHECK(-c.distance <= sampled + 1e-12);
    CHECK(-c.distance >= sampled - 4 * 0.03);
    CHECK(c.direction.norm() == Approx(1));
    CHECK((c.pointB - c.pointA - c.distance * c.direction).norm() < 1e-12);
    // moved by the depth it touches, by less it does not
    CHECK(convex_contact(a, shifted(c.direction * -c.distance)).distance == Approx(0).margin(1e-9));
    CHECK(convex_contact(a, shifted(c.direction * -0.99 * c.distance)).distance < 0);
    return true;
  };
  int deep = 0;
  for (int i = 0; i < 120; ++i) {
    INFO(i);
    const ConvexHull first = ConvexHull::box(random.vector(0.4) + V(0.5, 0.6, 0.7)),
                     second = ConvexHull::box(random.vector(0.4) + V(0.5, 0.6, 0.7)),
                     needle({V(0, -1, 0), V(0, 1, 0)});
    const PosedHull a{first, random.pose(0.7)};
    auto hull = [&](ConvexHull const& h) {
      const auto place = random.pose(0.7);
      return check(a, PosedHull{h, place}, [&h, place](V const& d) {
        return PosedHull{h, {place.center + d, place.orientation}};
      });
    };
    deep += hull(second) + hull(needle);
    const std::array<V, 3> t{random.vector(1.5), random.vector(1.5), random.vector(1.5)};
    deep += check(a, t, [&t](V const& d) { return std::array<V, 3>{t[0] + d, t[1] + d, t[2] + d}; });
  }
  CHECK(deep > 120);
  // along the axes, where many directions are as good: 0.3 m of 1 m
  const ConvexHull cube = ConvexHull::box({0.5, 0.5, 0.5});
  const ConvexContact c = convex_contact(PosedHull{cube}, PosedHull{cube, rigid_at({0.1, 0.7, 0})});
  CHECK(c.distance == Approx(-0.3));
  CHECK((c.direction - V(0, 1, 0)).norm() < 1e-12);
}

TEST_CASE("boxes and segments apart are as far as the nearest of many of their points") {
  Random random;
  for (int i = 0; i < 100; ++i) {
    const V half = random.vector(0.4) + V(0.5, 0.6, 0.7), other = random.vector(0.4) + V(0.5, 0.6, 0.7);
    const ConvexHull first = ConvexHull::box(half), second = ConvexHull::box(other);
    const auto place = random.pose(0.2);
    auto away = random.pose(0.2);
    away.center += 3 * random.vector(1).normalized();
    const ConvexContact c = convex_contact(PosedHull{first, place}, PosedHull{second, away});
    if (c.distance <= 0) continue;
    auto inside = [](V const& x, RigidCoord3<double> const& p, V const& h) -> V {
      const V y = p.orientation.conjugate() * (x - p.center);
      return p.orientation * V(y.cwiseMax(-h).cwiseMin(h)) + p.center;
    };
    CHECK((inside(c.pointA, place, half) - c.pointA).norm() < 1e-9);
    CHECK((inside(c.pointB, away, other) - c.pointB).norm() < 1e-9);
    // to each point of the one the nearest of the other in closed form
    double least = 1e9;
    constexpr int n = 24;
    for (int k = 0; k < n * n * n; ++k) {
      const V t(k % n, k / n % n, k / n / n);
      const V x = place.orientation * V(half.cwiseProduct(2 * t / (n - 1) - V::Ones())) + place.center;
      least = std::min(least, (inside(x, away, other) - x).norm());
    }
    CHECK(c.distance <= least + 1e-12);
    CHECK(c.distance >= least - 2 * half.norm() / (n - 1));
  }
}

TEST_CASE("rigid capsules are as far as their segments, less their radii, on their skin") {
  Random random;
  for (int i = 0; i < 40; ++i) {
    INFO(i);
    const auto a = random.pose(0.3);
    auto b = random.pose(0.3);
    b.center += V(0.8, 0, 0);
    const auto found =
        contacts_of(MinProximityIntersection{.alarmDistance = 10, .contactDistance = 0.05},
                    node<"still">(MechanicalObject<Rigid3d>{.position = {a}},
                                  CapsuleCollisionModel<Rigid3d>{
                                      .moving = false, .simulated = false, .radii = {0.2}, .heights = {1}}),
                    free_body<"free", Rigid3d>(
                        {b}, CapsuleCollisionModel<Rigid3d>{.defaultRadius = 0.1, .defaultHeight = 1.5}));
    REQUIRE(!found.empty());
    const auto expected = closest_points(axis(a, 1), axis(b, 1.5));
    const double distance = std::sqrt(expected.squaredDistance) - 0.3;
    Contact const* c = &found[0];
    for (Contact const& other : found)
      if (other.distance < c->distance) c = &other;
    CHECK(c->distance == Approx(distance).margin(1e-9));
    const V onA = a.orientation * c->a.lever + a.center, onB = b.orientation * c->b.lever + b.center;
    CHECK((onB - onA - distance * c->normal).norm() < 1e-7);
    const V n = (expected.pointB - expected.pointA).normalized();
    CHECK((c->normal - n).norm() < 1e-7);
    CHECK((onA - expected.pointA - 0.2 * n).norm() < 1e-7);
  }
}

TEST_CASE("capsules on points touch by their middles and their ends, each place once") {
  const auto body = [](std::vector<V> const& x, double radius) {
    return free_body<"free", Vec3d>(
        x, CapsuleCollisionModel<Vec3d>{.defaultRadius = radius}, edges({{0, 1}}));
  };
  auto still = [](std::vector<V> const& x, double radius) {
    return node<"still">(
        edges({{0, 1}}),
        MechanicalObject<Vec3d>{.position = x},
        CapsuleCollisionModel<Vec3d>{.moving = false, .simulated = false, .listCapsuleRadii = {radius}});
  };
  SECTION("crossed: one, by the radii") {
    const auto c =
        contacts_of(near, still({{-1, 0, 0}, {1, 0, 0}}, 0.2), body({{0, -1, 0.4}, {0, 1, 0.4}}, 0.1));
    REQUIRE(c.size() == 1);
    CHECK(c[0].distance == Approx(0.1));
    CHECK((c[0].normal - V(0, 0, 1)).norm() < 1e-12);
    CHECK(c[0].a.corners() == 2);
  }
  SECTION("parallel: the ends of the shorter one") {
    const auto c =
        contacts_of(near, still({{-1, 0, 0}, {1, 0, 0}}, 0.2), body({{-0.5, 0, 0.4}, {0.5, 0, 0.4}}, 0.1));
    REQUIRE(c.size() == 2);
    for (Contact const& one : c) {
      CHECK(one.distance == Approx(0.1));
      CHECK(one.b.corners() == 1);
    }
  }
  SECTION("in each other: the axes cross") {
    const auto c = contacts_of(near, still({{-1, 0, 0}, {1, 0, 0}}, 0.2), body({{0, -1, 0}, {0, 1, 0}}, 0.1));
    REQUIRE(c.size() == 1);
    CHECK(c[0].distance == Approx(-0.3));
    CHECK(std::abs(c[0].normal[2]) == Approx(1));
  }
  SECTION("the point that a thin and a thick one share has the radius of the thick one") {
    auto chain = [&](V const& at) {
      return contacts_of(
          near,
          node<"still">(edges({{0, 1}, {1, 2}}),
                        MechanicalObject<Vec3d>{.position = {{-1, 0, 0}, {0, 0, 0}, {1, 0, 0}}},
                        CapsuleCollisionModel<Vec3d>{
                            .moving = false, .simulated = false, .listCapsuleRadii = {0.1, 0.3}}),
          free_body<"free", Vec3d>({at}, PointCollisionModel<Vec3d>{}));
    };
    const auto above = chain({0, 0, 0.4});
    REQUIRE(above.size() == 1);
    CHECK(above[0].distance == Approx(0.1));
    // beside the thick end, over the thin one: 0.2 m from that, and 0.12 from the end of the thick one
    const auto beside = chain({-0.2, 0, 0.3});
    REQUIRE(beside.size() == 2);
    CHECK(std::min(beside[0].distance, beside[1].distance) == Approx(std::sqrt(0.13) - 0.3));
    CHECK(std::max(beside[0].distance, beside[1].distance) == Approx(0.2));
    // over the thick one the thin one has nothing to say
    CHECK(chain({0.2, 0, 0.4}).size() == 1);
  }
  SECTION("LocalMinDistance and DiscreteIntersection have them too") {
    const LocalMinDistance local{.alarmDistance = 0.2, .contactDistance = 0.05};
    CHECK(contacts_of(local, still({{-1, 0, 0}, {1, 0, 0}}, 0.2), body({{0, -1, 0.4}, {0, 1, 0.4}}, 0.1))
              .size() == 1);
    const auto onFloor = contacts_of(local, floor_node(100, 0), body({{-1, 0, 0.2}, {1, 0, 0.2}}, 0.1));
    REQUIRE(onFloor.size() == 2);
    for (Contact const& one : onFloor) CHECK(one.distance == Approx(0.1));
    const auto crossed = contacts_of(DiscreteIntersection{},
                                     still({{-1, 0, 0}, {1, 0, 0}}, 0.2),
                                     body({{0, -1, 0.25}, {0, 1, 0.25}}, 0.1));
    REQUIRE(crossed.size() == 1);
    CHECK(crossed[0].distance == Approx(-0.05));
  }
}

TEST_CASE("a box meets capsules of points and of rigids where they are") {
  const auto place = rigid_at({3, -2, 1}, {0.7, {1, 2, -1}});
  auto world = [&](V const& x) -> V { return place.orientation * x + place.center; };
  for (const double gap : {0.1, 0.01, -0.05, -0.3}) {  // at the last the axis is inside, too
    INFO(gap);
    auto check = [&](std::vector<Contact> const& found) {
      REQUIRE(found.size() == 2);
      for (Contact const& c : found) {
        CHECK(c.distance == Approx(gap).margin(1e-9));
        CHECK((c.normal - place.orientation * V(0, 0, 1)).norm() < 1e-7);
        CHECK(c.a.lever[2] == Approx(0.5));
      }
    };
    check(contacts_of(near,
                      box(place, {1, 1, 0.5}),
                      free_body<"free", Vec3d>({world({0, -0.6, 0.7 + gap}), world({0, 0.6, 0.7 + gap})},
                                               CapsuleCollisionModel<Vec3d>{.defaultRadius = 0.2},
                                               edges({{0, 1}}))));
    check(contacts_of(
        near,
        box(place, {1, 1, 0.5}),
        free_body<"free", Rigid3d>({moved(place, rigid_at({0, 0, 0.7 + gap}))},
                                   CapsuleCollisionModel<Rigid3d>{.radii = {0.2}, .heights = {1.2}})));
  }
}

TEST_CASE("boxes of one model have their own sides, and a picture shows what is touched") {
  const auto found = contacts_of(
      near,
      node<"still">(MechanicalObject<Rigid3d>{.position = {rigid_at({0, 0, 0}), rigid_at({5, 0, 0})}},
                    OBBCollisionModel<Rigid3d>{
                        .moving = false, .simulated = false, .defaultExtent = 0.5, .extents = {{1, 1, 2}}}),
      free_body<"free", Vec3d>({{0.1, 0.2, 2.1}, {5.1, 0.2, 0.6}, {5.1, 0.2, 2.1}},
                               PointCollisionModel<Vec3d>{}));
  REQUIRE(found.size() == 2);
  for (Contact const& c : found) CHECK(c.distance == Approx(0.1));
}

TEST_CASE("contacts do not depend on the frame") {
  Random random;
  for (int i = 0; i < 20; ++i) {
    INFO(i);
    const auto a = random.pose(0.3), c = random.pose(0.3);
    auto b = random.pose(0.3);
    b.center += V(1, 0.4, 0);
    const auto frame = random.pose(5);
    auto all = [&](RigidCoord3<double> const& f) {
      auto sim = contact_scene(
          MinProximityIntersection{.alarmDistance = 1, .contactDistance = 0.5},
          0,
          box(moved(f, a), {0.5, 0.7, 0.3}),
          free_body<"capsule", Rigid3d>({moved(f, b)}, CapsuleCollisionModel<Rigid3d>{.defaultRadius = 0.2}),
          free_body<"other", Rigid3d>({moved(f, c)},
                                      OBBCollisionModel<Rigid3d>{.extents = {{0.4, 0.2, 0.6}}}));
      sim.init();
      sim.animate(1e-9);
      return sim.root().template get<Contacts>().contacts;
    };
    const auto here = all(rigid_at({0, 0, 0})), there = all(frame);
    REQUIRE(here.size() == there.size());
    for (std::size_t k = 0; k < here.size(); ++k) {
      CHECK(there[k].distance == Approx(here[k].distance).margin(1e-7));
      CHECK((there[k].normal - frame.orientation * here[k].normal).norm() < 1e-6);
    }
  }
}

TEST_CASE("what collides without friction keeps its momenta") {
  // places of a contact lie on its normal, so that the two forces have no torque together; boxes and capsules
  // of 2 kg and 0.1 kg m^2
  RigidMass<double, 3> mass{2, 0.1 * Eigen::Matrix3d::Identity()};
  auto momenta = [](auto const& s) {
    V linear(0, 0, 0), angular(0, 0, 0);
    for (std::size_t i = 0; i < s.position.size(); ++i) {
      const V v = s.velocity[i].template head<3>(), w = s.velocity[i].template tail<3>();
      linear += 2 * v;
      angular += 2 * s.position[i].center.cross(v) + 0.1 * w;
    }
    return std::pair(linear, angular);
  };
  auto run = [&](auto sim) {
    sim.init();
    auto all = [&] {
      const auto a = momenta(sim.template at<"a">().state()), b = momenta(sim.template at<"b">().state());
      return std::pair<V, V>(a.first + b.first, a.second + b.second);
    };
    const auto before = all();
    const V start = sim.template at<"b">().state().velocity[0].template head<3>();
    for (int i = 0; i < 400; ++i) sim.animate(1e-3);
    const auto after = all();
    CHECK((sim.template at<"b">().state().velocity[0].template head<3>() - start).norm() > 0.1);
    CHECK((after.first - before.first).norm() < 1e-12);
    CHECK((after.second - before.second).norm() < 1e-9);
  };
  Rigid3d::Deriv flies;
  flies << -2, 0, 0.3, 0.5, -1, 0.7;
  const auto here = rigid_at({0, 0, 0}, {0.4, {1, 1, 0}}), there = rigid_at({1.2, 0.2, 0.1}, {1, {0, 1, 3}});
  auto moving = [&]<class Model>(Model model, RigidCoord3<double> const& x, Rigid3d::Deriv const& v) {
    return std::tuple(EulerExplicitSolver{},
                      MechanicalObject<Rigid3d>{.position = {x}, .velocity = {v}},
                      UniformMass<Rigid3d>{.vertexMass = mass},
                      model);
  };
  const OBBCollisionModel<Rigid3d> obb{.contactStiffness = 30, .extents = {{0.5, 0.4, 0.3}}};
  const CapsuleCollisionModel<Rigid3d> capsule{.contactStiffness = 30, .radii = {0.3}, .heights = {0.8}};
  auto scene = [&](auto first, auto second) {
    auto a =
        std::apply([](auto... c) { return node<"a">(c...); }, moving(first, here, Rigid3d::Deriv::Zero()));
    auto b = std::apply([](auto... c) { return node<"b">(c...); }, moving(second, there, flies));
    return contact_scene(near, 0, a, b);
  };
  run(scene(obb, obb));
  run(scene(obb, capsule));
  run(scene(capsule, capsule));
}

TEST_CASE("capsules and boxes that fall come to rest, as deep as they are stiff") {
  // 20 N on two ends, k = 2000 * 10 / (0.05 + 0.2) of points; rigids have the radius in their skin, and it is
  // not in their k
  SECTION("a capsule of two points of 1 kg") {
    auto sim =
        contact_scene(near,
                      10,
                      floor_node(2000, 0),
                      node<"rod">(EulerImplicitSolver{},
                                  CGLinearSolver<>{.iterations = 100, .tolerance = 1e-14},
                                  edges({{0, 1}}),
                                  MechanicalObject<Vec3d>{.position = {{-0.5, 0.3, 0.5}, {0.5, 0.3, 0.6}}},
                                  UniformMass<Vec3d>{.vertexMass = 1},
                                  CapsuleCollisionModel<Vec3d>{
                                      .contactStiffness = 10, .contactDamping = 20, .defaultRadius = 0.2}));
    sim.init();
    for (int i = 0; i < 2000; ++i) sim.animate(0.005);
    const double k = 2000 * 10 / 0.25;
    for (V const& x : sim.at<"rod">().state().position) CHECK(x[2] == Approx(0.25 - 10 / k).margin(1e-8));
    CHECK(sim.root().get<Contacts>().contacts.size() == 2);
  }
  SECTION("a rigid capsule and a box") {
    auto sim = contact_scene(
        near,
        10,
        floor_node(2000, 0),
        node<"rod">(
            EulerImplicitSolver{},
            CGLinearSolver<>{.iterations = 100, .tolerance = 1e-14},
            MechanicalObject<Rigid3d>{.position = {rigid_at({0, 0, 0.5}, {0.1, {1, 0, 0}})}},
            UniformMass<Rigid3d>{.vertexMass = RigidMass<double, 3>{2, 0.1 * Eigen::Matrix3d::Identity()}},
            CapsuleCollisionModel<Rigid3d>{
                .contactStiffness = 10, .contactDamping = 20, .radii = {0.2}, .heights = {1}}),
        node<"box">(
            EulerImplicitSolver{},
            CGLinearSolver<>{.iterations = 100, .tolerance = 1e-14},
            MechanicalObject<Rigid3d>{.position = {rigid_at({3, 0, 0.5}, {0.2, {1, 0.5, 0}})}},
            UniformMass<Rigid3d>{.vertexMass = RigidMass<double, 3>{2, 0.1 * Eigen::Matrix3d::Identity()}},
            OBBCollisionModel<Rigid3d>{
                .contactStiffness = 10, .contactDamping = 20, .extents = {{0.4, 0.3, 0.2}}}));
    sim.init();
    for (int i = 0; i < 2000; ++i) sim.animate(0.005);
    const double kRod = 2000 * 10 / 0.25, kBox = 2000 * 10 / 0.05;
    CHECK(sim.at<"rod">().state().position[0].center[2] == Approx(0.25 - 10 / kRod).margin(1e-7));
    CHECK(sim.at<"box">().state().position[0].center[2] == Approx(0.25 - 5 / kBox).margin(1e-7));
    CHECK(sim.root().get<Contacts>().contacts.size() == 6);
  }
}

TEST_CASE("a fast capsule is stopped by a box under a continuous method") {
  const ContinuousIntersection swept{.alarmDistance = 0.1, .contactDistance = 0.02};
  auto sim = contact_scene(
      swept,
      0,
      box(rigid_at({0, 0, 0}), {1, 1, 0.05}),
      node<"free">(EulerImplicitSolver{},
                   CGLinearSolver<>{.iterations = 50, .tolerance = 1e-12},
                   edges({{0, 1}}),
                   MechanicalObject<Vec3d>{.position = {{-0.2, 0, 1}, {0.2, 0, 1}},
                                           .velocity = {{0, 0, -300}, {0, 0, -300}}},
                   UniformMass<Vec3d>{},
                   CapsuleCollisionModel<Vec3d>{.contactStiffness = 1e4, .defaultRadius = 0.1}));
  sim.init();
  for (int i = 0; i < 5; ++i) sim.animate(0.01);
  for (V const& x : sim.at<"free">().state().position) CHECK(x[2] > 0);
}

TEST_CASE("rays meet capsules where they enter them, or leave those in which they begin") {
  const std::array<V, 2> p{V(-1, 0, 0), V(1, 0, 0)};
  const double r = 0.3;
  Random random;
  for (int i = 0; i < 2000; ++i) {
    const V from = random.vector(2), to = random.vector(1);
    if ((to - from).norm() < 0.1) continue;
    const Ray ray{from, (to - from).normalized()};
    auto gap = [&](double t) {
      return std::sqrt(closest_points(std::array<V, 1>{ray.at(t)}, p).squaredDistance) - r;
    };
    const RayHit hit = ray_capsule(ray, p, r);
    const double start = gap(0);
    if (hit) {
      CHECK(gap(hit.distance) == Approx(0).margin(1e-9));
      for (double t = 0; t < hit.distance - 1e-6; t += 0.05) CHECK(gap(t) * start >= -1e-9);
    } else {
      CHECK(start > 0);
      for (double t = 0; t < 6; t += 0.02) CHECK(gap(t) > -1e-9);
    }
  }
  CHECK(ray_capsule({{-3, 0.1, 0}, {1, 0, 0}}, p, r).distance == Approx(2 - std::sqrt(0.08)));
  CHECK(!ray_capsule({{-3, 0.4, 0}, {1, 0, 0}}, p, r));
  CHECK(ray_capsule({{0, 0, 0}, {0, 0, 1}}, {V(0, 0, 0), V(0, 0, 0)}, r).distance == Approx(0.3));
  // picking, of rigids and of points
  auto sim = contact_scene(
      near,
      0,
      free_body<"rigid", Rigid3d>({rigid_at({0, 0, 0})},
                                  CapsuleCollisionModel<Rigid3d>{.radii = {0.3}, .heights = {2}}),
      free_body<"points", Vec3d>(
          {{4, -1, 0}, {4, 1, 0}}, CapsuleCollisionModel<Vec3d>{.defaultRadius = 0.2}, edges({{0, 1}})));
  sim.init();
  CHECK(sim.pick({0, 0.5, 5}, {0, 0, -1})->distance == Approx(4.7));
  CHECK(sim.pick({0, 1.2, 5}, {0, 0, -1})->distance == Approx(5 - std::sqrt(0.05)));
  CHECK(sim.pick({4, 0.5, 5}, {0, 0, -1})->distance == Approx(4.8));
  CHECK(!sim.pick({4, 1.3, 5}, {0, 0, -1}));
}

TEST_CASE("wrong boxes and capsules say what is wrong") {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  auto rigid = [](auto model) {
    auto sim = contact_scene(near, 0, free_body<"free", Rigid3d>({rigid_at({0, 0, 0})}, model));
    return error_of([&] { sim.init(); });
  };
  auto points = [](CapsuleCollisionModel<Vec3d> model, MeshTopology topology) {
    auto sim = contact_scene(near, 0, free_body<"free", Vec3d>({{0, 0, 0}, {1, 0, 0}}, model, topology));
    return error_of([&] { sim.init(); });
  };
  using Catch::Contains;
  for (const double wrong : {0.0, -1.0, nan}) {
    CHECK_THAT(rigid(OBBCollisionModel<Rigid3d>{.extents = {{1, wrong, 1}}}),
               Contains("free") && Contains("OBBCollisionModel") && Contains("extents"));
    CHECK_THAT(rigid(OBBCollisionModel<Rigid3d>{.defaultExtent = wrong}), Contains("defaultExtent"));
    CHECK_THAT(rigid(CapsuleCollisionModel<Rigid3d>{.radii = {wrong}}), Contains("radii"));
    CHECK_THAT(points({.defaultRadius = wrong}, edges({{0, 1}})), Contains("defaultRadius"));
    CHECK_THAT(points({.listCapsuleRadii = {wrong}}, edges({{0, 1}})), Contains("listCapsuleRadii"));
  }
  CHECK_THAT(rigid(CapsuleCollisionModel<Rigid3d>{.heights = {-1}}), Contains("heights"));
  CHECK(rigid(CapsuleCollisionModel<Rigid3d>{.heights = {0}}).empty());  // a ball
  CHECK_THAT(rigid(OBBCollisionModel<Rigid3d>{.extents = {{1, 1, 1}, {1, 1, 1}}}),
             Contains("extents has 2 entries for 1 rigids"));
  CHECK_THAT(rigid(CapsuleCollisionModel<Rigid3d>{.radii = {1, 1}}), Contains("radii has 2 entries"));
  CHECK_THAT(points({}, {}), Contains("free") && Contains("there are no edges"));
  CHECK_THAT(points({.listCapsuleRadii = {1, 1}}, edges({{0, 1}})),
             Contains("listCapsuleRadii has 2 entries for 1 edges"));
}

}  // namespace test_hull_obb_capsule
