// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/core/platform.hpp>

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <concepts>

namespace sinew {

/// A solid given by a scalar field f(p): negative inside, zero on the surface, positive outside.
/// Any callable will do. Meshes come out best when f is close to the distance to the surface, in metres.
template <class Shape>
concept ImplicitShape = requires(Shape const& shape, Eigen::Vector3d const& p) {
  { shape(p) } -> std::convertible_to<double>;
};

/// Ball. f is the exact distance [m].
struct SphereShape {
  Eigen::Vector3d center{Eigen::Vector3d::Zero()};
  double radius = 1;

  double operator()(Eigen::Vector3d const& p) const { return (p - center).norm() - radius; }
};

/// Ellipsoid with its axes along x, y, z. f approximates the distance to first order, g/|grad g| with
/// g = |(x/a, y/b, z/c)| - 1 (Taubin 1994, Distance approximations for rasterizing implicit curves).
struct EllipsoidShape {
  Eigen::Vector3d center{Eigen::Vector3d::Zero()};
  Eigen::Vector3d radii{Eigen::Vector3d::Ones()};

  double operator()(Eigen::Vector3d const& p) const {
    const Eigen::Vector3d scaled = (p - center).cwiseQuotient(radii);
    const double g = scaled.norm();
    const double slope = scaled.cwiseQuotient(radii).norm();  // g |grad g|
    return slope > 0 ? (g - 1) * g / slope : -radii.minCoeff();
  }
};

/// All points nearer than `radius` to the segment from `begin` to `end`. f is the exact distance [m].
struct CapsuleShape {
  Eigen::Vector3d begin{Eigen::Vector3d::Zero()};
  Eigen::Vector3d end{Eigen::Vector3d::UnitX()};
  double radius = 0.5;

  double operator()(Eigen::Vector3d const& p) const {
    const Eigen::Vector3d axis = end - begin;
    const double squared = axis.squaredNorm();
    const double t = squared > 0 ? std::clamp((p - begin).dot(axis) / squared, 0.0, 1.0) : 0.0;
    return (p - begin - t * axis).norm() - radius;
  }
};

/// Box with its faces normal to x, y, z. f is the exact distance [m].
struct BoxShape {
  Eigen::Vector3d lo{-Eigen::Vector3d::Ones()};
  Eigen::Vector3d hi{Eigen::Vector3d::Ones()};

  double operator()(Eigen::Vector3d const& p) const {
    const Eigen::Vector3d beyond = (lo - p).cwiseMax(p - hi);
    return beyond.cwiseMax(0).norm() + std::min(beyond.maxCoeff(), 0.0);
  }
};

/// min(a, b), rounded where |a - b| < k: the quadratic polynomial smooth minimum (Quilez 2013, Smooth
/// minimum). It is C1, and lowers the minimum by k/4 at most. k = 0 gives min(a, b).
inline double smooth_minimum(double a, double b, double k) {
  const double overlap = k > 0 ? std::max(k - std::abs(a - b), 0.0) / k : 0.0;
  return std::min(a, b) - overlap * overlap * k / 4;
}

/// a and b melted together, with a fillet whose size is `blend` [m].
template <ImplicitShape A, ImplicitShape B>
struct SmoothUnion {
  A a;
  B b;
  double blend = 0;

  double operator()(Eigen::Vector3d const& p) const { return smooth_minimum(a(p), b(p), blend); }
};
template <class A, class B>
SmoothUnion(A, B, double) -> SmoothUnion<A, B>;

/// a without b, the rim rounded over `blend` [m]. max(a, -b) = -min(-a, b).
template <ImplicitShape A, ImplicitShape B>
struct SmoothSubtraction {
  A a;
  B b;
  double blend = 0;

  double operator()(Eigen::Vector3d const& p) const { return -smooth_minimum(-a(p), b(p), blend); }
};
template <class A, class B>
SmoothSubtraction(A, B, double) -> SmoothSubtraction<A, B>;

/// A body like a human liver, in metres: 0.22 wide (x, right lobe at -x), 0.12 high (y, up), 0.12 deep (z,
/// front), 1.4 litres. A large right lobe, a thin left lobe, a hollow underside, a notch in the lower front
/// edge between the lobes. It is one piece without holes, so its surface has Euler characteristic 2.
struct LiverShape {
  /// Corners of a box around the body, with a margin of some millimetres.
  static Eigen::Vector3d box_min() { return {-0.116, -0.066, -0.066}; }
  static Eigen::Vector3d box_max() { return {0.116, 0.071, 0.066}; }

  double operator()(Eigen::Vector3d const& p) const {
    const EllipsoidShape rightLobe{{-0.035, 0, 0}, {0.075, 0.065, 0.06}};
    const EllipsoidShape leftLobe{{0.045, 0.018, 0.006}, {0.065, 0.032, 0.042}};
    const EllipsoidShape hollow{{0.0, -0.076, -0.014}, {0.065, 0.05, 0.05}};
    const CapsuleShape notch{{0.026, -0.05, 0.03}, {0.022, 0.004, 0.056}, 0.013};
    double f = smooth_minimum(rightLobe(p), leftLobe(p), 0.03);
    f = -smooth_minimum(-f, hollow(p), 0.015);
    return -smooth_minimum(-f, notch(p), 0.012);
  }
};

}  // namespace sinew
