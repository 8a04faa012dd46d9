// SPDX-License-Identifier: BSL-1.0
// Contacts of points on the device with what stands, against those that the host finds of all pairs.
#include "catch.hpp"

#include <sinew/gpu/gpu.hpp>

#include <sinew/collision/friction_contact_constraint.hpp>
#include <sinew/collision/min_proximity_intersection.hpp>
#include <sinew/gpu/contact_search.hpp>

#include <optional>
#include <random>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

namespace test_device_contact_search {

using namespace sinew;
using Vector = Eigen::Vector3d;

namespace {

CollisionSurface surface_of(Shape shape, int number, std::vector<Vector> const& points,
                            std::vector<std::array<int, 3>> elements) {
  CollisionSurface s;
  s.shape = shape;
  s.number = number;
  s.elements = std::move(elements);
  s.settings.bothSide = false;
  s.settings.proximity = 0.01;
  s.path = "/standing";
  if (shape == Shape::sphere)
    for (std::size_t i = 0; i < s.elements.size(); ++i) s.radius.push_back(0.05 + 0.01 * double(i % 4));
  s.resize(points.size());
  s.position = points;
  return s;
}
std::vector<std::array<int, 3>> each_point(std::size_t n) {
  std::vector<std::array<int, 3>> all;
  for (int i = 0; i < int(n); ++i) all.push_back({i, -1, -1});
  return all;
}

// hills of n x n squares over [0, 1]^2, cut into triangles or along their edges
struct Hills {
  std::vector<Vector> points{};
  std::vector<std::array<int, 3>> triangles{}, lines{};
  explicit Hills(int n) {
    for (int j = 0; j <= n; ++j)
      for (int i = 0; i <= n; ++i) {
        const double x = double(i) / n, y = double(j) / n;
        points.push_back({x, y, 0.1 * std::sin(7 * x) * std::cos(5 * y)});
      }
    for (int j = 0; j < n; ++j)
      for (int i = 0; i < n; ++i) {
        const int p = j * (n + 1) + i, q = p + n + 1;
        triangles.push_back({p, p + 1, q + 1});
        triangles.push_back({p, q + 1, q});
        lines.push_back({p, p + 1, -1});
        lines.push_back({p, q, -1});
      }
  }
};
std::vector<Vector> scattered(std::size_t n) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> anywhere(-0.1, 1.1), high(-0.3, 0.3);
  std::vector<Vector> all;
  for (std::size_t i = 0; i < n; ++i)
    all.push_back(Vector(float(anywhere(random)), float(anywhere(random)), float(high(random))));
  return all;
}

template <Shape A, Shape B>
void find_all(MinProximityIntersection const& method, CollisionSurface const& a, CollisionSurface const& b,
              std::vector<Contact>& to) {
  for (int i = 0; i < int(a.size()); ++i)
    for (int j = 0; j < int(b.size()); ++j)
      if (auto c = method.intersect(PrimitivePair<A, B>{a, b, i, j, 0.01})) to.push_back(*c);
}

// what the device finds of points with some surfaces, in the order of points, is what the host finds
template <class D, Shape Other>
void agrees(CollisionSurface const& points, std::vector<CollisionSurface*> const& standing) {
  const MinProximityIntersection method{.alarmDistance = 0.06, .contactDistance = 0.02};
  typename D::VecCoord x;
  for (Vector const& p : points.position) x.push_back(p.cast<typename D::Real>());
  gpu::ContactSearch<D> search;
  for (const std::size_t reserve : {std::size_t(10000), std::size_t(1)}) {
    search = {};
    std::size_t count = 0, last = 0;
    for (int round = 0; round < 2; ++round) {
      search.begin(points, reserve);
      for (CollisionSurface* s : standing) {
        s->enclose(method.reach() / 2, 0);
        search.add(*s, s->number < points.number, method.reach());
      }
      search.look(method, std::as_const(x));
      std::vector<std::vector<Contact>> expected(standing.size());
      for (std::size_t k = 0; k < standing.size(); ++k)
        if (standing[k]->number < points.number)
          find_all<Other, Shape::point>(method, *standing[k], points, expected[k]);
        else
          find_all<Shape::point, Other>(method, points, *standing[k], expected[k]);
      std::size_t all = 0;
      for (auto const& of : expected) all += of.size();
      count = 0;
      int wrong = 0, lastElement = -1;
      search.take(method, std::as_const(x));
      search.accept();
      bool once = true;
      int before = -1;
      for (gpu::FoundContact const& found : search.found()) {
        ++count;
        wrong += found.element < lastElement;
        lastElement = found.element;
        const auto k = std::size_t(found.surface);
        const bool first = standing[k]->number < points.number;
        bool known = false;
        for (Contact const& c : expected[k]) {
          ContactSide const &own = first ? c.b : c.a, &its = first ? c.a : c.b;
          if (own.element != found.element || its.element != found.other) continue;
          known = its.vertices == found.vertices && (c.normal - found.normal).norm() < 1e-9 &&
                  std::abs(c.distance - found.distance) < 1e-12 && c.thickness == found.thickness &&
                  c.limit == found.limit &&
                  (found.point - points.position[std::size_t(own.vertices[0])]).norm() == 0;
          for (std::size_t i = 0; i < 3; ++i)
            known = known && std::abs(its.weights[i] - found.weights[Eigen::Index(i)]) < 1e-9;
        }
        wrong += !known;
        once = once && found.element != before;
        before = found.element;
      }
      CHECK((search.again() == gpu::ContactSearch<D>::Again::sameDirections) == (round == 1 && once));
      CHECK(wrong == 0);
      CHECK(count == all);
      CHECK(count > 50);
      if (round == 1) CHECK(count == last);
      last = count;
    }
  }
}

CollisionSurface points_at(std::vector<Vector> const& x, Shape shape, int number) {
  CollisionSurface s = surface_of(shape, number, x, each_point(x.size()));
  s.settings.proximity = 0.005;
  s.solver = 0;
  return s;
}

}  // namespace

