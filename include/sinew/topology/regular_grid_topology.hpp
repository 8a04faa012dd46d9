// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/core/compiled.hpp>
#include <sinew/topology/element_checks.hpp>
#include <sinew/topology/regular_grid.hpp>

#include <optional>
#include <vector>

namespace sinew {

/// A box of n[0] x n[1] x n[2] points with all the elements between them: hexahedra where it has cells,
/// squares in every plane, each also as two triangles, and the edges, diagonals too. With one point in a
/// direction it is a sheet or a string. Point (i, j, k) has number i + n[0] (j + n[1] k).
struct RegularGridTopology {
  using Role = role::Topology;
  static constexpr std::string_view className = "RegularGridTopology";
  static constexpr std::string_view aliases = "RegularGrid";
  static constexpr bool mayHaveTetrahedra = true;  // its hexahedra can be split

  std::array<int, 3> n{2, 2, 2};
  std::optional<int> nx{}, ny{}, nz{};
  Eigen::Vector3d min{0, 0, 0}, max{1, 1, 1};
  std::optional<double> xmin{}, ymin{}, zmin{}, xmax{}, ymax{}, zmax{};
  std::optional<Eigen::Vector3d> p0{};
  double cellWidth = 0;
  bool computeHexaList = true, computeQuadList = true, computeTriangleList = true, computeEdgeList = true;

  static constexpr auto fields() {
    using T = RegularGridTopology;
    return grid_fields<T>(
        field("n", &T::n, "", "points along x, y and z", range::atLeast(1)),
        field("nx", &T::nx, "", "points along x, in place of that of n", range::atLeast(1)),
        field("ny", &T::ny, "", "points along y, in place of that of n", range::atLeast(1)),
        field("nz", &T::nz, "", "points along z, in place of that of n", range::atLeast(1)),
        field("min", &T::min, "m", "lowest corner of the box"),
        field("max", &T::max, "m", "highest corner of the box"),
        field("xmin", &T::xmin, "m", "lowest x, in place of that of min"),
        field("ymin", &T::ymin, "m", "lowest y, in place of that of min"),
        field("zmin", &T::zmin, "m", "lowest z, in place of that of min"),
        field("xmax", &T::xmax, "m", "highest x, in place of that of max"),
        field("ymax", &T::ymax, "m", "highest y, in place of that of max"),
        field("zmax", &T::zmax, "m", "highest z, in place of that of max"),
        field("p0", &T::p0, "m", "where the first point is moved to, and the box with it"),
        field("cellWidth",
              &T::cellWidth,
              "m",
              "size of the cubic cells that cover the box, in place of n; 0 for cells as n says",
              range::nonNegative));
  }

  // after generate
  std::vector<Eigen::Vector3d> position{};
  std::vector<Edge> edges{};
  std::vector<Triangle> triangles{};
  std::vector<Quad> quads{};
  std::vector<Hexahedron> hexahedra{};
  std::array<int, 3> points{0, 0, 0};  // along x, y, z

  static constexpr auto outputs() {
    using T = RegularGridTopology;
    return field_list(
        field("position", &T::position, "m", "the points, x fastest").also("points"),
        field("grid", &T::points, "", "points along x, y and z"),
        field("edges",
              &T::edges,
              "",
              "sides of the triangles, as they come; without these, lines along x, then y, then z")
            .also("lines"),
        field("triangles", &T::triangles, "", "each quad as two"),
        field("quads", &T::quads, "", "squares of the xy planes, then xz, then yz"),
        field("hexahedra", &T::hexahedra, "", "the cells, x fastest").also("hexas"));
  }

  TopologyView view() const {
    TopologyView all = detail::grid_view(*this);
    if (!hexahedra.empty()) all.places = position;
    return all;
  }

  /// Throws Error when the box is empty in a direction of several points, or above 2^24 points. One that runs
  /// backwards makes a grid that does, as in SOFA.
  void generate(std::string_view where);

  /// Throws Error where the state has fewer points than the grid.
  template <class D>
  void init(InitContext<D> const& context) const {
    check_grid_state(text(context.where, ": RegularGridTopology"), position.size(), context.rest.size());
  }
};

}  // namespace sinew

#if SINEW_DEFINES
namespace sinew {

SINEW_ONCE void RegularGridTopology::generate(std::string_view where) {
  const std::string at = text(where, ": RegularGridTopology");
  Eigen::Vector3d lo(xmin.value_or(min[0]), ymin.value_or(min[1]), zmin.value_or(min[2]));
  Eigen::Vector3d hi(xmax.value_or(max[0]), ymax.value_or(max[1]), zmax.value_or(max[2]));
  points = {nx.value_or(n[0]), ny.value_or(n[1]), nz.value_or(n[2])};
  if (cellWidth > 0) {
    if (!(lo.array() <= hi.array()).all()) detail::refuse_box(at, lo, hi);
    points = detail::cubic_cells(cellWidth, lo, hi);
  }
  // SOFA's sheets and strings lie in the middle of the box along x and y, and at its bottom along z
  for (int c = 0; c < 2; ++c)
    if (points[std::size_t(c)] == 1) lo[c] = (lo[c] + hi[c]) / 2;
  if (p0) hi += *p0 - lo, lo = *p0;

  position = detail::grid_points(at, points, lo, hi, 1, 24).positions;
  detail::make_grid_elements(*this);
}

}  // namespace sinew
#endif
