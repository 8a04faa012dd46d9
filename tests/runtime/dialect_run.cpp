// SPDX-License-Identifier: BSL-1.0
// Scenes in SOFA's dialect over a small registry, run.
#include "catch.hpp"

#include <sinew/runtime/precompiled.hpp>

namespace test_dialect_run {

using namespace sinew;

TEST_CASE("a surface that names elements only follows the points of its mapping") {
  auto sim = start(parse_scene<Standard>("test.scn", R"(<Node gravity="0 0 -1">
    <EulerImplicitSolver/> <CGLinearSolver/>
    <RegularGridTopology name="grid" n="3 3 1"/>
    <MechanicalObject velocity="1 0 0"/>
    <TriangleSetTopologyContainer name="surface" src="@grid"/>
    <UniformMass/> <TriangularFEMForceField/>
    <Node name="named"><OglModel triangles="@../surface.triangles"/><IdentityMapping/></Node>
    <Node name="bare"><OglModel/><IdentityMapping/></Node>
  </Node>)"));
  for (int i = 0; i < 10; ++i) sim.animate(0.1);
  sim.updateVisual();
  auto const& state = *sim.root().get<MechanicalObject<Vec3d>>();
  // a free fall of ten steps, backwards: 1/2 t^2 + 1/2 t h, each to 1e-5 of its speed by conjugate gradients
  CHECK((state.position[8] - Eigen::Vector3d(2, 1, -0.55)).norm() < 1e-6);
  for (auto* name : {"named", "bare"}) {
    const Mesh now = sim.root().find_node(name)->get<VisualModel>()->current();
    REQUIRE(now.positions.size() == 9);
    CHECK(now.triangles.size() == 8);
    for (std::size_t i = 0; i < 9; ++i) CHECK((now.positions[i] - state.position[i]).norm() < 1e-6);
  }
  // and what is saved is the same scene
  auto again = start(parse_scene<Standard>("saved.scn", scene_text(sim, 0.1)));
  sim.animate(0.1), again.animate(0.1);
  CHECK(again.root().get<MechanicalObject<Vec3d>>()->position == state.position);
}

TEST_CASE("what is in the cells of a grid is put into place with it, and goes on from a checkpoint") {
  // the grid is turned by 90 degrees about z, stretched and moved; so is its child, since it lies in the grid
  const std::string_view scene = R"(<Node gravity="0 0 -1">
    <EulerImplicitSolver/> <CGLinearSolver/>
    <RegularGridTopology name="grid" n="3 2 2" min="0 0 0" max="2 1 1"/>
    STATE
    <UniformMass/>
    <Node name="inner"><MechanicalObject position="0.3 0.4 0.5  1.6 0.2 0.9"/><BarycentricMapping/></Node>
  </Node>)";
  constexpr std::string_view moved = "translation='5 6 7' rotation='0 0 90' ";
  auto started = [&](std::string state) {
    std::string text(scene);
    text.replace(text.find("STATE"), 5, state);
    return start(parse_scene<Standard>("test.scn", text));
  };
  auto placed = [&](std::string_view position) {
    return text("<MechanicalObject ", position, ' ', moved, "scale3d='2 2 2'/>");
  };
  for (auto const& state : {placed(""),
                            placed("position='@grid.position'"),
                            text("<TransformEngine name='move' input_position='@grid.position' ",
                                 moved,
                                 "scale='2 2 2'/><MechanicalObject position='@move.output_position'/>")}) {
    auto sim = started(state);
    auto inner = [](auto& of) -> auto const& {
      return of.root().find_node("inner")->template get<MechanicalObject<Vec3d>>()->position;
    };
    CHECK((inner(sim)[0] - Eigen::Vector3d(5 - 2 * 0.4, 6 + 2 * 0.3, 7 + 2 * 0.5)).norm() < 1e-14);
    CHECK((inner(sim)[1] - Eigen::Vector3d(5 - 2 * 0.2, 6 + 2 * 1.6, 7 + 2 * 0.9)).norm() < 1e-14);
    sim.animate(0.1);
    auto again = start(parse_scene<Standard>("saved.scn", scene_text(sim, 0.1)));
    CHECK(inner(again) == inner(sim));
    sim.animate(0.1), again.animate(0.1);
    CHECK(inner(again) == inner(sim));
  }
  // points of its own lie where they say, and the grid only has their cells
  auto own = started(
      placed("position='0 0 0 1 0 0 2 0 0  0 2 0 1 2 0 2 2 0  0 0 1 1 0 1 2 0 1  0 2 1 1 2 1 2 2 1'"));
  auto const& points = own.root().find_node("inner")->get<MechanicalObject<Vec3d>>()->position;
  CHECK((points[0] - Eigen::Vector3d(0.3, 0.4, 0.5)).norm() < 1e-13);
  CHECK((points[1] - Eigen::Vector3d(1.6, 0.2, 0.9)).norm() < 1e-13);
}

TEST_CASE("an explicit step of the mass of elements is solved by the linear solver of the scene") {
  // an edge of 6 kg: M^-1 = (2 -1; -1 2) / 3 kg, or 1/3 kg of each row's sum
  auto speeds = [](std::string_view linear) {
    auto sim = start(parse_scene<Standard>("test.scn", text("<Node gravity='0 0 0'>", linear, R"(
      <Node name="body"> <EulerExplicitSolver/>
        <MeshTopology position="0 0 0  1 0 0" edges="0 1"/> <MechanicalObject/>
        <MeshMatrixMass totalMass="6"/> <ConstantForceField indices="0" forces="3 0 0"/>
      </Node></Node>)")));
    sim.animate(1);
    auto const& v = sim.root().find_node("body")->template get<MechanicalObject<Vec3d>>()->velocity;
    return Eigen::Vector2d(v[0][0], v[1][0]);
  };
  for (auto* linear : {"<SparseLDLSolver/>", "<CGLinearSolver/>"})
    CHECK((speeds(linear) - Eigen::Vector2d(2, -1)).norm() < 1e-12);
  CHECK((speeds("") - Eigen::Vector2d(1, 0)).norm() < 1e-12);
}

TEST_CASE("a checkpoint goes on bit by bit from the last solution, and in a pulse of pressure") {
  for (auto* solver : {"CGLinearSolver", "CGLinearSolver template='CompressedRowSparseMatrix'"}) {
    auto sim = start(parse_scene<Standard>("test.scn",
                                           text(R"(<Node gravity="0 -1 0"><EulerImplicitSolver/><)",
                                                solver,
                                                R"( tolerance="1e-3" warmStart="1"/>
      <RegularGridTopology n="3 3 3" min="0 0 0" max="1 1 1"/>
      <MechanicalObject/><UniformMass/><MeshSpringForceField stiffness="100"/><FixedConstraint indices="0-8"/>
      <SurfacePressureForceField pressure="3" pulseMode="1" pressureSpeed="8"/></Node>)")));
    for (int i = 0; i < 7; ++i) sim.animate(0.1);
    auto const& pressure = *sim.root().get<SurfacePressureForceField<Vec3d>>();
    CHECK((pressure.returning && pressure.pulse > 0.1 && pressure.pulse < 2.9));
    auto again = start(parse_scene<Standard>("saved.scn", scene_text(sim, 0.1)));
    for (int i = 0; i < 7; ++i) sim.animate(0.1), again.animate(0.1);
    CHECK(again.root().get<MechanicalObject<Vec3d>>()->position ==
          sim.root().get<MechanicalObject<Vec3d>>()->position);
  }
}

TEST_CASE(
    "the last solution is that of the linear solver's node or above, goes into checkpoints and is gone after "
    "a reset") {
  for (auto* solver : {"EulerExplicitSolver", "EulerImplicitSolver", "NewmarkImplicitSolver"}) {
    auto sim = start(
        parse_scene<Standard>("test.scn",
                              text(R"(<Node gravity="0 -1 0"><CGLinearSolver tolerance="1e-3" warmStart="1"/>
      <Node name="body"><)",
                                   solver,
                                   R"(/><RegularGridTopology n="3 3 3" min="0 0 0" max="1 1 1"/>
      <MechanicalObject/><MeshMatrixMass totalMass="1"/><MeshSpringForceField stiffness="20"/>
      <FixedConstraint indices="0-8"/></Node></Node>)")));
    auto places = [](auto& of) {
      return of.root().find_node("body")->template get<MechanicalObject<Vec3d>>()->position;
    };
    for (int i = 0; i < 5; ++i) sim.animate(0.02);
    const auto first = places(sim);
    auto again = start(parse_scene<Standard>("saved.scn", scene_text(sim, 0.02)));
    for (int i = 0; i < 5; ++i) sim.animate(0.02), again.animate(0.02);
    CHECK(places(again) == places(sim));
    sim.reset();
    for (int i = 0; i < 5; ++i) sim.animate(0.02);
    CHECK(places(sim) == first);
  }
}

TEST_CASE("a checkpoint of BDF goes on bit by bit, whatever the order") {
  for (auto* order : {"1", "2", "3"}) {
    auto sim = start(parse_scene<Standard>("test.scn",
                                           text(R"(<Node gravity="0 -1 0"><BDFOdeSolver order=")",
                                                order,
                                                R"("/><CGLinearSolver tolerance="1e-12"/>
      <NewtonRaphsonSolver maxNbIterationsNewton="3"/>
      <MechanicalObject position="0 0 0  1 0 0"/><UniformMass/>
      <StiffSpringForceField spring="0 1 100 1 1"/><FixedConstraint indices="0"/></Node>)")));
    for (int i = 0; i < 7; ++i) sim.animate(0.1);
    CHECK(sim.root().get<BDFOdeSolver>()->newton.corrections.size() > 1);
    auto again = start(parse_scene<Standard>("saved.scn", scene_text(sim, 0.1)));
    for (int i = 0; i < 7; ++i) sim.animate(0.1), again.animate(0.1);
    CHECK(again.root().get<MechanicalObject<Vec3d>>()->position ==
          sim.root().get<MechanicalObject<Vec3d>>()->position);
  }
}

}  // namespace test_dialect_run
