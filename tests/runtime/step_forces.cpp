// SPDX-License-Identifier: BSL-1.0
// The forces that a step is said to have had are those that changed the momenta: for each body the sum of
// contact forces, weight and reactions over dt is the change of its momentum, whatever the solver and the
// response.

#include "catch.hpp"

#include <sinew/runtime/precompiled.hpp>

#include <map>

namespace test_step_forces {

using namespace sinew;
using Eigen::Vector3d;

namespace {

constexpr double gravity = -9.81;
constexpr std::string_view direct = R"(<SparseLDLSolver template="CompressedRowSparseMatrixMat3x3d"/>)";

std::string pipeline(std::string_view response) {
  return text(R"(
  <DefaultPipeline/> <BruteForceBroadPhase/> <BVHNarrowPhase/>
  <MinProximityIntersection alarmDistance="0.05" contactDistance="0.02"/> <DefaultContactManager response=")",
              response,
              R"("/>)");
}
constexpr std::string_view floorNode = R"(
  <Node name="floor">
    <MeshTopology triangles="0 1 2  0 2 3"/>
    <MechanicalObject position="-5 -5 0  5 -5 0  5 5 0  -5 5 0"/>
    <TriangleCollisionModel moving="false" simulated="false" contactStiffness="40" contactFriction="0.2"/>
  </Node>)";
// 27 points of an elastic block, whose surface follows it; it comes down at a slant
constexpr std::string_view block = R"(
    <Node name="block">
      <RegularGridTopology n="3 3 3" min="-0.2 -0.2 0.04" max="0.2 0.2 0.44"/>
      <MechanicalObject velocity="0.6 0.2 -1"/>
      <UniformMass totalMass="2.7"/>
      <HexahedronFEMForceField youngModulus="3000" poissonRatio="0.3"/>
      <Node name="skin">
        <MeshTopology position="-0.2 -0.2 0.04  0.2 -0.2 0.04  0.2 0.2 0.04  -0.2 0.2 0.04
                                -0.2 -0.2 0.44  0.2 -0.2 0.44  0.2 0.2 0.44  -0.2 0.2 0.44"
                      triangles="0 2 1  0 3 2  4 5 6  4 6 7"/>
        <MechanicalObject/>
        <BarycentricMapping/>
        <TriangleCollisionModel contactStiffness="40" contactFriction="0.1" contactDamping="1"/>
        <PointCollisionModel contactStiffness="40" contactFriction="0.1" contactDamping="1"/>
      </Node>
    </Node>)";
// a rigid ball that falls onto it, on three spheres that follow it
constexpr std::string_view ball = R"(
    <Node name="ball">
      <MechanicalObject template="Rigid3d" position="0.05 0.02 0.58  0 0 0 1" velocity="0 0 -2  0.5 0 3"/>
      <UniformMass vertexMass="1.5 1  0.01 0 0  0 0.01 0  0 0 0.01"/>
      <Node name="skin">
        <MechanicalObject position="0 0 0  0.08 0 0  0 0.08 0"/>
        <RigidMapping/>
        <SphereCollisionModel radius="0.1" contactStiffness="40" contactFriction="0.1" contactDamping="1"/>
      </Node>
    </Node>)";

Simulation<RuntimeNode<Standard>> started(std::string const& content) {
  auto read = parse_scene<Standard>("forces.scn", content);
  Simulation sim{std::move(read.root)};
  sim.init();
  return sim;
}
std::string scene(std::string_view inside) {
  return text("<Node name=\"root\" gravity=\"0 0 ", gravity, "\">", inside, "\n</Node>");
}

// of a body: its momentum, and the sum of contact forces, reactions and weight
struct Body {
  std::string path;
  double mass = 0;
  Vector3d momentum{0, 0, 0}, force{0, 0, 0};
};
constexpr double blockMass = 2.7, ballMass = 1.5;

void look(Simulation<RuntimeNode<Standard>>& sim, Body& body) {
  body.momentum.setZero();
  auto* node = sim.root().find_node(body.path.substr(1));
  REQUIRE(node);
  if (auto* points = node->get<MechanicalObject<Vec3d>>())
    for (auto const& v : points->velocity) body.momentum += body.mass / double(points->size()) * v;
  else
    body.momentum = body.mass * node->get<MechanicalObject<Rigid3d>>()->velocity[0].head<3>();
  body.force = body.mass * Vector3d(0, 0, gravity);
  for (auto const& f : sim.forces())
    if (f.kind != ForceKind::net && f.body.starts_with("/root" + body.path)) body.force += f.wrench.force;
}

