// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/constraint/constrained_points.hpp>
#include <sinew/core/ends.hpp>
#include <sinew/lagrangian/constraint_rows.hpp>

#include <algorithm>
#include <limits>
#include <vector>

namespace sinew {

/// A point P of one body slides without friction along the line between two points A and B of the other, and
/// not beyond them. With the axis u = (B - A)/|B - A| at the start of the step, where the foot of P on the
/// line is Q = (1 - s) A + s B, 0 <= s <= 1, and with normals n of u:
///   n.(P - Q) = 0,   u.(P - A) >= 0,   -u.(P - B) >= 0
/// Where A and B are in one place, P stays there: P = A. Of rigid bodies it is the centres.
template <class D, class E = Within>
struct SlidingLagrangianConstraint {
  using Ends = E;
  template <class Other>
  using WithEnds = SlidingLagrangianConstraint<D, Other>;
  static constexpr bool between = !std::is_same_v<E, Within>;
  using Role = role::LagrangianConstraint;
  using DataTypes = D;
  using Real = typename D::Real;
  using Deriv = typename D::Deriv;
  static constexpr int N = D::spatial;
  static_assert(N == 2 || N == 3, "SlidingLagrangianConstraint is for points in space or in the plane");
  using Place = Vec<Real, N>;
  static constexpr std::string_view className = "SlidingLagrangianConstraint";

  int sliding_point = 0, axis_1 = 0, axis_2 = 0;
  [[no_unique_address]] E ends{};

  static constexpr auto fields() {
    using F = SlidingLagrangianConstraint;
    return field_list(
        field("sliding_point", &F::sliding_point, "", "the point of the first body", range::nonNegative)
            .numbersOf(Of::points),
        field("axis_1", &F::axis_1, "", "one end of the line, a point of the second body", range::nonNegative)
            .numbersOf(Of::secondPoints),
        field("axis_2", &F::axis_2, "", "its other end", range::nonNegative).numbersOf(Of::secondPoints));
  }

  std::vector<double> multipliers{};  // across the line, then along it at each of its ends

  bool none = false;  // the point or an end of the line has been removed

  static constexpr auto state() {
    return field_list(
        field("multipliers", &SlidingLagrangianConstraint::multipliers, "N", "of the last step"),
        field("none",
              &SlidingLagrangianConstraint::none,
              "",
              "the point or an end of the line has been removed"));
  }

  void init(InitContext<D> const& context) { init(context, context); }
  void init(InitContext<D> const& first, InitContext<D> const& second) {
    if (none) return;
    const std::string where = place_of<SlidingLagrangianConstraint>(first);
    check_points(where, "sliding_point", std::vector{sliding_point}, first.rest.size());
    check_points(where, "axis_1 or axis_2", std::vector{axis_1, axis_2}, second.rest.size());
  }

  void addRows(ConstraintRows& rows, ConstrainedState<D> const& state) const { addRows(rows, state, state); }
  void addRows(ConstraintRows& rows, ConstrainedState<D> const& first,
               ConstrainedState<D> const& second) const {
    if (none) return;
    const Motion p = motion(rows, first, sliding_point), a = motion(rows, second, axis_1),
                 b = motion(rows, second, axis_2);
    const Place line = b.start - a.start;
    const Real length = line.norm();
    if (!(length > std::numeric_limits<Real>::epsilon())) {
      const int row = rows.addEquality(N);
      for (int c = 0; c < N; ++c) addRow(rows, row + c, Place::Unit(c), p, a, b, 0);
      return;
    }
    const Place u = line / length;
    const Real s = std::clamp(u.dot(p.start - a.start) / length, Real(0), Real(1));
    const int row = rows.addEquality(N - 1);
    const Place n = u.unitOrthogonal();
    addRow(rows, row, n, p, a, b, s);
    if constexpr (N == 3) addRow(rows, row + 1, u.cross(n), p, a, b, s);
    addRow(rows, rows.addUnilateral(), u, p, a, b, 0);
    addRow(rows, rows.addUnilateral(), -u, p, a, b, 1);
  }

 private:
  // a point at the start of the step, and at its end without multipliers, or what its velocity adds up to
  struct Motion {
    int point;
    Place start, end;
  };
  static Motion motion(ConstraintRows const& rows, ConstrainedState<D> const& state, int point) {
    const auto i = std::size_t(point);
    const Place start = D::center(state.position[i]);
    if (!rows.ofVelocity) return {point, start, D::center(state.free[i])};
    return {point, start, start / Real(state.dt) + state.velocity[i].template head<N>()};
  }
  // direction.(P - (1 - s) A - s B)
  static void addRow(ConstraintRows& rows, int row, Place const& direction, Motion const& p, Motion const& a,
                     Motion const& b, Real s) {
    auto add = [&](int point, Real factor, int side) {
      Deriv j = Deriv::Zero();
      j.template head<N>() = factor * direction;
      if (factor != 0) rows.addTo(row, point, j, side);
    };
    add(p.point, 1, 0);
    add(a.point, s - 1, between ? 1 : 0);
    add(b.point, -s, between ? 1 : 0);
    rows.setViolation(row, double(direction.dot(p.end - (1 - s) * a.end - s * b.end)));
  }
};

}  // namespace sinew
