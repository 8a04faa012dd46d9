// SPDX-License-Identifier: BSL-1.0
#pragma once

// Frames of rigid bodies, how they move, and the tangent of forces between them.

#include "one_component.hpp"

#include <Eigen/Geometry>
#include <cmath>

namespace frames {

using namespace sinew;
using Eigen::Quaterniond;
using Eigen::Vector3d;

inline Rigid3d::Coord frame(Vector3d const& center, Quaterniond const& rotation = Quaterniond::Identity()) {
  Rigid3d::Coord x;
  x.center = center;
  x.orientation = rotation;
  return x;
}
/// By a rotation vector.
inline Rigid3d::Coord frame(Vector3d const& center, Vector3d const& turn) {
  if (!(turn.norm() > 0)) return frame(center);
  return frame(center, Quaterniond(Eigen::AngleAxisd(turn.norm(), turn.normalized())));
}

/// Motions of n frames without any order; of each number other ones.
inline Rigid3d::VecDeriv wave(std::size_t n, double size, int number = 0) {
  Rigid3d::VecDeriv dx(n);
  for (std::size_t i = 0; i < n; ++i)
    for (int c = 0; c < 6; ++c) dx[i][c] = size * std::sin(1 + 7 * number + 3 * int(i) + 5 * c * c);
  return dx;
}
inline Rigid3d::VecCoord moved(Rigid3d::VecCoord x, Rigid3d::VecDeriv const& dx, double h = 1) {
  for (std::size_t i = 0; i < x.size(); ++i) Rigid3d::increment(x[i], dx[i] * h);
  return x;
}

/// That dx.K dx is the derivative of dx.f by finite differences of values of order 100 over 2e-5: rounding
/// 1e-9, truncation 1e-8.
template <class C>
void check_tangent(C& forces, Rigid3d::VecCoord const& x, double tolerance) {
  for (int trial = 0; trial < 4; ++trial) {
    const double h = 1e-5;
    const auto dx = wave(x.size(), 1, trial);
    const auto plus = one::force(forces, moved(x, dx, h)), minus = one::force(forces, moved(x, dx, -h));
    one::force(forces, x);
    const auto df = one::product(forces, dx, 1, 0);
    double slope = 0, tangent = 0;
    for (std::size_t i = 0; i < x.size(); ++i) {
      slope += dx[i].dot(plus[i] - minus[i]) / (2 * h);
      tangent += dx[i].dot(df[i]);
    }
    CHECK(tangent == Approx(slope).epsilon(tolerance));
  }
}

}  // namespace frames
