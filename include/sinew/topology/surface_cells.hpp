// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/core/compiled.hpp>
#include <sinew/core/fields.hpp>
#include <sinew/core/mesh.hpp>

#include <Eigen/Core>
#include <array>
#include <optional>
#include <string>
#include <vector>

namespace sinew::detail {

/// The surface in a file, or else that of the triangles and quads, as triangles over points that are used.
/// What may be a `cloud` of points is all of them where there is no triangle. Throws Error where it cannot be
/// read, has an index out of range, or there is nothing.
Mesh read_surface(std::string const& at, DataFile const& file, std::vector<Eigen::Vector3d> const& position,
                  std::vector<Triangle> const& triangles, std::vector<Quad> const& quads, bool cloud = false);

/// The box around a surface and a hundredth more, where not given.
std::array<Eigen::Vector3d, 2> box_of_surface(Mesh const& surface, std::optional<Eigen::Vector3d> const& low,
                                              std::optional<Eigen::Vector3d> const& high);

/// Whether a triangle and a box share a point.
bool triangle_meets_box(Eigen::Vector3d const (&triangle)[3], Eigen::Vector3d const& center,
                        Eigen::Vector3d const& half);

/// The cells of a regular grid, and on which side of a surface they are. Where a closed one winds around a
/// cell, that is inside; of an open one, or a cloud of points, cells that it cuts off from the border of the
/// grid.
struct SurfaceCells {
  enum Kind : char { unknown, touched, inside, outside };

  std::array<int, 3> points{2, 2, 2};
  Eigen::Vector3i cells{1, 1, 1};
  std::array<std::vector<double>, 3> coordinates{};
  std::vector<Kind> kinds{};       // x fastest
  Eigen::Vector3d slack{0, 0, 0};  // what is this near touches, so that rounding opens no gap between cells

  /// Throws Error of a grid above 2^24 points or an empty box, and where the surface has to be closed and is
  /// not.
  SurfaceCells(std::string const& at, Mesh const& surface, std::array<int, 3> const& n,
               Eigen::Vector3d const& low, Eigen::Vector3d const& high, bool mayBeOpen = false);

  std::size_t number(Eigen::Vector3i const& c) const {
    return std::size_t(c[0]) +
           std::size_t(cells[0]) * (std::size_t(c[1]) + std::size_t(cells[1]) * std::size_t(c[2]));
  }
  Kind& kind(Eigen::Vector3i const& c) { return kinds[number(c)]; }
  Eigen::Vector3d corner(Eigen::Vector3i const& c) const {
    return {coordinates[0][std::size_t(c[0])],
            coordinates[1][std::size_t(c[1])],
            coordinates[2][std::size_t(c[2])]};
  }
  /// f(cell) for each cell that touches the triangle, found by halving.
  template <class F>
  void forCellsNear(Eigen::Vector3d const (&triangle)[3], F&& f) const {
    forCellsNear(triangle, Eigen::Vector3i::Zero(), cells, f);
  }

 private:
  // of those from a to b - 1
  template <class F>
  void forCellsNear(Eigen::Vector3d const (&triangle)[3], Eigen::Vector3i const& a, Eigen::Vector3i const& b,
                    F& f) const {
    const Eigen::Vector3d low = corner(a), high = corner(b);
    if (!triangle_meets_box(triangle, (low + high) / 2, (high - low) / 2 + slack)) return;
    int longest = 0;
    (b - a).maxCoeff(&longest);
    if (b[longest] - a[longest] == 1) return f(a);
    Eigen::Vector3i middle = b;
    middle[longest] = (a[longest] + b[longest]) / 2;
    forCellsNear(triangle, a, middle, f);
    middle = a;
    middle[longest] = (a[longest] + b[longest]) / 2;
    forCellsNear(triangle, middle, b, f);
  }
  void decideRest(Mesh const& surface, std::string const& at, bool mayBeOpen);
};

}  // namespace sinew::detail

