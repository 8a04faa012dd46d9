// SPDX-License-Identifier: BSL-1.0
#include "catch.hpp"
#include "solver/fem_bar.hpp"

#include <sinew/mpi/petsc_linear_solver.hpp>
#include <sinew/solver/sparse_ldl_solver.hpp>

#include <string>

namespace test_petsc_linear_solver {

using namespace sinew;

template <class F>
std::string error_of(F&& f) {
  try {
    f();
  } catch (Error const& error) {
    return error.what();
  }
  return "nothing was said";
}
bool says(std::string const& message, std::initializer_list<char const*> words) {
  for (char const* word : words)
    if (message.find(word) == std::string::npos) return false;
  return true;
}

TEST_CASE("a mass on a stretched spring moves as the system of implicit Euler says, in closed form") {
  // along the spring: (m + h^2 k) dv = h (f + h (-k) v), f = -k (|d| - L)
  const double k = 100, m = 2, h = 0.01, v = 0.3, stretch = 0.5;
  auto sim = [&](auto linear) {
    Simulation s{node<"root">(
        EulerImplicitSolver{},
        linear,
        MechanicalObject<Vec2d>{.position = {{0, 0}, {1 + stretch, 0}}, .velocity = {{0, 0}, {v, 0}}},
        UniformMass<Vec2d>{.vertexMass = m},
        StiffSpringForceField<Vec2d>{.springs = {{.first = 0, .second = 1, .stiffness = k, .length = 1}}},
        FixedConstraint<Vec2d>{.indices = {0}})};
    s.init();
    s.animate(h);
    return s.root().state().velocity[1];
  };
  const double exact = v + h * (-k * stretch - h * k * v) / (m + h * h * k);
  // to the tolerance of the solver, relative to dv
  const double error = 1e-12 * std::abs(exact - v) + 1e-15;
  CHECK(std::abs(sim(PetscLinearSolver<CompressedRowSparseMatrixd>{.tolerance = 1e-12})[0] - exact) < error);
  CHECK(std::abs(sim(PetscLinearSolver<>{.tolerance = 1e-12})[0] - exact) < error);
}

TEST_CASE("PETSc's solvers and preconditioners find what L D L' finds") {
  struct Choice {
    std::string solver, preconditioner, matrix, options;
  };
  auto exact = fem_bar::simulation(SparseLDLSolver<>{}, 8, true, true);
  const Eigen::VectorXd v = fem_bar::velocities(exact);
  for (Choice const& c : {Choice{"cg", "pbjacobi", "baij", ""},
                          Choice{"cg", "bjacobi", "baij", ""},
                          Choice{"minres", "jacobi", "aij", ""},
                          Choice{"gmres", "ilu", "baij", ""},
                          Choice{"bcgs", "pbjacobi", "baij", ""},
                          Choice{"cg", "gamg", "aij", ""},
                          Choice{"cg", "hypre", "aij", "-pc_hypre_type boomeramg"},
                          Choice{"preonly", "cholesky", "aij", ""},
                          Choice{"preonly", "lu", "baij", ""}}) {
    INFO(c.solver << ' ' << c.preconditioner << ' ' << c.matrix);
    auto sim = fem_bar::simulation(PetscLinearSolver<>{.solver = c.solver,
                                                       .preconditioner = c.preconditioner,
                                                       .tolerance = 1e-11,
                                                       .matrix = c.matrix,
                                                       .options = c.options},
                                   8,
                                   true,
                                   true);
    // three steps; the condition of the matrix over the tolerance
    CHECK((fem_bar::velocities(sim) - v).norm() < 1e-6 * v.norm());
    auto copy = sim;
    copy.init();
    // a preconditioner that is made anew may not have the same bits: gamg draws random numbers
    const Eigen::VectorXd w = fem_bar::velocities(sim, 1);
    CHECK((fem_bar::velocities(copy, 1) - w).norm() < 1e-6 * w.norm());
  }
  auto single = fem_bar::simulation(PetscLinearSolver<CompressedRowSparseMatrixMat3x3f>{}, 8, true, true);
  CHECK((fem_bar::velocities(single) - v).norm() < 1e-3 * v.norm());
}

TEST_CASE("a solver that starts from the last solution takes fewer iterations, and finds the same") {
  auto cold = fem_bar::simulation(PetscLinearSolver<>{.tolerance = 1e-10});
  auto warm = fem_bar::simulation(PetscLinearSolver<>{.tolerance = 1e-10, .warmStart = true});
  const Eigen::VectorXd v = fem_bar::velocities(cold, 20, 0.001), w = fem_bar::velocities(warm, 20, 0.001);
  CHECK((v - w).norm() < 1e-7 * v.norm());
  CHECK(warm.root().first<role::LinearSolver>().iterationsTaken <
        cold.root().first<role::LinearSolver>().iterationsTaken);
  CHECK(cold.root().first<role::LinearSolver>().residual < 1e-10);
}

TEST_CASE("what PETSc does not know, or does not solve, is said in a sentence") {
  auto first = [](PetscLinearSolver<> linear) {
    auto sim = fem_bar::simulation(linear);
    sim.animate(0.02);
  };
  std::string said = error_of([&] { first({.solver = "gmress"}); });
  INFO(said);
  CHECK(says(said, {"/root: PetscLinearSolver", "solver is 'gmress'", "did you mean 'gmres'", "fgmres"}));
  said = error_of([&] { first({.preconditioner = "multigrids"}); });
  INFO(said);
  CHECK(says(said, {"preconditioner is 'multigrids'", "no preconditioner of that name", "gamg"}));
  said = error_of([&] { first({.matrix = "dense"}); });
  CHECK(says(said, {"matrix is 'dense'", "baij, aij or free"}));
  said = error_of([&] { first({.preconditioner = "gamg", .matrix = "free"}); });
  CHECK(says(said, {"preconditioner is 'gamg'", "matrix is free", "take none"}));
  said = error_of([&] { first({.iterations = 3}); });
  INFO(said);
  CHECK(says(said, {"cg with pbjacobi has not converged in 3 iterations", "more iterations"}));
  said = error_of([&] { first({.options = "-pc_hypre_typ boomeramg"}); });
  INFO(said);
  CHECK(says(said, {"-pc_hypre_typ", "does not read"}));
  CHECK(says(error_of([&] { first({.tolerance = -1}); }), {"tolerance"}));
  CHECK(says(error_of([&] { first({.iterations = 0}); }), {"iterations"}));

  // across a compressed spring the stiffness is negative: m - h^2 100 < 0, and the force is along it
  Simulation sim{node<"root">(
      EulerImplicitSolver{},
      PetscLinearSolver<>{.preconditioner = "none"},
      MechanicalObject<Vec2d>{.position = {{0, 0}, {0.5, 0}}, .velocity = {{0, 0}, {0, 1}}},
      UniformMass<Vec2d>{.vertexMass = 0.5},
      StiffSpringForceField<Vec2d>{.springs = {{.first = 0, .second = 1, .stiffness = 100, .length = 1}}},
      FixedConstraint<Vec2d>{.indices = {0}})};
  sim.init();
  said = error_of([&] { sim.animate(0.1); });
  INFO(said);
  CHECK(says(said, {"positive definite matrix", "minres"}));
}

}  // namespace test_petsc_linear_solver
