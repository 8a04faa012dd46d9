// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/core/mesh.hpp>

#include <string>
#include <vector>

namespace examples {

/// What the command line of the liver sets.
struct LiverOptions {
  int tetrahedra = 1800;
  std::string mesh{};  // a file in the place of the generated body
  double youngModulus = 3000, poissonRatio = 0.3, density = 0;
  std::vector<int> fixed{};
  double time = 4, dt = 0.02;
  int iterations = 25;
  int every = 2;  // steps from one picture to the next
  std::string output = "out/liver";
};

/// Reads the command line. False where the program should end, with `status`.
bool read_options(int argc, char** argv, LiverOptions& options, int& status);

/// The body and its skin: generated from sinew::LiverShape, or from options.mesh. Fills in density and fixed
/// points where the options leave them open. Throws sinew::Error.
struct LiverBody {
  sinew::Mesh volume, skin;
};
LiverBody make_body(LiverOptions& options);

}  // namespace examples