// how the momenta of a method follow from the forces of steps of h: dP = old dP of the step before + h (last
// F of the step before + now F)
struct Rule {
  double old = 0, last = 0, now = 1;
};
struct Method {
  std::string ode;
  Rule rule{};
  bool explicitly = false;
};
std::vector<Method> methods() {
  const auto linear = std::string(direct);
  const Rule trapezoid{0, 0.5, 0.5}, newmark{0, 0.3, 0.7}, bdf{1. / 3, 0, 2. / 3};
  return {
      {"<EulerExplicitSolver/>", {}, true},
      {"<EulerExplicitSolver symplectic=\"0\"/>", {}, true},
      {"<CentralDifferenceSolver/>", {}, true},
      {"<RungeKutta2Solver/>", {}, true},
      {"<RungeKutta4Solver/>", {}, true},
      {"<RungeKutta45Solver tolerance=\"1e-7\"/>", {}, true},
      {"<EulerImplicitSolver/>" + linear},
      {"<EulerImplicitSolver rayleighStiffness=\"0.01\"/>" + linear},
      {"<EulerImplicitSolver/> <CGLinearSolver iterations=\"400\" tolerance=\"1e-13\" threshold=\"0\"/>"},
      {"<EulerImplicitSolver trapezoidalScheme=\"1\"/>" + linear},
      {"<EulerImplicitSolver maxNbIterationsNewton=\"30\" relativeInitialStoppingThreshold=\"1e-13\"/>" +
       linear},
      {"<VariationalSymplecticSolver/>" + linear},
      {"<VariationalSymplecticSolver explicitIntegration=\"1\"/>" + linear, {}, true},
      {"<NewmarkImplicitSolver/>" + linear, trapezoid},
      {"<NewmarkImplicitSolver gamma=\"0.7\" beta=\"0.4\" rayleighStiffness=\"0.01\"/>" + linear, newmark},
      {"<BDFOdeSolver order=\"2\"/>" + linear, bdf},
      {"<BDFOdeSolver order=\"1\" maxNbIterationsNewton=\"30\" relativeInitialStoppingThreshold=\"1e-13\"/>" +
       linear}};
}

// what the iterations of Newton's method have left of the impulses of 36 unknown velocities at most: friction
// has no smooth tangent
double unsolved(Simulation<RuntimeNode<Standard>>& sim) {
  double left = 0;
  auto add = [&](auto const* ode) {
    if (ode && !ode->newton.residuals.empty()) left += 6 * ode->newton.residuals.back();
  };
  for (auto const& child : sim.root().children())
    add(child->get<EulerImplicitSolver>()), add(child->get<BDFOdeSolver>());
  return left;
}

// runs and compares; returns the largest contact force on a body that there was
double balance(std::string const& content, std::vector<Body> bodies, Rule rule, double h, int steps,
               double slack) {
  auto sim = started(content);
  sim.keepForces(true);
  struct Last {
    Vector3d change{0, 0, 0}, force{0, 0, 0};
  };
  std::map<std::string, Last> last;  // of the step before
  double maximum = 0;
  for (auto& body : bodies) look(sim, body);
  for (int i = 0; i < steps; ++i) {
    for (auto& body : bodies) {
      const Body before = body;
      if (&body == &bodies[0]) sim.animate(h);
      look(sim, body);
      const Vector3d change = body.momentum - before.momentum, weight(0, 0, gravity * body.mass);
      const bool first = !last.contains(body.path);
      auto& [lastChange, lastForce] = last[body.path];
      Vector3d expected = rule.old * lastChange + h * (rule.last * lastForce + rule.now * body.force);
      if (first && rule.old != 0) expected = h * body.force;
      lastChange = change;
      lastForce = body.force;
      CAPTURE(i, body.path, change.transpose(), expected.transpose());
      // what held and pushed at the start of the first step is not known
      if (!first || rule.last == 0) REQUIRE((change - expected).norm() < slack + unsolved(sim));
      maximum = std::max(maximum, (body.force - weight).norm());
    }
  }
  return maximum;
}

}  // namespace

// the tolerance: what solvers leave of the impulses of a step, some N s, by rounding and by their own
// tolerances of 1e-13

TEST_CASE("contact forces, weight and reactions change the momenta, whatever the solver", "[long]") {
  for (std::string_view response : {"PenalityContactForceField", "StickContactForceField"})
    for (auto const& method : methods()) {
      CAPTURE(response, method.ode);
      const double h = method.explicitly ? 0.0005 : 0.004;
      const double maximum = balance(
          scene(text(
              pipeline(response), floorNode, "<Node name=\"bodies\">", method.ode, block, ball, "</Node>")),
          {{"/bodies/block", blockMass}, {"/bodies/ball", ballMass}},
          method.rule,
          h,
          method.explicitly ? 600 : 100,
          1e-9);
      CHECK(maximum > 10 * ballMass);  // they met, and by more than their weight
    }
}

