// SPDX-License-Identifier: BSL-1.0
#pragma once

#include "catch.hpp"

#include <sinew/topology/adjacency.hpp>
#include <sinew/topology/blade_crossings.hpp>
#include <sinew/topology/cut_pattern.hpp>
#include <sinew/topology/cut_plan.hpp>
#include <sinew/topology/hexahedra.hpp>
#include <sinew/topology/quality.hpp>

#include <numeric>
#include <random>

// Blocks that blades cut, without a scene around them.
namespace cutting {

using namespace sinew;
using Point = Eigen::Vector3d;

struct Body {
  std::vector<Point> points{};
  std::vector<Tetrahedron> tetrahedra{};
  std::vector<Triangle> skin{};
};

/// nx * ny * nz cubes of 1 m, six tetrahedra each, whose points are moved by up to `jitter`.
inline Body block(int nx, int ny, int nz, double jitter = 0) {
  Body b;
  std::mt19937 random(5);
  std::uniform_real_distribution<double> move(-jitter, jitter);
  for (int k = 0; k <= nz; ++k)
    for (int j = 0; j <= ny; ++j)
      for (int i = 0; i <= nx; ++i)
        b.points.emplace_back(i + move(random), j + move(random), k + move(random));
  auto at = [&](int i, int j, int k) { return Index(i + (nx + 1) * (j + (ny + 1) * k)); };
  std::vector<Hexahedron> cubes;
  for (int k = 0; k < nz; ++k)
    for (int j = 0; j < ny; ++j)
      for (int i = 0; i < nx; ++i)
        cubes.push_back({at(i, j, k),
                         at(i + 1, j, k),
                         at(i + 1, j + 1, k),
                         at(i, j + 1, k),
                         at(i, j, k + 1),
                         at(i + 1, j, k + 1),
                         at(i + 1, j + 1, k + 1),
                         at(i, j + 1, k + 1)});
  b.tetrahedra = hexahedra_to_tetrahedra(cubes);
  b.skin = boundary_triangles(b.tetrahedra);
  return b;
}

/// How many pieces hang together by points.
template <std::size_t N>
int pieces(std::size_t points, std::vector<std::array<Index, N>> const& elements) {
  std::vector<Index> up(points);
  std::iota(up.begin(), up.end(), 0);
  auto top = [&](Index i) {
    while (up[std::size_t(i)] != i) i = up[std::size_t(i)] = up[std::size_t(up[std::size_t(i)])];
    return i;
  };
  for (auto const& e : elements)
    for (const Index i : e) up[std::size_t(top(i))] = top(e[0]);
  std::vector<bool> is(points, false);
  for (auto const& e : elements) is[std::size_t(top(e[0]))] = true;
  return int(std::count(is.begin(), is.end(), true));
}
inline int pieces(Body const& b) { return pieces(b.points.size(), b.tetrahedra); }

inline double volume(Body const& b) {
  double sum = 0;
  for (auto const& e : b.tetrahedra) {
    auto at = [&](std::size_t k) { return b.points[std::size_t(e[k])]; };
    sum += tetrahedron_volume(at(0), at(1), at(2), at(3));
  }
  return sum;
}
inline double worst(Body const& b) {
  double q = 1;
  for (auto const& e : b.tetrahedra) {
    std::array<Point, 4> x;
    for (std::size_t k = 0; k < 4; ++k) x[k] = b.points[std::size_t(e[k])];
    q = std::min(q, simplex_quality(x));
  }
  return q;
}
/// The skin is the border, oriented outwards.
inline bool has_its_skin(Body const& b) {
  auto turned = [](std::vector<Triangle> list) {
    for (auto& f : list) std::rotate(f.begin(), std::min_element(f.begin(), f.end()), f.end());
    std::sort(list.begin(), list.end());
    return list;
  };
  return turned(b.skin) == turned(boundary_triangles(b.tetrahedra));
}

/// Cuts, and checks what holds after every cut.
inline CutPlan cut(Body& b, BladeStroke const& stroke, CutFront front = {}, CutRules const& rules = {}) {
  const double before = volume(b), quality = std::min(worst(b), rules.quality);
  add_crossings<4>(b.tetrahedra, b.points, {}, stroke, front);
  CutPlan plan =
      plan_cut(b.points, {{.triangles = b.skin, .tetrahedra = b.tetrahedra}}, 0, {true}, front, rules);
  if (plan.elements > 0) {
    plan.points.filter(b.points);
    b.tetrahedra = plan.lists[0].tetrahedra;
    b.skin = plan.lists[0].triangles;
  }
  CHECK(volume(b) == Approx(before).epsilon(1e-12));
  CHECK(worst(b) >= quality * (1 - 1e-9));
  CHECK(has_its_skin(b));
  return plan;
}
inline CutPlan cut(Body& b, Blade const& blade, CutRules const& rules = {}) {
  return cut(b, BladeStroke{SweptBlade("blade", blade)}, {}, rules);
}

/// A rectangle at x = a + b y + c z, from y0 to y1 and z0 to z1.
struct Plane {
  double a, b = 0, c = 0;
  Point at(double y, double z) const { return {a + b * y + c * z, y, z}; }
  Blade blade(double y0, double y1, double z0, double z1) const {
    return {{at(y0, z0), at(y0, z1)}, {at(y1, z0), at(y1, z1)}};
  }
};

}  // namespace cutting
