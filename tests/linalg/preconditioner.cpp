// SPDX-License-Identifier: BSL-1.0
#include "catch.hpp"

#include <sinew/linalg/preconditioner.hpp>

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>

namespace test_preconditioner {

using namespace sinew;

namespace {

/// Points on a chain of `n` (or, with `ring`, closed), a dense symmetric 3x3 block a link, definite through
/// `shift`.
template <class Matrix>
Matrix chain(int n, double shift, bool ring, Eigen::MatrixXd& dense) {
  Matrix a;
  dense = Eigen::MatrixXd::Zero(3 * n, 3 * n);
  for (int phase = 0; phase < 2; ++phase) {
    if (phase == 0) a.startPattern(3 * n);
    if (phase == 1) a.finishPattern(), a.setZero();
    for (int i = 0; i < n; ++i) {
      const int j = (i + 1) % n;
      Eigen::Matrix3d k, d = Eigen::Matrix3d::Constant(0.3);
      for (int c = 0; c < 9; ++c) k(c) = std::sin(2.0 * i + 3 * c);
      for (int r = 0; r < 3; ++r) d(r, r) = shift * (1 + r + i % 3);
      if (phase == 0) {
        a.preallocate(3 * i, 3 * i, 3, 3);
        if (j > 0 || ring) a.preallocate(3 * i, 3 * j, 3, 3);
        continue;
      }
      a.add(3 * i, 3 * i, d);
      dense.block<3, 3>(3 * i, 3 * i) += d;
      if (j == 0 && !ring) continue;
      if (j > i)
        a.add(3 * i, 3 * j, k);
      else
        a.add(3 * j, 3 * i, Eigen::Matrix3d(k.transpose()));
      dense.block<3, 3>(3 * i, 3 * j) += k;
      dense.block<3, 3>(3 * j, 3 * i) += k.transpose();
    }
  }
  return a;
}

template <class Matrix>
Eigen::MatrixXd inverse_of(Preconditioner<Matrix>& m, int n) {
  Eigen::MatrixXd inverse(n, n);
  Eigen::Matrix<typename Matrix::Real, Eigen::Dynamic, 1> e(n + 1), z(n + 1);
  for (int i = 0; i < n; ++i) {
    e.setZero();
    e[i] = 1;
    m.apply(e, z);
    inverse.col(i) = z.head(n).template cast<double>();
  }
  return inverse;
}

}  // namespace

TEMPLATE_TEST_CASE("preconditioners are the inverse of what they take", "",
                   (CompressedRowSparseMatrix<double, 3>), (CompressedRowSparseMatrix<double, 1>)) {
  Eigen::MatrixXd dense;
  const int n = 8, dofs = 3 * n;
  const auto a = chain<TestType>(n, 4, false, dense);
  Preconditioner<TestType> m;
  auto inverse = [&](PreconditionerMethod method) {
    m.init(a, method, dofs);
    m.update(a);
    return inverse_of(m, dofs);
  };
  const Eigen::MatrixXd one = Eigen::MatrixXd::Identity(dofs, dofs);
  CHECK((inverse(PreconditionerMethod::none) - one).norm() < 1e-14);
  CHECK((inverse(PreconditionerMethod::jacobi) * dense.diagonal().asDiagonal() - one).norm() < 1e-13);
  constexpr int B = TestType::blockSize;
  Eigen::MatrixXd blocks = Eigen::MatrixXd::Zero(dofs, dofs);
  for (int i = 0; i < dofs; i += B) blocks.block<B, B>(i, i) = dense.block<B, B>(i, i);
  CHECK((inverse(PreconditionerMethod::blockJacobi) * blocks - one).norm() < 1e-13);
  // (D/w + L) (D/w)^-1 (D/w + L)' / (2 - w)
  for (const double w : {1.0, 0.7, 1.4}) {
    m.omega = w;
    Eigen::MatrixXd left = dense.triangularView<Eigen::StrictlyLower>();
    for (int i = 0; i < dofs; i += B) left.block<B, B>(i, i) = dense.block<B, B>(i, i) / w;
    const Eigen::MatrixXd ssor = left * (blocks / w).inverse() * left.transpose() / (2 - w);
    CHECK((inverse(PreconditionerMethod::ssor) * ssor - one).norm() < 1e-12);
  }
  CHECK((inverse(PreconditionerMethod::ldl) * dense - one).norm() < 1e-12);
  CHECK(m.shift == 0);
  // a chain eliminated from its end has no fill: IC(0) is the whole factorisation
  CHECK((inverse(PreconditionerMethod::incompleteCholesky) * dense - one).norm() < 1e-12);
  CHECK(m.shift == 0);
}

TEST_CASE("incomplete Cholesky of a ring has the blocks of the matrix, and is symmetric and positive") {
  using Matrix = CompressedRowSparseMatrix<double, 3>;
  Eigen::MatrixXd dense;
  const int n = 9;
  const auto a = chain<Matrix>(n, 4, true, dense);
  Preconditioner<Matrix> m;
  m.init(a, PreconditionerMethod::incompleteCholesky, 3 * n);
  m.update(a);
  const Eigen::MatrixXd inverse = inverse_of(m, 3 * n);
  CHECK((inverse - inverse.transpose()).norm() < 1e-13);
  CHECK(inverse.llt().info() == Eigen::Success);
  // M = A wherever A has a block: that defines IC(0)
  const Eigen::MatrixXd factored = inverse.inverse();
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < n; ++j)
      if (a.slot(i, j) >= 0)
        CHECK((factored.block<3, 3>(3 * i, 3 * j) - dense.block<3, 3>(3 * i, 3 * j)).norm() < 1e-11);
}

TEST_CASE("preconditioners of an indefinite matrix are positive all the same") {
  using Matrix = CompressedRowSparseMatrix<double, 3>;
  Eigen::MatrixXd dense;
  const int n = 9;
  const auto a = chain<Matrix>(n, 0.2, true, dense);
  REQUIRE(Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(dense).eigenvalues()[0] < -0.5);
  for (const auto method : {PreconditionerMethod::jacobi,
                            PreconditionerMethod::blockJacobi,
                            PreconditionerMethod::ssor,
                            PreconditionerMethod::incompleteCholesky,
                            PreconditionerMethod::ldl}) {
    Preconditioner<Matrix> m;
    m.init(a, method, 3 * n);
    m.update(a);
    const bool factorised =
        method == PreconditionerMethod::incompleteCholesky || method == PreconditionerMethod::ldl;
    CHECK((m.shift > 0) == factorised);
    // the whole factorisation is that of A + shift diag(A)
    if (method == PreconditionerMethod::ldl) {
      dense.diagonal() *= 1 + m.shift;
      CHECK((inverse_of(m, 3 * n) * dense - Eigen::MatrixXd::Identity(3 * n, 3 * n)).norm() < 1e-9);
    }
    CHECK(Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(inverse_of(m, 3 * n)).eigenvalues()[0] > 0);
  }
}

}  // namespace test_preconditioner
