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
                                         "T= 1 ADD= Triangles 1 0 1",
                                         "T= 1 ADD= Triangles 1 Ancestors x 0 1 2",
                                         "T= 1 ADD= Cones 1 0",
                                         "T= 1 ADD= Quads -1",
                                         "ADD= Triangles 1 0 1 2",
                                         "T= 1 ADD= PointsInTriangle 1 0 0.7 0.7",
                                         "T= 1 ADD= PointsInTriangle 1 0 nan 0.2",
                                         "T= 1 INCISE= 1 0 0 0",
                                         "T= 1 INCISE= 2 0 0 0 1",
                                         "T= 1 INCISE= 2 0 0 0 1 0 inf",
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
  CHECK(few[0].numbers == std::vector<int>{5, 7, 0});
  CHECK(few[0].isShort);
  CHECK(few[1].numbers == std::vector<int>{4});
  CHECK(!few[1].isShort);
  CHECK(few[2].numbers == std::vector<int>{2, 0});

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

TEST_CASE("a file adds elements, points and parts of elements, and takes the whole away") {
  const files::TempFolder folder;
  const std::string file =
      folder.write("changes.txt",
                   "T= 0.02\n ADD= PointsInTriangle 1\n11 0.5 0.25\nT= 0.02\n ADD= Triangles 3 "
                   "Ancestors 11 11 11\n10 13 14 13 12 14 12 10 14\nT= 0.04\n REMOVE= 1\n11 3\n");
  auto sim = scene_of(strip(text("<TopologicalChangeProcessor filename=\"", file, "\"/>")));
  auto byHand = scene_of(strip(""));
  for (int i = 0; i < 12; ++i) {
    if (i == 2) {
      const Triangle t = topology(byHand).triangles[11];
      AddedElements parts{.points = {{t[0], t[1], 0.25, t[2], 0.25}},
                          .triangles = {{10, 13, 14}, {13, 12, 14}, {12, 10, 14}}};
      parts.ancestors[1] = {11, 11, 11};
      byHand.addElements("strip", parts);
    }
    if (i == 4) byHand.removeElements("strip", {.triangles = {11}});
    sim.animate(0.01), byHand.animate(0.01);
    CHECK(topology(sim).triangles == topology(byHand).triangles);
    CHECK(points(sim) == points(byHand));
  }
  CHECK(topology(sim).triangles.size() == 14);
  CHECK(points(sim).size() == 15);
  REQUIRE(sim.warnings().list().size() == 1);
  CHECK_THAT(sim.warnings().list()[0].message, Catch::Contains("more numbers follow"));
}

namespace {

std::string filling(std::string_view more, std::string_view file) {
  return text(R"(<Node name="root" gravity="0 0 -1" dt="0.01"><Node name="strip">
    <EulerImplicitSolver/><CGLinearSolver iterations="200" tolerance="1e-14" threshold="0"/>
    <TetrahedronSetTopologyContainer name="volume" position="0 0 0  1 0 0  0 1 0  0 0 1  1 1 1"/>
    <MechanicalObject/><DiagonalMass massDensity="6"/>
    <TetrahedronFEMForceField youngModulus="1000" poissonRatio="0.3"/><FixedConstraint indices="0 1 2"/>
    <Node name="skin"><TriangleSetTopologyContainer name="triangles"/>
      <Tetra2TriangleTopologicalMapping input="@../volume" output="@triangles"/>
      <TriangleFEMForceField youngModulus="10" poissonRatio="0.3"/><TriangleCollisionModel/>
      <Node name="look"><OglModel/><IdentityMapping/></Node></Node>)",
              more,
              file.empty() ? std::string() : text("<TopologicalChangeProcessor filename=\"", file, "\"/>"),
              "</Node></Node>");
}

}  // namespace

