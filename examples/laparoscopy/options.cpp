// SPDX-License-Identifier: BSL-1.0
#include "options.hpp"
#include "support/command_line.hpp"

#include <cstdio>

namespace examples {

std::array<int, 3> grid_of(std::string const& given) {
  std::array<int, 3> n{};
  int end = 0;
  if (std::sscanf(given.c_str(), "%4dx%4dx%4d%n", &n[0], &n[1], &n[2], &end) != 3 ||
      std::size_t(end) != given.size() || *std::min_element(n.begin(), n.end()) < 2)
    throw sinew::Error(
        "--resolution",
        sinew::text("is '", given, "', but must be points along x, y and z, at least 2, such as 17x8x10"));
  return n;
}

bool read_options(int argc, char** argv, LaparoscopyOptions& options, int& status) {
  CLI::App app{
      "Liver and intestines, touched by ribs, the abdominal wall, each other and a tool that a script moves. "
      "Writes a series of surfaces for each, which ParaView opens."};
  std::string model = "fem", resolution;
  app.add_option("--model", model, "What organs are made of: fem, or grid for grids of springs")
      ->check(CLI::IsMember({"fem", "grid"}))
      ->capture_default_str();
  app.add_option("--resolution",
                 resolution,
                 "Of the liver: about how many tetrahedra (default 1800), or points of the grid (17x8x10)");
  add_times(app, options, "Seconds to simulate; the script takes 20 and starts again");
  app.add_option("--gravity", options.scene.gravity, "Gravity, to the back [m/s^2]")->capture_default_str();
  app.add_option("--iterations", options.scene.iterations, "Conjugate-gradient iterations a step")
      ->capture_default_str();
  add_every(app, options);
  app.add_option("--output", options.output, "Folder to write to; '' writes nothing")->capture_default_str();
  app.add_option(
      "--picture", options.picture, "Draw three moments of the first 18 seconds to this file (.svg)");
  if (!parsed(app, argc, argv, status)) return false;
  check_times(options);
  if (model == "grid") {
    options.grid = grid_of(resolution.empty() ? "17x8x10" : resolution);
  } else if (!resolution.empty()) {
    int end = 0;
    if (std::sscanf(resolution.c_str(), "%9d%n", &options.tetrahedra, &end) != 1 ||
        std::size_t(end) != resolution.size() || options.tetrahedra < 100)
      throw sinew::Error(
          "--resolution",
          sinew::text("is '", resolution, "', but must be a number of tetrahedra, at least 100"));
  }
  return true;
}

}  // namespace examples
