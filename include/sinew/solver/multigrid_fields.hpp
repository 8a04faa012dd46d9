// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/core/fields.hpp>
#include <sinew/linalg/multigrid.hpp>

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
            range::closed(1, 100)));
}

/// The values of those fields.
template <class Solver>
MultigridSettings multigrid_settings(Solver const& s) {
  return {.levels = s.levels,
          .coarsestSize = s.coarsestSize,
          .threshold = s.strengthThreshold,
          .degree = s.smootherDegree};
}

}  // namespace sinew
