// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/core/compiled.hpp>

#include <Eigen/Geometry>

namespace sinew {

/// The rotation that scene files give as three angles [degrees]: about x first, then about the fixed y axis,
/// then about the fixed z axis (Rz Ry Rx), as in SOFA.
Eigen::Quaterniond rotation_of_degrees(Eigen::Vector3d const& degrees);

/// x -> A x + t
struct Placement {
  Eigen::Matrix3d linear;
  Eigen::Vector3d translation;

  Eigen::Vector3d operator*(Eigen::Vector3d const& x) const { return linear * x + translation; }
};

/// x -> R S x + t: sizes along the axes first, then the rotation, then the translation.
Placement placement(Eigen::Vector3d const& translation, Eigen::Quaterniond const& rotation,
                    Eigen::Vector3d const& scale);
inline Placement placement(Eigen::Vector3d const& translation, Eigen::Vector3d const& degrees,
                           Eigen::Vector3d const& scale) {
  return placement(translation, rotation_of_degrees(degrees), scale);
}

}  // namespace sinew

#if SINEW_DEFINES
#include <sinew/core/small_matrix.hpp>

#include <numbers>

namespace sinew {

SINEW_ONCE Eigen::Quaterniond rotation_of_degrees(Eigen::Vector3d const& degrees) {
  const Eigen::Vector3d angle = degrees * (std::numbers::pi / 180);
  return Eigen::AngleAxisd(angle[2], Eigen::Vector3d::UnitZ()) *
         Eigen::AngleAxisd(angle[1], Eigen::Vector3d::UnitY()) *
         Eigen::AngleAxisd(angle[0], Eigen::Vector3d::UnitX());
}

SINEW_ONCE Placement placement(Eigen::Vector3d const& translation, Eigen::Quaterniond const& rotation,
                               Eigen::Vector3d const& scale) {
  Placement p{rotation.toRotationMatrix(), translation};
  for (int j = 0; j < 3; ++j)
    for (int i = 0; i < 3; ++i) p.linear(i, j) *= scale[j];
  return p;
}

}  // namespace sinew
#endif
