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

/// Where two simplices are nearest. Weights are barycentric, not negative, of sum 1; those of points that a
/// simplex lacks are 0. The square of the distance comes from differences of points, so that it is as good
/// far from the origin, where pointA and pointB are rounded, as near it.
template <class Real>
struct ClosestPoints {
  Vec<Real, 3> weightsA, weightsB;
  Vec<Real, 3> pointA, pointB;
  Real squaredDistance;
};

namespace detail {

template <class Real>
Real clamp_unit(Real t) {
  return t > 0 ? (t < 1 ? t : Real(1)) : Real(0);
}

template <class Real>
Vec<Real, 3> unit_weight(std::size_t i) {
  Vec<Real, 3> w(Real(0), Real(0), Real(0));
  w[Eigen::Index(i)] = 1;
  return w;
}

template <class Real, std::size_t N>
Vec<Real, 3> weighted_point(Simplex<Real, N> const& p, Vec<Real, 3> const& w) {
  Vec<Real, 3> x = w[0] * p[0];
  for (std::size_t i = 1; i < N; ++i) x += w[Eigen::Index(i)] * p[i];
  return x;
}

/// pointB - pointA, from differences to the points of largest weight: near a vertex the error is that of the
/// distance from it.
template <class Real, std::size_t NA, std::size_t NB>
Vec<Real, 3> weighted_difference(Simplex<Real, NA> const& a, Simplex<Real, NB> const& b, Vec<Real, 3> const& wa,
                                 Vec<Real, 3> const& wb) {
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
  EdgeFrame(Simplex<Real, N> const& p, std::size_t i, std::size_t j)
      : first(i), second(j), from(p[i]), along(p[j] - p[i]) {
    const Real square = along.squaredNorm();
    if (square > 0 && 1 / square <= std::numeric_limits<Real>::max()) inverse = 1 / square;
  }
  Real nearest(Vec<Real, 3> const& fromStart) const { return clamp_unit(fromStart.dot(along) * inverse); }
  Vec<Real, 3> weights(Real s) const {
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

  explicit SimplexFrame(Simplex<Real, N> const& p) : points(p) {
    for (std::size_t k = 0; k < edgeCount; ++k) edges[k] = EdgeFrame<Real>(p, k, (k + 1) % N);
    if constexpr (N == 3) {
      auto const& u = edges[0];
      second = p[2] - p[0];
      across = second;
      for (int pass = 0; pass < 2; ++pass) across -= (across.dot(u.along) * u.inverse) * u.along;
      const Real square = across.squaredNorm();
      if (u.inverse > 0 && square > 0 && 1 / square <= std::numeric_limits<Real>::max()) inverseAcross = 1 / square;
      normal = u.along.cross(second);
    }
  }

  /// Weights of the point nearest to points[0] + r.
  Vec<Real, 3> nearest(Vec<Real, 3> const& r) const {
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
      Real bestS = 0, least = std::numeric_limits<Real>::infinity();
      for (std::size_t k = 0; k < 3; ++k) {
        const Vec<Real, 3> fromStart = k == 0 ? r : k == 1 ? r - edges[0].along : r - second;
        const Real s = edges[k].nearest(fromStart);
        const Real square = (fromStart - s * edges[k].along).squaredNorm();
        if (square < least) best = k, bestS = s, least = square;
      }
      return edges[best].weights(bestS);
    }
  }
};

/// The nearest pair of points so far. Each is feasible, so that none is nearer than the truth.
template <class Real, std::size_t NA, std::size_t NB>
struct ClosestSearch {
  Simplex<Real, NA> const& a;
  Simplex<Real, NB> const& b;
  Vec<Real, 3> weightsA{}, weightsB{};
  Real least = std::numeric_limits<Real>::infinity();

  Real offer(Vec<Real, 3> const& wa, Vec<Real, 3> const& wb) {
    const Real square = weighted_difference<Real, NA, NB>(a, b, wa, wb).squaredNorm();
    if (square < least) weightsA = wa, weightsB = wb, least = square;
    return square;
  }

  /// Points inside both edges: A(s), B(t) with A(s) - B(t) along n = u x v. Cross products, and t again from
  /// A(s), keep the error of the distance at rounding where the edges are nearly parallel. All else is found
  /// from the ends.
  void offerInside(EdgeFrame<Real> const& u, EdgeFrame<Real> const& v) {
    const Vec<Real, 3> n = u.along.cross(v.along), w = u.from - v.from;
    const Real square = n.squaredNorm();
    if (!(square > 0)) return;
    const Real s = v.along.cross(w).dot(n) / square;
    if (!(s > 0 && s < 1)) return;
    const Real t = u.along.cross(w).dot(n) / square;
    if (!(t > 0 && t < 1)) return;
    offer(u.weights(s), v.weights(v.nearest(w + s * u.along)));
  }

