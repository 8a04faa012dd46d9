// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/engine/roi.hpp>

namespace sinew {

/// The points and elements near pieces of planes: in parallelograms of some thickness. One without thickness
/// is the whole plane, as in SOFA.
template <class D>
struct PlaneROI {
  using Role = role::Engine;
  using DataTypes = D;
  static constexpr std::string_view className = "PlaneROI";
  static_assert(D::spatial == 3, "PlaneROI chooses points in space");

  std::vector<Vec<double, 10>> plane{};
  typename D::VecCoord position{};
  std::vector<Edge> edges{};
  std::vector<Triangle> triangles{};
  std::vector<Quad> quads{};
  std::vector<Tetrahedron> tetrahedra{};
  std::vector<Hexahedron> hexahedra{};
  bool strict = true, computeEdges = true, computeTriangles = true, computeQuad = true,
       computeTetrahedra = true, computeHexahedra = true;

  static constexpr auto fields() {
    return roi_fields<PlaneROI>(
        field("plane",
              &PlaneROI::plane,
              "m",
              "three corners of a parallelogram each, and its thickness: p0 p1 p2 depth"));
  }

  // after update
  std::vector<int> indices{}, edgeIndices{}, triangleIndices{}, quadIndices{}, tetrahedronIndices{},
      hexahedronIndices{}, indicesOut{};
  typename D::VecCoord pointsInROI{};
  std::vector<Edge> edgesInROI{};
  std::vector<Triangle> trianglesInROI{};
  std::vector<Quad> quadInROI{};
  std::vector<Tetrahedron> tetrahedraInROI{};
  std::vector<Hexahedron> hexahedraInROI{};
  int nbIndices = 0;

  static constexpr auto outputs() { return roi_outputs<PlaneROI>(); }

  /// Throws Error when there is no plane or no point, the corners of one are on a line, or an element refers
  /// to a missing point.
  void update(std::string_view where) {
    check_fields(*this, where);
    const std::string at = text(where, ": ", component_name<PlaneROI>());
    if (plane.empty()) throw Error(at, "there is no plane; give three points and a depth");
    std::vector<OrientedBox> boxes;
    for (auto const& b : plane) boxes.emplace_back(at, b, true);
    select_in_roi(*this, at, [&](Eigen::Vector3d const& p) {
      for (auto const& b : boxes)
        if (b.contains(p)) return true;
      return false;
    });
  }
};

}  // namespace sinew
