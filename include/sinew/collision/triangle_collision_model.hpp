// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/collision/collision_model.hpp>
#include <sinew/collision/surface_elements.hpp>

namespace sinew {

/// The triangles of the topology, quads as two; or of the surface of its volume.
template <class D>
struct TriangleCollisionModel {
  using Role = role::CollisionModel;
  using DataTypes = D;
  static_assert(D::spatial == 3,
                "Sinew: collision models are in space; take Vec3d, Vec3f, Rigid3d or Rigid3f.");
  static constexpr std::string_view className = "TriangleCollisionModel";
  static constexpr std::string_view aliases =
      "Triangle TriangleModel TriangleMeshModel TriangleSetModel TTriangleModel";
  static constexpr int corners = 3;

  bool active = true, moving = true, simulated = true, selfCollision = false, bothSide = false;
  std::vector<int> group{};
  double proximity = 0, contactStiffness = 10, contactFriction = 0, contactDamping = 0;
  std::string contactResponse{};

  static constexpr auto fields() { return collision_model_fields<TriangleCollisionModel>(); }

  CollisionSurface surface{};

  void init(InitContext<D> const& context) {
    std::vector<Eigen::Vector3d> rest;
    for (auto const& x : context.rest) rest.push_back(D::center(x).template cast<double>());
    surface.elements = triangles_of(context.topology, rest);
    surface.radius.clear();
    describe_surface(*this, surface, context.where, context.rest.size());
    if (surface.elements.empty())
      throw Error(
          context.where,
          text(component_name<TriangleCollisionModel>(),
               ": there is no triangle to collide with; give the node points, or a topology that has some"));
  }
};

}  // namespace sinew
