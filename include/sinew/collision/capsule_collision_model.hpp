// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/collision/collision_model.hpp>
#include <sinew/collision/surface_elements.hpp>

namespace sinew {

/// Capsules: what is within a radius of a segment. On points the edges of the topology are the segments, or
/// those of its triangles; on rigids each has one along its own y axis, around its centre. Where capsules of
/// one state share a point, the thickest one has it. Those of rigids need libccd, and scene files have them
/// where the library sinew::standard was built with it.
template <class D>
struct CapsuleCollisionModel {
  using Role = role::CollisionModel;
  using DataTypes = D;
  static_assert(D::spatial == 3,
                "Sinew: collision models are in space; take Vec3d, Vec3f, Rigid3d or Rigid3f.");
  static_assert(!D::rigid,
                "Sinew: capsules of rigids are in a header of their own, since they need libccd; include "
                "<sinew/collision/rigid_capsule_collision_model.hpp>.");
  static constexpr std::string_view className = "CapsuleCollisionModel";
  static constexpr std::string_view aliases = "CapsuleModel TCapsuleModel Capsule";
  static constexpr Shape shape = Shape::capsule;

  bool active = true, moving = true, simulated = true, selfCollision = false, bothSide = true;
  std::vector<int> group{};
  double proximity = 0, contactStiffness = 10, contactFriction = 0, contactDamping = 0;
  std::string contactResponse{};
  double defaultRadius = 0.5;
  std::vector<double> listCapsuleRadii{};

  static constexpr auto fields() {
    using M = CapsuleCollisionModel;
    return collision_model_fields<M>(
        field("defaultRadius", &M::defaultRadius, "m", "radius of all capsules", range::positive),
        field("listCapsuleRadii",
              &M::listCapsuleRadii,
              "m",
              "radius of each capsule, in the order of the edges, instead; the last ones without have "
              "`defaultRadius`",
              range::positive)
            .oneEach(Of::edges));
  }

  CollisionSurface surface{};

  /// Throws Error where there are no edges, or more radii than edges.
  void init(InitContext<D> const& context) {
    const std::string where = text(context.where, ": ", component_name<CapsuleCollisionModel>());
    surface.elements = lines_of(context.topology);
    const std::size_t n = surface.elements.size();
    if (n == 0 && !context.topology.grows)
      throw Error(
          where,
          "there are no edges to put capsules around; give the node a topology that has some, such as "
          "a MeshTopology with edges=\"0 1\"");
    fill_up(listCapsuleRadii, n, defaultRadius, "listCapsuleRadii", "edges", where);
    surface.radius.clear();
    for (std::size_t i = 0; i < n; ++i) surface.radius.push_back(each_or(listCapsuleRadii, i, defaultRadius));
    describe_surface(*this, surface, context.where, context.rest.size());
  }
};

}  // namespace sinew
