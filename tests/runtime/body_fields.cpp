// SPDX-License-Identifier: BSL-1.0
// Values on the points of a body in scene files: temperatures in a child node.
#include "catch.hpp"
#include "error_of.hpp"

#include <sinew/engines.hpp>
#include <sinew/mechanics.hpp>
#include <sinew/runtime/precompiled.hpp>
#include <sinew/runtime/read_scene.hpp>
#include <sinew/runtime/runtime.hpp>
#include <sinew/runtime/save_scene.hpp>

#include "io/files.hpp"

namespace test_body_fields {

using namespace sinew;

namespace {

using Mine = Standard;

/// Two tetrahedra along x, and what stands in the node of the temperatures.
std::string scene(std::string const& inside,
                  std::string const& solver = "<CGLinearSolver iterations='50' tolerance='1e-14'/>") {
  return "<Node dt='0.1' gravity='0 0 0'>"
         "<MeshTopology name='topo' position='0 0 0  1 0 0  0 1 0  0 0 1  1 1 1' tetrahedra='0 1 2 3  1 2 3 "
         "4'/>"
         "<MechanicalObject name='dofs' tags='mechanics'/>"
         "<BoxROI name='hot' box='0.9 0.9 0.9 1.1 1.1 1.1' position='@dofs.position'/>"
         "<Node name='heat'><EulerImplicitSolver firstOrder='1'/>" +
         solver + inside + "</Node></Node>";
}
const std::string temperatures = "<MechanicalObject template='Vec1' name='T' position='1 2 3 4 5'/>",
                  diffusion =
                      "<TetrahedronDiffusionFEMForceField template='Vec1' topology='@../topo' "
                      "constantDiffusionCoefficient='2' tagMechanics='mechanics' drawConduc='0'/>",
                  mass =
                      "<MeshMatrixMass template='Vec1,Vec3' massDensity='1' lumping='0' topology='@../topo' "
                      "geometryState='@../dofs'/>";

ReadScene<Mine> read(std::string const& text) { return parse_scene<Mine>("test.scn", text); }
Vec1d::VecCoord run(ReadScene<Mine> scene, int steps = 5) {
  Simulation sim{std::move(scene.root)};
  sim.init();
  for (int i = 0; i < steps; ++i) sim.animate(0.1);
  return sim.root().find_node("heat")->get<MechanicalObject<Vec1d>>()->position;
}

}  // namespace

TEST_CASE("temperatures of a scene of SOFA diffuse over the tetrahedra of the node above") {
  auto file = read(scene(temperatures + diffusion + mass));
  for (auto const& warning : file.warnings) FAIL(warning);
  const auto u = run(std::move(file));
  // the capacities of the points by hand: volumes 1/6 and 1/3, of which each point has a quarter
  const double v = 1. / 24, w = 1. / 12, of[5] = {v, v + w, v + w, v + w, w};
  double before = 0, after = 0;
  for (int i = 0; i < 5; ++i) before += of[i] * (i + 1), after += of[i] * u[std::size_t(i)][0];
  CHECK(after == Approx(before).epsilon(1e-12));
  CHECK(u[4][0] < 5);
  CHECK(u[0][0] > 1);

  // an assembled matrix has the same
  const auto assembled = run(read(
      scene(temperatures + diffusion + mass, "<SparseLDLSolver template='CompressedRowSparseMatrixd'/>")));
  for (std::size_t i = 0; i < 5; ++i) CHECK(assembled[i][0] == Approx(u[i][0]).epsilon(1e-11));

  // and so has the scene saved and read again
  Simulation fresh{std::move(read(scene(temperatures + diffusion + mass)).root)};
  fresh.init();
  const auto saved = run(read(scene_text(fresh, 0.1)));
  for (std::size_t i = 0; i < 5; ++i) CHECK(saved[i][0] == u[i][0]);
}

TEST_CASE("points between a heated and a cooled one come to a temperature between theirs") {
  const std::string held =
      "<FixedConstraint indices='0'/>"
      "<LinearMovementProjectiveConstraint template='Vec1' keyTimes='0 0.5 100' movements='0 10 10' "
      "indices='@../hot.indices'/>";
  const auto u = run(read(scene(temperatures + diffusion +
                                "<DiagonalMass template='Vec1d,Vec3d' massDensity='1' "
                                "geometryState='@../dofs'/>" +
                                held)),
                     400);
  CHECK(u[0][0] == 1);
  CHECK(u[4][0] == Approx(15));
  // by symmetry the three points between have one temperature. Exchange s = -V g_i.g_j of point 0 with point
  // 1: g = (-1,-1,-1) and (1,0,0), V = 1/6; of 1 with 4: g = (1,-1,-1)/2 and (1,1,1)/2, V = 1/3
  for (int i = 1; i < 4; ++i)
    CHECK(u[std::size_t(i)][0] == Approx((1. / 6 * 1 + 1. / 12 * 15) / (1. / 6 + 1. / 12)));
}

TEST_CASE("values come from a file of vertices with one coordinate") {
  const files::TempFolder folder;
  folder.write("t.obj", "v 7\nv 1\nv 2\nv 3\nv 4\n");
  folder.write(
      "test.scn",
      "<Node><MeshOBJLoader name='values' filename='t.obj'/>"
      "<Node name='heat'><MechanicalObject template='Vec1' position='@../values.position'/></Node></Node>");
  auto file = read_scene<Mine>(folder / "test.scn");
  auto const& x = file.root.find_node("heat")->get<MechanicalObject<Vec1d>>()->position;
  REQUIRE(x.size() == 5);
  CHECK(x[0][0] == 7);
  CHECK(x[4][0] == 4);
}

TEST_CASE("what is wrong with values on a body is told") {
  auto says = [](std::string const& text, std::string_view part) {
    const std::string said = error_of([&] { run(read(text)); });
    INFO(said);
    CHECK(said.find(part) != std::string::npos);
  };
  says(scene("<MechanicalObject template='Vec1' position='1 2'/>" + diffusion + mass),
       "2 values, but the body");
  says(
      "<Node><EulerImplicitSolver firstOrder='1'/><CGLinearSolver/><MechanicalObject template='Vec1' "
      "position='1'/>"
      "<TetrahedronDiffusionFEMForceField/></Node>",
      "its values lie on no body");
  // other points than those of the elements
  says(scene(temperatures + diffusion + "<MeshMatrixMass massDensity='1' geometryState='@T'/>"),
       "geometryState leads to the points of 'heat', but its elements are over those of");
  says(scene("<MechanicalObject template='Vec1' tags='mechanics' position='1 2 3 4 5'/>" + mass +
             "<TetrahedronDiffusionFEMForceField tetraDiffusionCoefficient='1 2 3'/>"),
       "tetraDiffusionCoefficient has 3 values for 2 tetrahedra");
  says(scene(temperatures + mass + "<TetrahedronDiffusionFEMForceField constantDiffusionCoefficient='-1'/>"),
       "constantDiffusionCoefficient");
}

}  // namespace test_body_fields
