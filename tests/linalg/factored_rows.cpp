// SPDX-License-Identifier: BSL-1.0
#include "catch.hpp"

#include <sinew/lagrangian/jacobian_rows.hpp>
#include <sinew/linalg/block_ldl.hpp>
#include <sinew/linalg/factored_rows.hpp>

#include <Eigen/LU>

#include <random>

namespace test_factored_rows {

using namespace sinew;

namespace {

// a chain of points with branches, of which the matrix is definite or, with a negative shift, indefinite
template <class Matrix>
Matrix chain(int points, int size, double shift, Eigen::MatrixXd& dense) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> entry(-1, 1);
  const int dofs = points * size;
  Matrix a;
  a.startPattern(dofs);
  dense = Eigen::MatrixXd::Zero(dofs, dofs);
  for (int i = 1; i < points; ++i)
    for (const int j : {i - 1, i / 2, i / 3}) {
      if (j == i) continue;
      a.preallocate(i * size, j * size, size, size);
      for (int r = 0; r < size; ++r)
        for (int c = 0; c < size; ++c)
          dense(i * size + r, j * size + c) = dense(j * size + c, i * size + r) = entry(random);
    }
  dense.diagonal().setConstant(shift);
  a.finishPattern();
  a.setZero();
  using One = Eigen::Matrix<double, 1, 1>;
  for (int i = 0; i < dofs; ++i)
    for (int j = 0; j < dofs; ++j)
      if (dense(i, j) != 0) a.add(i, j, One(dense(i, j)));
  return a;
}

template <class Matrix>
void check(int size, double shift) {
  constexpr int points = 40;
  Eigen::MatrixXd dense;
  const Matrix a = chain<Matrix>(points, size, shift, dense);
  BlockLdl<Matrix> factor;
  factor.init(a, points * size);
  REQUIRE(factor.factorise(a) == -1);
  const Eigen::MatrixXd inverse = dense.inverse();
  const double condition = dense.norm() * inverse.norm();
  std::mt19937 random(2);
  FactoredRows factored;
  // from less than a group of rows to so many that whole solutions cost less; the room of many serves few.
  // Of the rows one has no entries, or all but one
  for (const bool one : {true, false})
    for (const int rows : {3, 8, 21, 400, 5}) {
      JacobianRows j;
      Eigen::MatrixXd J = Eigen::MatrixXd::Zero(rows, points * size);
      for (int r = 0; r < rows; ++r) {
        j.addRow();
        for (int k = 0; k < 4; ++k) {
          const int dof = std::uniform_int_distribution<int>(0, points * size - 1)(random);
          const bool none = one ? r == 2 : r >= 1;
          const double value = none ? 0 : std::normal_distribution<double>()(random);
          j.addToLast(dof, value);
          J(r, dof) += value;
        }
      }
      Eigen::MatrixXd W = Eigen::MatrixXd::Zero(rows, rows), given = W;
      factored.compliance(factor, j, [&](int k, int l, double w) {
        W(k, l) = W(l, k) = w;
        given(k, l) += 1;
        if (k != l) given(l, k) += 1;
      });
      CHECK((given.array() == 1).all());
      const Eigen::MatrixXd exact = J * inverse * J.transpose();
      CHECK((W - exact).norm() < 1e-15 * condition * exact.norm());
    }
}

}  // namespace

TEST_CASE("rows have their compliance by the kept factor") {
  check<CompressedRowSparseMatrixMat3x3d>(3, 12);
  check<CompressedRowSparseMatrixMat3x3d>(3, -2.5);
  check<CompressedRowSparseMatrixMat3x3d>(2, 12);
  check<CompressedRowSparseMatrixd>(1, 8);
}

}  // namespace test_factored_rows
