// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <array>
#include <string>

namespace examples {

/// Settings of the scene, apart from its bodies.
struct LaparoscopyScene {
  int iterations = 25;
  double gravity = 2;  // the part of the weight that what is not simulated does not bear [m/s^2]
  double liverModulus = 6000, intestineModulus = 6000;  // [Pa]
  double viscosity = 0.05;                              // damping of the organs per stiffness [s]
  double mesentery = 20;                                // stiffness of each tether [N/m]
  double alarmDistance = 0.003, contactDistance = 0.0015;
  double organContact = 1, wallContact = 2, toolContact = 5;  // contactStiffness
  double organFriction = 0.05, organDamping = 0.02;
  double period = 20;  // in which the script plays once [s]
};

/// What the command line of the laparoscopy sets.
struct LaparoscopyOptions {
  int tetrahedra = 1800;             // of the liver
  std::array<int, 3> grid{0, 0, 0};  // of the liver; 0: finite elements
  LaparoscopyScene scene{};
  double time = 20, dt = 0.02;
  int every = 5;  // steps from one picture to the next
  std::string output = "out/laparoscopy", picture{};
};

/// Reads the command line. False where the program should end, with `status`. Throws sinew::Error.
bool read_options(int argc, char** argv, LaparoscopyOptions& options, int& status);

/// "17x8x10": points along x, y, z. Throws sinew::Error.
std::array<int, 3> grid_of(std::string const& text);

}  // namespace examples
