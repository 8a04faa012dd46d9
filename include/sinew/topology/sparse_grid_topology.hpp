// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/core/compiled.hpp>
#include <sinew/topology/element_checks.hpp>

#include <optional>
#include <vector>

namespace sinew {

/// The cells of a regular grid that touch a closed surface or lie inside it, as hexahedra over their own
/// points only. Where a surface winds around a cell, the cell is inside; so surfaces of cavities look into
/// them.
struct SparseGridTopology {
  using Role = role::Topology;
  static constexpr std::string_view className = "SparseGridTopology";
  static constexpr std::string_view aliases = "SparseGrid";
  static constexpr bool mayHaveTetrahedra = true;  // its hexahedra can be split

  std::array<int, 3> n{2, 2, 2};
  DataFile fileTopology{};
  std::vector<Eigen::Vector3d> position{};
  std::vector<Triangle> triangles{};
  std::vector<Quad> quads{};
  std::optional<Eigen::Vector3d> min{}, max{};
  double cellWidth = 0;
  bool onlyInsideCells = false, fillWeighted = true;

  static constexpr auto fields() {
    using T = SparseGridTopology;
    return field_list(
        field(
            "n", &T::n, "", "points along x, y and z of the grid of which cells are kept", range::atLeast(2)),
        field("fileTopology", &T::fileTopology, "", "a file with the surface (.obj, .stl, .msh, .vtk)")
            .also("filename"),
        field("position", &T::position, "m", "points of the surface, where there is no file"),
        field("triangles", &T::triangles, "", "triangles of the surface", range::nonNegative),
        field("quads", &T::quads, "", "quads of the surface", range::nonNegative),
        field(
            "min", &T::min, "m", "lowest corner of the grid; not given, that of the surface and 1 % beyond"),
        field(
            "max", &T::max, "m", "highest corner of the grid; not given, that of the surface and 1 % beyond"),
        field("cellWidth",
              &T::cellWidth,
              "m",
              "size of the cubic cells that cover the box, in place of n; 0 for cells as n says",
              range::nonNegative),
        field(
            "onlyInsideCells", &T::onlyInsideCells, "", "whether cells that touch the surface are left out"),
        field("fillWeighted",
              &T::fillWeighted,
              "",
              "hexahedra that touch the surface count as half filled: they are half as stiff"));
  }

  // after generate
  std::vector<Eigen::Vector3d> points{};
  std::vector<Edge> edges{};
  std::vector<Hexahedron> hexahedra{};
  std::vector<double> fill{};

  static constexpr auto outputs() {
    using T = SparseGridTopology;
    return field_list(
        field("position", &T::points, "m", "points of the cells, z fastest, as in SOFA"),
        field("edges", &T::edges, "", "sides of the cells").also("lines"),
        field("hexahedra", &T::hexahedra, "", "the cells that meet the surface, then those inside")
            .also("hexas"));
  }

  TopologyView view() const {
    return {.positions = points, .edges = edges, .hexahedra = hexahedra, .places = points, .fill = fill};
  }

  /// Throws Error when the file cannot be read, there is no surface or it is not closed, the box is empty,
  /// above 2^24 points, and when no cell is kept. What was made before then stays.
  void generate(std::string_view where);

  /// Throws Error where the state has fewer points than the grid.
  template <class D>
  void init(InitContext<D> const& context) const {
    check_grid_state(text(context.where, ": SparseGridTopology"), points.size(), context.rest.size());
  }

 private:
  enum Kind : char { unknown, touched, inside, outside };

  struct Grid {
    std::array<int, 3> points;
    Eigen::Vector3i cells;
    std::vector<double> coordinates[3]{};
    std::vector<Kind> kinds{};
    Eigen::Vector3d slack;  // a cell touches what is this near, so that rounding opens no gap between cells

    Kind& kind(Eigen::Vector3i const& c);
    // the box around the cells from a to b - 1
    std::array<Eigen::Vector3d, 2> box(Eigen::Vector3i const& a, Eigen::Vector3i const& b) const;
    // marks the cells from a to b - 1 that touch the triangle, by halving
    void touch(Eigen::Vector3d const (&triangle)[3], Eigen::Vector3i const& a, Eigen::Vector3i const& b);
  };

