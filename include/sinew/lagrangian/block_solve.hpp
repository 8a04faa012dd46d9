// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/lagrangian/constraint_problem.hpp>

#include <algorithm>
#include <cmath>
#include <string_view>
#include <vector>

namespace sinew {

// What all iterations over the blocks of constraints share: the solution of one block for its own
// multipliers, those of the others as they are, and a measure of what it changes.

/// W_bb^-1 of a block of equalities; an Error where they depend on each other.
BlockMatrix inverse_compliance(BlockMatrix const& w, ConstraintBlock const& b, std::string_view where);

/// The multipliers f of a block, from their last value and the violation d that it has with this. w is W_bb,
/// `inverse` its inverse for equalities. With a weight, d is the violation times that: ends of intervals are
/// weighed, too.
template <class W>
void solve_block(ConstraintBlock const& b, W const& w, BlockMatrix const& inverse, BlockVector const& d,
                 BlockVector& f, double weight = 1) {
  switch (b.kind) {
    case ConstraintBlock::Kind::equality:
      f -= inverse * d;
      break;
    case ConstraintBlock::Kind::interval: {
      const double without = d[0] - w(0, 0) * f[0];
      f[0] = (std::clamp(without, weight * b.lower, weight * b.upper) - without) / w(0, 0);
      break;
    }
    case ConstraintBlock::Kind::friction: {
      // first along the normal, then along the tangents by the mean of their compliances, then back onto the
      // cone (Duriez et al. 2006)
      const double before = f[0];
      f[0] -= d[0] / w(0, 0);
      if (f[0] < 0) {
        f.setZero();
        break;
      }
      const double tangential = (w(1, 1) + w(2, 2)) / 2;
      for (int t = 1; t <= 2; ++t) f[t] -= (d[t] + w(t, 0) * (f[0] - before)) / tangential;
      const double held = std::hypot(f[1], f[2]), allowed = b.friction * f[0];
      if (held > allowed) f.tail(2) *= allowed / held;
      break;
    }
  }
}

/// What an iteration changes, each in the unit of the violation.
struct SweepChange {
  double rows = 0;     // sum over the rows i of sqrt(sum_j (W_ij step_j)^2), j in the block of i
  double largest = 0;  // of these
  double blocks = 0;   // sum over the blocks of |W_bb step_b|

  template <class W>
  void add(W const& w, BlockVector const& step) {
    double squared = 0;
    for (int i = 0; i < step.size(); ++i) {
      double row = 0, product = 0;
      for (int j = 0; j < step.size(); ++j) {
        const double part = w(i, j) * step[j];
        row += part * part;
        product += part;
      }
      row = std::sqrt(row);
      rows += row;
      largest = std::max(largest, row);
      squared += product * product;
    }
    blocks += std::sqrt(squared);
  }
};

/// What an iteration may have to correct in a block, in the unit of the violation: that, what the first guess
/// does, and where the interval ends.
template <class W>
double size_of_block(ConstraintBlock const& b, W const& w, BlockVector const& d, BlockVector const& f) {
  SweepChange guessed;
  guessed.add(w, f);
  double size = d.lpNorm<1>() + guessed.rows;
  if (b.kind == ConstraintBlock::Kind::interval)
    for (const double end : {b.lower, b.upper})
      if (std::isfinite(end)) size += std::abs(end);
  return size;
}

/// One block of Gauss-Seidel over W: solved for its own multipliers, those of the others as they are.
void relax_block(ConstraintProblem& problem, ConstraintBlock const& b, BlockMatrix const& inverse,
                 SweepChange& change);

}  // namespace sinew

#if SINEW_DEFINES
#include <Eigen/Cholesky>

namespace sinew {

SINEW_ONCE BlockMatrix inverse_compliance(BlockMatrix const& w, ConstraintBlock const& b,
                                          std::string_view where) {
  const Eigen::LDLT<BlockMatrix> factor(w);
  const BlockVector pivots = factor.vectorD();
  if (!(pivots.minCoeff() > 1e-13 * pivots.maxCoeff()))
    throw Error(where,
                text("the equalities in rows ",
                     b.first,
                     " to ",
                     b.first + b.rows - 1,
                     " depend on each other, so that their multipliers are not determined; leave one out"));
  // column by column, since nvcc takes Eigen's solution for a matrix for a function of the device
  BlockMatrix inverse(b.rows, b.rows);
  for (int c = 0; c < b.rows; ++c) {
    const BlockVector unit = BlockVector::Unit(b.rows, c);
    const BlockVector column = factor.solve(unit);
    inverse.col(c) = column;
  }
  return inverse;
}

SINEW_ONCE void relax_block(ConstraintProblem& problem, ConstraintBlock const& b, BlockMatrix const& inverse,
                            SweepChange& change) {
  auto const w = problem.own(b);
  const BlockVector d = problem.violation(b);
  const BlockVector before = problem.multipliers.segment(b.first, b.rows);
  BlockVector f = before;
  solve_block(b, w, inverse, d, f);
  problem.multipliers.segment(b.first, b.rows) = f;
  const BlockVector step = f - before;
  problem.moved(b, step);
  change.add(w, step);
}

}  // namespace sinew
#endif
