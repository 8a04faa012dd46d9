// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/core/compiled.hpp>
#include <sinew/core/component.hpp>
#include <sinew/topology/element_checks.hpp>
#include <sinew/topology/sparse_grid.hpp>

#include <optional>
#include <vector>

namespace sinew {

/// The cells of a regular grid that touch a closed surface or lie inside it, as hexahedra over their own
/// points only. Where a surface winds around a cell, the cell is inside; so surfaces of cavities look into
/// them. Of points without triangles or quads, cells are kept that have one of them, and those that these
/// shut in. With nbVirtualFinerLevels a cell is as filled as its parts of a finer grid are in the mean.
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
  int nbVirtualFinerLevels = 0;

  static constexpr auto fields() { return sparse_grid_fields<SparseGridTopology>(); }

  // after generate
  std::vector<Eigen::Vector3d> points{};
  std::vector<Edge> edges{};
  std::vector<Hexahedron> hexahedra{};
  std::vector<double> fill{}, massFill{};
  std::vector<CellLevel> levels{};

  static constexpr auto outputs() { return sparse_grid_outputs<SparseGridTopology>(); }

  TopologyView view() const { return sparse_grid_view(*this); }

  /// Throws Error when the file cannot be read, there is no point, the surface is not closed, the box is
  /// empty, above 2^24 points, and when no cell is kept. What was made before then stays.
  void generate(std::string_view where);

  /// Throws Error where the state has fewer points than the grid.
  template <class D>
  void init(InitContext<D> const& context) const {
    check_grid_state(text(context.where, ": SparseGridTopology"), points.size(), context.rest.size());
  }
};

}  // namespace sinew

#if SINEW_DEFINES

namespace sinew {

SINEW_ONCE void SparseGridTopology::generate(std::string_view where) {
  const std::string at = text(where, ": SparseGridTopology");
  const Mesh surface = detail::read_surface(at, fileTopology, position, triangles, quads, true);
  const auto grid = cells_of_surface(*this, at, surface);
  auto finest = detail::finest_parts(grid, onlyInsideCells);
  detail::fill_by_surface(finest, grid, fillWeighted);
  take_cells(*this,
             detail::sparse_cells(at, std::move(finest), grid, nbVirtualFinerLevels, false, onlyInsideCells));
}

}  // namespace sinew
#endif
