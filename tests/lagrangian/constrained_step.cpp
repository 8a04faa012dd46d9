// SPDX-License-Identifier: BSL-1.0
// A typed scene with constraints by multipliers, against closed forms.
#include "catch.hpp"

#include <sinew/lagrangian.hpp>
#include <sinew/mechanics.hpp>

namespace test_constrained_step {

using namespace sinew;

namespace {

const Eigen::Vector3d g(0, 0, -10);

template <class ConstraintSolver = BlockGaussSeidelConstraintSolver, class Ode, class... Linear>
auto hanging(Ode ode, Linear... linear) {
  ConstraintSolver solver;
  solver.tolerance = 1e-13;
  if constexpr (requires { solver.momentumTolerance; }) solver.momentumTolerance = 1e-13;
  return Simulation{node<"root">(Gravity{g},
                                 FreeMotionAnimationLoop{},
                                 solver,
                                 ode,
                                 linear...,
                                 node<"body">(MechanicalObject<Vec3d>{.position = {{0, 0, 0}, {0, 0, -1}}},
                                              UniformMass<Vec3d>{.totalMass = 4},
                                              FixedLagrangianConstraint<Vec3d>{.indices = {0}}))};
}

}  // namespace

TEST_CASE("a point that a multiplier holds stays, and the multiplier is its weight") {
  auto holds = [](auto sim) {
    sim.init();
    for (int i = 0; i < 10; ++i) sim.animate(0.01);
    auto& body = sim.template at<"body">();
    const double before = body.template get<FixedLagrangianConstraint<Vec3d>>().multipliers[2];
    sim.animate(0.01);
    CHECK(body.state().position[0].norm() < 1e-12);
    CHECK(body.state().velocity[0].norm() < 1e-11);
    auto const& f = body.template get<FixedLagrangianConstraint<Vec3d>>().multipliers;
    REQUIRE(f.size() == 3);
    // Newmark's method begins with the acceleration of the free point, and so alternates about the weight
    CHECK((before + f[2]) / 2 == Approx(20).epsilon(1e-9));
    CHECK(std::abs(f[0]) + std::abs(f[1]) < 1e-9);
  };
  holds(hanging(EulerExplicitSolver{}));
  holds(hanging(EulerImplicitSolver{}, SparseLDLSolver<>{}));
  holds(hanging(EulerImplicitSolver{}, CGLinearSolver<>{.tolerance = 1e-14}));
  // by its factor, and where that is older than the matrix, by iterations
  for (const int updateStep : {1, 3})
    holds(hanging(
        EulerImplicitSolver{},
        ShewchukPCGLinearSolver<>{
            .tolerance = 1e-14, .updateStep = updateStep, .precondition = PreconditionerMethod::ldl}));
  holds(hanging(NewmarkImplicitSolver{}, SparseLDLSolver<>{}));
  for (const int order : {1, 2, 3}) holds(hanging(BDFOdeSolver{.order = order}, SparseLDLSolver<>{}));
  holds(hanging<ConvexConstraintSolver>(EulerExplicitSolver{}));
  holds(hanging<ConvexConstraintSolver>(EulerImplicitSolver{}, CGLinearSolver<>{.tolerance = 1e-14}));
  holds(hanging(VariationalSymplecticSolver{}, SparseLDLSolver<>{}));
  // each solver of constraints
  holds(hanging<NNCGConstraintSolver>(EulerExplicitSolver{}));
  holds(hanging<ImprovedJacobiConstraintSolver>(EulerExplicitSolver{}));
  holds(hanging<LCPConstraintSolver>(EulerExplicitSolver{}));
}

TEST_CASE("bodies of different solvers that are joined fall as one, and keep their momentum") {
  Simulation sim{node<"root">(
      FreeMotionAnimationLoop{},
      BlockGaussSeidelConstraintSolver{.tolerance = 1e-14},
      BilateralLagrangianConstraint<Vec3d, Between<"a", "b">>{.first_point = {0}, .second_point = {0}},
      node<"a">(EulerExplicitSolver{},
                MechanicalObject<Vec3d>{.position = {{0, 0, 0}}, .velocity = {{3, 0, 0}}},
                UniformMass<Vec3d>{.totalMass = 1}),
      node<"b">(EulerImplicitSolver{},
                SparseLDLSolver<>{},
                MechanicalObject<Vec3d>{.position = {{0, 0, 0}}},
                UniformMass<Vec3d>{.totalMass = 2}))};
  sim.init();
  for (int i = 1; i <= 10; ++i) {
    sim.animate(0.01);
    auto const& a = sim.at<"a">().state();
    auto const& b = sim.at<"b">().state();
    CHECK((a.position[0] - b.position[0]).norm() < 1e-12);
    CHECK((a.velocity[0] - Eigen::Vector3d(1, 0, 0)).norm() < 1e-9);
    CHECK((b.velocity[0] - Eigen::Vector3d(1, 0, 0)).norm() < 1e-9);
  }
}

// What an impulse moves the point by is h / m, SOFA's W: Jacobi's weight is 1.8 m / h where that is below
// one, and so much of the weight of the point its first iteration finds.
TEST_CASE("Jacobi's weight is of the length of the step") {
  const double h = 0.01, m = 1e-3;
  Simulation sim{
      node<"root">(Gravity{g},
                   FreeMotionAnimationLoop{},
                   ImprovedJacobiConstraintSolver{.maxIterations = 1, .useSpectralCorrection = true},
                   EulerExplicitSolver{},
                   node<"body">(MechanicalObject<Vec3d>{.position = {{0, 0, 0}}},
                                UniformMass<Vec3d>{.totalMass = m},
                                FixedLagrangianConstraint<Vec3d>{.indices = {0}}))};
  sim.init();
  sim.animate(h);
  auto const& f = sim.at<"body">().get<FixedLagrangianConstraint<Vec3d>>().multipliers;
  REQUIRE(f.size() == 3);
  CHECK(f[2] == Approx(1.8 * m / h * m * 10).epsilon(1e-3));
}

}  // namespace test_constrained_step
