// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/collision/collision_model.hpp>
#include <sinew/collision/surface_elements.hpp>

namespace sinew {

/// A sphere around each point of the state that collides, with a radius of its own or one for all.
template <class D>
struct SphereCollisionModel {
  using Role = role::CollisionModel;
  using DataTypes = D;
  static_assert(D::spatial == 3,
                "Sinew: collision models are in space; take Vec3d, Vec3f, Rigid3d or Rigid3f.");
  static constexpr std::string_view className = "SphereCollisionModel";
  static constexpr std::string_view aliases = "Sphere SphereModel TSphereModel";
  static constexpr Shape shape = Shape::sphere;

  bool active = true, moving = true, simulated = true, selfCollision = false, bothSide = true;
  std::vector<int> group{};
  double proximity = 0, contactStiffness = 10, contactFriction = 0, contactDamping = 0;
  std::string contactResponse{};
  double radius = 1;
  std::vector<double> listRadius{};

  static constexpr auto fields() {
    using M = SphereCollisionModel;
    return collision_model_fields<M>(
        field("radius", &M::radius, "m", "radius of all spheres", range::positive),
        field("listRadius",
              &M::listRadius,
              "m",
              "radius of each sphere, instead; the last ones without have `radius`",
              range::positive)
            .oneEach(Of::points));
  }

  CollisionSurface surface{};

  void init(InitContext<D> const& context) {
    const std::size_t n = context.rest.size();
    fill_up(listRadius,
            n,
            radius,
            "listRadius",
            "points",
            text(context.where, ": ", component_name<SphereCollisionModel>()));
    surface.elements = points_of(context.topology, n);
    surface.radius = listRadius;
    if (surface.radius.empty()) surface.radius.assign(n, radius);
    describe_surface(*this, surface, context.where, n);
  }
};

}  // namespace sinew