#if SINEW_DEFINES
#include <sinew/io/text_mesh_file.hpp>
#include <sinew/topology/adjacency.hpp>
#include <sinew/topology/regular_grid.hpp>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>

namespace sinew::detail {

/// No plane between a triangle and a box is normal to an axis of the box, to the triangle, or to an axis and
/// a side (Akenine-Moeller 2001).
SINEW_ONCE bool triangle_meets_box(Eigen::Vector3d const (&triangle)[3], Eigen::Vector3d const& center,
                                   Eigen::Vector3d const& half) {
  const Eigen::Vector3d v[3] = {triangle[0] - center, triangle[1] - center, triangle[2] - center};
  auto apart = [&](Eigen::Vector3d const& axis) {
    const double a = axis.dot(v[0]), b = axis.dot(v[1]), c = axis.dot(v[2]),
                 reach =
                     std::abs(axis[0]) * half[0] + std::abs(axis[1]) * half[1] + std::abs(axis[2]) * half[2];
    return std::min({a, b, c}) > reach || std::max({a, b, c}) < -reach;
  };
  for (int c = 0; c < 3; ++c)
    if (apart(Eigen::Vector3d::Unit(c))) return false;
  for (int k = 0; k < 3; ++k)
    for (int c = 0; c < 3; ++c)
      if (apart(Eigen::Vector3d::Unit(c).cross(v[(k + 1) % 3] - v[k]))) return false;
  return !apart((v[1] - v[0]).cross(v[2] - v[0]));
}

/// How many times a surface winds around p: the sum of the solid angles of its triangles over 4 pi (van
/// Oosterom & Strackee 1983). 1 inside a closed surface whose triangles look outwards, 0 outside.
inline double winding_number(std::vector<Eigen::Vector3d> const& x, std::vector<Triangle> const& triangles,
                             Eigen::Vector3d const& p) {
  double half = 0;
  for (auto const& t : triangles) {
    const Eigen::Vector3d a = x[std::size_t(t[0])] - p, b = x[std::size_t(t[1])] - p,
                          c = x[std::size_t(t[2])] - p;
    const double la = a.norm(), lb = b.norm(), lc = c.norm();
    half += std::atan2(a.dot(b.cross(c)), la * lb * lc + a.dot(b) * lc + b.dot(c) * la + c.dot(a) * lb);
  }
  return half / (2 * std::numbers::pi);
}

SINEW_ONCE Mesh read_surface(std::string const& at, DataFile const& file,
                             std::vector<Eigen::Vector3d> const& position,
                             std::vector<Triangle> const& triangles, std::vector<Quad> const& quads,
                             bool cloud) {
  Mesh surface;
  if (!file.path.empty()) {
    try {
      surface = io::read_text_mesh(file.path);
    } catch (Error const& error) {
      throw Error(at, error.what());
    }
  } else {
    surface.positions = position;
    surface.triangles = triangles;
    surface.quads = quads;
    check_mesh(at, surface);
  }
  for (auto const& q : surface.quads) {
    surface.triangles.push_back({q[0], q[1], q[2]});
    surface.triangles.push_back({q[0], q[2], q[3]});
  }
  if (surface.triangles.empty() && cloud && !surface.positions.empty()) return surface;
  if (surface.triangles.empty())
    throw Error(
        at,
        cloud ? "there is no point; give fileTopology, or position, with triangles or quads for a surface"
              : "there is no surface; give fileTopology, or position with triangles or quads");
  remove_unused_points(surface);
  return surface;
}

SINEW_ONCE std::array<Eigen::Vector3d, 2> box_of_surface(Mesh const& surface,
                                                         std::optional<Eigen::Vector3d> const& low,
                                                         std::optional<Eigen::Vector3d> const& high) {
  Eigen::Vector3d lo = surface.positions[0], hi = lo;
  for (auto const& p : surface.positions) lo = min_of(lo, p), hi = max_of(hi, p);
  const Eigen::Vector3d margin = (hi - lo) / 100;
  return {low.value_or(lo - margin), high.value_or(hi + margin)};
}

SINEW_ONCE SurfaceCells::SurfaceCells(std::string const& at, Mesh const& surface, std::array<int, 3> const& n,
                                      Eigen::Vector3d const& low, Eigen::Vector3d const& high, bool mayBeOpen)
    : points(n) {
  check_grid(at, points, low, high, 2, 24);
  for (int c = 0; c < 3; ++c) {
    cells[c] = points[std::size_t(c)] - 1;
    coordinates[std::size_t(c)] = grid_coordinates(points[std::size_t(c)], low[c], high[c]);
    slack[c] = 1e-9 * (high[c] - low[c]) / cells[c] + 1e-15 * std::max(std::abs(low[c]), std::abs(high[c]));
  }
  kinds.assign(std::size_t(cells.prod()), unknown);
  auto touch = [&](Eigen::Vector3d const& a, Eigen::Vector3d const& b, Eigen::Vector3d const& c) {
    const Eigen::Vector3d corners[3] = {a, b, c};
    forCellsNear(corners, [&](Eigen::Vector3i const& cell) { kind(cell) = touched; });
  };
  auto const& x = surface.positions;
  for (auto const& t : surface.triangles)
    touch(x[std::size_t(t[0])], x[std::size_t(t[1])], x[std::size_t(t[2])]);
  const bool cloud = surface.triangles.empty();
  for (std::size_t i = 0; cloud && i < x.size(); ++i) touch(x[i], x[i], x[i]);
  decideRest(surface, at, mayBeOpen || cloud);
}

SINEW_ONCE void SurfaceCells::decideRest(Mesh const& surface, std::string const& at, bool mayBeOpen) {
  // cells that no part of the surface separates are on one side of it: each connected lot of them is decided
  // by how often the surface winds around its first cell, its last and one between, which lie away from the
  // surface
  std::vector<Eigen::Vector3i> region;
  for (int k = 0; k < cells[2]; ++k)
    for (int j = 0; j < cells[1]; ++j)
      for (int i = 0; i < cells[0]; ++i) {
        if (kind({i, j, k}) != unknown) continue;
        region.assign(1, {i, j, k});
        kind(region[0]) = outside;
        for (std::size_t c = 0; c < region.size(); ++c)
          for (int side = 0; side < 6; ++side) {
            Eigen::Vector3i next = region[c];
            int& step = next[side / 2];
            step += side % 2 == 0 ? -1 : 1;
            if (step < 0 || step >= cells[side / 2] || kind(next) != unknown) continue;
            kind(next) = outside;
            region.push_back(next);
          }
        if (mayBeOpen) {
          const bool atBorder =
              std::any_of(region.begin(), region.end(), [this](Eigen::Vector3i const& cell) {
                return (cell.array() == 0).any() || (cell.array() == cells.array() - 1).any();
              });
          for (auto const& cell : region) kind(cell) = atBorder ? outside : inside;
          continue;
        }
        int windings = 0;
        for (const std::size_t c : {std::size_t(0), region.size() / 2, region.size() - 1}) {
          const Eigen::Vector3d p = (corner(region[c]) + corner(region[c] + Eigen::Vector3i::Ones())) / 2;
          const double winding = winding_number(surface.positions, surface.triangles, p);
          if (c == 0) windings = int(std::lround(winding));
          if (!(std::abs(winding - windings) < 0.1))
            throw Error(
                at,
                text("the surface is not closed, or its triangles do not all look outwards: it winds ",
                     winding,
                     " times around (",
                     p[0],
                     ", ",
                     p[1],
                     ", ",
                     p[2],
                     "); close its holes and orient its triangles alike"));
        }
        if (windings != 0)
          for (auto const& cell : region) kind(cell) = inside;
      }
}

}  // namespace sinew::detail
#endif
