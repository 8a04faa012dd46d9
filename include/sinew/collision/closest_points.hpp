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
Vec<Real, 3> weighted_difference(Simplex<Real, NA> const& a, Simplex<Real, NB> const& b,
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

/// Length that bounds what separates points of a and b from one another: distances are right to some epsilon
/// of it.
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

/// The nearest pair of points so far. Each is feasible, so that none is nearer than the truth.
template <class Real, std::size_t NA, std::size_t NB>
struct ClosestSearch {
  Simplex<Real, NA> const& a;
  Simplex<Real, NB> const& b;
  Vec<Real, 3> weightsA = unit_weight<Real>(0), weightsB = weightsA, difference{};
  Real least = std::numeric_limits<Real>::infinity();

  Real offer(Vec<Real, 3> const& wa, Vec<Real, 3> const& wb) {
    const Vec<Real, 3> d = weighted_difference<Real, NA, NB>(a, b, wa, wb);
    const Real square = d.squaredNorm();
    if (square < least) weightsA = wa, weightsB = wb, difference = d, least = square;
    return square;
  }

  /// Whether a and b lie on the two sides of planes across `difference` through its ends: then no pair is
  /// nearer by more than rounding (the test by which Larsen, Gottschalk, Lin, Manocha 1999 leave early).
  bool found(Real size) const {
    Real low = std::numeric_limits<Real>::infinity();
    for (auto const& x : a)
      for (auto const& y : b) low = std::min(low, (y - x).dot(difference));
    return low >= least - 2 * std::numeric_limits<Real>::epsilon() * size * std::sqrt(least);
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
    const Real squares = triangle.edges[0].along.squaredNorm() + edge.along.squaredNorm();
    Real t = clamp_unit(-h0 / slope), last = Real(1e-4) * squares;  // farther away it passes by
    for (int pass = 0; pass < 5; ++pass) {
      const Vec<Real, 3> p = to0 + t * edge.along, w = triangle.nearest(p);
      Real square;
      if constexpr (EdgeOfA)
        square = offer(edge.weights(t), w);
      else
        square = offer(w, edge.weights(t));
      if (square <= eps * eps * squares) return;
      if (!(square < last / 4)) break;
      last = square;
      const Vec<Real, 3> q = w[1] * triangle.edges[0].along + w[2] * triangle.second;
      t = clamp_unit(t - (p - q).dot(triangle.normal) / slope);
    }
    // a needle crossed at a small angle: between its edges, which the other edge passes on two sides
    if (least > eps * eps * squares && least < Real(1e6) * eps * eps * squares)
      offerBetween<EdgeOfA>(edge, triangle);
  }

  /// The best mean of two pairs of nearest points, of the edge and two edges of the triangle.
  template <bool EdgeOfA, class Frame>
  void offerBetween(EdgeFrame<Real> const& edge, Frame const& triangle) {
    Real s[3];
    Vec<Real, 3> w[3], d[3];
    const Simplex<Real, 2> local{Vec<Real, 3>(0, 0, 0), edge.along};
    for (std::size_t k = 0; k < 3; ++k) {
      auto const& other = triangle.edges[k];
      const Vec<Real, 3> start = other.from - edge.from;
      const Simplex<Real, 2> otherEnds{start, start + other.along};
      const SimplexFrame<Real, 2> one(local), two(otherEnds);
      ClosestSearch<Real, 2, 2> search{local, otherEnds};
      search.offerAll(one, two);
      s[k] = search.weightsA[1];
      w[k] = other.weights(search.weightsB[1]);
      d[k] = weighted_difference<Real, 2, 2>(local, otherEnds, search.weightsA, search.weightsB);
    }
    for (int k = 0; k < 3; ++k) {
      const int l = (k + 1) % 3;
      const Vec<Real, 3> change = d[l] - d[k];
      const Real square = change.squaredNorm();
      const Real mix = square > 0 ? clamp_unit(-change.dot(d[k]) / square) : Real(0);
      const Vec<Real, 3> we = edge.weights(s[k] + mix * (s[l] - s[k])), wt = w[k] + mix * (w[l] - w[k]);
      if constexpr (EdgeOfA)
        offer(we, wt);
      else
        offer(wt, we);
    }
  }

  void offerAll(SimplexFrame<Real, NA> const& frameA, SimplexFrame<Real, NB> const& frameB) {
    for (std::size_t i = 0; i < NA; ++i) offer(unit_weight<Real>(i), frameB.nearest(a[i] - b[0]));
    if constexpr (NA > 1)
      for (std::size_t j = 0; j < NB; ++j) offer(frameA.nearest(b[j] - a[0]), unit_weight<Real>(j));
    if constexpr (NA > 1 && NB > 1) {
      constexpr bool leaves = NA == 3 && NB == 3;  // elsewhere the test costs what it saves
      const Real size = leaves ? contact_size<Real, NA, NB>(a, b) : Real(0);
      if (leaves && found(size)) return;
      for (auto const& u : frameA.edges)
        for (auto const& v : frameB.edges) {
          const Real before = least;
          offerInside(u, v);
          if (leaves && least < before && found(size)) return;
        }
    }
    if constexpr (NA > 1 && NB == 3)
      for (auto const& u : frameA.edges) offerCrossing<true>(u, frameB);
    if constexpr (NA == 3 && NB > 1)
      for (auto const& v : frameB.edges) offerCrossing<false>(v, frameA);
  }
};

/// The edge inside which the point with weights w lies, in units of size; zero where it is a corner or inside
/// a face.
template <class Real, std::size_t N>
Vec<Real, 3> carrying_edge(Simplex<Real, N> const& p, Vec<Real, 3> const& w, Real size) {
  for (std::size_t k = 0; N > 1 && k < SimplexFrame<Real, N>::edgeCount; ++k) {
    const std::size_t i = k, j = (k + 1) % N;
    if (w[Eigen::Index(i)] > 0 && w[Eigen::Index(j)] > 0 && (N == 2 || !(w[Eigen::Index(3 - i - j)] > 0)))
      return (p[j] - p[i]) / size;
  }
  return {Real(0), Real(0), Real(0)};
}

}  // namespace detail

