// SPDX-License-Identifier: BSL-1.0
#pragma once

#include "scene.hpp"

#include <memory>

namespace cli {

/// Pictures of a scene as it is drawn: a PNG file for each, or a film.
class Frames {
 public:
  /// Throws Failure where this program has no pictures, and sinew::Error where they cannot be made here.
  Frames(RunOptions const& options, Scene& scene, double picturesPerSecond);
  /// Whether they show forces that the simulation has to keep.
  bool needForces() const;
  ~Frames();
  void add(sinew::StandardSimulation& simulation);
  /// Completes the film. The files.
  std::vector<std::string> finish();

 private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

}  // namespace cli
