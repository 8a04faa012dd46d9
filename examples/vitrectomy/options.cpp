// SPDX-License-Identifier: BSL-1.0
#include "options.hpp"

#include <sinew/core/error.hpp>

#include <CLI/CLI.hpp>

namespace examples {

bool read_options(int argc, char** argv, VitrectomyOptions& options, int& status) {
  CLI::App app{
      "A vitrectomy: a retina that a ring of scar tissue pulls out of its shape relaxes while a blade goes "
      "round and "
      "cuts it free. Writes series that ParaView opens."};
  app.add_option("--sectors", options.sectors, "Points around the eye: a multiple of 3")
      ->capture_default_str();
  app.add_option("--time", options.time, "Seconds to simulate")->capture_default_str();
  app.add_option("--dt", options.dt, "Seconds a step")->capture_default_str();
  app.add_option("--every", options.every, "Steps from one picture to the next")
      ->capture_default_str()
      ->check(CLI::PositiveNumber);
  app.add_option("--output", options.output, "Folder to write to; '' writes nothing")->capture_default_str();
  app.add_option(
      "--picture", options.picture, "Draw the eye before, during and after the cut to this file (.svg)");
  app.add_option(
      "--write-scene",
      options.sceneData,
      "Only write the data of vitrectomy.scn (membranes, springs, tool, its movement) to this folder");
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
