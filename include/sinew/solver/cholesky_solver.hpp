// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/core/phase.hpp>
#include <sinew/linalg/block_ldl.hpp>
#include <sinew/solver/linear_system.hpp>
#include <sinew/state/vector_operations.hpp>

#include <string_view>

namespace sinew {

/// The assembled system solved to rounding by a dense L D L', in n^3/3 operations: for systems of up to a few
/// hundred unknowns, positive definite or, as there is no pivoting, indefinite ones whose leading minors do
/// not vanish. Throws Error where one does.
template <class Matrix = CompressedRowSparseMatrixd>
struct CholeskySolver {
  using Role = role::LinearSolver;
  static constexpr std::string_view className = "CholeskySolver";
  static constexpr std::string_view templateName = Matrix::name;
  static constexpr Auxiliary auxiliary{};

  static constexpr auto fields() { return field_list(); }

  using Vector = Eigen::Matrix<typename Matrix::Real, Eigen::Dynamic, 1>;
  Matrix matrix{};
  Eigen::MatrixXd lower{};
  Vector x{}, b{};
  Eigen::VectorXd y{};

  template <class Operations>
  void init(Operations& operations) {
    operations.initMatrix(matrix);
    const int n = matrix.dofs();
    lower.setZero(n, n);
    y.setZero(n);
    x.setZero(matrix.dofs());
    b.setZero(matrix.dofs());
  }

  template <class Operations>
  void solve(Operations& operations, MatrixFactors factors, MultiVecDeriv<Operations>& solution,
             MultiVecDeriv<Operations>& rhs) {
    operations.assemble(matrix, factors);
    const int dof = [&] {
      [[maybe_unused]] const auto span = operations.root.span(Phase::factorisation);
      unpack();
      return factorise();
    }();
    if (dof >= 0)
      throw Error(text(operations.root.path(), ": ", className),
                  text("the matrix is singular at ",
                       dof_text(operations, dof),
                       ": nothing holds it there; fix points of the body, or give it mass or stiffness (if a "
                       "value is not finite, the simulation diverged before: take a smaller dt)"));
    solveAgain(operations, solution, rhs);
  }
  template <class Operations>
  void solveAgain(Operations& operations, MultiVecDeriv<Operations>& solution,
                  MultiVecDeriv<Operations>& rhs) {
    [[maybe_unused]] const auto span = operations.root.span(Phase::substitution);
    operations.gather(b, rhs.id);
    y = b.template cast<double>();
    substitute();
    x = y.template cast<typename Matrix::Real>();
    operations.scatter(solution.id, x);
  }

 private:
  void unpack() {
    constexpr int B = Matrix::blockSize;
    lower.setZero();
    for (int i = 0; i < matrix.rows(); ++i)
      for (int s = matrix.rowStart[std::size_t(i)]; s < matrix.rowStart[std::size_t(i) + 1]; ++s)
        for (int r = 0; r < B; ++r)
          for (int c = 0; c < B; ++c)
            lower(matrix.columns[std::size_t(s)] * B + c, i * B + r) = double(matrix.block(s)[r * B + c]);
  }
  // column by column, in place, D on the diagonal; the first dof whose pivot vanishes, or -1
  int factorise() {
    const Eigen::Index n = lower.rows();
    for (Eigen::Index k = 0; k < n; ++k) y[k] = noPivot<typename Matrix::Real> * std::abs(lower(k, k));
    for (Eigen::Index k = 0; k < n; ++k) {
      const double d = lower(k, k);
      if (!(std::abs(d) > y[k]) || !std::isfinite(d)) return int(k);
      lower.col(k).tail(n - k - 1) /= d;
      for (Eigen::Index j = k + 1; j < n; ++j)
        lower.col(j).tail(n - j) -= (d * lower(j, k)) * lower.col(k).tail(n - j);
    }
    return -1;
  }
  void substitute() {
    const Eigen::Index n = lower.rows();
    for (Eigen::Index k = 0; k < n; ++k) y.tail(n - k - 1) -= y[k] * lower.col(k).tail(n - k - 1);
    for (Eigen::Index k = n; k-- > 0;)
      y[k] = y[k] / lower(k, k) - vec::product(lower.col(k).tail(n - k - 1), y.tail(n - k - 1));
  }
};

}  // namespace sinew
