// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/core/mesh.hpp>
#include <sinew/topology/adjacency.hpp>
#include <sinew/topology/bcc_lattice.hpp>
#include <sinew/topology/implicit_surface.hpp>
#include <sinew/topology/isosurface_stuffing.hpp>

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <string_view>
#include <utility>
#include <vector>

namespace sinew {

namespace detail {

/// Newton steps along the gradient, x -= f grad f / |grad f|^2, to 1e-9 of `length`; the gradient is from
/// central differences. False where they do not converge within `length` of the start; x is then unchanged.
template <class Shape>
bool project_to_surface(std::string_view where, Shape const& shape, double length, Eigen::Vector3d& x) {
  Eigen::Vector3d y = x;
  for (int iteration = 0; iteration < 12; ++iteration) {
    const double f = finite_value(where, shape, y), step = 1e-4 * length;
    Eigen::Vector3d gradient;
    for (int i = 0; i < 3; ++i) {
      const Eigen::Vector3d offset = step * Eigen::Vector3d::Unit(i);
      gradient[i] =
          (finite_value(where, shape, y + offset) - finite_value(where, shape, y - offset)) / (2 * step);
    }
    const double squared = gradient.squaredNorm();
    if (!(squared > 0)) return false;
    if (std::abs(f) <= 1e-9 * length * std::sqrt(squared)) {
      x = y;
      return true;
    }
    y -= f / squared * gradient;
    if (!((y - x).norm() < length)) return false;
  }
  return false;
}

/// Moves each point to the middle of its neighbours and back onto the surface, where that enlarges the
/// smallest angle of the triangles around it and rotates none of them by 60 degrees or more. Sequential, so
/// deterministic.
template <class Shape>
void smooth_surface(std::string_view where, Shape const& shape, double spacing, int sweeps, Mesh& mesh) {
  const Adjacency around = elements_around(mesh.triangles, mesh.positions.size());
  const Adjacency nearby = neighbours(edges_of(mesh.triangles), mesh.positions.size());
  std::vector<Eigen::Vector3d> before, after;  // normals of the triangles around a point
  auto smallest_angle = [&](std::size_t i, std::vector<Eigen::Vector3d>& normals) {
    double cosine = -1;
    normals.clear();
    for (const Index e : around[i]) {
      Eigen::Vector3d x[3];
      for (std::size_t c = 0; c < 3; ++c)
        x[c] = mesh.positions[std::size_t(mesh.triangles[std::size_t(e)][c])];
      normals.push_back((x[1] - x[0]).cross(x[2] - x[0]).normalized());
      for (std::size_t c = 0; c < 3; ++c)
        cosine =
            std::max(cosine, (x[(c + 1) % 3] - x[c]).normalized().dot((x[(c + 2) % 3] - x[c]).normalized()));
    }
    return cosine;
  };
  for (int sweep = 0; sweep < sweeps; ++sweep)
    for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
      const Eigen::Vector3d old = mesh.positions[i];
      const double cosine = smallest_angle(i, before);
      Eigen::Vector3d middle = Eigen::Vector3d::Zero();
      for (const Index j : nearby[i]) middle += mesh.positions[std::size_t(j)] / double(nearby[i].size());
      if (!project_to_surface(where, shape, spacing, middle)) continue;
      mesh.positions[i] = middle;
      bool better = smallest_angle(i, after) < cosine;
      for (std::size_t k = 0; k < after.size(); ++k) better = better && after[k].dot(before[k]) > 0.5;
      if (!better) mesh.positions[i] = old;
    }
}

}  // namespace detail

/// The faces of a mesh's tetrahedra that belong to one tetrahedron only, outwards, with the points that they
/// use. Throws Error as boundary_triangles() and check_mesh() do.
inline Mesh boundary_surface(Mesh const& volume) {
  Mesh skin;
  skin.positions = volume.positions;
  skin.triangles = boundary_triangles(volume.tetrahedra);
  remove_unused_points(skin);
  return skin;
}

/// The surface shape(p) = 0 in the box as triangles with their front outwards: the boundary of the isosurface
/// stuffing (see tetrahedralize()) with its points evened out over the surface. It is a closed manifold
/// whatever the spacing; of several bodies the largest remains. Triangle sides are near spacing / sqrt(2)
/// long. Points are on the surface to 1e-6 spacing, except where the body is thinner than the spacing. Throws
/// Error as tetrahedralize() does.
template <ImplicitShape Shape>
Mesh surface(Shape const& shape, Eigen::Vector3d const& lo, Eigen::Vector3d const& hi, double spacing) {
  const std::string_view where = "surface";
  const detail::BccLattice lattice = detail::warped_bcc_lattice(where, shape, lo, hi, spacing);
  Mesh mesh;
  mesh.triangles = boundary_triangles(detail::stuff(lattice, true));
  // towards the tetrahedra left out there are faces with inside points; the boundary has none
  std::erase_if(mesh.triangles, [&](Triangle const& t) {
    return std::any_of(
        t.begin(), t.end(), [&](Index i) { return i < lattice.size() && lattice.label[std::size_t(i)] > 0; });
  });
  detail::check_not_empty(where, mesh.triangles.size(), spacing);
  mesh.positions = detail::place_points(lattice, mesh.triangles);
  detail::smooth_surface(where, shape, spacing, 4, mesh);
  return mesh;
}

}  // namespace sinew
