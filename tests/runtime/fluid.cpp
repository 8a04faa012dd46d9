// SPDX-License-Identifier: BSL-1.0
// Fluids and bodies from a scene file: the bits of the typed scene.
#include "catch.hpp"
#include "error_of.hpp"

#include <sinew/core/registry.hpp>
#include <sinew/mechanics.hpp>
#include <sinew/runtime/precompiled.hpp>
#include <sinew/runtime/read_scene.hpp>
#include <sinew/runtime/runtime.hpp>
#include <sinew/solver/dfsph.hpp>
#include <sinew/topology/cube_topology.hpp>
#include <sinew/topology/surface_sampling.hpp>

namespace test_fluid {

using namespace sinew;

using Mine = Standard;

TEST_CASE("a drop falls on a box, in a scene file and in a typed scene, with the same bits") {
  Simulation read{parse_scene<Mine>("test.scn", R"(<Node gravity="0 -10 0">
      <Node name="water"><DFSPHSolver radius="0.2"/>
        <MechanicalObject position="0 0.3 0  0.1 0.3 0  0 0.4 0  0.1 0.4 0  0.05 0.35 0.1" velocity="0 -1 0"/>
        <UniformMass vertexMass="1"/></Node>
      <Node name="box"><EulerExplicitSolver/>
        <MechanicalObject template="Rigid3d" position="0 0 0 0 0 0 1"/><UniformMass template="Rigid3d" vertexMass="3"/>
        <Node name="surface"><CubeTopology name="cube" min="-0.15 -0.15 -0.15" max="0.15 0.15 0.15"/>
          <SurfaceSampling position="@cube.position" quads="@cube.quads" spacing="0.1"/>
          <MechanicalObject/><RigidMapping/><FluidBoundary/></Node></Node></Node>)")
                      .root};
  CubeTopology cube{.min = {-0.15, -0.15, -0.15}, .max = {0.15, 0.15, 0.15}};
  cube.generate("test");
  auto at = Rigid3d::zero();
  Simulation typed{node<"root">(
      Gravity{{0, -10, 0}},
      node<"water">(
          DFSPHSolver{.radius = 0.2},
          MechanicalObject<Vec3d>{
              .position = {{0, 0.3, 0}, {0.1, 0.3, 0}, {0, 0.4, 0}, {0.1, 0.4, 0}, {0.05, 0.35, 0.1}},
              .velocity = {{0, -1, 0}}},
          UniformMass<Vec3d>{.vertexMass = 1}),
      node<"box">(
          EulerExplicitSolver{},
          MechanicalObject<Rigid3d>{.position = {at}},
          UniformMass<Rigid3d>{.vertexMass =
                                   Rigid3d::MassType{.mass = 3, .inertia = 3 * Eigen::Matrix3d::Identity()}},
          node<"surface">(SurfaceSampling{.position = cube.position, .quads = cube.quads, .spacing = 0.1},
                          MechanicalObject<Vec3d>{},
                          RigidMapping<Rigid3d, Vec3d>{},
                          FluidBoundary<Vec3d>{})))};
  read.init();
  typed.init();
  const std::size_t samples = typed.at<"box/surface">().state().position.size();
  CHECK(samples > 50);
  for (int i = 0; i < 40; ++i) read.animate(0.005), typed.animate(0.005);
  auto& water = *read.root().find_node("water")->get<MechanicalObject<Vec3d>>();
  auto& box = *read.root().find_node("box")->get<MechanicalObject<Rigid3d>>();
  CHECK(water.position == typed.at<"water">().state().position);
  CHECK(box.velocity == typed.at<"box">().state().velocity);
  CHECK(box.velocity[0][1] < 40 * 0.005 * -10 - 1e-3);  // the drop has pushed it
}

TEST_CASE("a fluid behind the body that it meets is an error of the scene file") {
  Simulation read{parse_scene<Mine>("test.scn", R"(<Node gravity="0 -10 0">
      <Node name="body"><EulerExplicitSolver/><MechanicalObject position="1 0 0"/><UniformMass/><FluidBoundary/></Node>
      <Node name="water"><DFSPHSolver radius="2"/><MechanicalObject position="0 0 0"/><UniformMass vertexMass="1000"/>
      </Node></Node>)")
                      .root};
  CHECK_THAT(error_of([&] { read.init(); }), Catch::Contains("/water") && Catch::Contains("/body"));
}

}  // namespace test_fluid
