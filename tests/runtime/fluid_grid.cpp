// SPDX-License-Identifier: BSL-1.0
// Fluid2D and Fluid3D from scene files: the same bits as in a typed scene, also from a checkpoint, and what
// readers say.
#include "catch.hpp"
#include "error_of.hpp"

#include <sinew/context/gravity.hpp>
#include <sinew/control/threads.hpp>
#include <sinew/core/registry.hpp>
#include <sinew/fluid/fluid2d.hpp>
#include <sinew/fluid/fluid3d.hpp>
#include <sinew/runtime/checks.hpp>
#include <sinew/runtime/precompiled.hpp>
#include <sinew/runtime/read_scene.hpp>
#include <sinew/runtime/save_scene.hpp>
#include <sinew/scene/simulation.hpp>
#include <sinew/view/seen_scene.hpp>

namespace test_runtime_fluid_grid {

using namespace sinew;
using Catch::Matchers::Contains;

namespace {

using Few = Standard;
using Few_simulation = Simulation<RuntimeNode<Few>>;

constexpr char const* scene =
    R"(<Node name="root" gravity="0 -9.81 0" dt="0.01"><Threads count="2"/><Node name="water">
  <Fluid3D nx="18" ny="14" nz="10" cellwidth="0.1" center="1 2 3" height="6.5" dir="0.4 1 0" viscosity="0.5" walls="stick"
           obstacle="0.5 0 0 1 1.6 9"/></Node></Node>)";

std::vector<double> flow_of(Few_simulation& sim) {
  std::vector<double> flow;
  sim.visit<role::BehaviorModel>(
      [&](auto const& model, auto const&) { flow.assign(model.flow.begin(), model.flow.end()); });
  return flow;
}
Few_simulation started(ReadScene<Few> read) {
  Few_simulation sim(std::move(read.root));
  sim.init(read.time, read.step);
  return sim;
}

}  // namespace

TEST_CASE("a fluid of a scene file has the bits of a typed one, also from a checkpoint") {
  auto sim = started(parse_scene<Few>("water.scn", scene));
  Simulation typed{node<"root">(Gravity{{0, -9.81, 0}},
                                node<"water">(Fluid3D<Vec3d>{.nx = 18,
                                                             .ny = 14,
                                                             .nz = 10,
                                                             .cellwidth = 0.1,
                                                             .center = {1, 2, 3},
                                                             .height = 6.5,
                                                             .dir = {0.4, 1, 0},
                                                             .viscosity = 0.5,
                                                             .walls = fluid::Walls::stick,
                                                             .obstacle = {{0.5, 0, 0, 1, 1.6, 9}}}))};
  typed.init();
  for (int k = 0; k < 6; ++k) {
    sim.animate(0.01);
    typed.animate(0.01);
  }
  CHECK(flow_of(sim) == typed.at<"water">().get<Fluid3D<Vec3d>>().flow);
  CHECK(sim.kineticEnergy() == typed.kineticEnergy());
  CHECK(sim.kineticEnergy() > 0);

  auto again = started(parse_scene<Few>("saved.scn", scene_text(sim, 0.01)));
  CHECK(again.step() == 6);
  for (int k = 0; k < 3; ++k) {
    sim.animate(0.01);
    again.animate(0.01);
  }
  CHECK(flow_of(again) == flow_of(sim));
}

TEST_CASE("what is seen of a fluid is its border") {
  auto sim = started(parse_scene<Few>("water.scn", scene));
  const view::SeenScene seen = view::seen_scene(sim);
  REQUIRE(seen.bodies.size() == 1);
  CHECK(seen.bodies[0].quads.size() > 100);
  CHECK(seen.bodies[0].path == "/root/water");
  CHECK(seen.up == Eigen::Vector3d(0, 1, 0));

  auto plane = started(parse_scene<Few>("plane.scn", "<Node><Fluid2D center='0 0 2'/></Node>"));
  const view::SeenScene flat = view::seen_scene(plane);
  REQUIRE(flat.bodies.size() == 1);
  CHECK(flat.bodies[0].edges.size() > 30);
  for (auto const& p : flat.bodies[0].points) CHECK(p[2] == 2);
}

TEST_CASE("what the reader says of a fluid that is wrong") {
  auto said = [](std::string const& attributes) {
    return error_of(
        [&] { started(parse_scene<Few>("water.scn", "<Node><Fluid3D " + attributes + "/></Node>")); });
  };
  CHECK(said("nx='8' ny='8' nz='8'").empty());
  CHECK_THAT(said("nx='10000' ny='10000' nz='10000'"), Contains("would take"));
  CHECK_THAT(said("nx='1e12'"), Contains("nx"));
  CHECK_THAT(said("cellwidth='0'"), Contains("cellwidth"));
  CHECK_THAT(said("height='nan'"), Contains("height"));
  CHECK_THAT(said("walls='wet'"), Contains("slip, stick"));
  CHECK_THAT(said("advection='mccormack'"), Contains("macCormack"));
  CHECK_THAT(said("heigth='3'"), Contains("height"));
  CHECK_THAT(said("obstacle='0 0 0 1 1'"), Contains("obstacle"));
}

}  // namespace test_runtime_fluid_grid
