// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/collision/collision_model.hpp>
#include <sinew/collision/distance_grid.hpp>
#include <sinew/collision/surface_elements.hpp>
#include <sinew/core/placement.hpp>
#include <sinew/topology/shape_file.hpp>

#include <memory>

namespace sinew {

/// A closed surface around each rigid of the state, as a grid of the distances to it: points, spheres,
/// capsules, lines and triangles meet it wherever they are, however deep, at the cost of looking up a
/// distance. A line or triangle has a contact at each corner, and one inside where it is nearest or deepest;
/// so a body that lies flat on few large triangles stands on one contact each, and is better met by its
/// points, as those of a PointCollisionModel below it. Two grids meet by the points on their surfaces.
/// Contacts are found where the step starts, also under a continuous method; convex hulls are not met.
template <class D>
struct RigidDistanceGridCollisionModel {
  using Role = role::CollisionModel;
  using DataTypes = D;
  static_assert(D::spatial == 3 && D::rigid,
                "Sinew: a RigidDistanceGridCollisionModel is around the rigids of a state in space; take "
                "Rigid3d or Rigid3f.");
  static constexpr std::string_view className = "RigidDistanceGridCollisionModel";
  static constexpr std::string_view aliases =
      "DistanceGridCollisionModel RigidDistanceGrid DistanceGrid RigidDistanceGridModel";
  static constexpr Shape shape = Shape::point;

  bool active = true, moving = true, simulated = true, selfCollision = false, bothSide = true;
  std::vector<int> group{};
  double proximity = 0, contactStiffness = 10, contactFriction = 0, contactDamping = 0;
  std::string contactResponse{};
  DataFile filename{};
  double scale = 1;
  Eigen::Vector3d translation{0, 0, 0}, rotation{0, 0, 0};
  std::vector<Eigen::Vector3d> box{};
  int nx = 64, ny = 64, nz = 64;
  bool usePoints = true, flipNormals = false;

  static constexpr auto fields() {
    using M = RigidDistanceGridCollisionModel;
    return collision_model_fields<M>(
        field("filename",
              &M::filename,
              "",
              "a mesh of a closed surface (.msh, .obj, .stl, .ply, .vtk), in the axes of the rigid; #cube: a "
              "cube of "
              "half side `scale`; #sphere: a ball of that radius")
            .also("fileRigidDistanceGrid"),
        field("scale", &M::scale, "", "factor of its size", range::positive),
        field("translation", &M::translation, "m", "moves it in the axes of the rigid"),
        field("rotation", &M::rotation, "degrees", "rotates it about the axes x, y and z, in this order"),
        field("box",
              &M::box,
              "m",
              "lowest and highest corner of the grid, in the axes of the rigid, which is made larger to hold "
              "the surface; "
              "none: the surface and a tenth of its size around it"),
        field("nx", &M::nx, "", "points of the grid along x", range::atLeast(2)),
        field("ny", &M::ny, "", "along y", range::atLeast(2)),
        field("nz", &M::nz, "", "along z", range::atLeast(2)),
        field("usePoints", &M::usePoints, "", "points of its surface meet other grids"),
        field(
            "flipNormals", &M::flipNormals, "", "the body is around the surface, which is met from inside"));
  }

  CollisionSurface surface{};

  /// Throws Error where there is no file, it cannot be read, or its surface is not closed.
  void init(InitContext<D> const& context) {
    const std::string where = text(context.where, ": ", component_name<RigidDistanceGridCollisionModel>());
    GridLayout layout{.n = {nx, ny, nz}};
    if (!box.empty()) {
      if (box.size() != 2)
        throw Error(where, text("box has ", box.size(), " corners; give the lowest and the highest one"));
      layout.box = {box[0], box[1]};
      if (layout.box.empty())
        throw Error(where, "box has a lowest corner beyond its highest one; exchange them");
    }
    const ShapeFrame frame{translation, rotation_of_degrees(rotation)};
    auto made = std::make_shared<DistanceGrid>([&] {
      if (filename.path.empty())
        throw Error(
            where,
            "there is no surface to be distant from; give the filename of a mesh, or #cube or #sphere");
      if (filename.path == "#cube") return grid_of_cube(where, scale, frame, layout);
      if (filename.path == "#sphere") return grid_of_ball(where, scale, frame, layout);
      if (filename.path[0] == '#')
        throw Error(
            where,
            text("'", filename.path, "' is none of the shapes #cube and #sphere; correct the filename"));
      try {
        Mesh mesh = surface_in_file(filename.path);
        const Placement placed = placement(translation, rotation, Eigen::Vector3d::Constant(scale));
        for (auto& p : mesh.positions) p = placed * p;
        return grid_of_surface(filename.path, mesh.positions, mesh.triangles, mesh.quads, layout);
      } catch (Error const& error) {
        throw Error(where, error.what());
      }
    }());
    if (flipNormals) made->flip();
    surface.grid = std::move(made);
    surface.gridPoints = usePoints;
    surface.elements = points_of(context.topology, context.rest.size());
    describe_surface(*this, surface, context.where, context.rest.size());
  }
};

}  // namespace sinew
