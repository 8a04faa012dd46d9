// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/force/solid_element_fem.hpp>
#include <sinew/topology/quadratic_shapes.hpp>

namespace sinew {

struct QuadraticHexahedronElements {
  using Shape = QuadraticHexahedronShape;
  static constexpr std::string_view
      className = "QuadraticHexahedronFEMForceField",
      aliases = "", noun = "quadratic hexahedron", plural = "quadratic hexahedra",
      order =
          "its points are eight corners, then those near the middles of the edges around the first face, "
          "around the opposite one, and between them";
  static constexpr Of entries = Of::quadraticHexahedra;
  static auto of(TopologyView const& topology) { return topology.quadraticHexahedra; }
};

/// An elastic body of corotational hexahedra of second order, each of twenty points, with edges that may be
/// curved. Displacements converge by the third power of the size of elements, and elements bend without
/// locking.
template <class D>
using QuadraticHexahedronFEMForceField = SolidElementFEMForceField<D, QuadraticHexahedronElements>;

}  // namespace sinew
