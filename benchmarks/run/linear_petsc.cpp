// SPDX-License-Identifier: BSL-1.0
#include "linear_system.hpp"
#include "paired.hpp"

#include <petscksp.h>

#include <algorithm>
#include <string_view>

namespace bench {

LinearResult solve_by_petsc(LinearSystem const& s, char const* preconditioner) {
  PetscBool running = PETSC_FALSE;
  PetscInitialized(&running);
  if (!running) PetscInitializeNoArguments();
  LinearResult result;
  const PetscInt n = s.unknowns, points = n / 3;
  // blocks of the points that are joined
  std::vector<PetscInt> starts{0}, columns;
  for (PetscInt i = 0; i < points; ++i) {
    for (int k = s.starts[std::size_t(3 * i)]; k < s.starts[std::size_t(3 * i) + 1]; k += 3)
      columns.push_back(s.columns[std::size_t(k)] / 3);
    starts.push_back(PetscInt(columns.size()));
  }
  std::vector<PetscScalar> blocks;
  for (PetscInt i = 0; i < points; ++i)
    for (PetscInt k = 0; k < starts[std::size_t(i) + 1] - starts[std::size_t(i)]; ++k)
      for (PetscInt r = 0; r < 3; ++r)
        for (PetscInt c = 0; c < 3; ++c)
          blocks.push_back(s.values[std::size_t(s.starts[std::size_t(3 * i + r)] + 3 * k + c)]);
  Mat a;
  MatCreate(PETSC_COMM_SELF, &a);
  MatSetSizes(a, n, n, n, n);
  MatSetType(a, MATSEQAIJ);  // what GAMG is quickest with, and ML asks for
  MatSetBlockSize(a, 3);
  MatSeqAIJSetPreallocationCSR(a, s.starts.data(), s.columns.data(), s.values.data());
  MatSetOption(a, MAT_SPD, PETSC_TRUE);
  Vec places, b, x;
  VecCreateSeq(PETSC_COMM_SELF, n, &b);
  VecSetBlockSize(b, 3);
  VecDuplicate(b, &x);
  VecDuplicate(b, &places);
  auto fill = [](Vec v, std::vector<double> const& from) {
    PetscScalar* to = nullptr;
    VecGetArray(v, &to);
    std::copy(from.begin(), from.end(), to);
    VecRestoreArray(v, &to);
  };
  fill(places, s.places);
  fill(b, s.rhs);
  MatNullSpace rigid;
  MatNullSpaceCreateRigidBody(places, &rigid);
  MatSetNearNullSpace(a, rigid);
  KSP solver;
  PC cycle;
  KSPCreate(PETSC_COMM_SELF, &solver);
  KSPSetOperators(solver, a, a);
  KSPSetType(solver, KSPCG);
  KSPSetNormType(solver, KSP_NORM_UNPRECONDITIONED);
  KSPSetTolerances(solver, linearTolerance, 0, PETSC_DEFAULT, 2000);
  KSPGetPC(solver, &cycle);
  PCSetType(cycle, preconditioner);
  // without it ml has no number of levels; gamg gets other defaults by it, which take more iterations
  if (preconditioner == std::string_view("ml")) PCSetFromOptions(cycle);
  result.setUp = processor_seconds([&] { KSPSetUp(solver); });
  result.solve = processor_seconds([&] { KSPSolve(solver, b, x); });
  PetscInt iterations = 0;
  KSPGetIterationNumber(solver, &iterations);
  result.iterations = int(iterations);
  PetscScalar const* from = nullptr;
  VecGetArrayRead(x, &from);
  result.x.assign(from, from + n);
  VecRestoreArrayRead(x, &from);
  KSPDestroy(&solver);
  MatNullSpaceDestroy(&rigid);
  for (Vec* v : {&places, &b, &x}) VecDestroy(v);
  MatDestroy(&a);
  return result;
}

}  // namespace bench
