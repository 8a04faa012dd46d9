// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/engine/roi.hpp>
#include <sinew/topology/ray_triangle.hpp>

namespace sinew {

/// What is inside a closed surface of triangles: a ray from there meets it an odd number of times. Elements
/// of which all points are inside are chosen, and with `strict` off those whose mean is.
template <class D>
struct MeshROI {
  using Role = role::Engine;
  using DataTypes = D;
  static_assert(D::spatial == 3, "MeshROI is a region of space");
  static constexpr std::string_view className = "MeshROI";

  std::vector<Eigen::Vector3d> ROIposition{};
  std::vector<Triangle> ROItriangles{};
  bool computeMeshROI = true;
  typename D::VecCoord position{};
  std::vector<Edge> edges{};
  std::vector<Triangle> triangles{};
  std::vector<Quad> quads{};
  std::vector<Tetrahedron> tetrahedra{};
  std::vector<Hexahedron> hexahedra{};
  bool strict = false;
  bool computeEdges = true, computeTriangles = true, computeQuad = true, computeTetrahedra = true,
       computeHexahedra = true;

  static constexpr auto fields() {
    using R = MeshROI;
    return roi_fields<R>(
        field("ROIposition", &R::ROIposition, "m", "points of the surface"),
        field("ROItriangles", &R::ROItriangles, "", "triangles of the surface", range::nonNegative),
        field("computeMeshROI", &R::computeMeshROI, "", "whether the surface counts; else all is inside"));
  }

  // after update
  std::vector<int> indices{}, edgeIndices{}, triangleIndices{}, quadIndices{}, tetrahedronIndices{},
      hexahedronIndices{};
  typename D::VecCoord pointsInROI{};
  std::vector<Edge> edgesInROI{};
  std::vector<Triangle> trianglesInROI{};
  std::vector<Quad> quadInROI{};
  std::vector<Tetrahedron> tetrahedraInROI{};
  std::vector<Hexahedron> hexahedraInROI{};
  std::vector<int> indicesOut{};
  int nbIndices = 0;

  static constexpr auto outputs() { return roi_outputs<MeshROI>(); }

  /// Throws Error when there are no points, there is no surface, or an element refers to a missing point; the
  /// outputs then stay.
  void update(std::string_view where) {
    check_fields(*this, where);
    const std::string at = text(where, ": ", component_name<MeshROI>());
    if (computeMeshROI && ROItriangles.empty())
      throw Error(at, "ROItriangles is empty; link it to the triangles of a closed surface");
    detail::check_indices(at, "triangle of the surface:", ROItriangles, ROIposition.size());
    Eigen::Vector3d low = Eigen::Vector3d::Zero(), high = low;
    if (!ROIposition.empty()) low = high = ROIposition[0];
    for (auto const& x : ROIposition) low = low.cwiseMin(x), high = high.cwiseMax(x);
    select_in_roi(*this, at, [&](auto const& place) {
      if (!computeMeshROI) return true;
      const Eigen::Vector3d p = place;
      if ((p.array() < low.array()).any() || (p.array() > high.array()).any()) return false;
      // away from the middle, to beyond the nearer corner of the box around the surface
      const bool lower = (p - low).squaredNorm() < (p - high).squaredNorm();
      const Eigen::Vector3d away = lower ? (low - Eigen::Vector3d::Constant(100) - p).eval()
                                         : (high + Eigen::Vector3d::Constant(100) - p).eval();
      int through = 0;
      for (auto const& [a, b, c] : ROItriangles) {
        auto x = [&](Index i) -> Eigen::Vector3d const& { return ROIposition[std::size_t(i)]; };
        const auto t = line_meets_triangle(p, away, x(a), x(b), x(c));
        through += t && *t >= 0;
      }
      return through % 2 == 1;
    });
  }
};

}  // namespace sinew
