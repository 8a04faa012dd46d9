// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/lagrangian/constraint_problem.hpp>

namespace sinew {

/// SOFA's regularisation of those equations only that its criteria take for dependent on others
/// (useSVDForRegularization). With the singular values and vectors of the compliance, W = sum_k s_k v_k v_k',
///   null space: the v_k of s_k < singularValue max_j s_j
///   W_ii += term  for each i with |v_k,i| > component for a k of these
/// so that all other equations hold as they would without regularisation. Two things are to be known of it:
/// s_k has the unit of the equations, so that one on a body that is heavy beside the others is taken for
/// dependent, too; and where several s_k are the same their vectors are not unique, so that a component near
/// its limit may be on either side of it.
class NullSpaceRows {
 public:
  void regularise(ConstraintProblem& problem, double term, double singularValue, double component);

 private:
  // W, which rotations make diagonal, and those rotations: v_k is row k
  Reserved<ConstraintProblem::Matrix> values_{}, vectors_{};

  bool sweep(double negligible);
  void rotate(Eigen::Index p, Eigen::Index q);
};

}  // namespace sinew

#if SINEW_DEFINES
#include <Eigen/Jacobi>

#include <cmath>

namespace sinew {

SINEW_ONCE void NullSpaceRows::regularise(ConstraintProblem& problem, double term, double singularValue,
                                          double component) {
  const Eigen::Index n = problem.rows();
  if (!(term > 0) || n == 0 || !problem.compliance.allFinite()) return;
  values_ = problem.compliance;
  vectors_.setZero(n, n);
  vectors_.diagonal().setOnes();
  const double negligible = 1e-15 * values_.diagonal().sum();
  for (int sweeps = 0; sweeps < 50 && sweep(negligible); ++sweeps) {
  }
  const double limit = singularValue * values_.diagonal().cwiseAbs().maxCoeff();
  for (Eigen::Index i = 0; i < n; ++i) {
    bool depends = false;
    for (Eigen::Index k = 0; k < n; ++k)
      depends = depends || (std::abs(values_(k, k)) < limit && std::abs(vectors_(k, i)) > component);
    if (depends) problem.compliance(i, i) += term;
  }
}

// Jacobi's method, row by row (Golub, Van Loan 2013, 8.5): of a symmetric matrix singular vectors are
// eigenvectors. Says whether something was left to do.
SINEW_ONCE bool NullSpaceRows::sweep(double negligible) {
  bool rotated = false;
  for (Eigen::Index p = 0; p < values_.rows(); ++p)
    for (Eigen::Index q = p + 1; q < values_.rows(); ++q)
      if (std::abs(values_(p, q)) > negligible) {
        rotate(p, q);
        rotated = true;
      }
  return rotated;
}
SINEW_ONCE void NullSpaceRows::rotate(Eigen::Index p, Eigen::Index q) {
  Eigen::JacobiRotation<double> rotation;
  rotation.makeJacobi(values_, p, q);
  values_.applyOnTheLeft(p, q, rotation.adjoint());
  values_.applyOnTheRight(p, q, rotation);
  vectors_.applyOnTheLeft(p, q, rotation.adjoint());
}

}  // namespace sinew
#endif
