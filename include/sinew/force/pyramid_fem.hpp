// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/force/solid_element_fem.hpp>

namespace sinew {

struct PyramidElements {
  using Shape = PyramidShape;
  static constexpr std::string_view className = "PyramidFEMForceField",
                                    aliases = "PyramidCorotationalFEMForceField", noun = "pyramid",
                                    plural = "pyramids",
                                    order = "its points are the four around its base, then the apex";
  static constexpr Of entries = Of::pyramids;
  static auto of(TopologyView const& topology) { return topology.pyramids; }
};

/// An elastic body of corotational linear pyramids, each a quad and an apex.
template <class D>
using PyramidFEMForceField = SolidElementFEMForceField<D, PyramidElements>;

}  // namespace sinew
