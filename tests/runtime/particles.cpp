// SPDX-License-Identifier: BSL-1.0
// Sources and sinks of particles in scene files: the bits of the typed scene, checkpoints, and changes of a
// scene that runs.
#include "catch.hpp"
#include "error_of.hpp"

#include <sinew/control/write_state.hpp>
#include <sinew/core/registry.hpp>
#include <sinew/mechanics.hpp>
#include <sinew/runtime/precompiled.hpp>
#include <sinew/runtime/runtime.hpp>
#include <sinew/runtime/save_scene.hpp>
#include <sinew/view/seen_scene.hpp>

namespace test_runtime_particles {

using namespace sinew;
using Catch::Contains;

using Mine = Standard;
using Running = Simulation<RuntimeNode<Mine>>;

namespace {

constexpr std::string_view bleeding = R"(<Node gravity="0 -10 0">
  <Node name="drops">
    <EulerExplicitSolver symplectic="1"/>
    <MechanicalObject template="Vec3d"/>
    <UniformMass vertexMass="0.1"/>
    <SPHFluidForceField radius="0.1" mass="0.1" pressure="10" density="1000" kernelType="1" viscosityType="2"/>
    <PlaneForceField normal="0 1 0" d="-0.3"/>
    <ParticleSource name="first" center="0 0 0  0.05 0 0  0 0 0.05" radius="0.01 0.01 0.01" velocity="0 -1 0" delay="0.03"
                    capacity="100" printLog="0"/>
    <ParticleSource name="second" center="0.5 0 0" scale="0.5" translation="0 0.1 0" addNoise="0" velocity="2 -1 0"
                    delay="0.02" start="0.1" stop="0.4" capacity="200"/>
    <ParticleSink normal="-1 0 0" d0="-9" d1="-0.4" showPlane="1"/>
  </Node></Node>)";

Running start(std::string_view scene, double time = 0, long step = 0) {
  Running sim{parse_scene<Mine>("test.scn", std::string(scene)).root};
  sim.init(time, step);
  return sim;
}
Running saved(Running& sim) { return start(scene_text(sim, 0.01), sim.time(), sim.step()); }
auto& state_of(Running& sim) { return *sim.root().find_node("drops")->get<MechanicalObject<Vec3d>>(); }
auto bits(Running& sim) {
  auto& s = state_of(sim);
  return std::tuple(s.position, s.velocity, s.restPosition, sim.kineticEnergy());
}
void run(auto& sim, int steps) {
  for (int i = 0; i < steps; ++i) sim.animate(0.01);
}

}  // namespace

TEST_CASE("a source and a sink have the same bits in a scene file and in a typed scene") {
  Simulation typed{
      node<"root">(Gravity{{0, -10, 0}},
                   node<"drops">(EulerExplicitSolver{.symplectic = true},
                                 MechanicalObject<Vec3d>{},
                                 UniformMass<Vec3d>{.vertexMass = 0.1},
                                 SPHFluidForceField<Vec3d>{.radius = 0.1,
                                                           .mass = 0.1,
                                                           .pressure = 10,
                                                           .density = 1000,
                                                           .kernelType = 1,
                                                           .viscosityType = 2},
                                 PlaneForceField<Vec3d>{.normal = {0, 1, 0}, .d = -0.3},
                                 ParticleSource<Vec3d>{.center = {{0, 0, 0}, {0.05, 0, 0}, {0, 0, 0.05}},
                                                       .radius = {0.01, 0.01, 0.01},
                                                       .velocity = {0, -1, 0},
                                                       .delay = 0.03,
                                                       .capacity = 100},
                                 ParticleSource<Vec3d>{.translation = {0, 0.1, 0},
                                                       .scale = 0.5,
                                                       .center = {{0.5, 0, 0}},
                                                       .velocity = {2, -1, 0},
                                                       .delay = 0.02,
                                                       .start = 0.1,
                                                       .stop = 0.4,
                                                       .addNoise = false,
                                                       .capacity = 200},
                                 ParticleSink<Vec3d>{.normal = {-1, 0, 0}, .d0 = -9, .d1 = -0.4}))};
  typed.init();
  auto sim = start(bleeding);
  CHECK(state_of(sim).capacity == 200);
  run(typed, 60);
  run(sim, 60);
  auto& state = typed.at<"drops">().state();
  CHECK(state.size() > 60);
  CHECK(state_of(sim).position == state.position);
  CHECK(state_of(sim).velocity == state.velocity);
  CHECK(sim.root().find_node("drops")->get<ParticleSink<Vec3d>>()->removed > 2);
  // what a camera sees has the points of the state
  const view::SeenScene seen = view::seen_scene(sim);
  REQUIRE(seen.bodies.size() == 1);
  CHECK(seen.bodies[0].points == state.position);
}

