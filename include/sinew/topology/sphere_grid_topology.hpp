// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/core/compiled.hpp>
#include <sinew/topology/element_checks.hpp>
#include <sinew/topology/round_grid.hpp>

#include <optional>
#include <vector>

namespace sinew {

/// A ball of n[0] x n[1] x n[2] points: a cube of a grid around `center`, its shells squeezed to spheres as
/// detail::round_square does, with the elements that a RegularGridTopology of this size has.
struct SphereGridTopology {
  using Role = role::Topology;
  static constexpr std::string_view className = "SphereGridTopology";
  static constexpr std::string_view aliases = "SphereGrid";
  static constexpr bool mayHaveTetrahedra = true;  // its hexahedra can be split

  std::array<int, 3> n{2, 2, 2};
  std::optional<int> nx{}, ny{}, nz{};
  Eigen::Vector3d center{0, 0, 0}, axis{0, 0, 1};
  double radius = 1;
  bool computeHexaList = true, computeQuadList = true, computeTriangleList = true, computeEdgeList = true;

  static constexpr auto fields() {
    using T = SphereGridTopology;
    return round_grid_fields<T>(
        field("center", &T::center, "m", "middle of the ball"),
        field("axis", &T::axis, "", "direction of the third direction of the grid, of any length"),
        field("radius", &T::radius, "m", "radius of the ball", range::positive));
  }

  // after generate
  std::vector<Eigen::Vector3d> position{};
  std::vector<Edge> edges{};
  std::vector<Triangle> triangles{};
  std::vector<Quad> quads{};
  std::vector<Hexahedron> hexahedra{};
  std::array<int, 3> points{0, 0, 0};

  static constexpr auto outputs() { return round_grid_outputs<SphereGridTopology>(); }

  TopologyView view() const { return detail::grid_view(*this); }

  /// Throws Error on an axis of no length, fewer than two points each way, or more than 2^24 in all.
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

SINEW_ONCE void SphereGridTopology::generate(std::string_view where) {
  const std::string at = text(where, ": ", className);
  points = {nx.value_or(n[0]), ny.value_or(n[1]), nz.value_or(n[2])};
  Mesh grid = detail::round_grid_points(at, points, axis, 3, radius, 0);
  position = std::move(grid.positions);
  for (auto& p : position) p += center;
  detail::make_grid_elements(*this);
}

}  // namespace sinew
#endif
