// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/collision/collision_model.hpp>
#include <sinew/collision/surface_elements.hpp>

namespace sinew {

struct CollisionTriangles {
  static constexpr std::string_view className = "TriangleCollisionModel";
  static constexpr std::string_view aliases =
      "Triangle TriangleModel TriangleMeshModel TriangleSetModel TTriangleModel TriangleOctreeCollisionModel "
      "TriangleOctreeModel TriangleOctree";
  static constexpr std::string_view noun = "triangle";
  static constexpr Shape shape = Shape::triangle;

  template <class D>
  static std::vector<PrimitiveCorners> elements(InitContext<D> const& context) {
    std::vector<Eigen::Vector3d> rest;
    for (auto const& x : context.rest) rest.push_back(D::center(x).template cast<double>());
    return triangles_of(context.topology, rest);
  }
};

/// The triangles of the topology, and its quads as two each, as a surface that collides; or of the surface of
/// its volume.
template <class D>
using TriangleCollisionModel = MeshCollisionModel<D, CollisionTriangles>;

}  // namespace sinew
