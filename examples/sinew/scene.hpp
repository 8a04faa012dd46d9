// SPDX-License-Identifier: BSL-1.0
#pragma once

#include "options.hpp"

#include <sinew/runtime/precompiled.hpp>

#include <string>
#include <vector>

namespace cli {

using Node = sinew::RuntimeNode<sinew::Standard>;

/// What a scene is made of.
struct Count {
  std::size_t nodes = 0, components = 0, degreesOfFreedom = 0;
  std::string words() const;
};
Count count(Node const& top);

/// A scene that runs, and what was noticed when it was read.
struct Scene {
  sinew::StandardSimulation simulation;
  double dt;
  std::vector<std::string> ignored, warnings;

  void animate();  // throws Failure where the simulation diverges
  std::string path;
};

/// Reads a scene, not yet initialised. Throws Failure with all that is wrong with it.
sinew::ReadScene<sinew::Standard> read(SceneOptions const& options);
/// Reads and initialises it.
Scene load(SceneOptions const& options);
/// The same from what was read.
Scene start(sinew::ReadScene<sinew::Standard> scene, SceneOptions const& options);
/// Gives all Threads of a scene so many, and the root some where it has none.
void use_threads(Node& node, int count);
/// Where a mistake is that only shows when the scene is initialised: as it says itself, or in the file.
std::string located(std::string const& path, std::string const& message);

/// What was ignored, and warnings, on standard error.
void print_notes(std::vector<std::string> const& ignored, std::vector<std::string> const& warnings);

/// Steps of length dt in a duration. Throws Failure where there are too many.
long steps_of(Duration const& duration, double dt);

/// Whether Ctrl-C was pressed since catch_interrupt(); pressed again, it ends the program at once.
void catch_interrupt();
bool was_interrupted();

/// f(), with Errors as failures to write a file.
template <class F>
decltype(auto) writing(F&& f) {
  try {
    return f();
  } catch (sinew::Error const& error) {
    throw Failure{notWritten, {error.what()}};
  }
}

}  // namespace cli
