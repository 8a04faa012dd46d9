// SPDX-License-Identifier: BSL-1.0
#include "options.hpp"
#include "support/command_line.hpp"

namespace examples {

bool read_options(int argc, char** argv, HapticOptions& options, int& status) {
  CLI::App app{
      "A simulated hand holds a haptic device, which holds a tool, whose tip touches a soft block: a loop of "
      "1 kHz beside a simulation of corotational finite elements and contact. Prints how well the loop kept "
      "its time."};
  app.add_option("--seconds", options.seconds, "How long to run, in real time")->capture_default_str();
  app.add_option("--dt", options.dt, "Seconds a step of the simulation")->capture_default_str();
  app.add_option("--rate", options.rate, "Ticks of the haptic loop a second")->capture_default_str();
  app.add_option("--cells", options.cells, "Cells along each side of the block, of 6 tetrahedra each")
      ->capture_default_str()
      ->check(CLI::Range(2, 60));
  app.add_option("--young", options.youngModulus, "Young's modulus [Pa]")->capture_default_str();
  app.add_option("--poisson", options.poissonRatio, "Poisson's ratio")->capture_default_str();
  app.add_option("--contact-stiffness", options.contactStiffness, "Of tip and skin [N/m]")
      ->capture_default_str();
  app.add_option("--friction", options.friction, "Coefficient, of tip and skin")->capture_default_str();
  app.add_option("--iterations", options.iterations, "Conjugate-gradient iterations a step")
      ->capture_default_str();
  app.add_option("--priority", options.priority, "Of SCHED_FIFO, 1 to 99; 0 for an ordinary thread")
      ->capture_default_str();
  return parsed(app, argc, argv, status);
}

}  // namespace examples
