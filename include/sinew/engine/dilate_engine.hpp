// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/core/compiled.hpp>
#include <sinew/core/component.hpp>

#include <vector>

namespace sinew {

/// Moves the points of a surface along their normals, which are weighted by area: outwards by a distance,
/// and by half of what the body, measured along the ray inwards, is thinner there than a least thickness.
struct DilateEngine {
  using Role = role::Engine;
  static constexpr std::string_view className = "DilateEngine";

  std::vector<Eigen::Vector3d> inputPosition{};
  std::vector<Triangle> triangles{};
  std::vector<Quad> quads{};
  double distance = 0, minThickness = 0;

  static constexpr auto fields() {
    using E = DilateEngine;
    return field_list(
        field("input_position", &E::inputPosition, "m", "points of the surface").also("position"),
        field("triangles", &E::triangles, "", "of the surface", range::nonNegative),
        field("quads", &E::quads, "", "of the surface", range::nonNegative),
        field("distance", &E::distance, "m", "outwards; negative for inwards"),
        field("minThickness", &E::minThickness, "m", "the least; 0 for any", range::nonNegative));
  }

  // after update
  std::vector<Eigen::Vector3d> outputPosition{}, normal{};
  std::vector<double> thickness{};

  static constexpr auto outputs() {
    using E = DilateEngine;
    return field_list(
        field("output_position", &E::outputPosition, "m", "where the points are put"),
        field("normal", &E::normal, "", "unit normals of the points"),
        field("thickness", &E::thickness, "m", "at the points, where a least one is set; 0 for none found"));
  }

  /// Throws Error where there is no point or element, or one refers to a missing point; the outputs then
  /// stay.
  void update(std::string_view where);
};

}  // namespace sinew

#if SINEW_DEFINES
#include <sinew/topology/ray_triangle.hpp>

#include <algorithm>
#include <limits>

namespace sinew {

SINEW_ONCE void DilateEngine::update(std::string_view where) {
  check_fields(*this, where);
  const std::string at = text(where, ": ", className);
  if (triangles.empty() && quads.empty())
    throw Error(at, "there is no surface; give triangles or quads, or a topology that has some");
  detail::check_indices(at, "triangle", triangles, inputPosition.size());
  detail::check_indices(at, "quad", quads, inputPosition.size());
  auto x = [&](Index i) -> Eigen::Vector3d const& { return inputPosition[std::size_t(i)]; };
  normal.assign(inputPosition.size(), Eigen::Vector3d::Zero());
  std::vector<Triangle> all = triangles;
  for (auto const& [a, b, c] : triangles) {
    const Eigen::Vector3d n = (x(b) - x(a)).cross(x(c) - x(a));
    for (const Index i : {a, b, c}) normal[std::size_t(i)] += n;
  }
  for (auto const& q : quads) {
    for (std::size_t k = 0; k < 4; ++k)
      normal[std::size_t(q[k])] += (x(q[(k + 1) % 4]) - x(q[k])).cross(x(q[(k + 3) % 4]) - x(q[k]));
    all.push_back({q[0], q[1], q[2]});
    all.push_back({q[0], q[2], q[3]});
  }
  for (auto& n : normal) n = n.stableNormalized();
  thickness.clear(), outputPosition.clear();
  for (std::size_t i = 0; i < inputPosition.size(); ++i) {
    double out = distance;
    if (minThickness > 0) {
      double nearest = std::numeric_limits<double>::infinity();
      for (auto const& t : all) {
        if (std::find(t.begin(), t.end(), Index(i)) != t.end()) continue;
        const auto d = line_meets_triangle(inputPosition[i], -normal[i], x(t[0]), x(t[1]), x(t[2]));
        if (d && *d > 0) nearest = std::min(nearest, *d);
      }
      thickness.push_back(nearest < std::numeric_limits<double>::infinity() ? nearest : 0);
      out += std::max(0.0, minThickness - thickness.back()) / 2;
    }
    outputPosition.push_back(inputPosition[i] + out * normal[i]);
  }
}

}  // namespace sinew
#endif
