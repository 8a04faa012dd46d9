// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <string>

namespace examples {

/// What the command line of the vitrectomy sets.
struct VitrectomyOptions {
  int sectors = 48;
  double time = 7, dt = 0.005;
  int every = 10;  // steps from one picture to the next
  std::string output = "out/vitrectomy";
  std::string picture{};    // file for a drawing of the surgery; empty: none
  std::string sceneData{};  // where to write the data of vitrectomy.scn; empty: nowhere
};

/// Reads the command line. False where the program should end, with `status`.
bool read_options(int argc, char** argv, VitrectomyOptions& options, int& status);

}  // namespace examples
