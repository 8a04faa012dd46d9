// SPDX-License-Identifier: BSL-1.0
// Engines in scene files: numbered inputs and outputs, values whose size follows from links, pairs of states,
// and what SOFA reads in part.
#include "catch.hpp"
#include "error_of.hpp"

#include <sinew/registry.hpp>
#include <sinew/runtime/precompiled.hpp>
#include <sinew/runtime/read_scene.hpp>
#include <sinew/runtime/runtime.hpp>

#include <cstdio>
#include <fstream>

namespace test_engine_scenes {

using namespace sinew;
using Catch::Matchers::Contains;
using Points = std::vector<Eigen::Vector3d>;

namespace {

using Mine = Standard;

ReadScene<Mine> read(std::string const& content) {
  return parse_scene<Mine>("test.scn", "<Node>" + content + "</Node>");
}
template <class C>
C const& only(ReadScene<Mine>& scene) {
  return *scene.root.template get<C>();
}

}  // namespace

TEST_CASE("engines have as many numbered inputs as they say, and links lead to numbered outputs") {
  auto scene = read(
      "<RegularGridTopology name='a' n='2 2 2' max='1 1 1'/><RegularGridTopology name='b' n='3 2 2' max='2 1 "
      "1'/>"
      "<MergeMeshes name='both' nbMeshes='3' position3='7 7 7' position1='@a.position' "
      "hexahedra1='@a.hexahedra' "
      "position2='@b.position' hexahedra2='@b.hexahedra'/>"
      "<MeshSplittingEngine name='split' src='@both' nbInputs='1' hexahedronIndices1='0'/>"
      "<MechanicalObject name='rest' position='@split.position2'/>");
  auto const& merged = only<MergeMeshes<Vec3d>>(scene);
  CHECK(merged.positions.size() == 3);
  CHECK(merged.positions[2] == Points{{7, 7, 7}});
  CHECK(merged.npoints == 8 + 12 + 1);
  CHECK(merged.hexahedra.size() == 3);
  auto const& split = only<MeshSplittingEngine>(scene);
  CHECK(split.positions[0].size() == 8);
  CHECK(only<MechanicalObject<Vec3d>>(scene).position == split.positions[1]);
  CHECK(split.positions[1].size() == 13);
  auto first = read(
      "<MeshSplittingEngine name='s' position='0 0 0 1 0 0' nbInputs='1' indices1='1'/>"
      "<MechanicalObject position='@s.position1'/>");
  CHECK(only<MechanicalObject<Vec3d>>(first).position == Points{{1, 0, 0}});
  CHECK_THAT(error_of([] { read("<MergeVectors nbInputs='1' input1='1' input2='x'/>"); }),
             Contains("<MergeVectors>: input2:") && Contains("'x'"));
  CHECK_THAT(error_of([] { read("<MergeVectors nbInputs='1' input1='1' input2='2'/>"); }),
             Contains("2 inputs, but nbInputs is 1"));
  CHECK_THAT(error_of([] { read("<MergeVectors input0='1'/>"); }), Contains("has no attribute 'input0'"));
  CHECK_THAT(
      error_of([] {
        read("<MeshSplittingEngine name='s' position='0 0 0'/><MechanicalObject position='@s.position2'/>");
      }),
      Contains("has no 'position2'"));
  auto labels = read("<SelectLabelROI labels='[1 2] [] [3]' selectLabels='3 1'/>");
  CHECK(only<SelectLabelROI>(labels).indices == std::vector<int>{0, 2});
  CHECK_THAT(error_of([] { read("<SelectLabelROI labels='[1 2] 4 [3]' selectLabels='3'/>"); }),
             Contains("each list stands in brackets"));
}

TEST_CASE("the size of values follows from what they are linked to, through engines and templates") {
  auto scene = read(
      "<MechanicalObject name='m' position='0 0 0  3 4 0  0 0 2'/>"
      "<ValuesFromIndices name='a' in='@m.position' indices='1 2'/>"
      "<ValuesFromIndices name='b' template='Vec3' in='0 0 0 0 0 1' indices='0 1'/>"
      "<DifferenceEngine name='d' input='@a.out' substractor='@b.out'/><NormEngine input='@d.output'/>"
      "<MergeVectors name='v' input1='@a.out' input2='9 9 9'/>");
  CHECK(only<DifferenceEngine>(scene).size == 3);
  CHECK(only<NormEngine>(scene).output == std::vector<double>{5, 1});
  CHECK(only<MergeVectors>(scene).output.size() == 9);
  auto plane = read("<HausdorffDistance template='Vec2' points1='0 0  1 0' points2='0 3'/>");
  CHECK(only<HausdorffDistance>(plane).maximum == Approx(std::sqrt(10.)));
  auto line = read("<HausdorffDistance size='1' points1='0 10' points2='0'/>");
  CHECK(only<HausdorffDistance>(line).maximum == 10);
  // frames from an engine stay frames
  auto frames = read(
      "<QuatToRigidEngine name='q' positions='1 2 3' orientations='0 0 1 0'/>"
      "<MechanicalObject template='Rigid3' position='@q.rigids'/>");
  CHECK(only<MechanicalObject<Rigid3d>>(frames).position[0].orientation.z() == 1);
}

TEST_CASE("engines take points and elements from what they name, or what is around them") {
  const std::string states =
      "<Node name='a'><MechanicalObject position='0 0 0 5 0 0'/></Node>"
      "<Node name='b'><MechanicalObject position='0 0 0.5' rest_position='5 0 0.5'/></Node>";
  auto scene = read(states + "<NearestPointROI template='Vec3' object1='@a' object2='@b' radius='1'/>");
  CHECK(only<NearestPointROI<Vec3d>>(scene).indices1 == std::vector<int>{1});
  auto moved = read(
      states + "<NearestPointROI template='Vec3' object1='@a' object2='@b' radius='1' useRestPosition='0'/>");
  CHECK(only<NearestPointROI<Vec3d>>(moved).indices1 == std::vector<int>{0});
  CHECK_THAT(error_of([&] { read(states + "<NearestPointROI template='Vec3' object1='@c' object2='@b'/>"); }),
             Contains("'@c' leads nowhere"));
  // a selection does not take its edges from a topology that is made of it
  CHECK_NOTHROW(
      read("<MechanicalObject position='0 0 0 1 0 0'/><BoxROI name='box' box='-1 -1 -1 2 2 2'/>"
           "<NearestPointROI name='n' position1='0 0 0 1 0 0' position2='0 0 0 1 0 0' "
           "inputIndices1='@box.indices' "
           "radius='0.1'/><MeshTopology edges='@n.edges'/>"));
  auto named = read(
      "<MeshTopology name='square' position='0 0 0 1 0 0 1 1 0 0 1 1' quads='0 1 2 3'/>"
      "<Node name='below'><MeshTopology name='none'/>"
      "<SmoothMeshEngine name='s' topology='@../square' input_position='@../square.position'/></Node>");
  CHECK(named.root.find_node("below")->get<SmoothMeshEngine>()->outputPosition[0] ==
        Eigen::Vector3d(0.5, 0.5, 0.5));
  // where the state is, and not where it rests
  auto volume = read(
      "<MeshTopology triangles='0 2 1 0 1 3 0 3 2 1 2 3'/>"
      "<MechanicalObject position='0 0 0 2 0 0 0 1 0 0 0 1' rest_position='0 0 0 1 0 0 0 1 0 0 0 1'/>"
      "<VolumeFromTriangles/>");
  CHECK(only<VolumeFromTriangles<Vec3d>>(volume).volume == Approx(2 / 6.));
}

TEST_CASE("a mesh comes from a visual model that stands beside the state which is made of it") {
  for (std::string const& taken :
       {"src='@Visual'", "position='@Visual.position' triangles='@Visual.triangles'"}) {
    auto scene = read(
        "<OglModel name='Visual' position='0 0 0  1 0 0  0 1 0  1 1 0' triangles='0 1 2  1 3 2' dz='2'/>"
        "<MeshTopology name='topo' " +
        taken +
        "/><PointsFromIndices name='some' position='@topo.position' indices='3 1'/>"
        "<MechanicalObject position='@some.indices_position'/>");
    CHECK(only<MechanicalObject<Vec3d>>(scene).position == Points{{1, 1, 2}, {1, 0, 2}});
    CHECK(only<MeshTopology>(scene).triangles == std::vector<Triangle>{{0, 1, 2}, {1, 3, 2}});
  }
  CHECK_THAT(error_of([] { read("<Node name='below'/><MeshTopology src='@below'/>"); }),
             Contains("'@below' leads to no loader"));
}

TEST_CASE("what SOFA reads in part is read so, with a warning") {
  auto solver = read("<EulerImplicitSolver/><CGLinearSolver iterations='1e4'/>");
  CHECK(only<CGLinearSolver<>>(solver).iterations == 1);
  REQUIRE(solver.warnings.size() == 1);
  CHECK_THAT(solver.warnings[0],
             Contains("test.scn:1:") && Contains("iterations: '1e4' is read as 1, as in SOFA"));
  CHECK_THAT(error_of([] { read("<CGLinearSolver iterations='4x'/>"); }),
             Contains("'4x' is no whole number"));
  CHECK_THAT(error_of([] { read("<CGLinearSolver iterations='2 3'/>"); }), Contains("goes on with '3'"));
  auto mass =
      read("<MechanicalObject template='Rigid3'/><UniformMass vertexMass='2 1 0.1 0 0 0 0.1 0 0 0 0.1 0'/>");
  CHECK(only<UniformMass<Rigid3d>>(mass).vertexMass->mass == 2);
  CHECK_THAT(mass.warnings.at(0), Contains("vertexMass: has 12 numbers; the first 11 are taken"));
  auto moves = read(
      "<MechanicalObject/><LinearMovementConstraint indices='0' keyTimes='0 1' movements='0 0 0 1 0 0 2 0 0 "
      "3 0 0'/>");
  CHECK(only<LinearMovementConstraint<Vec3d>>(moves).movements.size() == 2);
  CHECK_THAT(moves.warnings.at(0), Contains("movements: has 4 entries for 2 of keyTimes"));
  auto state = read("<MechanicalObject translation='1 0 0' translation2='0 2 0' position='0 0 0'/>");
  CHECK(only<MechanicalObject<Vec3d>>(state).translation == Eigen::Vector3d(1, 2, 0));
  CHECK_THAT(error_of([] { read("<MechanicalObject translation2='0 2'/>"); }),
             Contains("translation2: ends where"));
}

TEST_CASE("a folder of data is named by the scene") {
  CHECK_THAT(error_of([] { read("<MeshOBJLoader filename='mesh_of_engine_scenes.obj'/>"); }),
             Contains("there is no file"));
  std::ofstream("/tmp/mesh_of_engine_scenes.obj") << "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";
  auto scene = read(
      "<AddDataRepository path='/tmp'/><MeshOBJLoader filename='mesh_of_engine_scenes.obj' scale='2 0.25'/>");
  CHECK(only<MeshOBJLoader>(scene).position[1] == Eigen::Vector3d(2, 0, 0));
  CHECK_THAT(scene.warnings.at(0), Contains("scale: has 2 numbers; the first 1 are taken"));
  std::remove("/tmp/mesh_of_engine_scenes.obj");
}

}  // namespace test_engine_scenes
