// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/core/compiled.hpp>
#include <sinew/core/platform.hpp>

#include <Eigen/Geometry>
#include <array>
#include <limits>

namespace sinew {

/// The half-line origin + t direction, t >= 0, with a direction of length 1: t is a distance.
struct Ray {
  Eigen::Vector3d origin, direction;

  Eigen::Vector3d at(double t) const { return origin + t * direction; }
};

/// Where a ray meets a primitive: the distance along it, and the weights of the corners.
struct RayHit {
  double distance = std::numeric_limits<double>::infinity();
  std::array<double, 3> weights{1, 0, 0};

  explicit operator bool() const { return distance < std::numeric_limits<double>::infinity(); }
};

/// Where it enters the sphere, or leaves that in which it begins.
RayHit ray_sphere(Ray const& ray, Eigen::Vector3d const& center, double radius);

/// The same for what is within a radius of a segment, a capsule; the weights are those of the nearest place
/// on the segment.
RayHit ray_capsule(Ray const& ray, std::array<Eigen::Vector3d, 2> const& p, double radius);

/// Where it enters a hull, or leaves that in which it begins: of(ray, surface, element, end), up to the
/// distance `end`. Declared here only: hull_ray.hpp, which needs libccd, defines it for who has hulls.
template <class Hulls>
struct HullRay;

/// Where it is nearest to a point, if it passes within `tolerance` of it.
RayHit ray_point(Ray const& ray, Eigen::Vector3d const& point, double tolerance);

/// Where it is nearest to a segment, if it passes within `tolerance` of it; of a segment along the ray at its
/// first point.
RayHit ray_segment(Ray const& ray, std::array<Eigen::Vector3d, 2> const& p, double tolerance);

/// Where it goes through a triangle, from either side. No ray passes between triangles that share an edge or
/// a corner (Woop, Benthin and Wald 2013): they are sheared along the ray into a plane, where each vertex is
/// at the same place for all, and the test of an edge is the same number for both of its triangles,
/// `corners` being the numbers of the vertices. A triangle seen from its edge, or without area, is not hit.
RayHit ray_triangle(Ray const& ray, std::array<Eigen::Vector3d, 3> const& p,
                    std::array<int, 3> const& corners);

}  // namespace sinew

#if SINEW_DEFINES
#include <algorithm>
#include <cmath>

