// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/lagrangian/constraint_block.hpp>
#include <sinew/lagrangian/jacobian_rows.hpp>
#include <sinew/linalg/reserved.hpp>

#include <Eigen/Core>

#include <algorithm>
#include <vector>

namespace sinew {

/// A compliance W = J U + S of constraints, with U = A^-1 J' and a symmetric S of blocks, that is not
/// multiplied out: its room is that of the rows J and U', and the product W f costs as much as they have
/// entries, where W has a number for each pair of rows.
class UnbuiltCompliance {
 public:
  using Matrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
  using Blocks = Eigen::Matrix<double, Eigen::Dynamic, ConstraintBlock::maxRows, Eigen::RowMajor>;

  JacobianRows jacobian{};  // J
  JacobianRows answers{};   // U', over the same degrees of freedom

  int rows() const { return int(first_.size()); }
  void clear() {
    jacobian.clear();
    answers.clear();
    first_.clear();
  }
  /// Forms the diagonal blocks of J U of so many degrees of freedom; S is zero.
  void begin(std::vector<ConstraintBlock> const& blocks, int dofs);

  /// The diagonal blocks: row i has that of its block from column 0 on.
  double const* own(int firstRow) const { return own_.data() + firstRow * ConstraintBlock::maxRows; }
  bool allFinite() const { return own_.allFinite(); }

  /// S_ij += value of two rows of one block.
  void add(int i, int j, double value) {
    const int column = j - first_[std::size_t(i)];
    own_(i, column) += value;
    added_(i, column) += value;
  }
  /// Takes a row out of J U, where S_ii becomes a value.
  void leaveOut(ConstraintBlock const& b, int i, double value);

  /// U f of all multipliers, from which products begin and which moved() goes on with.
  void setMultipliers(Eigen::Ref<Eigen::VectorXd const> const& f);
  void moved(int i, double step) {
    if (step != 0) answers.addTransposed(i, step, motion_);
  }
  /// Row i of W f, where f has these multipliers in the block of the row.
  template <class F>
  double times(int i, F const& f) const {
    return times(i, f, motion_);
  }
  /// d += W f
  void addProduct(std::vector<ConstraintBlock> const& blocks, Eigen::Ref<Eigen::VectorXd const> const& f,
                  Eigen::VectorXd& d) const;
  /// The first rows and columns of W.
  Matrix product(int end) const;

 private:
  std::vector<int> first_{};  // of each row the first of its block
  Reserved<Blocks> own_{}, added_{};
  Eigen::VectorXd motion_{};

  template <class F>
  double times(int i, F const& f, Eigen::VectorXd const& motion) const {
    double sum = jacobian.times(i, motion);
    for (int k = 0; k < f.size(); ++k) sum += added_(i, k) * f[k];
    return sum;
  }
};

}  // namespace sinew

#if SINEW_DEFINES

namespace sinew {

SINEW_ONCE void UnbuiltCompliance::begin(std::vector<ConstraintBlock> const& blocks, int dofs) {
  const int n = jacobian.rows();
  first_.resize(std::size_t(n));
  own_.setZero(n, ConstraintBlock::maxRows);
  added_.setZero(n, ConstraintBlock::maxRows);
  motion_.setZero(dofs);
  for (ConstraintBlock const& b : blocks)
    for (int j = 0; j < b.rows; ++j) {
      first_[std::size_t(b.first + j)] = b.first;
      answers.addTransposed(b.first + j, 1, motion_);
      for (int i = 0; i < b.rows; ++i) own_(b.first + i, j) = jacobian.times(b.first + i, motion_);
      answers.forEachInRow(b.first + j, [&](int dof, double) { motion_[dof] = 0; });
    }
}

SINEW_ONCE void UnbuiltCompliance::leaveOut(ConstraintBlock const& b, int i, double value) {
  for (JacobianRows* rows : {&jacobian, &answers})
    std::fill(rows->values.begin() + rows->first[std::size_t(i)],
              rows->values.begin() + rows->first[std::size_t(i) + 1],
              0.);
  for (int k = 0; k < b.rows; ++k)
    own_(i, k) = added_(i, k) = own_(b.first + k, i - b.first) = added_(b.first + k, i - b.first) = 0;
  own_(i, i - b.first) = added_(i, i - b.first) = value;
}

SINEW_ONCE void UnbuiltCompliance::setMultipliers(Eigen::Ref<Eigen::VectorXd const> const& f) {
  motion_.setZero();
  for (int i = 0; i < rows(); ++i) moved(i, f[i]);
}

SINEW_ONCE void UnbuiltCompliance::addProduct(std::vector<ConstraintBlock> const& blocks,
                                              Eigen::Ref<Eigen::VectorXd const> const& f,
                                              Eigen::VectorXd& d) const {
  Eigen::VectorXd motion = Eigen::VectorXd::Zero(motion_.size());
  for (int i = 0; i < rows(); ++i) answers.addTransposed(i, f[i], motion);
  for (ConstraintBlock const& b : blocks)
    for (int i = b.first; i < b.first + b.rows; ++i) d[i] += times(i, f.segment(b.first, b.rows), motion);
}

SINEW_ONCE UnbuiltCompliance::Matrix UnbuiltCompliance::product(int end) const {
  Matrix W(end, end);
  Eigen::VectorXd motion = Eigen::VectorXd::Zero(motion_.size());
  for (int j = 0; j < end; ++j) {
    answers.addTransposed(j, 1, motion);
    for (int i = 0; i < end; ++i) W(i, j) = jacobian.times(i, motion);
    answers.forEachInRow(j, [&](int dof, double) { motion[dof] = 0; });
    const int first = first_[std::size_t(j)];
    for (int i = first; i < std::min(end, first + ConstraintBlock::maxRows); ++i)
      if (first_[std::size_t(i)] == first) W(i, j) += added_(i, j - first);
  }
  return W;
}

}  // namespace sinew
#endif
