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
  using VecDeriv = typename D::VecDeriv;
  static constexpr std::string_view className = "FixedConstraint";
  static constexpr std::string_view aliases = "FixedProjectiveConstraint";

  std::vector<int> indices{0};
  bool fixAll = false, activateProjectVelocity = false;

  static constexpr auto fields() {
    using F = FixedConstraint;
    return field_list(
        field("indices", &F::indices, "", "points held in place", range::nonNegative).numbersOf(Of::points),
        field("fixAll", &F::fixAll, "", "all points are held"),
        field(
            "activate_projectVelocity", &F::activateProjectVelocity, "", "held points lose their velocity"));
  }

  std::size_t size = 0;  // points of the state

  void init(InitContext<D> const& context) {
    if (!fixAll) check_points<FixedConstraint>(context, indices);
    size = context.rest.size();
  }

  void projectResponse(VecDeriv& dx) const {
    forEachPoint([&](int i) { dx[std::size_t(i)].setZero(); });
  }
  void projectVelocity(double /*time*/, VecDeriv& v) const {
    if (activateProjectVelocity) projectResponse(v);
  }
  template <class Sink>
  void projectMatrix(Sink const& sink) const {
    forEachPoint([&](int i) { sink.fix(i); });
  }

  template <class F>
  void forEachPoint(F&& f) const {
    if (fixAll)
      for (std::size_t i = 0; i < size; ++i) f(int(i));
    else
      for (const int i : indices) f(i);
  }
};

}  // namespace sinew
