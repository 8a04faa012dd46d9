// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/runtime/value_text.hpp>
#include <sinew/runtime/view_element.hpp>
#include <sinew/view/camera.hpp>
#include <sinew/view/seen_settings.hpp>

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace sinew::view {

/// How a scene file wants its scene to be seen.
struct ViewSettings {
  SeenSettings seen{};
  std::optional<Camera> camera{};
  std::vector<std::string> warnings{};  // what could not be understood
};

namespace detail {

struct NamedColour {
  std::string_view name;
  std::array<double, 3> colour;
};
inline constexpr std::array<NamedColour, 9> namedColours{{{"white", {1, 1, 1}},
                                                          {"black", {0, 0, 0}},
                                                          {"red", {1, 0, 0}},
                                                          {"green", {0, 1, 0}},
                                                          {"blue", {0, 0, 1}},
                                                          {"cyan", {0, 1, 1}},
                                                          {"magenta", {1, 0, 1}},
                                                          {"yellow", {1, 1, 0}},
                                                          {"gray", {0.5, 0.5, 0.5}}}};

/// Red, green, blue, and opacity.
struct SaidColour {
  Eigen::Vector3d colour{0, 0, 0};
  double opacity = 1;
};

/// A colour as SOFA writes it: "red", "#ff0000", "#ff0000ff", or three or four numbers from 0 to 1, of which
/// the last is opacity. Throws Error where it is none.
inline SaidColour colour_of_words(std::string_view words) {
  const std::string_view word = Words(words).peek();
  for (NamedColour const& named : namedColours)
    if (named.name == word) return {Eigen::Vector3d(named.colour.data())};
  if (word == "grey") return {{0.5, 0.5, 0.5}};
  if (word.starts_with('#')) {
    const std::string_view digits = word.substr(1);
    if ((digits.size() != 6 && digits.size() != 8) ||
        digits.find_first_not_of("0123456789abcdefABCDEF") != digits.npos)
      throw Error("", text(sinew::detail::shown(word), " is no colour; write #rrggbb"));
    auto part = [&](std::size_t c) {
      int value = 0;
      std::from_chars(digits.data() + 2 * c, digits.data() + 2 * c + 2, value, 16);
      return value / 255.;
    };
    return {{part(0), part(1), part(2)}, digits.size() == 8 ? part(3) : 1};
  }
  std::vector<double> numbers;
  read_value(words, numbers);
  if (numbers.size() != 3 && numbers.size() != 4)
    throw Error("", text(sinew::detail::shown(words), " is no colour; write red, #ff0000, or 1 0 0"));
  for (const double number : numbers)
    if (!(number >= 0 && number <= 1))
      throw Error("", text("a colour has ", number, ", but its numbers are from 0 to 1"));
  return {{numbers[0], numbers[1], numbers[2]}, numbers.size() == 4 ? numbers[3] : 1};
}

/// The diffuse colour of a material as SOFA writes it: "Default Diffuse 1 1 0 0 1 Ambient 0 ...", where the
/// number behind a word says whether it is used. None where there is no such colour.
inline std::optional<SaidColour> diffuse_of_material(std::string_view material) {
  for (Words words(material); !words.end();)
    if (words.next() == "Diffuse") {
      std::array<double, 5> numbers{};
      for (double& number : numbers)
        number = std::clamp(sinew::detail::read_number<double>(sinew::detail::need_word(
                                words, "whether there is a colour, and red, green, blue, opacity")),
                            0.,
                            1.);
      if (numbers[0] == 0) return {};
      return SaidColour{{numbers[1], numbers[2], numbers[3]}, numbers[4]};
    }
  return {};
}

inline void apply_flags(std::string_view flags, ViewElement const& element, ViewSettings& settings) {
  SeenSettings& seen = settings.seen;
  auto each = [&](std::string_view flag, bool on) {
    if (flag == "All")
      seen.visualModels = seen.states = seen.collisionModels = seen.springs = seen.constraints = on;
    else if (flag == "Visual" || flag == "VisualModels")
      seen.visualModels = on;
    else if (flag == "Behavior" || flag == "Behaviour")
      seen.states = seen.springs = seen.constraints = on;
    else if (flag == "BehaviorModels" || flag == "BehaviourModels")
      seen.states = on;
    else if (flag == "ForceFields" || flag == "InteractionForceFields")
      seen.springs = on;
    else if (flag == "Collision" || flag == "CollisionModels")
      seen.collisionModels = on;
    else if (flag == "BoundingCollisionModels" || flag == "BoundingTree")
      seen.boxes = on;
    else if (flag == "DetectionOutputs")
      seen.arrows[std::size_t(ArrowKind::contact)] = on;
    else if (flag == "Wireframe")
      seen.wireframe = on;
    else if (flag == "Normals")
      seen.normals = on;
    else
      return flag == "Mapping" || flag == "Mappings" || flag == "MechanicalMappings" || flag == "Options" ||
             flag == "Rendering";
    return true;
  };
  for (Words words(flags); !words.end();) {
    const std::string_view word = words.next();
    const bool shows = word.starts_with("show");
    if ((!shows && !word.starts_with("hide")) || !each(word.substr(4), shows))
      settings.warnings.push_back(text(element.origin,
                                       ": <",
                                       element.tag,
                                       ">: displayFlags: ",
                                       sinew::detail::shown(word),
                                       " is not known; it is left out"));
  }
}

inline void apply_camera(ViewElement const& element, ViewSettings& settings) {
  std::optional<Eigen::Vector3d> position, lookAt;
  std::optional<Eigen::Vector4d> orientation;
  std::optional<double> distance, angle;
  auto read = [&](std::string_view name, auto& to) {
    if (std::string const* words = element.find(name)) {
      typename std::decay_t<decltype(to)>::value_type value{};
      read_value(*words, value);
      to = value;
    }
  };
  read("position", position);
  read("lookAt", lookAt);
  read("orientation", orientation);
  read("distance", distance);
  read("fieldOfView", angle);
  if (!position || !(lookAt || orientation)) return;
  Camera camera;
  Eigen::Vector3d toEye, up = settings.camera ? settings.camera->up : Eigen::Vector3d(0, 1, 0);
  if (orientation) {
    const Eigen::Quaterniond q((*orientation)[3], (*orientation)[0], (*orientation)[1], (*orientation)[2]);
    if (!(q.norm() > 1e-6)) throw Error("", "orientation: a quaternion of length 0 turns nothing");
    toEye = q.normalized() * Eigen::Vector3d::UnitZ();
    up = q.normalized() * Eigen::Vector3d::UnitY();
  }
  if (lookAt) {
    toEye = *position - *lookAt;
    camera.distance = toEye.norm();
  } else {
    camera.distance = distance.value_or(position->norm());
  }
  if (!(camera.distance > 0) || !std::isfinite(camera.distance) || !toEye.allFinite())
    throw Error("", "position and lookAt: the camera stands in the point that it looks at");
  camera.toEye = toEye.normalized();
  camera.target = *position - camera.distance * camera.toEye;
  if (up.cross(camera.toEye).norm() < 1e-3) up = camera.toEye.unitOrthogonal();
  camera.up = up;
  if (angle) {
    if (!(*angle > 0 && *angle < 180)) throw Error("", "fieldOfView: it is between 0 and 180 degrees");
    camera.angle = *angle;
  }
  camera.near = camera.distance / 100;
  camera.far = camera.distance * 100;
  settings.camera = camera;
}

inline void apply_light(ViewElement const& element, ViewSettings& settings) {
  SeenLight light{.kind = element.tag == "DirectionalLight"  ? SeenLight::Kind::parallel
                          : element.tag == "PositionalLight" ? SeenLight::Kind::point
                                                             : SeenLight::Kind::spot};
  auto each = [&](std::string_view name, auto&& f) {
    if (std::string const* value = element.find(name)) try {
        f(*value);
      } catch (Error const& error) {
        throw Error("", text(name, ": ", error.what()));
      }
  };
  bool looksAt = false;
  light.direction = {0, 0, -1};  // as in SOFA
  each("color", [&](auto const& words) { light.colour = colour_of_words(words).colour; });
  each("position", [&](auto const& words) { read_value(words, light.position); });
  each("direction", [&](auto const& words) { read_value(words, light.direction); });
  each("attenuation", [&](auto const& words) { read_value(words, light.attenuation); });
  each("cutoff", [&](auto const& words) { read_value(words, light.cutoff); });
  each("exponent", [&](auto const& words) { read_value(words, light.exponent); });
  each("fixed", [&](auto const& words) { read_value(words, light.movesWithCamera); });
  each("lookat", [&](auto const& words) { read_value(words, looksAt); });
  if (looksAt) light.direction -= light.position;
  if (light.kind != SeenLight::Kind::point && !(light.direction.norm() > 0 && light.direction.allFinite()))
    throw Error("", "direction: the light shines to nowhere");
  light.direction.normalize();
  if (!light.position.allFinite()) throw Error("", "position: it is not finite");
  if (!(light.attenuation >= 0)) throw Error("", "attenuation: it is at least 0");
  if (!(light.cutoff > 0 && light.cutoff <= 90))
    throw Error("", "cutoff: it is above 0 and up to 90 degrees");
  if (!(light.exponent >= 0)) throw Error("", "exponent: it is at least 0");
  if (settings.seen.lights.size() == mostLights)
    throw Error("", text("a scene has up to ", mostLights, " lights"));
  settings.seen.lights.push_back(light);
}

inline void apply_element(ViewElement const& element, ViewSettings& settings) {
  auto each = [&](std::string_view name, auto&& f) {
    if (std::string const* value = element.find(name)) try {
        f(*value);
      } catch (Error const& error) {
        throw Error("", text(name, ": ", error.what()));
      }
  };
  std::string_view tag = element.tag;
  if (tag == "VisualStyle" || tag == "DisplayFlagsSetting")
    each("displayFlags", [&](auto const& flags) { apply_flags(flags, element, settings); });
  else if (tag == "BackgroundSetting")
    each("color", [&](auto const& words) { settings.seen.background = colour_of_words(words).colour; });
  else if (tag == "DirectionalLight" || tag == "PositionalLight" || tag == "SpotLight")
    apply_light(element, settings);
  else if (tag == "LightManager") {
    each("ambient", [&](auto const& words) { settings.seen.ambient = colour_of_words(words).colour; });
    each("shadows", [&](auto const& words) { read_value(words, settings.seen.shadows); });
  } else if (tag == "OglSceneFrame")
    settings.seen.axes = true;
  else if (tag == "LineAxis")
    settings.seen.axes = true;
  else if (tag == "VisualGrid" || tag == "OglGrid")
    settings.seen.grid = true;
  else if (tag == "ClipPlane") {
    ClipPlane plane;
    Eigen::Vector3d position = Eigen::Vector3d::Zero();
    bool active = true;
    each("position", [&](auto const& words) { read_value(words, position); });
    each("normal", [&](auto const& words) { read_value(words, plane.normal); });
    each("active", [&](auto const& words) { read_value(words, active); });
    if (!(plane.normal.norm() > 0)) throw Error("", "normal: it has no direction");
    plane.normal = -plane.normal.normalized();  // SOFA shows what is on the side of the normal
    plane.offset = plane.normal.dot(position);
    if (active) settings.seen.clip = plane;
  } else if (tag.find("Camera") != tag.npos)
    apply_camera(element, settings);
  else {
    std::optional<SaidColour> said;
    std::string image;
    each("texturename", [&](auto const& words) { image = words; });
    each("material", [&](auto const& words) { said = diffuse_of_material(words); });
    each("color", [&](auto const& words) {
      if (!Words(words).end()) said = colour_of_words(words);
    });
    BodyLook look{.path = element.path, .image = image, .origin = element.origin};
    if (said) look.colour = said->colour, look.opacity = said->opacity;
    if (said || !image.empty()) settings.seen.looks.push_back(std::move(look));
  }
}

}  // namespace detail

/// What the elements of a scene file say: flags of a VisualStyle, the background, colours, materials and
/// textures of visual models, axes, grid, plane of clipping and camera. What is wrong in one is a warning.
/// Textures and libraries of materials are read by load_materials() (view/load_materials.hpp).
inline ViewSettings view_settings(std::span<ViewElement const> elements) {
  ViewSettings settings;
  for (ViewElement const& element : elements) try {
      detail::apply_element(element, settings);
    } catch (Error const& error) {
      settings.warnings.push_back(
          text(element.origin, ": <", element.tag, ">: ", error.what(), "; it is left out"));
    }
  return settings;
}
/// Of a simulation: those of its scene file, where it comes from one.
template <class Simulation>
ViewSettings view_settings_of(Simulation& simulation) {
  if constexpr (requires { simulation.root().view; })
    return view_settings(simulation.root().view);
  else
    return {};
}

}  // namespace sinew::view
