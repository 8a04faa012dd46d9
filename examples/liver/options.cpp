// SPDX-License-Identifier: BSL-1.0
#include "options.hpp"
#include "support/command_line.hpp"

namespace examples {

bool read_options(int argc, char** argv, LiverOptions& options, int& status) {
  CLI::App app{
      "A liver under gravity: corotational finite elements, implicit Euler, a smooth skin carried by "
      "barycentric mapping. Writes a series of surfaces that ParaView opens."};
  app.add_option("--tetrahedra", options.tetrahedra, "About how many elements to generate")
      ->capture_default_str();
  app.add_option(
      "--mesh", options.mesh, "Tetrahedra from a file (.msh .vtk .vtu) in the place of the generated liver");
  app.add_option("--young", options.youngModulus, "Young's modulus [Pa]")->capture_default_str();
  app.add_option("--poisson", options.poissonRatio, "Poisson's ratio")->capture_default_str();
  app.add_option("--density", options.density, "Mass density [kg/m^3] (default 1000; 1 with --mesh)");
  app.add_option(
      "--fixed", options.fixed, "Points held in place (default: where the liver hangs; 3 39 64 with --mesh)");
  add_times(app, options);
  app.add_option("--iterations", options.iterations, "Conjugate-gradient iterations a step")
      ->capture_default_str();
  add_every(app, options);
  app.add_option("--output", options.output, "Where to write: a path without extension; '' writes nothing")
      ->capture_default_str();
  if (!parsed(app, argc, argv, status)) return false;
  check_times(options);
  return true;
}

}  // namespace examples