  /// Where the edge meets the plane of the triangle. The normal of a needle has a large relative error, so
  /// the crossing is found again from the point of the triangle nearest to it, while that brings both nearer.
  template <bool EdgeOfA, class Frame>
  void offerCrossing(EdgeFrame<Real> const& edge, Frame const& triangle) {
    constexpr Real eps = std::numeric_limits<Real>::epsilon();
    const Vec<Real, 3> to0 = edge.from - triangle.points[0], to1 = to0 + edge.along;
    const Real h0 = to0.dot(triangle.normal), h1 = to1.dot(triangle.normal);
    if (h0 * h1 > 0) {
      const Real product = 1 / (triangle.edges[0].inverse * triangle.edges[2].inverse);  // of squared lengths
      if (h0 * h0 > 64 * eps * eps * product * to0.squaredNorm() &&
          h1 * h1 > 64 * eps * eps * product * to1.squaredNorm())
        return;
    }
    const Real slope = edge.along.dot(triangle.normal);
    if (!(std::abs(slope) > 0)) return;
    Real t = clamp_unit(-h0 / slope), last = std::numeric_limits<Real>::infinity();
    for (int pass = 0; pass < 5; ++pass) {
      const Vec<Real, 3> p = to0 + t * edge.along, w = triangle.nearest(p);
      Real square;
      if constexpr (EdgeOfA) square = offer(edge.weights(t), w);
      else square = offer(w, edge.weights(t));
      if (!(square < last / 4) || square * edge.inverse <= eps * eps) return;
      last = square;
      const Vec<Real, 3> q = w[1] * triangle.edges[0].along + w[2] * triangle.second;
      t = clamp_unit(t - (p - q).dot(triangle.normal) / slope);
    }
  }
};

/// Length that bounds what separates points of a and b from one another: distances are right to some epsilon of it.
template <class Real, std::size_t NA, std::size_t NB>
Real contact_size(Simplex<Real, NA> const& a, Simplex<Real, NB> const& b) {
  Real size = 0;
  auto extend = [&](Vec<Real, 3> const& d) {
    size = std::max({size, std::abs(d[0]), std::abs(d[1]), std::abs(d[2])});
  };
  for (std::size_t i = 1; i < NA; ++i) extend(a[i] - a[0]);
  for (std::size_t j = 0; j < NB; ++j) extend(b[j] - a[0]);
  return size;
}

}  // namespace detail

/// Below this the distance of a and b is taken for zero: 16 times the machine epsilon of their common size,
/// several times the largest error of closest_points.
template <class Real, std::size_t NA, std::size_t NB>
Real contact_tolerance(Simplex<Real, NA> const& a, Simplex<Real, NB> const& b) {
  return 16 * std::numeric_limits<Real>::epsilon() * detail::contact_size<Real, NA, NB>(a, b);
}

/// Nearest points of two simplices: the least distance over the pairs of features on which it can lie (Ericson
/// 2005, Real-Time Collision Detection, 5.1), each solved such that rounding costs the distance some epsilon
/// of the common size of a and b, however flat, long, parallel or empty these are: orthogonalised edges for
/// triangles, cross products for pairs of edges (compare Eberly 2018, Robust Computation of Distance Between
/// Line Segments), refined crossings. Where more than one pair of points is nearest, one of them; where a and b
/// cross, a common point. Lengths whose fourth powers leave the range of Real (float: below 1e-9, above 1e9)
/// cost accuracy. No allocation.
template <class Real, std::size_t NA, std::size_t NB>
ClosestPoints<Real> closest_points(std::array<Vec<Real, 3>, NA> const& a, std::array<Vec<Real, 3>, NB> const& b) {
  static_assert(NA >= 1 && NA <= 3 && NB >= 1 && NB <= 3, "Sinew: closest_points takes 1, 2 or 3 points of each.");
  const detail::SimplexFrame<Real, NA> frameA(a);
  const detail::SimplexFrame<Real, NB> frameB(b);
  detail::ClosestSearch<Real, NA, NB> search{a, b};
  for (std::size_t i = 0; i < NA; ++i) search.offer(detail::unit_weight<Real>(i), frameB.nearest(a[i] - b[0]));
  if constexpr (NA > 1)
    for (std::size_t j = 0; j < NB; ++j) search.offer(frameA.nearest(b[j] - a[0]), detail::unit_weight<Real>(j));
  if constexpr (NA > 1 && NB > 1)
    for (auto const& u : frameA.edges)
      for (auto const& v : frameB.edges) search.offerInside(u, v);
  if constexpr (NA > 1 && NB == 3)
    for (auto const& u : frameA.edges) search.template offerCrossing<true>(u, frameB);
  if constexpr (NA == 3 && NB > 1)
    for (auto const& v : frameB.edges) search.template offerCrossing<false>(v, frameA);
  return {search.weightsA,
          search.weightsB,
          detail::weighted_point<Real, NA>(a, search.weightsA),
          detail::weighted_point<Real, NB>(b, search.weightsB),
          search.least};
}

