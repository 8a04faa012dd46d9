// SPDX-License-Identifier: BSL-1.0
#pragma once

#include "measures.hpp"
#include "options.hpp"
#include "picture.hpp"
#include "scene.hpp"

#include "support/progress.hpp"

#include <sinew/io/pvd_series.hpp>

#include <cmath>
#include <optional>

namespace examples {

/// Simulates the scene and says what came out.
template <class Organs>
void run(LaparoscopyBodies const& bodies, LaparoscopyOptions const& options) {
  auto sim = laparoscopy_scene<Organs>(bodies, options.scene);
  sim.init();
  std::printf("liver: %zu points, skins of %zu and %zu triangles\n",
              bodies.liver.volume.positions.size(),
              bodies.liver.skin.triangles.size(),
              bodies.intestines.skin.triangles.size());

  std::optional<sinew::io::PvdSeries> series[3];
  sinew::Mesh tool;
  if (!options.output.empty()) {
    const char* names[] = {"/liver", "/intestines", "/tool"};
    for (int i = 0; i < 3; ++i) series[i].emplace(options.output + names[i]);
    sinew::io::PvdSeries(options.output + "/wall").add(0, bodies.wall);
    sinew::io::PvdSeries(options.output + "/ribs").add(0, bodies.ribs);
  }
  auto picture = [&] {
    if (!series[0]) return;
    sinew::Mesh mesh = bodies.liver.skin;
    mesh.positions = sim.template at<"organs/liver/skin">().state().position;
    series[0]->add(sim.time(), mesh);
    mesh = bodies.intestines.skin;
    mesh.positions = sim.template at<"organs/intestines/skin">().state().position;
    series[1]->add(sim.time(), mesh);
    tool.positions = sim.template at<"tool/shaft">().state().position;
    tool.edges = {{0, int(tool.positions.size()) - 1}};
    series[2]->add(sim.time(), tool);
  };

  const long steps = std::lround(options.time / options.dt);
  LaparoscopyScript script{.length = options.scene.period};
  LaparoscopyMeasures measures;
  std::vector<LaparoscopyPanel> panels;
  Progress progress(steps);
  Stopwatch stepping;
  picture();
  for (long i = 1; i <= steps; ++i) {
    stepping.start();
    script.act(sim, options.dt);
    sim.animate(options.dt);
    stepping.stop();
    measures.look<sinew::DefaultContactManager>(sim, bodies, i % 10 == 0);
    if (i % options.every == 0) picture();
    if (!options.picture.empty() && panels.size() < LaparoscopyScript::moments.size())
      if (auto const& [part, title] = LaparoscopyScript::moments[panels.size()];
          sim.time() >= part * script.length)
        panels.push_back({sinew::text(std::round(10 * sim.time()) / 10, " s: ", title),
                          sim.template at<"organs/liver/skin">().state().position,
                          sim.template at<"organs/intestines/skin">().state().position,
                          sim.template at<"tool/shaft">().state().position});
    progress.at(i);
  }
  std::printf("%ld steps of %g s in %.1f s: %.0f steps/s; lifted %d times\n",
              steps,
              options.dt,
              stepping.seconds(),
              double(steps) / stepping.seconds(),
              script.graspsDone);
  std::printf("fastest point %.3f m/s, kinetic energy up to %.2g J, elastic up to %.2g J\n",
              measures.fastest,
              measures.kinetic,
              measures.potential);
  std::printf(
      "up to %zu contacts, deepest penetration %.2f mm (%s); skins at least %.1f mm inside of the wall\n",
      measures.contacts,
      1e3 * measures.deepest,
      measures.where.c_str(),
      -1e3 * measures.farthest);
  std::printf(
      "volumes of skins %.2f to %.2f of those at rest, of elements at least %.2f; up to %d elements "
      "inverted, for up to %.1f s; ribs or tool inside an organ: %d times\n",
      measures.smallest,
      measures.largest,
      measures.lowest,
      measures.maximum,
      measures.longest * 10 * options.dt,
      measures.within);
  if (!options.picture.empty()) write_picture(bodies, panels, options.picture);
  if (series[0]) std::printf("open %s/*.pvd in ParaView\n", options.output.c_str());
}

}  // namespace examples
