// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/lagrangian/anderson_acceleration.hpp>
#include <sinew/lagrangian/constraint_terms.hpp>
#include <sinew/lagrangian/convex_step_settings.hpp>

#include <Eigen/Core>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string_view>
#include <vector>

namespace sinew {

/// A step with constraints as a sequence of convex problems without any,
///   min_v 1/2 v' A v - b' v + sum_i l_i(J_i v + d_0i),
/// the same as 1/2 |v - v*|^2_A of the free velocity v* = A^-1 b, which is not needed (Castro, Permenter, Han
/// 2022; Todorov 2014). A is known by products alone. Newton's method, whose equation (A + J' G J) dv = -grad
/// is solved by conjugate gradients up to `forcing`, with an exact line search; then l is moved to the
/// multipliers found (augmented Lagrangian; Hestenes 1969), until J v + d_0 and f fulfil the conditions of
/// their blocks, Coulomb's law included. The regularisation begins soft, so that the first problems have no
/// sharp kinks and are well conditioned; they find out which contacts slide. Where updates converge slowly,
/// they are accelerated, or the other part of Coulomb's law is lagged.
///
/// One object serves a scene for all its steps; it allocates only where a step has more dofs or rows than
/// any before. Results do not depend on what it solved before.
class ConvexStep {
 public:
  /// `multiply(p, q)`: q = A p, A symmetric and positive definite. `preconditioner`: what has the functions
  /// of ConstrainedBlockJacobi: dofs; begin, which estimates the diagonal of W; update, for
  /// A + J' G J; addProduct, of J' G J; apply, which is symmetric and positive definite. `start`: d_0, the
  /// violation at v = 0, as g / h. `velocity` and `multipliers`: the first guess, then the solution; with
  /// zero multipliers the start is cold. Throws Error for sizes that do not fit, numbers that are not finite,
  /// blocks that check_blocks refuses, and rows that nothing can move.
  template <class System, class Preconditioner>
  ConvexStepResult solve(System&& multiply, Preconditioner& preconditioner, Eigen::VectorXd const& b,
                         JacobianRows const& J, std::vector<ConstraintBlock> const& blocks,
                         Eigen::VectorXd const& start, Eigen::VectorXd& velocity,
                         Eigen::VectorXd& multipliers, ConvexStepSettings const& settings,
                         std::string_view where);

 private:
  ConstraintTerms terms_{};
  AndersonAcceleration acceleration_{};
  Eigen::VectorXd compliance_{};             // estimate of the diagonal of W
  Eigen::VectorXd momentum_{}, reaction_{};  // A v - b, J' f
  Eigen::VectorXd gradient_{}, step_{}, residual_{}, scaled_{}, direction_{}, product_{};
  Eigen::VectorXd rate_{}, next_{};  // J dv; g of the next update
  double relative_ = 0;              // of r, the regularisation
  bool accelerating_ = false;
  double last_ = 0, best_ = 0;  // residuals
  int since_ = 0;               // updates since the best

  void begin(ConvexStepSettings const& settings);
  void regularise(double relative);
  /// What changes between two problems: r, g and what is lagged.
  void update(ConvexStepSettings const& settings, double residual);

