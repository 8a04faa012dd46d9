// SPDX-License-Identifier: BSL-1.0
// Constraints by multipliers in scene files: their attributes, ends and checkpoints.
#include <sinew/constraint/fixed_constraint.hpp>
#include <sinew/context/gravity.hpp>
#include <sinew/core/registry.hpp>
#include <sinew/force/constant_force.hpp>
#include <sinew/lagrangian.hpp>
#include <sinew/mapping/distance_mapping.hpp>
#include <sinew/mapping/rigid_mapping.hpp>
#include <sinew/mass/uniform_mass.hpp>
#include <sinew/runtime/bake.hpp>
#include <sinew/runtime/precompiled.hpp>
#include <sinew/runtime/read_scene.hpp>
#include <sinew/runtime/runtime.hpp>
#include <sinew/runtime/save_scene.hpp>
#include <sinew/solver/euler_explicit.hpp>
#include <sinew/solver/euler_implicit.hpp>
#include <sinew/solver/sparse_ldl_solver.hpp>
#include <sinew/state/mechanical_object.hpp>
#include <sinew/topology/mesh_topology.hpp>

#include "catch.hpp"

#include <cmath>

namespace test_lagrangian_constraints {

using namespace sinew;

namespace {

using Mine = Standard;

// each constraint once; what moves is in nodes of its own
const std::string xml = R"(<Node name="root" gravity="0 -10 0" dt="0.01">
  <FreeMotionAnimationLoop/>
  <BlockGaussSeidelConstraintSolver tolerance="1e-13" maxIterations="5000"/>
  <Node name="chain">
    <EulerImplicitSolver/><SparseLDLSolver/>
    <MeshTopology edges="0 1  1 2  2 3"/>
    <MechanicalObject template="Vec3d" position="0 0 0  1 0 0  2 0 0  3 0 0"/>
    <UniformMass totalMass="4"/>
    <FixedConstraint indices="0"/>
    <Node name="edges">
      <MechanicalObject template="Vec1d"/>
      <DistanceMapping/>
      <UniformLagrangianConstraint iterative="false"/>
    </Node>
  </Node>
  <Node name="cart">
    <EulerExplicitSolver/>
    <MechanicalObject template="Vec1d" position="0" velocity="3"/>
    <UniformMass totalMass="1"/>
    <StopperLagrangianConstraint index="0" min="-1" max="0.5"/>
  </Node>
  <Node name="rail"><MechanicalObject template="Vec3d" position="0 0 0  4 -3 0"/></Node>
  <Node name="bead">
    <EulerExplicitSolver/>
    <MechanicalObject template="Vec3d" position="0 0 0"/>
    <UniformMass totalMass="2"/>
  </Node>
  <SlidingLagrangianConstraint object1="@bead" object2="@rail" sliding_point="0" axis_1="0" axis_2="1"/>
  <Node name="ground"><MechanicalObject template="Vec3d" position="0 0 0"/></Node>
  <Node name="hard">
    <EulerExplicitSolver/>
    <MechanicalObject template="Vec3d" position="0 0.1 0"/>
    <UniformMass totalMass="2"/>
  </Node>
  <UnilateralLagrangianConstraint object1="@ground" object2="@hard" first_point="0" second_point="0"
                                  normal="0 1 0" mu="0.2"/>
  <Node name="soft">
    <EulerExplicitSolver/>
    <MechanicalObject template="Vec3d" position="0 0 0"/>
    <UniformMass totalMass="2"/>
  </Node>
  <AugmentedLagrangianConstraint object1="@ground" object2="@soft" first_point="0" second_point="0"
                                 normal="0 1 0" compliance="1e-3" damping="200"/>
  <Node name="first">
    <EulerImplicitSolver/><SparseLDLSolver/>
    <MechanicalObject template="Rigid3d" position="0 0 0  0.6 0 0 0.8"/>
    <UniformMass totalMass="2"/>
    <Node name="arm"><MechanicalObject template="Vec3d" position="0 0.5 0"/><RigidMapping/></Node>
  </Node>
  <Node name="second">
    <EulerExplicitSolver/>
    <MechanicalObject template="Rigid3d" position="1 2 3  0 0 0 1" velocity="0 0 0  1 -2 0.5"/>
    <UniformMass totalMass="3"/>
  </Node>
  <BilateralLagrangianConstraint template="Rigid3d" object1="@first" object2="@second" first_point="0"
                                 second_point="0" keepOrientationDifference="true"/>
  <BilateralLagrangianConstraint template="Vec3d" object1="@ground" object2="@first/arm" first_point="0"
                                 second_point="0" rest_vector="0 0.14 0.48" load="0.5"/>
</Node>)";

// the same by the convex solver, but for the cart, whose points are on a line
std::string by_convex_steps() {
  std::string text = xml;
  const auto cart = text.find("  <Node name=\"cart\">"), end = text.find("  <Node name=\"rail\">");
  text.erase(cart, end - cart);
  const auto solver = text.find("  <BlockGaussSeidel"), next = text.find("  <Node name=\"chain\">");
  return text.replace(solver, next - solver, "  <ConvexConstraintSolver tolerance=\"1e-9\"/>\n");
}

using Scene = Simulation<RuntimeNode<Mine>>;
Scene started(std::string const& text) {
  auto read = parse_scene<Mine>("constraints.scn", text);
  Scene sim{read.root};
  sim.init(read.time, read.step);
  return sim;
}
template <class D>
auto& state(Scene& sim, std::string_view node) {
  return *sim.root().find_node(node)->template get<MechanicalObject<D>>();
}
// all that moves
std::vector<double> motion(Scene& sim) {
  std::vector<double> all;
  auto add = [&](auto const& s) {
    for (auto const& v : s.velocity) all.insert(all.end(), v.begin(), v.end());
    for (auto const& x : s.position)
      if constexpr (requires { x.center; }) {
        all.insert(all.end(), x.center.begin(), x.center.end());
        all.insert(all.end(), x.orientation.coeffs().begin(), x.orientation.coeffs().end());
      } else {
        all.insert(all.end(), x.begin(), x.end());
      }
  };
  for (auto name : {"chain", "bead", "hard", "soft", "first/arm"}) add(state<Vec3d>(sim, name));
  for (auto name : {"first", "second"}) add(state<Rigid3d>(sim, name));
  add(state<Vec1d>(sim, "chain/edges"));
  if (sim.root().find_node("cart")) add(state<Vec1d>(sim, "cart"));
  return all;
}
void run(Scene& sim, int steps) {
  for (int i = 0; i < steps; ++i) sim.animate(0.01);
}

}  // namespace

