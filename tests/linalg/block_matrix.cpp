// SPDX-License-Identifier: BSL-1.0
#include "catch.hpp"

#include <sinew/linalg/block_matrix.hpp>

namespace test_block_matrix {

using namespace sinew;

namespace {

// a chain of n points of three dofs with a few far links, against the same dense matrix
template <class Matrix>
void check_matrix(double rounding) {
  using Real = typename Matrix::Real;
  const int n = 12, dofs = 3 * n;
  Matrix a;
  Eigen::MatrixXd dense = Eigen::MatrixXd::Zero(dofs, dofs);
  std::vector<std::array<int, 2>> links;
  for (int i = 0; i + 1 < n; ++i) links.push_back({i, i + 1});
  links.push_back({0, 7});
  links.push_back({9, 2});
  a.startPattern(dofs);
  for (auto [i, j] : links) {
    a.preallocate(3 * i, 3 * j, 3, 3);
    a.preallocate(3 * i, 3 * i, 3, 3);
  }
  a.finishPattern();
  auto fill = [&] {
    a.setZero();
    dense.setZero();
    for (auto [i, j] : links) {
      Eigen::Matrix3d k;
      for (int c = 0; c < 9; ++c) k(c) = std::sin(i + 2.0 * j + 3 * c);
      for (auto [r, s, block] : {std::tuple{i, j, k},
                                 std::tuple{j, i, Eigen::Matrix3d(k.transpose())},
                                 std::tuple{i, i, Eigen::Matrix3d(k * k.transpose())}}) {
        a.add(3 * r, 3 * s, block);
        dense.block<3, 3>(3 * r, 3 * s) += block;
      }
    }
  };
  auto compare = [&] {
    Eigen::Matrix<Real, Eigen::Dynamic, 1> x(a.dofs() + 1), y(a.dofs());
    for (int i = 0; i < dofs; ++i) x[i] = Real(std::cos(7.0 * i));
    x[dofs] = Real(1e30);  // read, and of no effect
    a.multiply(x.data(), y.data());
    const Eigen::VectorXd expected = dense * x.head(dofs).template cast<double>();
    CHECK((y.template cast<double>() - expected).norm() < rounding * expected.norm());
  };
  fill();
  compare();
  fill();  // setZero leaves nothing behind
  compare();
  for (const int dof : {4, 21, 22}) {
    a.fix(dof);
    dense.row(dof).setZero();
    dense.col(dof).setZero();
    dense(dof, dof) = 1;
  }
  compare();
}

// Points of a grid: from the fourth product on, rows go through lanes where the processor has wide ones.
template <class Matrix>
void check_grid(std::array<int, 3> n, double rounding) {
  using Real = typename Matrix::Real;
  using Vector = Eigen::Matrix<Real, Eigen::Dynamic, 1>;
  const int points = n[0] * n[1] * n[2];
  Matrix a;
  a.slicedFrom = 0;
  a.startPattern(3 * points);
  auto forEachPair = [&](auto&& f) {
    for (int i = 0; i < points; ++i)
      for (const int step : {1, n[0], n[0] + 1, n[0] * n[1], n[0] * (n[1] + 1) - 1})
        if (i + step < points) f(i, i + step);
  };
  forEachPair([&](int i, int j) { a.preallocate(3 * i, 3 * j, 3, 3); });
  a.finishPattern();
  Vector x(3 * points + 1), first(3 * points), y(3 * points);
  for (int i = 0; i <= 3 * points; ++i) x[i] = Real(std::cos(7.0 * i));
  for (int round = 0; round < 3; ++round) {
    // a new matrix, the same with a fixed point, the same with one block changed
    if (round == 0) {
      a.setZero();
      forEachPair([&](int i, int j) {
        Eigen::Matrix3d k;
        for (int c = 0; c < 9; ++c) k(c) = std::sin(i + 2.0 * j + 3 * c);
        a.add(3 * i, 3 * j, k);
        a.add(3 * i, 3 * i, Eigen::Matrix3d(k * k.transpose()));
      });
    } else if (round == 1) {
      a.fix(3 * (points - 2) + 1);
    } else {
      a.block(a.slot(1, 2))[5] += 1;
    }
    double dot = 0;
    for (int product = 0; product < 6; ++product) {
      y.setConstant(Real(1e20));
      dot = a.multiply(x.data(), y.data());
      if (product == 0) first = y;
      CHECK((y - first).norm() <= Real(rounding) * first.norm());
    }
    CHECK(std::abs(dot - double(x.head(3 * points).dot(y))) < rounding * double(x.norm() * y.norm()));
  }
}

}  // namespace

TEST_CASE("block matrices of grids multiply alike in all products") {
  check_grid<CompressedRowSparseMatrix<double, 3>>({9, 5, 4}, 1e-14);
  check_grid<CompressedRowSparseMatrix<double, 3>>({8, 8, 4}, 1e-14);
  check_grid<CompressedRowSparseMatrix<float, 3>>({17, 5, 4}, 1e-6);
  check_grid<CompressedRowSparseMatrix<float, 3>>({16, 4, 4}, 1e-6);
}

TEST_CASE("a small matrix of doubles has no copy of itself in slices, one of floats may have") {
  auto bytes = [](auto a, std::size_t slicedFrom) {
    a.slicedFrom = slicedFrom;
    a.startPattern(300);
    for (int i = 0; i < 99; ++i) a.preallocate(3 * i, 3 * i + 3, 3, 3);
    a.finishPattern();
    return a.bytes();
  };
  const CompressedRowSparseMatrix<double, 3> doubles;
  const CompressedRowSparseMatrix<float, 3> floats;
  CHECK(bytes(doubles, doubles.slicedFrom) == bytes(doubles, 200));
  CHECK(bytes(floats, floats.slicedFrom) == bytes(floats, 0));
  if constexpr (native_width<float> >= 4) CHECK(bytes(floats, 0) > bytes(floats, 200));
  if constexpr (native_width<double> >= 4) CHECK(bytes(doubles, 199) > bytes(doubles, 200));
}

TEST_CASE("block matrices multiply as the dense one") {
  check_matrix<CompressedRowSparseMatrix<double, 3>>(1e-14);
  check_matrix<CompressedRowSparseMatrix<double, 1>>(1e-14);
  check_matrix<CompressedRowSparseMatrix<double, 6>>(1e-14);
  check_matrix<CompressedRowSparseMatrix<float, 3>>(1e-6);
}

TEST_CASE("a block outside the pattern has no slot") {
  CompressedRowSparseMatrix<double, 3> a;
  a.startPattern(9);
  a.preallocate(0, 6, 3, 3);
  a.finishPattern();
  CHECK(a.slot(0, 2) >= 0);
  CHECK(a.slot(2, 0) >= 0);
  CHECK(a.slot(1, 1) >= 0);
  CHECK(a.slot(0, 1) == -1);
  CHECK_THROWS_AS(a.add(0, 3, Eigen::Matrix3d(Eigen::Matrix3d::Identity())), Error);
}

}  // namespace test_block_matrix
