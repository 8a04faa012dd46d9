// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/force/solid_element_fem.hpp>

namespace sinew {

struct PrismElements {
  using Shape = PrismShape;
  static constexpr std::string_view className = "PrismFEMForceField",
                                    aliases = "PrismCorotationalFEMForceField", noun = "prism",
                                    plural = "prisms",
                                    order =
                                        "its points are those of a triangle, and in the same order "
                                        "those of the opposite one";
  static constexpr Of entries = Of::prisms;
  static auto of(TopologyView const& topology) { return topology.prisms; }
};

/// An elastic body of corotational linear prisms, each a triangle and the opposite one.
template <class D>
using PrismFEMForceField = SolidElementFEMForceField<D, PrismElements>;

}  // namespace sinew
