// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/core/compiled.hpp>
#include <sinew/linalg/reserved.hpp>

#include <Eigen/Core>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace sinew {

/// Linear complementarity problems w = M z + q, w >= 0, z >= 0, w.z = 0 by Lemke's method: pivots from basis
/// to basis (Cottle, Pang, Stone 1992, algorithm 4.4.5), with the lexicographic rule, by which it ends also
/// where bases are degenerate, as those of redundant contacts are. Where M is positive semidefinite it finds
/// a solution or there is none. A pivot takes O(n^2), and there are about n of them.
class Lemke {
 public:
  enum class End {
    solved,
    ray,         // no z >= 0 makes M z + q >= 0, if M is positive semidefinite
    pivotsEnded  // more pivots than permitted
  };
  int pivots = 0;  // of the last problem

  /// z is 0 where no solution is found.
  End solve(Eigen::Ref<Eigen::MatrixXd const> const& M, Eigen::Ref<Eigen::VectorXd const> const& q,
            ReservedVector& z, int maxPivots);

 private:
  // Basis B of the columns of w - M z - e z0 = q, scaled so that M has a diagonal of ones and q a largest
  // entry of one, which makes tolerances those of rounding.
  Reserved<Eigen::MatrixXd> scaled_{}, basis_{}, inverse_{};
  ReservedVector scale_{}, q_{}, x_{}, column_{}, row_{};
  std::vector<int> basic_{};  // i: w_i, n + i: z_i, 2 n: z0
  static constexpr double zero = 1e-11;

  void setColumn(int variable, Eigen::Ref<Eigen::VectorXd> column) const;
  // x and B^-1 of the basis as it is, by elimination with a pivot in each column
  void refactor();
  // whether (x, row of B^-1) / column of i comes before that of j
  bool comesBefore(int i, int j) const;
  int leavingRow() const;
  void pivot(int row, int variable);
};

}  // namespace sinew

#if SINEW_DEFINES

namespace sinew {

SINEW_ONCE void Lemke::setColumn(int variable, Eigen::Ref<Eigen::VectorXd> column) const {
  const int n = int(q_.size());
  if (variable < n)
    column = Eigen::VectorXd::Unit(n, variable);
  else if (variable < 2 * n)
    column = -scaled_.col(variable - n);
  else
    column.setConstant(-1);
}

SINEW_ONCE void Lemke::refactor() {
  const auto n = q_.size();
  for (std::size_t i = 0; i < basic_.size(); ++i) setColumn(basic_[i], basis_.col(Eigen::Index(i)));
  inverse_.setIdentity();
  for (Eigen::Index c = 0; c < n; ++c) {
    Eigen::Index below = 0;
    basis_.col(c).tail(n - c).cwiseAbs().maxCoeff(&below);
    for (auto* matrix : {&basis_, &inverse_}) matrix->row(c).swap(matrix->row(c + below));
    column_ = basis_.col(c);
    const double pivot = column_[c];
    column_[c] = 0;
    for (auto* matrix : {&basis_, &inverse_}) {
      row_ = matrix->row(c).transpose() / pivot;
      matrix->noalias() -= column_ * row_.transpose();
      matrix->row(c) = row_.transpose();
    }
  }
  x_.noalias() = inverse_ * q_;
}

SINEW_ONCE bool Lemke::comesBefore(int i, int j) const {
  double difference = x_[i] / column_[i] - x_[j] / column_[j];
  for (int k = 0; std::abs(difference) <= zero && k < q_.size(); ++k)
    difference = inverse_(i, k) / column_[i] - inverse_(j, k) / column_[j];
  return difference < 0;
}

SINEW_ONCE int Lemke::leavingRow() const {
  const int n = int(q_.size());
  int row = -1;
  for (int i = 0; i < n; ++i)
    if (column_[i] > zero && (row < 0 || comesBefore(i, row))) row = i;
  if (row < 0) return row;
  // z0 leaves where it may: then it is 0, which is a solution
  for (int i = 0; i < n; ++i)
    if (basic_[std::size_t(i)] == 2 * n && column_[i] > zero &&
        x_[i] / column_[i] - x_[row] / column_[row] <= zero)
      return i;
  return row;
}

SINEW_ONCE void Lemke::pivot(int row, int variable) {
  const double pivot = column_[row];
  row_ = inverse_.row(row).transpose() / pivot;
  const double value = x_[row] / pivot;
  x_ -= value * column_;
  x_[row] = value;
  inverse_.noalias() -= column_ * row_.transpose();
  inverse_.row(row) = row_.transpose();
  basic_[std::size_t(row)] = variable;
  if (++pivots % 50 == 0) refactor();  // so that errors do not add up
}

SINEW_ONCE Lemke::End Lemke::solve(Eigen::Ref<Eigen::MatrixXd const> const& M,
                                   Eigen::Ref<Eigen::VectorXd const> const& q, ReservedVector& z,
                                   int maxPivots) {
  const int n = int(q.size());
  pivots = 0;
  z.setZero(n);
  if (n == 0 || q.minCoeff() >= 0) return End::solved;
  const double largest = std::max(M.diagonal().maxCoeff(), std::numeric_limits<double>::min());
  scale_ = M.diagonal().unaryExpr(
      [&](double m) { return m > 1e-14 * largest ? 1 / std::sqrt(m) : 1 / std::sqrt(largest); });
  scaled_ = scale_.asDiagonal() * M * scale_.asDiagonal();
  q_ = scale_.asDiagonal() * q;
  const double unit = q_.cwiseAbs().maxCoeff();
  q_ /= unit;
  x_ = q_;
  basis_.resize(n, n);
  inverse_.resize(n, n);
  inverse_.setIdentity();
  column_.resize(n);
  column_.setConstant(-1);  // of z0
  basic_.resize(std::size_t(n));
  for (int i = 0; i < n; ++i) basic_[std::size_t(i)] = i;

  // z0 becomes so large that all others are positive: of rows that are equal, unit vectors are the smaller
  // the later they are
  int leaves = 0, enters = 2 * n;
  for (int i = 1; i < n; ++i)
    if (x_[i] - x_[leaves] <= zero) leaves = i;
  while (true) {
    const int left = basic_[std::size_t(leaves)];
    pivot(leaves, enters);
    if (left == 2 * n) break;
    if (pivots >= maxPivots) return End::pivotsEnded;
    enters = left < n ? left + n : left - n;
    setColumn(enters, row_);
    column_.noalias() = inverse_ * row_;
    leaves = leavingRow();
    if (leaves < 0) return End::ray;
  }
  refactor();
  for (int i = 0; i < n; ++i)
    if (const int variable = basic_[std::size_t(i)]; variable >= n && variable < 2 * n)
      z[variable - n] = std::max(0., x_[i]) * scale_[variable - n] * unit;
  return End::solved;
}

}  // namespace sinew
#endif
