// SPDX-License-Identifier: BSL-1.0
// Scene files over the DataTypes of a device: the same bits as the typed scene, and what the scene over Vec3f
// does, to rounding.
#include "catch.hpp"

#include <sinew/gpu/gpu.hpp>

#include <sinew/constraint/fixed_constraint.hpp>
#include <sinew/context/gravity.hpp>
#include <sinew/engine/box_roi.hpp>
#include <sinew/force/regular_grid_spring.hpp>
#include <sinew/mapping/barycentric_mapping.hpp>
#include <sinew/mapping/subset_mapping.hpp>
#include <sinew/mass/uniform_mass.hpp>
#include <sinew/runtime/checks.hpp>
#include <sinew/runtime/read_scene.hpp>
#include <sinew/runtime/record.hpp>
#include <sinew/runtime/save_scene.hpp>
#include <sinew/runtime/scope.hpp>
#include <sinew/scene/simulation.hpp>
#include <sinew/solver/cg_linear_solver.hpp>
#include <sinew/solver/euler_implicit.hpp>
#include <sinew/solver/multigrid_linear_solver.hpp>
#include <sinew/state/mechanical_object.hpp>
#include <sinew/topology/regular_grid_topology.hpp>
#include <sinew/visual/visual_model.hpp>

namespace test_scene_files {

using namespace sinew;

namespace {

// as few classes as the scene takes: all of CudaStandard compile for minutes
struct Few
    : Registry<Gravity, RegularGridTopology, VisualModel, BoxROI<Vec3f>, EulerImplicitSolver,
               CGLinearSolver<>, MultigridLinearSolver<>, MechanicalObject<CudaVec3f>, UniformMass<CudaVec3f>,
               RegularGridSpringForceField<CudaVec3f>, FixedConstraint<CudaVec3f>, MechanicalObject<Vec3f>,
               SubsetMapping<CudaVec3f, Vec3f>, BarycentricMapping<CudaVec3f, Vec3f>> {};

constexpr char scene[] = R"(<Node name="root" gravity="0 -9.81 0" dt="0.02">
  <EulerImplicitSolver rayleighStiffness="0.01" rayleighMass="0.1"/>
  <CGLinearSolver iterations="25" tolerance="0" threshold="0"/>
  <Node name="bar">
    <RegularGridTopology n="7 3 3" min="0 0 0" max="3 1 1"/>
    <MechanicalObject template="CudaVec3f"/>
    <UniformMass vertexMass="2"/>
    <RegularGridSpringForceField linesStiffness="1e5" linesDamping="10" cubesStiffness="4e4" cubesDamping="10"/>
    <BoxROI name="held" box="-0.1 -0.1 -0.1  0.1 1.1 1.1"/>
    <FixedConstraint indices="@held.indices"/>
    <Node name="points">
      <MechanicalObject template="Vec3f"/>
      <SubsetMapping indices="62 20"/>
    </Node>
    <Node name="skin">
      <OglModel position="3 1 1  1.5 0.5 0.5"/>
      <BarycentricMapping/>
    </Node>
  </Node>
</Node>)";

template <class D>
auto typed() {
  std::vector<int> held;
  for (int i = 0; i < 63; i += 7) held.push_back(i);
  VisualModel skin;
  skin.mesh.positions = {{3, 1, 1}, {1.5, 0.5, 0.5}};
  return Simulation{node<"root">(
      Gravity{{0, -9.81, 0}},
      EulerImplicitSolver{.rayleighStiffness = 0.01, .rayleighMass = 0.1},
      CGLinearSolver<>{.iterations = 25, .tolerance = 0, .threshold = 0},
      node<"bar">(RegularGridTopology{.n = {7, 3, 3}, .min = {0, 0, 0}, .max = {3, 1, 1}},
                  MechanicalObject<D>{},
                  UniformMass<D>{.vertexMass = 2.f},
                  RegularGridSpringForceField<D>{
                      .linesStiffness = 1e5, .linesDamping = 10, .cubesStiffness = 4e4, .cubesDamping = 10},
                  FixedConstraint<D>{.indices = held},
                  node<"points">(MechanicalObject<Vec3f>{}, SubsetMapping<D, Vec3f>{.indices = {62, 20}}),
                  node<"skin">(skin, BarycentricMapping<D, Vec3f>{})))};
}
template <class Sim>
void run(Sim& sim, int steps) {
  for (int i = 0; i < steps; ++i) sim.animate(0.02);
}
template <class Sim>
auto& bar(Sim& sim) {
  return *sim.root().find_node("bar")->template get<MechanicalObject<CudaVec3f>>();
}

}  // namespace