namespace sinew {

SINEW_ONCE RayHit ray_sphere(Ray const& ray, Eigen::Vector3d const& center, double radius) {
  const Eigen::Vector3d d = center - ray.origin;
  const double along = d.dot(ray.direction);
  const double half = radius * radius - (d - along * ray.direction).squaredNorm();
  if (!(half >= 0)) return {};
  const double h = std::sqrt(half), t = along >= h ? along - h : along + h;
  if (!(t >= 0)) return {};
  return {t, {1, 0, 0}};
}

SINEW_ONCE RayHit ray_capsule(Ray const& ray, std::array<Eigen::Vector3d, 2> const& p, double radius) {
  // the part of the line in the capsule is from the first to the last place in one of its two balls or its
  // cylinder, as all of them are convex and so is their union
  constexpr double never = std::numeric_limits<double>::infinity();
  double first = never, last = -never;
  auto include = [&](double from, double to) {
    if (from <= to) first = std::min(first, from), last = std::max(last, to);
  };
  for (Eigen::Vector3d const& end : p) {
    const Eigen::Vector3d d = end - ray.origin;
    const double along = d.dot(ray.direction);
    const double half = radius * radius - (d - along * ray.direction).squaredNorm();
    if (half >= 0) include(along - std::sqrt(half), along + std::sqrt(half));
  }
  const Eigen::Vector3d axis = p[1] - p[0];
  const double length = axis.norm();
  if (length > 0) {
    const Eigen::Vector3d u = axis / length, d = ray.origin - p[0];
    const double rise = ray.direction.dot(u), start = d.dot(u);
    const Eigen::Vector3d across = ray.direction - rise * u, away = d - start * u;
    double from = -never, to = never;
    if (const double square = across.squaredNorm(); square > 1e-24) {
      const double middle = -across.dot(away) / square;
      const double half = (radius * radius - (away + middle * across).squaredNorm()) / square;
      from = middle - std::sqrt(std::max(0.0, half)), to = middle + std::sqrt(std::max(0.0, half));
      if (half < 0) to = -never;
    } else if (away.norm() > radius) {
      to = -never;
    }
    if (rise != 0) {
      const auto [low, high] = std::minmax(-start / rise, (length - start) / rise);
      from = std::max(from, low), to = std::min(to, high);
    } else if (start < 0 || start > length) {
      to = -never;
    }
    include(from, to);
  }
  const double t = first >= 0 ? first : last;
  if (!(t >= 0) || !(first <= last)) return {};
  const double s = length > 0 ? std::clamp((ray.at(t) - p[0]).dot(axis) / (length * length), 0.0, 1.0) : 0.0;
  return {t, {1 - s, s, 0}};
}

SINEW_ONCE RayHit ray_point(Ray const& ray, Eigen::Vector3d const& point, double tolerance) {
  const double t = std::max(0.0, (point - ray.origin).dot(ray.direction));
  if (!((point - ray.at(t)).norm() <= tolerance)) return {};
  return {t, {1, 0, 0}};
}

SINEW_ONCE RayHit ray_segment(Ray const& ray, std::array<Eigen::Vector3d, 2> const& p, double tolerance) {
  const Eigen::Vector3d e = p[1] - p[0], w = p[0] - ray.origin;
  const double ee = e.squaredNorm(), ed = e.dot(ray.direction), ew = e.dot(w), dw = ray.direction.dot(w);
  const double across = ee - ed * ed;  // ee sin^2 of the angle between
  RayHit best;
  double minimum = std::numeric_limits<double>::infinity();
  auto consider = [&](double s) {
    s = std::clamp(s, 0.0, 1.0);
    const double t = std::max(0.0, dw + s * ed);
    const double distance = (w + s * e - t * ray.direction).norm();
    if (!(distance <= tolerance) || distance > minimum || (distance == minimum && t >= best.distance)) return;
    minimum = distance;
    best = {t, {1 - s, s, 0}};
  };
  consider(0);
  consider(1);
  if (ee > 0) consider(-ew / ee);                              // nearest to the origin
  if (across > 1e-14 * ee) consider((ed * dw - ew) / across);  // nearest to the line
  return best;
}

SINEW_ONCE RayHit ray_triangle(Ray const& ray, std::array<Eigen::Vector3d, 3> const& p,
                               std::array<int, 3> const& corners) {
  Eigen::Index z = 0;
  ray.direction.cwiseAbs().maxCoeff(&z);
  const Eigen::Index x = (z + 1) % 3, y = (z + 2) % 3;
  std::array<Eigen::Vector3d, 3> q;
  std::array<std::array<double, 2>, 3> flat;
  for (std::size_t c = 0; c < 3; ++c) {
    q[c] = p[c] - ray.origin;
    const double along = q[c][z] / ray.direction[z];
    flat[c] = {q[c][x] - along * ray.direction[x], q[c][y] - along * ray.direction[y]};
  }
  auto area = [&](std::size_t i, std::size_t j) { return flat[i][0] * flat[j][1] - flat[i][1] * flat[j][0]; };
  // twice that of an edge with the ray, which is also the weight of the corner opposite
  auto side = [&](std::size_t i, std::size_t j) {
    return corners[i] < corners[j] ? area(i, j) : -area(j, i);
  };
  const std::array<double, 3> w{side(1, 2), side(2, 0), side(0, 1)};
  if (!((w[0] >= 0 && w[1] >= 0 && w[2] >= 0) || (w[0] <= 0 && w[1] <= 0 && w[2] <= 0))) return {};
  const double sum = w[0] + w[1] + w[2];
  if (sum == 0) return {};
  RayHit hit{0, {w[0] / sum, w[1] / sum, w[2] / sum}};
  for (std::size_t c = 0; c < 3; ++c) hit.distance += hit.weights[c] * q[c].dot(ray.direction);
  if (!(hit.distance >= 0)) return {};
  return hit;
}

}  // namespace sinew
#endif
