// SPDX-License-Identifier: BSL-1.0
// SOFA's regularisation of those equations only that depend on others, against closed forms.
#include "catch.hpp"
#include "registry_scene.hpp"

#include <sinew/lagrangian.hpp>
#include <sinew/mechanics.hpp>

namespace test_null_space_rows {

using namespace sinew;

namespace {

constexpr double dt = 0.01, g = 10, mass = 2;
constexpr double w = dt * dt / mass, term = 0.01 * w;  // the compliance of a point, and what is added

// Two points, the first held twice.
template <class Solver>
auto held_twice(Solver solver, bool dependentOnly) {
  using Fixed = FixedLagrangianConstraint<Vec3d>;
  solver.maxIterations = 20000;
  solver.tolerance = 1e-15;
  solver.regularizationTerm = term / dt;  // of impulses
  solver.useSVDForRegularization = dependentOnly;
  return RegistryScene{node<"root">(Gravity{{0, 0, -g}},
                                    FreeMotionAnimationLoop{},
                                    solver,
                                    node<"body">(EulerExplicitSolver{},
                                                 MechanicalObject<Vec3d>{.position = {{0, 0, 0}, {1, 0, 0}}},
                                                 UniformMass<Vec3d>{.vertexMass = mass},
                                                 Fixed{.indices = {0, 1}},
                                                 Fixed{.indices = {0}}))};
}

// The diagonal that is added to J J'.
Eigen::VectorXd added(Eigen::MatrixXd const& J, double singularValue = 0.01, double component = 0.001) {
  const auto n = J.rows();
  ConstraintProblem p{J * J.transpose(), Eigen::VectorXd::Ones(n), Eigen::VectorXd::Zero(n), {}};
  const ConstraintProblem::Matrix before = p.compliance;
  NullSpaceRows().regularise(p, 3, singularValue, component);
  const ConstraintProblem::Matrix change = p.compliance - before;
  CHECK(change.isDiagonal());
  return change.diagonal();
}

}  // namespace

TEST_CASE(
    "equalities that say the same twice share the force, and the others hold as if nothing were added") {
  auto check = [](auto solver) {
    INFO(decltype(solver)::className);
    // in the first step a point falls by g dt^2, and (2 w + term) f = g dt^2 for each of its two multipliers;
    // in the end they are half its weight each, at which it rests term/(2 w) of that lower
    const double fall = g * dt * dt;
    auto sim = held_twice(solver, true);
    sim.init();
    sim.animate(dt);
    auto const& body = sim.template at<"body">().state();
    CHECK(body.position[0][2] == Approx(-fall * term / (2 * w + term)).epsilon(1e-6));
    CHECK(std::abs(body.position[1][2]) < 1e-9 * fall);
    auto const& f = sim.root().template get<FreeMotionAnimationLoop>().motion.problem.multipliers;
    CHECK(f[2] == Approx(fall / (2 * w + term)));
    CHECK(f[8] == Approx(f[2]));
    CHECK(f[5] == Approx(mass * g));
    for (int i = 0; i < 20; ++i) sim.animate(dt);
    CHECK(body.position[0][2] == Approx(-fall * term / (2 * w)).epsilon(1e-6));
    CHECK(std::abs(body.position[1][2]) < 1e-9 * fall);
    CHECK(f[2] == Approx(mass * g / 2));
    CHECK(sim.warnings().list().empty());
    // the same term for all equations lets the other point go, too
    auto all = held_twice(solver, false);
    all.init();
    all.animate(dt);
    CHECK(all.template at<"body">().state().position[1][2] ==
          Approx(-fall * term / (w + term)).epsilon(1e-6));
  };
  check(BlockGaussSeidelConstraintSolver{});
  check(NNCGConstraintSolver{});
  check(ImprovedJacobiConstraintSolver{});
  check(PreconditionedConjugateResidual{});
}

TEST_CASE("equations of the null space are those with a part in its vectors, whatever basis these are") {
  Eigen::MatrixXd J = Eigen::MatrixXd::Zero(6, 4);
  // two pairs that depend on each other, and two equations alone
  J.topLeftCorner<5, 3>() << 1, 0, 0, 0, 2, 0, 1, 0, 0, 0, 0, 3, 0, -2, 0;
  J(5, 3) = 1;
  CHECK((added(J) - Eigen::Matrix<double, 6, 1>(3, 3, 3, 0, 3, 0)).norm() == 0);
  CHECK(added(J, 0).norm() == 0);
  // 1 is below 0.3 of the largest singular value, 9, which is no dependence: SOFA's criterion
  CHECK(added(J, 0.3)[5] == 3);
  // the null vector of 1, e and their sum is (1, e, -1) but for its length
  Eigen::MatrixXd sum(3, 2);
  sum << 1, 0, 0, 1, 1, 1e-4;
  CHECK((added(sum) - Eigen::Vector3d(3, 0, 3)).norm() == 0);
  CHECK((added(sum, 0.01, 1e-5) - Eigen::Vector3d(3, 3, 3)).norm() == 0);
  // twenty equations over ten degrees of freedom, and equations that are independent
  CHECK((added(Eigen::MatrixXd::Random(20, 10)) - Eigen::VectorXd::Constant(20, 3)).norm() < 1e-12);
  CHECK(added(Eigen::MatrixXd::Identity(8, 8)).norm() == 0);
  CHECK(added(Eigen::MatrixXd(0, 3)).size() == 0);
}

}  // namespace test_null_space_rows
