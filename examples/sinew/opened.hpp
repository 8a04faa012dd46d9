// SPDX-License-Identifier: BSL-1.0
#pragma once

#include "seen.hpp"

#include <sinew/view/opened_scene.hpp>

#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace cli {

/// A scene that runs on a stage, and how it is to be seen. What is wrong with the command line is a Failure.
struct StagedScene {
  Scene scene;
  sinew::view::ViewSettings settings;
  sinew::view::Stage stage;

  StagedScene(Scene s, SeenOptions const& seen)
      : scene(std::move(s)),
        settings(seen_settings(seen, scene)),
        stage(scene.simulation, scene.dt, 1, settings.seen) {
    scene.warnings.insert(scene.warnings.end(), settings.warnings.begin(), settings.warnings.end());
  }

  void save(std::string const& path) { sinew::save_scene(scene.simulation, scene.dt, path); }
};

/// The same for those who look already. `with`: what goes with the scene, beside its simulation.
inline sinew::view::OpenedScene opened(Scene scene, std::string title, std::shared_ptr<void> with = {},
                                       SeenOptions const& seen = {}) {
  struct Kept {
    std::shared_ptr<void> with;
    StagedScene staged;
    Kept(std::shared_ptr<void> w, Scene s, SeenOptions const& seen)
        : with(std::move(w)), staged(std::move(s), seen) {}
  };
  auto kept = std::make_shared<Kept>(std::move(with), std::move(scene), seen);
  StagedScene& staged = kept->staged;
  std::vector<std::string> notes;
  if (!staged.scene.ignored.empty()) {
    std::string all;
    for (auto const& name : staged.scene.ignored) all += (all.empty() ? "" : ", ") + name;
    notes.push_back("ignored, without a meaning here: " + all);
  }
  for (auto const& warning : staged.scene.warnings) notes.push_back("warning: " + warning);
  return {.stage = std::shared_ptr<sinew::view::Stage>(kept, &staged.stage),
          .title = std::move(title),
          .camera = staged.settings.camera,
          .notes = std::move(notes),
          .save = [&staged](std::string const& path) { staged.save(path); }};
}

/// f(), with a Failure as an Error in words.
template <class F>
decltype(auto) opening(F&& f) {
  try {
    return f();
  } catch (Failure const& failure) {
    std::string all;
    for (auto const& message : failure.messages) all += (all.empty() ? "" : "\n") + message;
    throw sinew::Error("", all);
  }
}

}  // namespace cli
