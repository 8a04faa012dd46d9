// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/core/compiled.hpp>
#include <sinew/core/component.hpp>
#include <sinew/topology/element_checks.hpp>
#include <sinew/topology/sparse_grid.hpp>

#include <optional>
#include <vector>

namespace sinew {

/// The cells of a SparseGridTopology, where what does not meet inside a cell is apart: a cell that holds two
/// branches of the body has a hexahedron for each, at the same place (Nesme, Kry, Jerabkova, Faure 2009).
/// What meets is seen in a grid whose cells are halved nbVirtualFinerLevels times: there the cells with a
/// face in common are joined, with finestConnectivity only where the surface crosses that face or one of them
/// is inside; without, points alone will do, as for a SparseGridTopology. A BarycentricMapping finds the
/// hexahedron of a point by the fine cell in which it lies. A hexahedron is as filled as its fine cells are
/// in the mean; one of several in a cell as the last of them, over 8, as in SOFA.
struct SparseGridRamificationTopology {
  using Role = role::Topology;
  static constexpr std::string_view className = "SparseGridRamificationTopology";
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
  bool finestConnectivity = true;

  static constexpr auto fields() {
    using T = SparseGridRamificationTopology;
    return sparse_grid_fields<T>(
        field("finestConnectivity",
              &T::finestConnectivity,
              "",
              "whether the finest cells are joined only where the surface crosses the "
              "face between them, or one is inside"));
  }

  // after generate
  std::vector<Eigen::Vector3d> points{};
  std::vector<Edge> edges{};
  std::vector<Hexahedron> hexahedra{};
  std::vector<double> fill{}, massFill{};
  std::vector<CellLevel> levels{};
  Mesh finer{};
  std::vector<int> parents{};  // the hexahedron of each finer cell

  static constexpr auto outputs() { return sparse_grid_outputs<SparseGridRamificationTopology>(); }

  TopologyView view() const { return sparse_grid_view(*this); }

  /// Throws Error as SparseGridTopology does. What was made before then stays.
  void generate(std::string_view where);

  /// Throws Error where the state has fewer points than the grid.
  template <class D>
  void init(InitContext<D> const& context) const {
    check_grid_state(
        text(context.where, ": SparseGridRamificationTopology"), points.size(), context.rest.size());
  }
};

}  // namespace sinew

#if SINEW_DEFINES

namespace sinew {

SINEW_ONCE void SparseGridRamificationTopology::generate(std::string_view where) {
  const std::string at = text(where, ": SparseGridRamificationTopology");
  const Mesh surface =
      detail::read_surface(at, fileTopology, position, triangles, quads, !finestConnectivity);
  const auto grid = cells_of_surface(*this, at, surface);
  auto finest = detail::finest_parts(grid, onlyInsideCells);
  detail::fill_by_surface(finest, grid, fillWeighted);
  const bool split = nbVirtualFinerLevels > 0 || finestConnectivity;
  if (split) detail::link_by_faces(finest, grid, finestConnectivity ? &surface : nullptr);
  take_cells(*this,
             detail::sparse_cells(at, std::move(finest), grid, nbVirtualFinerLevels, split, onlyInsideCells));
}

}  // namespace sinew
#endif
