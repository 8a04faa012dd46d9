// SPDX-License-Identifier: BSL-1.0
#pragma once

// Needs PETSc (Debian: petsc-dev), which has a licence of its own (BSD), as have the libraries in it. Not in
// sinew.hpp; CMake's target sinew::mpi, there where PETSc is installed, brings it.
#include <sinew/core/phase.hpp>
#include <sinew/mpi/rank_multigrid.hpp>
#include <sinew/solver/linear_system.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <exception>
#include <functional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace sinew {

/// The assembled system, solved by one of PETSc's Krylov methods with one of its preconditioners, by the
/// names that PETSc has for them (KSPSetType, PCSetType: Balay et al., PETSc/TAO users manual 3.18), and of a
/// distributed scene by all ranks together. The residual is |b - A x|, where the method has that (cg, fcg,
/// gmres, fgmres, bcgs, gcr), else what it takes by itself. `options` is what PETSc's command line would
/// have, such as
/// "-pc_hypre_type boomeramg"; for a direct method take solver="preonly" with preconditioner="cholesky", or
/// "lu". With the preconditioner "multigrid" each rank has Sinew's own for what is its, and all of them the
/// rigid motions of their parts as a coarse level (RankMultigrid); with the matrix "free" there is none, and
/// products go through the scene. The near null space of the matrix, which multigrid by aggregation (gamg)
/// asks for, is the rigid motions of points in space. Throws Error at names and options that PETSc does not
/// know, and where a solve does not converge. What is Sinew's allocates at init only; PETSc makes its own
/// multigrids, and what its methods need of vectors, in solves.
template <class Matrix = CompressedRowSparseMatrixMat3x3d>
struct PetscLinearSolver {
  using Role = role::LinearSolver;
  static constexpr std::string_view className = "PetscLinearSolver";
  static constexpr std::string_view header = "sinew/mpi/petsc_linear_solver.hpp";
  static constexpr std::string_view templateName = Matrix::name;
  static constexpr Auxiliary auxiliary{.derivs = 2};  // of products without a matrix

  std::string solver = "cg", preconditioner = "pbjacobi";
  double tolerance = 1e-8;
  int iterations = 10000;
  bool warmStart = false;
  std::string matrix = "baij", options{};

  static constexpr auto fields() {
    using S = PetscLinearSolver;
    return field_list(
        field("solver", &S::solver, "", "PETSc's name of the method: cg, gmres, minres, preonly..."),
        field("preconditioner",
              &S::preconditioner,
              "",
              "PETSc's name of the preconditioner: pbjacobi, bjacobi, gamg, hypre, cholesky, none..., or "
              "multigrid: Sinew's own"),
        field("tolerance", &S::tolerance, "", "relative residual at which to stop", range::positive),
        field("iterations",
              &S::iterations,
              "",
              "largest number of iterations; one that ends there has not converged",
              range::atLeast(1))
            .also("maxIter"),
        field("warmStart", &S::warmStart, "", "start from the solution of the last system, instead of 0"),
        field("matrix",
              &S::matrix,
              "",
              "PETSc's name of the matrix: baij, in blocks, or aij, in scalars; free: there is none"),
        field("options", &S::options, "", "others of PETSc, as on its command line: -name value ..."));
  }

  using Vector = Eigen::Matrix<typename Matrix::Real, Eigen::Dynamic, 1>;
  Matrix local{};
  Vector x{}, b{};
  mpi::PetscLayout layout{};
  mpi::Petsc<::Mat, MatDestroy> system{};
  mpi::Petsc<::Vec, VecDestroy> solution{}, rightSide{};
  mpi::Petsc<KSP, KSPDestroy> method{};
  mpi::Petsc<PetscOptions, PetscOptionsDestroy> ofPetsc{};
  std::vector<PetscInt> columns{};
  std::vector<PetscScalar> values{};
  std::string where{};
  bool optionsAreRead = false;
  mpi::RankMultigrid<Matrix> multigrid{};
  // what PETSc calls in a solve, and what has come of it
  using Call = std::function<void(PetscScalar const*, PetscScalar*)>;
  Call multiply{}, precondition{};
  std::exception_ptr thrown{};
  MatrixFactors last{};
  // of the last solve
  int iterationsTaken = 0;
  double residual = 0;

