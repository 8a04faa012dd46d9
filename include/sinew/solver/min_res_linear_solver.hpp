// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/solver/linear_system.hpp>

#include <string_view>
#include <utility>
#include <vector>

namespace sinew {

/// The minimal residual method (Paige, Saunders 1975) from x = 0, for symmetric systems that need not be
/// definite: Lanczos vectors v, A V_k = V_k+1 T_k, and the residual |b - A x| smallest over the Krylov space
/// in each step, by plane rotations of T_k. `Matrix` as in CGLinearSolver.
template <class Matrix = GraphScattered>
struct MinResLinearSolver {
  using Role = role::LinearSolver;
  static constexpr std::string_view className = "MinResLinearSolver";
  static constexpr std::string_view templateName = Matrix::name;
  static constexpr std::string_view aliases = "MINRESSolver MinResSolver";
  static constexpr bool matrixFree = std::is_same_v<Matrix, GraphScattered>, needsPattern = !matrixFree;
  static constexpr Auxiliary auxiliary{.derivs = matrixFree ? 4 : 0};

  int iterations = 25;      // at most
  double tolerance = 1e-5;  // ends at |b - A x| <= tolerance |b|

  static constexpr auto fields() {
    using S = MinResLinearSolver;
    return field_list(
        field("iterations", &S::iterations, "", "largest number of iterations", range::atLeast(1)),
        field("tolerance",
              &S::tolerance,
              "",
              "relative residual at which to stop; 0 does all iterations",
              range::nonNegative));
  }

  std::vector<double>
      residuals{};       // |b - A x| / |b| of the last solve: at the start, then after each iteration
  MatrixFactors last{};  // of the last solve

  using Vector =
      Eigen::Matrix<typename std::conditional_t<matrixFree, CompressedRowSparseMatrixd, Matrix>::Real,
                    Eigen::Dynamic, 1>;
  struct Nothing {};
  struct Assembled {
    Matrix matrix{};
    Vector x{}, b{}, product{}, v[2]{}, w[2]{};
  };
  std::conditional_t<matrixFree, Nothing, Assembled> system{};

  template <class Operations>
  void init(Operations& operations) {
    reserve_residuals(residuals, iterations);
    if constexpr (!matrixFree) {
      auto& s = system;
      operations.initMatrix(s.matrix);
      for (Vector* v : {&s.x, &s.b, &s.product, &s.v[0], &s.v[1], &s.w[0], &s.w[1]})
        v->setZero(s.matrix.dofs() + 1);  // the last stays 0: multiply reads it
    }
  }

  template <class Operations>
  void solve(Operations& operations, MatrixFactors factors, MultiVecDeriv<Operations>& x,
             MultiVecDeriv<Operations>& b) {
    last = factors;
    if constexpr (!matrixFree) operations.assemble(system.matrix, factors);
    solveAgain(operations, x, b);
  }
  /// With the matrix of the last solve.
  template <class Operations>
  void solveAgain(Operations& operations, MultiVecDeriv<Operations>& x, MultiVecDeriv<Operations>& b) {
    if constexpr (matrixFree) {
      MultiVecDeriv v0(operations), v1(operations), w0(operations), w1(operations);
      iterate(x, b, &v0, &v1, &w0, &w1, [&](auto& r, auto& v) {
        operations.addMBKdx(r.id, v.id, last);
        operations.projectResponse(r.id);
      });
    } else {
      auto& s = system;
      operations.gather(s.b, b.id);
      SystemVec<Vector> sx{s.x}, sb{s.b}, v0{s.v[0]}, v1{s.v[1]}, w0{s.w[0]}, w1{s.w[1]};
      iterate(sx, sb, &v0, &v1, &w0, &w1, [&](auto& r, auto& v) {
        s.matrix.multiply(operations.workers(), v.v.data(), s.product.data());
        r.v += s.product;
      });
      operations.scatter(x.id, s.x);
    }
  }

 private:
  // addProduct(r, v): r += A v
  template <class V, class Product>
  void iterate(V& x, V& b, V* vOld, V* v, V* wOlder, V* wOld, Product&& addProduct) {
    const double start = std::sqrt(b.dot(b));
    double beta = start, eta = start;         // |next Lanczos vector|, signed residual
    double c = 1, cOld = 1, s = 0, sOld = 0;  // the last two rotations
    residuals.clear();
    keep_residual(residuals, 1);
    for (V* zero : {&x, vOld, wOlder, wOld}) zero->clear();
    v->eq(b);
    if (!std::isfinite(start)) x.eq(b, notSolved);
    for (int i = 0; i < iterations; ++i) {
      if (!(std::abs(eta) > tolerance * start) || !(beta > 0)) return;
      // alpha v, beta: the next column of T
      v->teq(1 / beta);
      vOld->teq(-beta);
      if (i == 0) vOld->clear();
      addProduct(*vOld, *v);
      const double alpha = v->dot(*vOld);
      vOld->peq(*v, -alpha);
      const double betaNext = std::sqrt(vOld->dot(*vOld));
      // the two rotations before this one, and the one that clears betaNext
      const double delta = c * alpha - cOld * s * beta, r1 = std::hypot(delta, betaNext),
                   r2 = s * alpha + cOld * c * beta, r3 = sOld * beta;
      if (!std::isfinite(r1)) return x.eq(b, notSolved);
      if (r1 <= 0) return;  // singular, and no direction left
      cOld = std::exchange(c, delta / r1);
      sOld = std::exchange(s, betaNext / r1);
      // w = (v - r3 w[-2] - r2 w[-1]) / r1
      wOlder->teq(-r3 / r1);
      wOlder->peq(*wOld, -r2 / r1);
      wOlder->peq(*v, 1 / r1);
      std::swap(wOld, wOlder);
      x.peq(*wOld, c * eta);
      eta *= -s;
      beta = betaNext;
      std::swap(v, vOld);
      keep_residual(residuals, std::abs(eta) / start);
    }
  }
};

}  // namespace sinew
