// SPDX-License-Identifier: BSL-1.0
#pragma once

// Needs libccd, as convex.hpp does.
#include <sinew/collision/moved_primitive.hpp>
#include <sinew/collision/ray_hits.hpp>

#include <array>
#include <limits>

namespace sinew {

/// By advancement: from a place at the distance d of the hull, in the direction n, the ray goes d /
/// (n.direction) to the plane that keeps the hull from it (van den Bergen 2004).
template <>
struct HullRay<CollisionSurface> {
  static RayHit of(Ray const& ray, CollisionSurface const& s, int element, double end) {
    const detail::MovedPrimitive<Shape::hull> hull(s, element, 0);
    const detail::ConvexView view = hull.view(hull.corners[0]);
    const Eigen::Vector3d start = ray.origin - hull.corners[0];
    const double far = start.norm() + s.hullOf(element).reach() + s.radiusOf(element);
    double t = enter(view, s.radiusOf(element), start, ray.direction, far);
    if (t == 0) {
      t = 2 * far -
          enter(view, s.radiusOf(element), start + 2 * far * ray.direction, -ray.direction, 2 * far);
      if (!(t >= 0)) t = 0;
    }
    RayHit hit;
    if (t <= end) hit.distance = t;
    return hit;
  }

 private:
  static double enter(detail::ConvexView const& view, double radius, Eigen::Vector3d const& start,
                      Eigen::Vector3d const& direction, double end) {
    constexpr double never = std::numeric_limits<double>::infinity();
    double t = 0;
    for (int i = 0; i < 200; ++i) {
      const std::array<Eigen::Vector3d, 1> at{start + t * direction};
      const detail::ConvexView point{at.data(), 1, Eigen::Matrix3d::Identity(), {0, 0, 0}, at[0], 0, 0};
      const double size = (view.middle - at[0]).norm() + view.radius;
      const detail::Gjk nearest(point, view, {0, 0, 0}, size);
      const double toCore = nearest.overlapping ? 0 : nearest.difference.norm(), d = toCore - radius;
      if (d <= 1e-12 * size) return t;
      const double rate = nearest.difference.dot(direction) / toCore;
      if (!(rate * (end - t) >= d)) return never;
      t += d / rate;
    }
    return t;
  }
};

}  // namespace sinew
