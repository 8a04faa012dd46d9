// SPDX-License-Identifier: BSL-1.0
// Timers of a typed scene: what is counted, and that times fit into each other.
#include "catch.hpp"
#include "profile_lines.hpp"

#include <sinew/constraint/fixed_constraint.hpp>
#include <sinew/context/gravity.hpp>
#include <sinew/force/stiff_spring.hpp>
#include <sinew/mapping/subset_mapping.hpp>
#include <sinew/mass/uniform_mass.hpp>
#include <sinew/scene/profiled.hpp>
#include <sinew/scene/simulation.hpp>
#include <sinew/solver/cg_linear_solver.hpp>
#include <sinew/solver/euler_implicit.hpp>
#include <sinew/state/mechanical_object.hpp>

namespace test_profile {

using namespace sinew;

namespace {

constexpr int steps = 7, iterations = 3;

auto chain() {
  return node<"root">(
      Gravity{{0, -10, 0}},
      EulerImplicitSolver{},
      CGLinearSolver<>{.iterations = iterations, .tolerance = 0},
      node<"chain">(
          MechanicalObject<Vec3d>{.position = {{0, 0, 0}, {1, 0, 0}, {2, 0.1, 0}, {3, 0, 0.2}}},
          UniformMass<Vec3d>{},
          StiffSpringForceField<Vec3d>{{{0, 1, 100, 0.1, 1}, {1, 2, 100, 0.1, 1}}},
          StiffSpringForceField<Vec3d>{{{2, 3, 200, 0.1, 1}}},
          FixedConstraint<Vec3d>{.indices = {0}},
          node<"end">(
              MechanicalObject<Vec3d>{}, SubsetMapping<Vec3d, Vec3d>{.indices = {3}}, UniformMass<Vec3d>{})));
}

}  // namespace

TEST_CASE("a profile counts the calls of phases and components, and their times fit into each other") {
  Simulation sim{profiled(chain(), Profile(2000))};
  Profile const& profile = sim.root().profile();
  sim.init();
  sim.kineticEnergy();
  CHECK(profile.rowCount() == 1);  // nothing but steps is counted
  for (int i = 0; i < steps; ++i) sim.animate(0.01);

  const auto lines = lines_of(profile);
  const std::string ode = "step/root EulerImplicitSolver",
                    linear = ode + "/root CGLinearSolver<GraphScattered>";
  auto calls = [&](std::string const& line) {
    INFO(line);
    REQUIRE(lines.contains(line));
    return lines.at(line).calls;
  };
  CHECK(calls("step") == steps);
  CHECK(calls(ode) == steps);
  for (char const* inForce : {"",
                              "/chain UniformMass<Vec3d>",
                              "/chain StiffSpringForceField<Vec3d>",
                              "/chain StiffSpringForceField<Vec3d>'",
                              "/chain/end UniformMass<Vec3d>",
                              "/mapping of forces/chain/end SubsetMapping<Vec3d, Vec3d>"})
    CHECK(calls(ode + "/force" + inForce) == steps);
  CHECK(calls(linear) == steps);
  // 3 iterations for 3 free points with 3 components are all done
  CHECK(calls(linear + "/product with the matrix") == steps * iterations);
  CHECK(calls(linear + "/iteration") == steps * iterations);
  CHECK(calls(linear + "/product with the matrix/chain StiffSpringForceField<Vec3d>'") == steps * iterations);
  CHECK(calls(linear + "/constraint/chain FixedConstraint<Vec3d>") == steps * iterations);
  CHECK(profile.calls(Phase::product) == steps * (iterations + 1));  // one for the damping
  CHECK(calls("step/end of the step/chain MechanicalObject<Vec3d>") == steps);
  CHECK(profile.leftOut() == 0);

  // what is inside takes no longer than what is around it
  CHECK(lines.at("step").seconds > 0);
  for (auto const& [name, line] : lines) {
    INFO(name);
    CHECK(line.own >= 0);
    CHECK(line.seconds >= line.own);
  }
  // events begin one after the other, and each ends within the one around it
  long events = 0;
  for (auto const& [name, line] : lines)
    if (line.name != "iteration") events += line.calls;
  REQUIRE(long(profile.eventCount()) + profile.eventsLeftOut() == events);
  std::vector<Profile::Event> open;
  for (std::size_t i = 0; i < profile.eventCount(); ++i) {
    auto const& event = profile.event(i);
    if (i > 0) CHECK(event.begin >= profile.event(i - 1).begin);
    CHECK(event.end >= event.begin);
    while (!open.empty() && profile.row(event.row).parent != open.back().row) open.pop_back();
    if (open.empty()) CHECK(profile.row(event.row).parent == 0);
    if (!open.empty()) CHECK(event.end <= open.back().end);
    open.push_back(event);
  }

  SECTION("the profile changes nothing") {
    Simulation plain{chain()};
    plain.init();
    for (int i = 0; i < steps; ++i) plain.animate(0.01);
    CHECK(plain.at<"chain">().state().position == sim.at<"chain">().state().position);
  }
  SECTION("a copy has a profile of its own") {
    auto copy = sim;
    copy.animate(0.01);
    CHECK(copy.root().profile().calls(Phase::step) == steps + 1);
    CHECK(profile.calls(Phase::step) == steps);
    CHECK(copy.root().profile().rowCount() == profile.rowCount());
  }
  SECTION("a table and a trace") {
    const std::string table = profile_table(profile, 0);
    CHECK(std::count(table.begin(), table.end(), '\n') == 1 + long(lines.size()));
    const std::string trace = profile_trace(profile, "a \"chain\"\n");
    CHECK(trace.find(
              R"({"name":"process_name","ph":"M","pid":1,"tid":1,"args":{"name":"a \"chain\"\u000a"}})") !=
          trace.npos);
    std::size_t written = 0;
    for (std::size_t at = 0; (at = trace.find("\"ph\":\"X\"", at)) != trace.npos; ++at) ++written;
    CHECK(written == profile.eventCount());
  }
  SECTION("it starts again") {
    sim.root().profile().clear();
    sim.animate(0.01);
    CHECK(profile.calls(Phase::step) == 1);
  }
}

TEST_CASE("what has no room in a profile is counted") {
  Simulation sim{profiled(chain(), Profile(10, 5))};
  sim.init();
  sim.animate(0.01);
  Profile const& profile = sim.root().profile();
  CHECK(profile.rowCount() == 1 + 5);
  CHECK(profile.leftOut() > 0);
  const long events = long(profile.eventCount()), first = profile.leftOut();
  CHECK(events < 10);
  sim.animate(0.01);
  const long second = profile.leftOut();
  CHECK(second > first);
  sim.animate(0.01);
  CHECK(profile.eventCount() == 10);
  CHECK(profile.eventsLeftOut() == 3 * events - 10);
  CHECK(profile.leftOut() - second == second - first);
  CHECK_THAT(profile_table(profile), Catch::Matchers::Contains("had no room for a line of their own"));
}

TEST_CASE("an error in a step leaves no timer running") {
  auto root = chain();
  root.child<"chain">().state().velocity.assign(4, {1e300, 0, 0});
  Simulation sim{profiled(std::move(root))};
  sim.init();
  CHECK_THROWS_AS(sim.animate(1e300), Error);
  sim.reset();
  sim.updateVisual();
  auto const lines = lines_of(sim.root().profile());
  CHECK(lines.at("step").calls == 1);
  CHECK(lines.contains("visual"));
}

}  // namespace test_profile
