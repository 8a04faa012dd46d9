// SPDX-License-Identifier: BSL-1.0
#include "catch.hpp"

#include <sinew/runtime/precompiled.hpp>

namespace test_damp_velocity {

using namespace sinew;

namespace {

auto simulation(std::string const& solvers) {
  auto scene = parse_scene<Standard>("test.scn", "<Node gravity=\"0 -10 0\">" + solvers + R"(
    <MechanicalObject position="0 0 0"/><UniformMass totalMass="1"/></Node>)");
  Simulation sim{std::move(scene.root)};
  sim.init();
  return sim;
}

}  // namespace

TEST_CASE("a DampVelocitySolver stands beside the ODE solver of a node, another one does not") {
  auto sim = simulation(R"(<EulerExplicitSolver/><DampVelocitySolver rate="3"/>)");
  for (int i = 0; i < 1000; ++i) sim.animate(0.01);
  CHECK(sim.root().get<MechanicalObject<Vec3d>>()->velocity[0][1] == Approx(-0.1 / (std::exp(0.03) - 1)));
  std::string said;
  try {
    simulation("<EulerExplicitSolver/><DampVelocitySolver/><BDFOdeSolver/><CGLinearSolver/>");
  } catch (Error const& error) {
    said = error.what();
  }
  CHECK(said.find("is the second ODE solver of its node (beside EulerExplicitSolver)") != std::string::npos);
}

}  // namespace test_damp_velocity
