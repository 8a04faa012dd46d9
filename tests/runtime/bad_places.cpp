// SPDX-License-Identifier: BSL-1.0
// Scenes whose parts do not fit together: solvers that have nothing to move, topologies over points that are
// not there, sizes that cannot be meant. Each is said, and none is read beyond its end.
#include "same_bits.hpp"

#include <sinew/core/memory_limit.hpp>

namespace test_bad_places {

using namespace sinew;
using Catch::Matchers::Contains;

namespace {

const std::string implicit =
    "<EulerImplicitSolver/><CGLinearSolver iterations='50' tolerance='1e-12' threshold='1e-12'/>";

// a body that hangs, with a mapped state below it; `inBody` and `inChild`: more components
std::string hanging(std::string const& inRoot, std::string const& inBody, std::string const& inChild) {
  return "<Node gravity='0 -9.81 0' dt='0.01'>" + inRoot + "<Node name='body'>" + inBody +
         "<MechanicalObject position='0 0 0 1 0 0 1 1 0'/><UniformMass vertexMass='0.1'/>"
         "<StiffSpringForceField spring='0 1 100 0.1 1  1 2 100 0.1 1  0 2 100 0.1 1.4'/><FixedConstraint "
         "indices='0'/>"
         "<Node name='child'>" +
         inChild +
         "<MechanicalObject/><IdentityMapping/><ConstantForceField indices='2' forces='0 0 0.1'/>"
         "</Node></Node></Node>";
}

auto run(std::string const& scene) {
  auto simulation = start(parse_scene<Standard>("scene.scn", scene));
  for (int i = 0; i < 20; ++i) simulation.animate(0.01);
  return simulation;
}
auto positions(StandardSimulation& s) {
  return s.root().find_node("body")->get<MechanicalObject<Vec3d>>()->position;
}
void says(std::string const& scene, std::string const& sentence) {
  REQUIRE_THROWS_WITH(run(scene), Contains("scene.scn:") && Contains(sentence));
}

}  // namespace

TEST_CASE("an ODE solver below another, or above nothing that it could move, does nothing and says so") {
  auto plain = run(hanging(implicit, "", ""));
  CHECK(plain.root().warnings.empty());
  const auto expected = positions(plain);

  const std::string direct = "<EulerImplicitSolver/><SparseLDLSolver/>";
  for (std::string const& solver :
       {implicit, direct, std::string("<EulerExplicitSolver/>"), std::string("<RungeKutta4Solver/>")}) {
    auto below = run(hanging(implicit, "", solver));
    REQUIRE(below.root().warnings.size() == 1);
    CHECK_THAT(below.root().warnings[0],
               Contains("scene.scn:1:") && Contains("/child: ") && Contains("does nothing"));
    CHECK(positions(below) == expected);
    CHECK(positions(*std::make_unique<StandardSimulation>(run(hanging(implicit, solver, "")))) == expected);

    // without one above, the body is not moved by anything
    auto alone = run(hanging("", "", solver));
    REQUIRE(alone.root().warnings.size() == 1);
    CHECK_THAT(alone.root().warnings[0], Contains("no state is below"));
    CHECK(positions(alone)[2] == Eigen::Vector3d(1, 1, 0));
  }
}

TEST_CASE("a mapping out of reach of the solver of its parent is refused") {
  says(
      "<Node><Node name='body'><MechanicalObject position='0 0 0'/><UniformMass/>"
      "<Node name='child'>" +
          implicit +
          "<MechanicalObject/><IdentityMapping/>"
          "<Node name='other'><MechanicalObject position='1 0 0'/><UniformMass/></Node></Node></Node></Node>",
      "is under another ODE solver than a parent (at '/root/body')");
}

TEST_CASE("what stands below a solver and acts on a state above it is refused") {
  for (std::string const part : {"<UniformMass/>",
                                 "<ConstantForceField indices='0' forces='1 0 0'/>",
                                 "<FixedConstraint indices='0'/>",
                                 "<PointCollisionModel/>"})
    says(
        "<Node><MechanicalObject position='0 0 0'/><Node name='solved'>" + implicit +
            "<Node name='body'><MechanicalObject position='1 0 0'/><UniformMass/></Node><Node name='other'>" +
            part + "</Node></Node></Node>",
        "acts on a state that the ODE solver above it does not move (the state of '/root', the solver of "
        "'/root/solved')");
}

TEST_CASE("collision models without a pipeline, and its parts without it, do nothing and say so") {
  const std::string scene =
      "<Node gravity='0 0 0'>STAGES" + implicit +
      "<Node name='a'><MechanicalObject position='0 0 0'/><UniformMass/><SphereCollisionModel "
      "radius='1'/></Node>"
      "<Node name='b'><MechanicalObject position='0.1 0 0'/><UniformMass/><SphereCollisionModel radius='1'/>"
      "</Node></Node>";
  for (std::string const stages : {"", "<BruteForceBroadPhase/><DefaultContactManager/>"}) {
    std::string with = scene;
    with.replace(with.find("STAGES"), 6, stages);
    auto simulation = run(with);
    REQUIRE(simulation.root().warnings.size() == (stages.empty() ? 2 : 4));
    CHECK_THAT(simulation.root().warnings.back(),
               Contains("SphereCollisionModel") && Contains("collides with nothing"));
    if (!stages.empty()) CHECK_THAT(simulation.root().warnings[0], Contains("does nothing"));
    CHECK(simulation.root().find_node("a")->get<MechanicalObject<Vec3d>>()->position[0].isZero());
  }
}

TEST_CASE("what changes the work of an ODE solver needs one in its node") {
  says("<Node><DampVelocitySolver rate='1'/><MechanicalObject position='0 0 0'/><UniformMass/></Node>",
       "and there is none");
}

TEST_CASE("topologies are checked before anybody reads through them") {
  const std::string pipeline =
      "<Node><DefaultPipeline/><BruteForceBroadPhase/><BVHNarrowPhase/><MinProximityIntersection/>"
      "<DefaultContactManager/>" +
      implicit;
  auto with = [&](std::string const& state, std::string const& topology, std::string const& model) {
    // before and behind the topology
    for (bool first : {true, false})
      says(pipeline + "<Node name='body'>" + (first ? model + topology : topology + model) + state +
               "<UniformMass/></Node></Node>",
           "point");
  };
  const std::string four = "<MeshTopology position='0 0 0 1 0 0 0 1 0 0 0 1' tetrahedra='0 1 2 3'/>";
  for (std::string const model : {"<TriangleCollisionModel/>", "<LineCollisionModel/>"}) {
    with("<MechanicalObject position='0 0 0 1 0 0'/>", four, model);
    with("<MechanicalObject position='0 0 0 1 0 0 0 1 0 0 0 1'/>",
         "<MeshTopology edges='0 9' triangles='0 1 9'/>",
         model);
    with("<MechanicalObject position='0 0 0 1 0 0 0 1 0'/>",
         "<MeshTopology triangles='0 1 2147483647'/>",
         model);
    with("<MechanicalObject position='0 0 0 1 0 0'/>", "<RegularGridTopology n='2 2 2'/>", model);
    with("<MechanicalObject/>", "<MeshTopology triangles='0 1 2'/>", model);
  }
  // mappings read through the topology of their parents
  says("<Node>" + implicit + "<Node name='body'><MechanicalObject position='0 0 0 1 0 0'/><UniformMass/>" +
           four +
           "<Node name='child'><MechanicalObject position='0.1 0.1 "
           "0.1'/><BarycentricMapping/></Node></Node></Node>",
       "point");
  // and what stands below the state of the topology
  says(pipeline +
           "<Node name='body'><MechanicalObject position='0 0 0'/><UniformMass/><Node name='surface'>"
           "<TriangleCollisionModel/><MeshTopology triangles='0 1 2'/></Node></Node></Node>",
       "point");
}

TEST_CASE("grids that cannot be meant are refused with the memory that they would take") {
  const std::string grid = "<Node><MechanicalObject/><RegularGridTopology n='99999 8 11'/></Node>";
  says(grid, "a grid of 99999 x 8 x 11 points would take 18 GB, and the limit is 8.59 GB");
  const std::size_t limit = memory_limit.exchange(1000 * bytesOfGridPoint);
  CHECK_NOTHROW(run("<Node><MechanicalObject/><RegularGridTopology n='10 10 10'/></Node>"));
  says("<Node><MechanicalObject/><RegularGridTopology n='10 10 11'/></Node>", "would take");
  says("<Node><MechanicalObject/><CubeTopology nx='10' ny='10' nz='11' min='0 0 0' max='1 1 1'/></Node>",
       "would take");
  says("<Node><MechanicalObject/><SphereGridTopology n='10 10 11' radius='1'/></Node>", "would take");
  memory_limit = limit;
}

TEST_CASE("forces that are not finite end in positions that are not, with each iterative solver") {
  for (std::string const& linear : {std::string("CGLinearSolver"),
                                    std::string("CGLinearSolver template='CompressedRowSparseMatrixd'"),
                                    std::string("ShewchukPCGLinearSolver"),
                                    std::string("MinResLinearSolver")}) {
    INFO(linear);
    auto simulation = start(parse_scene<Standard>(
        "scene.scn",
        "<Node dt='0.01'><Node name='body'><EulerImplicitSolver/><" + linear +
            "/><MechanicalObject position='0 0 0 1 0 0 1 1 0'/><UniformMass vertexMass='0.1'/>"
            "<StiffSpringForceField spring='0 1 100 0.1 1  1 2 100 0.1 1'/>"
            "<ConstantForceField indices='1' forces='1e300 1e300 1e300'/></Node></Node>"));  // whose square
                                                                                             // overflows
    CHECK_THROWS_WITH(simulation.animate(0.01), Contains("point 0 is not a finite number"));
  }
  // a largest number of iterations takes no memory
  auto simulation =
      run("<Node dt='0.01'><Node name='body'><EulerImplicitSolver/><CGLinearSolver iterations='2147483647'/>"
          "<MechanicalObject position='0 0 0'/><UniformMass vertexMass='0.1'/></Node></Node>");
  CHECK(simulation.root().find_node("body")->get<CGLinearSolver<>>()->residuals.capacity() < 2'000'000);
}

TEST_CASE("a linear solver has one matrix: two ODE solvers with one between them are refused") {
  auto body = [](std::string const& name, std::string const& solver) {
    return "<Node name='" + name + "'>" + solver +
           "<RegularGridTopology n='2 2 3' min='0 0 0' max='1 1 1'/><MechanicalObject/><MeshMatrixMass "
           "totalMass='1'/>"
           "<MeshSpringForceField stiffness='10'/></Node>";
  };
  const std::string one = "<EulerImplicitSolver/>", other = "<EulerExplicitSolver/>";
  for (std::string const& second : {one, other}) {
    says("<Node dt='0.01'><SparseLDLSolver/>" + body("body", one) + body("second", second) + "</Node>",
         "has one matrix; give each an assembled linear solver of its own");
    says("<Node dt='0.01'><CGLinearSolver template='CompressedRowSparseMatrixd'/>" + body("body", one) +
             body("second", second) + "</Node>",
         "/second: ");
    // without a matrix it may serve both
    run("<Node dt='0.01'><CGLinearSolver/>" + body("body", one) + body("second", second) + "</Node>");
    run("<Node dt='0.01'>" + body("body", one + "<SparseLDLSolver/>") +
        body("second", second + "<SparseLDLSolver/>") + "</Node>");
  }
}

}  // namespace test_bad_places