TEST_CASE("so they do between bodies of different solvers") {
  for (auto const& [first, second] : {std::pair(0, 6), std::pair(6, 4), std::pair(11, 6)}) {
    const auto all = methods();
    CAPTURE(all[std::size_t(first)].ode, all[std::size_t(second)].ode);
    const double maximum = balance(scene(text(pipeline("PenalityContactForceField"),
                                              floorNode,
                                              "<Node name=\"a\">",
                                              all[std::size_t(first)].ode,
                                              block,
                                              "</Node><Node name=\"b\">",
                                              all[std::size_t(second)].ode,
                                              ball,
                                              "</Node>")),
                                   {{"/a/block", blockMass}, {"/b/ball", ballMass}},
                                   {},
                                   0.0005,
                                   600,
                                   1e-9);
    CHECK(maximum > 10 * ballMass);
  }
}

TEST_CASE(
    "reactions of constraints change the momenta with the rest, whatever the solver and the constraint") {
  for (std::string_view constraint :
       {"<FixedConstraint indices=\"0 3 6 9 12 15 18 21 24\"/>",
        "<PartialFixedConstraint indices=\"0 3 6 9 12\" fixedDirections=\"1 0 1\"/>",
        "<FixedPlaneConstraint indices=\"0 1 2 3 4\" direction=\"0.6 0 0.8\"/>",
        "<ProjectToLineConstraint indices=\"0 6 18\" origin=\"0 0 0\" direction=\"1 2 2\"/>",
        "<ProjectToPlaneConstraint indices=\"0 6 18\" origin=\"0 0 0\" normal=\"1 2 2\"/>",
        "<AttachConstraint indices1=\"0 1\" indices2=\"26 25\" twoWay=\"1\"/>"})
    for (auto const& method : methods()) {
      CAPTURE(constraint, method.ode);
      balance(scene(text("<Node name=\"bodies\">",
                         method.ode,
                         "<Node name=\"block\"> <RegularGridTopology n=\"3 3 3\" min=\"-0.2 -0.2 0.04\" "
                         "max=\"0.2 0.2 0.44\"/>"
                         "<MechanicalObject/> <UniformMass totalMass=\"2.7\"/>"
                         "<HexahedronFEMForceField youngModulus=\"3000\" poissonRatio=\"0.3\"/>",
                         constraint,
                         "</Node></Node>")),
              {{"/bodies/block", blockMass}},
              method.rule,
              method.explicitly ? 0.0005 : 0.004,
              30,
              1e-9);
    }
}

TEST_CASE("what is driven is held by what accelerates it") {
  // a point of 2 kg that moves as a sine: F = m a, by the mean acceleration of each step
  for (auto const& method : methods()) {
    CAPTURE(method.ode);
    auto sim =
        started(scene(text("<Node name=\"bodies\">",
                           method.ode,
                           "<MechanicalObject position=\"0 0 0\"/> <UniformMass totalMass=\"2\"/>"
                           "<OscillatorConstraint oscillators=\"0  0 0 0  0.1 0 0  7 0.3\"/></Node>")));
    sim.keepForces(true);
    auto& state = *sim.root().find_node("bodies")->get<MechanicalObject<Vec3d>>();
    const double h = 0.001;
    for (int i = 0; i < 20; ++i) {
      const Vector3d before = state.velocity[0];
      sim.animate(h);
      const Vector3d needed = 2 * ((state.velocity[0] - before) / h - Vector3d(0, 0, gravity));
      REQUIRE((state.reaction[0] - needed).norm() < 1e-9 * needed.norm());
    }
  }
}

