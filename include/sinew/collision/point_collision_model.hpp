// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/collision/collision_model.hpp>
#include <sinew/collision/surface_elements.hpp>

namespace sinew {

struct CollisionPoints {
  static constexpr std::string_view className = "PointCollisionModel";
  static constexpr std::string_view aliases = "Point PointModel PointMeshModel PointSetModel TPointModel SpatialGridPointModel";
  static constexpr std::string_view noun = "point";
  static constexpr Shape shape = Shape::point;

  template <class D>
  static std::vector<PrimitiveCorners> elements(InitContext<D> const& context) {
    return points_of(context.topology, context.rest.size());
  }
};

/// Each point of the state as a point that collides.
template <class D>
using PointCollisionModel = MeshCollisionModel<D, CollisionPoints>;

}  // namespace sinew
