// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/lagrangian/constraint_terms.hpp>
#include <sinew/lagrangian/convex_schedule.hpp>
#include <sinew/lagrangian/convex_step_settings.hpp>
#include <sinew/lagrangian/convex_updates.hpp>
#include <sinew/lagrangian/exact_line_search.hpp>

#include <Eigen/Core>

#include <algorithm>
#include <cmath>
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
  ConvexUpdates updates_{};
  ConstraintTerms& terms() { return updates_.terms; }
  Eigen::VectorXd momentum_{}, reaction_{};  // A v - b, J' f
  Eigen::VectorXd gradient_{}, step_{}, residual_{}, scaled_{}, direction_{}, product_{};
  Eigen::VectorXd rate_{};  // J dv
  // the last solution of a problem that is about as good as any
  ReservedVector goodVelocity_{}, goodMultipliers_{};
  ConvexBest best_{};

  /// Keeps the solution of a problem, or says that it is far worse than an earlier one.
  bool keeps(Eigen::VectorXd const& velocity, ConvexStepResult const& result);

  /// The size of the gradient.
  template <class Preconditioner>
  double evaluate(Preconditioner& preconditioner, Eigen::VectorXd const& b, Eigen::VectorXd const& velocity,
                  ConvexStepResult& result);
  /// False where no direction was found.
  template <class System, class Preconditioner>
  bool newton(System& multiply, Preconditioner& preconditioner, Eigen::VectorXd& velocity,
              ConvexStepSettings const& settings, ConvexStepResult& result);
};

template <class Preconditioner>
double ConvexStep::evaluate(Preconditioner& preconditioner, Eigen::VectorXd const& b,
                            Eigen::VectorXd const& velocity, ConvexStepResult& result) {
  reaction_.setZero();
  terms().rows().addTransposed(terms().multipliers, reaction_);
  gradient_ = momentum_ - reaction_;
  terms().evaluateCurvature();
  preconditioner.update(terms());
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
  terms().begin(J, blocks, start, multipliers, settings.friction);
  preconditioner.begin(terms(), updates_.compliance);
  check_movable(updates_.compliance.head(J.rows()), where);
  updates_.begin(settings);
  for (Eigen::VectorXd* v :
       {&momentum_, &reaction_, &gradient_, &step_, &residual_, &scaled_, &direction_, &product_})
    v->resize(b.size());
  goodVelocity_.setZero(b.size());
  goodMultipliers_.setZero(J.rows());

  terms().evaluate(velocity);
  best_ = {};
  while (true) {
    multiply(velocity, momentum_);
    momentum_ -= b;
    double size = evaluate(preconditioner, b, velocity, result);
    const double first = size;
    bool stuck = false;
    for (int i = 0; i < settings.maxNewtonIterations && !stuck; ++i) {
      if (!std::isfinite(size)) refuse_unbounded_step(where);
      result.residual = updates_.residual();
      if (result.momentum <= settings.momentumTolerance) break;
      // the last problem is solved to the end
      if (size <= settings.reduction * first && result.residual > settings.tolerance) break;
      stuck = result.conjugateGradients >= settings.maxConjugateGradients ||
              !newton(multiply, preconditioner, velocity, settings, result);
      size = evaluate(preconditioner, b, velocity, result);
    }
    result.residual = updates_.residual();
    result.converged = result.residual <= settings.tolerance && result.momentum <= settings.momentumTolerance;
    if (result.converged) break;
    if (!keeps(velocity, result)) break;
    if (stuck || result.updates == settings.maxUpdates) break;
    ++result.updates;
    updates_.update(settings, result.residual);
  }
  if (!result.converged) {
    velocity = goodVelocity_;
    terms().multipliers.head(J.rows()) = goodMultipliers_;
    result.residual = best_.residual;
    result.momentum = best_.momentum;
  }
  multipliers = terms().multipliers.head(J.rows());
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
    preconditioner.addProduct(terms(), direction_, product_);
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
  preconditioner.addProduct(terms(), step_, product_);
  product_ += gradient_ + residual_;
  product_ = -product_;
  terms().rows().multiply(step_, rate_);
  const double t = exact_line_search(
      step_.dot(momentum_),
      step_.dot(product_),
      [&](double at) { return terms().slope(at, rate_); },
      result.lineSearches);
  velocity += t * step_;
  momentum_ += t * product_;
  terms().advance(t, rate_);
  return true;
}

}  // namespace sinew

#if SINEW_DEFINES

namespace sinew {

SINEW_ONCE bool ConvexStep::keeps(Eigen::VectorXd const& velocity, ConvexStepResult const& result) {
  const ConvexBest::Found found = best_.look(result.residual, result.momentum);
  if (found == ConvexBest::Found::good) {
    goodVelocity_ = velocity;
    goodMultipliers_ = terms().multipliers.head(terms().rows().rows());
  }
  return found != ConvexBest::Found::farWorse;
}

}  // namespace sinew
#endif
