// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/view/fields.hpp>
#include <sinew/view/plots.hpp>
#include <sinew/view/step_profile.hpp>

#include <Eigen/Core>
#include <memory>
#include <optional>
#include <string>

namespace sinew::view {

/// What the pointer holds: the place on the body, where the pointer is, and the force between them [N].
struct Held {
  std::string path{};
  Eigen::Vector3d point{0, 0, 0}, target{0, 0, 0}, force{0, 0, 0};
};

/// How a simulation is getting on.
struct StageState {
  double time = 0, stepsPerSecond = 0;
  long step = 0;
  bool playing = false, recording = false, replaying = false, measuring = false, profiling = false;
  std::optional<Held> held{};
  std::shared_ptr<SeenComponent const> selected{};  // as it was when the scene was last looked at; or none
  std::shared_ptr<Measures const> measures{};       // a few times a second, while it is measured
  std::shared_ptr<StepProfile const>
      profile{};                              // of the steps of the last half second, while it is asked for
  std::optional<FieldChange> undo{}, redo{};  // what undo() would take back, and redo() do again
  std::string error{};                        // of the last thing that went wrong; empty where nothing has
};

}  // namespace sinew::view
