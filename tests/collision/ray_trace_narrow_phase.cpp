// SPDX-License-Identifier: BSL-1.0
// Contacts by rays: against all triangles, closed forms of balls, momenta, frames, and what has none.
#include <sinew/collision/discrete_intersection.hpp>
#include <sinew/collision/ray_trace_narrow_phase.hpp>
#include <sinew/solver/euler_explicit.hpp>

#include "collision/contact_scene.hpp"

#include <algorithm>
#include <map>

namespace test_ray_trace_narrow_phase {

using namespace sinew;
using V = Eigen::Vector3d;

namespace {

struct Mesh {
  std::vector<V> points;
  MeshTopology topology;
};
/// An octahedron, each of whose faces is divided in 4 `divisions` times; points on the ball.
Mesh ball(double radius, int divisions, V const& center) {
  Mesh mesh;
  auto& p = mesh.points;
  auto& all = mesh.topology.triangles;
  p = {{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}};
  all = {{0, 2, 4}, {2, 1, 4}, {1, 3, 4}, {3, 0, 4}, {2, 0, 5}, {1, 2, 5}, {3, 1, 5}, {0, 3, 5}};
  for (int d = 0; d < divisions; ++d) {
    std::map<std::pair<int, int>, int> middles;
    auto middle = [&](int i, int j) {
      auto [at, isNew] = middles.try_emplace(std::minmax(i, j), int(p.size()));
      if (isNew) p.push_back((p[std::size_t(i)] + p[std::size_t(j)]).normalized());
      return at->second;
    };
    std::vector<Triangle> finer;
    for (auto const& [a, b, c] : all) {
      const int ab = middle(a, b), bc = middle(b, c), ca = middle(c, a);
      for (Triangle const& t : {Triangle{a, ab, ca}, {ab, b, bc}, {ca, bc, c}, {ab, bc, ca}})
        finer.push_back(t);
    }
    all = finer;
  }
  for (V& x : p) x = radius * x + center;
  return mesh;
}
template <FixedString Name>
auto body(Mesh const& mesh, double stiffness = 10, std::vector<V> velocity = {}) {
  return node<Name>(EulerExplicitSolver{},
                    mesh.topology,
                    MechanicalObject<Vec3d>{.position = mesh.points, .velocity = velocity},
                    UniformMass<Vec3d>{.vertexMass = 1},
                    TriangleCollisionModel<Vec3d>{.contactStiffness = stiffness});
}
template <class... Children>
auto ray_scene(Children... children) {
  return Simulation{node<"root">(DefaultPipeline{},
                                 BruteForceBroadPhase{},
                                 RayTraceNarrowPhase{},
                                 MinProximityIntersection{.alarmDistance = 0.2, .contactDistance = 0.05},
                                 Contacts{},
                                 children...)};
}
template <class... Children>
std::vector<Contact> contacts_of(Children... children) {
  auto sim = ray_scene(children...);
  sim.init();
  sim.animate(1e-9);
  return sim.root().template get<Contacts>().contacts;
}
Mesh moved(Mesh mesh, Eigen::Quaterniond const& q, V const& by) {
  for (V& x : mesh.points) x = q * x + by;
  return mesh;
}

std::vector<V> normals_of(Mesh const& m) {
  std::vector<V> all(m.points.size(), V::Zero());
  for (auto const& t : m.topology.triangles) {
    auto at = [&](std::size_t c) { return m.points[std::size_t(t[c])]; };
    for (const int v : t) all[std::size_t(v)] += (at(1) - at(0)).cross(at(2) - at(0));
  }
  for (V& n : all) n.normalize();
  return all;
}
// Moeller and Trumbore 1997; the distance, negative where there is none, and whether from the inside
std::pair<double, bool> through(V const& from, V const& d, Mesh const& m, Triangle const& t) {
  const V a = m.points[std::size_t(t[0])], u = m.points[std::size_t(t[1])] - a,
          v = m.points[std::size_t(t[2])] - a;
  const V h = d.cross(v);
  const double det = u.dot(h);
  if (std::abs(det) < 1e-14) return {-1, false};
  const V s = from - a, q = s.cross(u);
  const double x = s.dot(h) / det, y = d.dot(q) / det;
  if (x < 0 || y < 0 || x + y > 1) return {-1, false};
  return {v.dot(q) / det, u.cross(v).dot(d) > 0};
}
// how deep each vertex of a is in b along its normal; vertices that are not are left out
std::map<int, double> depths(Mesh const& a, Mesh const& b) {
  std::map<int, double> all;
  const auto n = normals_of(a);
  for (int v = 0; v < int(a.points.size()); ++v) {
    auto nearest = [&](Mesh const& m, int without) {
      std::pair<double, bool> best{1e9, false};
      for (auto const& t : m.topology.triangles) {
        if (t[0] == without || t[1] == without || t[2] == without) continue;
        const auto hit = through(a.points[std::size_t(v)], -n[std::size_t(v)], m, t);
        if (hit.first >= 0 && hit.first < best.first) best = hit;
      }
      return best;
    };
    const auto other = nearest(b, -1), own = nearest(a, v);
    if (other.first < 1e9 && other.second && own.first < 1e9 && own.second && other.first <= own.first)
      all[v] = other.first;
  }
  return all;
}

}  // namespace

TEST_CASE("rays find the vertices that all triangles say are inside, and how deep they are") {
  const Mesh a = ball(1, 3, {0, 0, 0}), b = ball(0.7, 2, {1.3, 0.21, -0.13});
  const auto found = contacts_of(body<"a">(a), body<"b">(b));
  const auto ofA = depths(a, b), ofB = depths(b, a);
  REQUIRE(ofA.size() > 5);
  REQUIRE(ofB.size() > 5);
  CHECK(found.size() == ofA.size() + ofB.size());
  const auto normalsA = normals_of(a), normalsB = normals_of(b);
  for (Contact const& c : found) {
    const bool first = c.a.corners() == 1;
    const int v = first ? c.a.vertices[0] : c.b.vertices[0];
    auto const& expected = first ? ofA : ofB;
    REQUIRE(expected.count(v) == 1);
    CHECK(-c.distance == Approx(expected.at(v)).margin(1e-12));
    const V n = first ? normalsA[std::size_t(v)] : V(-normalsB[std::size_t(v)]);
    CHECK((c.normal - n).norm() < 1e-12);
    // its place on the other is on the ray, so that the two forces have no torque
    CHECK(c.start.cross(c.normal).norm() < 1e-12);
    CHECK(c.limit == 0.05);
  }
}

TEST_CASE("on the line between the middles of two balls the ray is as long as they are deep") {
  // both have a vertex there, whose rays are one: 0.3 m
  const auto found = contacts_of(body<"a">(ball(1, 3, {0, 0, 0})), body<"b">(ball(1, 3, {1.7, 0, 0})));
  int onLine = 0;
  for (Contact const& c : found)
    if (std::abs(c.normal[0] - 1) < 1e-9) {
      CHECK(-c.distance == Approx(0.3).margin(1e-12));
      CHECK((c.a.corners() == 1 && c.b.corners() == 1));
      ++onLine;
    }
  CHECK(onLine == 1);
}

TEST_CASE("a surface in two layers has the contacts of each of them") {
  auto twice = [](Mesh mesh) {
    const int n = int(mesh.points.size());
    mesh.points.insert(mesh.points.end(), mesh.points.begin(), mesh.points.begin() + n);
    auto& all = mesh.topology.triangles;
    for (std::size_t t = 0, count = all.size(); t < count; ++t)
      all.push_back({all[t][0] + n, all[t][1] + n, all[t][2] + n});
    return mesh;
  };
  const Mesh a = ball(1, 2, {3, 20, -11}), b = ball(0.8, 2, {4.3, 20.21, -11.13});
  const auto one = contacts_of(body<"a">(a), body<"b">(b)),
             two = contacts_of(body<"a">(twice(a)), body<"b">(b));
  auto ofA = [](std::vector<Contact> const& all) {
    return std::count_if(all.begin(), all.end(), [](Contact const& c) { return c.a.corners() == 1; });
  };
  REQUIRE(ofA(one) > 5);
  CHECK(ofA(two) == 2 * ofA(one));
  CHECK(two.size() - std::size_t(ofA(two)) == one.size() - std::size_t(ofA(one)));
}

TEST_CASE("rays do not depend on the frame") {
  const Mesh a = ball(1, 2, {0, 0, 0}), b = ball(0.8, 2, {1.3, 0.21, -0.13});
  const Eigen::Quaterniond q(Eigen::AngleAxisd(1.1, V(1, 2, -0.5).normalized()));
  const V by(3, -4, 2);
  const auto here = contacts_of(body<"a">(a), body<"b">(b)),
             there = contacts_of(body<"a">(moved(a, q, by)), body<"b">(moved(b, q, by)));
  REQUIRE(here.size() == there.size());
  for (std::size_t i = 0; i < here.size(); ++i) {
    CHECK(there[i].a.vertices == here[i].a.vertices);
    CHECK(there[i].distance == Approx(here[i].distance).margin(1e-12));
    CHECK((there[i].normal - q * here[i].normal).norm() < 1e-12);
  }
}

TEST_CASE("bodies in each other part, and keep their momenta") {
  const Mesh a = ball(1, 2, {0, 0, 0}), b = ball(0.8, 2, {1.4, 0.21, -0.13});
  auto sim = ray_scene(body<"a">(a, 1, std::vector<V>(a.points.size(), V(0.3, 0.1, 0))),
                       body<"b">(b, 1, std::vector<V>(b.points.size(), V(-0.5, 0, 0.2))));
  sim.init();
  auto momenta = [&] {
    V linear(0, 0, 0), angular(0, 0, 0);
    auto add = [&](auto const& s) {
      for (std::size_t i = 0; i < s.position.size(); ++i) {
        linear += s.velocity[i];
        angular += s.position[i].cross(s.velocity[i]);
      }
    };
    add(sim.at<"a">().state());
    add(sim.at<"b">().state());
    return std::pair<V, V>(linear, angular);
  };
  const auto before = momenta();
  CHECK(sim.root().get<Contacts>().contacts.empty());
  for (int i = 0; i < 20; ++i) sim.animate(1e-3);
  CHECK(!sim.root().get<Contacts>().contacts.empty());
  const auto after = momenta();
  CHECK((after.first - before.first).norm() < 1e-10);
  CHECK((after.second - before.second).norm() < 1e-10);
  V away(0, 0, 0);  // b has been pushed along x
  for (V const& v : sim.at<"b">().state().velocity) away += v / double(b.points.size());
  CHECK(away[0] > -0.5);
}

TEST_CASE("what is apart, or wholly inside, or open has no contacts by rays of its own") {
  CHECK(contacts_of(body<"a">(ball(1, 2, {0, 0, 0})), body<"b">(ball(1, 2, {2.01, 0, 0}))).empty());
  CHECK(contacts_of(body<"a">(ball(1, 2, {0, 0, 0})), body<"b">(ball(0.2, 2, {0.1, 0, 0}))).empty());
  // a floor of one layer stops the vertices of a ball
  const auto found = contacts_of(floor_node(10, 0), body<"b">(ball(1, 2, {0.3, 0.2, 0.9})));
  REQUIRE(!found.empty());
  double deepest = 0;
  for (Contact const& c : found) {
    CHECK(c.b.corners() == 1);
    CHECK(c.normal[2] > 0);
    deepest = std::max(deepest, -c.distance);
  }
  CHECK(deepest == Approx(0.1).margin(1e-12));
}

TEST_CASE("other models are met as by boxes, and points and lines beside triangles are left to these") {
  auto sphere = node<"sphere">(EulerExplicitSolver{},
                               MechanicalObject<Vec3d>{.position = {{0, 0, 1.25}}},
                               UniformMass<Vec3d>{},
                               SphereCollisionModel<Vec3d>{.radius = 0.2});
  const auto one = contacts_of(body<"a">(ball(1, 2, {0, 0, 0})), sphere);
  REQUIRE(one.size() == 1);
  CHECK(one[0].distance == Approx(0.05));
  const Mesh a = ball(1, 2, {0, 0, 0}), b = ball(0.8, 2, {1.3, 0.21, -0.13});
  auto withAll = [](auto triangles) {
    return std::apply(
        [](auto... c) { return node<"b">(c..., LineCollisionModel<Vec3d>{}, PointCollisionModel<Vec3d>{}); },
        triangles);
  };
  const auto alone = contacts_of(body<"a">(a), body<"b">(b)).size();
  const auto beside = contacts_of(body<"a">(a),
                                  withAll(std::tuple(EulerExplicitSolver{},
                                                     b.topology,
                                                     MechanicalObject<Vec3d>{.position = b.points},
                                                     UniformMass<Vec3d>{},
                                                     TriangleCollisionModel<Vec3d>{})))
                          .size();
  CHECK(alone == beside);
}

}  // namespace test_ray_trace_narrow_phase
