// SPDX-License-Identifier: BSL-1.0
// A scene file says how many threads work, and its steps have the bits that they have with one.
#include "catch.hpp"

#include <sinew/runtime/checks.hpp>
#include <sinew/runtime/precompiled.hpp>
#include <sinew/runtime/read_scene.hpp>
#include <sinew/runtime/scope.hpp>
#include <sinew/scene/simulation.hpp>
#include <sinew/sinew.hpp>

namespace test_threads {

using namespace sinew;

namespace {

using Small = Standard;

auto simulation(std::string const& threads, std::string const& below) {
  auto scene = parse_scene<Small>(
      "test.scn", "<Node name=\"root\" gravity=\"0 -10 0\">" + threads + "<Node name=\"body\">" + below + R"(
    <EulerImplicitSolver/><CGLinearSolver iterations="5" tolerance="0"/>
    <RegularGridTopology n="10 10 32" min="0 0 0" max="1 1 3"/>
    <MechanicalObject velocity="1 2 3"/><UniformMass totalMass="1"/><MeshSpringForceField stiffness="100"/>
    </Node></Node>)");
  Simulation sim{std::move(scene.root)};
  sim.init();
  return sim;
}

}  // namespace

TEST_CASE("a scene file says how many threads work") {
  std::vector<std::string> all{"", "<Threads/>", "<Threads count=\"2\"/>", "<Threads count=\"5\"/>"};
  std::vector<Eigen::Vector3d> first;
  for (auto const& threads : all)
    for (const bool inside : {false, true}) {
      auto sim = simulation(inside ? "" : threads, inside ? threads : "");
      for (int i = 0; i < 3; ++i) sim.animate(0.01);
      auto const& now = sim.root().find_node("body")->get<MechanicalObject<Vec3d>>()->position;
      if (first.empty()) first = now;
      CHECK(now == first);
    }
  for (std::string bad : {"0", "-2", "257", "1000000000", "many"}) {
    INFO(bad);
    CHECK_THROWS_WITH(simulation("<Threads count=\"" + bad + "\"/>", ""), Catch::Matchers::Contains("count"));
  }
  // read in part, as SOFA reads whole numbers, and said
  const auto scene = parse_scene<Small>("test.scn", "<Node><Threads count=\"1e9\"/></Node>");
  REQUIRE(scene.warnings.size() == 1);
  CHECK_THAT(scene.warnings[0], Catch::Matchers::Contains("count: '1e9' is read as 1, as in SOFA"));
}

}  // namespace test_threads