TEST_CASE("a topology that something adds to may be empty at the start, with what is made of it; no other") {
  const files::TempFolder folder;
  const std::string file =
      folder.write("fill.txt", "T= 0\nADD= Tetrahedra 1\n0 1 2 3\nT= 0.03\nADD= Tetrahedra 1\n1 2 3 4\n");
  auto sim = scene_of(filling("", file));
  CHECK(topology(sim).tetrahedra.empty());
  std::vector<std::size_t> faces, seen;
  for (int i = 0; i < 6; ++i) {
    sim.animate(0.01);
    auto& strip = *sim.root().find_node("strip");
    faces.push_back(strip.find_node("skin")->get<MeshTopology>()->triangles.size());
    seen.push_back(strip.find_node("skin/look")->get<VisualModel>()->mesh.triangles.size());
    // 1/6 m^3 at first, and 1/3 m^3 more
    double mass = 0;
    auto const& m = *strip.get<DiagonalMass<Vec3d>>();
    for (std::size_t p = 0; p < m.lumped.mass.size(); ++p)
      if (std::find(m.lumped.massless.begin(), m.lumped.massless.end(), int(p)) == m.lumped.massless.end())
        mass += m.lumped.mass[p];
    CHECK(mass == Approx(i < 3 ? 1 : 3));
    if (i < 3) CHECK(points(sim)[4] == Eigen::Vector3d(1, 1, 1));  // no element has it yet
  }
  CHECK(faces == std::vector<std::size_t>{4, 4, 4, 6, 6, 6});
  CHECK(seen == faces);
  CHECK_THAT(error_of([] { scene_of(filling("", "")); }), Catch::Contains("the topology has no tetrahedron"));
  const std::string removes = folder.write("removes.txt", "T= 0\nREMOVE= 1\n0\n");
  CHECK_THAT(error_of([&] { scene_of(filling("", removes)); }),
             Catch::Contains("the topology has no tetrahedron"));
}

TEST_CASE("what a step changes is made whole or not at all") {
  const files::TempFolder folder;
  const std::string file = folder.write(
      "wrong.txt",
      "T= 0.02\nADD= Triangles 1\n0 2 5\nT= 0.02\nREMOVE= 1\n0\nT= 0.02\nADD= Triangles 1\n0 1 99\n");
  auto sim = scene_of(strip(text("<TopologicalChangeProcessor filename=\"", file, "\"/>")));
  sim.animate(0.01), sim.animate(0.01);
  const auto triangles = topology(sim).triangles;
  const auto x = points(sim);
  for (int i = 0; i < 2; ++i) {
    CHECK_THAT(error_of([&] { sim.animate(0.01); }),
               Catch::Contains("the topological change at step 2") && Catch::Contains("has point 99") &&
                   Catch::Contains("/root/strip"));
    CHECK(topology(sim).triangles == triangles);
    CHECK(points(sim) == x);
  }
}

TEST_CASE("points go with their springs, and elements where a box is that moving points come into") {
  auto springs = scene_of(R"(<Node name="root" gravity="0 -10 0"><EulerImplicitSolver/>
    <CGLinearSolver iterations="100" tolerance="1e-9" threshold="1e-9"/>
    <Node name="held"><MechanicalObject name="dof" position="0 2 0  1 2 0  2 2 0"/><FixedConstraint indices="0 1 2"/></Node>
    <Node name="strip"><PointSetTopologyContainer position="0 1 0  1 1 0  2 1 0"/><MechanicalObject name="dof"/>
      <UniformMass vertexMass="10"/>
      <TopologicalChangeProcessor useDataInputs="true" pointsToRemove="0 1" timeToRemove="0.02"/></Node>
    <SpringForceField object1="@held/dof" object2="@strip/dof" spring="0 0 100 0 1  1 1 100 0 1  2 2 100 0 1  1 2 100 0 1"/>
    </Node>)");
  for (int i = 0; i < 5; ++i) {
    springs.animate(0.01);
    CHECK(points(springs).size() == (i < 3 ? 3u : 1u));
  }
  CHECK(points(springs)[0][0] < 2);

  std::string xml = strip(R"(<BoxROI name="low" box="-1 -1 -9  2 9 -0.05" position="@dof.position"
    triangles="@mesh.triangles"/><TopologicalChangeProcessor useDataInputs="true" trianglesToRemove="@low.triangleIndices"
    timeToRemove="0.01" interval="0.01"/>)");
  xml.insert(xml.find("<MechanicalObject") + 17, R"( name="dof")");
  xml.insert(xml.find("<MeshTopology") + 13, R"( name="mesh")");
  auto sim = scene_of(xml);
  std::size_t last = 12;
  for (int i = 0; i < 40; ++i) {
    sim.animate(0.01);
    CHECK(topology(sim).triangles.size() <= last);
    last = topology(sim).triangles.size();
  }
  CHECK(last < 12);
}

