// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/core/compiled.hpp>

#include <Eigen/Core>

#include <algorithm>
#include <array>

namespace sinew {

/// Anderson's acceleration (1965; Walker, Ni 2011) of a fixed point z = F(z): the next z is the combination
/// of the last values of F whose combined residual F(z) - z is least in the norm of the given weights.
class AndersonAcceleration {
 public:
  static constexpr int depth = 5;

  /// Forgets all; vectors have n entries from now on, which are the first ones of what they are given in.
  void reset(Eigen::Index n);

  /// z <- the next point, from z and F(z).
  void next(Eigen::VectorXd const& value, Eigen::VectorXd const& weights, Eigen::VectorXd& z);

 private:
  // with room for as many as blocks of constraints have, so that Eigen's decomposition is compiled once
  using Small = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, 6, 6>;
  using Few = Eigen::Matrix<double, Eigen::Dynamic, 1, 0, 6, 1>;

  void forget() { count_ = 0, size_ = -1; }
  void room(Eigen::VectorXd& of) const;

  Eigen::Index n_ = 0;
  int count_ = 0;     // of differences so far
  double size_ = -1;  // of the last residual, squared; negative where there is none
  Eigen::VectorXd residual_{}, lastResidual_{}, lastValue_{}, weighted_{};
  std::array<Eigen::VectorXd, depth> residuals_{}, values_{};
};

}  // namespace sinew

#if SINEW_DEFINES
#include <Eigen/Cholesky>

namespace sinew {

SINEW_ONCE void AndersonAcceleration::reset(Eigen::Index n) {
  forget();
  n_ = n;
  for (Eigen::VectorXd* of : {&residual_, &lastResidual_, &lastValue_, &weighted_}) room(*of);
  for (std::size_t i = 0; i < depth; ++i) room(residuals_[i]), room(values_[i]);
}

SINEW_ONCE void AndersonAcceleration::next(Eigen::VectorXd const& value, Eigen::VectorXd const& weights,
                                           Eigen::VectorXd& z) {
  residual_.head(n_) = value.head(n_) - z.head(n_);
  const double size = residual_.head(n_).cwiseAbs2().dot(weights.head(n_));
  // what grows is no contraction: the history of another part of the function misleads
  if (size_ >= 0 && !(size < 4 * size_)) forget();
  if (size_ >= 0) {
    const std::size_t at = std::size_t(count_ % depth);
    residuals_[at].head(n_) = residual_.head(n_) - lastResidual_.head(n_);
    values_[at].head(n_) = value.head(n_) - lastValue_.head(n_);
    ++count_;
  }
  lastResidual_.head(n_) = residual_.head(n_);
  lastValue_.head(n_) = value.head(n_);
  size_ = size;
  z.head(n_) = value.head(n_);
  const int n = std::min(count_, depth);
  if (n == 0) return;
  Small products = Small::Zero(n, n);
  Few right(n);
  for (int i = 0; i < n; ++i) {
    weighted_.head(n_) = residuals_[std::size_t(i)].head(n_).cwiseProduct(weights.head(n_));
    right[i] = weighted_.head(n_).dot(residual_.head(n_));
    for (int j = 0; j <= i; ++j)
      products(i, j) = products(j, i) = weighted_.head(n_).dot(residuals_[std::size_t(j)].head(n_));
  }
  products.diagonal().array() += 1e-10 * products.trace() + 1e-300;
  const Few share = products.ldlt().solve(right);
  if (!share.allFinite()) return;
  for (int i = 0; i < n; ++i) z.head(n_) -= share[i] * values_[std::size_t(i)].head(n_);
}

SINEW_ONCE void AndersonAcceleration::room(Eigen::VectorXd& of) const {
  if (of.size() < n_) of.resize(n_);
}

}  // namespace sinew
#endif
