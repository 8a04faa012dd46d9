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
        field("indices", &F::indices, "", "points that are held", range::nonNegative).numbersOf(Of::points),
        field("fixAll", &F::fixAll, "", "all points are held"),
        field("fixedDirections",
              &F::fixedDirections,
              "",
              "1 for each degree of freedom that is held, 0 for one that is free",
              range::closed(0, 1)),
        field(
            "projectVelocity", &F::activateProjectVelocity, "", "held degrees of freedom lose their velocity")
            .also("activate_projectVelocity"));
  }

  std::size_t size = 0;  // points of the state

  void init(InitContext<D> const& context) {
    if (!fixAll) check_points<PartialFixedConstraint>(context, indices);
    size = context.rest.size();
  }

  void projectResponse(VecDeriv& dx) const {
    forEachPoint([&](int i) {
      for (int c = 0; c < D::size; ++c)
        if (fixedDirections[std::size_t(c)]) dx[std::size_t(i)][c] = 0;
    });
  }
  void projectVelocity(double /*time*/, VecDeriv& v) const {
    if (activateProjectVelocity) projectResponse(v);
  }
  template <class Sink>
  void projectMatrix(Sink const& sink) const {
    forEachPoint([&](int i) { sink.fix(i, fixedDirections); });
  }

  template <class F>
  void forEachPoint(F&& f) const {
    if (fixAll)
      for (std::size_t i = 0; i < size; ++i) f(int(i));
    else
      for (const int i : indices) f(i);
  }
  static constexpr Mask all() {
    Mask mask{};
    for (int& m : mask) m = 1;
    return mask;
  }
};

}  // namespace sinew
