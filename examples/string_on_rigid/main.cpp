// SPDX-License-Identifier: BSL-1.0
#include "scene.hpp"

#include <sinew/io/pvd_series.hpp>

#include <cstdio>

namespace {

template <class Sim>
void run(char const* name, Sim sim, double dt) {
  sim.init();
  sinew::io::PvdSeries series(std::string("out/string_on_rigid_") + name);
  double next = 0;
  while (sim.time() < 3) {
    if (sim.time() >= next) {
      sinew::Mesh mesh;
      mesh.positions = sim.template at<"string">().state().position;
      mesh.positions.push_back(sim.template at<"brick/corner">().state().position[0]);
      mesh.positions.push_back(sim.template at<"brick">().state().position[0].center);
      for (int i = 1; i < int(mesh.positions.size()); ++i) mesh.edges.push_back({i - 1, i});
      series.add(sim.time(), mesh);
      next += 0.04;
    }
    sim.animate(dt);
  }
  auto const& c = sim.template at<"brick">().state().position[0].center;
  std::printf(
      "%-8s dt %.4f s: after 3 s the brick is at (%.3f, %.3f, %.3f) m; open out/string_on_rigid_%s.pvd\n",
      name,
      dt,
      c[0],
      c[1],
      c[2],
      name);
}

}  // namespace

int main() try {
  using namespace sinew;
  run("explicit", examples::string_on_rigid(EulerExplicitSolver{}), 0.0005);
  run("implicit",
      examples::string_on_rigid(EulerImplicitSolver{},
                                CGLinearSolver<>{.iterations = 200, .tolerance = 1e-10}),
      0.005);
  return 0;
} catch (sinew::Error const& error) {
  std::fprintf(stderr, "string_on_rigid: %s\n", error.what());
  return 1;
}
