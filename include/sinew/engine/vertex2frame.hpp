// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/core/compiled.hpp>
#include <sinew/core/component.hpp>

#include <vector>

namespace sinew {

/// A frame at each point of a mesh: z along its normal and x across y; or, without normals, x from each point
/// to the next. Then they rotate by an angle about one of their axes.
struct Vertex2Frame {
  using Role = role::Engine;
  static constexpr std::string_view className = "Vertex2Frame";

  std::vector<Eigen::Vector3d> position{}, normals{};
  bool useNormals = true, invertNormals = false;
  int rotation = 0;
  double rotationAngle = 0;

  static constexpr auto fields() {
    using F = Vertex2Frame;
    return field_list(field("position", &F::position, "m", "points of the mesh"),
                      field("normals", &F::normals, "", "of the points"),
                      field("useNormals", &F::useNormals, "", "whether frames are along normals"),
                      field("invertNormals", &F::invertNormals, "", "whether z is against them"),
                      field("rotation",
                            &F::rotation,
                            "",
                            "axis of the rotation: 0 for x, 1 for y, 2 for z",
                            range::closed(0, 2)),
                      field("rotationAngle", &F::rotationAngle, "degrees", "by which each frame rotates"));
  }

  Rigid3d::VecCoord frames{};  // after update

  static constexpr auto outputs() {
    return field_list(field("frames", &Vertex2Frame::frames, "m", "one at each point"));
  }

  /// Throws Error where a point has no normal, or there is no next point; the output then stays.
  void update(std::string_view where);
};

}  // namespace sinew

#if SINEW_DEFINES
#include <cmath>
#include <limits>
#include <numbers>

namespace sinew {

SINEW_ONCE void Vertex2Frame::update(std::string_view where) {
  check_fields(*this, where);
  const std::string at = text(where, ": ", className);
  const std::size_t n = position.size();
  if (n == 0) throw Error(at, "position is empty; link it to the points of a loader");
  if (useNormals && normals.size() != n)
    throw Error(at,
                text("there are ",
                     normals.size(),
                     " normals for ",
                     n,
                     " points; give one each, or set useNormals=\"0\""));
  if (!useNormals && n < 2) throw Error(at, "there is one point only; give more, or normals");
  auto unit = [&](Eigen::Vector3d const& v, std::size_t i) -> Eigen::Vector3d {
    if (!(v.norm() > 0))
      throw Error(at,
                  text("point ",
                       i,
                       useNormals ? " has a normal of 0 0 0" : " is where the next one is",
                       "; correct it"));
    return v.stableNormalized();
  };
  // the axis that is nearly along `along` gives way to another
  auto across =
      [](Eigen::Vector3d const& along, Eigen::Vector3d const& wanted, Eigen::Vector3d const& other) {
        return 1 - std::abs(along.dot(wanted)) <= std::numeric_limits<double>::epsilon() ? other : wanted;
      };
  Rigid3d::VecCoord made(n);
  for (std::size_t i = 0; i < n; ++i) {
    made[i].center = position[i];
    if (!useNormals && i + 1 == n) {
      made[i].orientation = made[i - 1].orientation;
      continue;
    }
    Eigen::Matrix3d axes;
    if (useNormals) {
      axes.col(2) = unit(invertNormals ? -normals[i] : normals[i], i);
      axes.col(0) = across(axes.col(2), Eigen::Vector3d::UnitY(), Eigen::Vector3d::UnitZ())
                        .cross(axes.col(2))
                        .normalized();
      axes.col(1) = axes.col(2).cross(axes.col(0)).normalized();
    } else {
      axes.col(0) = unit(position[i + 1] - position[i], i);
      axes.col(1) = across(axes.col(0), Eigen::Vector3d::UnitX(), Eigen::Vector3d::UnitZ())
                        .cross(axes.col(0))
                        .normalized();
      axes.col(2) = axes.col(0).cross(axes.col(1)).normalized();
    }
    const Eigen::AngleAxisd turn(rotationAngle * std::numbers::pi / 180, axes.col(rotation));
    made[i].orientation = Quat<double>(turn * Eigen::Quaterniond(axes)).normalized();
  }
  frames = std::move(made);
}

}  // namespace sinew
#endif
