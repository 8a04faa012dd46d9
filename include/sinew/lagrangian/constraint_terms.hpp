// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/lagrangian/contact_potential.hpp>
#include <sinew/lagrangian/jacobian_rows.hpp>

#include <Eigen/Core>

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

namespace sinew {

/// The constraints of a step as terms of a convex function of the velocity v: sum_b l_b(d_b + s_b) with the
/// violation d = J v + d_0, the potentials l of contact_potential.hpp, and the lagged gap s along the normal
/// of contacts, or the lagged bound c of their friction. Vectors over the rows are never made shorter, so
/// that contacts may come and go; what is behind the last row is 0.
class ConstraintTerms {
 public:
  Eigen::VectorXd regularisation{};  // r of each row, in the unit of the compliance W = J A^-1 J'
  Eigen::VectorXd violation{};       // d
  Eigen::VectorXd multipliers{};     // f
  Eigen::VectorXd before{};          // g

  /// The rows and blocks are referred to until the next solution. `start`: d_0, the violation at v = 0.
  void begin(JacobianRows const& J, std::vector<ConstraintBlock> const& blocks, Eigen::VectorXd const& start,
             Eigen::VectorXd const& guess, FrictionLag lag);
  /// At least n zeros.
  static void clear(Eigen::Index n, Eigen::VectorXd& of);

  JacobianRows const& rows() const { return *J_; }
  std::vector<ConstraintBlock> const& blocks() const { return *blocks_; }
  /// The lagged bound or gap, at the row of the normal of each contact.
  Eigen::VectorXd const& lagged() const { return lag_; }
  double const* curvature(ConstraintBlock const& b) const { return curvature_.data() + 3 * b.first; }

  /// d and f at the velocity v.
  void evaluate(Eigen::VectorXd const& v);
  /// d += t w, for a change of v by t times what J makes w of.
  void advance(double t, Eigen::VectorXd const& w);
  void evaluateCurvature();

  using Slope = contact_potential::Slope;
  /// Of t -> sum l(d + t w + s).
  Slope slope(double t, Eigen::VectorXd const& w) const;
  /// sum l(d + s)
  double value() const;

  /// g, inside the cones, and what is lagged: c = mu g_n, or s of the contacts that slide or are open at d.
  void update(Eigen::VectorXd const& multipliersBefore);

  FrictionLag lag() const { return kind_; }
  /// What is lagged, as another has found it.
  void setLagged(Eigen::Ref<Eigen::VectorXd const> const& lagged) { lag_.head(lagged.size()) = lagged; }
  /// The same problem, of which something else is lagged; from d and f as they are.
  void change(FrictionLag lag);

  /// The largest natural map of the blocks (contact_potential.hpp), with an estimate of the diagonal of W.
  double residual(Eigen::VectorXd const& compliance) const;

  /// The largest contact_potential::Rest of the blocks.
  contact_potential::Rest rest(Eigen::VectorXd const& compliance) const;

 private:
  using Values = std::array<double, ConstraintBlock::maxRows>;

  JacobianRows const* J_ = nullptr;
  std::vector<ConstraintBlock> const* blocks_ = nullptr;
  FrictionLag kind_ = FrictionLag::bound;
  Eigen::VectorXd start_{}, lag_{};  // d_0; c or s at the row of the normal
  Eigen::VectorXd curvature_{};

  contact_potential::Rows of(ConstraintBlock const& b) const {
    return {regularisation.data() + b.first,
            before.data() + b.first,
            kind_ == FrictionLag::bound ? lag_[b.first] : contact_potential::cone};
  }
  // d + t w + s of a block
  Values at(ConstraintBlock const& b, double t, Eigen::VectorXd const& w) const;
  void setBefore(Eigen::VectorXd const& f);
  void evaluateMultipliers();
};

}  // namespace sinew

#if SINEW_DEFINES

