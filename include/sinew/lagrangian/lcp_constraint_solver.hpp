// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/lagrangian/linear_complementarity.hpp>
#include <sinew/lagrangian/sweeping_solver.hpp>

namespace sinew {

/// Block Gauss-Seidel over the compliance W for contacts (Duriez et al. 2006), with one coefficient of
/// friction for all of them in the place of their own; where it is zero a linear complementarity problem is
/// left, and the iteration is projected Gauss-Seidel, or Lemke's method takes its place, which has no
/// tolerance. Other constraints are solved as they are.
struct LCPConstraintSolver {
  using Role = role::ConstraintSolver;
  static constexpr std::string_view className = "LCPConstraintSolver";

  int maxIterations = 1000;
  double tolerance = 0.001;
  double mu = 0.6;
  bool initial_guess = true;
  double minW = 0, maxF = 0;
  double regularizationTerm = 0;
  bool build_lcp = true, lemke = false, stopsUnsolved = false;
  bool computeConstraintForces = false;

  static constexpr auto fields() {
    using S = LCPConstraintSolver;
    return field_list(
        field("maxIt", &S::maxIterations, "", "largest number of iterations", range::atLeast(1)),
        field("tolerance",
              &S::tolerance,
              "m",
              "change of the violations in an iteration at which to stop, the sum over all constraints; with "
              "friction times their number and one more",
              range::nonNegative),
        field("mu", &S::mu, "", "coefficient of Coulomb's friction of all contacts", range::nonNegative),
        field("initial_guess", &S::initial_guess, "", "start from the multipliers of the last step"),
        field("minW",
              &S::minW,
              "m/(N s)",
              "contacts whose compliance along the normal, for an impulse, is not above that are ignored; 0: "
              "none",
              range::nonNegative),
        field("maxF",
              &S::maxF,
              "N s",
              "contacts whose normal impulse in a step would be at least that are ignored; 0: none",
              range::nonNegative),
        field("regularizationTerm",
              &S::regularizationTerm,
              "m/(N s)",
              "displacement for an impulse of 1 N s that is added to the compliance of each equation",
              range::nonNegative),
        field("build_lcp",
              &S::build_lcp,
              "",
              "form the compliance of all contacts; without it sweeps take its factors, as those of "
              "UnbuiltGaussSeidelConstraintSolver do"),
        field("lemke",
              &S::lemke,
              "",
              "by Lemke's pivots in place of iterations, for mu 0: to rounding, also where W is singular"),
        field(
            "stopsUnsolved",
            &S::stopsUnsolved,
            "",
            "an Error where the iterations end above the tolerance, or Lemke's method finds that there is no "
            "solution; else a warning, and the step goes on with what they have found"),
        asks_for_constraint_forces<S>());
  }

  bool takesUnbuilt() const { return !build_lcp && !lemke; }

  static constexpr auto outputs() { return constraint_forces_output<LCPConstraintSolver>(); }
  std::vector<double> constraintForces{};
  void reset() { constraintForces.clear(); }

  SweepResult result{};  // of the last step
  ComplementaritySweeps sweeps{};
  LinearComplementarity pivots{};

  void solve(ConstraintProblem& problem, std::string_view where) {
    checkLemke(where);
    for (ConstraintBlock& block : problem.blocks)
      if (block.kind == ConstraintBlock::Kind::friction) block.friction = mu;
    problem.regularise(regularizationTerm * problem.timeStep);
    result = lemke ? pivots.solve(problem, where)
                   : sweeps.solve(problem,
                                  {.maxIterations = maxIterations,
                                   .tolerance = tolerance,
                                   .initialGuess = initial_guess,
                                   .minW = minW * problem.timeStep,
                                   .maxF = maxF / problem.timeStep},
                                  where);
    if (stopsUnsolved && !result.converged) throw Error(where, unsolved());
  }

  std::string unsolved() const {
    if (lemke)
      return text("LCPConstraintSolver: Lemke's method found no solution in ",
                  result.iterations,
                  " pivots: without forces the constraints are broken by ",
                  result.error,
                  " m; look for constraints that contradict each other, or set regularizationTerm");
    return text("LCPConstraintSolver: the constraints are not solved after ",
                result.iterations,
                " iterations: the error is ",
                result.error,
                ", the tolerance ",
                tolerance,
                mu > 0 ? " times the number of constraints and one more" : "",
                "; allow more iterations (maxIt), or look for constraints that contradict each other");
  }

 private:
  void checkLemke(std::string_view where) const {
    if (lemke && (mu > 0 || minW > 0 || maxF > 0))
      throw Error(
          where,
          text("LCPConstraintSolver: Lemke's method is for contacts without friction or bounds, and mu "
               "is ",
               mu,
               ", minW ",
               minW,
               ", maxF ",
               maxF,
               "; set these to 0, or lemke to false"));
  }
};

}  // namespace sinew
