// SPDX-License-Identifier: BSL-1.0
// Elements that go by a plan, or where they leave a box, while a scene runs.

#include "catch.hpp"
#include "error_of.hpp"
#include "io/files.hpp"

#include <sinew/io/topological_changes.hpp>
#include <sinew/runtime/precompiled.hpp>

namespace test_topological_changes {

using namespace sinew;

namespace {

// a strip of six quads, each of two triangles, held at its end
std::string strip(std::string_view what, std::string_view more = "") {
  std::string triangles, positions;
  for (int i = 0; i < 7; ++i) positions += text("0 ", i, " 0  1 ", i, " 0  ");
  for (int i = 0; i < 6; ++i) {
    const int a = 2 * i;
    triangles += text(a, ' ', a + 1, ' ', a + 3, "  ", a, ' ', a + 3, ' ', a + 2, "  ");
  }
  return text(
      R"(<Node name="root" gravity="0 0 -9.81" dt="0.01"><Node name="strip">
    <EulerImplicitSolver rayleighStiffness="0.01"/><CGLinearSolver iterations="200" tolerance="1e-12" threshold="0"/>
    <MeshTopology triangles=")",
      triangles,
      R"("/><MechanicalObject position=")",
      positions,
      R"("/><UniformMass vertexMass="0.1"/><TriangleFEMForceField youngModulus="5000" thickness="0.01"/>
    <FixedConstraint indices="0 1"/>)",
      what,
      "</Node>",
      more,
      "</Node>");
}
using Scene = Simulation<RuntimeNode<Standard>>;
Scene scene_of(std::string const& xml) {
  Scene sim{parse_scene<Standard>("strip.scn", xml).root};
  sim.init();
  return sim;
}
auto& topology(Scene& sim) { return *sim.root().find_node("strip")->get<MeshTopology>(); }
auto& points(Scene& sim) { return sim.root().find_node("strip")->get<MechanicalObject<Vec3d>>()->position; }

}  // namespace

TEST_CASE("elements go at their time, and the rest moves as when they are removed by hand") {
  auto sim = scene_of(strip(
      R"(<TopologicalChangeProcessor useDataInputs="true" timeToRemove="0.095" trianglesToRemove="10 11"/>)"));
  auto byHand = scene_of(strip(""));
  for (int i = 0; i < 30; ++i) {
    if (i == 10) byHand.removeElements("strip", {.triangles = {10, 11}});
    sim.animate(0.01);
    byHand.animate(0.01);
    CHECK(topology(sim).triangles.size() == (i < 10 ? 12u : 10u));
    CHECK(points(sim) == points(byHand));
  }
  CHECK(points(sim).size() == 12);
  // another run with what is left: it goes by the clock of the scene
  sim.reset();
  sim.animate(0.01);
  CHECK(topology(sim).triangles.size() == 10);
}

TEST_CASE("numbers in a file are those after the changes before, in which the last element takes a place") {
  const files::TempFolder folder;
  const std::string file = folder.write(
      "changes.txt", "T= 0.02\n  REMOVE= 2\n11 1\nT= 0.03\n REMOVE= 2\n1 9\n T= 0.03 REMOVE= 1\n8\n");
  auto sim = scene_of(strip(text("<TopologicalChangeProcessor filename=\"", file, "\"/>")));
  const auto before = topology(sim).triangles;
  for (int i = 0; i < 6; ++i) sim.animate(0.01);
  // 0 10 2 3 4 5 6 7 8 9, then without 10 and 9: 0 8 2 3 4 5 6 7, which has no number 8
  std::vector<Triangle> left;
  for (const int e : {0, 2, 3, 4, 5, 6, 7, 8}) left.push_back(before[std::size_t(e)]);
  auto const& now = topology(sim).triangles;
  REQUIRE(now.size() == 8);
  for (std::size_t e = 0; e < 5; ++e) CHECK(now[e] == left[e]);
  REQUIRE(sim.warnings().list().size() == 1);
  CHECK(sim.warnings().list()[0].message == "elements to remove are not there any more");
}

TEST_CASE("a file that loops goes on by its last time, and the last element stays") {
  const files::TempFolder folder;
  const std::string file = folder.write("loop.txt", "T= 0.01\nREMOVE= 1\n0\nT= 0.02\nREMOVE= 1\n0\n");
  auto sim = scene_of(strip(text("<TopologicalChangeProcessor loop=\"true\" filename=\"", file, "\"/>")));
  for (int i = 0; i < 5; ++i) sim.animate(0.01);  // the fifth begins at 0.04 s, as the fourth change says
  CHECK(topology(sim).triangles.size() == 8);
  for (int i = 0; i < 20; ++i) sim.animate(0.01);
  CHECK(topology(sim).triangles.size() == 1);
  CHECK(sim.warnings().list().back().what == "the last element of a body stays");
}