/// Unit vector from a to b at their closest points: the difference of these where the distance exceeds
/// contact_tolerance. Where they touch or cross, what fits the features that meet, turned such that the middle
/// of b lies ahead of that of a: inside of a face, its normal; two edges, their cross product; else the line
/// between the middles, less its part along an edge that is touched. Where that is empty too: the normal of a
/// triangle, a perpendicular of an edge, the z axis. Never NaN for finite points.
template <class Real, std::size_t NA, std::size_t NB>
Vec<Real, 3> contact_direction(std::array<Vec<Real, 3>, NA> const& a, std::array<Vec<Real, 3>, NB> const& b,
                               ClosestPoints<Real> const& closest) {
  const Real size = detail::contact_size<Real, NA, NB>(a, b);
  if (!(size > 0)) return {0, 0, 1};
  const Real small = 16 * std::numeric_limits<Real>::epsilon();  // of lengths in units of `size`
  auto scaled = [&](Vec<Real, 3> const& d) -> Vec<Real, 3> { return d / size; };
  const Vec<Real, 3> d = scaled(detail::weighted_difference<Real, NA, NB>(a, b, closest.weightsA, closest.weightsB));
  if (const Real length = d.norm(); length > small) return d / length;

  Vec<Real, 3> third(1, 1, 1);
  const Vec<Real, 3> middleA = detail::weighted_point<Real, NA>(a, third) / Real(NA);
  const Vec<Real, 3> middleB = detail::weighted_point<Real, NB>(b, third) / Real(NB);
  const Vec<Real, 3> between = scaled(middleB - middleA);
  Vec<Real, 3> found(0, 0, 0);
  auto take = [&](Vec<Real, 3> const& direction, Real least) {
    const Real length = direction.norm();
    if (!(length > least)) return false;
    found = direction / length;
    if (found.dot(between) < 0) found = -found;
    return true;
  };

  // of each: points that carry the contact, its edge between the first two of them
  auto feature = [&](auto const& p, Vec<Real, 3> const& w, Vec<Real, 3>& along) {
    std::array<std::size_t, 3> carrier{};
    int count = 0;
    for (std::size_t i = 0; i < p.size(); ++i)
      if (w[Eigen::Index(i)] > 0) carrier[std::size_t(count++)] = i;
    along = count == 2 ? scaled(p[carrier[1]] - p[carrier[0]]) : Vec<Real, 3>(0, 0, 0);
    return count;
  };
  auto normal = [&](auto const& p) -> Vec<Real, 3> {
    if constexpr (std::tuple_size_v<std::decay_t<decltype(p)>> == 3) return scaled(p[1] - p[0]).cross(scaled(p[2] - p[0]));
    else return Vec<Real, 3>(0, 0, 0);
  };
  Vec<Real, 3> alongA, alongB;
  const int countA = feature(a, closest.weightsA, alongA), countB = feature(b, closest.weightsB, alongB);
  const Real none = std::numeric_limits<Real>::min();
  if (countA == 3 && take(normal(a), none)) return found;
  if (countB == 3 && take(normal(b), none)) return found;
  if (countA == 2 && countB == 2 && take(alongA.cross(alongB), small * alongA.norm() * alongB.norm())) return found;
  Vec<Real, 3> line = between;
  for (Vec<Real, 3> const& along : {alongA, alongB})
    if (const Real square = along.squaredNorm(); square > 0) line -= (line.dot(along) / square) * along;
  if (take(line, small)) return found;
  if (take(normal(b), none) || take(normal(a), none)) return found;
  // a perpendicular of what is a line: with the axis in which it extends least
  for (Vec<Real, 3> along : {alongA, alongB, between, NA > 1 ? scaled(a[NA - 1] - a[0]) : between,
                             NB > 1 ? scaled(b[NB - 1] - b[0]) : between}) {
    Eigen::Index axis = 2;
    for (Eigen::Index k = 0; k < 2; ++k)
      if (std::abs(along[k]) < std::abs(along[axis])) axis = k;
    if (take(along.cross(detail::unit_weight<Real>(std::size_t(axis))), none)) return found;
  }
  return {0, 0, 1};
}

}  // namespace sinew
