// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/engine/roi.hpp>

namespace sinew {

/// The points and elements in spheres, their surfaces included.
template <class D>
struct SphereROI {
  using Role = role::Engine;
  using DataTypes = D;
  static constexpr std::string_view className = "SphereROI";

  std::vector<Eigen::Vector3d> centers{};
  std::vector<double> radii{};
  typename D::VecCoord position{};
  std::vector<Edge> edges{};
  std::vector<Triangle> triangles{};
  std::vector<Quad> quads{};
  std::vector<Tetrahedron> tetrahedra{};
  std::vector<Hexahedron> hexahedra{};
  bool strict = true, computeEdges = true, computeTriangles = true, computeQuad = true,
       computeTetrahedra = true, computeHexahedra = true;

  static constexpr auto fields() {
    return roi_fields<SphereROI>(
        field("centers", &SphereROI::centers, "m", "where the spheres are"),
        field("radii", &SphereROI::radii, "m", "one for all spheres, or one each", range::nonNegative));
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

  static constexpr auto outputs() { return roi_outputs<SphereROI>(); }

  /// Throws Error when there is no sphere or no point, radii are missing, or an element refers to a missing
  /// point.
  void update(std::string_view where) {
    check_fields(*this, where);
    const std::string at = text(where, ": ", component_name<SphereROI>());
    if (centers.empty()) throw Error(at, "there is no sphere; give centers and radii");
    if (radii.size() != 1 && radii.size() != centers.size())
      throw Error(at,
                  text("radii has ",
                       radii.size(),
                       " values for ",
                       centers.size(),
                       " centers; give one value, or one for each"));
    select_in_roi(*this, at, [&](Vec<double, D::spatial> const& p) {
      for (std::size_t i = 0; i < centers.size(); ++i)
        if ((p - centers[i].head<D::spatial>()).norm() <= radii[radii.size() == 1 ? 0 : i]) return true;
      return false;
    });
  }
};

}  // namespace sinew
