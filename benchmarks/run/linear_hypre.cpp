// SPDX-License-Identifier: BSL-1.0
#include "linear_system.hpp"
#include "paired.hpp"

#include <HYPRE.h>
#include <HYPRE_IJ_mv.h>
#include <HYPRE_krylov.h>
#include <HYPRE_parcsr_ls.h>
#include <mpi.h>

#include <cstddef>

namespace bench {

LinearResult solve_by_hypre(LinearSystem const& s, bool nodal) {
  int running = 0;
  MPI_Initialized(&running);
  if (!running) MPI_Init(nullptr, nullptr);
  HYPRE_Init();
  LinearResult result;
  const int n = s.unknowns;
  std::vector<int> counts, rows;
  for (int i = 0; i < n; ++i) {
    counts.push_back(s.starts[std::size_t(i) + 1] - s.starts[std::size_t(i)]);
    rows.push_back(i);
  }
  HYPRE_IJMatrix a;
  HYPRE_IJMatrixCreate(MPI_COMM_WORLD, 0, n - 1, 0, n - 1, &a);
  HYPRE_IJMatrixSetObjectType(a, HYPRE_PARCSR);
  HYPRE_IJMatrixSetRowSizes(a, counts.data());
  HYPRE_IJMatrixInitialize(a);
  HYPRE_IJMatrixSetValues(a, n, counts.data(), rows.data(), s.columns.data(), s.values.data());
  HYPRE_IJMatrixAssemble(a);
  void* object = nullptr;
  HYPRE_IJMatrixGetObject(a, &object);
  auto const matrix = static_cast<HYPRE_ParCSRMatrix>(object);
  auto vector = [&](std::vector<double> const& values, HYPRE_IJVector& held) {
    HYPRE_IJVectorCreate(MPI_COMM_WORLD, 0, n - 1, &held);
    HYPRE_IJVectorSetObjectType(held, HYPRE_PARCSR);
    HYPRE_IJVectorInitialize(held);
    HYPRE_IJVectorSetValues(held, n, rows.data(), values.data());
    HYPRE_IJVectorAssemble(held);
    HYPRE_IJVectorGetObject(held, &object);
    return static_cast<HYPRE_ParVector>(object);
  };
  HYPRE_IJVector heldB, heldX;
  const HYPRE_ParVector b = vector(s.rhs, heldB), x = vector(std::vector<double>(std::size_t(n)), heldX);

  HYPRE_Solver cycle, solver;
  HYPRE_BoomerAMGCreate(&cycle);
  HYPRE_BoomerAMGSetNumFunctions(cycle, 3);
  HYPRE_BoomerAMGSetCoarsenType(cycle, 10);  // HMIS
  HYPRE_BoomerAMGSetInterpType(cycle, 6);    // extended, with diagonal
  HYPRE_BoomerAMGSetPMaxElmts(cycle, 4);
  HYPRE_BoomerAMGSetStrongThreshold(cycle, 0.5);
  HYPRE_BoomerAMGSetRelaxType(cycle, 6);  // symmetric Gauss-Seidel
  HYPRE_BoomerAMGSetNumSweeps(cycle, 1);
  HYPRE_BoomerAMGSetMaxIter(cycle, 1);
  HYPRE_BoomerAMGSetTol(cycle, 0);
  HYPRE_BoomerAMGSetPrintLevel(cycle, 0);
  if (nodal) HYPRE_BoomerAMGSetNodal(cycle, 4);
  HYPRE_ParCSRPCGCreate(MPI_COMM_WORLD, &solver);
  HYPRE_PCGSetMaxIter(solver, 2000);
  HYPRE_PCGSetTol(solver, linearTolerance);
  HYPRE_PCGSetTwoNorm(solver, 1);
  HYPRE_PCGSetPrecond(solver,
                      reinterpret_cast<HYPRE_PtrToSolverFcn>(HYPRE_BoomerAMGSolve),
                      reinterpret_cast<HYPRE_PtrToSolverFcn>(HYPRE_BoomerAMGSetup),
                      cycle);
  result.setUp = processor_seconds([&] { HYPRE_ParCSRPCGSetup(solver, matrix, b, x); });
  result.solve = processor_seconds([&] { HYPRE_ParCSRPCGSolve(solver, matrix, b, x); });
  HYPRE_PCGGetNumIterations(solver, &result.iterations);
  result.x.resize(std::size_t(n));
  HYPRE_IJVectorGetValues(heldX, n, rows.data(), result.x.data());
  HYPRE_ParCSRPCGDestroy(solver);
  HYPRE_BoomerAMGDestroy(cycle);
  HYPRE_IJVectorDestroy(heldX);
  HYPRE_IJVectorDestroy(heldB);
  HYPRE_IJMatrixDestroy(a);
  return result;
}

}  // namespace bench