TEST_CASE("each constraint of a scene file holds") {
  Scene sim = started(xml);
  run(sim, 60);
  for (auto const& c : state<Vec1d>(sim, "chain/edges").position) CHECK(std::abs(c[0]) < 0.01);
  CHECK(state<Vec3d>(sim, "chain").position[3][1] < -1);
  CHECK(state<Vec1d>(sim, "cart").position[0][0] == Approx(0.5));
  auto const& bead = state<Vec3d>(sim, "bead").position[0];
  CHECK((bead - Eigen::Vector3d(4, -3, 0) / 5 * bead.norm()).norm() < 1e-10);
  CHECK(bead.norm() == Approx(10 * 0.6 * 0.6 * 0.61 / 2));
  CHECK(state<Vec3d>(sim, "hard").position[0].norm() < 1e-12);
  CHECK(state<Vec3d>(sim, "soft").position[0][1] == Approx(-0.02).epsilon(0.05));
  auto const &a = state<Rigid3d>(sim, "first").position[0], &b = state<Rigid3d>(sim, "second").position[0];
  CHECK((b.center - a.center - Eigen::Vector3d(1, 2, 3)).norm() < 1e-9);
  const Eigen::Quaterniond relative = a.orientation.conjugate() * b.orientation;
  CHECK((relative.coeffs() - Eigen::Vector4d(-0.6, 0, 0, 0.8)).norm() < 1e-9);
}

