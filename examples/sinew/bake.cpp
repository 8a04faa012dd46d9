// SPDX-License-Identifier: BSL-1.0
#include "scene.hpp"

#include <sinew/io/output_file.hpp>
#include <sinew/runtime/scene_files.hpp>

namespace cli {

int bake(BakeOptions const& options) {
  // a scene that does not run is nothing to bake
  const Scene scene = load(options.scene);
  print_notes(scene.ignored, scene.warnings);
  std::string header;
  try {
    header =
        sinew::bake_scene<sinew::Standard>(options.scene.path,
                                           {options.scene.data, options.scene.lenient, options.scene.set},
                                           {.embed = options.embed, .name = options.name});
  } catch (sinew::Error const& error) {
    throw Failure{badScene, {located(options.scene.path, error.what())}};
  }
  writing([&] { sinew::io::write_file(options.output, header); });
  return ok;
}

}  // namespace cli
