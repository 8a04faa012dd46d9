// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/core/component.hpp>

#include <optional>
#include <string>

namespace sinew {

/// Removes the elements of a body that a tool touches, while the scene runs: after detection, the tetrahedra
/// and hexahedra (of a body without them, the triangles and quads) under those triangles of its collision
/// model that are nearer to the tool than the carving distance. Stands beside the collision pipeline. The
/// last element of a body stays.
struct CarvingManager {
  using Role = role::Carving;
  static constexpr std::string_view className = "CarvingManager";

  bool active = false;
  std::optional<double> carvingDistance{};
  std::string toolModel{}, surfaceModelPath{};

  static constexpr auto fields() {
    using C = CarvingManager;
    return field_list(
        field("active", &C::active, "", "whether it removes anything"),
        field("carvingDistance",
              &C::carvingDistance,
              "m",
              "distance below which what is touched is removed: that from which contacts act when not given; "
              "negative: only what the tool has gone into"),
        field("toolModel",
              &C::toolModel,
              "",
              "path of the node with the collision models of the tool, or of a node above them")
            .also("toolModelPath"),
        field("surfaceModelPath",
              &C::surfaceModelPath,
              "",
              "the same of what is carved; all bodies whose elements can be removed when not given")
            .also("surfaceModel"));
  }

  // after init: paths from the root of the scene on
  std::string tool{}, body{};
  // of the steps
  long removed = 0;       // elements so far
  std::string message{};  // what could not be removed in the last step in which something could not

  /// What is carved stays so.
  void reset() { message.clear(); }
};

}  // namespace sinew