  /// The size of the gradient.
  template <class Preconditioner>
  double evaluate(Preconditioner& preconditioner, Eigen::VectorXd const& b, Eigen::VectorXd const& velocity,
                  ConvexStepResult& result);
  /// False where no direction was found.
  template <class System, class Preconditioner>
  bool newton(System& multiply, Preconditioner& preconditioner, Eigen::VectorXd& velocity,
              ConvexStepSettings const& settings, ConvexStepResult& result);
  double lineSearch(double slope, double curvature, ConvexStepResult& result) const;
};

template <class Preconditioner>
double ConvexStep::evaluate(Preconditioner& preconditioner, Eigen::VectorXd const& b,
                            Eigen::VectorXd const& velocity, ConvexStepResult& result) {
  reaction_.setZero();
  terms_.rows().addTransposed(terms_.multipliers, reaction_);
  gradient_ = momentum_ - reaction_;
  terms_.evaluateCurvature();
  preconditioner.update(terms_);
  preconditioner.apply(reaction_, scaled_);
  const double energy = velocity.dot(momentum_) + velocity.dot(b);  // v' A v
  const double whole = std::sqrt(std::max({0., energy, reaction_.dot(scaled_)}));
  preconditioner.apply(gradient_, scaled_);
  const double size = std::sqrt(std::max(0., gradient_.dot(scaled_)));
  result.momentum = whole > 0 ? size / whole : size;
  return size;
}

template <class System, class Preconditioner>
ConvexStepResult ConvexStep::solve(System&& multiply, Preconditioner& preconditioner,
                                   Eigen::VectorXd const& b, JacobianRows const& J,
                                   std::vector<ConstraintBlock> const& blocks, Eigen::VectorXd const& start,
                                   Eigen::VectorXd& velocity, Eigen::VectorXd& multipliers,
                                   ConvexStepSettings const& settings, std::string_view where) {
  check_convex_step(b, J, blocks, start, velocity, multipliers, where);
  check_convex_step(settings, where);
  if (preconditioner.dofs() != int(b.size()))
    throw Error(where,
                text("a step of ",
                     b.size(),
                     " dofs has a preconditioner of ",
                     preconditioner.dofs(),
                     "; give it the blocks of each point"));
  ConvexStepResult result;
  terms_.begin(J, blocks, start, multipliers, settings.friction);
  preconditioner.begin(terms_, compliance_);
  check_movable(compliance_.head(J.rows()), where);
  begin(settings);
  for (Eigen::VectorXd* v :
       {&momentum_, &reaction_, &gradient_, &step_, &residual_, &scaled_, &direction_, &product_})
    v->resize(b.size());

  terms_.evaluate(velocity);
  while (true) {
    multiply(velocity, momentum_);
    momentum_ -= b;
    double size = evaluate(preconditioner, b, velocity, result);
    const double first = size;
    bool stuck = false;
    for (int i = 0; i < settings.maxNewtonIterations && !stuck; ++i) {
      if (!std::isfinite(size))
        throw Error(where,
                    "the system of a step with constraints is not finite; see whether the time step is too "
                    "large for the forces before it");
      result.residual = terms_.residual(compliance_);
      if (result.momentum <= settings.momentumTolerance) break;
      // the last problem is solved to the end
      if (size <= settings.reduction * first && result.residual > settings.tolerance) break;
      stuck = result.conjugateGradients >= settings.maxConjugateGradients ||
              !newton(multiply, preconditioner, velocity, settings, result);
      size = evaluate(preconditioner, b, velocity, result);
    }
    result.residual = terms_.residual(compliance_);
    result.converged = result.residual <= settings.tolerance && result.momentum <= settings.momentumTolerance;
    if (result.converged || stuck || result.updates == settings.maxUpdates) break;
    ++result.updates;
    update(settings, result.residual);
  }
  multipliers = terms_.multipliers.head(J.rows());
  return result;
}

template <class System, class Preconditioner>
bool ConvexStep::newton(System& multiply, Preconditioner& preconditioner, Eigen::VectorXd& velocity,
                        ConvexStepSettings const& settings, ConvexStepResult& result) {
  ++result.newtonIterations;
  step_.setZero();
  residual_ = -gradient_;
  scaled_ = -scaled_;
  direction_ = scaled_;
  double rho = residual_.dot(scaled_);
  const double end = settings.forcing * settings.forcing * rho;
  bool found = false;
  while (rho > end && result.conjugateGradients < settings.maxConjugateGradients) {
    ++result.conjugateGradients;
    multiply(direction_, product_);
    preconditioner.addProduct(terms_, direction_, product_);
    const double curvature = direction_.dot(product_);
    if (!(curvature > 0)) break;
    found = true;
    const double alpha = rho / curvature;
    step_ += alpha * direction_;
    residual_ -= alpha * product_;
    preconditioner.apply(residual_, scaled_);
    const double next = residual_.dot(scaled_);
    direction_ = scaled_ + (next / rho) * direction_;
    rho = next;
  }
  if (!found) return false;
  // A dv = -grad - residual - J' G J dv
  product_.setZero();
  preconditioner.addProduct(terms_, step_, product_);
  product_ += gradient_ + residual_;
  product_ = -product_;
  terms_.rows().multiply(step_, rate_);
  const double t = lineSearch(step_.dot(momentum_), step_.dot(product_), result);
  velocity += t * step_;
  momentum_ += t * product_;
  terms_.advance(t, rate_);
  return true;
}

}  // namespace sinew