  template <class Operations>
  void init(Operations& operations) {
    where = text(operations.root.path(), ": ", className);
    mpi::start_petsc();
    checkName(KSPList, solver, "solver", "method");
    if (!ownMultigrid()) checkName(PCList, preconditioner, "preconditioner", "preconditioner");
    if (matrix != "baij" && matrix != "aij" && !matrixFree())
      throw Error(where, text("matrix is '", matrix, "', but has to be baij, aij or free"));
    if (matrixFree() && preconditioner != "none")
      throw Error(where,
                  text("preconditioner is '",
                       preconditioner,
                       "', which is made of a matrix, and matrix is free; take none, or a matrix"));
    if constexpr (std::decay_t<decltype(operations.root)>::distributed)
      if (!operations.root.distribution().active()) return;  // the whole scene is about to be shared out
    const int dofs = matrixFree() ? operations.numberDofs(B) : 0;
    if (!matrixFree()) operations.initMatrix(local);
    x.setZero(matrixFree() ? dofs : local.dofs());
    b.setZero(x.size());
    MPI_Comm ranks = PETSC_COMM_SELF;
    if constexpr (std::decay_t<decltype(operations.root)>::distributed) {
      ranks = operations.root.distribution().ranks().handle();
      operations.root.distribution().layout(operations, layout, Matrix::blockSize, where);
    } else {
      const PetscInt n = PetscInt(x.size() / B);
      layout.global.resize(std::size_t(n));
      for (PetscInt i = 0; i < n; ++i) layout.global[std::size_t(i)] = i;
      layout.rows = layout.global;
      layout.begin = 0;
    }
    make(ranks, operations);
    prepare(operations);
  }

  template <class Operations>
  void solve(Operations& operations, MatrixFactors factors, MultiVecDeriv<Operations>& to,
             MultiVecDeriv<Operations>& from) {
    last = factors;
    {
      [[maybe_unused]] const auto span = operations.root.span(Phase::factorisation);
      if (!matrixFree()) operations.assemble(local, factors);
      meet(operations);
      if (!matrixFree()) fill();
      if (ownMultigrid()) multigrid.update(operations, local, layout, to.id);
    }
    run(operations, to, from, warmStart);
  }
  template <class Operations>
  void solveAgain(Operations& operations, MultiVecDeriv<Operations>& to, MultiVecDeriv<Operations>& from) {
    meet(operations);
    run(operations, to, from, false);
  }

 private:
  static constexpr int B = Matrix::blockSize;
  template <class Operations>
  static constexpr bool distributes = std::decay_t<decltype(std::declval<Operations&>().root)>::distributed;

  bool matrixFree() const { return matrix == "free"; }
  bool ownMultigrid() const { return preconditioner == "multigrid"; }

  // y = f(x) for PETSc. What f throws is thrown again behind it.
  static PetscErrorCode called(PetscLinearSolver& self, Call const& f, ::Vec x, ::Vec y) {
    PetscScalar const* from = nullptr;
    PetscScalar* to = nullptr;
    if (VecGetArrayRead(x, &from) != 0 || VecGetArray(y, &to) != 0) return PETSC_ERR_LIB;
    PetscErrorCode code = 0;
    try {
      f(from, to);
    } catch (...) {
      self.thrown = std::current_exception();
      code = PETSC_ERR_USER;
    }
    VecRestoreArrayRead(x, &from);
    VecRestoreArray(y, &to);
    return code;
  }
  static PetscErrorCode calledMultiply(::Mat a, ::Vec x, ::Vec y) {
    void* self = nullptr;
    if (MatShellGetContext(a, static_cast<void*>(&self)) != 0) return PETSC_ERR_LIB;
    auto& solver = *static_cast<PetscLinearSolver*>(self);
    return called(solver, solver.multiply, x, y);
  }
  static PetscErrorCode calledPrecondition(PC pc, ::Vec x, ::Vec y) {
    void* self = nullptr;
    if (PCShellGetContext(pc, static_cast<void*>(&self)) != 0) return PETSC_ERR_LIB;
    auto& solver = *static_cast<PetscLinearSolver*>(self);
    return called(solver, solver.precondition, x, y);
  }

  void check(PetscErrorCode code) const { mpi::check_petsc(code, where); }

  // PETSc waits for other ranks without end: none goes there before all do
  template <class Operations>
  static void meet([[maybe_unused]] Operations& operations) {
    if constexpr (std::decay_t<decltype(operations.root)>::distributed)
      operations.root.distribution().ranks().meet("the other ranks, to solve a system by PETSc");
  }

  void checkName(PetscFunctionList list, std::string const& name, std::string_view field,
                 std::string_view what) const {
    const std::vector<std::string> known = mpi::names_of(list);
    if (std::find(known.begin(), known.end(), name) != known.end()) return;
    std::string all;
    for (auto const& k : known) all += text(all.empty() ? "" : " ", k);
    const std::string near = nearest_name(name, known);
    throw Error(where,
                text(field,
                     " is '",
                     name,
                     "', and this PETSc has no ",
                     what,
                     " of that name",
                     near.empty() ? std::string() : text("; did you mean '", near, "'?"),
                     near.empty() ? "; it has: " : " It has: ",
                     all));
  }

