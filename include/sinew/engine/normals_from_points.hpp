// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/core/compiled.hpp>
#include <sinew/core/component.hpp>

#include <vector>

namespace sinew {

/// Unit normals at the points of a surface: the directions of the sums of unit normals of the triangles, and
/// of the corners of quads, around; with useAngles weighted by the angle of the element there. Zero at points
/// without elements.
struct NormalsFromPoints {
  using Role = role::Engine;
  static constexpr std::string_view className = "NormalsFromPoints";

  std::vector<Eigen::Vector3d> position{};
  std::vector<Triangle> triangles{};
  std::vector<Quad> quads{};
  bool invertNormals = false, useAngles = false;

  static constexpr auto fields() {
    using E = NormalsFromPoints;
    return field_list(
        field("position", &E::position, "m", "points of the surface"),
        field("triangles", &E::triangles, "", "of the surface", range::nonNegative),
        field("quads", &E::quads, "", "of the surface", range::nonNegative),
        field("invertNormals", &E::invertNormals, "", "whether normals look inwards"),
        field("useAngles", &E::useAngles, "", "whether elements count by their angle at the point"));
  }

  std::vector<Eigen::Vector3d> normals{};  // after update

  static constexpr auto outputs() {
    return field_list(field("normals", &NormalsFromPoints::normals, "", "one for each point"));
  }

  /// Throws Error where an element refers to a missing point; the output then stays.
  void update(std::string_view where);
};

}  // namespace sinew

#if SINEW_DEFINES
#include <cmath>

namespace sinew {

SINEW_ONCE void NormalsFromPoints::update(std::string_view where) {
  check_fields(*this, where);
  const std::string at = text(where, ": ", className);
  detail::check_indices(at, "triangle", triangles, position.size());
  detail::check_indices(at, "quad", quads, position.size());
  normals.assign(position.size(), Eigen::Vector3d::Zero());
  auto add = [&](auto const& face) {
    for (std::size_t k = 0; k < face.size(); ++k) {
      auto x = [&](std::size_t i) -> Eigen::Vector3d const& {
        return position[std::size_t(face[i % face.size()])];
      };
      const Eigen::Vector3d after = x(k + 1) - x(k), before = x(k + face.size() - 1) - x(k),
                            n = after.cross(before);
      const double angle = useAngles ? std::atan2(n.norm(), after.dot(before)) : 1;
      normals[std::size_t(face[k])] += angle * n.stableNormalized();
    }
  };
  for (auto const& t : triangles) add(t);
  for (auto const& q : quads) add(q);
  for (auto& n : normals) n = (invertNormals ? -n : n).stableNormalized();
}

}  // namespace sinew
#endif
