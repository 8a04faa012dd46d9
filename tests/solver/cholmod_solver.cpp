// SPDX-License-Identifier: BSL-1.0
#include "catch.hpp"
#include "solver/fem_bar.hpp"

#include <sinew/lagrangian.hpp>
#include <sinew/solver/cholmod_solver.hpp>
#include <sinew/solver/sparse_ldl_solver.hpp>

using namespace sinew;

namespace {

/// A mass on a compressed spring: across the spring the stiffness is k (1 - L/|d|), here -100.
template <class Linear>
auto compressed_spring(Linear linear, double mass) {
  Simulation sim{node<"root">(
      EulerImplicitSolver{},
      linear,
      MechanicalObject<Vec2d>{.position = {{0, 0}, {0.5, 0}}, .velocity = {{0, 0}, {0, 1}}},
      UniformMass<Vec2d>{.vertexMass = mass},
      StiffSpringForceField<Vec2d>{.springs = {{.first = 0, .second = 1, .stiffness = 100, .length = 1}}},
      FixedConstraint<Vec2d>{.indices = {0}})};
  sim.init();
  return sim;
}

}  // namespace

TEMPLATE_TEST_CASE("CHOLMOD finds what L D L' finds", "", CompressedRowSparseMatrixMat3x3d,
                   CompressedRowSparseMatrixd) {
  static_assert(LinearSolver<CholmodSolver<TestType>>);
  for (const bool graded : {false, true}) {
    auto exact = fem_bar::simulation(SparseLDLSolver<>{}, 8, true, graded);
    auto sim = fem_bar::simulation(CholmodSolver<TestType>{}, 8, true, graded);
    const Eigen::VectorXd v = fem_bar::velocities(exact);
    CHECK((fem_bar::velocities(sim) - v).norm() < 1e-10 * v.norm());
    // a second init, and a copy
    sim.init();
    auto copy = sim;
    copy.init();
    const Eigen::VectorXd more = fem_bar::velocities(exact);
    CHECK((fem_bar::velocities(copy) - more).norm() < 1e-9 * more.norm());
    CHECK((fem_bar::velocities(sim) - more).norm() < 1e-9 * more.norm());
  }
}

TEST_CASE("CHOLMOD takes points of any size in any blocks, and says where a matrix is not definite") {
  // m v' = h f(v'), across: (m - 100 h^2) dv = 100 h^2 v
  const double h = 0.01, m = 1;
  auto sim = compressed_spring(CholmodSolver<>{}, m);
  sim.animate(h);
  CHECK(sim.root().state().velocity[1][1] == Approx(1 + 100 * h * h / (m - 100 * h * h)).epsilon(1e-13));
  auto refused = compressed_spring(CholmodSolver<CompressedRowSparseMatrixd>{}, 0.5);
  try {
    refused.animate(0.1);
    FAIL("nothing was said");
  } catch (Error const& error) {
    const std::string said = error.what();
    INFO(said);
    for (const std::string word : {"/root: CholmodSolver", "not positive definite", "point 1, component 1"})
      CHECK(said.find(word) != std::string::npos);
  }
}

TEST_CASE("CHOLMOD solves again for multipliers, with the factor of the step") {
  auto velocities = [](auto linear) {
    MechanicalObject<Vec3d> state{.position = {{0, 0, 0}, {1, 0, 0}, {2, 0.1, 0}, {3, 0, 0}}};
    StiffSpringForceField<Vec3d> springs;
    for (int i = 0; i < 3; ++i) springs.springs.push_back({i, i + 1, 200, 1, 1});
    Simulation sim{node<"root">(FreeMotionAnimationLoop{},
                                BlockGaussSeidelConstraintSolver{.tolerance = 1e-15},
                                Gravity{{0, -10, 0}},
                                EulerImplicitSolver{},
                                linear,
                                state,
                                UniformMass<Vec3d>{.totalMass = 4},
                                springs,
                                FixedLagrangianConstraint<Vec3d>{.indices = {0, 3}})};
    sim.init();
    for (int i = 0; i < 10; ++i) sim.animate(0.01);
    return Eigen::VectorXd(vec::flat(sim.root().state().velocity));
  };
  const Eigen::VectorXd exact = velocities(SparseLDLSolver<>{});
  CHECK((velocities(CholmodSolver<>{}) - exact).norm() < 1e-10 * exact.norm());
}
