// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/collision/collision_model.hpp>
#include <sinew/collision/surface_elements.hpp>

namespace sinew {

/// Each point of the state.
template <class D>
struct PointCollisionModel {
  using Role = role::CollisionModel;
  using DataTypes = D;
  static_assert(D::spatial == 3,
                "Sinew: collision models are in space; take Vec3d, Vec3f, Rigid3d or Rigid3f.");
  static constexpr std::string_view className = "PointCollisionModel";
  static constexpr std::string_view aliases = "Point PointModel PointMeshModel PointSetModel TPointModel";
  static constexpr int corners = 1;

  bool active = true, moving = true, simulated = true, selfCollision = false, bothSide = true;
  std::vector<int> group{};
  double proximity = 0, contactStiffness = 10, contactFriction = 0, contactDamping = 0;
  std::string contactResponse{};

  static constexpr auto fields() { return collision_model_fields<PointCollisionModel>(); }

  CollisionSurface surface{};

  void init(InitContext<D> const& context) {
    surface.elements = points_of(context.topology, context.rest.size());
    surface.radius.clear();
    describe_surface(*this, surface, context.where, context.rest.size());
    if (surface.elements.empty())
      throw Error(
          context.where,
          text(component_name<PointCollisionModel>(),
               ": there is no point to collide with; give the node points, or a topology that has some"));
  }
};

}  // namespace sinew
