// SPDX-License-Identifier: BSL-1.0
#pragma once

// Needs libccd (Debian: libccd-dev). Not in sinew.hpp; CMake's target sinew::ccd, there where libccd is
// installed, brings it.
#include <sinew/collision/collision_model.hpp>
#include <sinew/collision/hull_contacts.hpp>
#include <sinew/collision/hull_ray.hpp>
#include <sinew/collision/surface_elements.hpp>

namespace sinew {

/// A box around the centre of each rigid, along its axes. What touches a face is up to 8 contacts, as of
/// other hulls; how deep boxes, capsules, lines and triangles are in one another is known in closed form.
/// Scene files have it where the library sinew::standard was built with libccd.
template <class D>
struct OBBCollisionModel {
  using Role = role::CollisionModel;
  using DataTypes = D;
  static_assert(
      D::spatial == 3 && D::rigid,
      "Sinew: an OBBCollisionModel is boxes in the axes of rigids in space; take Rigid3d or Rigid3f.");
  static constexpr std::string_view className = "OBBCollisionModel";
  static constexpr std::string_view aliases = "OBBModel TOBBModel OBB";
  static constexpr std::string_view header = "sinew/collision/obb_collision_model.hpp";
  static constexpr Shape shape = Shape::hull;

  bool active = true, moving = true, simulated = true, selfCollision = false, bothSide = true;
  std::vector<int> group{};
  double proximity = 0, contactStiffness = 10, contactFriction = 0, contactDamping = 0;
  std::string contactResponse{};
  double defaultExtent = 1;
  std::vector<Eigen::Vector3d> extents{};

  static constexpr auto fields() {
    using M = OBBCollisionModel;
    return collision_model_fields<M>(
        field("defaultExtent", &M::defaultExtent, "m", "half of each side of all boxes", range::positive),
        field("extents",
              &M::extents,
              "m",
              "half of the sides of each box along its x, y and z axis, instead; the last ones without are "
              "cubes by `defaultExtent`",
              range::positive)
            .oneEach(Of::points));
  }

  CollisionSurface surface{};

  /// Throws Error where there are more extents than rigids.
  void init(InitContext<D> const& context) {
    const std::string where = text(context.where, ": ", component_name<OBBCollisionModel>());
    const std::size_t n = context.rest.size();
    const Eigen::Vector3d all = Eigen::Vector3d::Constant(defaultExtent);
    fill_up(extents, n, all, "extents", "rigids", where);
    surface.elements = points_of(context.topology, n);
    surface.hulls.clear();
    for (std::size_t i = 0; i < n; ++i)
      surface.hulls.push_back(ConvexHull::box(each_or(extents, i, all), where));
    describe_surface(*this, surface, context.where, n);
  }
};

}  // namespace sinew