TEST_CASE("points on the device meet standing triangles where the host finds them") {
  const Hills hills(9);
  auto floor = surface_of(Shape::triangle, 0, hills.points, hills.triangles);
  agrees<CudaVec3d, Shape::triangle>(points_at(scattered(1500), Shape::point, 1), {&floor});
  agrees<CudaVec3f, Shape::triangle>(points_at(scattered(1500), Shape::point, 1), {&floor});
}
TEST_CASE("spheres on the device meet standing triangles on both of their sides") {
  const Hills hills(5);
  auto floor = surface_of(Shape::triangle, 2, hills.points, hills.triangles);
  floor.settings.bothSide = true;
  agrees<CudaVec3d, Shape::triangle>(points_at(scattered(700), Shape::sphere, 1), {&floor});
}
TEST_CASE("points on the device meet standing lines, spheres and points") {
  const Hills hills(6);
  auto lines = surface_of(Shape::line, 1, hills.points, hills.lines);
  agrees<CudaVec3d, Shape::line>(points_at(scattered(1500), Shape::point, 0), {&lines});
  auto spheres = surface_of(Shape::sphere, 0, hills.points, each_point(hills.points.size()));
  agrees<CudaVec3d, Shape::point>(points_at(scattered(1500), Shape::point, 1), {&spheres});
  auto points = surface_of(Shape::point, 0, hills.points, each_point(hills.points.size()));
  agrees<CudaVec3d, Shape::point>(points_at(scattered(1500), Shape::sphere, 1), {&points});
}
TEST_CASE("points on the device meet several standing surfaces, of few and of many triangles") {
  const Hills hills(8);
  auto one = surface_of(Shape::triangle, 0, hills.points, hills.triangles);
  auto plate = surface_of(Shape::triangle, 2, {{-5, -5, 0.2}, {5, -5, 0.2}, {0, 9, 0.2}}, {{0, 1, 2}});
  agrees<CudaVec3d, Shape::triangle>(points_at(scattered(900), Shape::point, 1), {&one, &plate});
}
TEST_CASE("points on the device see a standing surface where it has been put") {
  const Hills hills(4);
  auto floor = surface_of(Shape::triangle, 0, hills.points, hills.triangles);
  const auto points = points_at(scattered(800), Shape::point, 1);
  agrees<CudaVec3d, Shape::triangle>(points, {&floor});
  for (auto& p : floor.position) p += Vector(0.2, 0, 0.05);
  floor.enclosed.reset();
  agrees<CudaVec3d, Shape::triangle>(points, {&floor});
}
TEST_CASE("the device says the violations of contacts as the host does") {
  const Hills hills(5);
  auto floor = surface_of(Shape::triangle, 0, hills.points, hills.triangles);
  for (std::size_t i = 0; i < floor.velocity.size(); ++i)
    floor.velocity[i] = Vector(0.1, -0.2, 0.3 + 0.01 * double(i));
  const auto points = points_at(scattered(700), Shape::point, 1);
  const MinProximityIntersection method{.alarmDistance = 0.06, .contactDistance = 0.02};
  const double dt = 0.02;
  for (const bool ofVelocity : {false, true})
    for (const bool standsFirst : {true, false}) {
      floor.number = standsFirst ? 0 : 2;
      floor.enclose(method.reach() / 2, 0);
      CudaVec3d::VecCoord x, free;
      CudaVec3d::VecDeriv v;
      for (std::size_t i = 0; i < points.position.size(); ++i) {
        x.push_back(points.position[i]);
        v.push_back(Vector(0.3, 0.1 * double(i % 3), -1 - 0.01 * double(i % 50)));
        free.push_back(x[i] + 0.9 * dt * v[i]);
      }
      gpu::ContactSearch<CudaVec3d> search;
      search.begin(points, 1000);
      search.add(floor, standsFirst, method.reach());
      search.look(method, std::as_const(x));
      std::vector<double> expected;
      search.clearRows();
      search.take(method, std::as_const(x));
      int place = -1;
      for (gpu::FoundContact const& found : search.found()) {
        ++place;
        const double mu = place % 3 == 0 ? 0 : 0.4;
        search.addRow({place, int(expected.size()), 0, mu});
        Contact c;
        c.normal = found.normal;
        c.thickness = found.thickness;
        c.limit = found.limit;
        c.friction = mu;
        Vector standing(0, 0, 0), rate(0, 0, 0);
        for (std::size_t k = 0; k < 3 && found.vertices[k] >= 0; ++k) {
          standing += found.weights[Eigen::Index(k)] * floor.position[std::size_t(found.vertices[k])];
          rate += found.weights[Eigen::Index(k)] * floor.velocity[std::size_t(found.vertices[k])];
        }
        const auto i = std::size_t(found.element);
        const double sign = standsFirst ? 1 : -1;
        ContactMotion m;
        m.start = sign * (x[i] - (standing - dt * rate));
        m.free = sign * (free[i] - standing);
        m.rate = sign * (v[i] - rate);
        m.dt = dt;
        double d[3];
        FrictionContactConstraint::violations(c, m, ofVelocity, d);
        expected.insert(expected.end(), d, d + (mu > 0 ? 3 : 1));
      }
      REQUIRE(expected.size() > 100);
      gpu::DeviceVector<double> found(expected.size());
      search.putViolations(std::tuple<FrictionContactConstraint>(),
                           std::as_const(x),
                           std::as_const(free),
                           std::as_const(v),
                           dt,
                           ofVelocity,
                           found.overwrite());
      double off = 0;
      for (std::size_t i = 0; i < expected.size(); ++i)
        off = std::max(off, std::abs(std::as_const(found)[i] - expected[i]));
      CHECK(off < 1e-12);
    }
}

}  // namespace test_device_contact_search
