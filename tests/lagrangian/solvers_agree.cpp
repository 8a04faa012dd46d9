// SPDX-License-Identifier: BSL-1.0
// What constraint solvers have in common in scenes: the same motion with and without a compliance that is
// formed, the multipliers that they give out, and what is said of contacts that nothing can move.
#include "lagrangian/contact_scenes.hpp"

#include <algorithm>
#include <limits>
#include <type_traits>

namespace test_solvers_agree {

using namespace sinew;
using Eigen::Vector3d;

namespace {

constexpr double dt = 0.01;

// two rigid boxes by spheres at their corners on each other and on the floor, thrown along it; a chain of
// points with a link that cannot stretch, that a linear solver answers for, held at its end and at a point by
// a constraint; and a ball with a compliance of its own
template <class Solver, class OfChain, class OfBall>
auto scene_by(Solver const& solver, OfChain const& ofChain, OfBall const& ofBall) {
  auto box = []<FixedString Name>(double z, double speed) {
    std::vector<Vector3d> corners;
    for (int i = 0; i < 8; ++i)
      corners.push_back({i & 1 ? 0.2 : -0.2, i & 2 ? 0.2 : -0.2, i & 4 ? 0.2 : -0.2});
    return node<Name>(
        EulerExplicitSolver{},
        MechanicalObject<Rigid3d>{.position = {{{0, 0, z}, Eigen::Quaterniond::Identity()}},
                                  .velocity = {Rigid3d::Deriv(speed, 0.1, 0, 0, 0, 0.2)}},
        UniformMass<Rigid3d>{.vertexMass = RigidMass<double, 3>{3, 0.1 * Eigen::Matrix3d::Identity()}},
        node<"skin">(MechanicalObject<Vec3d>{.position = corners},
                     RigidMapping<Rigid3d, Vec3d>{},
                     SphereCollisionModel<Vec3d>{.radius = 0.05}));
  };
  MeshTopology link;
  link.edges = {{2, 3}};
  return constrained_scene_by(
      solver,
      near_by(),
      0.4,
      fixed_floor(),
      box.template operator()<"lower">(0.262, 1),
      box.template operator()<"upper">(0.774, 0.5),
      node<"chain">(EulerImplicitSolver{},
                    SparseLDLSolver<>{},
                    link,
                    MechanicalObject<Vec3d>{.position = {{2, 0, 1}, {2.3, 0, 1}, {2.6, 0, 1}, {2.9, 0, 1}}},
                    UniformMass<Vec3d>{.vertexMass = 0.2},
                    StiffSpringForceField<Vec3d>{.springs = {{0, 1, 100, 0.1, 0.3}, {1, 2, 100, 0.1, 0.3}}},
                    FixedConstraint<Vec3d>{.indices = {0}},
                    FixedLagrangianConstraint<Vec3d>{.indices = {1}},
                    ofChain,
                    node<"length">(MechanicalObject<Vec1d>{},
                                   DistanceMapping<Vec3d, Vec1d>{},
                                   UniformLagrangianConstraint<Vec1d>{})),
      node<"ball">(EulerImplicitSolver{},
                   CGLinearSolver<>{.iterations = 50, .tolerance = 1e-14},
                   MechanicalObject<Vec3d>{.position = {{-1, 0, 0.12}}, .velocity = {{0.3, 0, -0.5}}},
                   UniformMass<Vec3d>{.vertexMass = 0.7},
                   SphereCollisionModel<Vec3d>{.radius = 0.1},
                   ofBall));
}

template <class Solver>
Solver exact() {
  if constexpr (std::is_same_v<Solver, ConvexConstraintSolver>)
    return {.tolerance = 1e-12, .momentumTolerance = 1e-12, .maxUpdates = 500, .maxIterations = 100000};
  else
    return {.maxIterations = 100000, .tolerance = 1e-14};
}
std::vector<double> numbers_of(StandardSimulation& sim) {
  std::vector<double> all;
  for (std::string_view const name : {"lower", "upper"}) {
    auto const& x = sim.root().find_node(name)->template get<MechanicalObject<Rigid3d>>()->position[0];
    for (int i = 0; i < 3; ++i) all.push_back(x.center[i]);
    for (int i = 0; i < 4; ++i) all.push_back(x.orientation.coeffs()[i]);
  }
  for (std::string_view const name : {"chain", "ball"})
    for (auto const& x : sim.root().find_node(name)->template get<MechanicalObject<Vec3d>>()->position)
      for (int i = 0; i < 3; ++i) all.push_back(x[i]);
  return all;
}

}  // namespace

TEST_CASE("UnbuiltGaussSeidelConstraintSolver: scenes move as with a compliance that is formed", "[long]") {
  for (const double regularization : {0., 1e-4}) {
    const LinearSolverConstraintCorrection ofChain{.regularizationTerm = regularization};
    const UncoupledConstraintCorrection<Vec3d> ofBall{.defaultCompliance = 1 / 0.7};
    auto built = scene_by(exact<BlockGaussSeidelConstraintSolver>(), ofChain, ofBall);
    auto unbuilt = scene_by(exact<UnbuiltGaussSeidelConstraintSolver>(), ofChain, ofBall);
    built.init();
    unbuilt.init();
    const auto start = numbers_of(built);
    std::size_t contacts = 0;
    for (int i = 0; i < 60; ++i) {
      built.animate(dt);
      unbuilt.animate(dt);
      contacts = std::max(contacts, unbuilt.root().template get<DefaultContactManager>().contacts.size());
    }
    const auto a = numbers_of(built), b = numbers_of(unbuilt);
    double most = 0, moved = 0;
    for (std::size_t i = 0; i < a.size(); ++i) {
      most = std::max(most, std::abs(a[i] - b[i]));
      moved = std::max(moved, std::abs(a[i] - start[i]));
    }
    CHECK(most < 1e-9);
    CHECK(moved > 0.1);
    CHECK(contacts >= 9);
  }
}

TEST_CASE("LCPConstraintSolver: build_lcp changes nothing of the motion", "[long]") {
  const LinearSolverConstraintCorrection ofChain{};
  const UncoupledConstraintCorrection<Vec3d> ofBall{.defaultCompliance = 1 / 0.7};
  LCPConstraintSolver solver = exact<LCPConstraintSolver>();
  auto built = scene_by(solver, ofChain, ofBall);
  solver.build_lcp = false;
  auto unbuilt = scene_by(solver, ofChain, ofBall);
  built.init();
  unbuilt.init();
  for (int i = 0; i < 40; ++i) {
    built.animate(dt);
    unbuilt.animate(dt);
  }
  const auto a = numbers_of(built), b = numbers_of(unbuilt);
  for (std::size_t i = 0; i < a.size(); ++i) CHECK(a[i] == Approx(b[i]).margin(1e-9));
}

TEST_CASE("constraint solvers give out the multipliers of constraints and contacts in their order",
          "[long]") {
  auto look = []<class Solver>(std::type_identity<Solver>) {
    INFO(Solver::className);
    Solver solver = exact<Solver>();
    solver.computeConstraintForces = true;
    if constexpr (requires { solver.mu; }) solver.mu = 0.4;
    auto sim = scene_by(solver, Gravity{{0, 0, -g}}, Gravity{{0, 0, -g}});  // without corrections
    sim.init();
    for (int i = 0; i < 30; ++i) sim.animate(dt);
    auto const& f = sim.root().template get<Solver>().constraintForces;
    auto chain = sim.template at<"chain">();
    std::vector<double> expected = chain.template get<FixedLagrangianConstraint<Vec3d>>().multipliers;
    CHECK(expected.size() == 3);
    for (const double one :
         sim.template at<"chain/length">().template get<UniformLagrangianConstraint<Vec1d>>().multipliers)
      expected.push_back(one);
    CHECK(expected.size() == 4);
    for (Contact const& c : sim.root().template get<DefaultContactManager>().contacts) {
      const Eigen::Matrix3d axes = contact_axes(c.normal);
      for (int i = 0; i < 3; ++i) expected.push_back(axes.col(i).dot(c.force));
    }
    REQUIRE(f.size() == expected.size());
    CHECK(f.size() >= 4 + 3 * 9);
    double largest = 0;
    for (std::size_t i = 0; i < f.size(); ++i) {
      CHECK(f[i] == Approx(expected[i]).margin(1e-9));
      largest = std::max(largest, std::abs(f[i]));
    }
    CHECK(largest > 1);
    sim.reset();
    CHECK(sim.root().template get<Solver>().constraintForces.empty());
  };
  look(std::type_identity<BlockGaussSeidelConstraintSolver>{});
  look(std::type_identity<UnbuiltGaussSeidelConstraintSolver>{});
  look(std::type_identity<NNCGConstraintSolver>{});
  look(std::type_identity<LCPConstraintSolver>{});
  look(std::type_identity<ConvexConstraintSolver>{});
}

TEST_CASE("a contact of points that are fixed on both sides is told, and has no force") {
  auto look = [](auto solver) {
    auto ball = []<FixedString Name>(double x, std::vector<int> const& fixed) {
      return node<Name>(EulerImplicitSolver{},
                        SparseLDLSolver<>{},
                        MechanicalObject<Vec3d>{.position = {{x, 0, 5}}},
                        UniformMass<Vec3d>{.vertexMass = 1},
                        FixedConstraint<Vec3d>{.indices = fixed},
                        SphereCollisionModel<Vec3d>{.radius = 0.1});
    };
    auto sim = constrained_scene_by(solver,
                                    near_by(),
                                    0.4,
                                    ball.template operator()<"a">(0, {0}),
                                    ball.template operator()<"b">(0.2, {0}),
                                    ball.template operator()<"c">(2, {}));
    sim.init();
    for (int i = 0; i < 3; ++i) sim.animate(dt);
    for (Contact const& c : sim.root().template get<DefaultContactManager>().contacts)
      CHECK(c.force.norm() == 0);
    auto const& warnings = sim.warnings().list();
    REQUIRE(warnings.size() == 1);
    CHECK(warnings[0].count == 3);
    CHECK(warnings[0].where == "the contact of /root/a and /root/b");
    CHECK_THAT(warnings[0].message, Catch::Contains("nothing that touches there can move"));
    CHECK(sim.template at<"c">().state().position[0][2] < 5);
  };
  look(exact<BlockGaussSeidelConstraintSolver>());
  look(exact<UnbuiltGaussSeidelConstraintSolver>());
  look(exact<ConvexConstraintSolver>());
}

}  // namespace test_solvers_agree
