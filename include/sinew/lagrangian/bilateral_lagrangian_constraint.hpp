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
/// with `keepOrientationDifference` as the second is turned in the axes of the first at the start, with the
/// shift in the world between them at the start. Where the two lists have different lengths the rest of the
/// longer one is free.
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
  double load = 1;
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
              "from each point of the first body to that of the second; zero where not given")
            .oneEach(Of::entries),
        field("activate", &F::activate, "", "the points are joined"),
        field("keepOrientationDifference",
              &F::keepOrientationDifference,
              "",
              "rigid bodies keep the shift and the rotation between them that they have at the start, in "
              "place of rest_vector"),
        field("load",
              &F::load,
              "",
              "part of the violation of the free motion that is taken away in a step, and so of the force "
              "that holds the points",
              range::closed(0, 1)));
  }

  std::vector<double> multipliers{};
  typename D::VecCoord
      differences{};  // at the start, of rigid bodies: the shift, and the second in the first

  static constexpr auto state() {
    using F = BilateralLagrangianConstraint;
    constexpr auto kept = field("multipliers", &F::multipliers, "N", "of the last step");
    if constexpr (D::rigid)
      return field_list(kept, field("differences", &F::differences, "m", "between the bodies at the start"));
    else
      return field_list(kept);
  }

  void init(InitContext<D> const& context) { init(context, context); }
  void init(InitContext<D> const& first, InitContext<D> const& second) {
    const std::string where = place_of<BilateralLagrangianConstraint>(first);
    check_points(where, "first_point", first_point, first.rest.size());
    check_points(where, "second_point", second_point, second.rest.size());
  }
  void reset() { differences.clear(); }

  void addRows(ConstraintRows& rows, ConstrainedState<D> const& state) { addRows(rows, state, state); }
  void addRows(ConstraintRows& rows, ConstrainedState<D> const& first, ConstrainedState<D> const& second) {
    if (!activate || load == 0) return;
    const std::size_t n = std::min(first_point.size(), second_point.size());
    if (keeps()) keepDifferences(first.position, second.position, n);
    for (std::size_t i = 0; i < n; ++i) {
      const int a = first_point[i], b = second_point[i];
      const Deriv d = Real(load) * violation(rows, first, second, i);
      add_point_equalities<D>(rows, [&](int row, int c) {
        rows.addTo(row, a, Deriv(-Deriv::Unit(c)));
        rows.addTo(row, b, Deriv::Unit(c), between ? 1 : 0);
        rows.setViolation(row, double(d[c]));
      });
    }
  }

 private:
  bool keeps() const { return D::rigid && keepOrientationDifference; }
  Deriv violation(ConstraintRows const& rows, ConstrainedState<D> const& first,
                  ConstrainedState<D> const& second, std::size_t i) const {
    const auto a = std::size_t(first_point[i]), b = std::size_t(second_point[i]);
    Coord from = rows.ofVelocity ? first.position[a] : first.free[a];
    if constexpr (D::rigid)
      if (keeps()) shift(from, differences[i]);
    Deriv d = D::difference(from, rows.ofVelocity ? second.position[b] : second.free[b]);
    if (!keeps() && i < rest_vector.size()) d -= rest_vector[i];
    if (rows.ofVelocity) d = d / Real(first.dt) + (second.velocity[b] - first.velocity[a]);
    return d;
  }
  void keepDifferences(typename D::VecCoord const& x1, typename D::VecCoord const& x2, std::size_t n) {
    if constexpr (D::rigid)
      for (std::size_t i = differences.size(); i < n; ++i) {
        Coord const &a = x1[std::size_t(first_point[i])], &b = x2[std::size_t(second_point[i])];
        Coord difference = b;
        difference.center -= a.center;
        if constexpr (D::spatial == 3)
          difference.orientation = (a.orientation.conjugate() * b.orientation).normalized();
        else
          difference.orientation -= a.orientation;
        differences.push_back(difference);
      }
  }
  static void shift(Coord& x, Coord const& by) {
    x.center += by.center;
    if constexpr (D::spatial == 3)
      x.orientation = x.orientation * by.orientation;
    else
      x.orientation += by.orientation;
  }
};

}  // namespace sinew
