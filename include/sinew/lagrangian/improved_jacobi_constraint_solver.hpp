// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/lagrangian/sweeping_solver.hpp>

namespace sinew {

/// Projected Jacobi over the compliance W (Francu, Moldoveanu 2014): all multipliers are found from those of
/// the last iteration, so that their order does not matter. It converges where the weight of the violations
/// times the largest eigenvalue of D^-1 W, with the diagonal D of W, is below 2: many contacts on one body
/// need useSpectralCorrection, whose weight is SOFA's, or a smaller factor of it. Iterations that run away
/// leave no force.
struct ImprovedJacobiConstraintSolver {
  using Role = role::ConstraintSolver;
  static constexpr std::string_view className = "ImprovedJacobiConstraintSolver";

  int maxIterations = 1000;
  double tolerance = 0.001;
  double regularizationTerm = 0;
  bool useSVDForRegularization = false;
  double svdSingularValueNullSpaceCriteriaFactor = 0.01, svdSingularVectorNullSpaceCriteriaFactor = 0.001;
  bool scaleTolerance = true, allVerified = false, stopsUnsolved = false;
  bool useSpectralCorrection = false;
  double spectralCorrectionFactor = 1;
  bool useConjugateResidue = false;
  double conjugateResidueSpeedFactor = 10;
  bool computeConstraintForces = false;

  static constexpr auto fields() {
    using S = ImprovedJacobiConstraintSolver;
    return sweeping_fields<S>(field("useSpectralCorrection",
                                    &S::useSpectralCorrection,
                                    "",
                                    "violations are weighed by spectralCorrectionFactor min(1, 1.8 / "
                                    "radius), with the spectral radius "
                                    "of W over the length of the step"),
                              field("spectralCorrectionFactor",
                                    &S::spectralCorrectionFactor,
                                    "",
                                    "factor of that weight",
                                    range::positive),
                              field("useConjugateResidue",
                                    &S::useConjugateResidue,
                                    "",
                                    "the last change of the multipliers is added to the next one, times "
                                    "(i / maxIterations)^conjugateResidueSpeedFactor in iteration i"),
                              field("conjugateResidueSpeedFactor",
                                    &S::conjugateResidueSpeedFactor,
                                    "",
                                    "how late the last change begins to count: the higher, the later",
                                    range::nonNegative));
  }

  static constexpr auto outputs() { return constraint_forces_output<ImprovedJacobiConstraintSolver>(); }
  std::vector<double> constraintForces{};
  void reset() { constraintForces.clear(); }

  SweepResult result{};  // of the last step
  ConstraintSweeps sweeps{};
  NullSpaceRows dependent{};
  LargestEigenvalue largest{};

  std::string unsolved() const { return unsolved_by_sweeps(*this); }
  void solve(ConstraintProblem& problem, std::string_view where) {
    sweep(*this, problem, where, [&](auto& p) {
      JacobiSettings jacobi;
      if (useSpectralCorrection) {
        p.checkSizes(where);
        jacobi.weight = spectral_weight(p, spectralCorrectionFactor, largest);
      }
      if (useConjugateResidue) jacobi.delay = conjugateResidueSpeedFactor;
      return sweeps.jacobi(p, sweep_settings(*this), jacobi, where);
    });
  }
};

}  // namespace sinew