TEST_CASE("the triangles of quads go with these, and springs across edges may all go") {
  const std::string quads = R"(<Node name="root" dt="0.01"><Node name="strip">
    <EulerImplicitSolver/><CGLinearSolver iterations="50" tolerance="1e-9"/>
    <QuadSetTopologyContainer name="quads" quads="0 1 3 2  2 3 5 4  4 5 7 6"/>
    <MechanicalObject position="0 0 0  1 0 0  0 1 0  1 1 0  0 2 0  1 2 0  0 3 0  1 3 0"/>
    <DiagonalMass massDensity="0.5"/><QuadularBendingSprings stiffness="30"/>
    <TopologicalChangeProcessor useDataInputs="true" timeToRemove="0.005" interval="0.01" quadsToRemove="0"/>
    <Node name="faces"><TriangleSetTopologyContainer name="triangles"/>
      <Quad2TriangleTopologicalMapping input="@../quads" output="@triangles"/>
      <TriangularBendingSprings stiffness="30"/></Node></Node></Node>)";
  auto sim = scene_of(quads);
  std::vector<std::size_t> triangles;
  for (int i = 0; i < 4; ++i) {
    sim.animate(0.01);
    triangles.push_back(sim.root().find_node("strip/faces")->get<MeshTopology>()->triangles.size());
  }
  CHECK(triangles == std::vector<std::size_t>{6, 4, 2, 2});
  CHECK(points(sim).size() == 4);
}

TEST_CASE("elements outside of a box go") {
  auto sim = scene_of(strip(R"(<TopologyBoundingTrasher box="-1 -1 -0.1  2 9 1"/>)"));
  std::size_t least = 12;
  for (int i = 0; i < 100; ++i) {
    const std::vector<Vec3d::Coord> x(points(sim).begin(), points(sim).end());
    std::size_t inside = 0;
    for (Triangle const& t : topology(sim).triangles)
      inside += std::all_of(t.begin(), t.end(), [&](Index p) { return x[std::size_t(p)][2] >= -0.1; });
    sim.animate(0.01);
    CHECK(topology(sim).triangles.size() == std::max<std::size_t>(1, inside));
    least = std::min(least, topology(sim).triangles.size());
  }
  CHECK(least < 12);
}

TEST_CASE("bad plans of topological changes are refused, and a scene that meets one stays what it was") {
  auto refused = [](std::string const& what) { return error_of([&] { scene_of(strip(what)); }); };
  CHECK_THAT(refused("<TopologicalChangeProcessor/>"), Catch::Contains("there is nothing to do"));
  CHECK_THAT(refused(R"(<TopologicalChangeProcessor useDataInputs="true"/>)"),
             Catch::Contains("nothing to remove"));
  CHECK_THAT(refused(R"(<TopologicalChangeProcessor trianglesToRemove="1"/>)"),
             Catch::Contains("set useDataInputs"));
  CHECK_THAT(refused(R"(<TopologicalChangeProcessor useDataInputs="true" trianglesToRemove="12"/>)"),
             Catch::Contains("triangle 12") && Catch::Contains("has 12"));
  CHECK_THAT(refused(R"(<TopologicalChangeProcessor useDataInputs="true" trianglesToRemove="-1"/>)"),
             Catch::Contains("trianglesToRemove"));
  CHECK_THAT(refused(R"(<TopologyBoundingTrasher box="0 0 0 1 0 1"/>)"), Catch::Contains("holds nothing"));
  CHECK_THAT(error_of([] {
               scene_of(strip("",
                              R"(<Node><RegularGridTopology n="2 2 2"/><MechanicalObject/>
      <TopologicalChangeProcessor useDataInputs="true" hexahedraToRemove="0"/></Node>)"));
             }),
             Catch::Contains("none of them can be removed"));
  CHECK_THAT(error_of([] {
               scene_of(R"(<Node name="root">
      <TopologicalChangeProcessor useDataInputs="true" hexahedraToRemove="0"/></Node>)");
             }),
             Catch::Contains("has a topology"));

  for (std::string_view const content : {"T= x",
                                         "REMOVE= 1 0",
                                         "T= 1 REMOVE= 1 -1",
                                         "T= 1 REMOVE= -2 1",
                                         "T= 2 REMOVE= 1 0 T= 1 REMOVE= 1 0",
                                         "T= 1 ADD= Triangles 1 0 1 2",
                                         "T= nan REMOVE= 1 0",
                                         "T= 1",
                                         "{"}) {
    INFO(content);
    CHECK_THAT(error_of([&] { io::parse_topological_changes("changes.txt", content); }),
               Catch::Contains("changes.txt"));
  }

  // where fewer numbers follow than the count says, the missing ones are 0
  const auto few =
      io::parse_topological_changes("changes.txt", "T= 1 REMOVE= 3 5 7 T= 2 REMOVE= 1 4 REMOVE= 9 2");
  REQUIRE(few.size() == 3);
  CHECK(few[0].elements == std::vector<int>{5, 7, 0});
  CHECK(few[0].isShort);
  CHECK(few[1].elements == std::vector<int>{4});
  CHECK(!few[1].isShort);
  CHECK(few[2].elements == std::vector<int>{2, 0});

  // a mass that cannot be: the step throws, and nothing has gone
  auto sim = scene_of(strip(
      R"(<TopologicalChangeProcessor useDataInputs="true" timeToRemove="0.005" trianglesToRemove="4"/>)",
      R"(<Node name="wire"><MechanicalObject position="0 0 0  1 0 0"/></Node>)"));
  sim.animate(0.01);
  auto const& before = topology(sim).triangles;
  CHECK(before.size() == 12);
  sim.animate(0.01);
  CHECK(topology(sim).triangles.size() == 11);
}

}  // namespace test_topological_changes
