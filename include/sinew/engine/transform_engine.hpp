// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/core/component.hpp>
#include <sinew/core/placement.hpp>

#include <string>

namespace sinew {

/// Places points, or rigid bodies with their orientation, anew: sizes along the axes first, then the rotation
/// by angles, then that by the quaternion, then the translation; or all of that undone.
template <class D>
struct TransformEngine {
  using Role = role::Engine;
  using DataTypes = D;
  static_assert(D::spatial == 3 && (D::rigid || D::size == 3),
                "TransformEngine places points or rigid bodies in space");
  static constexpr std::string_view className = "TransformEngine";

  typename D::VecCoord inputPosition{};
  Eigen::Vector3d translation{0, 0, 0}, rotation{0, 0, 0};
  Eigen::Vector4d quaternion{0, 0, 0, 1};
  Eigen::Vector3d scale{1, 1, 1};
  bool inverse = false;

  static constexpr auto fields() {
    using T = TransformEngine;
    return field_list(
        field("input_position", &T::inputPosition, "m", "where the points are"),
        field("translation", &T::translation, "m", "moves the points"),
        field("rotation", &T::rotation, "degrees", "rotates them about the axes x, y and z, in this order"),
        field(
            "quaternion", &T::quaternion, "", "rotates them after that: x y z w of a quaternion of length 1"),
        field("scale", &T::scale, "", "sizes along the axes x, y and z"),
        field("inverse", &T::inverse, "", "whether the inverse of all that is applied"));
  }

  typename D::VecCoord outputPosition{};  // after update

  static constexpr auto outputs() {
    return field_list(
        field("output_position", &TransformEngine::outputPosition, "m", "where the points are placed"));
  }

  /// Throws Error when the quaternion is zero, or a size is where the inverse is asked for.
  void update(std::string_view where) {
    check_fields(*this, where);
    const std::string at = text(where, ": ", component_name<TransformEngine>());
    if (!(quaternion.norm() > 1e-6))
      throw Error(at, "quaternion is zero; give one of length 1, such as 0 0 0 1");
    if (inverse && (scale[0] == 0 || scale[1] == 0 || scale[2] == 0))
      throw Error(at, "a size of scale is 0, which cannot be undone; give another one");
    Eigen::Quaterniond rotate(quaternion.normalized());
    rotate = rotate * rotation_of_degrees(rotation);
    Placement placed = placement(translation, rotate, scale);
    if (inverse) {
      placed.linear = placed.linear.inverse().eval();
      placed.translation = placed.linear * -translation;
      rotate = rotate.conjugate();
    }

    using Real = typename D::Real;
    outputPosition = inputPosition;
    for (auto& x : outputPosition)
      if constexpr (D::rigid) {
        x.center = (placed * x.center.template cast<double>()).template cast<Real>();
        x.orientation = (rotate.cast<Real>() * x.orientation).normalized();
      } else {
        x = (placed * x.template cast<double>()).template cast<Real>();
      }
  }
};

}  // namespace sinew
