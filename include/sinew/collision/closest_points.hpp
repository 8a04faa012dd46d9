// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/collision/closest_search.hpp>

#include <optional>

namespace sinew {

/// Where two simplices are nearest. Weights are barycentric, not negative, of sum 1; those of points that a
/// simplex lacks are 0. The square of the distance comes from differences of points, so that it is as good
/// far from the origin, where pointA and pointB are rounded, as near it.
template <class Real>
struct ClosestPoints {
  Vec<Real, 3> weightsA, weightsB;
  Vec<Real, 3> pointA, pointB;
  Real squaredDistance;
};

/// Below this the distance of a and b is taken for zero: 16 times the machine epsilon of their common size,
/// several times the largest error of closest_points.
template <class Real, std::size_t NA, std::size_t NB>
SINEW_HD Real contact_tolerance(Simplex<Real, NA> const& a, Simplex<Real, NB> const& b) {
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
SINEW_HD ClosestPoints<Real> closest_points(std::array<Vec<Real, 3>, NA> const& a,
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
          search.minimum};
}

/// Where two simplices with no more than four points together are nearest, each place inside its simplex;
/// none where they are nearest elsewhere. Weights may be negative by 1e-9, and are 0 then, so that rounding
/// leaves no gap between neighbours. Segments that are parallel (to 1e-6) meet at their middles, where the
/// line between these is across them.
///   (J'J) z = J'(b0 - a0),  the columns of J being the edges of a from a0, and those of b from b0 backwards
template <class Real, std::size_t NA, std::size_t NB>
std::optional<ClosestPoints<Real>> inner_closest_points(std::array<Vec<Real, 3>, NA> const& a,
                                                        std::array<Vec<Real, 3>, NB> const& b) {
  static_assert(NA + NB <= 4, "Sinew: inner_closest_points takes two segments, or a point and a simplex.");
  constexpr int unknowns = int(NA + NB) - 2;
  ClosestPoints<Real> closest{{1, 0, 0}, {1, 0, 0}, a[0], b[0], 0};
  if constexpr (unknowns > 0) {
    using Unknowns = Eigen::Matrix<Real, unknowns, 1>;
    Eigen::Matrix<Real, 3, unknowns> edges;
    for (std::size_t i = 1; i < NA; ++i) edges.col(Eigen::Index(i - 1)) = a[i] - a[0];
    for (std::size_t j = 1; j < NB; ++j) edges.col(Eigen::Index(NA + j - 2)) = b[0] - b[j];
    const Eigen::Matrix<Real, unknowns, unknowns> square = edges.transpose() * edges;
    const Unknowns lengths = square.diagonal();
    const bool parallel = !(square.determinant() > Real(1e-12) * lengths.prod());
    if (parallel && (NA != 2 || NB != 2 || !(lengths.minCoeff() > 0))) return std::nullopt;
    const Unknowns z = parallel ? Unknowns(Unknowns::Constant(Real(0.5)))
                                : Unknowns(square.inverse() * (edges.transpose() * (b[0] - a[0])));
    auto inside = [&z](Vec<Real, 3>& weights, std::size_t first, std::size_t corners) {
      for (std::size_t i = 1; i < corners; ++i) weights[Eigen::Index(i)] = z[Eigen::Index(first + i - 1)];
      weights[0] -= weights.template tail<2>().sum();
      if (!(weights.minCoeff() >= Real(-1e-9))) return false;
      weights = weights.cwiseMax(Real(0)).eval();
      weights /= weights.sum();
      return true;
    };
    if (!inside(closest.weightsA, 0, NA) || !inside(closest.weightsB, NA - 1, NB)) return std::nullopt;
    closest.pointA = detail::weighted_point<Real, NA>(a, closest.weightsA);
    closest.pointB = detail::weighted_point<Real, NB>(b, closest.weightsB);
    const Vec<Real, 3> d = closest.pointB - closest.pointA;
    if (parallel && (edges.transpose() * d).norm() > Real(1e-4) * std::sqrt(lengths.sum()) * d.norm())
      return std::nullopt;
  }
  closest.squaredDistance = (closest.pointB - closest.pointA).squaredNorm();
  return closest;
}

namespace detail {

/// The edge inside which the point with weights w lies, in units of size; zero where it is a corner or inside
/// a face.
template <class Real, std::size_t N>
SINEW_HD Vec<Real, 3> carrying_edge(Simplex<Real, N> const& p, Vec<Real, 3> const& w, Real size) {
  for (std::size_t k = 0; N > 1 && k < SimplexFrame<Real, N>::edgeCount; ++k) {
    const std::size_t i = k, j = (k + 1) % N;
    if (w[Eigen::Index(i)] > 0 && w[Eigen::Index(j)] > 0 && (N == 2 || !(w[Eigen::Index(3 - i - j)] > 0)))
      return (p[j] - p[i]) / size;
  }
  return {Real(0), Real(0), Real(0)};
}

/// The normal of the features on which closest points lie, of either sign and in units of size^2: of a face
/// that holds one inside, else the cross product of two edges; zero where there is neither.
template <class Real, std::size_t NA, std::size_t NB>
SINEW_HD Vec<Real, 3> feature_normal(Simplex<Real, NA> const& a, Simplex<Real, NB> const& b,
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
/// contact_tolerance. Where they touch or cross, what fits the features that meet, oriented such that the
/// middle of b lies ahead of that of a: inside of a face, its normal; two edges, their cross product; else
/// the line between the middles, less its part along an edge that is touched. Where that is empty too: the
/// normal of a triangle, a perpendicular of an edge, the z axis. Never NaN for finite points.
template <class Real, std::size_t NA, std::size_t NB>
SINEW_HD Vec<Real, 3> contact_direction(std::array<Vec<Real, 3>, NA> const& a,
                                        std::array<Vec<Real, 3>, NB> const& b,
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
  auto take = [&](V const& direction, Real minimum) {
    const Real length = direction.norm();
    if (!(length > minimum)) return false;
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