TEST_CASE("a statically held body is held by its weight, from the constrained points alone") {
  auto sim = started(scene(text(
      R"(<Node name="bodies"> <StaticSolver maxNbIterationsNewton="30" absoluteResidualStoppingThreshold="1e-11"
      absoluteEstimateDifferenceThreshold="0" relativeEstimateDifferenceThreshold="0" relativeInitialStoppingThreshold="0"/>)",
      direct,
      R"(<RegularGridTopology n="4 3 3" min="0 0 0" max="0.6 0.3 0.3"/> <MechanicalObject/>
      <UniformMass totalMass="3.6"/> <HexahedronFEMForceField youngModulus="20000" poissonRatio="0.3"/>
      <FixedConstraint indices="0 4 8 12 16 20 24 28 32"/></Node>)")));
  sim.keepForces(true);
  sim.animate(0.01);
  auto& state = *sim.root().find_node("bodies")->get<MechanicalObject<Vec3d>>();
  const double weight = -gravity * 3.6;
  const Wrench all = reaction_force(state);
  CHECK((all.force - Vector3d(0, 0, weight)).norm() < 1e-9);
  // the torque about another place
  const Vector3d there(0.3, -0.2, 0.7);
  const std::vector<int> some{0, 4, 8};
  const Wrench here = reaction_force(state, some), other = reaction_force(state, some, there);
  CHECK((here.torque - other.torque - there.cross(here.force)).norm() < 1e-12);
  Vector3d torque(0, 0, 0);
  for (const int i : some) torque += state.position[std::size_t(i)].cross(state.reaction[std::size_t(i)]);
  CHECK(here.torque.norm() > 0.1);
  CHECK((here.torque - torque).norm() < 1e-12);
  int held = 0;
  for (auto const& f : sim.forces()) {
    CHECK(f.kind == ForceKind::reaction);
    CHECK(f.index % 4 == 0);
    ++held;
  }
  CHECK(held == 9);
  const Wrench net = net_force(state);
  CHECK(net.force.norm() < 1e-9);
}

TEST_CASE("the net force and torque on a rigid body are its change of momentum and of angular momentum") {
  // a sphere: its angular momentum is I w in any orientation
  auto sim = started(scene(text(pipeline("PenalityContactForceField"),
                                floorNode,
                                "<Node name=\"bodies\"><EulerImplicitSolver/>",
                                direct,
                                block,
                                ball,
                                "</Node>")));
  sim.keepForces(true);
  auto& state = *sim.root().find_node("bodies/ball")->get<MechanicalObject<Rigid3d>>();
  double turned = 0;
  for (int i = 0; i < 100; ++i) {
    const auto before = state.velocity[0];
    sim.animate(0.004);
    const auto change = Vec6d::Deriv((state.velocity[0] - before) / 0.004);
    const Wrench net = net_force(state, {}, state.position[0].center);
    REQUIRE((net.force - 1.5 * change.head<3>()).norm() < 1e-8);
    REQUIRE((net.torque - 1.5 * 0.01 * change.tail<3>()).norm() < 1e-8);
    turned = std::max(turned, net.torque.norm());
  }
  CHECK(turned > 0.1);
}

TEST_CASE("the force of an impact is that of its momentum") {
  // found within reach of the contact, a ball of 1 kg at 2 m/s: the force at the start of the step knows
  // nothing of it
  auto sim = started(
      scene(text(pipeline("PenalityContactForceField"),
                 floorNode,
                 R"(<Node name="ball"><EulerImplicitSolver/> <CGLinearSolver tolerance="1e-14" threshold="0"/>
      <MechanicalObject position="0 1 0.115" velocity="0 0 -2"/> <UniformMass totalMass="1"/>
      <SphereCollisionModel radius="0.1" contactStiffness="40"/></Node>)")));
  auto& state = *sim.root().find_node("ball")->get<MechanicalObject<Vec3d>>();
  sim.animate(0.01);
  auto const& contacts = sim.root().get<DefaultContactManager>()->contacts;
  REQUIRE(contacts.size() == 1);
  const double impulse = state.velocity[0][2] + 2 - gravity * 0.01;
  CHECK(contacts[0].force.norm() * 0.01 == Approx(impulse).epsilon(1e-9));
  CHECK(impulse > 1);
}

TEST_CASE("forces that nobody asked for are not kept, and say so") {
  auto sim =
      started(scene("<Node name=\"a\"><EulerExplicitSolver/><MechanicalObject position=\"0 0 0\"/>"
                    "<UniformMass totalMass=\"1\"/><FixedConstraint indices=\"0\"/></Node>"));
  sim.animate(0.01);
  auto& state = *sim.root().find_node("a")->get<MechanicalObject<Vec3d>>();
  CHECK(state.reaction.empty());
  CHECK(sim.forces().empty());
  CHECK_THROWS_WITH(reaction_force(state), Catch::Contains("keepForces"));
  sim.keepForces(true);
  sim.animate(0.01);
  CHECK(reaction_force(state).force[2] == Approx(9.81).epsilon(1e-12));
  CHECK_THROWS_WITH(reaction_force(state, std::array{1}), Catch::Contains("no point 1"));
}

}  // namespace test_step_forces
