// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/collision/simplex.hpp>

namespace sinew::detail {

/// The nearest pair of points so far. Each is feasible, so that none is nearer than the truth.
template <class Real, std::size_t NA, std::size_t NB>
struct ClosestSearch {
  Simplex<Real, NA> const& a;
  Simplex<Real, NB> const& b;
  Vec<Real, 3> weightsA = unit_weight<Real>(0), weightsB = weightsA, difference{};
  Real minimum = std::numeric_limits<Real>::infinity();

  SINEW_HD Real offer(Vec<Real, 3> const& wa, Vec<Real, 3> const& wb) {
    const Vec<Real, 3> d = weighted_difference<Real, NA, NB>(a, b, wa, wb);
    const Real square = d.squaredNorm();
    if (square < minimum) weightsA = wa, weightsB = wb, difference = d, minimum = square;
    return square;
  }

  /// Whether a and b lie on the two sides of planes across `difference` through its ends: then no pair is
  /// nearer by more than rounding (the test by which Larsen, Gottschalk, Lin, Manocha 1999 leave early).
  SINEW_HD bool found(Real size) const {
    Real low = std::numeric_limits<Real>::infinity();
    for (auto const& x : a)
      for (auto const& y : b) low = std::min(low, (y - x).dot(difference));
    return low >= minimum - 2 * std::numeric_limits<Real>::epsilon() * size * std::sqrt(minimum);
  }

  /// Points inside both edges: A(s), B(t) with A(s) - B(t) along n = u x v. Cross products, and t again from
  /// A(s), keep the error of the distance at rounding where the edges are nearly parallel. All else is found
  /// from the ends.
  SINEW_HD void offerInside(EdgeFrame<Real> const& u, EdgeFrame<Real> const& v) {
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
  SINEW_HD void offerCrossing(EdgeFrame<Real> const& edge, Frame const& triangle) {
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
    if (minimum > eps * eps * squares && minimum < Real(1e6) * eps * eps * squares)
      offerBetween<EdgeOfA>(edge, triangle);
  }

  /// The best mean of two pairs of nearest points, of the edge and two edges of the triangle.
  template <bool EdgeOfA, class Frame>
  SINEW_HD void offerBetween(EdgeFrame<Real> const& edge, Frame const& triangle) {
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

  SINEW_HD void offerAll(SimplexFrame<Real, NA> const& frameA, SimplexFrame<Real, NB> const& frameB) {
    for (std::size_t i = 0; i < NA; ++i) offer(unit_weight<Real>(i), frameB.nearest(a[i] - b[0]));
    if constexpr (NA > 1)
      for (std::size_t j = 0; j < NB; ++j) offer(frameA.nearest(b[j] - a[0]), unit_weight<Real>(j));
    if constexpr (NA > 1 && NB > 1) {
      constexpr bool leaves = NA == 3 && NB == 3;  // elsewhere the test costs what it saves
      const Real size = leaves ? contact_size<Real, NA, NB>(a, b) : Real(0);
      if (leaves && found(size)) return;
      for (auto const& u : frameA.edges)
        for (auto const& v : frameB.edges) {
          const Real before = minimum;
          offerInside(u, v);
          if (leaves && minimum < before && found(size)) return;
        }
    }
    if constexpr (NA > 1 && NB == 3)
      for (auto const& u : frameA.edges) offerCrossing<true>(u, frameB);
    if constexpr (NA == 3 && NB > 1)
      for (auto const& v : frameB.edges) offerCrossing<false>(v, frameA);
  }
};

}  // namespace sinew::detail
