// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/lagrangian/constraint_sweeps.hpp>

namespace sinew {

/// Block Gauss-Seidel without W (SOFA's UnbuiltGaussSeidelConstraintSolver): an operator answers for one
/// block at a time, out of the motion u = A^-1 J' f that it keeps, so that a sweep costs as many products as
/// there are blocks, and no room grows with the square of their number.
///
/// When solve() begins, the operator has the motion without multipliers; solve() tells it each change of
/// them, those of the first guess and of relaxation too. Where the result is not finite, its motion is that
/// of no multipliers in particular.
class UnbuiltGaussSeidel {
 public:
  template <ConstraintOperator O>
  SweepResult solve(O& problem, std::vector<ConstraintBlock> const& blocks,
                    Eigen::Ref<Eigen::VectorXd> multipliers, SweepSettings const& settings,
                    std::string_view where) {
    double scale = begin(problem, blocks, multipliers, where);
    SweepResult result;
    if (blocks.empty()) return result;
    result.converged = false;
    while (result.iterations < settings.maxIterations && !result.converged) {
      if (settings.relaxation != 1) last_ = multipliers;
      SweepChange change;
      for (std::size_t k = 0; k < blocks.size(); ++k)
        relax_block(problem, blocks, k, inverses_[k], multipliers, change);
      ++result.iterations;
      if (settings.relaxation != 1) relax(problem, blocks, multipliers, settings.relaxation);
      if (runs_away(result, change.rows, scale, multipliers)) break;
      result.error = settings.allVerified ? change.largest : change.rows;
      result.converged = result.error <= settings.limit(multipliers.size());
    }
    return result;
  }

 private:
  std::vector<BlockMatrix> inverses_{};  // of W_bb, for equalities
  ReservedVector last_{};

  // what there is to correct, for runs_away
  template <class O>
  double begin(O& problem, std::vector<ConstraintBlock> const& blocks,
               Eigen::Ref<Eigen::VectorXd const> const& multipliers, std::string_view where) {
    check_blocks(blocks, int(multipliers.size()), where);
    inverses_.resize(blocks.size());
    double scale = std::numeric_limits<double>::min();
    for (std::size_t k = 0; k < blocks.size(); ++k) {
      ConstraintBlock const& b = blocks[k];
      BlockMatrix const w = problem.diagonal(k);
      const BlockVector d = problem.violation(k);
      auto const f = multipliers.segment(b.first, b.rows);
      if (!w.allFinite() || !d.allFinite() || !f.allFinite())
        throw Error(where,
                    text("the compliance, the violation or a multiplier of the constraints from row ",
                         b.first,
                         " on is not a finite number"));
      check_movable(w.diagonal(), where, b.first);
      if (b.kind == ConstraintBlock::Kind::equality) inverses_[k] = inverse_compliance(w, b, where);
      scale += size_of_block(b, w, d, f);
    }
    for (std::size_t k = 0; k < blocks.size(); ++k) {
      const BlockVector f = multipliers.segment(blocks[k].first, blocks[k].rows);
      if ((f.array() != 0).any()) problem.change(k, f);
    }
    return scale;
  }

  template <class O>
  void relax(O& problem, std::vector<ConstraintBlock> const& blocks, Eigen::Ref<Eigen::VectorXd> multipliers,
             double relaxation) {
    for (std::size_t k = 0; k < blocks.size(); ++k) {
      auto f = multipliers.segment(blocks[k].first, blocks[k].rows);
      const BlockVector step = (1 - relaxation) * (last_.segment(blocks[k].first, blocks[k].rows) - f);
      f += step;
      if ((step.array() != 0).any()) problem.change(k, step);
    }
  }
};

}  // namespace sinew
