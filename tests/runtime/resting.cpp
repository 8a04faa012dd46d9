// SPDX-License-Identifier: BSL-1.0
// What the documentation recommends comes to rest: an elastic block with models of triangles and points, or
// of lines too, on a floor of triangles, of which each place counts once.

#include "catch.hpp"

#include <sinew/runtime/precompiled.hpp>

namespace test_resting {

using namespace sinew;

namespace {

constexpr double mass = 4, gravity = 9.81;

std::string models(std::string_view kinds, std::string_view attributes) {
  std::string all;
  for (const char kind : kinds)
    all += text('<',
                kind == 'P'   ? "Point"
                : kind == 'L' ? "Line"
                              : "Triangle",
                "CollisionModel contactStiffness=\"5\" ",
                attributes,
                "/>");
  return all;
}

std::string scene(std::string_view body, std::string_view floor) {
  return text(R"(<Node name="root" gravity="0 0 -9.81" dt="0.005">
  <DefaultPipeline/> <BruteForceBroadPhase/> <BVHNarrowPhase/>
  <MinProximityIntersection alarmDistance="0.02" contactDistance="0.005"/> <DefaultContactManager/>
  <Node name="organs">
    <EulerImplicitSolver/> <SparseLDLSolver template="CompressedRowSparseMatrixMat3x3d"/>
    <Node name="liver">
      <RegularGridTopology n="5 5 4" min="-0.1 -0.1 0.004" max="0.1 0.1 0.104"/>
      <MechanicalObject/> <UniformMass totalMass="4"/>
      <HexahedronFEMForceField youngModulus="20000" poissonRatio="0.4"/>)",
              models(body, ""),
              R"(
    </Node>
  </Node>
  <Node name="ribs">
    <MeshTopology triangles="0 1 2  0 2 3"/>
    <MechanicalObject position="-1 -1 0  1 -1 0  1 1 0  -1 1 0"/>)",
              models(floor, R"(moving="false" simulated="false")"),
              "</Node></Node>");
}

}  // namespace

TEST_CASE("a block with triangles and points rests on a floor of triangles, and weighs what it weighs",
          "[long]") {
  // the diagonal of the floor goes through points of the block
  for (std::string_view body : {"TP", "TLP"})
    for (std::string_view floor : {"T", "TL", "TLP"}) {
      CAPTURE(body, floor);
      auto read = parse_scene<Standard>("resting.scn", scene(body, floor));
      Simulation sim{std::move(read.root)};
      sim.init();
      // the slowest motion loses a part of itself in each step by the solver alone: 6 s are enough for the
      // block to be as still as sums of its weight round
      for (int i = 0; i < 1200; ++i) sim.animate(0.005);
      auto const& state = *sim.root().find_node("organs/liver")->get<MechanicalObject<Vec3d>>();
      double fastest = 0;
      for (auto const& v : state.velocity) fastest = std::max(fastest, v.norm());
      CHECK(fastest < 1e-8);
      // each point of the lowest layer once
      CHECK(sim.root().get<DefaultContactManager>()->contacts.size() == 25);
      Eigen::Vector3d force(0, 0, 0);
      for (auto const& f : sim.forces())
        if (f.body == "/root/organs/liver") force += f.wrench.force;
      CHECK((force - Eigen::Vector3d(0, 0, mass * gravity)).norm() < 1e-6);
    }
}

TEST_CASE("a surface whose outside is on the wrong side is said at init") {
  auto warnings = [](std::string_view triangles, std::string_view positions, std::string_view attributes) {
    auto read = parse_scene<Standard>(
        "winding.scn",
        text(
            R"(<Node name="root" gravity="0 0 -9.81"> <DefaultPipeline/> <BruteForceBroadPhase/> <BVHNarrowPhase/>
  <MinProximityIntersection/> <DefaultContactManager/>
  <Node name="floor"> <MeshTopology triangles=")",
            triangles,
            R"("/> <MechanicalObject position=")",
            positions,
            R"("/> <TriangleCollisionModel )",
            attributes,
            "/></Node></Node>"));
    Simulation sim{std::move(read.root)};
    sim.init();
    return sim.root().warnings;
  };
  constexpr std::string_view square = "0 0 0  1 0 0  1 1 0  0 1 0",
                             still = R"(moving="false" simulated="false")";
  CHECK(warnings("0 1 2  0 2 3", square, still).empty());
  CHECK(warnings("0 2 1  0 3 2", square, R"(moving="false" simulated="false" bothSide="true")").empty());
  auto down = warnings("0 2 1  0 3 2", square, still);
  REQUIRE(down.size() == 1);
  CHECK_THAT(down[0], Catch::Contains("below them") && Catch::Contains("TriangleCollisionModel"));
  auto disagree = warnings("0 1 2  0 3 2", square, still);
  REQUIRE(disagree.size() == 1);
  CHECK_THAT(disagree[0], Catch::Contains("disagree at 1 edges"));
  constexpr std::string_view corners = "0 0 0  1 0 0  0 1 0  0 0 1";
  CHECK(warnings("0 2 1  0 1 3  0 3 2  1 2 3", corners, still).empty());
  auto inside = warnings("0 1 2  0 3 1  0 2 3  1 3 2", corners, still);
  REQUIRE(inside.size() == 1);
  CHECK_THAT(inside[0], Catch::Contains("face inwards"));
}

}  // namespace test_resting
