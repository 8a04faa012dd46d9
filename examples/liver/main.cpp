// SPDX-License-Identifier: BSL-1.0
#include "picture.hpp"
#include "scene.hpp"

#include "support/progress.hpp"

#include <sinew/io/pvd_series.hpp>

#include <cmath>
#include <optional>

int main(int argc, char** argv) try {
  examples::LiverOptions options;
  int status = 0;
  if (!examples::read_options(argc, argv, options, status)) return status;
  const examples::LiverBody body = examples::make_body(options);
  auto sim = examples::liver_scene(body, options);
  sim.init();
  std::printf("liver: %zu points, %zu tetrahedra, skin of %zu vertices\n",
              body.volume.positions.size(),
              body.volume.tetrahedra.size(),
              body.skin.positions.size());

  std::optional<sinew::io::PvdSeries> series;
  if (!options.output.empty()) series.emplace(options.output);
  auto picture = [&] {
    if (series) series->add(sim.time(), sim.at<"liver/skin">().visual().current());
  };

  const long steps = std::lround(options.time / options.dt);
  examples::Progress progress(steps);
  examples::Stopwatch stepping;
  picture();
  for (long i = 1; i <= steps; ++i) {
    stepping.start();
    sim.animate(options.dt);
    stepping.stop();
    if (i % options.every == 0) picture();
    progress.at(i);
  }
  std::printf("%ld steps of %g s in %.3f s: %.0f steps/s, %.1f times real time\n",
              steps,
              options.dt,
              stepping.seconds(),
              double(steps) / stepping.seconds(),
              double(steps) * options.dt / stepping.seconds());
  if (series) {
    const std::string file = options.output + ".svg";
    examples::write_picture(body.skin, sim.at<"liver/skin">().visual().current(), sim.time(), file);
    std::printf("open %s in a browser, and %s.pvd in ParaView\n", file.c_str(), options.output.c_str());
  }
  return 0;
} catch (sinew::Error const& error) {
  std::fprintf(stderr, "liver: %s\n", error.what());
  return 1;
}
