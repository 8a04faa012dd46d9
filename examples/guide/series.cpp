// SPDX-License-Identifier: BSL-1.0
// A row of pictures of a moving body, and a series with a quantity of each point for ParaView.
#include <sinew/io/pvd_series.hpp>
#include <sinew/mechanics.hpp>
#include <sinew/topology/regular_grid.hpp>
#include <sinew/view/picture.hpp>

#include <cstdio>

using namespace sinew;

int main() try {
  const Mesh block = regular_grid_tetrahedra(9, 3, 3, {0, 0, 0}, {0.4, 0.1, 0.1});
  std::vector<int> held;
  for (std::size_t i = 0; i < block.positions.size(); ++i)
    if (block.positions[i].x() == 0) held.push_back(int(i));
  Simulation sim{node<"root">(Gravity{{0, -9.81, 0}},
                              EulerImplicitSolver{},
                              CGLinearSolver<>{.iterations = 100, .tolerance = 1e-9},
                              node<"block">(TetrahedronTopology{block.tetrahedra},
                                            MechanicalObject<Vec3d>{block.positions},
                                            DiagonalMass<Vec3d>{.massDensity = 1000},
                                            TetrahedronFEMForceField<Vec3d>{.youngModulus = {50000}},
                                            FixedConstraint<Vec3d>{.indices = held}))};
  sim.init();

  view::Painter painter({.width = 640, .height = 480});  // its first picture places the camera for all
  io::PvdSeries series("out/block");                     // out/block.pvd, for ParaView
  for (int step = 0; step <= 50; ++step) {
    if (step % 10 == 0) {
      auto const& state = sim.at<"block">().state();
      Mesh now = block;
      now.positions = state.position;
      std::vector<double> speed;
      for (auto const& v : state.velocity) speed.push_back(v.norm());
      series.add(sim.time(), now, {{"speed", 1, speed}});
      view::write_png(painter.paint(view::seen_scene(sim)), text("out/block", step / 10, ".png"));
    }
    sim.animate(0.01);
  }
  std::printf("%zu states in %s\n", series.size(), series.path().c_str());
} catch (Error const& error) {
  std::fprintf(stderr, "%s\n", error.what());
  return 1;
}
