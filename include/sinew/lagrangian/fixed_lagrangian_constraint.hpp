// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/constraint/constrained_points.hpp>
#include <sinew/lagrangian/constraint_rows.hpp>

#include <vector>

namespace sinew {

/// Points stay at their rest positions by multipliers, rigid bodies in their rest orientations too:
///   d = x - x0,   of an orientation its rotation vector from that at rest [m, rad].
template <class D>
struct FixedLagrangianConstraint {
  using Role = role::LagrangianConstraint;
  using DataTypes = D;
  using Real = typename D::Real;
  using Deriv = typename D::Deriv;
  static constexpr std::string_view className = "FixedLagrangianConstraint";

  std::vector<int> indices{};
  bool fixAll = false;

  static constexpr auto fields() {
    using F = FixedLagrangianConstraint;
    return field_list(
        field("indices", &F::indices, "", "points that stay", range::nonNegative).numbersOf(Of::points),
        field("fixAll", &F::fixAll, "", "all points stay"));
  }

  std::vector<int> held{};
  std::vector<double> multipliers{};  // of each of them, a point's after the other

  static constexpr auto state() {
    return field_list(field("multipliers", &FixedLagrangianConstraint::multipliers, "N", "of the last step"));
  }

  void init(InitContext<D> const& context) {
    held = held_points<FixedLagrangianConstraint>(context, indices, fixAll);
  }

  void addRows(ConstraintRows& rows, ConstrainedState<D> const& state) const {
    for (const int point : held) {
      const auto p = std::size_t(point);
      Deriv d = D::difference(state.rest[p], rows.ofVelocity ? state.position[p] : state.free[p]);
      if (rows.ofVelocity) d = d / Real(state.dt) + state.velocity[p];
      add_point_equalities<D>(rows, [&](int row, int c) {
        rows.addTo(row, point, Deriv::Unit(c));
        rows.setViolation(row, double(d[c]));
      });
    }
  }
};

}  // namespace sinew
