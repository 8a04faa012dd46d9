// SPDX-License-Identifier: BSL-1.0
// Timers of a runtime tree: the counts of the same scene composed by the compiler, through changes of the
// scene.
#include "catch.hpp"
#include "scene/profile_lines.hpp"

#include <sinew/context/gravity.hpp>
#include <sinew/force/stiff_spring.hpp>
#include <sinew/mass/uniform_mass.hpp>
#include <sinew/runtime/checks.hpp>
#include <sinew/runtime/scope.hpp>
#include <sinew/scene/profiled.hpp>
#include <sinew/scene/simulation.hpp>
#include <sinew/solver/cg_linear_solver.hpp>
#include <sinew/solver/euler_implicit.hpp>
#include <sinew/state/mechanical_object.hpp>

namespace test_profile {

using namespace sinew;

namespace {

struct Few : Registry<Gravity, MechanicalObject<Vec3d>, UniformMass<Vec3d>, StiffSpringForceField<Vec3d>,
                      EulerImplicitSolver, CGLinearSolver<>> {};

const MechanicalObject<Vec3d> points{.position = {{0, 0, 0}, {1, 0, 0}, {2, 0.1, 0}}};
const StiffSpringForceField<Vec3d> springs{{{0, 1, 100, 0.1, 1}, {1, 2, 100, 0.1, 1}}};
const CGLinearSolver<> cg{.iterations = 2, .tolerance = 0};

void fill(RuntimeNode<Few>& chain) {
  chain.add(points, "dofs");
  chain.add(UniformMass<Vec3d>{}, "mass");
  chain.add(springs, "springs");
}

}  // namespace

TEST_CASE("a runtime tree is timed while it has a profile") {
  RuntimeNode<Few> root("root");
  root.add(Gravity{{0, -10, 0}}, "gravity");
  root.add(EulerImplicitSolver{}, "ode");
  root.add(cg, "cg");
  fill(root.addChild("chain"));
  Simulation sim{std::move(root)};
  sim.init();
  Profile profile;
  sim.animate(0.01);
  CHECK(profile.rowCount() == 1);
  sim.root().profileWith(&profile);
  for (int i = 0; i < 3; ++i) sim.animate(0.01);
  const std::string
      force = "step/ode EulerImplicitSolver/force",
      product = "step/ode EulerImplicitSolver/cg CGLinearSolver<GraphScattered>/product with the matrix";
  const std::string springsCalled = "/chain/springs StiffSpringForceField<Vec3d>";
  auto lines = lines_of(profile);
  CHECK(lines.at("step").calls == 3);
  CHECK(lines.at(force + springsCalled).calls == 3);
  CHECK(lines.at(product).calls == 6);
  CHECK(lines.at(product + springsCalled).calls == 6);

  SECTION("the counts are those of the scene composed by the compiler") {
    Simulation typed{profiled(node<"root">(Gravity{{0, -10, 0}},
                                           EulerImplicitSolver{},
                                           cg,
                                           node<"chain">(points, UniformMass<Vec3d>{}, springs)))};
    typed.init();
    for (int i = 0; i < 3; ++i) typed.animate(0.01);
    auto counts = [](Profile const& p) {
      std::vector<std::tuple<int, std::string, long>> all;
      for (auto const& line : profile_lines(p))
        all.emplace_back(line.depth, line.isPhase ? line.name : line.className, line.calls);
      return all;
    };
    // from the first step on, too
    Profile again;
    sim.reset();
    sim.root().profileWith(&again);
    for (int i = 0; i < 3; ++i) sim.animate(0.01);
    CHECK(counts(typed.root().profile()) == counts(again));
    sim.root().profileWith(nullptr);
  }
  SECTION("lines go on when the scene changes, and what is new has its own") {
    sim.change([](auto& top) { fill(top.addChild("second")); });
    sim.animate(0.01);
    lines = lines_of(profile);
    CHECK(lines.at(force + springsCalled).calls == 4);
    CHECK(lines.at(force + "/second/springs StiffSpringForceField<Vec3d>").calls == 1);
  }
  SECTION("a copy is not timed") {
    auto copy = sim;
    copy.animate(0.01);
    CHECK(profile.calls(Phase::step) == 3);
  }
  SECTION("the profile is taken off") {
    sim.root().profileWith(nullptr);
    sim.animate(0.01);
    CHECK(profile.calls(Phase::step) == 3);
  }
}

TEST_CASE("a runtime place in a typed scene that is profiled") {
  RuntimePlace<"chain", Few> place;
  fill(place);
  Simulation sim{profiled(node<"root">(EulerImplicitSolver{}, cg, place))};
  sim.init();
  for (int i = 0; i < 3; ++i) sim.animate(0.01);
  CHECK(lines_of(sim.root().profile())
            .at("step/root EulerImplicitSolver/force/chain/springs StiffSpringForceField<Vec3d>")
            .calls == 3);
}

}  // namespace test_profile
