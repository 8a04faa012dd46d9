// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/core/component.hpp>
#include <sinew/topology/adjacency.hpp>
#include <sinew/topology/cell_parts.hpp>
#include <sinew/topology/regular_grid.hpp>

#include <string>

// What the topologies of cells over a surface have in common: fields, outputs, and the cells that they start
// from.
namespace sinew {

template <class T, class... More>
constexpr auto sparse_grid_fields(More... more) {
  return field_list(
      field("n", &T::n, "", "points along x, y and z of the grid of which cells are kept", range::atLeast(2)),
      field("fileTopology", &T::fileTopology, "", "a file with the surface (.obj, .stl, .ply, .msh, .vtk)")
          .also("filename"),
      field("position", &T::position, "m", "points of the surface, where there is no file"),
      field("triangles", &T::triangles, "", "triangles of the surface", range::nonNegative),
      field("quads", &T::quads, "", "quads of the surface", range::nonNegative),
      field("min", &T::min, "m", "lowest corner of the grid; not given, that of the surface and 1 % beyond"),
      field("max", &T::max, "m", "highest corner of the grid; not given, that of the surface and 1 % beyond"),
      field("cellWidth",
            &T::cellWidth,
            "m",
            "size of the cubic cells that cover the box, in place of n; 0 for cells as n says",
            range::nonNegative),
      field("onlyInsideCells", &T::onlyInsideCells, "", "whether cells that touch the surface are left out"),
      field("fillWeighted",
            &T::fillWeighted,
            "",
            "hexahedra that touch the surface count as half filled: they are half as stiff"),
      field("nbVirtualFinerLevels",
            &T::nbVirtualFinerLevels,
            "",
            "how often cells are halved to see how filled they are",
            range::closed(0, 24)),
      more...);
}

template <class T>
constexpr auto sparse_grid_outputs() {
  return field_list(
      field("position", &T::points, "m", "points of the cells, z fastest, as in SOFA"),
      field("edges", &T::edges, "", "sides of the cells").also("lines"),
      field("hexahedra", &T::hexahedra, "", "the cells that meet the surface, then those inside")
          .also("hexas"));
}

template <class T>
TopologyView sparse_grid_view(T const& t) {
  TopologyView view{.positions = t.points,
                    .edges = t.edges,
                    .hexahedra = t.hexahedra,
                    .places = t.points,
                    .fill = t.fill,
                    .massFill = t.massFill,
                    .levels = t.levels};
  if constexpr (requires { t.finer; }) view.finer = {t.finer.positions, t.finer.hexahedra, t.parents};
  return view;
}

/// The finest cells of a topology, in the box around the surface.
template <class T>
detail::SurfaceCells cells_of_surface(T const& t, std::string const& at, Mesh const& surface,
                                      bool mayBeOpen = false) {
  auto [low, high] = detail::box_of_surface(surface, t.min, t.max);
  const auto n = t.cellWidth > 0 ? detail::cubic_cells(t.cellWidth, low, high) : t.n;
  return {at, surface, detail::finer_grid(at, n, t.nbVirtualFinerLevels), low, high, mayBeOpen};
}

template <class T>
void take_cells(T& t, detail::SparseCells cells) {
  const auto all = [](std::vector<double> const& fill) {
    for (const double f : fill)
      if (f != 1) return false;
    return true;
  };
  t.edges = edges_of(cells.mesh.hexahedra);
  t.points = std::move(cells.mesh.positions);
  t.hexahedra = std::move(cells.mesh.hexahedra);
  t.fill.clear(), t.massFill.clear();
  if (!all(cells.stiffness)) t.fill = std::move(cells.stiffness);
  if (!all(cells.mass)) t.massFill = std::move(cells.mass);
  t.levels = std::move(cells.levels);
  if constexpr (requires { t.finer; }) {
    t.finer = std::move(cells.finer);
    t.parents = std::move(cells.parents);
  }
}

}  // namespace sinew
