// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/engine/wire_rest_shape.hpp>

/// A wire with a curved tip, of 1 mm, updated.
inline sinew::WireRestShape<sinew::Rigid3d> curved_wire() {
  const sinew::RodSection section{.length = 0.2,
                                  .youngModulus = 1e9,
                                  .poissonRatio = 0.3,
                                  .massDensity = 6000,
                                  .radius = 5e-4,
                                  .nbBeams = 10,
                                  .nbEdgesCollis = 40};
  sinew::RodSection tip = section;
  tip.length = 0.04, tip.nbBeams = 5, tip.nbEdgesCollis = 10, tip.spireDiameter = 0.04;
  sinew::WireRestShape<sinew::Rigid3d> shape{.wireMaterials = {section, tip}};
  shape.update("wire");
  return shape;
}
