// SPDX-License-Identifier: BSL-1.0
#pragma once

// What a program does with scene files. The bodies are in read_scene.hpp, save_scene.hpp and bake.hpp, to be
// included in one file of a program; for the registry Standard the library sinew::standard has them.
#include <sinew/io/output_file.hpp>
#include <sinew/runtime/node.hpp>
#include <sinew/scene/simulation.hpp>

#include <string>
#include <utility>
#include <vector>

namespace sinew {

struct ReadSceneOptions {
  std::vector<std::string> dataPaths{};  // where files are looked for that are not beside the scene
  bool lenient = false;                  // an unknown class is a warning
  std::vector<std::pair<std::string, std::string>> set{};  // "liver/fem.youngModulus" and its value
  std::string missing{};  // what to do about a file that is not there; else the name or --data is to blame
};

/// A scene file as a runtime tree, and what was noticed on the way.
template <class R>
struct ReadScene {
  RuntimeNode<R> root;
  double dt = 0.01;
  double time = 0;  // of a checkpoint
  long step = 0;
  std::vector<std::string> ignored{};   // classes and attributes without a meaning here, each once
  std::vector<std::string> warnings{};  // what is not simulated, and what was repaired
  std::vector<std::string> files{};     // data files that were read
};

/// All that is wrong with a scene file, one message a line, each with file, line and column.
struct SceneError : Error {
  std::vector<std::string> messages;
  explicit SceneError(std::vector<std::string> all) : Error("", joined(all)), messages(std::move(all)) {}

 private:
  static std::string joined(std::vector<std::string> const& all) {
    std::string lines;
    for (auto const& m : all) lines += text(lines.empty() ? "" : "\n", m);
    return lines;
  }
};

/// Reads a scene in SOFA's XML dialect, of the classes of the registry R. Throws SceneError with all that is
/// wrong with the file; nothing is returned then. What is wrong with a class of the registry, the compiler
/// says by the last argument.
template <class R>
ReadScene<R> read_scene(std::string const& path, ReadSceneOptions const& options = {},
                        checks::RegistryVerdict<R> = {});
/// The same from the content of a file.
template <class R>
ReadScene<R> parse_scene(std::string const& path, std::string content, ReadSceneOptions const& options = {},
                         checks::RegistryVerdict<R> = {});

/// An initialised simulation of a scene that was read, at the time at which it was saved. Throws Error.
template <class R>
Simulation<RuntimeNode<R>> start(ReadScene<R> scene) {
  Simulation<RuntimeNode<R>> simulation(std::move(scene.root));
  simulation.init(scene.time, scene.step);
  return simulation;
}

/// The scene as XML: positions and velocities as they are, time and step, and in the place of loaders and
/// selections the data that they made. A checkpoint: read_scene() and start() go on from it bit by bit.
template <class R>
std::string scene_text(Simulation<RuntimeNode<R>>& simulation, double dt);
/// Writes that to a file, whole or not at all. Throws Error.
template <class R>
void save_scene(Simulation<RuntimeNode<R>>& simulation, double dt, std::string const& path) {
  io::write_file(path, scene_text(simulation, dt));
}

struct BakeOptions {
  bool embed = false;                   // all data stands in the text; no file is read at run time
  std::string name = "scene";           // of the function
  std::string data{};                   // default folder of data files; that of the scene file when empty
  std::vector<std::string> includes{};  // headers of components that sinew.hpp has not
};

/// The C++ of a scene that was read from a path: a header with a function that returns it as a typed scene,
/// which gives the same results bit by bit. Throws Error where no typed scene says the same.
template <class R>
std::string bake_text(ReadScene<R> scene, std::string const& path, BakeOptions const& options = {});
/// The same of a scene file, in SOFA's XML dialect, of the classes of the registry R. Throws Error.
template <class R>
std::string bake_scene(std::string const& path, ReadSceneOptions const& read = {},
                       BakeOptions const& options = {}) {
  return bake_text<R>(read_scene<R>(path, read), path, options);
}

}  // namespace sinew
