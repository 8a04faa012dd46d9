// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/force/solid_element_fem.hpp>
#include <sinew/topology/quadratic_shapes.hpp>

namespace sinew {

struct QuadraticTetrahedronElements {
  using Shape = QuadraticTetrahedronShape;
  static constexpr std::string_view
      className = "QuadraticTetrahedronFEMForceField",
      aliases = "", noun = "quadratic tetrahedron", plural = "quadratic tetrahedra",
      order = "its points are four corners, then those near the middles of the edges 01, 12, 20, 03, 13, 23";
  static constexpr Of entries = Of::quadraticTetrahedra;
  static auto of(TopologyView const& topology) { return topology.quadraticTetrahedra; }
};

/// An elastic body of corotational tetrahedra of second order, each of ten points, with edges that may be
/// curved. Displacements converge by the third power of the size of elements, and elements bend without
/// locking.
template <class D>
using QuadraticTetrahedronFEMForceField = SolidElementFEMForceField<D, QuadraticTetrahedronElements>;

}  // namespace sinew
