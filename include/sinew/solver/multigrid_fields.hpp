// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/core/fields.hpp>
#include <sinew/core/workers.hpp>
#include <sinew/linalg/multigrid.hpp>
#include <sinew/solver/rigid_modes.hpp>

namespace sinew {

/// The fields of a solver S that may have multigrid: its own, then those of the cycle.
template <class S, class... Own>
constexpr auto multigrid_fields(Own... own) {
  return field_list(
      own...,
      field("levels",
            &S::levels,
            "",
            "of multigrid: largest number of levels, with that of the points",
            range::closed(1, 50)),
      field("coarsestSize",
            &S::coarsestSize,
            "",
            "of multigrid: unknowns up to which a level is solved by its factor",
            range::atLeast(1)),
      field(
          "strengthThreshold",
          &S::strengthThreshold,
          "",
          "of multigrid: what joins two points against what holds each, |A_ij| / sqrt(|A_ii| |A_jj|), above "
          "which they may be in one aggregate",
          range::closed(0, 1)),
      field("smootherDegree",
            &S::smootherDegree,
            "",
            "of multigrid: steps of the smoother before and behind the coarse levels",
            range::closed(1, 100)),
      field("coarseCycles",
            &S::coarseCycles,
            "",
            "of multigrid: cycles of a coarse level in one of the level above: 1 is the V-cycle, 2 the "
            "W-cycle; "
            "on a device always 1",
            range::closed(1, 10)));
}

/// The values of those fields.
template <class Solver>
MultigridSettings multigrid_settings(Solver const& s) {
  return {.levels = s.levels,
          .coarsestSize = s.coarsestSize,
          .threshold = s.strengthThreshold,
          .degree = s.smootherDegree,
          .cycles = s.coarseCycles};
}

/// Aggregates and patterns at init, so that no step allocates: those of the stiffness as it is now, with the
/// little mass that holds what nothing else does. Where time steps are short masses join nothing, and then
/// any aggregates serve. In a step, where contacts have come that the matrix has no room for, they wait for
/// the next solve.
template <class Operations, class Matrix>
void prepare_multigrid(Operations& operations, Matrix& matrix, Multigrid& multigrid) {
  rigid_modes(operations, multigrid.modes);
  if (operations.dt != 0) return;
  operations.withMatrixAtInit(
      matrix, {.m = 1, .k = -1e4}, [&] { multigrid.update(some_workers(operations.workers()), matrix); });
}

}  // namespace sinew
