// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/collision/closest_points.hpp>

#include <optional>

namespace sinew {

namespace detail {

/// Two simplices in motion, as seen from the first point of a at time 0.
template <class Real, std::size_t NA, std::size_t NB>
struct MovingPair {
  Simplex<Real, NA> startA, motionA, a;
  Simplex<Real, NB> startB, motionB, b;
  Real extent = 0;  // largest coordinate of an edge at time 0
  Real size = 0;    // largest coordinate of a start or a motion: what rounding is relative to
  Real speed = 0;   // nothing of a comes nearer to anything of b faster than this (Li et al. 2021)

  MovingPair(Simplex<Real, NA> const& a0, Simplex<Real, NA> const& a1, Simplex<Real, NB> const& b0,
             Simplex<Real, NB> const& b1) {
    Vec<Real, 3> common(0, 0, 0);
    auto prepare = [&](auto const& from, auto const& to, auto& start, auto& motion) {
      for (std::size_t i = 0; i < from.size(); ++i) {
        start[i] = from[i] - a0[0];
        motion[i] = to[i] - from[i];
        common += motion[i] / Real(NA + NB);
        for (Eigen::Index k = 0; k < 3; ++k) {
          extent = std::max(extent, std::abs(from[i][k] - from[0][k]));
          size = std::max({size, std::abs(start[i][k]), std::abs(motion[i][k])});
        }
      }
    };
    prepare(a0, a1, startA, motionA);
    prepare(b0, b1, startB, motionB);
    auto fastest = [&](auto& motion) {
      Real square = 0;
      for (auto& v : motion) v -= common, square = std::max(square, v.squaredNorm());
      return std::sqrt(square);
    };
    speed = fastest(motionA);
    speed += fastest(motionB);
  }

  void moveTo(Real t) {
    for (std::size_t i = 0; i < NA; ++i) a[i] = startA[i] + t * motionA[i];
    for (std::size_t j = 0; j < NB; ++j) b[j] = startB[j] + t * motionB[j];
  }

  /// For how long a and b stay farther apart along the unit vector n than `gap`: each point of b beyond each
  /// of a.
  Real timeApart(Vec<Real, 3> const& n, Real gap) const {
    Real time = std::numeric_limits<Real>::infinity();
    for (std::size_t i = 0; i < NA; ++i)
      for (std::size_t j = 0; j < NB; ++j) {
        const Real slack = (b[j] - a[i]).dot(n) - gap, rate = (motionA[i] - motionB[j]).dot(n);
        if (!(slack > 0)) return 0;
        if (rate > 0) time = std::min(time, slack / rate);
      }
    return time;
  }
};

}  // namespace detail

/// A time at or before the first one at which the distance of a and b falls to `thickness`, their points
/// moving from a0, b0 at time 0 straight to a1, b1 at time 1; nullopt where the distance stays above it.
/// Vertex and face, edge and edge, and all other pairs of 1, 2 or 3 points. Places are finite,
/// the thickness is not negative.
///
/// Never late, at any speed: time advances by steps after which a and b are surely apart still (conservative
/// advancement, Mirtich 1996): the longest of those in which they stay on two sides of a slab across the line
/// of their nearest points, or across the normal of the features on which these lie, and the distance over
/// the largest relative speed (additive advancement: Li, Kaufman, Jiang 2021, Codimensional Incremental
/// Potential Contact). Near the end of the approach these are Newton's steps.
///
/// Early by little: at the time found the distance is above `thickness`, by at most
///   sigma = max(relativeGap min(d0 - thickness, max(thickness, extent)), 32 eps size),
/// d0 the distance at time 0, extent the largest coordinate of an edge then (two points without thickness:
/// d0), size the largest coordinate of a distance or a motion. So an approach that comes as near as this is
/// reported, though it may reverse or pass by. Rounding moves the distance by an eighth of sigma at most.
/// After maxIterations steps the time reached is the answer, which is earlier; two steps are usual, more than
/// 100 rare (rotating needles). 0 where d0 exceeds the thickness by less than 32 eps size, or not at all,
/// whatever the motion.
template <class Real, std::size_t NA, std::size_t NB>
std::optional<Real> time_of_impact(std::array<Vec<Real, 3>, NA> const& a0,
                                   std::array<Vec<Real, 3>, NA> const& a1,
                                   std::array<Vec<Real, 3>, NB> const& b0,
                                   std::array<Vec<Real, 3>, NB> const& b1, Real thickness = 0,
                                   Real relativeGap = Real(1e-3), int maxIterations = 1000) {
  detail::MovingPair<Real, NA, NB> pair(a0, a1, b0, b1);
  const Real resolution = 32 * std::numeric_limits<Real>::epsilon() * pair.size;
  Real t = 0, sigma = resolution;
  for (int i = 0; i < maxIterations; ++i) {
    pair.moveTo(t);
    const auto closest = closest_points(pair.a, pair.b);
    const Real distance = std::sqrt(closest.squaredDistance);
    if (i == 0) {
      if (!(distance > thickness + resolution)) return Real(0);
      const Real start = distance - thickness, scale = std::max(thickness, pair.extent);
      sigma = std::max(resolution, relativeGap * (scale > 0 ? std::min(start, scale) : start));
    }
    if (distance <= thickness + sigma) return t;
    const Real gap = thickness + sigma / 2;
    Real step = (distance - gap) / pair.speed;
    const Vec<Real, 3> d =
        detail::weighted_difference<Real, NA, NB>(pair.a, pair.b, closest.weightsA, closest.weightsB);
    step = std::max(step, pair.timeApart(d / distance, gap));
    if (t + step < 1) {
      Vec<Real, 3> n = detail::feature_normal<Real, NA, NB>(pair.a, pair.b, closest, pair.size);
      if (const Real length = n.norm(); length > 0)
        step = std::max(
            step, pair.timeApart(n.dot(d) < 0 ? Vec<Real, 3>(-n / length) : Vec<Real, 3>(n / length), gap));
    }
    if (t + step >= 1) return std::nullopt;
    if (!(t + step > t)) return t;
    t += step;
  }
  return t;
}

}  // namespace sinew
