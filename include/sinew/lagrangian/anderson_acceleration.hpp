// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <Eigen/Cholesky>
#include <Eigen/Core>

#include <array>

namespace sinew {

/// Anderson's acceleration (1965; Walker, Ni 2011) of a fixed point z = F(z): the next z is the combination
/// of the last values of F whose combined residual F(z) - z is least in the norm of the given weights.
class AndersonAcceleration {
 public:
  static constexpr int depth = 5;

  void reset() { count_ = 0, size_ = -1; }

  /// z <- the next point, from z and F(z).
  void next(Eigen::VectorXd const& value, Eigen::VectorXd const& weights, Eigen::VectorXd& z) {
    residual_ = value - z;
    const double size = residual_.cwiseAbs2().dot(weights);
    // what grows is no contraction: the history of another part of the function misleads
    if (size_ >= 0 && !(size < 4 * size_)) count_ = 0, size_ = -1;
    if (size_ >= 0) {
      const std::size_t at = std::size_t(count_ % depth);
      residuals_[at] = residual_ - lastResidual_;
      values_[at] = value - lastValue_;
      ++count_;
    }
    lastResidual_ = residual_;
    lastValue_ = value;
    size_ = size;
    z = value;
    const int n = std::min(count_, depth);
    if (n == 0) return;
    Small products(n, n);
    Few right(n);
    for (int i = 0; i < n; ++i) {
      weighted_ = residuals_[std::size_t(i)].cwiseProduct(weights);
      right[i] = weighted_.dot(residual_);
      for (int j = 0; j <= i; ++j)
        products(i, j) = products(j, i) = weighted_.dot(residuals_[std::size_t(j)]);
    }
    products.diagonal().array() += 1e-10 * products.trace() + 1e-300;
    const Few share = products.ldlt().solve(right);
    if (!share.allFinite()) return;
    for (int i = 0; i < n; ++i) z -= share[i] * values_[std::size_t(i)];
  }

 private:
  using Small = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, depth, depth>;
  using Few = Eigen::Matrix<double, Eigen::Dynamic, 1, 0, depth, 1>;

  int count_ = 0;
  double size_ = -1;  // of the last residual, squared; negative where there is none
  Eigen::VectorXd residual_{}, lastResidual_{}, lastValue_{}, weighted_{};
  std::array<Eigen::VectorXd, depth> residuals_{}, values_{};
};

}  // namespace sinew
