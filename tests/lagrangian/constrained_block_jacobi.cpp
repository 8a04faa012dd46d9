// SPDX-License-Identifier: BSL-1.0
// Products and diagonal blocks of A + J' G J against dense matrices.
#include "catch.hpp"

#include <sinew/lagrangian/constrained_block_jacobi.hpp>

#include <Eigen/Dense>

#include <random>

namespace test_constrained_block_jacobi {

using namespace sinew;

namespace {

/// Seven points of B coordinates: a contact of one point, one of two, an equality of six rows, which is wider
/// than a point, and an interval over three. The last point has no row.
template <int B>
struct Sample {
  static constexpr int points = 7;
  JacobianRows rows{};
  std::vector<ConstraintBlock> blocks{};
  Eigen::VectorXd start{}, guess{};
  std::vector<Eigen::Matrix<double, B, B>> system{};
  std::mt19937 random{3};

  double number() { return std::uniform_real_distribution<double>(-1, 1)(random); }
  void add(ConstraintBlock block, std::vector<int> const& of) {
    block.first = rows.rows();
    for (int i = 0; i < block.rows; ++i) {
      for (const int p : of)
        for (int c = 0; c < B; ++c) rows.add(B * p + c, number());
      rows.endRow();
    }
    blocks.push_back(block);
  }
  Sample() {
    add(ConstraintBlock::contact(0, 0.5), {2});
    add(ConstraintBlock::equality(0, 6), {0, 4});
    add(ConstraintBlock::contact(0, 0.3), {5, 2});
    add(ConstraintBlock::interval(0, 0, 1), {1, 3, 4});
    add(ConstraintBlock::contact(0, 0.3), {3});  // open
    start = Eigen::VectorXd::Zero(rows.rows());
    guess = start;
    for (ConstraintBlock const& b : blocks) {
      for (int i = 0; i < b.rows; ++i) start[b.first + i] = 0.1 * number();
      start[b.first] = -0.5;  // what is not open is pressed
    }
    start[blocks.back().first] = 5;
    for (int p = 0; p < points; ++p) {
      Eigen::Matrix<double, B, B> half;
      for (auto& entry : half.reshaped()) entry = number();
      system.push_back(half * half.transpose() + Eigen::Matrix<double, B, B>::Identity());
    }
  }
  Eigen::VectorXd vector() {
    Eigen::VectorXd v(B * points);
    for (auto& entry : v) entry = number();
    return v;
  }
};

template <int B>
void compare() {
  Sample<B> s;
  const int n = B * Sample<B>::points, m = s.rows.rows();
  ConstraintTerms terms;
  terms.begin(s.rows, s.blocks, s.start, s.guess, FrictionLag::none);
  terms.evaluate(Eigen::VectorXd::Zero(n));
  ConstrainedBlockJacobi<B> jacobi;
  jacobi.system = s.system;
  Eigen::VectorXd compliance;
  jacobi.begin(terms, compliance);

  Eigen::MatrixXd J = Eigen::MatrixXd::Zero(m, n), G = Eigen::MatrixXd::Zero(m, m),
                  A = Eigen::MatrixXd::Zero(n, n);
  for (int i = 0; i < m; ++i) s.rows.forEachInRow(i, [&](int dof, double value) { J(i, dof) += value; });
  for (int p = 0; p < Sample<B>::points; ++p) A.block<B, B>(B * p, B * p) = s.system[std::size_t(p)];
  const Eigen::VectorXd W = (J * A.inverse() * J.transpose()).diagonal();
  CHECK((compliance.head(m) - W).norm() < 1e-12 * W.norm());

  // twice, so that the second starts from what the first has left
  for (const double softer : {1., 0.01}) {
    terms.regularisation.head(m).setConstant(softer);
    terms.evaluate(Eigen::VectorXd::Zero(n));
    terms.evaluateCurvature();
    jacobi.update(terms);
    int acting = 0;
    G.setZero();
    for (ConstraintBlock const& b : s.blocks) {
      double const* const g = terms.curvature(b);
      if (b.kind == ConstraintBlock::Kind::friction)
        G.block<3, 3>(b.first, b.first) = Eigen::Map<Eigen::Matrix3d const>(g);
      else
        for (int i = 0; i < b.rows; ++i) G(b.first + i, b.first + i) = g[i];
      acting += !G.middleRows(b.first, b.rows).isZero(0);
    }
    REQUIRE(acting == 4);
    const Eigen::MatrixXd K = J.transpose() * G * J;
    const Eigen::VectorXd p = s.vector(), before = s.vector();
    Eigen::VectorXd q = before, z(n);
    jacobi.addProduct(terms, p, q);
    CHECK((q - before - K * p).norm() < 1e-12 * (K * p).norm());
    jacobi.apply(p, z);
    for (int i = 0; i < n; i += B) {
      const Eigen::Matrix<double, B, B> D = (A + K).block<B, B>(i, i);
      CHECK((D * z.segment<B>(i) - p.segment<B>(i)).norm() < 1e-10 * p.norm());
    }
  }
}

}  // namespace

TEST_CASE("block Jacobi has the product with J' G J, and the inverse blocks of A + J' G J") {
  compare<3>();
  compare<6>();
}

}  // namespace test_constrained_block_jacobi