  template <class Operations>
  void make(MPI_Comm ranks, Operations& operations) {
    if (matrixFree())
      makeFree(ranks);
    else
      makeMatrix(ranks, operations);
    makeMethod(ranks);
    if (ownMultigrid()) multigrid.init(operations, local, layout);
  }
  // What can be made before there is a matrix of a step: multigrid from the stiffness as it is now, and what
  // PETSc keeps of the pattern, from ones on the diagonal. Its own multigrids are made anew in each solve.
  template <class Operations>
  void prepare(Operations& operations) {
    if (ownMultigrid())
      operations.withMatrixAtInit(
          local, {.m = 1, .k = -1e4}, [&] { multigrid.update(operations, local, layout, vec_id::dx); });
    constexpr std::array<std::string_view, 12> keep{"multigrid",
                                                    "none",
                                                    "jacobi",
                                                    "pbjacobi",
                                                    "bjacobi",
                                                    "asm",
                                                    "sor",
                                                    "eisenstat",
                                                    "ilu",
                                                    "icc",
                                                    "lu",
                                                    "cholesky"};
    if (matrixFree() || std::find(keep.begin(), keep.end(), preconditioner) == keep.end()) return;
    local.setZero();
    for (int dof = 0; dof < local.dofs(); ++dof) local.fix(dof);
    meet(operations);
    fill();
    check(KSPSetUp(method));
    check(KSPSetUpOnBlocks(method));
  }
  void makeFree(MPI_Comm ranks) {
    const PetscInt n = layout.blocks() * B;
    check(MatCreateShell(ranks, n, n, PETSC_DETERMINE, PETSC_DETERMINE, nullptr, system.fresh()));
    check(MatShellSetOperation(system, MATOP_MULT, reinterpret_cast<void (*)(void)>(&calledMultiply)));
    check(MatSetOption(system, MAT_SYMMETRIC, PETSC_TRUE));
    check(MatCreateVecs(system, solution.fresh(), rightSide.fresh()));
  }
  template <class Operations>
  void makeMatrix(MPI_Comm ranks, Operations& operations) {
    const PetscInt n = layout.blocks() * B;
    // blocks of each row, left of the own columns or right of them, and among them
    std::vector<PetscInt> own, other;
    std::size_t longest = 0;
    for (const PetscInt row : layout.rows) {
      PetscInt here = 0, there = 0;
      local.forEachInRow(int(row), [&](int column, int, bool) {
        const PetscInt c = layout.global[std::size_t(column)] - layout.begin;
        ++(c >= 0 && c < layout.blocks() ? here : there);
      });
      own.push_back(here);
      other.push_back(there);
      longest = std::max(longest, std::size_t(here + there));
    }
    columns.assign(longest, 0);
    values.assign(longest * B * B, 0);
    check(MatCreate(ranks, system.fresh()));
    check(MatSetSizes(system, n, n, PETSC_DETERMINE, PETSC_DETERMINE));
    check(MatSetType(system, matrix == "baij" ? MATBAIJ : MATAIJ));
    check(MatSetBlockSize(system, B));
    check(MatXAIJSetPreallocation(system, B, own.data(), other.data(), nullptr, nullptr));
    check(MatSetOption(system, MAT_ROW_ORIENTED, PETSC_TRUE));
    check(MatSetOption(system, MAT_SYMMETRIC, PETSC_TRUE));
    check(MatSetOption(system, MAT_SYMMETRY_ETERNAL, PETSC_TRUE));
    check(MatSetOption(system, MAT_NEW_NONZERO_ALLOCATION_ERR, PETSC_TRUE));
    check(MatCreateVecs(system, solution.fresh(), rightSide.fresh()));
    giveRigidMotions(operations);
  }
  void makeMethod(MPI_Comm ranks) {
    check(KSPCreate(ranks, method.fresh()));
    check(KSPSetOperators(method, system, system));
    check(KSPSetType(method, solver.c_str()));
    constexpr std::array<std::string_view, 6> trueResidual{"cg", "fcg", "gmres", "fgmres", "bcgs", "gcr"};
    if (std::find(trueResidual.begin(), trueResidual.end(), solver) != trueResidual.end())
      check(KSPSetNormType(method, KSP_NORM_UNPRECONDITIONED));
    check(KSPSetTolerances(method, tolerance, 0, PETSC_DEFAULT, iterations));
    PC pc = nullptr;
    check(KSPGetPC(method, &pc));
    check(PCSetType(pc, ownMultigrid() ? PCSHELL : preconditioner.c_str()));
    if (ownMultigrid()) check(PCShellSetApply(pc, &calledPrecondition));
    check(PetscOptionsCreate(ofPetsc.fresh()));
    check(PetscOptionsInsertString(ofPetsc, options.c_str()));
    for (PetscObject o : {reinterpret_cast<PetscObject>(KSP(method)), reinterpret_cast<PetscObject>(pc)})
      check(PetscObjectSetOptions(o, ofPetsc));
    check(KSPSetFromOptions(method));
    optionsAreRead = false;
  }
  // of points in space, at rest
  template <class Operations>
  void giveRigidMotions(Operations& operations) {
    bool points = B == 3;
    std::vector<PetscScalar> places;
    operations.forEachIndependent([&](auto& s) {
      using D = typename std::decay_t<decltype(s)>::DataTypes;
      if constexpr (!D::rigid && D::size == 3 && D::spatial == 3) {
        for (std::size_t i = 0; i < s.owned(); ++i)
          for (int c = 0; c < 3; ++c) places.push_back(PetscScalar(s.restPosition[i][c]));
      } else {
        points = false;
      }
    });
    if (!points || PetscInt(places.size()) != layout.blocks() * B) return;
    mpi::Petsc<::Vec, VecDestroy> coordinates;
    mpi::Petsc<MatNullSpace, MatNullSpaceDestroy> rigid;
    check(VecDuplicate(solution, coordinates.fresh()));
    check(VecSetBlockSize(coordinates, 3));
    put(coordinates, [&](PetscInt i) { return places[std::size_t(i)]; });
    check(MatNullSpaceCreateRigidBody(coordinates, rigid.fresh()));
    check(MatSetNearNullSpace(system, rigid));
  }

