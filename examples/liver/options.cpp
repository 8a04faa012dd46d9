// SPDX-License-Identifier: BSL-1.0
#include "options.hpp"

#include <sinew/core/error.hpp>

#include <CLI/CLI.hpp>

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
  app.add_option("--time", options.time, "Seconds to simulate")->capture_default_str();
  app.add_option("--dt", options.dt, "Seconds a step")->capture_default_str();
  app.add_option("--iterations", options.iterations, "Conjugate-gradient iterations a step")
      ->capture_default_str();
  app.add_option("--every", options.every, "Steps from one picture to the next")
      ->capture_default_str()
      ->check(CLI::PositiveNumber);
  app.add_option("--output", options.output, "Where to write: a path without extension; '' writes nothing")
      ->capture_default_str();
  try {
    app.parse(argc, argv);
  } catch (CLI::ParseError const& e) {
    status = app.exit(e);
    return false;
  }
  const double steps = options.time / options.dt;
  if (!(options.dt > 0) || !(options.time > 0) || !(steps < 1e9))
    throw sinew::Error("--time and --dt",
                       sinew::text("are ",
                                   options.time,
                                   " s and ",
                                   options.dt,
                                   " s, but must be greater than 0 and make less than 1e9 steps"));
  return true;
}

}  // namespace examples
