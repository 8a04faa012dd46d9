// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/core/compiled.hpp>
#include <sinew/topology/element_checks.hpp>
#include <sinew/topology/round_grid.hpp>

#include <optional>
#include <vector>

namespace sinew {

/// A solid cylinder of n[0] x n[1] x n[2] points: from `center` along `axis`, square layers of a grid, each
/// squeezed to a disk as detail::round_square does, with the elements that a RegularGridTopology of this size
/// has. With one layer it is a disk.
struct CylinderGridTopology {
  using Role = role::Topology;
  static constexpr std::string_view className = "CylinderGridTopology";
  static constexpr std::string_view aliases = "CylinderGrid";
  static constexpr bool mayHaveTetrahedra = true;  // its hexahedra can be split

  std::array<int, 3> n{2, 2, 2};
  std::optional<int> nx{}, ny{}, nz{};
  Eigen::Vector3d center{0, 0, 0}, axis{0, 0, 1};
  double radius = 1, length = 1;
  bool computeHexaList = true, computeQuadList = true, computeTriangleList = true, computeEdgeList = true;

  static constexpr auto fields() {
    using T = CylinderGridTopology;
    return round_grid_fields<T>(
        field("center", &T::center, "m", "middle of the first layer"),
        field("axis", &T::axis, "", "direction of the cylinder, of any length"),
        field("radius", &T::radius, "m", "radius of the cylinder", range::positive),
        field("length", &T::length, "m", "length of the cylinder along its axis", range::positive));
  }

  // after generate
  std::vector<Eigen::Vector3d> position{};
  std::vector<Edge> edges{};
  std::vector<Triangle> triangles{};
  std::vector<Quad> quads{};
  std::vector<Hexahedron> hexahedra{};
  std::array<int, 3> points{0, 0, 0};

  static constexpr auto outputs() { return round_grid_outputs<CylinderGridTopology>(); }

  TopologyView view() const { return detail::grid_view(*this); }

  /// Throws Error on an axis of no length, fewer than two points across, or more than 2^24 in all.
  void generate(std::string_view where);

  /// Throws Error where the state has fewer points than the grid.
  template <class D>
  void init(InitContext<D> const& context) const {
    check_grid_state(text(context.where, ": ", className), position.size(), context.rest.size());
  }
};

}  // namespace sinew

#if SINEW_DEFINES
namespace sinew {

SINEW_ONCE void CylinderGridTopology::generate(std::string_view where) {
  const std::string at = text(where, ": ", className);
  points = {nx.value_or(n[0]), ny.value_or(n[1]), nz.value_or(n[2])};
  // heights are those of the layers, and are not squeezed
  Mesh grid = detail::round_grid_points(at, points, axis, 2, radius, length);
  position = std::move(grid.positions);
  for (auto& p : position) p += center;
  detail::make_grid_elements(*this);
}

}  // namespace sinew
#endif
