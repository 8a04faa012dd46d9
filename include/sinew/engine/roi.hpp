// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/core/compiled.hpp>
#include <sinew/core/component.hpp>

#include <vector>

namespace sinew {

// What the regions of interest share. A region chooses among its points, and among its elements: with
// `strict` those of which it holds all points, else those of which it holds the mean of the points.

/// Whether a box of two opposite corners, x y z each [m], holds a place, its surface included.
template <int N>
bool box_holds(Vec<double, 6> const& box, Vec<double, N> const& place) {
  const Vec<double, N> a = box.template head<N>(), b = box.template segment<N>(3);
  return (place.array() >= a.cwiseMin(b).array()).all() && (place.array() <= a.cwiseMax(b).array()).all();
}

/// The fields of a region: first its own, which say where it is.
template <class R, class... Own>
constexpr auto roi_fields(Own... own) {
  return field_list(
      own...,
      field("position", &R::position, "m", "points to choose from").also("rest_position"),
      field("edges", &R::edges, "", "edges to choose from", range::nonNegative),
      field("triangles", &R::triangles, "", "triangles to choose from", range::nonNegative),
      field("quads", &R::quads, "", "quads to choose from", range::nonNegative).also("quad"),
      field("tetrahedra", &R::tetrahedra, "", "tetrahedra to choose from", range::nonNegative).also("tetras"),
      field("hexahedra", &R::hexahedra, "", "hexahedra to choose from", range::nonNegative).also("hexas"),
      field("strict",
            &R::strict,
            "",
            "whether an element must be inside with all its points, or only with their mean"),
      field("computeEdges", &R::computeEdges, "", "whether edges are chosen"),
      field("computeTriangles", &R::computeTriangles, "", "whether triangles are chosen"),
      field("computeQuad", &R::computeQuad, "", "whether quads are chosen"),
      field("computeTetrahedra", &R::computeTetrahedra, "", "whether tetrahedra are chosen"),
      field("computeHexahedra", &R::computeHexahedra, "", "whether hexahedra are chosen"));
}

template <class R>
constexpr auto roi_outputs() {
  return field_list(field("indices", &R::indices, "", "the points inside").also("pointIndices"),
                    field("edgeIndices", &R::edgeIndices, "", "the edges inside"),
                    field("triangleIndices", &R::triangleIndices, "", "the triangles inside"),
                    field("quadIndices", &R::quadIndices, "", "the quads inside"),
                    field("tetrahedronIndices", &R::tetrahedronIndices, "", "the tetrahedra inside"),
                    field("hexahedronIndices", &R::hexahedronIndices, "", "the hexahedra inside"),
                    field("pointsInROI", &R::pointsInROI, "m", "positions of the points inside"),
                    field("edgesInROI", &R::edgesInROI, "", "points of the edges inside"),
                    field("trianglesInROI", &R::trianglesInROI, "", "points of the triangles inside"),
                    field("quadInROI", &R::quadInROI, "", "points of the quads inside").also("quadsInROI"),
                    field("tetrahedraInROI", &R::tetrahedraInROI, "", "points of the tetrahedra inside"),
                    field("hexahedraInROI", &R::hexahedraInROI, "", "points of the hexahedra inside"),
                    field("indicesOut", &R::indicesOut, "", "the points outside"),
                    field("nbIndices", &R::nbIndices, "", "number of points inside"));
}

/// Fills the outputs of a region: inside(place) tells of a place [m] whether the region holds it. Throws
/// Error when there are no points, or an element refers to a missing one; the outputs then stay.
template <class R, class Inside>
void select_in_roi(R& roi, std::string const& where, Inside const& inside) {
  using D = typename R::DataTypes;
  using Place = Vec<double, D::spatial>;
  const std::size_t n = roi.position.size();
  if (n == 0) throw Error(where, "position is empty; link it to the points of a loader, topology or state");
  detail::check_elements(where, roi, n);

  auto place = [&](std::size_t i) -> Place { return D::center(roi.position[i]).template cast<double>(); };
  std::vector<bool> in(n);
  roi.indices.clear(), roi.indicesOut.clear(), roi.pointsInROI.clear();
  for (std::size_t i = 0; i < n; ++i) {
    in[i] = inside(place(i));
    (in[i] ? roi.indices : roi.indicesOut).push_back(int(i));
    if (in[i]) roi.pointsInROI.push_back(roi.position[i]);
  }
  roi.nbIndices = int(roi.indices.size());

  auto choose = [&](bool wanted, auto const& elements, std::vector<int>& numbers, auto& chosen) {
    numbers.clear(), chosen.clear();
    for (std::size_t e = 0; wanted && e < elements.size(); ++e) {
      bool all = true;
      Place mean = Place::Zero();
      for (const Index i : elements[e]) {
        all = all && in[std::size_t(i)];
        mean += place(std::size_t(i)) / double(elements[e].size());
      }
      if (roi.strict ? !all : !inside(mean)) continue;
      numbers.push_back(int(e));
      chosen.push_back(elements[e]);
    }
  };
  choose(roi.computeEdges, roi.edges, roi.edgeIndices, roi.edgesInROI);
  choose(roi.computeTriangles, roi.triangles, roi.triangleIndices, roi.trianglesInROI);
  choose(roi.computeQuad, roi.quads, roi.quadIndices, roi.quadInROI);
  choose(roi.computeTetrahedra, roi.tetrahedra, roi.tetrahedronIndices, roi.tetrahedraInROI);
  choose(roi.computeHexahedra, roi.hexahedra, roi.hexahedronIndices, roi.hexahedraInROI);
}

/// A parallelogram with corners p0, p1, p2 and p0 + p2 - p1, thickened by half its depth on both sides: ten
/// numbers, those of the points and the depth [m]. A billionth of a side is allowed for rounding. One that
/// may be a `plane` is, without depth, the whole plane, as in SOFA.
struct OrientedBox {
  Eigen::Vector3d p0;
  Eigen::Matrix3d inverse;
  bool endless = false;  // in its plane

