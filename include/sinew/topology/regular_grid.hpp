// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/core/compiled.hpp>
#include <sinew/core/component.hpp>
#include <sinew/core/memory_limit.hpp>

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <string_view>
#include <vector>

namespace sinew {

/// The fields of a grid of which all elements are made, behind its own.
template <class T, class... Own>
constexpr auto grid_fields(Own... own) {
  return field_list(own...,
                    field("computeHexaList", &T::computeHexaList, "", "whether hexahedra are made"),
                    field("computeQuadList", &T::computeQuadList, "", "whether quads are made"),
                    field("computeTriangleList", &T::computeTriangleList, "", "whether triangles are made"),
                    field("computeEdgeList", &T::computeEdgeList, "", "whether edges are made"));
}

namespace detail {

/// Throws the Error of a box without volume.
[[noreturn]] void refuse_box(std::string_view where, Eigen::Vector3d const& lo, Eigen::Vector3d const& hi);

/// Throws Error unless a grid has `minimum` points or more in each direction, 2^maxLog2 altogether at most,
/// and a box that is not empty in directions of several points. Grids that may be sheets and strings, of
/// `minimum` 1, may also run backwards, as in SOFA. One of a scene, of 2^24 at most, is also held to
/// memory_limit.
void check_grid(std::string_view where, std::array<int, 3> const& n, Eigen::Vector3d const& lo,
                Eigen::Vector3d const& hi, int minimum, int maxLog2);

/// n coordinates evenly from lo to hi, which are met exactly; one is at lo.
std::vector<double> grid_coordinates(int n, double lo, double hi);

/// Points from lo to hi. Point (i, j, k) has number i + nx (j + ny k). Throws Error as check_grid().
Mesh grid_points(std::string_view where, std::array<int, 3> const& n, Eigen::Vector3d const& lo,
                 Eigen::Vector3d const& hi, int minimum = 2, int maxLog2 = 28);

/// Points each way of a grid of cubic cells from lo that covers the box; its far corner becomes `hi`. A whole
/// number of cells, to rounding, stays so.
std::array<int, 3> cubic_cells(double width, Eigen::Vector3d const& lo, Eigen::Vector3d& hi);

/// Calls body(corners, i + j + k) for each cell; corners in the order of VTK's hexahedron.
template <class Body>
void for_grid_cells(int nx, int ny, int nz, Body&& body) {
  for (int k = 0; k + 1 < nz; ++k)
    for (int j = 0; j + 1 < ny; ++j)
      for (int i = 0; i + 1 < nx; ++i) {
        const Index p = i + nx * (j + ny * k), up = nx * ny;
        body(Hexahedron{p, p + 1, p + 1 + nx, p + nx, p + up, p + 1 + up, p + 1 + nx + up, p + nx + up},
             i + j + k);
      }
}

/// Calls body(point, step along a, step along b) for each square of a grid across the axes a < b: the xy
/// planes first, then xz, then yz; x runs fastest.
template <class Body>
void for_grid_squares(std::array<int, 3> const& n, Body&& body) {
  const std::array<Index, 3> step{1, n[0], n[0] * n[1]};
  for (const auto [a, b] : {std::array<std::size_t, 2>{0, 1}, {0, 2}, {1, 2}}) {
    std::array<int, 3> cells = n;
    --cells[a], --cells[b];
    for (int k = 0; k < cells[2]; ++k)
      for (int j = 0; j < cells[1]; ++j)
        for (int i = 0; i < cells[0]; ++i) body(i + j * step[1] + k * step[2], step[a], step[b]);
  }
}

/// Calls body(point, next point) for each line between neighbours: those along x first, then y, then z.
template <class Body>
void for_grid_lines(std::array<int, 3> const& n, Body&& body) {
  const std::array<Index, 3> step{1, n[0], n[0] * n[1]};
  for (std::size_t a = 0; a < 3; ++a) {
    std::array<int, 3> lines = n;
    --lines[a];
    for (int k = 0; k < lines[2]; ++k)
      for (int j = 0; j < lines[1]; ++j)
        for (int i = 0; i < lines[0]; ++i) {
          const Index p = i + j * step[1] + k * step[2];
          body(p, p + step[a]);
        }
  }
}

/// Calls body(point, other point) for each side of the two triangles of each square, in the order in which
/// these come with the squares of for_grid_squares().
template <class Body>
void for_grid_triangle_sides(std::array<int, 3> const& n, Body&& body) {
  const std::array<Index, 3> step{1, n[0], n[0] * n[1]};
  std::array<bool, 3> listed{};  // lines along x, y, z, by planes that came first
  for (const auto [a, b] : {std::array<std::size_t, 2>{0, 1}, {0, 2}, {1, 2}}) {
    std::array<int, 3> cells = n, at{};
    --cells[a], --cells[b];
    if (cells[a] == 0 || cells[b] == 0) continue;
    for (at[2] = 0; at[2] < cells[2]; ++at[2])
      for (at[1] = 0; at[1] < cells[1]; ++at[1])
        for (at[0] = 0; at[0] < cells[0]; ++at[0]) {
          const Index p = at[0] + at[1] * step[1] + at[2] * step[2], q = p + step[a] + step[b];
          if (!listed[b]) body(p + step[a], q);
          body(p, q);
          if (!listed[a] && at[b] == 0) body(p, p + step[a]);
          if (!listed[a]) body(p + step[b], q);
          if (!listed[b] && at[a] == 0) body(p, p + step[b]);
        }
    listed[a] = listed[b] = true;
  }
}

/// The elements between the `points` of a topology, those that it says it computes. Where it has triangles,
/// edges are the sides of these, as in SOFA, else the lines between neighbours.
template <class Topology>
void make_grid_elements(Topology& t) {
  t.hexahedra.clear(), t.quads.clear(), t.triangles.clear(), t.edges.clear();
  if (t.computeHexaList)
    for_grid_cells(
        t.points[0], t.points[1], t.points[2], [&](Hexahedron const& c, int) { t.hexahedra.push_back(c); });
  if (t.computeQuadList || t.computeTriangleList)
    for_grid_squares(t.points, [&](Index p, Index a, Index b) {
      if (t.computeQuadList) t.quads.push_back({p, p + a, p + a + b, p + b});
      if (t.computeTriangleList) {
        t.triangles.push_back({p, p + a, p + a + b});
        t.triangles.push_back({p, p + a + b, p + b});
      }
    });
  auto addEdge = [&](Index p, Index q) { t.edges.push_back({p, q}); };
  if (t.computeEdgeList && !t.triangles.empty())
    for_grid_triangle_sides(t.points, addEdge);
  else if (t.computeEdgeList)
    for_grid_lines(t.points, addEdge);
}

/// What components see of a topology made by make_grid_elements.
template <class Topology>
TopologyView grid_view(Topology const& t) {
  return {.positions = t.position,
          .edges = t.edges,
          .triangles = t.triangles,
          .quads = t.quads,
          .hexahedra = t.hexahedra,
          .grid = t.points};
}

}  // namespace detail

/// Hexahedra of a box, with nx x ny x nz points, the corners lo and hi included. x runs fastest.
/// Throws Error when a direction has fewer than 2 points, all together more than 2^28, or the box is empty.
Mesh regular_grid(int nx, int ny, int nz, Eigen::Vector3d const& lo, Eigen::Vector3d const& hi);

/// The same box as positively oriented tetrahedra that match across cells: 6 a cell, all around the diagonal
/// from its lowest to its highest corner (Kuhn 1960), or 5 a cell, a regular one in the middle, mirrored from
/// cell to cell. Throws Error as regular_grid(), and on another number a cell.
Mesh regular_grid_tetrahedra(int nx, int ny, int nz, Eigen::Vector3d const& lo, Eigen::Vector3d const& hi,
                             int perCell = 6);

/// Solid cylinder around the x, y or z axis (axis 0, 1, 2), from `lo` to `hi` on that axis, as positively
/// oriented tetrahedra. Its cross section has `rings` concentric hexagons of triangles, stretched to circles;
/// `layers` of them are stacked. The end planes are exactly at lo and hi, the lateral points on the radius
/// (to rounding), so a lateral face is a chord: the volume is that of the inscribed prism, 3 n r^2 sin(pi /
/// (3 n)) (hi - lo) for n rings. (layers + 1) (3 n (n + 1) + 1) points, 18 n^2 layers tetrahedra; points of
/// ring 0 first, layer by layer. Throws Error when the radius or length is not positive, rings or layers < 1,
/// axis not 0 to 2, above 2^28 points.
Mesh cylinder_tetrahedra(int axis, double lo, double hi, double radius, int rings, int layers);

}  // namespace sinew

