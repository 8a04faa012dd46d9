// SPDX-License-Identifier: BSL-1.0
#include <sinew/runtime/precompiled.hpp>

#include <cmath>

// The ball of main.cpp, from a scene file.
int main() {
  auto scene = sinew::parse_scene<sinew::Standard>("ball.scn", R"(
    <Node name="root" gravity="0 -10 0" dt="0.1">
      <EulerExplicitSolver/>
      <MechanicalObject position="0 0 0"/>
      <UniformMass totalMass="1"/>
    </Node>)");
  auto sim = sinew::start(std::move(scene));
  for (int i = 0; i < 10; ++i) sim.animate(0.1);
  return std::abs(sim.kineticEnergy() - 50) < 1e-9 ? 0 : 1;  // v = 10 m/s
}
