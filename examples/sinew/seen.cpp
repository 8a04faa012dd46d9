// SPDX-License-Identifier: BSL-1.0
#include "seen.hpp"

#ifdef SINEW_VIEW
#include <sinew/view/load_materials.hpp>
#endif

#include <algorithm>
#include <array>
#include <cmath>
#include <string_view>

template sinew::view::SeenScene sinew::view::seen_scene(sinew::StandardSimulation&,
                                                        sinew::view::SeenSettings const&,
                                                        sinew::view::KnownBorders*);

namespace cli {

namespace {

using namespace sinew::view;
using sinew::text;

[[noreturn]] void refuse(std::string const& message) { throw Failure{badUsage, {message}}; }

template <std::size_t N>
std::size_t place_of(std::array<std::string_view, N> const& names, std::string const& word,
                     char const* option) {
  for (std::size_t i = 0; i < N; ++i)
    if (names[i] == word) return i;
  std::string known;
  for (auto const& name : names) known += text(known.empty() ? "" : ", ", name);
  const std::string nearest = sinew::nearest_name(word, names);
  refuse(text(option,
              ": '",
              word,
              "' is not one of ",
              known,
              nearest.empty() ? std::string() : text("; did you mean '", nearest, "'?")));
}

template <std::size_t N>
std::array<double, N> numbers_of(std::string words, char const* option, char const* form) {
  std::replace(words.begin(), words.end(), ':', ' ');
  std::array<double, N> numbers{};
  try {
    sinew::read_value(words, numbers);
  } catch (sinew::Error const& error) {
    refuse(text(option, ": '", words, "' ", error.what(), " (", form, ")"));
  }
  for (const double number : numbers)
    if (!std::isfinite(number)) refuse(text(option, ": ", number, " is not finite (", form, ")"));
  return numbers;
}

bool* flag_of(SeenSettings& seen, std::string const& word) {
  const std::array<std::pair<std::string_view, bool*>, 13> all{{{"visuals", &seen.visualModels},
                                                                {"states", &seen.states},
                                                                {"collision", &seen.collisionModels},
                                                                {"boxes", &seen.boxes},
                                                                {"springs", &seen.springs},
                                                                {"constraints", &seen.constraints},
                                                                {"normals", &seen.normals},
                                                                {"wireframe", &seen.wireframe},
                                                                {"axes", &seen.axes},
                                                                {"grid", &seen.grid},
                                                                {"legend", &seen.legend},
                                                                {"shadows", &seen.shadows},
                                                                {"occlusion", &seen.occlusion}}};
  for (auto const& [name, flag] : all)
    if (name == word) return flag;
  return nullptr;
}

}  // namespace

ViewSettings seen_settings(SeenOptions const& options, Scene& scene) {
  ViewSettings settings = view_settings(scene.simulation.root().view);
  SeenSettings& seen = settings.seen;
  if (!options.colour.empty())
    seen.colour = Quantity(place_of(enum_names(Quantity{}), options.colour, "--colour"));
  if (!options.range.empty()) {
    const auto [low, high] = numbers_of<2>(options.range, "--range", "as in 0:5000");
    if (!(low < high)) refuse(text("--range: ", low, " is not below ", high));
    seen.range = {low, high};
  }
  for (auto const& kind : options.arrows)
    seen.arrows[place_of(enum_names(ArrowKind{}), kind, "--arrows")] = true;
  for (auto const& thing : options.show) {
    bool* const flag = flag_of(seen, thing);
    if (!flag)
      refuse(
          text("--show: '",
               thing,
               "' is not one of visuals, states, collision, boxes, springs, constraints, normals, wireframe, "
               "axes, grid, legend, shadows, occlusion"));
    *flag = true;
  }
  for (auto const& thing : options.hide) {
    if (bool* const flag = flag_of(seen, thing)) {
      *flag = false;
      continue;
    }
    Node* node = thing.empty() ? nullptr : scene.simulation.root().find_node(thing);
    if (!node) node = scene.simulation.root().resolve(thing);
    if (thing.empty() || !node)
      refuse(text("--hide: there is no node '", thing, "', and it is nothing that can be shown"));
    seen.looks.push_back({.path = node->path(), .visible = false});
  }
  if (options.boxLevel >= 0) seen.boxLevel = options.boxLevel, seen.boxes = true;
  if (!options.clip.empty()) {
    const auto [x, y, z, d] = numbers_of<4>(options.clip, "--clip", "as in '1 0 0 0.5'");
    const double length = Eigen::Vector3d(x, y, z).norm();
    if (!(length > 0)) refuse("--clip: X Y Z has no direction (as in '1 0 0 0.5')");
    seen.clip = ClipPlane{Eigen::Vector3d(x, y, z) / length, d / length};
  }
  if (!options.camera.empty()) {
    const auto [x, y, z, tx, ty, tz] = numbers_of<6>(options.camera, "--camera", "as in '0 1 5  0 0 0'");
    ViewSettings own = view_settings(std::array{sinew::ViewElement{
        .tag = "Camera",
        .attributes = {{"position", text(x, ' ', y, ' ', z)}, {"lookAt", text(tx, ' ', ty, ' ', tz)}}}});
    if (!own.warnings.empty()) refuse("--camera: it stands in the point that it looks at");
    settings.camera = own.camera;
  }
#ifdef SINEW_VIEW
  load_materials(scene.simulation, seen, settings.warnings, options.folders);
#endif
  return settings;
}

}  // namespace cli
