// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/topology/element_checks.hpp>

#include <vector>

namespace sinew {

/// Tetrahedra over the points of the node's state. Points 1, 2, 3 turn counter-clockwise seen from point 0's
/// far side: det(x1-x0, x2-x0, x3-x0) > 0.
struct TetrahedronTopology {
  using Role = role::Topology;
  static constexpr std::string_view className = "TetrahedronTopology";
  static constexpr bool mayHaveTetrahedra = true;

  std::vector<Tetrahedron> tetrahedra{};

  static constexpr auto fields() {
    return field_list(
        field("tetrahedra", &TetrahedronTopology::tetrahedra, "", "four points each", range::nonNegative)
            .also("tetras"));
  }

  static constexpr auto outputs() { return fields(); }

  TopologyView view() const { return {.tetrahedra = tetrahedra}; }
  ElementLists edit() { return {.tetrahedra = &tetrahedra}; }

  /// Throws Error at an index out of range, and at an element that is flat or inside out.
  template <class D>
  void init(InitContext<D> const& context) const {
    check_tetrahedra<D>(text(context.where, ": TetrahedronTopology"), tetrahedra, context.rest);
  }
};

}  // namespace sinew