  OrientedBox(std::string const& where, Vec<double, 10> const& box, bool plane = false);
  bool contains(Eigen::Vector3d const& p) const {
    const Eigen::Vector3d t = inverse * (p - p0) + Eigen::Vector3d(0, 0, 0.5);
    if (endless) return t[2] >= 0 && t[2] <= 1;
    return t.minCoeff() >= -1e-9 && t.maxCoeff() <= 1 + 1e-9;
  }
};

}  // namespace sinew

#if SINEW_DEFINES
#include <Eigen/LU>

#include <algorithm>

namespace sinew {

SINEW_ONCE OrientedBox::OrientedBox(std::string const& where, Vec<double, 10> const& box, bool plane)
    : p0(box[0], box[1], box[2]), endless(plane && box[9] == 0) {
  Eigen::Matrix3d sides;
  Eigen::Vector3d a, b;
  for (int k = 0; k < 3; ++k) a[k] = box[3 + k] - box[k], b[k] = box[6 + k] - box[3 + k];
  const Eigen::Vector3d normal = a.cross(b);
  if (!(normal.norm() > 1e-12 * a.norm() * b.norm()))
    throw Error(where,
                "the three points of a box are on a line, or two are in one place; give a parallelogram");
  if (!(box[9] > 0) && !endless)
    throw Error(
        where,
        text("the depth of a box is ", box[9], ", but must be ", plane ? "0 or " : "", "greater than 0"));
  const double depth = endless ? 2e-9 * std::max(a.norm(), b.norm()) : box[9];
  sides.col(0) = a, sides.col(1) = b, sides.col(2) = normal.normalized() * depth;
  inverse = sides.inverse();
}

}  // namespace sinew
#endif
