// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/core/compiled.hpp>
#include <sinew/core/component.hpp>

#include <vector>

namespace sinew {

/// A curve drawn out into a sheet of quads: its points move from -thicknessIn d on, in numberOfSections steps
/// of (thicknessIn + thicknessOut) / numberOfSections along the unit vector of d = extrudeDirection.
struct ExtrudeEdgesAndGenerateQuads {
  using Role = role::Engine;
  static constexpr std::string_view className = "ExtrudeEdgesAndGenerateQuads";

  Eigen::Vector3d extrudeDirection{1, 0, 0};
  double thicknessIn = 0, thicknessOut = 1;
  int numberOfSections = 1;
  std::vector<Eigen::Vector3d> curveVertices{};
  std::vector<Edge> curveEdges{};

  static constexpr auto fields() {
    using E = ExtrudeEdgesAndGenerateQuads;
    return field_list(
        field("extrudeDirection", &E::extrudeDirection, "", "along which the curve is drawn"),
        field("thicknessIn", &E::thicknessIn, "m", "against the direction, for one of length 1"),
        field("thicknessOut", &E::thicknessOut, "m", "along the direction"),
        field("numberOfSections", &E::numberOfSections, "", "steps", range::closed(1, 1 << 20)),
        field("curveVertices", &E::curveVertices, "m", "points of the curve"),
        field("curveEdges", &E::curveEdges, "", "edges of the curve", range::nonNegative));
  }

  // after update
  std::vector<Eigen::Vector3d> extrudedVertices{};
  std::vector<Edge> extrudedEdges{};
  std::vector<Quad> extrudedQuads{};

  static constexpr auto outputs() {
    using E = ExtrudeEdgesAndGenerateQuads;
    return field_list(
        field("extrudedVertices", &E::extrudedVertices, "m", "the points of the curve at each section"),
        field("extrudedEdges", &E::extrudedEdges, "", "of each edge: itself at each section, then its steps"),
        field("extrudedQuads", &E::extrudedQuads, "", "of each edge, section by section"));
  }

  /// Throws Error where there is no edge, or one refers to a missing point; the outputs then stay.
  void update(std::string_view where);
};

}  // namespace sinew

#if SINEW_DEFINES
namespace sinew {

SINEW_ONCE void ExtrudeEdgesAndGenerateQuads::update(std::string_view where) {
  check_fields(*this, where);
  const std::string at = text(where, ": ", className);
  if (curveEdges.empty()) throw Error(at, "curveEdges is empty; link it to the edges of a curve");
  if (!(extrudeDirection.norm() > 0))
    throw Error(at, "extrudeDirection is 0 0 0; give the direction along which the curve is drawn");
  detail::check_indices(at, "edge", curveEdges, curveVertices.size());
  if (double(curveVertices.size()) * (numberOfSections + 1) > 16777216)
    throw Error(
        at, text("numberOfSections is ", numberOfSections, ", which makes more than 2^24 points; reduce it"));
  extrudedVertices.clear(), extrudedEdges.clear(), extrudedQuads.clear();
  const int n = numberOfSections;
  const Eigen::Vector3d step = extrudeDirection.normalized() * ((thicknessIn + thicknessOut) / n);
  for (int s = 0; s <= n; ++s)
    for (auto const& x : curveVertices)
      extrudedVertices.push_back(x - thicknessIn * extrudeDirection + s * step);
  auto point = [points = Index(curveVertices.size())](Index i, int section) { return i + section * points; };
  for (auto const& [a, b] : curveEdges) {
    for (int s = 0; s <= n; ++s) extrudedEdges.push_back({point(a, s), point(b, s)});
    for (int s = 0; s < n; ++s) extrudedEdges.push_back({point(a, s), point(a, s + 1)});
    for (int s = 0; s < n; ++s)
      extrudedQuads.push_back({point(a, s), point(b, s), point(b, s + 1), point(a, s + 1)});
  }
  // the end of an open curve
  if (curveEdges.size() < curveVertices.size())
    for (int s = 0; s < n; ++s)
      extrudedEdges.push_back({point(curveEdges.back()[1], s), point(curveEdges.back()[1], s + 1)});
}

}  // namespace sinew
#endif
