// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/core/compiled.hpp>
#include <sinew/core/error.hpp>
#include <sinew/lagrangian/constraint_block.hpp>
#include <sinew/lagrangian/unbuilt_compliance.hpp>
#include <sinew/linalg/reserved.hpp>

#include <Eigen/Core>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string_view>
#include <vector>

namespace sinew {

/// The constraints of a step: d = W f + d_free with the compliance W = J A^-1 J', which is symmetric and
/// positive semidefinite, and a condition between d and f for each block. W is a matrix of all rows, or its
/// factors; a solver that asks for these (takesUnbuilt()) reads it by own(), violation() and moved() alone.
struct ConstraintProblem {
  using Matrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

  Reserved<Matrix> compliance{};   // W
  ReservedVector freeViolation{};  // d_free, of the motion without multipliers
  ReservedVector multipliers{};    // f: the first guess, then the solution
  std::vector<ConstraintBlock> blocks{};
  double timeStep = 1;  // [s]; SOFA's multipliers are impulses, f times that, and its compliance W over that
  bool built = true;    // whether W is `compliance`; else it is that:
  UnbuiltCompliance unbuilt{};

  int rows() const { return int(freeViolation.size()); }
  Eigen::VectorXd violation() const;

  /// W_bb of a block.
  using OwnBlock = Eigen::Map<Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor,
                                            ConstraintBlock::maxRows, ConstraintBlock::maxRows> const,
                              0, Eigen::OuterStride<>>;
  OwnBlock own(ConstraintBlock const& b) const {
    return built ? OwnBlock(compliance.data() + Eigen::Index(b.first) * (compliance.cols() + 1),
                            b.rows,
                            b.rows,
                            Eigen::OuterStride<>(compliance.cols()))
                 : OwnBlock(
                       unbuilt.own(b.first), b.rows, b.rows, Eigen::OuterStride<>(ConstraintBlock::maxRows));
  }
  /// The multipliers are others than those that moved() has been told of.
  void multipliersSet() {
    if (!built) unbuilt.setMultipliers(multipliers);
  }
  /// d of a block.
  BlockVector violation(ConstraintBlock const& b) const {
    BlockVector d = freeViolation.segment(b.first, b.rows);
    if (built)
      d.noalias() += compliance.middleRows(b.first, b.rows) * multipliers;
    else
      for (int i = 0; i < b.rows; ++i)
        d[i] += unbuilt.times(b.first + i, multipliers.segment(b.first, b.rows));
    return d;
  }
  /// The multipliers of a block have changed by a step.
  void moved(ConstraintBlock const& b, BlockVector const& step) {
    for (int i = 0; i < b.rows && !built; ++i) unbuilt.moved(b.first + i, step[i]);
  }
  /// W_ij += value; of factors i and j are of one block.
  void add(int i, int j, double value) {
    if (built)
      compliance(i, j) += value;
    else
      unbuilt.add(i, j, value);
  }
  /// Lets no other row act on a row, and that on none; its compliance becomes a value.
  void leaveOut(ConstraintBlock const& b, int row, double value);
  /// The first rows and columns of W, formed where it is not.
  Matrix products(int end) const {
    return built ? Matrix(compliance.topLeftCorner(end, end)) : Matrix(unbuilt.product(end));
  }

  /// Throws Error where sizes do not fit, a number is not one, blocks do not cover each row once, mu is
  /// negative, or no multiplier of a block changes its violation.
  void check(std::string_view where) const;
  void checkSizes(std::string_view where) const;  // and numbers, of that

  /// Adds a term to the compliance of each row.
  void regularise(double term);

  /// How far f is from a solution, in the unit of d: the largest |f - P(f - r (d + c))| / r over the blocks,
  /// with the projection P on what f may be, r = 1 / mean diagonal of W in the block, and c = mu |d_t| along
  /// the normal of a contact with friction (De Saxce 1992). Zero for solutions only.
  double residual() const;
};

/// The point of the cone |t| <= mu n that is nearest to (n, t).
SINEW_HD inline Eigen::Vector3d project_on_cone(Eigen::Vector3d const& f, double mu) {
  const double n = f[0], t = f.tail<2>().norm();
  if (t <= mu * n) return f;
  if (mu * t <= -n) return {0, 0, 0};
  const double onCone = (n + mu * t) / (1 + mu * mu);
  return {onCone, mu * onCone * f[1] / t, mu * onCone * f[2] / t};
}

/// Throws Error where blocks do not cover each of so many rows once, have a wrong number of them, a friction
/// that is negative or not finite, or ends of an interval in the wrong order.
void check_blocks(std::vector<ConstraintBlock> const& blocks, int rows, std::string_view where);

/// Throws Error where the diagonal of W, from a row on, has an entry that is not positive.
void check_movable(Eigen::Ref<Eigen::VectorXd const, 0, Eigen::InnerStride<>> const& compliance,
                   std::string_view where, int first = 0);

/// Equalities that depend on equalities before them: how many rows, and the first of them (-1: none).
struct DependentEqualities {
  int count = 0, first = -1;
};
/// Those of the rows before an end; none where W is not finite. `products`: W, or J J' of the same rows.
DependentEqualities dependent_equalities(std::vector<ConstraintBlock> const& blocks,
                                         ConstraintProblem::Matrix const& products, int end);

/// An equality that depends on equalities before it and asks for something else; row -1: none.
struct Contradiction {
  int row = -1;
  double by = 0;  // how far d of that row stays from 0 where d of the others is 0
};
/// The one that is furthest from what the others leave it. `products`: W, or J J' of the same rows.
Contradiction contradicting_equality(std::vector<ConstraintBlock> const& blocks,
                                     ConstraintProblem::Matrix const& products,
                                     Eigen::VectorXd const& freeViolation);

/// The row that is furthest from the condition of its block, by the violations of all rows, friction left
/// aside; -1: none is off.
int furthest_row(std::vector<ConstraintBlock> const& blocks, Eigen::VectorXd const& violation);

}  // namespace sinew

