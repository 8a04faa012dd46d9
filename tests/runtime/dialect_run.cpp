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
