// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/lagrangian/constraint_sweeps.hpp>

#include <string_view>

namespace sinew {

/// W f = -d_free by conjugate residuals (Stiefel 1955; Saad, Iterative Methods for Sparse Linear Systems,
/// 6.8) for S W S with S = diag(W)^-1/2. With r = -S (W f + d_free), W~ = S W S and p = r at first,
///   a = r.W~ r / |W~ p|^2,   f += a S p,   r -= a W~ p,   p = r + b p,   b = r.W~ r / that before
/// |r| falls in each iteration, also where W is singular. Where equations contradict each other what they
/// leave of r stays.
class ConjugateResiduals {
 public:
  /// From f = 0, by at most as many iterations as there are rows. `result.error`: of the violations W f +
  /// d_free, the sum over the blocks of their length, or with allVerified the largest one. Throws Error where
  /// ConstraintProblem::check does.
  SweepResult solve(ConstraintProblem& problem, SweepSettings const& settings, std::string_view where);

 private:
  ReservedVector scale_{}, r_{}, p_{}, ofR_{}, ofP_{}, room_{};  // S, r, p, W~ r, W~ p
};

}  // namespace sinew

#if SINEW_DEFINES
#include <algorithm>
#include <cmath>

namespace sinew {

SINEW_ONCE SweepResult ConjugateResiduals::solve(ConstraintProblem& problem, SweepSettings const& settings,
                                                 std::string_view where) {
  problem.check(where);
  const Eigen::Index n = problem.rows();
  SweepResult result;
  problem.multipliers.setZero();
  if (n == 0) return result;
  scale_.resize(n);
  scale_ = problem.compliance.diagonal().array().rsqrt().matrix();
  for (ReservedVector* v : {&r_, &p_, &ofR_, &ofP_, &room_}) v->setZero(n);
  auto multiply = [&](ReservedVector const& x, ReservedVector& y) {
    room_ = scale_.cwiseProduct(x);
    y.noalias() = problem.compliance * room_;
    y.array() *= scale_.array();
  };
  auto measure = [&] {
    double sum = 0, largest = 0;
    for (ConstraintBlock const& b : problem.blocks) {
      double squared = 0;
      for (int i = b.first; i < b.first + b.rows; ++i) {
        const double d = r_[i] / scale_[i];
        squared += d * d;
      }
      sum += std::sqrt(squared);
      largest = std::max(largest, std::sqrt(squared));
    }
    result.error = settings.allVerified ? largest : sum;
    result.converged = result.error <= settings.limit(n);
  };
  r_ = -scale_.cwiseProduct(problem.freeViolation);
  p_ = r_;
  multiply(r_, ofR_);
  ofP_ = ofR_;
  double along = r_.dot(ofR_);
  measure();
  const int most = std::min(settings.maxIterations, int(n));
  while (!result.converged && result.iterations < most) {
    const double square = ofP_.squaredNorm();
    if (!(square > 0) || !(along > 0)) break;  // nothing that is left can be reached
    const double a = along / square;
    problem.multipliers += a * p_;
    r_ -= a * ofP_;
    multiply(r_, ofR_);
    const double before = along;
    along = r_.dot(ofR_);
    const double b = along / before;
    p_ = r_ + b * p_;
    ofP_ = ofR_ + b * ofP_;
    ++result.iterations;
    measure();
  }
  problem.multipliers.array() *= scale_.array();
  return result;
}

}  // namespace sinew
#endif
