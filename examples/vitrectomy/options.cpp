// SPDX-License-Identifier: BSL-1.0
#include "options.hpp"
#include "support/command_line.hpp"

namespace examples {

bool read_options(int argc, char** argv, VitrectomyOptions& options, int& status) {
  CLI::App app{
      "A vitrectomy: a retina that a ring of scar tissue pulls out of its shape relaxes while a blade goes "
      "round and "
      "cuts it free. Writes series that ParaView opens."};
  app.add_option("--sectors", options.sectors, "Points around the eye: a multiple of 3")
      ->capture_default_str();
  add_times(app, options);
  add_every(app, options);
  app.add_option("--output", options.output, "Folder to write to; '' writes nothing")->capture_default_str();
  app.add_option(
      "--picture", options.picture, "Draw the eye before, during and after the cut to this file (.svg)");
  app.add_option(
      "--write-scene",
      options.sceneData,
      "Only write the data of vitrectomy.scn (membranes, springs, tool, its movement) to this folder");
  if (!parsed(app, argc, argv, status)) return false;
  check_times(options);
  return true;
}

}  // namespace examples
