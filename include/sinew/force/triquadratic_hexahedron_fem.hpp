// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/force/solid_element_fem.hpp>
#include <sinew/topology/quadratic_shapes.hpp>

namespace sinew {

struct TriquadraticHexahedronElements {
  using Shape = TriquadraticHexahedronShape;
  static constexpr std::string_view className = "TriquadraticHexahedronFEMForceField", aliases = "",
                                    noun = "triquadratic hexahedron", plural = "triquadratic hexahedra",
                                    order =
                                        "its points are those of a quadratic hexahedron, then those near the "
                                        "middles of its faces, in VTK's order, and of all";
  static constexpr Of entries = Of::triquadraticHexahedra;
  static auto of(TopologyView const& topology) { return topology.triquadraticHexahedra; }
};

/// An elastic body of corotational hexahedra of second order in each direction, each of 27 points, with edges
/// and faces that may be curved. Displacements converge by the third power of the size of elements, in warped
/// ones, too.
template <class D>
using TriquadraticHexahedronFEMForceField = SolidElementFEMForceField<D, TriquadraticHexahedronElements>;

}  // namespace sinew