#if SINEW_DEFINES
#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

namespace sinew::detail {

SINEW_ONCE void check_grid(std::string_view where, std::array<int, 3> const& n, Eigen::Vector3d const& lo,
                           Eigen::Vector3d const& hi, int minimum, int maxLog2) {
  const std::string grid = text("a grid of ", n[0], " x ", n[1], " x ", n[2], " points");
  if (std::min({n[0], n[1], n[2]}) < minimum)
    throw Error(where, text(grid, " has no cells; give at least ", minimum, " each way"));
  const double maximum = std::ldexp(1.0, maxLog2);
  if (double(n[0]) * n[1] * n[2] > maximum)
    throw Error(where,
                text(grid, " exceeds the limit of ", maximum, " points (2^", maxLog2, "); make it coarser"));
  if (maxLog2 <= 24) check_memory(where, grid, double(n[0]) * n[1] * n[2]);
  bool hasVolume = all_finite(lo) && all_finite(hi);
  for (int c = 0; c < 3; ++c)
    hasVolume = hasVolume && (n[std::size_t(c)] == 1 || (minimum == 1 ? lo[c] != hi[c] : lo[c] < hi[c]));
  if (!hasVolume) refuse_box(where, lo, hi);
}

SINEW_ONCE void refuse_box(std::string_view where, Eigen::Vector3d const& lo, Eigen::Vector3d const& hi) {
  throw Error(where,
              text("the box from (",
                   lo[0],
                   ", ",
                   lo[1],
                   ", ",
                   lo[2],
                   ") to (",
                   hi[0],
                   ", ",
                   hi[1],
                   ", ",
                   hi[2],
                   ") is empty; its second corner must exceed the first in x, y and z"));
}

SINEW_ONCE std::vector<double> grid_coordinates(int n, double lo, double hi) {
  // as SOFA computes them, so that points lie in the boxes and on the planes where they lie there
  std::vector<double> coordinates{lo};
  const double step = (hi - lo) / std::max(n - 1, 1);
  for (int i = 1; i < n; ++i) coordinates.push_back(i + 1 < n ? lo + i * step : hi);
  return coordinates;
}

SINEW_ONCE Mesh grid_points(std::string_view where, std::array<int, 3> const& n, Eigen::Vector3d const& lo,
                            Eigen::Vector3d const& hi, int minimum, int maxLog2) {
  check_grid(where, n, lo, hi, minimum, maxLog2);
  Mesh mesh;
  mesh.positions.reserve(std::size_t(n[0]) * std::size_t(n[1]) * std::size_t(n[2]));
  const auto xs = grid_coordinates(n[0], lo[0], hi[0]), ys = grid_coordinates(n[1], lo[1], hi[1]),
             zs = grid_coordinates(n[2], lo[2], hi[2]);
  for (const double z : zs)
    for (const double y : ys)
      for (const double x : xs) mesh.positions.push_back({x, y, z});
  return mesh;
}

SINEW_ONCE std::array<int, 3> cubic_cells(double width, Eigen::Vector3d const& lo, Eigen::Vector3d& hi) {
  std::array<int, 3> points{};
  for (int c = 0; c < 3; ++c) {
    const double cells = std::ceil((hi[c] - lo[c]) / width - 1e-9);
    points[std::size_t(c)] = int(std::clamp(cells, 0.0, 1e9)) + 1;
    if (cells >= 0) hi[c] = lo[c] + cells * width;
  }
  return points;
}

}  // namespace sinew::detail

