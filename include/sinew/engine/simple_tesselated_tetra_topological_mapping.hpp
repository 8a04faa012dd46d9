// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/core/compiled.hpp>
#include <sinew/core/component.hpp>

#include <vector>

namespace sinew {

/// Makes eight tetrahedra of each of another topology, at half the size: the points are those of the
/// topology, then the middles of its edges. Below a BarycentricMapping (SOFA's
/// SimpleTesselatedTetraMechanicalMapping) they follow the large ones.
struct SimpleTesselatedTetraTopologicalMapping {
  using Role = role::Engine;
  static constexpr bool joinsTopologies = true;
  static constexpr std::string_view className = "SimpleTesselatedTetraTopologicalMapping";

  std::vector<Eigen::Vector3d> position{};
  std::vector<Edge> edges{};
  std::vector<Tetrahedron> tetrahedra{};

  static constexpr auto fields() {
    using E = SimpleTesselatedTetraTopologicalMapping;
    constexpr Range r = range::nonNegative;
    return field_list(
        field("position", &E::position, "m", "points").also("points"),
        field(
            "edges", &E::edges, "", "of the tetrahedra, in the order of their middles; none: as they come", r)
            .also("lines"),
        field("tetrahedra", &E::tetrahedra, "", "four points each", r).also("tetras"));
  }

  // after update
  std::vector<Eigen::Vector3d> finePosition{};
  std::vector<Tetrahedron> fineTetrahedra{};

  static constexpr auto outputs() {
    using E = SimpleTesselatedTetraTopologicalMapping;
    return field_list(
        field("position", &E::finePosition, "m", "those points, then the middles of edges").also("points"),
        field("tetrahedra", &E::fineTetrahedra, "", "eight for each").also("tetras"));
  }

  /// Throws Error where there is no tetrahedron, or one has a point that is not there or an edge that is not
  /// in `edges`.
  void update(std::string_view where);
};

}  // namespace sinew

#if SINEW_DEFINES
#include <sinew/core/memory_limit.hpp>
#include <sinew/topology/edges_as_they_come.hpp>

#include <algorithm>
#include <array>

namespace sinew {

SINEW_ONCE void SimpleTesselatedTetraTopologicalMapping::update(std::string_view where) {
  check_fields(*this, where);
  const std::string at = text(where, ": ", className);
  detail::check_indices(at, "edge", edges, position.size());
  detail::check_indices(at, "tetrahedron", tetrahedra, position.size());
  if (tetrahedra.empty()) throw Error(at, "the topology has no tetrahedron; give it some");
  detail::EdgesAsTheyCome sides;
  if (edges.empty())
    sides.add(tetrahedra, detail::tetrahedronEdges);
  else
    sides.add(edges, std::array<detail::EdgeCorners, 1>{{{0, 1}}});
  check_memory(at, "the middles of edges", double(sides.edges.size()));
  finePosition = position;
  for (auto const& [a, b] : sides.edges)
    finePosition.push_back(0.5 * (position[std::size_t(a)] + position[std::size_t(b)]));
  fineTetrahedra.clear();
  for (Tetrahedron const& t : tetrahedra) {
    std::array<Index, 6> m;  // the middles of the edges
    for (std::size_t k = 0; k < 6; ++k) {
      auto const& [i, j] = detail::tetrahedronEdges[k];
      const auto [a, b] = std::minmax(t[i], t[j]);
      const auto found = sides.numbers.find(Edge{a, b});
      if (found == sides.numbers.end())
        throw Error(at,
                    text("the edge of points ",
                         a,
                         " and ",
                         b,
                         " of a tetrahedron is not in edges; give all edges, or none"));
      m[k] = Index(position.size()) + found->second;
    }
    for (Tetrahedron const& part : {Tetrahedron{t[0], m[0], m[1], m[2]},
                                    Tetrahedron{t[1], m[0], m[4], m[3]},
                                    Tetrahedron{t[2], m[1], m[3], m[5]},
                                    Tetrahedron{t[3], m[2], m[5], m[4]},
                                    Tetrahedron{m[1], m[0], m[3], m[5]},
                                    Tetrahedron{m[1], m[0], m[5], m[2]},
                                    Tetrahedron{m[4], m[0], m[5], m[3]},
                                    Tetrahedron{m[4], m[0], m[2], m[5]}})
      fineTetrahedra.push_back(part);
  }
}

}  // namespace sinew
#endif
