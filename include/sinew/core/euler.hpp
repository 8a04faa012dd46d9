// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <Eigen/Geometry>
#include <numbers>

namespace sinew {

/// The rotation that scene files give as three angles [degrees]: about x first, then about the fixed y axis,
/// then about the fixed z axis (Rz Ry Rx), as in SOFA.
inline Eigen::Quaterniond rotation_of_degrees(Eigen::Vector3d const& degrees) {
  const Eigen::Vector3d angle = degrees * (std::numbers::pi / 180);
  return Eigen::AngleAxisd(angle[2], Eigen::Vector3d::UnitZ()) *
         Eigen::AngleAxisd(angle[1], Eigen::Vector3d::UnitY()) *
         Eigen::AngleAxisd(angle[0], Eigen::Vector3d::UnitX());
}

/// x -> R S x + t: sizes along the axes first, then the rotation, then the translation.
inline Eigen::Affine3d placement(Eigen::Vector3d const& translation, Eigen::Vector3d const& degrees,
                                 Eigen::Vector3d const& scale) {
  return Eigen::Translation3d(translation) * rotation_of_degrees(degrees) * Eigen::Scaling(scale);
}

}  // namespace sinew
