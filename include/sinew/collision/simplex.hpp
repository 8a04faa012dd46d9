// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/core/data_types.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>

namespace sinew {

/// A point, a segment or a triangle: the convex hull of 1, 2 or 3 points, in any position.
template <class Real, std::size_t N>
using Simplex = std::array<Vec<Real, 3>, N>;

namespace detail {

template <class Real>
SINEW_HD Real clamp_unit(Real t) {
  return t > 0 ? (t < 1 ? t : Real(1)) : Real(0);
}

template <class Real>
SINEW_HD Vec<Real, 3> unit_weight(std::size_t i) {
  Vec<Real, 3> w(Real(0), Real(0), Real(0));
  w[Eigen::Index(i)] = 1;
  return w;
}

template <class Real, std::size_t N>
SINEW_HD Vec<Real, 3> weighted_point(Simplex<Real, N> const& p, Vec<Real, 3> const& w) {
  Vec<Real, 3> x = w[0] * p[0];
  for (std::size_t i = 1; i < N; ++i) x += w[Eigen::Index(i)] * p[i];
  return x;
}

/// pointB - pointA, from differences to the points of largest weight: near a vertex the error is that of the
/// distance from it.
template <class Real, std::size_t NA, std::size_t NB>
SINEW_HD Vec<Real, 3> weighted_difference(Simplex<Real, NA> const& a, Simplex<Real, NB> const& b,
                                          Vec<Real, 3> const& wa, Vec<Real, 3> const& wb) {
  std::size_t i = 0, j = 0;
  for (std::size_t k = 1; k < NA; ++k)
    if (wa[Eigen::Index(k)] > wa[Eigen::Index(i)]) i = k;
  for (std::size_t k = 1; k < NB; ++k)
    if (wb[Eigen::Index(k)] > wb[Eigen::Index(j)]) j = k;
  Vec<Real, 3> d = b[j] - a[i];
  for (std::size_t k = 0; k < NA; ++k)
    if (k != i) d -= wa[Eigen::Index(k)] * (a[k] - a[i]);
  for (std::size_t k = 0; k < NB; ++k)
    if (k != j) d += wb[Eigen::Index(k)] * (b[k] - b[j]);
  return d;
}

/// from + s along, s in [0, 1]; `inverse` is 1 / |along|^2, or 0 where there is no length.
template <class Real>
struct EdgeFrame {
  std::size_t first = 0, second = 0;
  Vec<Real, 3> from, along;
  Real inverse = 0;

  EdgeFrame() = default;
  template <std::size_t N>
  SINEW_HD EdgeFrame(Simplex<Real, N> const& p, std::size_t i, std::size_t j)
      : first(i), second(j), from(p[i]), along(p[j] - p[i]) {
    const Real square = along.squaredNorm();
    if (square > 0 && 1 / square <= std::numeric_limits<Real>::max()) inverse = 1 / square;
  }
  SINEW_HD Real nearest(Vec<Real, 3> const& fromStart) const {
    return clamp_unit(fromStart.dot(along) * inverse);
  }
  SINEW_HD Vec<Real, 3> weights(Real s) const {
    Vec<Real, 3> w(Real(0), Real(0), Real(0));
    w[Eigen::Index(first)] = 1 - s;
    w[Eigen::Index(second)] = s;
    return w;
  }
};

/// What searches need of a simplex: its edges, and for a triangle the second edge less its part along the
/// first (orthogonalised twice, Parlett 1980: right to rounding also for a needle).
template <class Real, std::size_t N>
struct SimplexFrame {
  static constexpr std::size_t edgeCount = N == 3 ? 3 : N - 1;
  Simplex<Real, N> const& points;
  std::array<EdgeFrame<Real>, edgeCount> edges;
  Vec<Real, 3> second, across, normal;  // of a triangle; the normal is not of unit length
  Real inverseAcross = 0;

  SINEW_HD explicit SimplexFrame(Simplex<Real, N> const& p) : points(p) {
    if constexpr (N > 1)
      for (std::size_t k = 0; k < edgeCount; ++k) edges[k] = EdgeFrame<Real>(p, k, (k + 1) % N);
    if constexpr (N == 3) {
      auto const& u = edges[0];
      second = p[2] - p[0];
      across = second;
      for (int pass = 0; pass < 2; ++pass) across -= (across.dot(u.along) * u.inverse) * u.along;
      const Real square = across.squaredNorm();
      if (u.inverse > 0 && square > 0 && 1 / square <= std::numeric_limits<Real>::max())
        inverseAcross = 1 / square;
      normal = u.along.cross(second);
    }
  }

  /// Weights of the point nearest to points[0] + r.
  SINEW_HD Vec<Real, 3> nearest(Vec<Real, 3> const& r) const {
    if constexpr (N == 1) {
      return unit_weight<Real>(0);
    } else if constexpr (N == 2) {
      return edges[0].weights(edges[0].nearest(r));
    } else {
      // r = s e1 + t e2 + (out of the plane): first t across e1, then s from what remains
      if (inverseAcross > 0) {
        const Real t = r.dot(across) * inverseAcross;
        if (t >= 0 && t <= 1) {
          const Real s = (r - t * second).dot(edges[0].along) * edges[0].inverse;
          if (s >= 0 && s + t <= 1) return {std::max(1 - s - t, Real(0)), s, t};
        }
      }
      std::size_t best = 0;
      Real bestS = 0, minimum = std::numeric_limits<Real>::infinity();
      for (std::size_t k = 0; k < 3; ++k) {
        const Vec<Real, 3> fromStart = k == 0 ? r : k == 1 ? r - edges[0].along : r - second;
        const Real s = edges[k].nearest(fromStart);
        const Real square = (fromStart - s * edges[k].along).squaredNorm();
        if (square < minimum) best = k, bestS = s, minimum = square;
      }
      return edges[best].weights(bestS);
    }
  }
};

/// Length that bounds what separates points of a and b from one another: distances are right to some epsilon
/// of it.
template <class Real, std::size_t NA, std::size_t NB>
SINEW_HD Real contact_size(Simplex<Real, NA> const& a, Simplex<Real, NB> const& b) {
  Real size = 0;
  auto extend = [&](Vec<Real, 3> const& d) {
    size = std::max({size, std::abs(d[0]), std::abs(d[1]), std::abs(d[2])});
  };
  for (std::size_t i = 1; i < NA; ++i) extend(a[i] - a[0]);
  for (std::size_t j = 0; j < NB; ++j) extend(b[j] - a[0]);
  return size;
}

}  // namespace detail

}  // namespace sinew
