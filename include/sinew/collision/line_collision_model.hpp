// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/collision/collision_model.hpp>
#include <sinew/collision/surface_elements.hpp>

namespace sinew {

/// The edges of the topology; of its faces, where it has no edges; or of the surface of its volume.
template <class D>
struct LineCollisionModel {
  using Role = role::CollisionModel;
  using DataTypes = D;
  static_assert(D::spatial == 3,
                "Sinew: collision models are in space; take Vec3d, Vec3f, Rigid3d or Rigid3f.");
  static constexpr std::string_view className = "LineCollisionModel";
  static constexpr std::string_view aliases = "Line LineModel LineMeshModel LineSetModel TLineModel";
  static constexpr int corners = 2;

  bool active = true, moving = true, simulated = true, selfCollision = false, bothSide = true;
  std::vector<int> group{};
  double proximity = 0, contactStiffness = 10, contactFriction = 0, contactDamping = 0;
  std::string contactResponse{};

  static constexpr auto fields() { return collision_model_fields<LineCollisionModel>(); }

  CollisionSurface surface{};

  void init(InitContext<D> const& context) {
    surface.elements = lines_of(context.topology, context.rest.size());
    surface.radius.clear();
    describe_surface(*this, surface, context.where, context.rest.size());
    if (surface.elements.empty())
      throw Error(
          context.where,
          text(component_name<LineCollisionModel>(),
               ": there is no line to collide with; give the node points, or a topology that has some"));
  }
};

}  // namespace sinew
