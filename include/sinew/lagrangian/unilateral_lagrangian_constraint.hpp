// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/core/ends.hpp>
#include <sinew/lagrangian/point_contacts.hpp>

#include <vector>

namespace sinew {

/// Points of two bodies, or of one, stay apart along given normals from the first to the second by
/// multipliers, which push only, with Coulomb's friction where `mu` is not zero:
///   d = n.(x2 - x1) - contactDistance >= 0,   f >= 0,   d f = 0,   |f_t| <= mu f
/// In SOFA it is made by the contacts of collision alone; here the lists are fields.
template <class D, class E = Within>
struct UnilateralLagrangianConstraint {
  using Ends = E;
  template <class Other>
  using WithEnds = UnilateralLagrangianConstraint<D, Other>;
  static constexpr bool between = !std::is_same_v<E, Within>;
  using Role = role::LagrangianConstraint;
  using DataTypes = D;
  static constexpr std::string_view className = "UnilateralLagrangianConstraint";
  static constexpr std::string_view aliases = "UnilateralInteractionConstraint";

  std::vector<int> first_point{}, second_point{};
  std::vector<typename D::Deriv> normal{};
  std::vector<double> contactDistance{0}, mu{0};
  [[no_unique_address]] E ends{};

  static constexpr auto fields() { return contact_fields<UnilateralLagrangianConstraint>(); }

  std::vector<double> multipliers{};  // of each contact: along the normal, then along two tangents

  static constexpr auto state() {
    return field_list(
        field("multipliers", &UnilateralLagrangianConstraint::multipliers, "N", "of the last step"));
  }

  void init(InitContext<D> const& context) { init(context, context); }
  void init(InitContext<D> const& first, InitContext<D> const& second) {
    check_contacts(*this, first, second);
  }

  PointContact contactAt(std::size_t i) const { return contact_of(*this, i); }
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
