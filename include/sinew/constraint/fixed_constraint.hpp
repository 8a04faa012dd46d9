// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/constraint/constrained_points.hpp>

#include <vector>

namespace sinew {

/// Chosen points never change their velocity: those that start at rest stay in place.
template <class D>
struct FixedConstraint {
  using Role = role::ProjectiveConstraint;
  using DataTypes = D;
  using Deriv = typename D::Deriv;
  using VecDeriv = typename D::VecDeriv;
  static constexpr std::string_view className = "FixedConstraint";
  static constexpr std::string_view aliases = "FixedProjectiveConstraint";

  std::vector<int> indices{0};
  bool fixAll = false, activateProjectVelocity = false;

  static constexpr auto fields() {
    using F = FixedConstraint;
    return field_list(
        field("indices", &F::indices, "", "points held in place", range::nonNegative)
            .numbersOf(Of::points)
            .whileRunning(),
        field("fixAll", &F::fixAll, "", "all points are held"),
        field(
            "activate_projectVelocity", &F::activateProjectVelocity, "", "held points lose their velocity"));
  }

  typename D::template Array<int> held{};

  void init(InitContext<D> const& context) { takeValues(context.where, context.rest.size()); }
  void takeValues(std::string_view where, std::size_t points) {
    hold_points<FixedConstraint>(where, points, indices, fixAll, held);
  }

  void projectResponse(VecDeriv& dx) const { each_point<D>(held.size(), Stop{entries(dx), entries(held)}); }
  struct Stop {
    Deriv* to;
    int const* points;
    SINEW_HD void operator()(int k) const { to[points[k]].setZero(); }
  };
  void projectVelocity(double /*time*/, VecDeriv& v) const {
    if (activateProjectVelocity) projectResponse(v);
  }
  template <class Sink>
  void projectMatrix(Sink const& sink) const {
    for (const int i : held) sink.fix(i);
  }
};

}  // namespace sinew