  Mesh readSurface(std::string const& at) const;

  // Cells that no part of the surface separates are on one side of it: each connected lot of them is decided
  // by how often the surface winds around its first cell, its last and one between, which lie away from the
  // surface.
  static void decideRest(Grid& grid, Mesh const& surface, std::string const& at);

  void keep(Grid const& grid, std::string const& at);
};

}  // namespace sinew

#if SINEW_DEFINES
#include <sinew/io/text_mesh_file.hpp>
#include <sinew/topology/adjacency.hpp>
#include <sinew/topology/regular_grid.hpp>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>

namespace sinew::detail {

/// Whether a triangle and a box share a point: no plane between them is normal to an axis of the box, to the
/// triangle, or to an axis and a side (Akenine-Moeller 2001).
inline bool triangle_meets_box(Eigen::Vector3d const (&triangle)[3], Eigen::Vector3d const& center,
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

}  // namespace sinew::detail

namespace sinew {

SINEW_ONCE void SparseGridTopology::generate(std::string_view where) {
  const std::string at = text(where, ": SparseGridTopology");
  const Mesh surface = readSurface(at);
  Eigen::Vector3d lo = surface.positions[0], hi = lo;
  for (auto const& t : surface.triangles)
    for (const Index i : t) {
      lo = min_of(lo, surface.positions[std::size_t(i)]);
      hi = max_of(hi, surface.positions[std::size_t(i)]);
    }
  const Eigen::Vector3d margin = (hi - lo) / 100;
  lo = min.value_or(lo - margin), hi = max.value_or(hi + margin);
  Grid grid;
  grid.points = cellWidth > 0 ? detail::cubic_cells(cellWidth, lo, hi) : n;
  detail::check_grid(at, grid.points, lo, hi, 2, 24);
  for (int c = 0; c < 3; ++c) {
    grid.cells[c] = grid.points[std::size_t(c)] - 1;
    grid.coordinates[c] = detail::grid_coordinates(grid.points[std::size_t(c)], lo[c], hi[c]);
  }
  grid.kinds.assign(std::size_t(grid.cells.prod()), unknown);
  for (int c = 0; c < 3; ++c)
    grid.slack[c] =
        1e-9 * (hi[c] - lo[c]) / grid.cells[c] + 1e-15 * std::max(std::abs(lo[c]), std::abs(hi[c]));

  for (auto const& t : surface.triangles) {
    const Eigen::Vector3d corners[3] = {surface.positions[std::size_t(t[0])],
                                        surface.positions[std::size_t(t[1])],
                                        surface.positions[std::size_t(t[2])]};
    grid.touch(corners, Eigen::Vector3i::Zero(), grid.cells);
  }
  decideRest(grid, surface, at);
  keep(grid, at);
}

SINEW_ONCE SparseGridTopology::Kind& SparseGridTopology::Grid::kind(Eigen::Vector3i const& c) {
  return kinds[std::size_t(c[0]) +
               std::size_t(cells[0]) * (std::size_t(c[1]) + std::size_t(cells[1]) * std::size_t(c[2]))];
}

SINEW_ONCE std::array<Eigen::Vector3d, 2> SparseGridTopology::Grid::box(Eigen::Vector3i const& a,
                                                                        Eigen::Vector3i const& b) const {
  std::array<Eigen::Vector3d, 2> corners;
  for (int c = 0; c < 3; ++c) {
    corners[0][c] = coordinates[c][std::size_t(a[c])];
    corners[1][c] = coordinates[c][std::size_t(b[c])];
  }
  return corners;
}

SINEW_ONCE void SparseGridTopology::Grid::touch(Eigen::Vector3d const (&triangle)[3],
                                                Eigen::Vector3i const& a, Eigen::Vector3i const& b) {
  const auto [low, high] = box(a, b);
  if (!detail::triangle_meets_box(triangle, (low + high) / 2, (high - low) / 2 + slack)) return;
  int longest = 0;
  (b - a).maxCoeff(&longest);
  if (b[longest] - a[longest] == 1) {
    kind(a) = touched;
    return;
  }
  Eigen::Vector3i middle = b;
  middle[longest] = (a[longest] + b[longest]) / 2;
  touch(triangle, a, middle);
  middle = a;
  middle[longest] = (a[longest] + b[longest]) / 2;
  touch(triangle, middle, b);
}

SINEW_ONCE Mesh SparseGridTopology::readSurface(std::string const& at) const {
  Mesh surface;
  if (!fileTopology.path.empty()) {
    try {
      surface = io::read_text_mesh(fileTopology.path);
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
  if (surface.triangles.empty())
    throw Error(at, "there is no surface; give fileTopology, or position with triangles or quads");
  remove_unused_points(surface);
  return surface;
}

SINEW_ONCE void SparseGridTopology::decideRest(Grid& grid, Mesh const& surface, std::string const& at) {
  std::vector<Eigen::Vector3i> region;
  for (int k = 0; k < grid.cells[2]; ++k)
    for (int j = 0; j < grid.cells[1]; ++j)
      for (int i = 0; i < grid.cells[0]; ++i) {
        if (grid.kind({i, j, k}) != unknown) continue;
        region.assign(1, {i, j, k});
        grid.kind(region[0]) = outside;
        for (std::size_t c = 0; c < region.size(); ++c)
          for (int side = 0; side < 6; ++side) {
            Eigen::Vector3i next = region[c];
            int& step = next[side / 2];
            step += side % 2 == 0 ? -1 : 1;
            if (step < 0 || step >= grid.cells[side / 2] || grid.kind(next) != unknown) continue;
            grid.kind(next) = outside;
            region.push_back(next);
          }
        int windings = 0;
        for (const std::size_t c : {std::size_t(0), region.size() / 2, region.size() - 1}) {
          const auto [low, high] = grid.box(region[c], region[c] + Eigen::Vector3i::Ones());
          const Eigen::Vector3d p = (low + high) / 2;
          const double winding = detail::winding_number(surface.positions, surface.triangles, p);
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
          for (auto const& cell : region) grid.kind(cell) = inside;
      }
}

SINEW_ONCE void SparseGridTopology::keep(Grid const& grid, std::string const& at) {
  // in SOFA's order, so that results compare: cells that meet the surface first, points with z fastest
  Mesh kept;
  std::vector<Hexahedron> within;
  std::size_t cell = 0;
  detail::for_grid_cells(grid.points[0], grid.points[1], grid.points[2], [&](Hexahedron const& h, int) {
    const Kind kind = grid.kinds[cell++];
    if (kind == inside) within.push_back(h);
    if (kind == touched && !onlyInsideCells) kept.hexahedra.push_back(h);
  });
  const std::size_t border = kept.hexahedra.size();
  kept.hexahedra.insert(kept.hexahedra.end(), within.begin(), within.end());
  if (kept.hexahedra.empty())
    throw Error(at,
                onlyInsideCells ? "no cell is inside the surface without touching it; take a finer grid, or "
                                  "onlyInsideCells=\"false\""
                                : "no cell touches the surface or is inside; correct min and max");
  std::vector<Index> number(
      grid.coordinates[0].size() * grid.coordinates[1].size() * grid.coordinates[2].size(), -1);
  for (auto const& h : kept.hexahedra)
    for (const Index i : h) number[std::size_t(i)] = 0;
  const auto [nx, ny, nz] = grid.points;
  for (int i = 0; i < nx; ++i)
    for (int j = 0; j < ny; ++j)
      for (int k = 0; k < nz; ++k)
        if (Index& p = number[std::size_t(i) +
                              std::size_t(nx) * (std::size_t(j) + std::size_t(ny) * std::size_t(k))];
            p == 0) {
          p = Index(kept.positions.size());
          kept.positions.push_back({grid.coordinates[0][std::size_t(i)],
                                    grid.coordinates[1][std::size_t(j)],
                                    grid.coordinates[2][std::size_t(k)]});
        }
  for (auto& h : kept.hexahedra)
    for (Index& i : h) i = number[std::size_t(i)];
  edges = edges_of(kept.hexahedra);
  points = std::move(kept.positions);
  hexahedra = std::move(kept.hexahedra);
  fill.clear();
  if (fillWeighted) {
    fill.assign(hexahedra.size(), 1.0);
    std::fill_n(fill.begin(), border, 0.5);
  }
}

}  // namespace sinew
#endif
