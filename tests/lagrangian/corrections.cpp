// SPDX-License-Identifier: BSL-1.0
// What bodies answer to multipliers: by their solver, with a factor or without, or by compliances of their
// own.
#include "catch.hpp"

#include <sinew/lagrangian.hpp>
#include <sinew/mechanics.hpp>

namespace test_corrections {

using namespace sinew;

namespace {

constexpr double dt = 0.01;

// a string of springs between two points that multipliers hold, one of them moved by a rest position of its
// own; the second point of it is held by a projective constraint too
template <class Linear, class... Correction>
auto string_of(Linear linear, Correction... correction) {
  constexpr int n = 12;
  MechanicalObject<Vec3d> state;
  StiffSpringForceField<Vec3d> springs;
  for (int i = 0; i < n; ++i) {
    state.position.push_back({0.1 * i, 0.02 * (i % 3), 0});
    if (i > 0) springs.springs.push_back({i - 1, i, 500, 1, 0.1});
  }
  return Simulation{node<"root">(FreeMotionAnimationLoop{},
                                 BlockGaussSeidelConstraintSolver{.maxIterations = 10000, .tolerance = 1e-15},
                                 Gravity{{0, -10, 0}},
                                 node<"string">(EulerImplicitSolver{.rayleighStiffness = 0.01},
                                                linear,
                                                state,
                                                UniformMass<Vec3d>{.totalMass = 1.2},
                                                springs,
                                                PartialFixedConstraint<Vec3d>{.indices = {1}},
                                                FixedLagrangianConstraint<Vec3d>{.indices = {0, 5, n - 1}},
                                                correction...))};
}
template <class Sim>
auto run(Sim sim) {
  sim.init();
  for (int i = 0; i < 20; ++i) sim.animate(dt);
  return sim.template at<"string">().state().position;
}

double apart(Vec3d::VecCoord const& a, Vec3d::VecCoord const& b) {
  double worst = 0;
  for (std::size_t i = 0; i < a.size(); ++i) worst = std::max(worst, (a[i] - b[i]).norm());
  return worst;
}

}  // namespace

TEST_CASE("a body answers alike, whichever linear solver says how") {
  const auto factor = run(string_of(SparseLDLSolver<>{}));
  CHECK(apart(factor, run(string_of(CGLinearSolver<>{.iterations = 500, .tolerance = 1e-15}))) < 1e-10);
  CHECK(apart(factor, run(string_of(SparseLDLSolver<CompressedRowSparseMatrixd>{}))) < 1e-10);
  CHECK(apart(factor, run(string_of(CholeskySolver<>{}))) < 1e-10);
  CHECK(apart(factor, run(string_of(SparseLDLSolver<>{}, LinearSolverConstraintCorrection{}))) == 0);
}

TEST_CASE("points that answer alone do what their compliance says") {
  // a heavy and a light point, joined: the impulse moves each by its compliance
  Simulation sim{node<"root">(
      FreeMotionAnimationLoop{},
      BlockGaussSeidelConstraintSolver{.maxIterations = 10000, .tolerance = 1e-15},
      BilateralLagrangianConstraint<Vec3d, Between<"a", "b">>{.first_point = {0}, .second_point = {0}},
      node<"a">(EulerExplicitSolver{},
                MechanicalObject<Vec3d>{.position = {{0, 0, 0}, {5, 0, 0}}},
                UniformMass<Vec3d>{.totalMass = 2},
                UncoupledConstraintCorrection<Vec3d>{.compliance = {3, 1}}),
      node<"b">(EulerExplicitSolver{},
                MechanicalObject<Vec3d>{.position = {{1, 0, 0}}},
                UniformMass<Vec3d>{.totalMass = 1},
                UncoupledConstraintCorrection<Vec3d>{.defaultCompliance = 1}))};
  sim.init();
  sim.animate(dt);
  auto const& a = sim.at<"a">().state();
  auto const& b = sim.at<"b">().state();
  // 1 m between them, shared 3 to 1
  CHECK(a.position[0][0] == Approx(0.75).epsilon(1e-12));
  CHECK(b.position[0][0] == Approx(0.75).epsilon(1e-12));
  CHECK(a.velocity[0][0] == Approx(0.75 / dt).epsilon(1e-12));
  CHECK(a.position[1][0] == 5);
}

TEST_CASE("compliances that move nothing, or are too few, are refused") {
  auto wrong = [](UncoupledConstraintCorrection<Rigid3d> correction, std::string const& words) {
    Simulation sim{node<"root">(FreeMotionAnimationLoop{},
                                BlockGaussSeidelConstraintSolver{},
                                EulerExplicitSolver{},
                                MechanicalObject<Rigid3d>{.position = {Rigid3d::Coord{}}},
                                UniformMass<Rigid3d>{},
                                correction)};
    CHECK_THROWS_WITH(sim.init(), Catch::Contains(words) && Catch::Contains("UncoupledConstraintCorrection"));
  };
  wrong({.compliance = {1, 2}}, "give 7");
  wrong({.compliance = {1, 1, 0, 0, 0, 0, 1}}, "compliance[4] is 0");
  wrong({.compliance = {-1, 1, 0, 0, 1, 0, 1}}, "compliance[0] is -1");
  wrong({.defaultCompliance = 0}, "defaultCompliance");
}

}  // namespace test_corrections