namespace sinew {

SINEW_ONCE void ConstraintTerms::begin(JacobianRows const& J, std::vector<ConstraintBlock> const& blocks,
                                       Eigen::VectorXd const& start, Eigen::VectorXd const& guess,
                                       FrictionLag lag) {
  J_ = &J;
  blocks_ = &blocks;
  kind_ = lag;
  const Eigen::Index n = start.size();
  for (Eigen::VectorXd* of : {&start_, &lag_, &regularisation, &violation, &multipliers, &before})
    clear(n, *of);
  clear(3 * n, curvature_);
  start_.head(n) = start;
  regularisation.head(n).setOnes();
  setBefore(guess);
}

SINEW_ONCE void ConstraintTerms::clear(Eigen::Index n, Eigen::VectorXd& of) {
  if (of.size() < n) of.resize(n);
  of.setZero();
}

SINEW_ONCE void ConstraintTerms::evaluate(Eigen::VectorXd const& v) {
  J_->multiply(v, violation);
  violation += start_;
  evaluateMultipliers();
}

SINEW_ONCE void ConstraintTerms::advance(double t, Eigen::VectorXd const& w) {
  const Eigen::Index n = J_->rows();  // both may have room for more
  violation.head(n) += t * w.head(n);
  evaluateMultipliers();
}

SINEW_ONCE void ConstraintTerms::evaluateCurvature() {
  for (ConstraintBlock const& b : *blocks_)
    contact_potential::curvature(b, of(b), at(b, 0, violation).data(), curvature_.data() + 3 * b.first);
}

SINEW_ONCE ConstraintTerms::Slope ConstraintTerms::slope(double t, Eigen::VectorXd const& w) const {
  Slope sum;
  for (ConstraintBlock const& b : *blocks_) {
    const Slope one = contact_potential::slope(b, of(b), at(b, t, w).data(), w.data() + b.first);
    sum.first += one.first;
    sum.second += one.second;
  }
  return sum;
}

SINEW_ONCE double ConstraintTerms::value() const {
  double sum = 0;
  for (ConstraintBlock const& b : *blocks_)
    sum += contact_potential::value(b, of(b), at(b, 0, violation).data());
  return sum;
}

SINEW_ONCE void ConstraintTerms::update(Eigen::VectorXd const& multipliersBefore) {
  for (ConstraintBlock const& b : *blocks_)
    if (b.kind == ConstraintBlock::Kind::friction && kind_ == FrictionLag::gap)
      lag_[b.first] = contact_potential::next_gap(
          b, violation.data() + b.first, multipliers.data() + b.first, lag_[b.first]);
  setBefore(multipliersBefore);
  evaluateMultipliers();
}

SINEW_ONCE void ConstraintTerms::change(FrictionLag lag) {
  kind_ = lag;
  lag_.setZero();
  if (lag == FrictionLag::gap)
    for (ConstraintBlock const& b : *blocks_)
      if (b.kind == ConstraintBlock::Kind::friction)
        lag_[b.first] = std::min(b.friction, contact_potential::largestFriction) *
                        violation.segment<2>(b.first + 1).norm();
  setBefore(multipliers);
  evaluateMultipliers();
}

SINEW_ONCE ConstraintTerms::Values ConstraintTerms::at(ConstraintBlock const& b, double t,
                                                       Eigen::VectorXd const& w) const {
  Values sum;
  for (int i = 0; i < b.rows; ++i) sum[std::size_t(i)] = violation[b.first + i] + t * w[b.first + i];
  if (kind_ == FrictionLag::gap) sum[0] += lag_[b.first];
  return sum;
}

SINEW_ONCE void ConstraintTerms::setBefore(Eigen::VectorXd const& f) {
  for (ConstraintBlock const& b : *blocks_)
    contact_potential::take_before(b, kind_, f.data() + b.first, before.data() + b.first, lag_[b.first]);
}

SINEW_ONCE void ConstraintTerms::evaluateMultipliers() {
  for (ConstraintBlock const& b : *blocks_)
    contact_potential::multipliers(b, of(b), at(b, 0, violation).data(), multipliers.data() + b.first);
}

SINEW_ONCE double ConstraintTerms::residual(Eigen::VectorXd const& compliance) const {
  double worst = 0;
  for (ConstraintBlock const& b : *blocks_)
    worst = std::max(worst,
                     contact_potential::natural_map(b,
                                                    kind_,
                                                    compliance.segment(b.first, b.rows).mean(),
                                                    violation.data() + b.first,
                                                    multipliers.data() + b.first));
  return worst;
}

SINEW_ONCE contact_potential::Rest ConstraintTerms::rest(Eigen::VectorXd const& compliance) const {
  contact_potential::Rest worst;
  for (ConstraintBlock const& b : *blocks_) {
    const auto one = contact_potential::rest(b,
                                             kind_,
                                             of(b),
                                             compliance[b.first],
                                             lag_[b.first],
                                             violation.data() + b.first,
                                             multipliers.data() + b.first);
    worst.regularisation = std::max(worst.regularisation, one.regularisation);
    worst.lag = std::max(worst.lag, one.lag);
  }
  return worst;
}

}  // namespace sinew
#endif
