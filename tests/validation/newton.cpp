// SPDX-License-Identifier: BSL-1.0
#include "catch.hpp"
#include "validation/closed_forms.hpp"

#include <sinew/constraint/linear_movement.hpp>
#include <sinew/solver/bdf2.hpp>
#include <sinew/solver/static_solver.hpp>

#include <limits>

namespace test_newton {

using namespace sinew;
using namespace closed_form;

namespace {

/// Implicit Euler linearised once a step, as it is written in the books: what one iteration is to be.
struct LinearisedEuler {
  using Role = role::OdeSolver;
  static constexpr std::string_view className = "LinearisedEuler";
  static constexpr bool implicit = true;
  static constexpr Auxiliary auxiliary{.derivs = 1};
  double rayleighStiffness = 0, rayleighMass = 0;
  bool firstOrder = false, trapezoidalScheme = false;
  static constexpr auto fields() { return field_list(); }

  template <class Operations>
  void solve(Operations& o, double h) const {
    MultiVecCoord pos(o, vec_id::position);
    MultiVecDeriv vel(o, vec_id::velocity), force(o, vec_id::force), dv(o, vec_id::dx), b(o);
    o.computeForce(force.id, pos.id, vel.id);
    b.eq(force);
    const double t = trapezoidalScheme ? 0.5 : 1, rK = rayleighStiffness, rM = rayleighMass;
    MatrixFactors factors{.m = 1 + t * h * rM, .b = -t * h, .k = -t * h * (t * h + rK)};
    if (firstOrder) {
      factors = {.m = 1, .k = -t * h};
    } else {
      o.addMBKdx(b.id, vel.id, {.m = -rM, .k = t * h + rK});
      b.teq(h);
    }
    o.projectResponse(b.id);
    o.root.withLinearSolver([&](auto& linear) { linear.solve(o, factors, dv, b); });
    if (firstOrder) {
      vel.eq(dv);
      pos.peq(vel, h);
    } else {
      vel.peq(dv, t);
      pos.peq(vel, h);
      if (t != 1) vel.peq(dv, 1 - t);
    }
  }
};

/// A solver of linear systems that goes the wrong way.
struct Backwards {
  using Role = role::LinearSolver;
  static constexpr std::string_view className = "Backwards";
  static constexpr Auxiliary auxiliary{};
  static constexpr auto fields() { return field_list(); }
  SparseLDLSolver<CompressedRowSparseMatrixd> right{};

