// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/core/platform.hpp>

#include <Eigen/Core>
#include <array>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace sinew::view {

/// What the colours of bodies show.
enum class Quantity {
  none,
  displacement,  // of a point from its place at rest [m]
  speed,         // [m/s]
  vonMises,      // stress of the elements around a point, by the rule of von Mises [Pa]
  strainEnergy,  // of the same elements, by their volume [J/m^3]
  stretch        // of springs: length over that without force
};
constexpr std::array<std::string_view, 6> enum_names(Quantity) {
  return {"none", "displacement", "speed", "vonMises", "strainEnergy", "stretch"};
}
struct QuantityWords {
  std::string_view title, unit;
};
constexpr QuantityWords words_of(Quantity quantity) {
  constexpr std::array<QuantityWords, 6> all{{{"", ""},
                                              {"displacement", "m"},
                                              {"speed", "m/s"},
                                              {"von Mises stress", "Pa"},
                                              {"strain energy", "J/m^3"},
                                              {"stretch", ""}}};
  return all[std::size_t(quantity)];
}

/// What arrows are of.
enum class ArrowKind { velocity, force, reaction, contact, attachment };
constexpr std::array<std::string_view, 5> enum_names(ArrowKind) {
  return {"velocities", "forces", "reactions", "contacts", "attachments"};
}

/// What is seen of the half space normal . x <= offset alone.
struct ClipPlane {
  Eigen::Vector3d normal{1, 0, 0};
  double offset = 0;  // [m]
};

/// How one body is to be seen, whatever the others are.
struct BodyLook {
  std::string path{};
  bool visible = true;
  std::optional<Eigen::Vector3d> colour{};  // red, green, blue from 0 to 1
};

/// What is asked for. What nobody asks for is not computed.
struct SeenSettings {
  Quantity colour = Quantity::none;
  std::optional<std::pair<double, double>> range{};  // of the colours; that of the values without one
  std::array<bool, 5> arrows{};                      // of each kind
  bool visualModels = true, states = false;          // states are seen in any case where no visual model is
  bool collisionModels = false, springs = false, constraints = false, normals = false;
  bool wireframe = false, axes = false, grid = false, legend = true, shadows = true;
  std::optional<ClipPlane> clip{};
  std::vector<BodyLook> looks{};
  std::optional<Eigen::Vector3d> background{};

  bool shows(ArrowKind kind) const { return arrows[std::size_t(kind)]; }
  /// Whether the simulation has to keep forces for it.
  bool needsForces() const { return shows(ArrowKind::force) || shows(ArrowKind::reaction); }
};

}  // namespace sinew::view