namespace sinew {

SINEW_ONCE Mesh regular_grid(int nx, int ny, int nz, Eigen::Vector3d const& lo, Eigen::Vector3d const& hi) {
  Mesh mesh = detail::grid_points("regular_grid", {nx, ny, nz}, lo, hi);
  detail::for_grid_cells(nx, ny, nz, [&](Hexahedron const& c, int) { mesh.hexahedra.push_back(c); });
  return mesh;
}

SINEW_ONCE Mesh regular_grid_tetrahedra(int nx, int ny, int nz, Eigen::Vector3d const& lo,
                                        Eigen::Vector3d const& hi, int perCell) {
  constexpr std::string_view where = "regular_grid_tetrahedra";
  if (perCell != 5 && perCell != 6)
    throw Error(where, text("a cell cannot be split into ", perCell, " tetrahedra; choose 5 or 6"));
  Mesh mesh = detail::grid_points(where, {nx, ny, nz}, lo, hi);
  constexpr int six[6][4] = {
      {0, 1, 2, 6}, {0, 2, 3, 6}, {0, 3, 7, 6}, {0, 7, 4, 6}, {0, 4, 5, 6}, {0, 5, 1, 6}};
  constexpr int five[2][5][4] = {{{0, 1, 2, 5}, {0, 2, 3, 7}, {0, 5, 7, 4}, {2, 7, 5, 6}, {0, 2, 7, 5}},
                                 {{1, 2, 3, 6}, {0, 1, 3, 4}, {1, 6, 4, 5}, {3, 4, 6, 7}, {1, 3, 4, 6}}};
  detail::for_grid_cells(nx, ny, nz, [&](Hexahedron const& c, int parity) {
    auto add = [&](int const(&t)[4]) {
      mesh.tetrahedra.push_back(
          {c[std::size_t(t[0])], c[std::size_t(t[1])], c[std::size_t(t[2])], c[std::size_t(t[3])]});
    };
    if (perCell == 6) {
      for (auto const& t : six) add(t);
    } else {
      for (auto const& t : five[parity % 2]) add(t);
    }
  });
  return mesh;
}

SINEW_ONCE Mesh cylinder_tetrahedra(int axis, double lo, double hi, double radius, int rings, int layers) {
  constexpr std::string_view where = "cylinder_tetrahedra";
  if (axis < 0 || axis > 2)
    throw Error(where, text("axis ", axis, " does not exist; choose 0 (x), 1 (y) or 2 (z)"));
  if (!(radius > 0) || !std::isfinite(radius))
    throw Error(where, text("the radius is ", radius, "; it must be a positive length"));
  if (!(lo < hi) || !std::isfinite(lo) || !std::isfinite(hi))
    throw Error(where, text("the cylinder runs from ", lo, " to ", hi, "; the end must exceed the start"));
  if (rings < 1 || layers < 1)
    throw Error(where,
                text(rings, " rings and ", layers, " layers were asked for; at least 1 of each is needed"));
  if ((3.0 * rings * (rings + 1.0) + 1) * (layers + 1.0) > 268435456)
    throw Error(where,
                text(rings, " rings and ", layers, " layers need more than 2^28 points; make it coarser"));

  // cross section: ring r has 6 r points, from number 3 r (r - 1) + 1 on
  auto first = [](int r) { return r == 0 ? 0 : 3 * r * (r - 1) + 1; };
  std::vector<Eigen::Vector2d> disk{Eigen::Vector2d::Zero()};
  std::vector<Triangle> triangles;
  for (int r = 1; r <= rings; ++r) {
    auto inner = [&](int i) { return r == 1 ? 0 : first(r - 1) + i % (6 * (r - 1)); };
    auto outer = [&](int i) { return first(r) + i % (6 * r); };
    for (int i = 0; i < 6 * r; ++i) {
      const double angle = std::numbers::pi * i / (3 * r), distance = radius * r / rings;
      disk.push_back(distance * Eigen::Vector2d(std::cos(angle), std::sin(angle)));
    }
    for (int sector = 0; sector < 6; ++sector)
      for (int i = 0; i < r; ++i) {
        const int o = sector * r + i, n = sector * (r - 1) + i;
        triangles.push_back({inner(n), outer(o), outer(o + 1)});
        if (i + 1 < r) triangles.push_back({inner(n), outer(o + 1), inner(n + 1)});
      }
  }

  Mesh mesh;
  const auto points = Index(disk.size());
  for (const double height : detail::grid_coordinates(layers + 1, lo, hi))
    for (Eigen::Vector2d const& p : disk) {
      Eigen::Vector3d x;
      x[axis] = height, x[(axis + 1) % 3] = p[0], x[(axis + 2) % 3] = p[1];
      mesh.positions.push_back(x);
    }
  // a prism becomes 3 tetrahedra; each side's diagonal rises from its lower-numbered point, as seen from both
  // sides
  for (int k = 0; k < layers; ++k)
    for (Triangle t : triangles) {
      std::rotate(t.begin(), std::min_element(t.begin(), t.end()), t.end());
      const Index down = k * points, up = down + points;
      const auto [a, b, c] = t;
      mesh.tetrahedra.push_back({a + down, b + down, c + down, (b < c ? c : b) + up});
      if (b < c) {
        mesh.tetrahedra.push_back({a + down, b + down, c + up, b + up});
      } else {
        mesh.tetrahedra.push_back({a + down, b + up, c + down, c + up});
      }
      mesh.tetrahedra.push_back({a + down, b + up, c + up, a + up});
    }
  return mesh;
}

}  // namespace sinew
#endif
