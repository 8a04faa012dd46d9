// SPDX-License-Identifier: BSL-1.0
#include "catch.hpp"

#include <sinew/linalg/block_ldl.hpp>

#include <Eigen/Eigenvalues>
#include <Eigen/LU>

namespace test_block_ldl {

using namespace sinew;

namespace {

// a grid of points with a random symmetric block a link, and a diagonal that makes it definite, or not
template <class Matrix>
Matrix grid(int side, int pointSize, double shift, Eigen::MatrixXd& dense) {
  const int n = side * side, dofs = n * pointSize;
  Matrix a;
  dense = Eigen::MatrixXd::Zero(dofs, dofs);
  std::vector<std::array<int, 2>> links;
  for (int i = 0; i < n; ++i) {
    if (i % side + 1 < side) links.push_back({i, i + 1});
    if (i + side < n) links.push_back({i, i + side});
  }
  for (std::size_t l = 0; l < links.size(); ++l)
    for (int r = 0; r < pointSize; ++r)
      for (int c = 0; c < pointSize; ++c) {
        const int i = links[l][0] * pointSize + r, j = links[l][1] * pointSize + c;
        dense(i, j) = dense(j, i) = std::sin(3.0 * double(l) + 5 * r + 7 * c);
      }
  for (int i = 0; i < dofs; ++i) dense(i, i) = shift + std::cos(2.0 * i);
  a.startPattern(dofs);
  for (auto [i, j] : links) a.preallocate(i * pointSize, j * pointSize, pointSize, pointSize);
  a.finishPattern();
  a.setZero();
  using One = Eigen::Matrix<double, 1, 1>;
  for (int i = 0; i < dofs; ++i)
    for (int j = 0; j < dofs; ++j)
      if (dense(i, j) != 0) a.add(i, j, One(dense(i, j)));
  return a;
}

template <class Matrix>
void check_factor(int side, int pointSize, double shift, double rounding) {
  using Vector = Eigen::Matrix<typename Matrix::Real, Eigen::Dynamic, 1>;
  Eigen::MatrixXd dense;
  const Matrix a = grid<Matrix>(side, pointSize, shift, dense);
  const int dofs = int(dense.rows());
  BlockLdl<Matrix> factor;
  factor.init(a, dofs);
  Vector b(a.dofs()), x(a.dofs());
  for (int i = 0; i < a.dofs(); ++i) b[i] = typename Matrix::Real(std::cos(7.0 * i));
  const Eigen::VectorXd exact = dense.partialPivLu().solve(b.head(dofs).template cast<double>());
  const Eigen::VectorXd eigenvalues = Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(dense).eigenvalues();
  for (int again = 0; again < 2; ++again) {  // a second factorisation finds nothing left of the first
    REQUIRE(factor.factorise(a) == -1);
    factor.solve(b, x);
    const double condition = eigenvalues.cwiseAbs().maxCoeff() / eigenvalues.cwiseAbs().minCoeff();
    CHECK((x.head(dofs).template cast<double>() - exact).norm() < condition * rounding * exact.norm());
    CHECK(factor.negativePivots == int((eigenvalues.array() < 0).count()));  // Sylvester's law of inertia
  }
}

}  // namespace

TEST_CASE("L D L' solves definite and indefinite systems, and counts negative eigenvalues") {
  for (const double shift : {8.0, 1.5}) {
    // without pivoting, entries of an indefinite matrix may grow on the way: two digits are left for that
    const double growth = shift == 8 ? 1 : 100;
    check_factor<CompressedRowSparseMatrix<double, 1>>(9, 1, shift, growth * 1e-15);
    check_factor<CompressedRowSparseMatrix<double, 1>>(5, 3, shift, growth * 1e-15);
    check_factor<CompressedRowSparseMatrix<double, 3>>(5, 3, shift, growth * 1e-15);
    check_factor<CompressedRowSparseMatrix<double, 6>>(4, 6, shift + 8, 1e-15);
    check_factor<CompressedRowSparseMatrix<float, 3>>(5, 3, shift, 1e-6);
  }
}

TEST_CASE("blocks may be larger than points, with padding behind the last") {
  check_factor<CompressedRowSparseMatrix<double, 3>>(5, 2, 6, 1e-15);  // 50 dofs in 17 blocks
  check_factor<CompressedRowSparseMatrix<double, 3>>(5, 1, 6, 1e-15);
}

TEST_CASE("fill stays small: the order is one of small degree") {
  Eigen::MatrixXd dense;
  const auto a = grid<CompressedRowSparseMatrix<double, 1>>(30, 1, 8, dense);
  BlockLdl<CompressedRowSparseMatrix<double, 1>> factor;
  factor.init(a, 900);
  // in the given order, L is a band of 30 below 900 diagonals; nested dissection has 31/4 n log2 n / 2
  CHECK(factor.lower.size() < 900 * 15);
}

TEST_CASE("the order is a permutation, also of a matrix in parts, and of none") {
  // two paths of three unknowns, and one alone
  const std::vector<int> rowStart{0, 2, 5, 7, 8, 10, 13, 15},
      columns{0, 1, 0, 1, 2, 1, 2, 3, 4, 5, 4, 5, 6, 5, 6};
  std::vector<int> order = minimum_degree_order(rowStart, columns);
  CHECK(order[0] == 3);  // of degree 0
  std::sort(order.begin(), order.end());
  CHECK(order == std::vector<int>{0, 1, 2, 3, 4, 5, 6});
  CHECK(minimum_degree_order(std::vector<int>{0}, {}).empty());
  CHECK(minimum_degree_order({}, {}).empty());
}

TEST_CASE("a star is eliminated from its points, without fill") {
  const int n = 50;
  CompressedRowSparseMatrix<double, 1> a;
  a.startPattern(n);
  for (int i = 1; i < n; ++i) a.preallocate(0, i, 1, 1);
  a.finishPattern();
  BlockLdl<CompressedRowSparseMatrix<double, 1>> factor;
  factor.init(a, n);
  CHECK(factor.lower.size() == n - 1);
}

TEST_CASE("a vanishing pivot is found, and named by its dof") {
  using Matrix = CompressedRowSparseMatrix<double, 3>;
  Matrix a;
  BlockLdl<Matrix> factor;
  const Eigen::Matrix3d k = Eigen::Vector3d(2, 3, 0).asDiagonal();
  auto chain =
      [&](bool held) {  // three points on springs that do nothing along z, and nothing holds the chain
        a.startPattern(9);
        a.preallocate(0, 3, 3, 3);
        a.preallocate(3, 6, 3, 3);
        a.finishPattern();
        a.setZero();
        for (int i = 0; i < 2; ++i) {
          a.add(3 * i, 3 * i, k);
          a.add(3 * i + 3, 3 * i + 3, k);
          a.add(3 * i, 3 * i + 3, Eigen::Matrix3d(-k));
        }
        if (held)
          for (const int dof : {0, 1, 2, 5, 8}) a.fix(dof);
        factor.init(a, 9);
        return factor.factorise(a);
      };
  CHECK(chain(false) % 3 == 2);
  CHECK(chain(true) == -1);
  a.values[0] = std::numeric_limits<double>::quiet_NaN();
  CHECK(factor.factorise(a) == 0);
}

}  // namespace test_block_ldl