/// Below this the distance of a and b is taken for zero: 16 times the machine epsilon of their common size,
/// several times the largest error of closest_points.
template <class Real, std::size_t NA, std::size_t NB>
Real contact_tolerance(Simplex<Real, NA> const& a, Simplex<Real, NB> const& b) {
  return 16 * std::numeric_limits<Real>::epsilon() * detail::contact_size<Real, NA, NB>(a, b);
}

/// Nearest points of two simplices: the least distance over the pairs of features on which it can lie
/// (Ericson 2005, Real-Time Collision Detection, 5.1), each solved such that rounding costs the distance some
/// epsilon of the common size of a and b, however flat, long, parallel or empty these are: orthogonalised
/// edges for triangles, cross products for pairs of edges (compare Eberly 2018, Robust Computation of
/// Distance Between Line Segments), refined crossings. Where more than one pair of points is nearest, one of
/// them; where a and b cross, a common point. Of points that are not finite the distance is infinite. Lengths
/// whose fourth powers leave the range of Real (float: below 1e-9, above 1e9) cost accuracy. No allocation.
template <class Real, std::size_t NA, std::size_t NB>
ClosestPoints<Real> closest_points(std::array<Vec<Real, 3>, NA> const& a,
                                   std::array<Vec<Real, 3>, NB> const& b) {
  static_assert(NA >= 1 && NA <= 3 && NB >= 1 && NB <= 3,
                "Sinew: closest_points takes 1, 2 or 3 points of each.");
  const detail::SimplexFrame<Real, NA> frameA(a);
  const detail::SimplexFrame<Real, NB> frameB(b);
  detail::ClosestSearch<Real, NA, NB> search{a, b};
  search.offerAll(frameA, frameB);
  return {search.weightsA,
          search.weightsB,
          detail::weighted_point<Real, NA>(a, search.weightsA),
          detail::weighted_point<Real, NB>(b, search.weightsB),
          search.least};
}

