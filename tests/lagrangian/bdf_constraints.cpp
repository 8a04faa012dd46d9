// SPDX-License-Identifier: BSL-1.0
// Multipliers under BDFOdeSolver: closed forms, and orders of convergence.
#include "catch.hpp"
#include "error_of.hpp"
#include "registry_scene.hpp"

#include <sinew/lagrangian.hpp>
#include <sinew/mechanics.hpp>

#include <array>
#include <cmath>
#include <vector>

namespace test_bdf_constraints {

using namespace sinew;
using Eigen::Vector3d;

namespace {

// the name of a node as an argument
template <FixedString Name>
struct Named {
  static constexpr FixedString value = Name;
};
template <class Solver = BlockGaussSeidelConstraintSolver>
Solver exact() {
  Solver solver;
  solver.tolerance = 1e-14;
  if constexpr (requires { solver.momentumTolerance; }) solver.momentumTolerance = 1e-14;
  return solver;
}

// Points of 1 and 2 kg on springs of 40 and 10 N/m, joined: from x = 0.3 m they swing as one, with
// w^2 = 50 / 3, and the joint holds the first by k x + m x'' = (40 - 50 / 3) x.
const double frequency = std::sqrt(50 / 3.), amplitude = 0.3;

template <class Solver>
auto joined_oscillators(Solver solver, int order, bool velocityFirst) {
  auto point = [&](auto name, double mass, double stiffness) {
    MechanicalObject<Vec3d> state{.position = {{amplitude, 0, 0}}};
    state.restPosition = {{0, 0, 0}};
    return node<decltype(name)::value>(
        BDFOdeSolver{.order = order},
        SparseLDLSolver<>{},
        state,
        UniformMass<Vec3d>{.totalMass = mass},
        RestShapeSpringsForceField<Vec3d>{.points = {0}, .stiffness = {stiffness}});
  };
  return RegistryScene{node<"root">(
      FreeMotionAnimationLoop{.solveVelocityConstraintFirst = velocityFirst},
      solver,
      BilateralLagrangianConstraint<Vec3d, Between<"a", "b">>{.first_point = {0}, .second_point = {0}},
      point(Named<"a">{}, 1, 40),
      point(Named<"b">{}, 2, 10))};
}

struct Errors {
  double position = 0, multiplier = 0;
};
// after 1 s of n steps
template <class Solver>
Errors errors(Solver solver, int order, int n, bool velocityFirst = false) {
  auto sim = joined_oscillators(solver, order, velocityFirst);
  sim.init();
  for (int i = 0; i < n; ++i) sim.animate(1. / n);
  auto const& a = sim.template at<"a">().state().position[0];
  auto const& b = sim.template at<"b">().state().position[0];
  CHECK((a - b).norm() < 1e-11);
  const double x = amplitude * std::cos(frequency);
  auto const& f =
      sim.root().template get<BilateralLagrangianConstraint<Vec3d, Between<"a", "b">>>().multipliers;
  REQUIRE(f.size() == 3);
  return {std::abs(a[0] - x), std::abs(std::abs(f[0]) - std::abs((40 - 50 / 3.) * x))};
}
double order_of(double coarse, double fine) { return std::log2(coarse / fine); }

}  // namespace

TEST_CASE(
    "joined oscillators under BDF swing as one, with the order of the method, and so does their multiplier") {
  for (const int order : {1, 2, 3}) {
    INFO(order);
    const Errors coarse = errors(exact(), order, 400), fine = errors(exact(), order, 800);
    CHECK(order_of(coarse.position, fine.position) == Approx(order).margin(0.1));
    CHECK(order_of(coarse.multiplier, fine.multiplier) == Approx(order).margin(0.1));
  }
  // without a compliance matrix, the same
  const Errors swept = errors(exact(), 2, 200), convex = errors(exact<ConvexConstraintSolver>(), 2, 200);
  CHECK(convex.position == Approx(swept.position).epsilon(1e-6));
  CHECK(convex.multiplier == Approx(swept.multiplier).epsilon(1e-6));
}

TEST_CASE("positions that move by constrained velocities are of order 1 under BDF") {
  const Errors coarse = errors(exact(), 2, 800, true), fine = errors(exact(), 2, 1600, true);
  CHECK(order_of(coarse.position, fine.position) == Approx(1).margin(0.1));
}

namespace {

// a rod of 1 m that swings from level
auto pendulum(int order, bool velocityFirst = false) {
  MeshTopology edge;
  edge.edges = {{0, 1}};
  return RegistryScene{node<"root">(
      Gravity{{0, -10, 0}},
      FreeMotionAnimationLoop{.solveVelocityConstraintFirst = velocityFirst},
      exact(),
      BDFOdeSolver{.order = order},
      SparseLDLSolver<>{},
      edge,
      MechanicalObject<Vec3d>{.position = {{0, 0, 0}, {1, 0, 0}}},
      UniformMass<Vec3d>{.vertexMass = 2},
      FixedConstraint<Vec3d>{.indices = {0}},
      node<"length">(
          MechanicalObject<Vec1d>{}, DistanceMapping<Vec3d, Vec1d>{}, UniformLagrangianConstraint<Vec1d>{}))};
}
// its angle after 1 s, by the method of Runge and Kutta of order 4 in steps of 1e-4 s
double swung() {
  double a = 0, w = 0;
  const double h = 1e-4;
  auto rate = [](double at) { return -10 * std::cos(at); };
  for (int i = 0; i < 10000; ++i) {
    const double w2 = w + h / 2 * rate(a), w3 = w + h / 2 * rate(a + h / 2 * w),
                 w4 = w + h * rate(a + h / 2 * w2);
    const double a1 = rate(a), a2 = rate(a + h / 2 * w), a3 = rate(a + h / 2 * w2), a4 = rate(a + h * w3);
    a += h / 6 * (w + 2 * w2 + 2 * w3 + w4);
    w += h / 6 * (a1 + 2 * a2 + 2 * a3 + a4);
  }
  return a;
}

}  // namespace

TEST_CASE(
    "a pendulum under BDF keeps its length, and has order 1, that of a Jacobian at the start of steps") {
  const double angle = swung();
  auto measured = [&](int order, int n) {
    auto sim = pendulum(order);
    sim.init();
    double longest = 0;
    for (int i = 0; i < n; ++i) {
      sim.animate(1. / n);
      longest = std::max(longest, std::abs(sim.root().state().position[1].norm() - 1));
    }
    auto const& x = sim.root().state().position[1];
    return std::array{std::abs(std::remainder(std::atan2(x[1], x[0]) - angle, 2 * M_PI)), longest};
  };
  for (const int order : {1, 2}) {
    INFO(order);
    const auto coarse = measured(order, 400), fine = measured(order, 800);
    INFO(coarse[0] << " " << fine[0] << " " << coarse[1] << " " << fine[1]);
    CHECK(order_of(coarse[0], fine[0]) == Approx(1).margin(0.15));
    // (h w)^2 / 2 with w^2 <= 20, but for the error of w
    CHECK(fine[1] < 1.1 * 20. / 800 / 800 / 2);
    CHECK(order_of(coarse[1], fine[1]) == Approx(2).margin(0.15));
  }
}

TEST_CASE("reset under BDF brings back the bits of the first steps, what multipliers left in them included") {
  for (const bool velocityFirst : {false, true}) {
    auto sim = pendulum(3, velocityFirst);
    sim.init();
    auto run = [&] {
      for (int i = 0; i < 20; ++i) sim.animate(0.01);
      return sim.root().state().position[1];
    };
    const Vector3d first = run();
    run();
    sim.reset();
    CHECK(run() == first);
  }
}

TEST_CASE("a compliance that is made once is refused beside a BDF whose first steps have another") {
  auto scene = [](int order) {
    return RegistryScene{node<"root">(FreeMotionAnimationLoop{},
                                      exact(),
                                      node<"body">(BDFOdeSolver{.order = order},
                                                   SparseLDLSolver<>{},
                                                   MechanicalObject<Vec3d>{.position = {{0, 0, 0}}},
                                                   UniformMass<Vec3d>{.totalMass = 4},
                                                   PrecomputedConstraintCorrection<Vec3d>{},
                                                   FixedLagrangianConstraint<Vec3d>{.indices = {0}}))};
  };
  auto refused = scene(2);
  CHECK_THAT(error_of([&] { refused.init(); }),
             Catch::Contains("/root/body: PrecomputedConstraintCorrection") &&
                 Catch::Contains("BDFOdeSolver") && Catch::Contains("order=1"));
  auto taken = scene(1);
  CHECK(error_of([&] { taken.init(); }).empty());
}

}  // namespace test_bdf_constraints
