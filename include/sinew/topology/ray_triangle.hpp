// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/core/platform.hpp>

#include <Eigen/Geometry>

#include <optional>

namespace sinew {

/// Where a straight line from p along d meets a triangle, its sides included: t of p + t d, also behind p;
/// nothing where it passes by or is parallel (Moller & Trumbore 1997, Fast, minimum storage ray-triangle
/// intersection).
inline std::optional<double> line_meets_triangle(Eigen::Vector3d const& p, Eigen::Vector3d const& d,
                                                 Eigen::Vector3d const& a, Eigen::Vector3d const& b,
                                                 Eigen::Vector3d const& c) {
  const Eigen::Vector3d e1 = b - a, e2 = c - a, h = d.cross(e2), s = p - a, q = s.cross(e1);
  const double det = e1.dot(h);
  if (det == 0) return {};
  const double u = s.dot(h) / det, v = d.dot(q) / det;
  if (!(u >= 0 && v >= 0 && u + v <= 1)) return {};
  return e2.dot(q) / det;
}

}  // namespace sinew