TEST_CASE("a file cuts triangles along a path") {
  const files::TempFolder folder;
  const std::string file = folder.write(
      "cut.txt", "T= 0.01\nINCISE= 2\n-0.5 2.5 0 0.7 2.5 0\nT= 0.03\nINCISE= 2\n0.7 2.5 0 1.5 2.5 0\n");
  auto sim = scene_of(
      strip(text("<TopologicalChangeProcessor filename=\"", file, "\" saveIndicesAtInit=\"true\"/>")));
  const std::size_t n = points(sim).size();
  for (int i = 0; i < 10; ++i) sim.animate(0.01);
  // the strip is in two parts: edges across the path are gone
  CHECK(points(sim).size() > n);
  auto const& rest = sim.root().find_node("strip")->get<MechanicalObject<Vec3d>>()->restPosition;
  double area = 0;
  for (Triangle const& t : topology(sim).triangles) {
    double low = 9, high = -9;
    for (const Index i : t) {
      low = std::min(low, rest[std::size_t(i)][1]);
      high = std::max(high, rest[std::size_t(i)][1]);
    }
    CHECK(!(low < 2.3 && high > 2.7));
    area += (rest[std::size_t(t[1])] - rest[std::size_t(t[0])])
                .cross(rest[std::size_t(t[2])] - rest[std::size_t(t[0])])
                .norm() /
            2;
  }
  CHECK(area == Approx(6));
}

TEST_CASE("elements of a scene file are refined while it runs") {
  Scene scene = scene_of(strip(""));
  scene.init();
  scene.animate(0.01);
  scene.refineElements("strip", {.triangles = {0, 11}});
  auto const& strip = *scene.root().find_node("strip");
  auto const& state = *strip.get<MechanicalObject<Vec3d>>();
  // four for each, and two for a neighbour
  CHECK(strip.get<MeshTopology>()->triangles.size() == 12 + 2 * 3 + 2);
  CHECK(state.size() == 14 + 6);
  CHECK(strip.get<FixedConstraint<Vec3d>>()->indices.size() == 3);  // and the middle of the edge that is held
  double area = 0;
  for (Triangle const& t : strip.get<MeshTopology>()->triangles) {
    auto at = [&](std::size_t k) { return state.restPosition[std::size_t(t[k])]; };
    area += (at(1) - at(0)).cross(at(2) - at(0)).norm() / 2;
  }
  CHECK(area == Approx(6).epsilon(1e-14));
  for (int i = 0; i < 20; ++i) scene.animate(0.01);
  CHECK(state.position[13].z() < -1e-3);
  CHECK_THROWS_WITH(scene.refineElements("strip", {.triangles = {-5}}),
                    Catch::Contains("there is no triangle -5 to refine"));
}

TEST_CASE("quads and hexahedra of a scene file are refined while it runs") {
  Scene scene{
      parse_scene<Standard>("bar.scn", R"(<Node name="root" gravity="0 0 -9.81" dt="0.01"><Node name="bar">
    <EulerImplicitSolver rayleighStiffness="0.01"/><CGLinearSolver iterations="200" tolerance="1e-12" threshold="0"/>
    <MeshTopology hexahedra="0 1 4 3 6 7 10 9  1 2 5 4 7 8 11 10" quads="0 3 4 1  6 7 10 9"/>
    <MechanicalObject position="0 0 0  1 0 0  2 0 0  0 1 0  1 1 0  2 1 0  0 0 1  1 0 1  2 0 1  0 1 1  1 1 1  2 1 1"/>
    <DiagonalMass massDensity="2"/><HexahedronFEMForceField youngModulus="5000 9000" poissonRatio="0.3"/>
    <FixedConstraint indices="0 3 6 9"/></Node></Node>)")
          .root};
  scene.init();
  scene.animate(0.01);
  scene.refineElements("bar", {.hexahedra = {0}});
  auto const& bar = *scene.root().find_node("bar");
  auto const& state = *bar.get<MechanicalObject<Vec3d>>();
  // the first in 8, the second across in 4, and the faces of the first with it
  CHECK(bar.get<MeshTopology>()->hexahedra.size() == 12);
  CHECK(bar.get<MeshTopology>()->quads.size() == 8);
  CHECK(state.size() == 4 * 9);
  CHECK(bar.get<HexahedronFEMForceField<Vec3d>>()->youngModulus ==
        std::vector<double>{5000, 5000, 5000, 5000, 5000, 5000, 5000, 5000, 9000, 9000, 9000, 9000});
  CHECK(bar.get<FixedConstraint<Vec3d>>()->indices.size() == 9);
  for (int i = 0; i < 20; ++i) scene.animate(0.01);
  for (std::size_t i = 0; i < state.size(); ++i)
    if (state.restPosition[i].x() == 2) CHECK(state.position[i].z() < state.restPosition[i].z());
  CHECK_THROWS_WITH(scene.refineElements("bar", {.hexahedra = {12}}),
                    Catch::Contains("there is no hexahedron 12 to refine"));
}

}  // namespace test_topological_changes
