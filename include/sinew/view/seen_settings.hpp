// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/core/platform.hpp>
#include <sinew/view/seen_material.hpp>

#include <Eigen/Core>
#include <array>
#include <memory>
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

/// A light of a scene.
struct SeenLight {
  enum class Kind { parallel, point, spot };
  Kind kind = Kind::parallel;
  Eigen::Vector3d colour{1, 1, 1};     // red, green, blue
  Eigen::Vector3d position{0, 0, 0};   // of a point or spot [m]
  Eigen::Vector3d direction{0, 0, 1};  // of length 1: towards a parallel light; of a spot where it shines to
  double attenuation = 0;              // at a distance d a point or spot has 1 / (1 + attenuation d) [1/m]
  double cutoff = 30, exponent = 20;  // of a spot: half the angle of its cone [degrees]; (cos angle)^exponent
  bool movesWithCamera = false;       // its place is relative to the eye, which looks along -z
};
inline constexpr std::size_t mostLights = 8;

/// How one body is to be seen, whatever the others are.
struct BodyLook {
  std::string path{};
  bool visible = true;
  std::optional<Eigen::Vector3d> colour{};  // red, green, blue from 0 to 1
  std::optional<double> opacity{};          // from 0 to 1; what is behind shows through where it is less
  std::string image{};                      // the file of a texture, and where it was written, for messages
  std::string origin{};
  std::shared_ptr<SeenTexture const> texture{};  // of it, where it was read (load_materials())
};

/// What is asked for. What nobody asks for is not computed.
struct SeenSettings {
  Quantity colour = Quantity::none;
  std::optional<std::pair<double, double>> range{};  // of the colours; that of the values without one
  std::array<bool, 5> arrows{};                      // of each kind
  bool visualModels = true, states = false;          // states are seen in any case where no visual model is
  bool collisionModels = false, springs = false, constraints = false, normals = false;
  bool wireframe = false, axes = false, grid = false, legend = true, shadows = true,
       occlusion = false;  // less light from all sides in corners
  std::optional<ClipPlane> clip{};
  std::vector<BodyLook> looks{};
  std::vector<SeenMaterial> materials{};  // that visual models name (load_materials())
  std::optional<Eigen::Vector3d> background{};
  std::vector<SeenLight> lights{};           // none: one from the left above the eye
  std::optional<Eigen::Vector3d> ambient{};  // what comes from all sides; without it white, more from above
  bool boxes = false;             // of collision models and their elements, by which collisions are found
  std::optional<int> boxLevel{};  // of these only those of one level; 0: around a model

  bool shows(ArrowKind kind) const { return arrows[std::size_t(kind)]; }
  /// Whether the simulation has to keep forces for it.
  bool needsForces() const { return shows(ArrowKind::force) || shows(ArrowKind::reaction); }
};

}  // namespace sinew::view
