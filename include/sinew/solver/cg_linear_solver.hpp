// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/solver/linear_system.hpp>
#include <sinew/state/vector_operations.hpp>

#include <cmath>
#include <vector>

namespace sinew {

/// Conjugate gradients (Hestenes, Stiefel 1952) from x = 0, or with `warmStart` from the last solution.
/// `Matrix`: GraphScattered, or a CompressedRowSparseMatrix into which the system is assembled once a step.
/// Where all states are on a device, so is the solver, and its matrix, of their precision; `residuals` then
/// stays empty.
template <class Matrix = GraphScattered>
struct CGLinearSolver {
  using Role = role::LinearSolver;
  static constexpr std::string_view className = "CGLinearSolver";
  static constexpr std::string_view templateName = Matrix::name;
  static constexpr std::string_view aliases = "CGSolver ConjugateGradient";
  static constexpr bool matrixFree = std::is_same_v<Matrix, GraphScattered>, needsPattern = !matrixFree;
  static constexpr Auxiliary auxiliary{.derivs = matrixFree ? 3 : 0};

  int iterations = 25;      // at most
  double tolerance = 1e-5;  // ends at |b - A x| <= tolerance |b|
  double threshold = 0;     // ends at |p.A p| <= threshold
  bool warmStart = false;

  static constexpr auto fields() {
    using S = CGLinearSolver;
    return field_list(
        field("iterations", &S::iterations, "", "largest number of iterations", range::atLeast(1))
            .also("maxIter"),
        field("tolerance",
              &S::tolerance,
              "",
              "relative residual at which to stop; 0 does all iterations",
              range::nonNegative),
        field("threshold",
              &S::threshold,
              "",
              "smallest curvature p.A p with which to go on",
              range::nonNegative)
            .also("smallDenominatorThreshold"),
        field("warmStart",
              &S::warmStart,
              "",
              "start from the solution of the last system, instead of 0; not on a device"));
  }

  std::vector<double>
      residuals{};        // |b - A x| / |b| of the last solve: at the start, then after each iteration
  MatrixFactors last{};   // of the last solve
  bool notBegun = false;  // the last solve ended at its first direction, by the threshold

  using Vector =
      Eigen::Matrix<typename std::conditional_t<matrixFree, CompressedRowSparseMatrixd, Matrix>::Real,
                    Eigen::Dynamic, 1>;
  struct Nothing {};
  struct Assembled {
    Matrix matrix{};
    Vector x{}, b{}, r{}, p{}, q{};
  };
  std::conditional_t<matrixFree, Nothing, Assembled> system{};

  template <class Operations>
  void init(Operations& operations) {
    reserve_residuals(residuals, iterations);
    if (states_solve(operations, !matrixFree, true)) {
      if (warmStart) throw Error(className, "warmStart is not there on a device; leave it out");
      return;
    }
    if constexpr (!matrixFree) {
      operations.initMatrix(system.matrix);
      for (Vector* v : {&system.x, &system.b, &system.r, &system.p, &system.q})
        v->setZero(system.matrix.dofs() + 1);  // the last stays 0: multiply reads it
    }
  }

  template <class Operations>
  void solve(Operations& operations, MatrixFactors factors, MultiVecDeriv<Operations>& x,
             MultiVecDeriv<Operations>& b) {
    last = factors;
    if (states_solve(operations, !matrixFree)) return let_states_solve(*this, operations, factors, x, b);
    if constexpr (!matrixFree) operations.assemble(system.matrix, factors);
    run(operations, x, b, warmStart);
  }
  /// With the matrix of the last solve, from x = 0.
  template <class Operations>
  void solveAgain(Operations& operations, MultiVecDeriv<Operations>& x, MultiVecDeriv<Operations>& b) {
    if (states_solve(operations, !matrixFree)) return let_states_solve(*this, operations, last, x, b);
    run(operations, x, b, false);
  }

 private:
  template <class Operations>
  void run(Operations& operations, MultiVecDeriv<Operations>& x, MultiVecDeriv<Operations>& b, bool warm) {
    if constexpr (matrixFree) {
      MultiVecDeriv r(operations), p(operations), q(operations);
      r.eq(b);
      const double whole = b.dot(b);
      if (warm && whole > 0) {
        operations.projectResponse(x.id);
        q.clear();
        operations.addMBKdx(q.id, x.id, last);
        operations.projectResponse(q.id);
        r.peq(q, -1);
      } else {
        x.clear();
      }
      p.eq(r);
      iterate(
          warm ? r.dot(r) : whole,
          whole,
          [&] {
            q.clear();
            operations.addMBKdx(q.id, p.id, last);
            operations.projectResponse(q.id);
            return p.dot(q);
          },
          [&](double alpha) { return operations.advance(x.id, p.id, r.id, q.id, alpha); },
          [&](double beta) { operations.xpay(p.id, r.id, beta); });
    } else {
      auto& s = system;
      using Real = typename Matrix::Real;
      const auto workers = operations.workers();
      operations.gather(s.b, b.id);
      s.r = s.b;
      const double whole = double(vec::squared_norm(s.b));
      if (warm && whole > 0) {
        operations.projectResponse(x.id);
        operations.gather(s.x, x.id);
        s.matrix.multiply(workers, s.x.data(), s.q.data());
        s.r -= s.q;
      } else {
        s.x.setZero();
      }
      s.p = s.r;
      iterate(
          warm ? double(vec::squared_norm(s.r)) : whole,
          whole,
          [&] { return s.matrix.multiply(workers, s.p.data(), s.q.data()); },
          [&](double alpha) { return vec::advance(workers, s.x, s.p, s.r, s.q, Real(alpha)); },
          [&](double beta) { vec::xpay(workers, s.p, s.r, Real(beta)); });
      operations.scatter(x.id, s.x);
    }
  }
  // rho = r.r, whole = b.b;  multiply: q = A p, returns p.q;  advance: x += alpha p, r -= alpha q, returns
  // r.r; xpay: p = r + beta p
  template <class Multiply, class Advance, class Xpay>
  void iterate(double rho, double whole, Multiply&& multiply, Advance&& advance, Xpay&& xpay) {
    residuals.clear();
    keep_residual(residuals, rho == whole ? 1 : std::sqrt(rho / whole));
    if (!std::isfinite(rho) || !std::isfinite(whole)) advance(notSolved);
    notBegun = false;
    for (int i = 0; i < iterations; ++i) {
      if (!(rho > tolerance * tolerance * whole)) return;
      const double curvature = multiply();
      if (std::abs(curvature) <= threshold) {
        notBegun = i == 0 && threshold > 0;
        return;
      }
      const double next = advance(std::isfinite(curvature) ? rho / curvature : notSolved);
      xpay(next / rho);
      rho = next;
      keep_residual(residuals, std::sqrt(rho / whole));
    }
  }
};

}  // namespace sinew
