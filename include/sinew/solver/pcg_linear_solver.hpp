// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/core/phase.hpp>
#include <sinew/linalg/preconditioner.hpp>
#include <sinew/solver/linear_system.hpp>
#include <sinew/solver/multigrid_fields.hpp>
#include <sinew/solver/point_rotations.hpp>
#include <sinew/solver/rigid_modes.hpp>

#include <string_view>
#include <vector>

namespace sinew {

/// Preconditioned conjugate gradients (Shewchuk 1994, B3) from x = 0. `Matrix` as in CGLinearSolver; with
/// GraphScattered products go through the scene graph, and the matrix is assembled for the preconditioner
/// only, once in `update_step` solves.
///
/// A preconditioner P that is kept for several solves is that of a body as it stood. With `warp` it rotates
/// with the body: R P^-1 R' is applied, R the rotation of each point's neighbourhood since P was made, as the
/// positions tell it (Courtecuisse, Allard, Duriez, Cotin 2010; there P is made by another thread meanwhile).
///
/// Over states on a device, jacobi and blockJacobi stay there, made of the elements and masses of the bodies
/// themselves (what mapped bodies add is left out), and `residuals` stays empty; other preconditioners are
/// those of the host, by copies.
template <class Matrix = GraphScattered>
struct ShewchukPCGLinearSolver {
  using Role = role::LinearSolver;
  static constexpr std::string_view className = "ShewchukPCGLinearSolver";
  static constexpr std::string_view templateName = Matrix::name;
  static constexpr std::string_view aliases = "PCGLinearSolver";
  static constexpr bool matrixFree = std::is_same_v<Matrix, GraphScattered>;
  static constexpr Auxiliary auxiliary{.derivs = matrixFree ? 3 : 0};
  using Formed = std::conditional_t<matrixFree, CompressedRowSparseMatrixMat3x3d, Matrix>;

  int iterations = 25;      // at most
  double tolerance = 1e-5;  // ends at |b - A x| <= tolerance |b|
  bool usePrecond = true;
  int updateStep = 1;  // the preconditioner is made anew in every so many solves; 0: in the first only
  bool buildPrecond = true;
  PreconditionerMethod precondition = PreconditionerMethod::blockJacobi;
  double omega = 1;
  bool warp = false;
  int levels = 10, coarsestSize = 200;
  double strengthThreshold = 0.05;
  int smootherDegree = 2, coarseCycles = 1;

  static constexpr auto fields() {
    using S = ShewchukPCGLinearSolver;
    return multigrid_fields<S>(
        field("iterations", &S::iterations, "", "largest number of iterations", range::atLeast(1)),
        field("tolerance",
              &S::tolerance,
              "",
              "relative residual at which to stop; 0 does all iterations",
              range::nonNegative),
        field("use_precond", &S::usePrecond, "", "use the preconditioner"),
        field("update_step",
              &S::updateStep,
              "",
              "solves from one update of the preconditioner to the next",
              range::nonNegative),
        field("build_precond", &S::buildPrecond, "", "update the preconditioner after the first solve"),
        field("precondition", &S::precondition, "", "what it is made of"),
        field("omega", &S::omega, "", "relaxation of ssor", range::open(0, 2)),
        field("warp", &S::warp, "", "a preconditioner that is kept rotates with each point's neighbourhood"));
  }

  std::vector<double>
      residuals{};  // |b - A x| / |b| of the last solve: at the start, then after each iteration

  using Vector = Eigen::Matrix<typename Formed::Real, Eigen::Dynamic, 1>;
  Formed matrix{};
  Preconditioner<Formed> preconditioner{};
  PointRotations rotations{};
  Vector rotated{};  // R' r
  Vector x{}, b{}, r{}, p{}, q{};
  int age = -1;          // solves since the preconditioner was made
  MatrixFactors last{};  // of the last solve

  template <class Operations>
  void init(Operations& operations) {
    reserve_residuals(residuals, iterations);
    age = -1;
    if (statesSolve(operations, true)) return;
    operations.initMatrix(matrix);
    preconditioner.multigrid.settings = multigrid_settings(*this);
    preconditioner.init(matrix, method(), matrix.dofs(), some_workers(operations.workers()));
    if (method() == PreconditionerMethod::multigrid)
      prepare_multigrid(operations, matrix, preconditioner.multigrid);
    preconditioner.omega = omega;
    if (warp) rotations.init(operations, matrix);
    for (Vector* v : {&x, &b, &r, &p, &q, &rotated})
      v->setZero(matrix.dofs() + 1);  // the last stays 0: multiply reads it
  }

  PreconditionerMethod method() const { return usePrecond ? precondition : PreconditionerMethod::none; }