  template <class Operations>
  void init(Operations& o) {
    right.init(o);
  }
  template <class Operations>
  void solve(Operations& o, MatrixFactors factors, MultiVecDeriv<Operations>& x,
             MultiVecDeriv<Operations>& b) {
    right.solve(o, factors, x, b);
    x.teq(-1);
  }
};

template <class Solver>
auto slung(Solver solver, double h, int steps) {
  auto sim = mass_on_spring(solver, {2, 0.3}, {1, 2});
  for (int i = 0; i < steps; ++i) sim.animate(h);
  return std::pair(sim.root().state().position[1], sim.root().state().velocity[1]);
}

// of mass_on_spring: mass 2, stiffness 8, length 1
Eigen::Vector2d pull(Eigen::Vector2d const& x, Eigen::Vector2d const& from = {0, 0}) {
  const Eigen::Vector2d d = x - from;
  return -8 * (d.norm() - 1) * d.normalized();
}

const EulerImplicitSolver exact{.maxNbIterationsNewton = 30,
                                .relativeInitialStoppingThreshold = 0,
                                .absoluteResidualStoppingThreshold = 1e-12};

}  // namespace

TEST_CASE("one iteration is the linearised step, bit by bit") {
  for (const bool trapezoidal : {false, true})
    for (const bool firstOrder : {false, true}) {
      const auto reference = slung(LinearisedEuler{.rayleighStiffness = 0.1,
                                                   .rayleighMass = 0.3,
                                                   .firstOrder = firstOrder,
                                                   .trapezoidalScheme = trapezoidal},
                                   0.1,
                                   50);
      EulerImplicitSolver solver{.rayleighStiffness = 0.1,
                                 .rayleighMass = 0.3,
                                 .firstOrder = firstOrder,
                                 .trapezoidalScheme = trapezoidal};
      CHECK(slung(solver, 0.1, 50) == reference);
      // and so it is where the residual is looked at after the iteration
      solver.maxNbIterationsLineSearch = 2;
      solver.lineSearchCoefficient = 0.999;
      auto once = mass_on_spring(solver, {2, 0.3}, {1, 2});
      once.animate(0.1);
      CHECK(once.root().template get<EulerImplicitSolver>().newton.residuals.size() == 2);
    }
}

TEST_CASE("implicit Euler with Newton's method solves its equation") {
  // a step of a third of the period, in which the spring turns and stretches
  const double h = 1;
  const Eigen::Vector2d x0(2, 0.3), v0(1, 2);
  auto sim = mass_on_spring(exact, x0, v0);
  sim.animate(h);
  auto const& newton = sim.root().get<EulerImplicitSolver>().newton;
  const Eigen::Vector2d x1 = sim.root().state().position[1], v1 = sim.root().state().velocity[1];
  CHECK(newton.status == NewtonStatus::residualSmall);
  // the residual that the solver reports is that of the equation, to rounding of forces of order 10
  CHECK((2 * (v1 - v0) - h * pull(x1)).norm() < 1e-12 + 1e-14);
  CHECK((x1 - x0 - h * v1).norm() < 1e-15 * 10);
  // the residuals at the end fall as their squares
  const std::size_t n = newton.residuals.size();
  REQUIRE(n >= 4);
  REQUIRE(newton.corrections.size() + 1 == n);
  for (std::size_t i = 2; i < n; ++i)
    if (newton.residuals[i - 1] < 0.5)
      CHECK(newton.residuals[i] < 2 * std::pow(newton.residuals[i - 1], 2) + 1e-14);
  // which the linearised step does not
  const auto [x, v] = slung(EulerImplicitSolver{}, h, 1);
  CHECK((2 * (v - v0) - h * pull(x)).norm() > 0.1);
}

TEST_CASE("with damping, at the midpoint and without inertia, the equation is solved too") {
  const double h = 0.5, rM = 0.3;
  const Eigen::Vector2d x0(2, 0.3), v0(1, 2);
  EulerImplicitSolver solver = exact;
  solver.rayleighMass = rM;
  auto [x, v] = slung(solver, h, 1);
  CHECK((2 * (v - v0) - h * (pull(x) - rM * 2 * v)).norm() < 1e-11);
  solver = exact;
  solver.trapezoidalScheme = true;
  std::tie(x, v) = slung(solver, h, 1);
  CHECK((2 * (v - v0) - h * pull((x0 + x) / 2)).norm() < 1e-11);
  CHECK((x - x0 - h * (v0 + v) / 2).norm() < 1e-14);
  solver = exact;
  solver.firstOrder = true;
  std::tie(x, v) = slung(solver, h, 1);
  CHECK((2 * v - pull(x)).norm() < 1e-11);
  CHECK((x - x0 - h * v).norm() < 1e-14);
}

TEST_CASE("a support that moves is where it is at the end of the step") {
  const double h = 0.5;
  Simulation sim{node<"root">(
      exact,
      SparseLDLSolver<CompressedRowSparseMatrixd>{},
      MechanicalObject<Vec2d>{.position = {{0, 0}, {1.5, 0}}},
      UniformMass<Vec2d>{.vertexMass = 2},
      StiffSpringForceField<Vec2d>{.springs = {{.first = 0, .second = 1, .stiffness = 8, .length = 1}}},
      LinearMovementConstraint<Vec2d>{.indices = {0}, .keyTimes = {0, 1}, .movements = {{0, 0}, {0, 1}}})};
  sim.init();
  sim.animate(h);
  auto const& s = sim.root().state();
  CHECK(s.position[0] == Eigen::Vector2d(0, 0.5));
  CHECK((2 * s.velocity[1] - h * pull(s.position[1], s.position[0])).norm() < 1e-11);
}

TEST_CASE("BDF of order 1 solves the same equation") {
  const auto euler = slung(exact, 0.5, 3);
  const auto bdf = slung(BDFOdeSolver{.order = 1,
                                      .maxNbIterationsNewton = 30,
                                      .relativeInitialStoppingThreshold = 0,
                                      .absoluteResidualStoppingThreshold = 1e-12},
                         0.5,
                         3);
  // residuals of 1e-12 against masses of 2, in three steps
  CHECK((euler.first - bdf.first).norm() < 1e-11);
  CHECK((euler.second - bdf.second).norm() < 1e-11);
}

TEST_CASE("a line search that finds nothing shorter takes the whole correction") {
  for (const int lengths : {4, std::numeric_limits<int>::max()}) {
    CAPTURE(lengths);
    Simulation sim{node<"root">(
        StaticSolver{.maxNbIterationsNewton = 1, .maxNbIterationsLineSearch = lengths},
        Backwards{},
        MechanicalObject<Vec2d>{.position = {{0, 0}, {1.5, 0}}},
        StiffSpringForceField<Vec2d>{.springs = {{.first = 0, .second = 1, .stiffness = 8, .length = 1}}},
        FixedConstraint<Vec2d>{.indices = {0}})};
    sim.init();
    sim.animate(1);
    auto const& newton = sim.root().get<StaticSolver>().newton;
    CHECK(newton.corrections == std::vector<double>{0.5});
    // each length moves the point by a power of two, of which at most one is rounded
    CHECK((sim.root().state().position[1] - Eigen::Vector2d(2, 0)).norm() <= 4.5e-16);
    CHECK(newton.residuals[0] == 4);
    CHECK(newton.residuals[1] == Approx(8).epsilon(1e-15));
    CHECK(newton.status == NewtonStatus::outOfIterations);
  }
}

TEST_CASE("what is at rest stays there without iterations") {
  auto sim = mass_on_spring(exact, {1, 0}, {0, 0});
  sim.animate(0.1);
  auto const& newton = sim.root().get<EulerImplicitSolver>().newton;
  CHECK(newton.corrections == std::vector<double>{0});  // a step in time has one, which is nothing
  CHECK(newton.status == NewtonStatus::residualSmall);
}

}  // namespace test_newton
