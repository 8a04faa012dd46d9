// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/core/compiled.hpp>
#include <sinew/core/component.hpp>

#include <vector>

namespace sinew {

/// A straight string, made without a file: `resolution` points from 0 to 1 m along x, and the edges between
/// them.
struct StringMeshCreator {
  using Role = role::Engine;
  static constexpr std::string_view className = "StringMeshCreator";

  int resolution = 2;
  Eigen::Vector3d translation{0, 0, 0}, rotation{0, 0, 0}, scale3d{1, 1, 1};

  static constexpr auto fields() {
    using E = StringMeshCreator;
    return field_list(
        field("resolution", &E::resolution, "", "points", range::atLeast(2)),
        field("translation", &E::translation, "m", "moves the string, last of all"),
        field("rotation",
              &E::rotation,
              "degrees",
              "rotates the string about the axes x, y and z, in this order"),
        field("scale3d", &E::scale3d, "", "sizes along the axes x, y and z, applied first").also("scale"));
  }

  // after update
  std::vector<Eigen::Vector3d> position{};
  std::vector<Edge> edges{};

  static constexpr auto outputs() {
    using E = StringMeshCreator;
    return field_list(field("position", &E::position, "m", "points, along the string").also("points"),
                      field("edges", &E::edges, "", "between neighbours, along the string").also("lines"));
  }

  /// Throws Error for a field out of its range, and for more than 2^24 points.
  void update(std::string_view where);
};

}  // namespace sinew

#if SINEW_DEFINES
#include <sinew/core/placement.hpp>

namespace sinew {

SINEW_ONCE void StringMeshCreator::update(std::string_view where) {
  check_fields(*this, where);
  if (resolution > 16777216)
    throw Error(text(where, ": ", className),
                text("resolution is ", resolution, ", more than 2^24 points; make it coarser"));
  const Placement placed = placement(translation, rotation, scale3d);
  position.clear(), edges.clear();
  for (int i = 0; i < resolution; ++i) {
    position.push_back(placed * Eigen::Vector3d(double(i) / (resolution - 1), 0, 0));
    if (i > 0) edges.push_back({Index(i - 1), Index(i)});
  }
}

}  // namespace sinew
#endif