TEST_CASE("MultigridLinearSolver of a scene file solves on the device") {
  auto solved = [](std::string const& solver) {
    auto sim = start(parse_scene<Few>("bar.scn", R"(<Node name="root" gravity="0 -9.81 0" dt="0.02">
  <EulerImplicitSolver rayleighStiffness="0.01" rayleighMass="0.1"/>
  )" + solver + R"(
  <Node name="bar">
    <RegularGridTopology n="13 5 5" min="0 0 0" max="3 1 1"/>
    <MechanicalObject template="CudaVec3f"/>
    <UniformMass vertexMass="2"/>
    <RegularGridSpringForceField linesStiffness="1e5" linesDamping="10" cubesStiffness="4e4" cubesDamping="10"/>
    <BoxROI name="held" box="-0.1 -0.1 -0.1  0.1 1.1 1.1"/>
    <FixedConstraint indices="@held.indices"/>
  </Node>
</Node>)"));
    run(sim, 20);
    return sim;
  };
  auto multigrid = solved("<MultigridLinearSolver tolerance=\"1e-6\" coarsestSize=\"60\"/>"),
       gradients = solved("<CGLinearSolver iterations=\"500\" tolerance=\"1e-6\"/>");
  CHECK(multigrid.root().get<MultigridLinearSolver<>>()->onStates);
  CHECK(bar(multigrid).solverWorkspace.multigrid.cycle.levels() > 1);
  double difference = 0, moved = 0;
  for (std::size_t i = 0; i < bar(multigrid).position.size(); ++i) {
    auto const& at = std::as_const(bar(multigrid).position)[i];
    difference = std::max(difference, double((at - std::as_const(bar(gradients).position)[i]).norm()));
    moved = std::max(moved, double((at - std::as_const(bar(multigrid).restPosition)[i]).norm()));
  }
  CHECK(moved > 0.03);
  CHECK(difference < 1e-3 * moved);
}

TEST_CASE("a scene file over CudaVec3f gives the bits of the typed scene, and Vec3f's numbers") {
  auto sim = start(parse_scene<Few>("bar.scn", scene));
  auto device = typed<CudaVec3f>();
  auto host = typed<Vec3f>();
  device.init(), host.init();
  run(sim, 3), run(device, 3), run(host, 3);
  gpu::transfers() = {};
  run(sim, 47);
  CHECK(gpu::transfers().toHost == 47 * 2 * 28);  // of two points, in a step: x, v, and dx of 26 products
  run(device, 47), run(host, 47);
  CHECK(bar(sim).position == device.at<"bar">().state().position);
  CHECK(bar(sim).velocity == device.at<"bar">().state().velocity);
  double maximum = 0;
  for (std::size_t i = 0; i < 63; ++i)
    maximum = std::max(maximum, double((bar(sim).position[i] - host.at<"bar">().state().position[i]).norm()));
  CHECK(maximum < 1e-3);  // of a bar of 3; floats have 7 digits, of which conjugate gradients lose some
  CHECK(maximum > 0);
  sim.updateVisual(), host.updateVisual();
  auto const& skin = sim.root().find_node("bar/skin")->get<VisualModel>()->position;
  for (std::size_t i = 0; i < 2; ++i)
    CHECK((skin[i] - host.at<"bar/skin">().visual().position[i]).norm() < 1e-3f);
}

TEST_CASE("a scene on a device is saved, goes on bit by bit, and is recorded") {
  auto sim = start(parse_scene<Few>("bar.scn", scene));
  run(sim, 5);
  const std::string saved = scene_text(sim, 0.02);
  CHECK_THAT(saved, Catch::Contains("CudaVec3f"));
  auto again = start(parse_scene<Few>("again.scn", saved));
  CHECK(again.step() == 5);
  run(sim, 5), run(again, 5);
  CHECK(bar(sim).position == bar(again).position);
  CHECK(bar(sim).velocity == bar(again).velocity);

  const RecordedFrame frame = capture(sim.root(), sim.step(), sim.time());
  const auto read = parse_record("frames", text("sinew record 1\n", record_text(frame), "end 1\n"));
  REQUIRE(read.size() == 1);
  CHECK(read[0].states[0].dataTypes == "CudaVec3f");
  CHECK(read[0].states[0].positions == frame.states[0].positions);
  CHECK(read[0].states[0].positions.size() == 63 * 3);
}

TEST_CASE("what is not there over the DataTypes of a device says what to do") {
  const auto bad = [](std::string const& line) {
    return text("<Node><MechanicalObject template=\"CudaVec3\" position=\"0 0 0\"/>", line, "</Node>");
  };
  CHECK_THROWS_WITH(parse_scene<Few>("bad.scn", bad("<SubsetMapping/>")), Catch::Contains("has no parent"));
  CHECK_THROWS_WITH(parse_scene<Few>("bad.scn", "<Node><MechanicalObject template=\"CudaVec3d\"/></Node>"),
                    Catch::Contains("is not there over CudaVec3d; it is over CudaVec3f, Vec3f"));
  auto good = parse_scene<Few>("good.scn", bad(""));
  CHECK(good.root.get<MechanicalObject<CudaVec3f>>() != nullptr);
}

}  // namespace test_scene_files
