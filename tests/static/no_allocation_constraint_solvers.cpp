// SPDX-License-Identifier: BSL-1.0
// Counts what constraint solvers allocate when they have solved a problem that is as large.
#include "static/allocations.hpp"

#include "catch.hpp"
#include "lagrangian/friction_problems.hpp"

#include <sinew/lagrangian/block_gauss_seidel_constraint_solver.hpp>
#include <sinew/lagrangian/improved_jacobi_constraint_solver.hpp>
#include <sinew/lagrangian/lcp_constraint_solver.hpp>
#include <sinew/lagrangian/nncg_constraint_solver.hpp>

namespace test_no_allocation_constraint_solvers {

using namespace sinew;
using namespace friction_problems;

template <class Solver>
void keeps_its_room(Solver solver) {
  const ConstraintProblem large = ball_pile(40, 1).problem(), small = ball_pile(15, 2).problem();
  INFO(Solver::className);
  ConstraintProblem p = large;
  solver.solve(p, "test");
  const long before = allocations;
  p = small;
  solver.solve(p, "test");
  p = large;
  solver.solve(p, "test");
  CHECK(allocations == before);
  CHECK(solver.result.iterations > 2);
  CHECK(p.multipliers.norm() > 1e-3);
}

TEST_CASE("constraint solvers keep the room of their largest problem") {
  keeps_its_room(BlockGaussSeidelConstraintSolver{.tolerance = 1e-6});
  keeps_its_room(BlockGaussSeidelConstraintSolver{.tolerance = 1e-6, .sor = 0.9});
  keeps_its_room(NNCGConstraintSolver{.tolerance = 1e-6});
  keeps_its_room(ImprovedJacobiConstraintSolver{
      .tolerance = 1e-6, .useSpectralCorrection = true, .useConjugateResidue = true});
  keeps_its_room(LCPConstraintSolver{.tolerance = 1e-6});
  keeps_its_room(LCPConstraintSolver{.mu = 0, .lemke = true});
}

}  // namespace test_no_allocation_constraint_solvers
