// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace cli {

/// What the program's exit status says.
enum Exit { ok = 0, badScene = 1, badUsage = 2, diverged = 3, notWritten = 4, interrupted = 130 };

/// Ends a command: what to print on standard error, and the exit status.
struct Failure {
  int status;
  std::vector<std::string> messages;
};

using Settings = std::vector<std::pair<std::string, std::string>>;  // "liver/fem.youngModulus" and its value

struct SceneOptions {
  std::string path{};
  Settings set{};
  std::vector<std::string> data{};
  bool lenient = false;
  double dt = 0;              // 0: the scene's
  std::size_t maxMemory = 0;  // bytes; 0: what the machine has
  std::string missing{};      // as ReadSceneOptions has it
  int processes = 1;          // that share what the machine has
};

/// How far to simulate: so many steps, or so many seconds where `time` is not 0.
struct Duration {
  long steps = 100;
  double time = 0;
  bool given = false;
};

/// What is to be seen of a scene, beside what its file says.
struct SeenOptions {
  std::string colour{}, range{}, clip{}, camera{};
  std::vector<std::string> arrows{}, show{}, hide{};
  int boxLevel = -1;                   // all
  std::vector<std::string> folders{};  // from which alone a scene of somebody else has textures and materials
};

enum class Output { words, quiet, json };

struct RunOptions {
  SceneOptions scene{};
  Duration duration{};
  std::string vtk{}, png{}, film{}, gltf{}, record{}, forces{}, save{};
  int width = 1280, height = 960;  // of pictures [pixels]
  SeenOptions seen{};
  long every = 1, saveEvery = 0;  // steps; 0: at the end only
  int threads = 0;                // as the scene says
  bool mpi = false;
  double patience = 300;  // of ranks [s]
  bool profile = false;
  std::string trace{};
  Output output = Output::words;
};
struct ViewOptions {
  SceneOptions scene{};
  SeenOptions seen{};
};
struct ServeOptions {
  SceneOptions scene{};
  std::string address{"127.0.0.1"}, page{};
  int port = 8765, clients = 16;
};
struct CheckOptions {
  SceneOptions scene{};
  bool quiet = false;
};
struct ListOptions {
  std::string component{}, markdown{}, headers{"include/sinew"}, scenes{"examples/scenes"};
};
struct BakeOptions {
  SceneOptions scene{};
  std::string output{}, name = "scene";
  bool embed = false;
};
struct CompareOptions {
  SceneOptions a{}, b{};
  Duration duration{};
  long every = 1;
  int rounds = 3;
  Output output = Output::words;
};
struct SweepOptions {
  SceneOptions scene{};
  Duration duration{};
  Settings set{};       // paths, and words for their values
  std::string table{};  // a file of combinations
  std::vector<std::string> measure{}, merge{};
  std::string file{};         // that is written; empty: named after the scene
  int jobs = 0, threads = 0;  // as many as there are cores, and as the scene says
  int part = 1, parts = 1;
  double timeLimit = 0;  // of a run [s]; 0: none
  bool retry = false;
  bool mpi = false;
  int worker = -1, beside = 1;  // does the runs of this rank of `sweep --mpi`, one of so many on the machine
  Output output = Output::words;
};

enum class Command { none, run, view, serve, check, list, bake, compare, sweep };
struct Options {
  Command command = Command::none;
  RunOptions run{};
  ViewOptions view{};
  ServeOptions serve{};
  CheckOptions check{};
  ListOptions list{};
  BakeOptions bake{};
  CompareOptions compare{};
  SweepOptions sweep{};
};

/// Reads the command line. Where that ends the program, as --help and mistakes do, the command is none and
/// `status` the exit status.
Options read_options(int argc, char** argv, int& status);

// the commands; each returns the exit status, or throws Failure
int run(RunOptions const& options);
int view(ViewOptions const& options);
int serve(ServeOptions const& options);
int check(CheckOptions const& options);
int list(ListOptions const& options);
int bake(BakeOptions const& options);
int compare(CompareOptions const& options);
int sweep(SweepOptions const& options);

/// The program: reads the command line, runs its command, prints what fails; the exit status.
int program(int argc, char** argv);

}  // namespace cli
