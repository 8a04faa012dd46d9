// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/view/stage.hpp>

#include <memory>
#include <string>
#include <string_view>
#include <utility>

namespace page {

/// A scene that runs in a page: a stage without a thread.
struct Running {
  std::string name{};
  std::shared_ptr<void> simulation{};
  std::unique_ptr<sinew::view::Stage> stage{};
  std::string notes{};  // what was noticed when it was read
};

/// The stage of a simulation that is initialised.
template <class Simulation>
Running running(std::string name, std::shared_ptr<Simulation> simulation, double dt,
                sinew::view::SeenSettings const& seen = {}) {
  using sinew::view::Stage;
  auto stage = std::make_unique<Stage>(*simulation, dt, 1, seen, Stage::WithoutThread{});
  return {std::move(name), std::move(simulation), std::move(stage)};
}
/// The same of one that is not.
template <class Simulation>
Running initialised(std::string name, Simulation&& simulation, double dt) {
  auto kept = std::make_shared<Simulation>(std::move(simulation));
  kept->init();
  return running(std::move(name), std::move(kept), dt);
}

/// Each module has its own: what it runs for these bytes, a name or files. Throws Error.
Running run(std::string_view bytes);

// the typed scenes that there are
Running run_liver();
Running run_vitrectomy();

}  // namespace page
