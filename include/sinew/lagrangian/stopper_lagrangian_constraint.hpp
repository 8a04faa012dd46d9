// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/constraint/constrained_points.hpp>
#include <sinew/lagrangian/constraint_rows.hpp>

#include <vector>

namespace sinew {

/// The coordinate of one point of a state in one dimension stays between two stops by a multiplier:
///   min <= x <= max,   f >= 0 at min, f <= 0 at max, else f = 0
template <class D>
struct StopperLagrangianConstraint {
  using Role = role::LagrangianConstraint;
  using DataTypes = D;
  static_assert(!D::rigid && D::size == 1, "StopperLagrangianConstraint is for Vec1");
  static constexpr std::string_view className = "StopperLagrangianConstraint";

  int index = 0;
  double min = -100, max = 100;

  static constexpr auto fields() {
    using F = StopperLagrangianConstraint;
    return field_list(
        field("index", &F::index, "", "the point", range::nonNegative).numbersOf(Of::points),
        field("min", &F::min, "m", "smallest coordinate that it may have; the unit is that of the state"),
        field("max", &F::max, "m", "largest coordinate that it may have"));
  }

  std::vector<double> multipliers{};

  bool none = false;  // the point has been removed

  static constexpr auto state() {
    return field_list(
        field("multipliers", &StopperLagrangianConstraint::multipliers, "N", "of the last step"),
        field("none", &StopperLagrangianConstraint::none, "", "the point has been removed"));
  }

  void init(InitContext<D> const& context) {
    if (!none) check_points<StopperLagrangianConstraint>(context, {index});
    checkStops(place_of<StopperLagrangianConstraint>(context));
  }

  void addRows(ConstraintRows& rows, ConstrainedState<D> const& state) const {
    if (none) return;
    const auto p = std::size_t(index);
    const double start = double(state.position[p][0]);
    const int row = rows.ofVelocity ? rows.addInterval((min - start) / state.dt, (max - start) / state.dt)
                                    : rows.addInterval(min, max);
    rows.addTo(row, index, D::Deriv::Unit(0));
    rows.setViolation(row, double(rows.ofVelocity ? state.velocity[p][0] : state.free[p][0]));
  }

 private:
  void checkStops(std::string const& where) const {
    if (!(min <= max))
      throw Error(where, text("min is ", min, " and max ", max, "; give a min that is not above max"));
  }
};

}  // namespace sinew
