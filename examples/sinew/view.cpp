// SPDX-License-Identifier: BSL-1.0
#include "scene.hpp"

#ifdef SINEW_WINDOW
#include "opened.hpp"

#include <sinew/view/window.hpp>

namespace cli {

int view(ViewOptions const& options) {
  StagedScene staged(load(options.scene), options.seen);
  print_notes(staged.scene.ignored, staged.scene.warnings);
  auto title = [](std::string const& path) { return path + " - Sinew"; };
  try {
    sinew::view::Window(staged.stage,
                        {.title = title(options.scene.path),
                         .camera = staged.settings.camera,
                         .save = [&staged](std::string const& path) { staged.save(path); },
                         .open =
                             [&](std::string const& path) {
                               SceneOptions other = options.scene;
                               other.path = path;
                               other.set.clear();  // of the scene of the command line
                               other.dt = 0;
                               return opening([&] { return opened(load(other), title(path)); });
                             }})
        .run();
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
