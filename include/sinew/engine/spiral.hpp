// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/core/compiled.hpp>
#include <sinew/core/component.hpp>

#include <vector>

namespace sinew {

/// A sheet rolled up: what lies at x along it comes to the arc length |x| of the spiral of Archimedes r = A t
/// about z, A its curvature, and y of it is the distance from the spiral.
///   A/2 (t sqrt(1 + t^2) + asinh t) = |x|
struct Spiral {
  using Role = role::Engine;
  static constexpr std::string_view className = "Spiral";

  std::vector<Eigen::Vector3d> restPosition{};
  double curvature = 0.2;

  static constexpr auto fields() {
    return field_list(field("rest_position", &Spiral::restPosition, "m", "points of the sheet"),
                      field("curvature", &Spiral::curvature, "m", "distance per angle", range::positive));
  }

  std::vector<Eigen::Vector3d> position{};  // after update

  static constexpr auto outputs() {
    return field_list(field("position", &Spiral::position, "m", "where the points come to"));
  }

  void update(std::string_view where);
};

}  // namespace sinew

#if SINEW_DEFINES
#include <cmath>
#include <numbers>

namespace sinew {

SINEW_ONCE void Spiral::update(std::string_view where) {
  check_fields(*this, where);
  position.clear();
  for (auto const& x : restPosition) {
    const double length = std::abs(x[0]);
    double t = std::sqrt(length);
    // Newton's method; the arc length is convex in t
    for (int i = 0; i < 10; ++i) {
      const double slope = curvature * std::sqrt(1 + t * t),
                   arc = curvature / 2 * (t * std::sqrt(1 + t * t) + std::asinh(t));
      t -= (arc - length) / slope;
    }
    const double r = (x[0] > 0 ? 1 : -1) * curvature * t, c = std::cos(t), s = std::sin(t);
    Eigen::Vector3d normal(-s - t * c, c - t * s, 0);
    normal.normalize();
    // both arms meet in the middle
    if (t < std::numbers::pi / 2 && normal[1] > 0.8) normal = {-0.6, 0.8, 0};
    position.push_back(Eigen::Vector3d(r * c, r * s, x[2]) + x[1] * normal);
  }
}

}  // namespace sinew
#endif
