// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/core/ends.hpp>
#include <sinew/lagrangian/point_contacts.hpp>

#include <vector>

namespace sinew {

/// Points of two bodies, or of one, stay apart along given normals by multipliers, as with
/// UnilateralLagrangianConstraint, and give way where a compliance is not zero:
///   d = n.(x2 - x1) - contactDistance,   f = max(0, -d/compliance - damping dd/dt),   |f_t| <= mu f
/// with the depth and its rate at the end of the step, so that it is stable for any step, and contacts that
/// depend on each other share their force. Without compliance it is the hard contact to which the
/// iterations of SOFA's component, an augmented Lagrangian with a penalty, converge; Sinew's constraint
/// solvers need no penalty for that.
template <class D, class E = Within>
struct AugmentedLagrangianConstraint {
  using Ends = E;
  template <class Other>
  using WithEnds = AugmentedLagrangianConstraint<D, Other>;
  static constexpr bool between = !std::is_same_v<E, Within>;
  using Role = role::LagrangianConstraint;
  using DataTypes = D;
  static constexpr std::string_view className = "AugmentedLagrangianConstraint";

  std::vector<int> first_point{}, second_point{};
  std::vector<typename D::Deriv> normal{};
  std::vector<double> contactDistance{0}, mu{0};
  double compliance = 0, damping = 0;
  [[no_unique_address]] E ends{};

  static constexpr auto fields() {
    using F = AugmentedLagrangianConstraint;
    return contact_fields<F>(
        field("compliance", &F::compliance, "m/N", "how deep a force of 1 N presses", range::nonNegative),
        field("damping",
              &F::damping,
              "N s/m",
              "force per rate of the depth, where there is a compliance",
              range::nonNegative));
  }

  std::vector<double> multipliers{};  // of each contact: along the normal, then along two tangents

  static constexpr auto state() {
    return field_list(
        field("multipliers", &AugmentedLagrangianConstraint::multipliers, "N", "of the last step"));
  }

  void init(InitContext<D> const& context) { init(context, context); }
  void init(InitContext<D> const& first, InitContext<D> const& second) {
    check_contacts(*this, first, second);
  }

  PointContact contactAt(std::size_t i) const {
    PointContact contact = contact_of(*this, i);
    contact.compliance = compliance;
    contact.damping = damping;
    return contact;
  }
  void addRows(ConstraintRows& rows, ConstrainedState<D> const& state) const { addRows(rows, state, state); }
  void addRows(ConstraintRows& rows, ConstrainedState<D> const& first,
               ConstrainedState<D> const& second) const {
    const int row = rows.count();
    addJacobian(rows);
    setViolations(rows, row, first, second);
  }
  void addJacobian(ConstraintRows& rows) const { add_contacts(*this, rows); }
  void setViolations(ConstraintRows& rows, int row, ConstrainedState<D> const& state) const {
    setViolations(rows, row, state, state);
  }
  void setViolations(ConstraintRows& rows, int row, ConstrainedState<D> const& first,
                     ConstrainedState<D> const& second) const {
    set_violations(*this, rows, row, first, second);
  }
};

}  // namespace sinew
