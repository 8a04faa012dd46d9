// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/view/stage.hpp>

#include <memory>
#include <string>
#include <utility>

namespace page {

/// A scene that runs in a page: a stage without a thread.
struct Running {
  std::string name{};
  std::shared_ptr<void> simulation{};
  std::unique_ptr<sinew::view::Stage> stage{};
};

/// Initialises a simulation.
template <class Simulation>
Running run(std::string name, Simulation&& simulation, double dt) {
  const auto kept = std::make_shared<Simulation>(std::move(simulation));
  kept->init();
  using sinew::view::Stage;
  auto stage = std::make_unique<Stage>(*kept, dt, 1, sinew::view::SeenSettings{}, Stage::WithoutThread{});
  return {std::move(name), kept, std::move(stage)};
}

// the scenes that there are
Running run_liver();
Running run_vitrectomy();

}  // namespace page
