// SPDX-License-Identifier: BSL-1.0
#pragma once

// Needs libccd (Debian: libccd-dev). Not in sinew.hpp; CMake's target sinew::ccd, there where libccd is
// installed, brings it.
#include <sinew/collision/collision_model.hpp>
#include <sinew/collision/hull_contacts.hpp>
#include <sinew/collision/hull_ray.hpp>
#include <sinew/collision/surface_elements.hpp>
#include <sinew/topology/shape_file.hpp>

namespace sinew {

/// The convex hull of points in the axes of a rigid, around each rigid of the state. Points inside do no harm
/// but cost time. In one plane or on one line they are a plate or a needle, which has two sides. Scene files
/// have it where the library sinew::standard was built with libccd; elsewhere it stands in a registry of
/// one's own: struct Mine : Registry<Standard, ConvexCollisionModel<Rigid3d>> {};
template <class D>
struct ConvexCollisionModel {
  using Role = role::CollisionModel;
  using DataTypes = D;
  static_assert(D::spatial == 3 && D::rigid,
                "Sinew: a ConvexCollisionModel is the hull of points in the axes of a rigid in space; take "
                "Rigid3d or Rigid3f.");
  static constexpr std::string_view className = "ConvexCollisionModel";
  // of SOFA's plugin for Bullet
  static constexpr std::string_view aliases =
      "TBulletConvexHullModel BulletConvexHullModel BtConvexHullModel BulletConvexHull BtConvexHull";
  static constexpr std::string_view header = "sinew/collision/convex_collision_model.hpp";
  static constexpr Shape shape = Shape::hull;

  bool active = true, moving = true, simulated = true, selfCollision = false, bothSide = true;
  std::vector<int> group{};
  double proximity = 0, contactStiffness = 10, contactFriction = 0, contactDamping = 0;
  std::string contactResponse{};
  std::vector<Eigen::Vector3d> points{};
  DataFile filename{};

  static constexpr auto fields() {
    using M = ConvexCollisionModel;
    return collision_model_fields<M>(
        field("points", &M::points, "m", "points of the hull, in the axes of the rigid")
            .also("position CHPoints"),
        field("filename",
              &M::filename,
              "",
              "a mesh (.msh, .obj, .stl, .ply, .vtk) whose points they are, instead"));
  }

  CollisionSurface surface{};

  /// Throws Error where there are no points, where both are given, and where the file cannot be read.
  void init(InitContext<D> const& context) {
    const std::string where = text(context.where, ": ", component_name<ConvexCollisionModel>());
    if (!points.empty() && !filename.path.empty())
      throw Error(where, "points and filename are both given; give one of them");
    if (points.empty() && filename.path.empty())
      throw Error(where, "there are no points to make a hull of; give points, or the filename of a mesh");
    std::vector<Eigen::Vector3d> all = points;
    if (!filename.path.empty()) try {
        all = points_in_file(filename.path);
      } catch (Error const& error) {
        throw Error(where, error.what());
      }
    surface.hulls.assign(1, ConvexHull(std::move(all), where));
    surface.elements = points_of(context.topology, context.rest.size());
    describe_surface(*this, surface, context.where, context.rest.size());
  }
};

}  // namespace sinew
