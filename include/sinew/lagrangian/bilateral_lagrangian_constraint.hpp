// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/constraint/constrained_points.hpp>
#include <sinew/core/ends.hpp>
#include <sinew/lagrangian/constraint_rows.hpp>

#include <algorithm>
#include <vector>

namespace sinew {

/// Points of two bodies stay together by multipliers, or as far from each other as `rest_vector` says:
///   d = x2 - x1 - r,
/// and rigid bodies in the same orientation too, d = rotation vector from the first to the second [rad], or
/// with `keepOrientationDifference` as they are turned against each other, and shifted, at the start. Where
/// the two lists have different lengths the rest of the longer one is free.
template <class D, class E = Within>
struct BilateralLagrangianConstraint {
  using Ends = E;
  template <class Other>
  using WithEnds = BilateralLagrangianConstraint<D, Other>;
  static constexpr bool between = !std::is_same_v<E, Within>;
  using Role = role::LagrangianConstraint;
  using DataTypes = D;
  using Real = typename D::Real;
  using Coord = typename D::Coord;
  using Deriv = typename D::Deriv;
  static constexpr std::string_view className = "BilateralLagrangianConstraint";
  static constexpr std::string_view aliases = "BilateralInteractionConstraint";

  std::vector<int> first_point{}, second_point{};
  std::vector<Deriv> rest_vector{};
  bool activate = true, keepOrientationDifference = false;
  [[no_unique_address]] E ends{};

  static constexpr auto fields() {
    using F = BilateralLagrangianConstraint;
    return field_list(
        field("first_point", &F::first_point, "", "points of the first body", range::nonNegative)
            .numbersOf(Of::points),
        field("second_point",
              &F::second_point,
              "",
              "points of the second that are joined to them",
              range::nonNegative)
            .numbersOf(Of::secondPoints),
        field("rest_vector",
              &F::rest_vector,
              "m",
              "from each point of the first body to that of the second; zero where not given"),
        field("activate", &F::activate, "", "the points are joined"),
        field("keepOrientationDifference",
              &F::keepOrientationDifference,
              "",
              "rigid bodies keep the shift and the rotation between them that they have at the start, in "
              "place of "
              "rest_vector"));
  }

  std::vector<Deriv> shift{};  // from the first to the second at the start, of rigid bodies
  std::vector<double> multipliers{};

  static constexpr auto state() {
    return field_list(
        field("multipliers", &BilateralLagrangianConstraint::multipliers, "N", "of the last step"));
  }

  void init(InitContext<D> const& context) { init(context, context); }
  void init(InitContext<D> const& first, InitContext<D> const& second) {
    const std::string where = place_of<BilateralLagrangianConstraint>(first);
    check_points(where, "first_point", first_point, first.rest.size());
    check_points(where, "second_point", second_point, second.rest.size());
    shift.clear();
  }

  void addRows(ConstraintRows& rows, ConstrainedState<D> const& state) { addRows(rows, state, state); }
  void addRows(ConstraintRows& rows, ConstrainedState<D> const& first, ConstrainedState<D> const& second) {
    if (!activate) return;
    const std::size_t n = std::min(first_point.size(), second_point.size());
    if constexpr (D::rigid)
      while (keepOrientationDifference && shift.size() < n)
        shift.push_back(D::difference(first.position[std::size_t(first_point[shift.size()])],
                                      second.position[std::size_t(second_point[shift.size()])]));
    for (std::size_t i = 0; i < n; ++i) {
      const int a = first_point[i], b = second_point[i];
      const Deriv d = violation(rows, first, second, i);
      // orientations are a block of their own
      for (int begin = 0; begin < D::size; begin += D::rigid ? D::spatial : D::size) {
        const int size = D::rigid ? (begin == 0 ? D::spatial : D::size - D::spatial) : D::size;
        const int row = rows.addEquality(size);
        for (int c = 0; c < size; ++c) {
          rows.addTo(row + c, a, Deriv(-Deriv::Unit(begin + c)));
          rows.addTo(row + c, b, Deriv::Unit(begin + c), between ? 1 : 0);
          rows.setViolation(row + c, double(d[begin + c]));
        }
      }
    }
  }

 private:
  Deriv violation(ConstraintRows const& rows, ConstrainedState<D> const& first,
                  ConstrainedState<D> const& second, std::size_t i) const {
    const auto a = std::size_t(first_point[i]), b = std::size_t(second_point[i]);
    Coord from = rows.ofVelocity ? first.position[a] : first.free[a];
    if constexpr (D::rigid) {
      if (keepOrientationDifference) {
        const Deriv center = shift[i];
        D::setCenter(from, D::center(from) + center.template head<D::spatial>());
        Deriv rotation = shift[i];
        rotation.template head<D::spatial>().setZero();
        D::increment(from, rotation);
      }
    }
    Deriv d = D::difference(from, rows.ofVelocity ? second.position[b] : second.free[b]);
    if (!(D::rigid && keepOrientationDifference) && i < rest_vector.size()) d -= rest_vector[i];
    if (rows.ofVelocity) d = d / Real(first.dt) + (second.velocity[b] - first.velocity[a]);
    return d;
  }
};

}  // namespace sinew
