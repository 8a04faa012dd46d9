// SPDX-License-Identifier: BSL-1.0
#include "scene.hpp"

#ifdef SINEW_WINDOW
#include "seen.hpp"

#include <sinew/view/window.hpp>

namespace cli {

int view(ViewOptions const& options) {
  Scene scene = load(options.scene);
  const sinew::view::ViewSettings settings = seen_settings(options.seen, scene);
  scene.warnings.insert(scene.warnings.end(), settings.warnings.begin(), settings.warnings.end());
  print_notes(scene.ignored, scene.warnings);
  try {
    sinew::view::view(
        scene.simulation,
        scene.dt,
        {.title = options.scene.path + " - Sinew",
         .camera = settings.camera,
         .seen = settings.seen,
         .save = [&scene](std::string const& path) { sinew::save_scene(scene.simulation, scene.dt, path); }});
  } catch (sinew::Error const& error) {
    throw Failure{notWritten, {error.what()}};
  }
  return ok;
}

}  // namespace cli

#else

namespace cli {

int view(ViewOptions const&) {
  throw Failure{
      badUsage,
      {"view: this program was built without a window; install what it needs (Debian: libepoxy-dev, "
       "libegl-dev, libstb-dev, libglfw3-dev, libimgui-dev), configure and build again"}};
}

}  // namespace cli

#endif
