// SPDX-License-Identifier: BSL-1.0
#include "frames.hpp"

#include "seen.hpp"

#ifdef SINEW_VIEW
#include <sinew/io/output_file.hpp>
#include <sinew/view/film.hpp>
#include <sinew/view/picture.hpp>

#include <cstdio>
#include <optional>

namespace cli {

struct Frames::Parts {
  sinew::view::SeenSettings seen;
  sinew::view::KnownBorders borders{};
  sinew::view::Painter painter;
  std::string folder;
  std::optional<sinew::view::Film> film{};
  long pictures = 0;
};

Frames::Frames(RunOptions const& options, Scene& scene, double picturesPerSecond) {
  const sinew::view::ViewSettings settings = seen_settings(options.seen, scene);
  if (options.output != Output::quiet) print_notes({}, settings.warnings);
  parts_.reset(new Parts{.seen = settings.seen,
                         .painter = sinew::view::Painter(
                             {.width = options.width, .height = options.height, .camera = settings.camera}),
                         .folder = options.png});
  if (!options.png.empty()) sinew::io::make_folders(options.png);
  if (!options.film.empty())
    parts_->film.emplace(options.film, options.width, options.height, picturesPerSecond);
}

void Frames::add(sinew::StandardSimulation& simulation) {
  const auto image =
      parts_->painter.paint(sinew::view::seen_scene(simulation, parts_->seen, &parts_->borders));
  if (!parts_->folder.empty()) {
    char name[32];
    std::snprintf(name, sizeof name, "%06ld.png", parts_->pictures);
    sinew::view::write_png(image,
                           sinew::text(parts_->folder, parts_->folder.ends_with('/') ? "" : "/", name));
  }
  if (parts_->film) parts_->film->add(image);
  ++parts_->pictures;
}

bool Frames::needForces() const { return parts_->seen.needsForces(); }

std::vector<std::string> Frames::finish() {
  std::vector<std::string> files;
  if (!parts_->folder.empty())
    files.push_back(sinew::text(parts_->folder, " (", parts_->pictures, " pictures)"));
  if (parts_->film) parts_->film->finish(), files.push_back(parts_->film->path());
  return files;
}

}  // namespace cli

#else

namespace cli {

struct Frames::Parts {};

Frames::Frames(RunOptions const&, Scene&, double) {
  throw Failure{badUsage,
                {"--png and --film: this program was built without pictures; install what they need (Debian: "
                 "libepoxy-dev, libegl-dev, libstb-dev), configure and build again"}};
}
void Frames::add(sinew::StandardSimulation&) {}
bool Frames::needForces() const { return false; }
std::vector<std::string> Frames::finish() { return {}; }

}  // namespace cli

#endif

namespace cli {

Frames::~Frames() = default;

}  // namespace cli
