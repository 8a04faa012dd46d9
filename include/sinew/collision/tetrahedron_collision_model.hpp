// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/collision/collision_model.hpp>
#include <sinew/collision/surface_elements.hpp>

namespace sinew {

/// The tetrahedra of the topology as a solid that collides: its surface is met as that of a
/// TriangleCollisionModel is, and points and spheres whose centres are in it are pushed out to the nearest
/// place on it, however deep they are, whatever the intersection method. SOFA tests tetrahedra only by
/// DiscreteIntersection, against points, which it pushes out of one tetrahedron along their own normals.
template <class D>
struct TetrahedronCollisionModel {
  using Role = role::CollisionModel;
  using DataTypes = D;
  static_assert(D::spatial == 3 && !D::rigid,
                "Sinew: a TetrahedronCollisionModel is over points in space; take Vec3d or Vec3f.");
  static constexpr std::string_view className = "TetrahedronCollisionModel";
  static constexpr std::string_view aliases = "TetrahedronModel";
  static constexpr Shape shape = Shape::triangle;

  bool active = true, moving = true, simulated = true, selfCollision = false, bothSide = false;
  std::vector<int> group{};
  double proximity = 0, contactStiffness = 10, contactFriction = 0, contactDamping = 0;
  std::string contactResponse{};

  static constexpr auto fields() { return collision_model_fields<TetrahedronCollisionModel>(); }

  CollisionSurface surface{};

  /// Throws Error where there are no tetrahedra, unless all have been removed while the scene ran.
  void init(InitContext<D> const& context) {
    const bool hadSome = !surface.solid.empty();
    TopologyView solid;
    solid.tetrahedra = context.topology.tetrahedra;
    std::vector<Eigen::Vector3d> rest;
    for (auto const& x : context.rest) rest.push_back(x.template cast<double>());
    surface.elements = triangles_of(solid, rest);
    surface.solid.assign(solid.tetrahedra.begin(), solid.tetrahedra.end());
    describe_surface(*this, surface, context.where, rest.size());
    if (surface.solid.empty() && !hadSome && !context.topology.grows)
      throw Error(
          text(context.where, ": ", component_name<TetrahedronCollisionModel>()),
          "there are no tetrahedra to collide with; give the node a topology that has some, or take a "
          "TriangleCollisionModel");
  }
};

}  // namespace sinew