#if SINEW_DEFINES

namespace sinew {

SINEW_ONCE void check_blocks(std::vector<ConstraintBlock> const& blocks, int rows, std::string_view where) {
  int next = 0;
  for (ConstraintBlock const& b : blocks) {
    if (b.first != next || b.rows < 1 || b.rows > ConstraintBlock::maxRows || b.rows > rows - next)
      throw Error(where,
                  text("a block of constraints has rows ",
                       b.first,
                       " to ",
                       b.first + b.rows - 1,
                       " where ",
                       next,
                       " is the next of ",
                       rows,
                       "; blocks have 1 to ",
                       ConstraintBlock::maxRows,
                       " rows and follow each other without a gap"));
    if (b.kind == ConstraintBlock::Kind::friction &&
        (b.rows != 3 || !(b.friction >= 0) || !std::isfinite(b.friction)))
      throw Error(where,
                  text("the contact at row ",
                       b.first,
                       " has ",
                       b.rows,
                       " rows and the friction ",
                       b.friction,
                       "; it needs a normal and two tangents, and a finite friction of at least 0"));
    if (b.kind == ConstraintBlock::Kind::interval && (b.rows != 1 || !(b.lower <= b.upper)))
      throw Error(where,
                  text("the one-sided constraint at row ",
                       b.first,
                       " is between ",
                       b.lower,
                       " and ",
                       b.upper,
                       " with ",
                       b.rows,
                       " rows; it needs one row, and a lower end that is not above the upper one"));
    next += b.rows;
  }
  if (next != rows) throw Error(where, text("blocks of constraints cover ", next, " rows of ", rows));
}

SINEW_ONCE void check_movable(Eigen::Ref<Eigen::VectorXd const, 0, Eigen::InnerStride<>> const& compliance,
                              std::string_view where, int first) {
  for (int i = 0; i < int(compliance.size()); ++i)
    if (!(compliance[i] > 0))
      throw Error(where,
                  text("nothing that constraint ",
                       first + i,
                       " holds can move (its compliance is ",
                       compliance[i],
                       "): it is between fixed points, or its direction is zero"));
}

SINEW_ONCE void ConstraintProblem::checkSizes(std::string_view where) const {
  const auto n = freeViolation.size();
  const Eigen::Index rowsOfW = built ? compliance.rows() : unbuilt.rows();
  const Eigen::Index columnsOfW = built ? compliance.cols() : unbuilt.rows();
  if (rowsOfW != n || columnsOfW != n || multipliers.size() != n)
    throw Error(where,
                text("constraints have ",
                     n,
                     " violations, a compliance of ",
                     rowsOfW,
                     " x ",
                     columnsOfW,
                     " and ",
                     multipliers.size(),
                     " multipliers; give each as many"));
  if (!(built ? compliance.allFinite() : unbuilt.allFinite()) || !freeViolation.allFinite() ||
      !multipliers.allFinite())
    throw Error(where, "the compliance, a violation or a multiplier of constraints is not a finite number");
  check_blocks(blocks, int(n), where);
}

SINEW_ONCE void ConstraintProblem::check(std::string_view where) const {
  checkSizes(where);
  for (ConstraintBlock const& b : blocks) check_movable(own(b).diagonal(), where, b.first);
}

SINEW_ONCE Eigen::VectorXd ConstraintProblem::violation() const {
  if (built) return compliance * multipliers + freeViolation;
  Eigen::VectorXd d = freeViolation;
  unbuilt.addProduct(blocks, multipliers, d);
  return d;
}

SINEW_ONCE void ConstraintProblem::regularise(double term) {
  for (int i = 0; i < rows(); ++i) add(i, i, term);
}

SINEW_ONCE void ConstraintProblem::leaveOut(ConstraintBlock const& b, int row, double value) {
  if (!built) return unbuilt.leaveOut(b, row, value);
  compliance.row(row).setZero();
  compliance.col(row).setZero();
  compliance(row, row) = value;
}

SINEW_ONCE double ConstraintProblem::residual() const {
  double worst = 0;
  const Eigen::VectorXd all = built ? Eigen::VectorXd() : violation();
  for (ConstraintBlock const& b : blocks) {
    const BlockVector d = built ? violation(b) : BlockVector(all.segment(b.first, b.rows));
    const double r = b.rows / own(b).trace();
    switch (b.kind) {
      case ConstraintBlock::Kind::equality: {
        double squared = 0;
        for (int i = 0; i < b.rows; ++i) squared += d[i] * d[i];
        worst = std::max(worst, std::sqrt(squared));
        break;
      }
      case ConstraintBlock::Kind::interval: {
        // d may be anywhere in the interval; the nearest d that f permits
        const double f = multipliers[b.first];
        worst = std::max(worst, std::abs(d[0] - std::clamp(d[0] - f / r, b.lower, b.upper)));
        break;
      }
      case ConstraintBlock::Kind::friction: {
        const Eigen::Vector3d f = multipliers.segment<3>(b.first);
        Eigen::Vector3d v = d.head<3>();
        v[0] += b.friction * v.tail<2>().norm();
        worst = std::max(worst, (f - project_on_cone(f - r * v, b.friction)).norm() / r);
        break;
      }
    }
  }
  return worst;
}

namespace detail {

// f(row, d) for each row of an equality that depends on others before it, until f returns false: Cholesky's
// method row by row meets a pivot that is rounding, and leaves the row out. d is what the others, fulfilled,
// leave of the violation of the row.
template <class F>
void each_dependent(std::vector<ConstraintBlock> const& blocks, ConstraintProblem::Matrix const& products,
                    Eigen::VectorXd const& violation, F&& f) {
  std::vector<int> rows;  // that are independent
  const auto most = products.rows();
  Eigen::MatrixXd L = Eigen::MatrixXd::Zero(most, most);
  Eigen::VectorXd y = Eigen::VectorXd::Zero(most);
  for (ConstraintBlock const& b : blocks)
    for (int i = b.first; i < b.first + b.rows && b.kind == ConstraintBlock::Kind::equality; ++i) {
      const auto n = Eigen::Index(rows.size());
      for (Eigen::Index j = 0; j < n; ++j)
        L(n, j) = (products(i, rows[std::size_t(j)]) - L.row(n).head(j).dot(L.row(j).head(j))) / L(j, j);
      const double pivot = products(i, i) - L.row(n).head(n).squaredNorm();
      const double left = violation[i] - L.row(n).head(n).dot(y.head(n));
      if (pivot > 1e-12 * products(i, i)) {
        L(n, n) = std::sqrt(pivot);
        y[n] = left / L(n, n);
        rows.push_back(i);
      } else if (!f(i, left)) {
        return;
      }
    }
}

}  // namespace detail

SINEW_ONCE DependentEqualities dependent_equalities(std::vector<ConstraintBlock> const& blocks,
                                                    ConstraintProblem::Matrix const& products, int end) {
  DependentEqualities found;
  std::vector<ConstraintBlock> before;
  for (ConstraintBlock const& b : blocks)
    if (b.first + b.rows <= end) before.push_back(b);
  const ConstraintProblem::Matrix part = products.topLeftCorner(end, end);
  if (part.allFinite())
    detail::each_dependent(before, part, Eigen::VectorXd::Zero(end), [&](int row, double) {
      if (found.count++ == 0) found.first = row;
      return true;
    });
  return found;
}

SINEW_ONCE Contradiction contradicting_equality(std::vector<ConstraintBlock> const& blocks,
                                                ConstraintProblem::Matrix const& products,
                                                Eigen::VectorXd const& freeViolation) {
  Contradiction worst;
  if (!products.allFinite() || freeViolation.size() == 0) return worst;
  // what rounding leaves
  worst.by = 1e-9 * freeViolation.lpNorm<Eigen::Infinity>();
  detail::each_dependent(blocks, products, freeViolation, [&](int row, double left) {
    if (std::abs(left) > worst.by) worst = {row, std::abs(left)};
    return true;
  });
  return worst;
}

SINEW_ONCE int furthest_row(std::vector<ConstraintBlock> const& blocks, Eigen::VectorXd const& violation) {
  int furthest = -1;
  double largest = 0;
  for (ConstraintBlock const& b : blocks)
    for (int i = b.first; i < b.first + b.rows; ++i) {
      double d = 0;
      if (b.kind == ConstraintBlock::Kind::equality)
        d = std::abs(violation[i]);
      else if (b.kind == ConstraintBlock::Kind::interval)
        d = std::max(b.lower - violation[i], violation[i] - b.upper);
      else if (i == b.first)
        d = -violation[i];
      if (d > largest) largest = d, furthest = i;
    }
  return furthest;
}

}  // namespace sinew
#endif