TEST_CASE("a scene goes on from its checkpoint, and from its start, with the same bits") {
  for (auto const& text : {xml, by_convex_steps()}) {
    Scene sim = started(text);
    run(sim, 20);
    const auto early = motion(sim);
    const std::string saved = scene_text(sim, 0.01);
    Scene again = started(saved);
    CHECK(motion(again) == early);
    run(sim, 20);
    run(again, 20);
    const auto late = motion(sim);
    CHECK(motion(again) == late);
    sim.reset();
    run(sim, 20);
    CHECK(motion(sim) == early);
    run(sim, 20);
    CHECK(motion(sim) == late);
  }
}

TEST_CASE("constraints are baked between the nodes that they join") {
  const std::string cpp = bake_text(parse_scene<Mine>("constraints.scn", xml), "constraints.scn", {});
  for (auto const* joined : {R"(SlidingLagrangianConstraint<Vec3d, Between<"bead", "rail">>)",
                             R"(UnilateralLagrangianConstraint<Vec3d, Between<"ground", "hard">>)",
                             R"(AugmentedLagrangianConstraint<Vec3d, Between<"ground", "soft">>)",
                             R"(BilateralLagrangianConstraint<Rigid3d, Between<"first", "second">>)",
                             R"(BilateralLagrangianConstraint<Vec3d, Between<"ground", "first/arm">>)",
                             "UniformLagrangianConstraint<Vec1d>"})
    CHECK_THAT(cpp, Catch::Contains(joined));
}

TEST_CASE("of several components of a class in a node messages say the name, or the place") {
  // rods of 1, 1, 2 and 3 m between two points
  auto rods = [](std::string const& last, std::string const& second = "") {
    auto rod = [](std::string const& attributes, int length) {
      return "<BilateralLagrangianConstraint first_point='0' second_point='1' rest_vector='" +
             std::to_string(length) + " 0 0' " + attributes + "/>";
    };
    return "<Node><FreeMotionAnimationLoop/><BlockGaussSeidelConstraintSolver maxIterations='10'/>"
           "<Node name='rods'><EulerExplicitSolver/><MechanicalObject position='0 0 0  1 0 "
           "0'/><UniformMass/>" +
           rod("name='good'", 1) + rod(second, 1) + rod("name='twice'", 2) + rod(last, 3) + "</Node></Node>";
  };
  auto warning = [](std::string const& text) {
    Scene sim = started(text);
    sim.animate(0.01);
    REQUIRE(sim.warnings().list().size() == 1);
    return sim.warnings().list()[0].message;
  };
  const std::string rod = "equation 0 of /root/rods: BilateralLagrangianConstraint<Vec3d> ";
  CHECK_THAT(warning(rods("name='long'")),
             Catch::Contains(rod + "'long' contradicts other equalities by 2 m"));
  // no name, that of the class or another one of it, or the same as before
  for (std::string const name :
       {"", "name='BilateralLagrangianConstraint'", "name='BilateralInteractionConstraint'", "name='twice'"})
    CHECK_THAT(warning(rods(name)), Catch::Contains(rod + "(4 of 4) contradicts other equalities by 2 m"));
  // an error at init
  auto wrong = parse_scene<Mine>("rods.scn", rods("", "name='second'"));
  wrong.root.children()[0]
      ->components()[4]
      .component.getIf<BilateralLagrangianConstraint<Vec3d>>()
      ->first_point = {7};
  Simulation sim{std::move(wrong.root)};
  CHECK_THROWS_WITH(
      sim.init(),
      Catch::Contains("rods.scn:1:") &&
          Catch::Contains("/root/rods: BilateralLagrangianConstraint<Vec3d> 'second': first_point"));
}

}  // namespace test_lagrangian_constraints
