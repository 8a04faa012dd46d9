// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/view/camera.hpp>
#include <sinew/view/stage.hpp>

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace sinew::view {

/// A scene that takes the place of the one that is seen.
struct OpenedScene {
  std::shared_ptr<Stage> stage{};  // keeps its simulation
  std::string title{};
  std::optional<Camera> camera{};                       // without one, that which sees all of the scene
  std::vector<std::string> notes{};                     // what was noticed when it was read
  std::function<void(std::string const& path)> save{};  // writes the simulation to a file, between two steps
};

/// A file of a scene, or of what a scene needs, as a page sends it.
struct SceneFile {
  std::string name{};  // "liver.scn", or below a folder "data/organ.obj"
  std::string content{};
  bool operator==(SceneFile const&) const = default;
};

}  // namespace sinew::view