#if SINEW_DEFINES

namespace sinew {

SINEW_ONCE void ConvexStep::regularise(double relative) {
  relative_ = relative;
  for (ConstraintBlock const& b : terms_.blocks())
    if (b.kind == ConstraintBlock::Kind::friction)
      terms_.regularisation.segment<3>(b.first).setConstant(relative *
                                                            compliance_.segment<3>(b.first).mean());
    else
      terms_.regularisation.segment(b.first, b.rows) = relative * compliance_.segment(b.first, b.rows);
}

SINEW_ONCE void ConvexStep::begin(ConvexStepSettings const& settings) {
  acceleration_.reset(terms_.rows().rows());
  accelerating_ = false;
  since_ = 0;
  last_ = best_ = std::numeric_limits<double>::infinity();
  regularise(std::max(settings.regularisation, settings.firstRegularisation));
}

SINEW_ONCE void ConvexStep::update(ConvexStepSettings const& settings, double residual) {
  if (residual < 0.5 * best_) {
    best_ = residual;
    since_ = 0;
  } else if (++since_ == settings.patience && terms_.lag() != FrictionLag::none) {
    begin(settings);
    terms_.change(terms_.lag() == FrictionLag::gap ? FrictionLag::bound : FrictionLag::gap);
    return;
  }
  const double contraction = residual / last_;
  last_ = residual;
  next_ = terms_.multipliers;
  if (relative_ > settings.regularisation) {
    regularise(std::max(settings.regularisation, settings.decrease * relative_));
  } else if (contraction > 0.3) {
    const auto rest = terms_.rest(compliance_);
    if (rest.regularisation > rest.lag && relative_ > settings.leastRegularisation) {
      regularise(std::max(settings.leastRegularisation, settings.decrease * relative_));
      acceleration_.reset(terms_.rows().rows());
    } else {
      accelerating_ = true;
    }
  }
  if (accelerating_ && terms_.lag() == FrictionLag::bound) {
    next_ = terms_.before;
    acceleration_.next(terms_.multipliers, compliance_, next_);
  }
  terms_.update(next_);
}

// The t where the derivative of the convex function 1/2 t^2 curvature + t slope + sum l(d + t J dv) vanishes:
// Newton's method inside the interval in which it changes its sign.
SINEW_ONCE double ConvexStep::lineSearch(double slope, double curvature, ConvexStepResult& result) const {
  const double first = std::abs(slope + terms_.slope(0, rate_).first);
  double low = 0, high = std::numeric_limits<double>::infinity(), t = 1;
  for (int i = 0; i < 50; ++i) {
    ++result.lineSearches;
    const ConstraintTerms::Slope terms = terms_.slope(t, rate_);
    const double at = slope + t * curvature + terms.first;
    if (!(std::abs(at) > 1e-3 * first)) break;
    (at < 0 ? low : high) = t;
    double next = t - at / (curvature + terms.second);
    if (!(next > low && next < high)) next = std::isinf(high) ? 2 * low : (low + high) / 2;
    if (next == t) break;
    t = next;
  }
  return t;
}

}  // namespace sinew
#endif
