// SPDX-License-Identifier: BSL-1.0
#include "catch.hpp"
#include "collision/simplex_pairs.hpp"

#include <sinew/collision/overlap.hpp>

#include <cstdint>
#include <vector>

namespace test_overlap {

using namespace sinew;
using namespace simplex_pairs;

namespace {

using V = Vec<double, 3>;

struct Whole {
  std::int64_t x, y, z;
};
std::int64_t det(Whole const& a, Whole const& b, Whole const& c) {
  return a.x * (b.y * c.z - b.z * c.y) - a.y * (b.x * c.z - b.z * c.x) + a.z * (b.x * c.y - b.y * c.x);
}
Whole cross(Whole const& a, Whole const& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
std::int64_t dot(Whole const& a, Whole const& b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
bool zero(Whole const& a) { return a.x == 0 && a.y == 0 && a.z == 0; }
bool opposite(Whole const& a, Whole const& b) { return zero(cross(a, b)) && dot(a, b) <= 0; }
/// 0 in the triangle of a, b, c.
bool around(Whole const& a, Whole const& b, Whole const& c) {
  if (det(a, b, c) != 0) return false;
  const Whole n1 = cross(a, b), n2 = cross(b, c), n3 = cross(c, a);
  return dot(n1, n2) > 0 && dot(n2, n3) > 0 && dot(n3, n1) > 0;
}
/// 0 in the tetrahedron: the four signed volumes with 0 in place of a corner have the sign of the whole.
bool around(Whole const& a, Whole const& b, Whole const& c, Whole const& d) {
  const std::int64_t v[4] = {det(b, c, d), -det(a, c, d), det(a, b, d), -det(a, b, c)};
  return (v[0] > 0 && v[1] > 0 && v[2] > 0 && v[3] > 0) || (v[0] < 0 && v[1] < 0 && v[2] < 0 && v[3] < 0);
}

/// Exactly: a and b meet where 0 is in the hull of all b_j - a_i, and then (Caratheodory 1907) inside one of
/// its points, segments, triangles or tetrahedra.
bool meet_exactly(std::vector<Whole> const& p) {
  const std::size_t n = p.size();
  for (std::size_t i = 0; i < n; ++i) {
    if (zero(p[i])) return true;
    for (std::size_t j = 0; j < i; ++j) {
      if (opposite(p[i], p[j])) return true;
      for (std::size_t k = 0; k < j; ++k) {
        if (around(p[i], p[j], p[k])) return true;
        for (std::size_t l = 0; l < k; ++l)
          if (around(p[i], p[j], p[k], p[l])) return true;
      }
    }
  }
  return false;
}

/// Random points of whole coordinates within `range`, often coplanar: how often the answers differ, and how
/// often a and b meet.
template <class Real, std::size_t NA, std::size_t NB>
void check_whole(int pairs, int range) {
  std::mt19937_64 engine(NA * 7 + NB + std::uint64_t(range));
  int wrong = 0, meeting = 0;
  Simplex<Real, NA> a;
  Simplex<Real, NB> b;
  for (int i = 0; i < pairs; ++i) {
    const bool flat = i % 3 == 0;
    auto fill = [&](auto& p) {
      for (auto& x : p) {
        for (int k = 0; k < 3; ++k) x[k] = Real(int(engine() % std::uint64_t(2 * range + 1)) - range);
        if (flat) x[2] = x[0] - x[1];
      }
    };
    fill(a);
    fill(b);
    std::vector<Whole> p;
    for (auto const& x : a)
      for (auto const& y : b)
        p.push_back({std::int64_t(y[0] - x[0]), std::int64_t(y[1] - x[1]), std::int64_t(y[2] - x[2])});
    const bool meet = meet_exactly(p);
    meeting += meet;
    wrong += overlap(a, b) != meet;
  }
  INFO(NA << " and " << NB << " points within " << range << ", " << meeting << " of " << pairs << " meet");
  CHECK(wrong == 0);
  CHECK(meeting > pairs / 2000);
}

}  // namespace

// Points of whole coordinates below R that do not meet are apart by more than 1 / (12 R^2) or so, volume 1
// over the area of the largest face: for R = 100 in doubles, and R = 8 in floats, far above
// contact_tolerance.
TEST_CASE("overlap is that of whole numbers", "[collision]") {
  const int pairs = manyPairs / 4;
  for (const int range : {2, 6, 100}) {
    if (range < 100) check_whole<double, 1, 2>(pairs, range);
    if (range < 100) check_whole<double, 1, 3>(pairs, range);
    check_whole<double, 2, 2>(range < 100 ? pairs : manyPairs, range);
    check_whole<double, 2, 3>(pairs, range);
    check_whole<double, 3, 2>(pairs / 10, range);
    check_whole<double, 3, 3>(pairs, range);
  }
  check_whole<float, 2, 2>(pairs, 8);
  check_whole<float, 2, 3>(pairs, 8);
  check_whole<float, 3, 3>(pairs, 8);
}

TEST_CASE("overlap of triangles that touch, also coplanar", "[collision]") {
  using Triangle = Simplex<double, 3>;
  const Triangle a{V(0, 0, 0), V(4, 0, 0), V(0, 4, 0)};
  auto moved = [&](V const& d) { return Triangle{a[0] + d, a[1] + d, a[2] + d}; };
  CHECK(overlap(a, a));
  CHECK(overlap(a, moved(V(1, 1, 0))));
  CHECK(overlap(a, moved(V(4, 0, 0))));
  CHECK(overlap(a, moved(V(2, 2, 0))));
  CHECK_FALSE(overlap(a, moved(V(2, 2.0001, 0))));
  CHECK_FALSE(overlap(a, moved(V(0, 0, 1e-13))));
  CHECK(overlap(a, Triangle{V(1, 1, 0), V(1.1, 1, 0), V(1, 1.1, 0)}));  // one inside the other
  CHECK(overlap(a, Triangle{V(1, 1, 0), V(1, 1, 0), V(1, 1, 0)}));
  CHECK(overlap(a, Simplex<double, 2>{V(-1, 2, 0), V(7, -2, 0)}));
}

TEST_CASE("overlap with balls", "[collision]") {
  const Simplex<double, 3> a{V(0, 0, 0), V(4, 0, 0), V(0, 4, 0)};
  const Simplex<double, 2> s{V(0, 0, 0), V(4, 0, 0)};
  const Simplex<double, 1> p{V(0, 0, 0)};
  CHECK(overlap(Sphere<double>{V(1, 1, 2), 2}, a));
  CHECK(overlap(a, Sphere<double>{V(1, 1, -2), 2.001}));
  CHECK_FALSE(overlap(a, Sphere<double>{V(1, 1, -2), 1.999}));
  CHECK(overlap(Sphere<double>{V(7, 4, 0), 5}, s));
  CHECK_FALSE(overlap(Sphere<double>{V(7, 4, 0), 4.999}, s));
  CHECK(overlap(s, Sphere<double>{V(2, 1e-3, 0), 1}));
  CHECK(overlap(p, Sphere<double>{V(2, 0, 0), 2}));
  CHECK_FALSE(overlap(p, Sphere<double>{V(2, 0, 1e-5), 2}));
  CHECK(overlap(Sphere<double>{V(0, 0, 0), 1}, Sphere<double>{V(0, 3, 0), 2}));
  CHECK_FALSE(overlap(Sphere<double>{V(0, 0, 0), 1}, Sphere<double>{V(0, 3.001, 0), 2}));
  CHECK(overlap(Sphere<double>{V(0, 0, 0), 0}, Sphere<double>{V(0, 0, 0), 0}));

  // against the distance by all faces
  PairMaker<double, 1, 3> maker{std::mt19937_64(3)};
  int wrong = 0, hits = 0;
  Simplex<double, 1> c;
  Simplex<double, 3> t;
  const int pairs = manyPairs / 10;
  for (int i = 0; i < pairs; ++i) {
    maker.make(c, t);
    const double radius = maker.uniform(0, 2);
    const double apart =
        double(std::sqrt(brute_squared_distance(to<long double>(c, c[0]), to<long double>(t, c[0])))) -
        radius;
    const bool meet = overlap(Sphere<double>{c[0], radius}, t);
    hits += meet;
    wrong += std::abs(apart) > contact_tolerance(c, t) * 1.5 + 1e-15 && meet != (apart < 0);
  }
  CHECK(wrong == 0);
  CHECK(hits > pairs / 10);
  CHECK(hits < pairs - pairs / 10);
}

}  // namespace test_overlap