  void fill() {
    PetscInt row = layout.begin;
    for (const PetscInt here : layout.rows) {
      // a row of blocks, each scalar row over all of them
      std::size_t n = 0;
      local.forEachInRow(int(here),
                         [&](int column, int, bool) { columns[n++] = layout.global[std::size_t(column)]; });
      std::size_t k = 0;
      local.forEachInRow(int(here), [&](int, int slot, bool transposed) {
        auto const* const block = std::as_const(local).block(slot);
        for (std::size_t r = 0; r < B; ++r)
          for (std::size_t c = 0; c < B; ++c)
            values[r * n * B + k * B + c] = PetscScalar(block[transposed ? c * B + r : r * B + c]);
        ++k;
      });
      check(MatSetValuesBlocked(system, 1, &row, PetscInt(n), columns.data(), values.data(), INSERT_VALUES));
      ++row;
    }
    check(MatAssemblyBegin(system, MAT_FINAL_ASSEMBLY));
    check(MatAssemblyEnd(system, MAT_FINAL_ASSEMBLY));
    check(KSPSetOperators(method, system, system));
  }

  // f(i) of each scalar of a vector that is this rank's
  template <class F>
  void put(::Vec vector, F&& f) const {
    PetscScalar* to = nullptr;
    PetscInt n = 0;
    check(VecGetLocalSize(vector, &n));
    check(VecGetArray(vector, &to));
    for (PetscInt i = 0; i < n; ++i) to[i] = f(i);
    check(VecRestoreArray(vector, &to));
  }
  std::size_t dofOf(PetscInt i) const {
    return std::size_t(layout.rows[std::size_t(i / B)]) * B + std::size_t(i % B);
  }

