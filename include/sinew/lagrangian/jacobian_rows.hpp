// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/core/error.hpp>

#include <Eigen/Core>

#include <cmath>
#include <string_view>
#include <vector>

namespace sinew {

/// The sparse rows of the Jacobian J of constraints, over scalar dofs: row i has the entries first[i] to
/// first[i + 1]. A dof may stand in a row more than once; such entries add up. Vectors keep their room when
/// the rows are cleared and filled again.
struct JacobianRows {
  std::vector<int> first{0};
  std::vector<int> dofs{};
  std::vector<double> values{};

  bool operator==(JacobianRows const&) const = default;

  int rows() const { return first.empty() ? 0 : int(first.size()) - 1; }

  void clear() {
    first.assign(1, 0);
    dofs.clear();
    values.clear();
  }
  void reserve(int rowCount, int entries) {
    first.reserve(std::size_t(rowCount) + 1);
    dofs.reserve(std::size_t(entries));
    values.reserve(std::size_t(entries));
  }
  /// An entry of the row that endRow() ends.
  void add(int dof, double value) {
    dofs.push_back(dof);
    values.push_back(value);
  }
  void endRow() { first.push_back(int(dofs.size())); }
  /// Another way to fill rows: begins one without entries, and adds to the last one.
  void addRow() { first.push_back(first.back()); }
  void addToLast(int dof, double value) {
    add(dof, value);
    ++first.back();
  }

  /// f(dof, value) for the entries of a row.
  template <class F>
  void forEachInRow(int row, F&& f) const {
    const auto end = std::size_t(first[std::size_t(row) + 1]);
    for (auto k = std::size_t(first[std::size_t(row)]); k < end; ++k) f(dofs[k], values[k]);
  }

  /// d = J v, the first entries of d, which is made longer where it is too short.
  void multiply(Eigen::VectorXd const& v, Eigen::VectorXd& d) const {
    if (d.size() < rows()) d.resize(rows());
    for (int i = 0; i < rows(); ++i) d[i] = times(i, v);
  }
  /// J v of one row.
  double times(int row, Eigen::VectorXd const& v) const {
    double sum = 0;
    forEachInRow(row, [&](int dof, double value) { sum += value * v[dof]; });
    return sum;
  }
  /// v += J' f of one row.
  void addTransposed(int row, double f, Eigen::VectorXd& v) const {
    forEachInRow(row, [&](int dof, double value) { v[dof] += value * f; });
  }
  /// v += J' f
  void addTransposed(Eigen::VectorXd const& f, Eigen::VectorXd& v) const {
    for (int i = 0; i < rows(); ++i)
      if (f[i] != 0) addTransposed(i, f[i], v);
  }

  /// Throws Error where the entries of a row are not within the lists, a dof is not one of `dofCount`, or a
  /// value is not finite.
  void check(int dofCount, std::string_view where) const {
    if (first.empty() || first.front() != 0 || first.back() != int(dofs.size()) ||
        dofs.size() != values.size())
      throw Error(where,
                  text("the rows of constraints end at entry ",
                       first.empty() ? 0 : first.back(),
                       " of ",
                       dofs.size(),
                       " dofs and ",
                       values.size(),
                       " values; rows begin at entry 0 and cover all"));
    for (int i = 0; i < rows(); ++i)
      if (first[std::size_t(i)] > first[std::size_t(i) + 1])
        throw Error(where,
                    text("row ", i, " of the constraints ends before it begins; entries are in order"));
    for (int i = 0; i < rows(); ++i)
      forEachInRow(i, [&](int dof, double value) {
        if (dof < 0 || dof >= dofCount)
          throw Error(
              where,
              text("row ", i, " of the constraints has dof ", dof, " of ", dofCount, ", numbered from 0"));
        if (!std::isfinite(value))
          throw Error(where, text("row ", i, " of the constraints is not a finite number at dof ", dof));
      });
  }
};

}  // namespace sinew
