// SPDX-License-Identifier: BSL-1.0
#pragma once

#include "equilibrium.hpp"

#include <Eigen/Eigenvalues>
#include <cmath>

namespace one {

/// That a body in space without supports has the stiffness -k: symmetric, and six motions, those of a rigid
/// body, cost nothing.
inline void check_six_free_motions(Eigen::MatrixXd const& k, double tolerance) {
  CHECK((k - k.transpose()).norm() < 1e-14);
  const Eigen::VectorXd values = Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(-k).eigenvalues();
  for (int i = 0; i < values.size(); ++i)
    if (i < 6)
      CHECK(std::abs(values[i]) < tolerance);
    else
      CHECK(values[i] > 1e-3);
}

}  // namespace one
