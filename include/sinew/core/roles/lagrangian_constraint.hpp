// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/core/role.hpp>

namespace sinew {

class ConstraintRows;

// Gives equations for the state of its node, or between two states, that the constraint solver of the scene solves by
// multipliers. The shortest:
//
//   /// The first point stays in the plane y = 0.
//   struct OnTable {
//     using Role = role::LagrangianConstraint;
//     using DataTypes = Vec3d;
//     static constexpr std::string_view className = "OnTable";
//     static constexpr auto fields() { return field_list(); }
//
//     void init(InitContext<Vec3d> const&) {}
//     void addRows(ConstraintRows& rows, ConstrainedState<Vec3d> const& state) const {
//       const int row = rows.addEquality(1);
//       rows.addTo(row, 0, Eigen::Vector3d(0, 1, 0));
//       rows.setViolation(row, state.free[0][1]);
//     }
//   };

/// A state as a constraint sees it when its rows are asked for: at the start of the step, where Jacobians are taken, and
/// after the motion without multipliers, where violations are.
template <class D>
struct ConstrainedState {
  typename D::VecCoord const& position;  // at the start of the step
  typename D::VecCoord const& free;      // at its end without multipliers
  typename D::VecDeriv const& velocity;  // at its end without multipliers
  typename D::VecCoord const& rest;
  double dt;
};

template <class C>
concept HasRows = HasDataTypes<C> &&
                  requires(C c, ConstraintRows& rows, ConstrainedState<typename C::DataTypes> const& state) {
                    c.addRows(rows, state);
                  };
template <class C>
concept HasRowsOfTwo = HasDataTypes<C> && requires(C c, ConstraintRows& rows,
                                                   ConstrainedState<typename C::DataTypes> const& state) {
  c.addRows(rows, state, state);
};

template <class C>
concept LagrangianConstraint =
    HasRole<C, role::LagrangianConstraint> && !JoinsTwo<C> && HasInit<C> && HasRows<C>;
/// The same between two states: their points have the sides 0 and 1 in the rows.
template <class C>
concept InteractionLagrangianConstraint =
    HasRole<C, role::LagrangianConstraint> && JoinsTwo<C> && HasInitOfTwo<C> && HasRowsOfTwo<C>;

// Hooks:

/// Its rows, and which points these are of, do not depend on the states: addJacobian(rows) adds them, and
/// setViolations(rows, first row, state), of two states with both, comes behind. Rows are then made while states are on their
/// way from a device.
template <class C>
concept SetsViolations = requires(C const c, ConstraintRows& rows) { c.addJacobian(rows); };
/// Keeps the multipliers f [N] of its rows after each step, `std::vector<double> multipliers`; where the next step has as
/// many rows, they are the first guess of its solver.
template <class C>
concept KeepsMultipliers = requires(C c) { c.multipliers.assign(1, 0.0); };

template <>
struct Promise<role::LagrangianConstraint> : NoPromise {
  template <class C>
  static constexpr bool kept = LagrangianConstraint<C> || InteractionLagrangianConstraint<C>;

  template <class C>
  struct Broken {
    static constexpr bool one = HasDataTypes<C> && !JoinsTwo<C>, two = HasDataTypes<C> && JoinsTwo<C>;
    static_assert(
        HasDataTypes<C>,
        "Sinew: a Lagrangian constraint has no DataTypes; write 'using DataTypes = D;' with those of the "
        "state on which it acts, such as Vec3d.");
    static_assert(
        !one || HasInit<C>,
        "Sinew: a Lagrangian constraint has no 'void init(InitContext<DataTypes> const& context)'.");
    static_assert(!one || HasRows<C>,
                  "Sinew: a Lagrangian constraint has no 'void addRows(ConstraintRows& rows, "
                  "ConstrainedState<DataTypes> const& state)', which adds its equations.");
    static_assert(
        !two || HasInitOfTwo<C>,
        "Sinew: a Lagrangian constraint between two states has no 'void init(InitContext<DataTypes> const& "
        "first, InitContext<DataTypes> const& second)'.");
    static_assert(
        !two || HasRowsOfTwo<C>,
        "Sinew: a Lagrangian constraint between two states has no 'void addRows(ConstraintRows& rows, "
        "ConstrainedState<DataTypes> const& first, ConstrainedState<DataTypes> const& second)'.");
  };
};

}  // namespace sinew
