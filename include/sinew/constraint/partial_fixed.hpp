// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/constraint/constrained_points.hpp>

#include <array>
#include <vector>

namespace sinew {

/// Chosen coordinates of chosen points never change their velocity.
template <class D>
struct PartialFixedConstraint {
  using Role = role::ProjectiveConstraint;
  using DataTypes = D;
  using Deriv = typename D::Deriv;
  using VecDeriv = typename D::VecDeriv;
  using Mask = std::array<int, D::size>;
  static constexpr std::string_view className = "PartialFixedConstraint";
  static constexpr std::string_view aliases = "PartialFixedProjectiveConstraint";

  std::vector<int> indices{0};
  bool fixAll = false;
  Mask fixedDirections = all();
  bool activateProjectVelocity = false;

  static constexpr auto fields() {
    using F = PartialFixedConstraint;
    return field_list(
        field("indices", &F::indices, "", "points that are held", range::nonNegative)
            .numbersOf(Of::points)
            .whileRunning(),
        field("fixAll", &F::fixAll, "", "all points are held"),
        field("fixedDirections",
              &F::fixedDirections,
              "",
              "1 for each degree of freedom that is held, 0 for one that is free",
              range::closed(0, 1))
            .whileRunning(),
        field(
            "projectVelocity", &F::activateProjectVelocity, "", "held degrees of freedom lose their velocity")
            .also("activate_projectVelocity"));
  }

  typename D::template Array<int> held{};

  void init(InitContext<D> const& context) { takeValues(context.where, context.rest.size()); }
  void takeValues(std::string_view where, std::size_t points) {
    hold_points<PartialFixedConstraint>(where, points, indices, fixAll, held);
  }

  void projectResponse(VecDeriv& dx) const {
    each_point<D>(held.size(), Stop{entries(dx), entries(held), fixedDirections});
  }
  struct Stop {
    Deriv* to;
    int const* points;
    Mask fixed;
    SINEW_HD void operator()(int k) const {
      for (int c = 0; c < D::size; ++c)
        if (fixed[std::size_t(c)]) to[points[k]][c] = 0;
    }
  };
  void projectVelocity(double /*time*/, VecDeriv& v) const {
    if (activateProjectVelocity) projectResponse(v);
  }
  template <class Sink>
  void projectMatrix(Sink const& sink) const {
    for (const int i : held) sink.fix(i, fixedDirections);
  }

  static constexpr Mask all() {
    Mask mask{};
    for (int& m : mask) m = 1;
    return mask;
  }
};

}  // namespace sinew
