// SPDX-License-Identifier: BSL-1.0
// Solids of tetrahedra: what is in them, against closed forms; momenta, and what is refused.
#include <sinew/collision/discrete_intersection.hpp>
#include <sinew/collision/local_min_distance.hpp>
#include <sinew/collision/tetrahedron_collision_model.hpp>
#include <sinew/solver/euler_explicit.hpp>

#include "collision/contact_scene.hpp"
#include "error_of.hpp"

#include <Eigen/LU>
#include <random>

namespace test_tetrahedron_collision_model {

using namespace sinew;
using V = Eigen::Vector3d;

namespace {

struct Random {
  std::mt19937 engine{11};
  double number(double low, double high) { return std::uniform_real_distribution(low, high)(engine); }
  V vector(double size) { return {number(-size, size), number(-size, size), number(-size, size)}; }
};

struct Block {
  std::vector<V> points;
  MeshTopology topology;
};
/// The cube of half side 1 as n^3 cells of six tetrahedra each.
Block block(int n) {
  Block b;
  auto at = [n](int x, int y, int z) { return x + (n + 1) * (y + (n + 1) * z); };
  for (int z = 0; z <= n; ++z)
    for (int y = 0; y <= n; ++y)
      for (int x = 0; x <= n; ++x) b.points.push_back(2.0 / n * V(x, y, z) - V::Ones());
  const std::array<std::array<int, 3>, 6> orders{
      {{0, 1, 2}, {0, 2, 1}, {1, 0, 2}, {1, 2, 0}, {2, 0, 1}, {2, 1, 0}}};
  for (int z = 0; z < n; ++z)
    for (int y = 0; y < n; ++y)
      for (int x = 0; x < n; ++x)
        for (auto const& order : orders) {
          std::array<int, 3> c{x, y, z};
          Tetrahedron t{at(c[0], c[1], c[2]), 0, 0, 0};
          for (std::size_t k = 0; k < 3; ++k) {
            ++c[std::size_t(order[k])];
            t[k + 1] = at(c[0], c[1], c[2]);
          }
          if ((order[1] - order[0] + 3) % 3 != 1) std::swap(t[2], t[3]);  // an odd order turns it inside out
          b.topology.tetrahedra.push_back(t);
        }
  return b;
}
template <class Model>
auto free_body(std::vector<V> const& x, Model model) {
  return node<"free">(EulerExplicitSolver{},
                      MechanicalObject<Vec3d>{.position = x},
                      UniformMass<Vec3d>{.vertexMass = 1},
                      model);
}
auto solid(Block const& b) {
  return node<"solid">(EulerExplicitSolver{},
                       b.topology,
                       MechanicalObject<Vec3d>{.position = b.points},
                       UniformMass<Vec3d>{.vertexMass = 1},
                       TetrahedronCollisionModel<Vec3d>{});
}
template <class Method, class Body>
std::vector<Contact> contacts_of(Method method, Block const& b, Body body) {
  auto sim = contact_scene(method, 0, solid(b), body);
  sim.init();
  sim.animate(1e-9);
  return sim.root().template get<Contacts>().contacts;
}
template <class Method>
void check_inside(Method method, Block const& b, Eigen::Quaterniond const& q, V const& by) {
  Random random;
  Block there = b;
  for (V& x : there.points) x = q * x + by;
  std::vector<V> all;
  for (int i = 0; i < 50; ++i) all.push_back(q * random.vector(0.99) + by);
  std::vector<int> found(all.size(), 0);
  for (Contact const& c : contacts_of(method, there, free_body(all, PointCollisionModel<Vec3d>{}))) {
    const auto i = std::size_t(c.b.vertices[0]);
    const V x = q.conjugate() * (all[i] - by);
    Eigen::Index axis = 0;
    const double deep = 1 - x.cwiseAbs().maxCoeff(&axis);
    if (std::abs(c.distance + deep) > 1e-9) continue;  // another face within the reach of the method
    ++found[i];
    const V n = q * V(V::Unit(axis) * (x[axis] < 0 ? -1 : 1));
    CHECK((c.normal - n).norm() < 1e-9);
  }
  for (const int n : found) CHECK(n == 1);
}

}  // namespace

TEST_CASE("what is in a tetrahedron has no negative weight") {
  Random random;
  int inside = 0;
  for (int i = 0; i < 4000; ++i) {
    const std::array<V, 4> t{random.vector(1), random.vector(1), random.vector(1), random.vector(1)};
    const V x = random.vector(0.5);
    Eigen::Matrix3d sides;
    for (int k = 0; k < 3; ++k) sides.col(k) = t[std::size_t(k) + 1] - t[0];
    const V w = sides.inverse() * (x - t[0]);
    const double least = std::min(w.minCoeff(), 1 - w.sum());
    if (std::abs(least) < 1e-9) continue;
    CHECK(is_inside(t, x) == (least > 0));
    inside += least > 0;
  }
  CHECK(inside > 50);
  CHECK_FALSE(is_inside({V(0, 0, 0), V(1, 0, 0), V(0, 1, 0), V(1, 1, 0)}, V(0.3, 0.3, 0)));  // flat
}

TEST_CASE("a point in a block goes out by the nearest face, however deep, with all methods") {
  const Block b = block(3);
  const Eigen::Quaterniond none = Eigen::Quaterniond::Identity(),
                           q(Eigen::AngleAxisd(0.8, V(1, 2, 3).normalized()));
  check_inside(MinProximityIntersection{.alarmDistance = 0.1, .contactDistance = 0.05}, b, none, V(0, 0, 0));
  check_inside(MinProximityIntersection{.alarmDistance = 0.1, .contactDistance = 0.05}, b, q, V(3, -1, 2));
  check_inside(DiscreteIntersection{}, b, q, V(3, -1, 2));
  check_inside(LocalMinDistance{.alarmDistance = 0.1, .contactDistance = 0.05}, b, q, V(3, -1, 2));
}

TEST_CASE("spheres are pushed out by their radius more, and what is outside is met at the surface") {
  const MinProximityIntersection near{.alarmDistance = 0.1, .contactDistance = 0.05};
  const auto in =
      contacts_of(near, block(2), free_body({{0.5, 0.1, 0.2}}, SphereCollisionModel<Vec3d>{.radius = 0.2}));
  REQUIRE(!in.empty());
  double deepest = 0;
  for (Contact const& c : in) deepest = std::min(deepest, c.distance);
  CHECK(deepest == Approx(-0.5 - 0.2));
  const auto out = contacts_of(near, block(2), free_body({{1.08, 0.1, 0.2}}, PointCollisionModel<Vec3d>{}));
  REQUIRE(out.size() == 1);
  CHECK(out[0].distance == Approx(0.08));
  CHECK(contacts_of(near, block(2), free_body({{1.2, 0.1, 0.2}}, PointCollisionModel<Vec3d>{})).empty());
}

TEST_CASE("what is pushed out keeps the momenta with the solid") {
  const Block b = block(2);
  auto sim = contact_scene(DiscreteIntersection{},
                           0,
                           solid(b),
                           free_body({{0.7, 0.1, 0.23}, {-0.2, 0.85, 0.1}}, PointCollisionModel<Vec3d>{}));
  sim.init();
  auto momenta = [&] {
    V linear(0, 0, 0), angular(0, 0, 0);
    auto add = [&](auto const& s) {
      for (std::size_t i = 0; i < s.position.size(); ++i) {
        linear += s.velocity[i];
        angular += s.position[i].cross(s.velocity[i]);
      }
    };
    add(sim.at<"solid">().state());
    add(sim.at<"free">().state());
    return std::pair<V, V>(linear, angular);
  };
  for (int i = 0; i < 50; ++i) sim.animate(1e-3);
  CHECK(sim.at<"free">().state().velocity[0][0] > 0.1);
  CHECK(sim.at<"free">().state().velocity[1][1] > 0.1);
  CHECK(momenta().first.norm() < 1e-12);
  CHECK(momenta().second.norm() < 1e-12);
}

TEST_CASE("a solid without tetrahedra says so") {
  Block none = block(1);
  none.topology.tetrahedra.clear();
  none.topology.triangles = {{0, 1, 2}};
  auto sim = contact_scene(DiscreteIntersection{}, 0, solid(none));
  CHECK_THAT(error_of([&] { sim.init(); }),
             Catch::Contains("solid: TetrahedronCollisionModel") && Catch::Contains("no tetrahedra"));
}

}  // namespace test_tetrahedron_collision_model
