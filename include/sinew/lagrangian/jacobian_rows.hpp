// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <Eigen/Core>

#include <vector>

namespace sinew {

/// Rows of a sparse matrix J over the degrees of freedom of a system, in compressed form. A degree of freedom
/// may stand more than once in a row: its values add up.
struct JacobianRows {
  std::vector<int> first{0};  // of each row in dofs and values; one more behind the last
  std::vector<int> dofs{};
  std::vector<double> values{};

  int rows() const { return int(first.size()) - 1; }
  void clear() {
    first.resize(1);
    dofs.clear();
    values.clear();
  }
  void addRow() { first.push_back(first.back()); }
  /// Adds to the last row.
  void add(int dof, double value) {
    dofs.push_back(dof);
    values.push_back(value);
    ++first.back();
  }
  /// J x in one row.
  double times(int row, Eigen::VectorXd const& x) const {
    double sum = 0;
    for (int k = first[std::size_t(row)]; k < first[std::size_t(row) + 1]; ++k)
      sum += values[std::size_t(k)] * x[dofs[std::size_t(k)]];
    return sum;
  }
  /// y += J' f of one row.
  void addTransposed(int row, double f, Eigen::VectorXd& y) const {
    for (int k = first[std::size_t(row)]; k < first[std::size_t(row) + 1]; ++k)
      y[dofs[std::size_t(k)]] += values[std::size_t(k)] * f;
  }
};

}  // namespace sinew
