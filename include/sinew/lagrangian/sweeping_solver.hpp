// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/lagrangian/constraint_forces.hpp>
#include <sinew/lagrangian/constraint_sweeps.hpp>
#include <sinew/lagrangian/null_space_rows.hpp>

#include <string>
#include <string_view>

namespace sinew {

// What constraint solvers share that iterate over the blocks of a problem: settings with SOFA's names and
// defaults, and what is said when the iterations end.

/// It may add to the compliance of those equations only that depend on others (NullSpaceRows).
template <class S>
concept FindsDependent = requires(S solver) { solver.dependent; };

/// The fields of such a solver S, and more.
template <class S, class... More>
constexpr auto sweeping_fields(More... more) {
  auto with = [&](auto... ofDependent) {
    return field_list(
        field("maxIterations", &S::maxIterations, "", "largest number of iterations", range::atLeast(1))
            .also("maxIt"),
        field("tolerance",
              &S::tolerance,
              "m",
              "change of the violations in an iteration at which to stop: the sum over all equations",
              range::nonNegative),
        field(
            "regularizationTerm",
            &S::regularizationTerm,
            "m/(N s)",
            "displacement for an impulse of 1 N s that is added to the compliance of each equation, so that "
            "those that depend on each other can be solved",
            range::nonNegative),
        ofDependent...,
        field("scaleTolerance", &S::scaleTolerance, "", "the tolerance is one for each equation"),
        field("allVerified",
              &S::allVerified,
              "",
              "each equation is below the tolerance, in place of their sum"),
        field("stopsUnsolved",
              &S::stopsUnsolved,
              "",
              "an Error where the iterations end above the tolerance; else a warning, and the step goes on "
              "with what they have found"),
        asks_for_constraint_forces<S>(),
        more...);
  };
  if constexpr (FindsDependent<S>)
    return with(
        field("useSVDForRegularization",
              &S::useSVDForRegularization,
              "",
              "regularizationTerm is for those equations only that the two criteria take for dependent on "
              "others, by a singular value decomposition of the compliance in each step"),
        field("svdSingularValueNullSpaceCriteriaFactor",
              &S::svdSingularValueNullSpaceCriteriaFactor,
              "",
              "part of the largest singular value below which the vector of one is in the null space; one of "
              "a body that is as much heavier than the others is, too",
              range::closed(0, 1)),
        field("svdSingularVectorNullSpaceCriteriaFactor",
              &S::svdSingularVectorNullSpaceCriteriaFactor,
              "",
              "component of a unit vector of the null space above which its equation depends on others",
              range::closed(0, 1)));
  else
    return with();
}

template <class S>
constexpr auto relaxation_field() {
  return field("sor", &S::sor, "", "relaxation of the multipliers", range::closed(0, 2));
}

template <class S>
SweepSettings sweep_settings(S const& solver) {
  return {.maxIterations = solver.maxIterations,
          .tolerance = solver.tolerance,
          .scaleTolerance = solver.scaleTolerance,
          .allVerified = solver.allVerified};
}

/// What such a solver says whose iterations have not ended.
template <class S>
std::string unsolved_by_sweeps(S const& solver) {
  return text(component_name<S>(),
              ": the constraints are not solved after ",
              solver.result.iterations,
              " iterations: the error is ",
              solver.result.error,
              ", the tolerance ",
              solver.tolerance,
              solver.scaleTolerance && !solver.allVerified ? " times the number of equations" : "",
              "; allow more iterations (maxIterations), or look for constraints that contradict each other");
}

/// Solves a problem by solve(problem) of a solver S, which keeps the result.
template <class S, class F>
void sweep(S& solver, ConstraintProblem& problem, std::string_view where, F&& solve) {
  const double term = solver.regularizationTerm * problem.timeStep;
  if constexpr (FindsDependent<S>) {
    if (solver.useSVDForRegularization)
      solver.dependent.regularise(problem,
                                  term,
                                  solver.svdSingularValueNullSpaceCriteriaFactor,
                                  solver.svdSingularVectorNullSpaceCriteriaFactor);
    else
      problem.regularise(term);
  } else {
    problem.regularise(term);
  }
  solver.result = solve(problem);
  if (solver.stopsUnsolved && !solver.result.converged) throw Error(where, solver.unsolved());
}

}  // namespace sinew
