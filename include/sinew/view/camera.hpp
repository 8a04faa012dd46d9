// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/core/platform.hpp>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

namespace sinew::view {

/// Looks at a point from a distance, in perspective.
struct Camera {
  Eigen::Vector3d target{0, 0, 0};
  Eigen::Vector3d toEye{0, 0, 1};  // from the target, of length 1
  Eigen::Vector3d up{0, 1, 0};     // what is upwards in the picture; not along toEye
  double distance = 1;             // of the eye from the target [m]
  double angle = 40;               // between the upper and the lower edge of the picture [degrees]
  double near = 0.01, far = 100;   // what is nearer or farther than that is not seen [m]

  bool operator==(Camera const&) const = default;
  Eigen::Vector3d eye() const { return target + distance * toEye; }
  Eigen::Vector3d right() const { return up.cross(toEye).normalized(); }
  Eigen::Vector3d above() const { return toEye.cross(right()); }

  /// From the world to the eye, which looks along its -z.
  Eigen::Matrix4d toView() const {
    Eigen::Matrix4d m = Eigen::Matrix4d::Identity();
    m.block<1, 3>(0, 0) = right().transpose();
    m.block<1, 3>(1, 0) = above().transpose();
    m.block<1, 3>(2, 0) = toEye.transpose();
    m.block<3, 1>(0, 3) = -(m.block<3, 3>(0, 0) * eye());
    return m;
  }
  /// From the eye to OpenGL's cube of [-1, 1].
  Eigen::Matrix4d toClip(double aspect) const {
    const double f = 1 / std::tan(angle / 2 * std::numbers::pi / 180);
    Eigen::Matrix4d m = Eigen::Matrix4d::Zero();
    m(0, 0) = f / aspect;
    m(1, 1) = f;
    m(2, 2) = (far + near) / (near - far);
    m(2, 3) = 2 * far * near / (near - far);
    m(3, 2) = -1;
    return m;
  }
  /// The pixel, from the upper left corner on, at which a point is seen, and its depth, from 0 to 1.
  Eigen::Vector3d project(Eigen::Vector3d const& point, int width, int height) const {
    const Eigen::Vector4d clip = toClip(double(width) / height) * (toView() * point.homogeneous());
    const Eigen::Vector3d at = clip.head<3>() / clip[3];
    return {(at[0] + 1) / 2 * width, (1 - at[1]) / 2 * height, (at[2] + 1) / 2};
  }
  /// Origin and direction of the ray that is seen at a pixel.
  std::pair<Eigen::Vector3d, Eigen::Vector3d> ray(double x, double y, int width, int height) const {
    const double half = std::tan(angle / 2 * std::numbers::pi / 180);
    const double across = (2 * x / width - 1) * half * width / height, upwards = (1 - 2 * y / height) * half;
    return {eye(), (across * right() + upwards * above() - toEye).normalized()};
  }
  /// Sees a sphere as a whole, the direction left as it is.
  void fit(Eigen::Vector3d const& centre, double radius, double aspect) {
    const double half = angle / 2 * std::numbers::pi / 180;
    const double narrow = std::min(half, std::atan(std::tan(half) * aspect));
    target = centre;
    distance = radius / std::sin(narrow);
    near = std::max(distance - 3 * radius, distance / 100);
    far = distance + 5 * radius;
  }
  /// Turns round the target: about what is upwards, and towards it, by angles [rad].
  void orbit(double about, double towards) {
    const Eigen::Vector3d upward = up.normalized();
    toEye = Eigen::AngleAxisd(about, upward) * toEye;
    const double height = std::asin(std::clamp(toEye.dot(upward), -1., 1.));
    const double limit = 89. / 180 * std::numbers::pi;  // at the pole, right() has no direction
    const double turn = std::clamp(height + towards, -limit, limit) - height;
    toEye = (Eigen::AngleAxisd(-turn, right()) * toEye).normalized();
  }
};

}  // namespace sinew::view
