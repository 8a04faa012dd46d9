// SPDX-License-Identifier: BSL-1.0
#include "catch.hpp"
#include "error_of.hpp"
#include "registry_scene.hpp"
#include "solver/fem_bar.hpp"

#include <sinew/solver/cholesky_solver.hpp>
#include <sinew/solver/sparse_ldl_solver.hpp>

namespace test_direct_solvers {

using namespace sinew;

namespace {

template <class Linear>
Eigen::VectorXd bar(Linear linear) {
  auto sim = fem_bar::simulation(linear);
  return fem_bar::velocities(sim);
}

/// A mass on a compressed spring: across the spring the stiffness is k (1 - L/|d|), here -100.
template <class Linear>
auto compressed_spring(Linear linear, double mass) {
  RegistryScene sim{node<"root">(
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

TEST_CASE("direct solvers and converged conjugate gradients agree on a bar") {
  const Eigen::VectorXd cg =
      bar(CGLinearSolver<CompressedRowSparseMatrixMat3x3d>{.iterations = 2000, .tolerance = 1e-15});
  REQUIRE(cg.norm() > 1);
  CHECK((bar(SparseLDLSolver<CompressedRowSparseMatrixMat3x3d>{}) - cg).norm() < 1e-10 * cg.norm());
  CHECK((bar(SparseLDLSolver<CompressedRowSparseMatrixd>{}) - cg).norm() < 1e-10 * cg.norm());
  CHECK((bar(CholeskySolver<CompressedRowSparseMatrixMat3x3d>{}) - cg).norm() < 1e-10 * cg.norm());
  CHECK((bar(CholeskySolver<CompressedRowSparseMatrixd>{}) - cg).norm() < 1e-10 * cg.norm());
}

TEST_CASE("direct solvers take points of any size in any blocks") {
  // the two dofs of the moving point: m v' = h f(v'), across: (m - 100 h^2) dv = 100 h^2 v
  const double h = 0.01, m = 1, expected = 1 + 100 * h * h / (m - 100 * h * h);
  auto moved = [&](auto linear) {
    auto sim = compressed_spring(linear, m);
    sim.animate(h);
    return sim.root().state().velocity[1][1];
  };
  CHECK(moved(SparseLDLSolver<CompressedRowSparseMatrixMat3x3d>{}) == Approx(expected).epsilon(1e-13));
  CHECK(moved(SparseLDLSolver<CompressedRowSparseMatrixd>{}) == Approx(expected).epsilon(1e-13));
  CHECK(moved(CholeskySolver<CompressedRowSparseMatrixMat3x3d>{}) == Approx(expected).epsilon(1e-13));
}

TEST_CASE("an indefinite system is solved by L D L', sparse and dense") {
  // the same spring and a mass too light for the step: m - 100 h^2 = -0.5
  const double h = 0.1, m = 0.5;
  auto sim = compressed_spring(SparseLDLSolver<>{}, m);
  sim.animate(h);
  CHECK(sim.root().state().velocity[1][1] == Approx(1 + 100 * h * h / (m - 100 * h * h)).epsilon(1e-13));
  CHECK(sim.root().get<SparseLDLSolver<>>().factor.negativePivots == 1);

  auto dense = compressed_spring(CholeskySolver<>{}, m);
  dense.animate(h);
  CHECK(dense.root().state().velocity[1][1] == Approx(sim.root().state().velocity[1][1]).epsilon(1e-13));
}

TEST_CASE("a singular system is an error that names the point") {
  // the mass at which m - 100 h^2 vanishes, exactly, since h is a binary fraction
  const double h = 0.125, m = 100 * h * h;
  for (const std::string& said : {error_of([&] { compressed_spring(SparseLDLSolver<>{}, m).animate(h); }),
                                  error_of([&] { compressed_spring(CholeskySolver<>{}, m).animate(h); })}) {
    INFO(said);
    CHECK(said.find("point 1, component 1 of MechanicalObject<Vec2d>") != std::string::npos);
  }
}

}  // namespace test_direct_solvers