  template <class Operations>
  void run(Operations& operations, MultiVecDeriv<Operations>& to, MultiVecDeriv<Operations>& from,
           bool warm) {
    [[maybe_unused]] const auto span = operations.root.span(Phase::substitution);
    operations.gather(b, from.id);
    put(rightSide, [&](PetscInt i) { return PetscScalar(b[Eigen::Index(dofOf(i))]); });
    if (warm) {
      operations.projectResponse(to.id);
      operations.gather(x, to.id);
      put(solution, [&](PetscInt i) { return PetscScalar(x[Eigen::Index(dofOf(i))]); });
    }
    check(KSPSetInitialGuessNonzero(method, warm ? PETSC_TRUE : PETSC_FALSE));
    // this object may have come here as a copy of another one
    MultiVecDeriv<Operations> direction(operations), product(operations);
    // (by reference, which a std::function has room for)
    auto productOf = [&](PetscScalar const* in, PetscScalar* out) {
      takeScalars(in);
      operations.scatter(direction.id, x);
      product.clear();
      operations.addMBKdx(product.id, direction.id, last);
      operations.projectResponse(product.id);
      operations.gather(x, product.id);
      for (PetscInt i = 0; i < layout.blocks() * B; ++i) out[i] = PetscScalar(x[Eigen::Index(dofOf(i))]);
    };
    auto cycleOf = [&](PetscScalar const* in, PetscScalar* out) { multigrid.apply(operations, in, out); };
    if (matrixFree()) {
      check(MatShellSetContext(system, this));
      multiply = std::ref(productOf);
    }
    if (ownMultigrid()) {
      PC pc = nullptr;
      check(KSPGetPC(method, &pc));
      check(PCShellSetContext(pc, this));
      precondition = std::ref(cycleOf);
    }
    if constexpr (distributes<Operations>) operations.root.distribution().ranks().inside("a solver of PETSc");
    const PetscErrorCode code = KSPSolve(method, rightSide, solution);
    if constexpr (distributes<Operations>) operations.root.distribution().ranks().working();
    multiply = precondition = nullptr;
    if (thrown) std::rethrow_exception(std::exchange(thrown, nullptr));
    check(code);
    refuseUnread();
    refuseUnconverged();
    PetscScalar const* found = nullptr;
    check(VecGetArrayRead(solution, &found));
    takeScalars(found);
    check(VecRestoreArrayRead(solution, &found));
    operations.scatter(to.id, x);
  }

  // x at what is this rank's; zero elsewhere
  void takeScalars(PetscScalar const* from) {
    x.setZero();
    for (PetscInt i = 0; i < layout.blocks() * B; ++i)
      x[Eigen::Index(dofOf(i))] = typename Matrix::Real(from[i]);
  }

  // (some are read when the preconditioner is made, in the first solve)
  void refuseUnread() {
    if (optionsAreRead) return;
    optionsAreRead = true;
    PetscInt count = 0;
    char **names = nullptr, **given = nullptr;
    check(PetscOptionsLeftGet(ofPetsc, &count, &names, &given));
    const std::string first = count > 0 ? names[0] : "";
    check(PetscOptionsLeftRestore(ofPetsc, &count, &names, &given));
    if (!first.empty())
      throw Error(where,
                  text("options has -",
                       first,
                       ", which PETSc's ",
                       solver,
                       " with ",
                       preconditioner,
                       " does not read; correct its name, or leave it out"));
  }
  void refuseUnconverged() {
    KSPConvergedReason reason{};
    PetscInt taken = 0;
    PetscReal norm = 0, whole = 0;
    check(KSPGetConvergedReason(method, &reason));
    check(KSPGetIterationNumber(method, &taken));
    check(KSPGetResidualNorm(method, &norm));
    check(VecNorm(rightSide, NORM_2, &whole));
    iterationsTaken = int(taken);
    residual = whole > 0 ? norm / whole : norm;
    if (reason >= 0) return;
    const std::string name = text("PETSc's ", solver, " with ", preconditioner);
    if (!std::isfinite(whole))
      throw Error(where,
                  "the right-hand side has values that are not finite: the simulation diverged before; take "
                  "a smaller "
                  "dt, more damping or a softer material");
    switch (reason) {
      case KSP_DIVERGED_ITS:
        throw Error(where,
                    text(name,
                         " has not converged in ",
                         taken,
                         " iterations: |b - A x| is ",
                         residual,
                         " |b|, and tolerance is ",
                         tolerance,
                         "; give it more iterations, or take another preconditioner"));
      case KSP_DIVERGED_INDEFINITE_PC:
      case KSP_DIVERGED_INDEFINITE_MAT:
        throw Error(where,
                    text(name,
                         " needs a positive definite ",
                         reason == KSP_DIVERGED_INDEFINITE_MAT ? "matrix" : "preconditioner",
                         ", and this one is not; take solver minres or gmres, a smaller dt, or fix points of "
                         "the body"));
      case KSP_DIVERGED_PC_FAILED:
        throw Error(where,
                    text(name,
                         " found no preconditioner: a pivot vanishes; fix points of the body, give it mass "
                         "or stiffness, "
                         "or take another preconditioner"));
      default: {
        char const* words = nullptr;
        check(KSPGetConvergedReasonString(method, &words));
        throw Error(where,
                    text(name,
                         " has not converged (",
                         words ? words : "",
                         ") after ",
                         taken,
                         " iterations, with |b - A x| of ",
                         residual,
                         " |b|; take another solver or preconditioner"));
      }
    }
  }
};

}  // namespace sinew
