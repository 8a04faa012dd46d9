// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/engine/roi.hpp>

namespace sinew {

/// The points and elements in boxes, their faces included: along the axes, or oriented.
template <class D>
struct BoxROI {
  using Role = role::Engine;
  using DataTypes = D;
  static constexpr std::string_view className = "BoxROI";
  static constexpr std::string_view aliases = "BoxRoi";

  std::vector<Vec<double, 6>> box{};
  std::vector<Vec<double, 10>> orientedBox{};
  typename D::VecCoord position{};
  std::vector<Edge> edges{};
  std::vector<Triangle> triangles{};
  std::vector<Quad> quads{};
  std::vector<Tetrahedron> tetrahedra{};
  std::vector<Hexahedron> hexahedra{};
  bool strict = true, computeEdges = true, computeTriangles = true, computeQuad = true,
       computeTetrahedra = true, computeHexahedra = true;

  static constexpr auto fields() {
    return roi_fields<BoxROI>(
        field("box", &BoxROI::box, "m", "two opposite corners each: xmin ymin zmin xmax ymax zmax"),
        field("orientedBox",
              &BoxROI::orientedBox,
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

  static constexpr auto outputs() { return roi_outputs<BoxROI>(); }

  /// Throws Error when there is no box or no point, an oriented box is flat, or an element refers to a
  /// missing point.
  void update(std::string_view where) {
    check_fields(*this, where);
    const std::string at = text(where, ": ", component_name<BoxROI>());
    if (box.empty() && orientedBox.empty()) throw Error(at, "there is no box; give box or orientedBox");
    if (!orientedBox.empty() && D::spatial != 3)
      throw Error(at, "orientedBox is for points in space; give box");
    std::vector<OrientedBox> oriented;
    for (auto const& b : orientedBox) oriented.emplace_back(at, b);
    select_in_roi(*this, at, [&](Vec<double, D::spatial> const& p) {
      for (auto const& b : box)
        if (box_holds<D::spatial>(b, p)) return true;
      if constexpr (D::spatial == 3)
        for (auto const& b : oriented)
          if (b.contains(p)) return true;
      return false;
    });
  }
};

}  // namespace sinew
