// SPDX-License-Identifier: BSL-1.0
// Rods and wires in scene files, as those of SOFA's plugin BeamAdapter have them; one registry of its own,
// since little is needed.
#include "catch.hpp"

#include <sinew/constraint/fixed_constraint.hpp>
#include <sinew/context/gravity.hpp>
#include <sinew/control/interventional_radiology_controller.hpp>
#include <sinew/core/registry.hpp>
#include <sinew/engine/beam_interpolation.hpp>
#include <sinew/engine/mesh_loader.hpp>
#include <sinew/engine/rod_spire_section.hpp>
#include <sinew/engine/rod_straight_section.hpp>
#include <sinew/engine/wire_beam_interpolation.hpp>
#include <sinew/engine/wire_rest_shape.hpp>
#include <sinew/force/adaptive_beam_force_field.hpp>
#include <sinew/force/rest_shape_springs.hpp>
#include <sinew/mapping/adaptive_beam_mapping.hpp>
#include <sinew/mass/adaptive_beam_mass.hpp>
#include <sinew/runtime/read_scene.hpp>
#include <sinew/runtime/runtime.hpp>
#include <sinew/scene/simulation.hpp>
#include <sinew/solver/euler_implicit.hpp>
#include <sinew/solver/sparse_ldl_solver.hpp>
#include <sinew/state/mechanical_object.hpp>
#include <sinew/topology/mesh_topology.hpp>
#include <sinew/topology/regular_grid_topology.hpp>

namespace test_rods {

using namespace sinew;
using Catch::Contains;
using Eigen::Vector3d;

struct Mine
    : Registry<Gravity, EulerImplicitSolver, SparseLDLSolver<CompressedRowSparseMatrixd>, MeshTopology,
               RegularGridTopology, MechanicalObject<Rigid3d>, MechanicalObject<Vec3d>,
               FixedConstraint<Rigid3d>, RestShapeSpringsForceField<Rigid3d>, AdaptiveBeamForceField<Rigid3d>,
               AdaptiveBeamMass<Rigid3d>, InterventionalRadiologyController<Rigid3d>,
               BeamInterpolation<Rigid3d>, WireBeamInterpolation<Rigid3d>, WireRestShape<Rigid3d>,
               MeshOBJLoader, RodStraightSection, RodSpireSection, AdaptiveBeamMapping<Rigid3d, Vec3d>> {};

namespace {

ReadScene<Mine> read(std::string const& components) {
  return parse_scene<Mine>("test.scn",
                           "<Node name='root' gravity='0 0 0' dt='0.01'>" + components + "</Node>");
}
std::string wrong(std::string const& components) {
  try {
    auto scene = read(components);
    Simulation sim{scene.root};
    sim.init();
  } catch (std::exception const& error) {
    return error.what();
  }
  return {};
}

const std::string solvers = "<EulerImplicitSolver rayleighStiffness='0.02'/><BTDLinearSolver/>";
const std::string shape = R"(<Node name="EdgeTopology">
  <RodStraightSection name="StraightSection" youngModulus="2e4" radius="0.9" massDensity="1.55e-6" poissonRatio="0.3"
                      nbBeams="10" nbEdgesCollis="50" nbEdgesVisu="200" length="80"/>
  <RodSpireSection name="SpireSection" youngModulus="2e4" radius="0.9" massDensity="1.55e-6" poissonRatio="0.3" nbBeams="5"
                   nbEdgesCollis="10" nbEdgesVisu="20" length="20" spireDiameter="25" spireHeight="0"/>
  <WireRestShape template="Rigid3d" name="BeamRestShape" wireMaterials="@StraightSection @SpireSection"/>
</Node>)";
std::string wire(std::string const& controller, std::string const& below = "") {
  return shape + "<Node name='BeamModel'>" + solvers + R"(
    <RegularGridTopology name="MeshLines" nx="16" ny="1" nz="1" xmax="0" xmin="0" ymin="0" ymax="0" zmax="0" zmin="0"/>
    <MechanicalObject template="Rigid3d" name="DOFs"/>
    <WireBeamInterpolation name="BeamInterpolation" WireRestShape="@../EdgeTopology/BeamRestShape"/>
    <AdaptiveBeamForceFieldAndMass name="BeamForceField" interpolation="@BeamInterpolation"/>
    <InterventionalRadiologyController name="DeployController" template="Rigid3d" )" +
         controller + "/>" + below + "</Node>";
}

}  // namespace