TEST_CASE("a checkpoint goes on with the particles there are, and a reset of it ends where the scene began") {
  for (const int steps : {0, 1, 7, 33, 60}) {
    INFO(steps);
    auto sim = start(bleeding);
    run(sim, steps);
    auto again = saved(sim);
    CHECK(bits(again) == bits(sim));
    run(sim, 20);
    run(again, 20);
    CHECK(bits(again) == bits(sim));
    again.reset();
    CHECK(state_of(again).size() == 0);
    sim.reset();
    run(sim, 40);
    run(again, 40);
    CHECK(bits(again) == bits(sim));
  }
}

TEST_CASE("a state that a grid has filled may run empty, and is filled again by a reset only") {
  auto sim = start(R"(<Node gravity="0 -10 0"><Node name="drops"><EulerExplicitSolver/>
      <RegularGridTopology n="2 2 2" min="0 0 0" max="1 1 1" computeHexaList="0" computeQuadList="0" computeTriangleList="0"
                           computeEdgeList="0"/>
      <MechanicalObject template="Vec3d"/><UniformMass totalMass="8"/>
      <ParticleSink d0="-9" d1="-0.5"/></Node></Node>)");
  CHECK(state_of(sim).size() == 8);
  run(sim, 25);
  CHECK(state_of(sim).size() == 8);
  run(sim, 20);
  CHECK(state_of(sim).size() == 4);
  CHECK(sim.root().find_node("drops")->get<UniformMass<Vec3d>>()->lumped.mass == std::vector<double>{1});
  auto half = saved(sim);
  CHECK(bits(half) == bits(sim));
  run(sim, 40);
  CHECK(state_of(sim).size() == 0);
  auto empty = saved(sim);
  CHECK(state_of(empty).size() == 0);
  run(empty, 3);
  for (auto* one : {&sim, &half, &empty}) {
    one->reset();
    CHECK(state_of(*one).size() == 8);
    run(*one, 3);
    CHECK(bits(*one) == bits(sim));
  }
}

TEST_CASE("a source comes into a scene that runs and leaves it") {
  auto sim = start(bleeding);
  run(sim, 20);
  const std::size_t before = state_of(sim).size();
  sim.change([](RuntimeNode<Mine>& root) {
    for (auto const* name : {"first", "second", "ParticleSink"}) root.find_node("drops")->remove(name);
  });
  CHECK(state_of(sim).capacity == 0);
  run(sim, 30);
  CHECK(state_of(sim).size() == before);
  sim.reset();
  CHECK(state_of(sim).size() == before);  // its points no longer come and go
  sim.change([](RuntimeNode<Mine>& root) {
    root.find_node("drops")->add(
        ParticleSource<Vec3d>{.translation = {3, 0, 0}, .velocity = {0, 1, 0}, .delay = 0.05}, "third");
  });
  run(sim, 21);
  CHECK(state_of(sim).size() == before + 4);
}

TEST_CASE("what is wrong with sources and sinks in a scene file is said with its place") {
  auto wrong = [](std::string const& components) {
    return error_of([&] {
      start(
          "<Node><Node name='drops'>\n<EulerExplicitSolver/>\n<MechanicalObject position='0 0 0'/>\n"
          "<UniformMass/>\n" +
          components + "</Node></Node>");
    });
  };
  const std::string source = "<ParticleSource velocity='0 1 0'/>";
  CHECK(wrong(source).empty());
  CHECK_THAT(wrong("<ParticleSource velocity='0 1 0' capacity='0'/>"),
             Contains("test.scn:5:") && Contains("capacity"));
  CHECK_THAT(wrong("<ParticleSource velocity='0 1 0' delay='-0.1'/>"),
             Contains("test.scn:5:") && Contains("delay"));
  CHECK_THAT(wrong("<ParticleSource velocity='0 nan 0'/>"), Contains("test.scn:5:") && Contains("velocity"));
  CHECK_THAT(wrong("<ParticleSource delay='1'/>"), Contains("velocity is 0 and so is the radius"));
  CHECK_THAT(wrong("<ParticleSource velocity='0 1 0' capcity='3'/>"), Contains("did you mean 'capacity'"));
  CHECK_THAT(wrong("<ParticleSink normal='0 0 0'/>"), Contains("test.scn:5:") && Contains("normal"));
  CHECK_THAT(wrong("<FixedConstraint indices='0'/>\n" + source),
             Contains("test.scn:5:") && Contains("FixedConstraint") && Contains("points go and come"));
  CHECK_THAT(wrong("<WriteState filename='/tmp/none.state'/>\n" + source),
             Contains("WriteState") && Contains("points go and come"));
  auto full = start(
      "<Node><Node name='drops'><EulerExplicitSolver/><MechanicalObject template='Vec3d'/><UniformMass/>"
      "<ParticleSource velocity='0 1 0' delay='0.1' capacity='2'/></Node></Node>");
  run(full, 30);
  CHECK_THAT(error_of([&] { run(full, 5); }),
             Contains("/root/drops: ParticleSource<Vec3d>") && Contains("capacity of 2"));
}

}  // namespace test_runtime_particles
