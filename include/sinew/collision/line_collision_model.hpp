// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/collision/collision_model.hpp>
#include <sinew/collision/surface_elements.hpp>

namespace sinew {

struct CollisionLines {
  static constexpr std::string_view className = "LineCollisionModel";
  static constexpr std::string_view aliases = "Line LineModel LineMeshModel LineSetModel TLineModel";
  static constexpr std::string_view noun = "line";
  static constexpr Shape shape = Shape::line;

  template <class D>
  static std::vector<PrimitiveCorners> elements(InitContext<D> const& context) {
    return lines_of(context.topology, context.rest.size());
  }
};

/// The edges of the topology as lines that collide; of its faces, where it has no edges; or of the surface of
/// its volume.
template <class D>
using LineCollisionModel = MeshCollisionModel<D, CollisionLines>;

}  // namespace sinew
