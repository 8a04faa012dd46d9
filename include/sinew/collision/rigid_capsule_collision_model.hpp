// SPDX-License-Identifier: BSL-1.0
#pragma once

// Needs libccd (Debian: libccd-dev). Not in sinew.hpp; CMake's target sinew::ccd, there where libccd is
// installed, brings it.
#include <sinew/collision/capsule_collision_model.hpp>
#include <sinew/collision/hull_contacts.hpp>
#include <sinew/collision/hull_ray.hpp>

namespace sinew {

/// Capsules of rigids: what is within a radius of a segment along the y axis of each rigid, around its
/// centre.
template <class D>
requires D::rigid
struct CapsuleCollisionModel<D> {
  using Role = role::CollisionModel;
  using DataTypes = D;
  static_assert(D::spatial == 3,
                "Sinew: collision models are in space; take Vec3d, Vec3f, Rigid3d or Rigid3f.");
  static constexpr std::string_view className = "CapsuleCollisionModel";
  static constexpr std::string_view aliases = "RigidCapsuleCollisionModel RigidCapsuleModel RigidCapsule";
  static constexpr std::string_view header = "sinew/collision/rigid_capsule_collision_model.hpp";
  static constexpr Shape shape = Shape::hull;

  bool active = true, moving = true, simulated = true, selfCollision = false, bothSide = true;
  std::vector<int> group{};
  double proximity = 0, contactStiffness = 10, contactFriction = 0, contactDamping = 0;
  std::string contactResponse{};
  double defaultRadius = 0.5, defaultHeight = 2;
  std::vector<double> radii{}, heights{};

  static constexpr auto fields() {
    using M = CapsuleCollisionModel;
    return collision_model_fields<M>(
        field("defaultRadius", &M::defaultRadius, "m", "radius of all capsules", range::positive),
        field("defaultHeight",
              &M::defaultHeight,
              "m",
              "length of the segments of all capsules, which are longer by two radii",
              range::nonNegative)
            .also("dafaultHeight"),  // as SOFA spells it
        field("radii",
              &M::radii,
              "m",
              "radius of each capsule, instead; the last ones without have `defaultRadius`",
              range::positive)
            .oneEach(Of::points),
        field("heights",
              &M::heights,
              "m",
              "length of the segment of each, instead; the last ones without have `defaultHeight`",
              range::nonNegative)
            .oneEach(Of::points));
  }

  CollisionSurface surface{};

  /// Throws Error where there are more radii or heights than rigids.
  void init(InitContext<D> const& context) {
    const std::string where = text(context.where, ": ", component_name<CapsuleCollisionModel>());
    const std::size_t n = context.rest.size();
    fill_up(radii, n, defaultRadius, "radii", "rigids", where);
    fill_up(heights, n, defaultHeight, "heights", "rigids", where);
    surface.elements = points_of(context.topology, n);
    surface.radius.clear();
    surface.hulls.clear();
    for (std::size_t i = 0; i < n; ++i) {
      const Eigen::Vector3d end(0, each_or(heights, i, defaultHeight) / 2, 0);
      surface.radius.push_back(each_or(radii, i, defaultRadius));
      surface.hulls.push_back(ConvexHull({-end, end}, where));
    }
    describe_surface(*this, surface, context.where, n);
  }
};

}  // namespace sinew
