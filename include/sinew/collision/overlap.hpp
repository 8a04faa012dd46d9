// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/collision/closest_points.hpp>

namespace sinew {

template <class Real>
struct Sphere {
  Vec<Real, 3> center{Real(0), Real(0), Real(0)};
  Real radius{0};
};

namespace detail {

/// Whether boxes along the axes, around a and b, are farther apart than `margin` in one axis.
template <class Real, std::size_t NA, std::size_t NB>
bool boxes_apart(Simplex<Real, NA> const& a, Simplex<Real, NB> const& b, Real margin) {
  for (Eigen::Index k = 0; k < 3; ++k) {
    Real lowA = a[0][k], highA = lowA, lowB = b[0][k], highB = lowB;
    for (std::size_t i = 1; i < NA; ++i) lowA = std::min(lowA, a[i][k]), highA = std::max(highA, a[i][k]);
    for (std::size_t j = 1; j < NB; ++j) lowB = std::min(lowB, b[j][k]), highB = std::max(highB, b[j][k]);
    if (lowB - highA > margin || lowA - highB > margin) return true;
  }
  return false;
}

}  // namespace detail

/// Whether points, segments or triangles have a point in common, or are nearer than contact_tolerance: none
/// that touch are missed, coplanar or flat ones neither, and two that are apart by some rounding count as
/// touching.
template <class Real, std::size_t NA, std::size_t NB>
bool overlap(std::array<Vec<Real, 3>, NA> const& a, std::array<Vec<Real, 3>, NB> const& b) {
  const Real tolerance = contact_tolerance<Real, NA, NB>(a, b);
  if (detail::boxes_apart<Real, NA, NB>(a, b, tolerance)) return false;
  return closest_points(a, b).squaredDistance <= tolerance * tolerance;
}

/// Whether the ball and the simplex have a point in common, up to contact_tolerance.
template <class Real, std::size_t N>
bool overlap(Sphere<Real> const& sphere, std::array<Vec<Real, 3>, N> const& b) {
  const Simplex<Real, 1> center{sphere.center};
  const Real reach = sphere.radius + contact_tolerance<Real, 1, N>(center, b);
  if (detail::boxes_apart<Real, 1, N>(center, b, reach)) return false;
  return closest_points(center, b).squaredDistance <= reach * reach;
}
template <class Real, std::size_t N>
bool overlap(std::array<Vec<Real, 3>, N> const& a, Sphere<Real> const& sphere) {
  return overlap(sphere, a);
}
template <class Real>
bool overlap(Sphere<Real> const& a, Sphere<Real> const& b) {
  return overlap(Sphere<Real>{a.center, a.radius + b.radius}, Simplex<Real, 1>{b.center});
}

}  // namespace sinew
