// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/core/compiled.hpp>
#include <sinew/core/component.hpp>

#include <vector>

namespace sinew {

/// The image of points in a camera: with y = P (x, 1) and the focal distance f they come to f y / y_z.
struct ProjectiveTransformEngine {
  using Role = role::Engine;
  static constexpr std::string_view className = "ProjectiveTransformEngine";

  std::vector<Eigen::Vector3d> inputPosition{};
  Mat<double, 3, 4> projection = Mat<double, 3, 4>::Identity();
  double focalDistance = 1;

  static constexpr auto fields() {
    using E = ProjectiveTransformEngine;
    return field_list(field("input_position", &E::inputPosition, "m", "where the points are"),
                      field("proj_mat", &E::projection, "", "P, 3 by 4 numbers, row by row"),
                      field("focal_distance", &E::focalDistance, "m", "f"));
  }

  std::vector<Eigen::Vector3d> outputPosition{};  // after update

  static constexpr auto outputs() {
    return field_list(
        field("output_position", &ProjectiveTransformEngine::outputPosition, "m", "where they are seen"));
  }

  /// Throws Error where a point is in the plane of the camera; the output then stays.
  void update(std::string_view where);
};

}  // namespace sinew

#if SINEW_DEFINES
#include <cmath>

namespace sinew {

SINEW_ONCE void ProjectiveTransformEngine::update(std::string_view where) {
  check_fields(*this, where);
  std::vector<Eigen::Vector3d> seen;
  for (auto const& x : inputPosition) {
    const Eigen::Vector3d y = projection * x.homogeneous();
    if (!(std::abs(y[2]) > 1e-10))
      throw Error(
          text(where, ": ", className),
          text("point ", seen.size(), " is in the plane of the camera; move it, or correct proj_mat"));
    seen.push_back(y * (focalDistance / y[2]));
  }
  outputPosition = std::move(seen);
}

}  // namespace sinew
#endif