namespace detail {

/// The normal of the features on which closest points lie, of either sign and in units of size^2: of a face
/// that holds one inside, else the cross product of two edges; zero where there is neither.
template <class Real, std::size_t NA, std::size_t NB>
Vec<Real, 3> feature_normal(Simplex<Real, NA> const& a, Simplex<Real, NB> const& b,
                            ClosestPoints<Real> const& c, Real size) {
  auto inside = [](Vec<Real, 3> const& w) { return w[0] > 0 && w[1] > 0 && w[2] > 0; };
  if constexpr (NA == 3)
    if (inside(c.weightsA)) return ((a[1] - a[0]) / size).cross((a[2] - a[0]) / size);
  if constexpr (NB == 3)
    if (inside(c.weightsB)) return ((b[1] - b[0]) / size).cross((b[2] - b[0]) / size);
  const Vec<Real, 3> u = carrying_edge<Real, NA>(a, c.weightsA, size),
                     v = carrying_edge<Real, NB>(b, c.weightsB, size);
  const Vec<Real, 3> n = u.cross(v);
  return n.norm() > 16 * std::numeric_limits<Real>::epsilon() * u.norm() * v.norm() ? n
                                                                                    : Vec<Real, 3>(0, 0, 0);
}

}  // namespace detail

/// Unit vector from a to b at their closest points: the difference of these where the distance exceeds
/// contact_tolerance. Where they touch or cross, what fits the features that meet, turned such that the
/// middle of b lies ahead of that of a: inside of a face, its normal; two edges, their cross product; else
/// the line between the middles, less its part along an edge that is touched. Where that is empty too: the
/// normal of a triangle, a perpendicular of an edge, the z axis. Never NaN for finite points.
template <class Real, std::size_t NA, std::size_t NB>
Vec<Real, 3> contact_direction(std::array<Vec<Real, 3>, NA> const& a, std::array<Vec<Real, 3>, NB> const& b,
                               ClosestPoints<Real> const& closest) {
  using V = Vec<Real, 3>;
  const Real size = detail::contact_size<Real, NA, NB>(a, b);
  if (!(size > 0)) return {0, 0, 1};
  const Real small = 16 * std::numeric_limits<Real>::epsilon(), none = std::numeric_limits<Real>::min();
  const V d = detail::weighted_difference<Real, NA, NB>(a, b, closest.weightsA, closest.weightsB) / size;
  if (const Real length = d.norm(); length > small) return d / length;

  V middle(0, 0, 0);  // of b, from that of a; all lengths in units of size
  for (V const& x : a) middle -= (x - a[0]) / (size * Real(NA));
  for (V const& x : b) middle += (x - a[0]) / (size * Real(NB));
  V found(0, 0, 0);
  auto take = [&](V const& direction, Real least) {
    const Real length = direction.norm();
    if (!(length > least)) return false;
    found = direction / length;
    if (found.dot(middle) < 0) found = -found;
    return true;
  };
  if (take(detail::feature_normal<Real, NA, NB>(a, b, closest, size), none)) return found;
  const V u = detail::carrying_edge<Real, NA>(a, closest.weightsA, size);
  const V v = detail::carrying_edge<Real, NB>(b, closest.weightsB, size);
  V line = middle;
  for (V const& along : {u, v})
    if (const Real square = along.squaredNorm(); square > 0) line -= (line.dot(along) / square) * along;
  if (take(line, small)) return found;
  if constexpr (NB == 3)
    if (take(((b[1] - b[0]) / size).cross((b[2] - b[0]) / size), none)) return found;
  if constexpr (NA == 3)
    if (take(((a[1] - a[0]) / size).cross((a[2] - a[0]) / size), none)) return found;
  // a perpendicular of what is a line: across the axis along which it extends least
  for (V const& along : {u, v, middle, V((a[NA - 1] - a[0]) / size), V((b[NB - 1] - b[0]) / size)}) {
    std::size_t axis = 2;
    for (std::size_t k = 0; k < 2; ++k)
      if (std::abs(along[Eigen::Index(k)]) < std::abs(along[Eigen::Index(axis)])) axis = k;
    if (take(along.cross(detail::unit_weight<Real>(axis)), none)) return found;
  }
  return {0, 0, 1};
}

}  // namespace sinew
