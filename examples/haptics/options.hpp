// SPDX-License-Identifier: BSL-1.0
#pragma once

namespace examples {

/// What the command line of the haptic example sets.
struct HapticOptions {
  double seconds = 60, dt = 0.01, rate = 1000;
  int cells = 7;  // along each side of the block
  double youngModulus = 4000, poissonRatio = 0.4;
  double contactStiffness = 1000;  // of tip and skin [N/m]
  double friction = 0.2;
  int iterations = 25;
  int priority = 80;
};

/// Reads the command line. False where the program should end, with `status`.
bool read_options(int argc, char** argv, HapticOptions& options, int& status);

}  // namespace examples
