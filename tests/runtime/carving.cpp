// SPDX-License-Identifier: BSL-1.0
// A scene file in which a ball carves a block, and the typed scene: the same bits, hole by hole.

#include "catch.hpp"

#include <sinew/runtime/precompiled.hpp>

namespace test_carving {

using namespace sinew;

namespace {

std::string scene(std::string_view tool) {
  return text(R"(
<Node name="carving" gravity="0 0 -9.81" dt="0.01">
  <DefaultPipeline/> <BruteForceBroadPhase/> <BVHNarrowPhase/>
  <MinProximityIntersection alarmDistance="0.1" contactDistance="0.02"/>
  <DefaultContactManager response="PenalityContactForceField"/>
  <CarvingManager active="true" carvingDistance="0.01" key="D" toolModel=")",
              tool,
              R"("/>
  <Node name="shape"> <RegularGridTopology name="grid" n="5 3 3" min="0 0 0" max="2 1 1"/> </Node>
  <Node name="block">
    <EulerImplicitSolver rayleighStiffness="0.05" rayleighMass="0.1"/>
    <CGLinearSolver iterations="20" tolerance="1e-9" threshold="0"/>
    <TetrahedronSetTopologyContainer name="container"/>
    <Hexa2TetraTopologicalMapping input="@../shape/grid" output="@container"/>
    <MechanicalObject position="@../shape/grid.position"/>
    <DiagonalMass massDensity="1"/>
    <TetrahedronFEMForceField youngModulus="2000" poissonRatio="0.3"/>
    <BoxROI name="clamped" box="-1 -1 -0.01  3 2 0.01"/>
    <FixedConstraint indices="@clamped.indices"/>
    <TriangleCollisionModel contactStiffness="10"/>
    <Node name="skin">
      <TriangleSetTopologyContainer name="container"/>
      <Tetra2TriangleTopologicalMapping input="@../container" output="@container"/>
      <Node name="look"> <OglModel src="@../container"/> <IdentityMapping/> </Node>
    </Node>
  </Node>
  <Node name="tool">
    <EulerImplicitSolver/>
    <CGLinearSolver iterations="10" tolerance="1e-8" threshold="0"/>
    <MechanicalObject template="Vec3d" position="0.3 0.5 1.4"/>
    <UniformMass totalMass="1"/>
    <LinearMovementConstraint indices="0" keyTimes="0 0.3 1" movements="0 0 0  0 0 -0.35  1.4 0 -0.35"/>
    <SphereCollisionModel name="ball" radius="0.2" simulated="false" contactStiffness="10"/>
  </Node>
</Node>)");
}

auto typed() {
  RegularGridTopology grid{.n = {5, 3, 3}, .min = {0, 0, 0}, .max = {2, 1, 1}};
  grid.generate("grid");
  const auto tetrahedra = hexahedra_to_tetrahedra(grid.hexahedra, {.points = grid.points}, 2);
  MeshTopology surface;
  surface.triangles = boundary_triangles(tetrahedra);
  std::vector<int> clamped;
  for (std::size_t i = 0; i < grid.position.size(); ++i)
    if (grid.position[i][2] == 0) clamped.push_back(int(i));
  return Simulation{node<"carving">(
      Gravity{{0, 0, -9.81}},
      DefaultPipeline{},
      BruteForceBroadPhase{},
      BVHNarrowPhase{},
      MinProximityIntersection{.alarmDistance = 0.1, .contactDistance = 0.02},
      DefaultContactManager{},
      CarvingManager{.active = true, .carvingDistance = 0.01, .toolModel = "tool"},
      node<"block">(EulerImplicitSolver{.rayleighStiffness = 0.05, .rayleighMass = 0.1},
                    CGLinearSolver<>{.iterations = 20, .tolerance = 1e-9},
                    TetrahedronTopology{tetrahedra},
                    MechanicalObject<Vec3d>{.position = grid.position},
                    DiagonalMass<Vec3d>{.massDensity = 1},
                    TetrahedronFEMForceField<Vec3d>{.youngModulus = {2000}, .poissonRatio = 0.3},
                    FixedConstraint<Vec3d>{.indices = clamped},
                    TriangleCollisionModel<Vec3d>{.contactStiffness = 10},
                    node<"skin">(surface,
                                 node<"look">(VisualModel{Mesh{.positions = grid.position,
                                                               .triangles = surface.triangles}},
                                              IdentityMapping<Vec3d, Vec3f>{}))),
      node<"tool">(EulerImplicitSolver{},
                   CGLinearSolver<>{.iterations = 10, .tolerance = 1e-8},
                   MechanicalObject<Vec3d>{.position = {{0.3, 0.5, 1.4}}},
                   UniformMass<Vec3d>{.totalMass = 1},
                   LinearMovementConstraint<Vec3d>{.indices = {0},
                                                   .keyTimes = {0, 0.3, 1},
                                                   .movements = {{0, 0, 0}, {0, 0, -0.35}, {1.4, 0, -0.35}}},
                   SphereCollisionModel<Vec3d>{.simulated = false, .contactStiffness = 10, .radius = 0.2}))};
}

}  // namespace

TEST_CASE("a ball carves a block in a scene file and in a typed scene: the same bits") {
  for (std::string_view tool : {"@tool/ball", "@/tool/ball", "tool", "/tool"}) {
    auto read = parse_scene<Standard>("carving.scn", scene(tool));
    Simulation sim{std::move(read.root)};
    auto fixed = typed();
    sim.init(), fixed.init();
    const std::size_t whole = fixed.at<"block">().get<TetrahedronTopology>().tetrahedra.size();
    for (int i = 0; i < 120; ++i) {
      sim.animate(0.01), fixed.animate(0.01);
      auto& block = *sim.root().find_node("block");
      auto& there = fixed.at<"block">();
      auto const* mesh = block.get<MeshTopology>();
      REQUIRE((mesh ? mesh->tetrahedra : block.get<TetrahedronTopology>()->tetrahedra) ==
              there.get<TetrahedronTopology>().tetrahedra);
      REQUIRE(block.get<MechanicalObject<Vec3d>>()->position == there.state().position);
      if (i % 10) continue;
      sim.updateVisual();
      auto const& skin = *block.find_node("skin")->find_node("look")->get<VisualModel>();
      auto const& look = fixed.at<"block/skin/look">().visual();
      REQUIRE(skin.mesh.triangles == look.mesh.triangles);
      REQUIRE(skin.position == look.position);
    }
    CHECK(sim.root().get<CarvingManager>()->removed == fixed.root().get<CarvingManager>().removed);
    CHECK(fixed.at<"block">().get<TetrahedronTopology>().tetrahedra.size() < whole - 20);
  }
}

}  // namespace test_carving
