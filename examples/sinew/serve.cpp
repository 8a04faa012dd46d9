// SPDX-License-Identifier: BSL-1.0
#include "scene.hpp"

#ifdef SINEW_SERVE
#include "seen.hpp"

#include <sinew/view/serve.hpp>

#include <filesystem>

namespace cli {

int serve(ServeOptions const& options) {
  Scene scene = load(options.scene);
  const sinew::view::ViewSettings settings = seen_settings({}, scene);
  scene.warnings.insert(scene.warnings.end(), settings.warnings.begin(), settings.warnings.end());
  print_notes(scene.ignored, scene.warnings);
  try {
    sinew::view::Stage stage(scene.simulation, scene.dt, 1, settings.seen);
    sinew::view::serve(stage,
                       {.title = std::filesystem::path(options.scene.path).filename().string(),
                        .address = options.address,
                        .port = options.port,
                        .page = options.page,
                        .clients = options.clients});
  } catch (sinew::Error const& error) {
    throw Failure{notWritten, {error.what()}};
  }
  return ok;
}

}  // namespace cli

#else

namespace cli {

int serve(ServeOptions const&) {
  throw Failure{badUsage,
                {"serve: this program was built without a server; install what it needs (Debian: "
                 "nlohmann-json3-dev), configure and build again"}};
}

}  // namespace cli

#endif
