// SPDX-License-Identifier: BSL-1.0
#include "scene.hpp"

#include "options.hpp"
#include "picture.hpp"
#include "support/progress.hpp"

#include <sinew/io/pvd_series.hpp>

#include <cmath>

using namespace sinew;

namespace {

template <class Sim>
std::vector<Spring> const& uncut(Sim& sim) {
  return sim.template at<"eye">().template get<examples::CuttableSpringForceField<Vec3d>>().springs;
}

/// One line of the table.
template <class Sim>
void report(char const* when, examples::Eye const& eye, Sim& sim) {
  const auto s = examples::examine(eye, sim.template at<"eye">().state().position, uncut(sim));
  std::printf("%-16s %6.2f %10zu %12.3f %12.3f %12.2f %10.3f %10.3f\n",
              when,
              sim.time(),
              uncut(sim).size(),
              1e3 * s.traction,
              1e3 * s.tension,
              1e9 * s.energy,
              1e6 * s.rms,
              1e6 * s.maximum);
}

/// The springs that are left, as lines.
template <class Sim>
Mesh lines(Sim& sim) {
  Mesh mesh{.positions = sim.template at<"eye">().state().position};
  for (Spring const& s : uncut(sim)) mesh.edges.push_back({s.first, s.second});
  return mesh;
}

struct Pictures {
  io::PvdSeries retina, scar, springs, handle, tip;
  explicit Pictures(std::string const& folder)
      : retina(folder + "/retina"),
        scar(folder + "/scar"),
        springs(folder + "/springs"),
        handle(folder + "/handle"),
        tip(folder + "/tip") {}

  template <class Sim>
  void add(Sim& sim) {
    retina.add(sim.time(), sim.template at<"eye/retina">().visual().current());
    scar.add(sim.time(), sim.template at<"eye/scar">().visual().current());
    springs.add(sim.time(), lines(sim));
    handle.add(sim.time(), sim.template at<"tool/handle">().visual().current());
    tip.add(sim.time(), sim.template at<"tool/tip">().visual().current());
  }
};

}  // namespace

int main(int argc, char** argv) try {
  examples::VitrectomyOptions options;
  int status = 0;
  if (!examples::read_options(argc, argv, options, status)) return status;
  const examples::Eye eye = examples::make_eye({.sectors = options.sectors});
  if (!options.sceneData.empty()) {
    examples::write_scene_data(eye, options.sceneData);
    std::printf("wrote the data of vitrectomy.scn to %s\n", options.sceneData.c_str());
    return 0;
  }
  auto sim = examples::vitrectomy_scene(eye);
  sim.init();
  std::printf("vitrectomy: %zu points, %zu springs, %zu more to cut\n",
              eye.position.size(),
              eye.springs.size(),
              eye.cuttable.size());
  std::printf("%-16s %6s %10s %12s %12s %12s %10s %10s\n",
              "",
              "time",
              "springs",
              "traction",
              "tension",
              "energy",
              "distance",
              "at most");
  std::printf(
      "%-16s %6s %10s %12s %12s %12s %10s %10s\n", "", "s", "to cut", "mN", "mN", "nJ", "rms, um", "um");

  std::optional<Pictures> pictures;
  if (!options.output.empty()) pictures.emplace(options.output);
  if (pictures) pictures->add(sim);
  const long steps = std::lround(options.time / options.dt);
  const auto step_at = [&](double time) { return std::lround(time / options.dt); };
  const long begin = step_at(eye.cutBegins), end = step_at(eye.cutEnds), before = step_at(eye.times[1]);
  std::vector<examples::Panel> panels;
  auto draw = [&](char const* title) {
    panels.push_back({title, sim.at<"eye">().state().position, uncut(sim)});
  };
  examples::Progress progress(steps);
  examples::Stopwatch stepping;
  for (long i = 1; i <= steps; ++i) {
    stepping.start();
    sim.animate(options.dt);
    stepping.stop();
    if (pictures && i % options.every == 0) pictures->add(sim);
    progress.at(i);
    if (i == before) report("before", eye, sim), draw("before");
    if (i == (begin + end) / 2) draw("half of it is cut");
    for (const int quarter : {1, 2, 3})
      if (i == begin + quarter * (end - begin) / 4) report("during the cut", eye, sim);
    if (i == end) report("all around", eye, sim);
  }
  report("after", eye, sim);
  draw("after");
  if (!options.picture.empty()) examples::write_picture(eye, panels, 4, options.picture);
  std::printf("%ld steps of %g s in %.3f s: %.0f steps/s, %.1f times real time\n",
              steps,
              options.dt,
              stepping.seconds(),
              double(steps) / stepping.seconds(),
              double(steps) * options.dt / stepping.seconds());
  if (pictures) std::printf("open %s/*.pvd in ParaView\n", options.output.c_str());
  return 0;
} catch (sinew::Error const& error) {
  std::fprintf(stderr, "vitrectomy: %s\n", error.what());
  return 1;
}