  /// The preconditioner is made anew.
  void reset() { age = -1; }
  /// That of the preconditioner, where it is the inverse of the matrix of the last solve.
  BlockLdl<Formed> const* blockFactor() const {
    const bool isInverse = preconditioner.method == PreconditionerMethod::ldl && preconditioner.shift == 0;
    return isInverse && age == 0 ? &preconditioner.factor : nullptr;
  }

  template <class Operations>
  void solve(Operations& operations, MatrixFactors factors, MultiVecDeriv<Operations>& solution,
             MultiVecDeriv<Operations>& rhs) {
    last = factors;
    const bool update = method() != PreconditionerMethod::none &&
                        (age < 0 || (buildPrecond && updateStep > 0 && age + 1 >= updateStep));
    if (statesSolve(operations)) {
      age = update ? 0 : age + 1;
      return let_states_solve(*this, operations, factors, solution, rhs);
    }
    if (update || !matrixFree) operations.assemble(matrix, factors);
    if (update) {
      [[maybe_unused]] const auto span = operations.root.span(Phase::factorisation);
      if (method() == PreconditionerMethod::multigrid)
        rigid_modes(operations, preconditioner.multigrid.modes);
      preconditioner.update(matrix, some_workers(operations.workers()));
    }
    age = update ? 0 : age + 1;
    if (warp && update) rotations.reset(operations);
    if (warp && age > 0) rotations.update(operations);
    solveAgain(operations, solution, rhs);
  }
  /// With the matrix and the preconditioner of the last solve.
  template <class Operations>
  void solveAgain(Operations& operations, MultiVecDeriv<Operations>& solution,
                  MultiVecDeriv<Operations>& rhs) {
    if (statesSolve(operations)) return let_states_solve(*this, operations, last, solution, rhs);
    if constexpr (matrixFree) {
      MultiVecDeriv res(operations), dir(operations), product(operations);
      iterate(
          solution,
          rhs,
          res,
          dir,
          product,
          [&](auto& to, auto& from) {
            to.clear();
            operations.addMBKdx(to.id, from.id, last);
            operations.projectResponse(to.id);
          },
          [&](auto& to, auto& from) {
            if (preconditioner.method == PreconditionerMethod::none) return to.eq(from);
            operations.gather(r, from.id);
            apply(r, q, some_workers(operations.workers()));
            operations.scatter(to.id, q);
            if (warp) operations.projectResponse(to.id);  // which need not commute with R
          });
    } else {
      operations.gather(b, rhs.id);
      SystemVec<Vector> sx{x}, sb{b}, res{r}, dir{p}, product{q};
      iterate(
          sx,
          sb,
          res,
          dir,
          product,
          [&](auto& to, auto& from) { matrix.multiply(operations.workers(), from.v.data(), to.v.data()); },
          [&](auto& to, auto& from) {
            if (preconditioner.method == PreconditionerMethod::none) return to.eq(from);
            apply(from.v, to.v, some_workers(operations.workers()));
          });
      operations.scatter(solution.id, x);
    }
  }

 private:
  template <class Operations>
  bool statesSolve(Operations& operations, bool restart = false) const {
    return method() <= PreconditionerMethod::blockJacobi && states_solve(operations, !matrixFree, restart);
  }
  // z = P^-1 r, or R P^-1 R' r
  void apply(Vector const& from, Vector& to, SomeWorkers const& workers) {
    if (!warp || age == 0) return preconditioner.apply(from, to, workers);
    rotated = from;
    rotations.apply(rotated, true);
    preconditioner.apply(rotated, to, workers);
    rotations.apply(to, false);
  }
  // multiply(to, from): to = A from;  precondition(to, from): to = M^-1 from
  template <class V, class Multiply, class Precondition>
  void iterate(V& solution, V& rhs, V& res, V& dir, V& product, Multiply&& multiply,
               Precondition&& approximate) {
    const double start = rhs.dot(rhs);
    residuals.clear();
    keep_residual(residuals, 1);
    solution.clear();
    res.eq(rhs);
    approximate(dir, res);
    double rho = res.dot(dir), size = start;
    if (!std::isfinite(start)) solution.eq(rhs, notSolved);
    for (int i = 0; i < iterations; ++i) {
      if (!(size > tolerance * tolerance * start)) return;
      multiply(product, dir);
      const double curvature = dir.dot(product);
      if (curvature == 0) return;
      const double alpha = std::isfinite(curvature) ? rho / curvature : notSolved;
      solution.peq(dir, alpha);
      res.peq(product, -alpha);
      size = res.dot(res);
      keep_residual(residuals, std::sqrt(size / start));
      approximate(product, res);
      const double next = res.dot(product);
      dir.teq(next / rho);
      dir.peq(product);
      rho = next;
    }
  }
};

}  // namespace sinew
