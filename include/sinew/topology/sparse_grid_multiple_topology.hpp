// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/core/compiled.hpp>
#include <sinew/core/component.hpp>
#include <sinew/topology/element_checks.hpp>
#include <sinew/topology/sparse_grid.hpp>

#include <optional>
#include <vector>

namespace sinew {

/// A SparseGridRamificationTopology over several surfaces, one in another or beside it, each of a material of
/// its own. A cell inside a surface has its coefficient c, one that touches it (a + c)/2 with that of the
/// surfaces before, 0 where there was none; so surfaces come after those that enclose them. Young's moduli
/// are multiplied by them. Surfaces may be open: what they cut off from the border of the grid is inside.
/// What joins cells is the surface of fileTopology.
struct SparseGridMultipleTopology {
  using Role = role::Topology;
  static constexpr std::string_view className = "SparseGridMultipleTopology";
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
  std::vector<DataFile> fileTopologies{};
  std::vector<double> stiffnessCoefs{}, massCoefs{};
  bool computeRamifications = true, erasePreviousCoef = false;

  static constexpr auto fields() {
    using T = SparseGridMultipleTopology;
    return sparse_grid_fields<T>(
        field("finestConnectivity",
              &T::finestConnectivity,
              "",
              "whether the finest cells are joined only where the surface of fileTopology crosses the face "
              "between them, or one is inside"),
        field(
            "fileTopologies", &T::fileTopologies, "", "files with the surfaces, the outer before the inner"),
        field("stiffnessCoefs",
              &T::stiffnessCoefs,
              "",
              "factor of the stiffness of the cells in each surface; 1 where none is given",
              range::nonNegative),
        field("massCoefs",
              &T::massCoefs,
              "",
              "factor of the mass of the cells in each surface; 1 where none is given",
              range::nonNegative),
        field("computeRamifications",
              &T::computeRamifications,
              "",
              "whether the cells of a grid without finer levels are split; others are"),
        field("erasePreviousCoef",
              &T::erasePreviousCoef,
              "",
              "whether a cell that touches a surface has the coefficient of that alone"));
  }

  // after generate
  std::vector<Eigen::Vector3d> points{};
  std::vector<Edge> edges{};
  std::vector<Hexahedron> hexahedra{};
  std::vector<double> fill{}, massFill{};
  std::vector<CellLevel> levels{};
  Mesh finer{};
  std::vector<int> parents{};  // the hexahedron of each finer cell

  static constexpr auto outputs() { return sparse_grid_outputs<SparseGridMultipleTopology>(); }

  TopologyView view() const { return sparse_grid_view(*this); }

  /// Throws Error where there is no file, and as SparseGridTopology does. What was made before then stays.
  void generate(std::string_view where);

  /// Throws Error where the state has fewer points than the grid.
  template <class D>
  void init(InitContext<D> const& context) const {
    check_grid_state(text(context.where, ": SparseGridMultipleTopology"), points.size(), context.rest.size());
  }
};

}  // namespace sinew

#if SINEW_DEFINES

namespace sinew {

SINEW_ONCE void SparseGridMultipleTopology::generate(std::string_view where) {
  using detail::SurfaceCells;
  const std::string at = text(where, ": SparseGridMultipleTopology");
  if (fileTopologies.empty()) throw Error(at, "fileTopologies names no file; give those of the surfaces");
  std::vector<Mesh> surfaces;
  Mesh around;  // the points of all
  for (auto const& file : fileTopologies) {
    surfaces.push_back(detail::read_surface(at, file, {}, {}, {}));
    around.positions.insert(
        around.positions.end(), surfaces.back().positions.begin(), surfaces.back().positions.end());
  }
  const auto [low, high] = detail::box_of_surface(around, min, max);
  SparseGridMultipleTopology boxed = *this;
  boxed.min = low, boxed.max = high;

  auto grid = cells_of_surface(boxed, at, surfaces[0], true);
  const std::vector<SurfaceCells::Kind> first = grid.kinds;
  std::vector<double> stiffness(first.size(), 0), mass(first.size(), 0);
  std::fill(grid.kinds.begin(), grid.kinds.end(), SurfaceCells::outside);
  for (std::size_t s = 0; s < surfaces.size(); ++s) {
    const auto kinds = s == 0 ? first : cells_of_surface(boxed, at, surfaces[s], true).kinds;
    const double k = s < stiffnessCoefs.size() ? stiffnessCoefs[s] : 1,
                 m = s < massCoefs.size() ? massCoefs[s] : 1;
    for (std::size_t c = 0; c < kinds.size(); ++c)
      if (kinds[c] == SurfaceCells::inside || (kinds[c] == SurfaceCells::touched && !fillWeighted)) {
        grid.kinds[c] = SurfaceCells::inside;
        stiffness[c] = k, mass[c] = m;
      } else if (kinds[c] == SurfaceCells::touched) {
        if (grid.kinds[c] != SurfaceCells::inside) grid.kinds[c] = SurfaceCells::touched;
        stiffness[c] = erasePreviousCoef ? k : (stiffness[c] + k) / 2;
        mass[c] = erasePreviousCoef ? m : (mass[c] + m) / 2;
      }
  }
  auto finest = detail::finest_parts(grid, onlyInsideCells);
  for (auto const& c : finest.cells) {
    finest.stiffness.push_back(stiffness[grid.number(c)]);
    finest.mass.push_back(mass[grid.number(c)]);
  }
  const bool split = nbVirtualFinerLevels > 0 || (computeRamifications && finestConnectivity);
  if (split && finestConnectivity) {
    const Mesh joining = detail::read_surface(at, fileTopology, position, triangles, quads);
    detail::link_by_faces(finest, grid, &joining);
  } else if (split) {
    detail::link_by_faces(finest, grid, nullptr);
  }
  take_cells(*this,
             detail::sparse_cells(at, std::move(finest), grid, nbVirtualFinerLevels, split, onlyInsideCells));
}

}  // namespace sinew
#endif
