// SPDX-License-Identifier: BSL-1.0
// A linear system of a body as other libraries take it, and what they need to solve it.
#pragma once

#include <vector>

namespace bench {

/// A symmetric matrix in compressed rows, both halves, three unknowns a point; the places of points.
struct LinearSystem {
  int unknowns = 0;
  std::vector<int> starts{}, columns{};
  std::vector<double> values{}, rhs{}, places{};
};

/// To |b - A x| <= 1e-6 |b|, from x = 0: processor seconds of what is made from the matrix, and of what is
/// done for each right-hand side. `x` is for a look at the residual.
struct LinearResult {
  double setUp = 0, solve = 0;
  int iterations = 0;
  std::vector<double> x{};
};
inline constexpr double linearTolerance = 1e-6;

LinearResult solve_by_cholmod(LinearSystem const& system);
/// Conjugate gradients with BoomerAMG, which sees three functions. `nodal`: coarse points are chosen by
/// points, else by unknowns.
LinearResult solve_by_hypre(LinearSystem const& system, bool nodal);
/// Conjugate gradients with one of PETSc's preconditioners by smoothed aggregation with rigid motions: its
/// own, gamg, or Trilinos' ml, which came before MueLu.
LinearResult solve_by_petsc(LinearSystem const& system, char const* preconditioner);
/// Conjugate gradients with Trilinos' MueLu: smoothed aggregation with rigid motions.
LinearResult solve_by_muelu(LinearSystem const& system);

}  // namespace bench