TEST_CASE("a rod of a scene file has its beams from the interpolation beside it, and its mass with it") {
  auto scene = read("<Node name='BeamModel'>" + solvers + R"(
    <MechanicalObject template="Rigid3d" position="0 0 0 0 0 0 1  2 0 0 0 0 0 1  4 0 0 0 0 0 1  6 0 0 0 0 0 1"/>
    <MeshTopology name="lines" lines="0 1 1 2 2 3"/>
    <FixedProjectiveConstraint indices="0"/>
    <BeamInterpolation name="BeamInterpolation" radius="0.1"/>
    <AdaptiveBeamForceFieldAndMass name="BeamForceField" computeMass="1" massDensity="10"/>
    <Node name="Collision">
      <MechanicalObject position="0 0.1 0  3 0 0.1  6 0 0"/>
      <AdaptiveBeamMapping/>
    </Node></Node>)");
  Simulation sim{scene.root};
  sim.init();
  auto& node = *sim.root().find_node("BeamModel");
  auto const& force = *node.get<AdaptiveBeamForceField<Rigid3d>>();
  REQUIRE(force.interpolation.size() == 3);
  CHECK(force.interpolation[0].length == Approx(2));
  CHECK(force.interpolation[0].youngModulus == 1e5);
  CHECK(node.get<AdaptiveBeamMass<Rigid3d>>()->massDensity == std::vector<double>{10});
  auto const& points = sim.root().find_node("BeamModel/Collision")->get<MechanicalObject<Vec3d>>()->position;
  CHECK((points[1] - Vector3d(3, 0, 0.1)).norm() < 1e-14);
  sim.animate(0.01);
  // without a mass of its own
  auto other = read("<Node name='BeamModel'>" + solvers + R"(
    <MechanicalObject template="Rigid3d" position="0 0 0 0 0 0 1  2 0 0 0 0 0 1"/>
    <BeamInterpolation radius="0.1"/><AdaptiveBeamForceFieldAndMass computeMass="0"/></Node>)");
  CHECK(other.root.find_node("BeamModel")->get<AdaptiveBeamMass<Rigid3d>>() == nullptr);
}

TEST_CASE("of values that are not one for each beam the first is that of all, as in SOFA, with a warning") {
  auto scene = read("<Node name='BeamModel'>" + solvers + R"(
    <MechanicalObject template="Rigid3d" position="0 0 0 0 0 0 1  2 0 0 0 0 0 1  4 0 0 0 0 0 1"/>
    <MeshTopology name="lines" lines="0 1 1 2"/>
    <BeamInterpolation radius="0.1 0.2" youngModulus="1e4 2e4 3e4" defaultPoissonRatio="0.4"/>
    <AdaptiveBeamForceFieldAndMass massDensity="10"/></Node>)");
  REQUIRE(scene.warnings.size() == 1);
  CHECK_THAT(*scene.warnings.begin(),
             Contains("youngModulus") &&
                 Contains("has 3 entries for 2 of edges; the first is that of all, as in SOFA"));
  Simulation sim{scene.root};
  sim.init();
  auto const& beams =
      sim.root().find_node("BeamModel")->get<AdaptiveBeamForceField<Rigid3d>>()->interpolation;
  REQUIRE(beams.size() == 2);
  CHECK(beams[0].youngModulus == 1e4);
  CHECK(beams[1].youngModulus == 1e4);
  CHECK(beams[1].area == Approx(4 * beams[0].area));
}

TEST_CASE("a wire of a scene file is made of its sections and pushed by its controller") {
  auto scene = read(wire(R"(instruments="BeamInterpolation" topology="@MeshLines"
    startingPos="0 0 0  0 -0.7071068 0 0.7071068" xtip="0" rotationInstrument="0" step="5" speed="50" listening="1")",
                         R"(<FixedProjectiveConstraint indices="0"/>
    <RestShapeSpringsForceField points="@DeployController.indexFirstNode" angularStiffness="1e8" stiffness="1e8"/>
    <Node name="points"><MechanicalObject/>
      <AdaptiveBeamMapping points="@../../EdgeTopology/BeamRestShape.collisionPoints"/></Node>)"));
  Simulation sim{scene.root};
  sim.init();
  auto& node = *sim.root().find_node("BeamModel");
  REQUIRE(node.get<AdaptiveBeamForceField<Rigid3d>>()->interpolation.size() == 15);
  REQUIRE(sim.root().find_node("BeamModel/points")->get<MechanicalObject<Vec3d>>()->position.size() == 61);
  for (int i = 0; i < 100; ++i) sim.animate(0.01);
  CHECK(node.get<InterventionalRadiologyController<Rigid3d>>()->xtip == Approx(50));
  // startingPos turns x to z, and the wire comes out there
  auto const& x = node.get<MechanicalObject<Rigid3d>>()->position;
  const double length = node.get<InterventionalRadiologyController<Rigid3d>>()->length();
  CHECK((x[0].center - Vector3d(0, 0, 50 - length)).norm() < 1e-5);
  CHECK(x.back().center[2] > 30);
}

TEST_CASE("the catheter of the examples has a wire of two sections") {
  auto scene = read_scene<Mine>(std::string(SINEW_EXAMPLE_SCENES) + "/catheter.scn", {.lenient = true});
  auto const& wire = *scene.root.find_node("wire");
  CHECK(wire.get<InterventionalRadiologyController<Rigid3d>>()->instruments.size() == 15);
  CHECK(wire.get<MechanicalObject<Rigid3d>>()->position.size() == 16);
}

TEST_CASE("wires of scene files that cannot be are refused") {
  CHECK_THAT(wrong(wire("instruments='BeamInterpolation Other'")), Contains("wires inside of each other"));
  CHECK_THAT(wrong(wire("instruments='Other'")), Contains("Other") && Contains("leads nowhere"));
  CHECK_THAT(wrong(wire("xtip='-1'")), Contains("xtip is -1 m"));
  CHECK_THAT(wrong("<WireRestShape template='Rigid3d' wireMaterials='@nothing @more'/>"),
             Contains("@nothing"));
  CHECK_THAT(wrong("<RodSpireSection name='a' spireDiameter='-1'/><WireRestShape template='Rigid3d' "
                   "wireMaterials='@a'/>"),
             Contains("spireDiameter is -1 m"));
}

}  // namespace test_rods
