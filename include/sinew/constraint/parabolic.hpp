// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/constraint/constrained_points.hpp>

#include <vector>

namespace sinew {

/// Points fly between two times along the parabola through P1, P2 and P3, with constant velocity along P1P3,
/// and are free before and after. With r from 0 to 1 in time, a = P1P2.P1P3 / |P1P3|^2 and h = P1P2 - a P1P3:
///   x = P1 + r P1P3 + h r (1 - r) / (a (1 - a))
/// Rigid bodies move with their centre and do not rotate.
template <class D>
struct ParabolicConstraint {
  using Role = role::ProjectiveConstraint;
  using DataTypes = D;
  using Real = typename D::Real;
  using VecCoord = typename D::VecCoord;
  using VecDeriv = typename D::VecDeriv;
  using Place = Vec<double, D::spatial>;
  static constexpr std::string_view className = "ParabolicConstraint";
  static constexpr std::string_view aliases = "ParabolicProjectiveConstraint";

  std::vector<int> indices{};
  Place p1 = Place::Zero(), p2 = Place::Zero(), p3 = Place::Zero();
  double beginTime = 0, endTime = 0;

  static constexpr auto fields() {
    using F = ParabolicConstraint;
    return field_list(
        field("indices", &F::indices, "", "points that are moved", range::nonNegative).numbersOf(Of::points),
        field("P1", &F::p1, "m", "where the movement begins"),
        field("P2", &F::p2, "m", "where it passes"),
        field("P3", &F::p3, "m", "where it ends"),
        field("BeginTime", &F::beginTime, "s", "when it begins"),
        field("EndTime", &F::endTime, "s", "when it ends"));
  }

  Place along = Place::Zero(), across = Place::Zero();  // P1P3, h / (a (1 - a))
  bool active = false;                                  // at the end of the last step

  void init(InitContext<D> const& context) {
    check_points<ParabolicConstraint>(context, indices);
    check_begin_and_end<ParabolicConstraint>(context, beginTime, endTime, indices.empty());
    along = p3 - p1;
    across.setZero();
    if (!indices.empty()) {
      const Place passed = p2 - p1;
      const std::string where = place_of<ParabolicConstraint>(context);
      if (!(along.norm() > 0)) throw Error(where, "P1 and P3 are one point; give two ends");
      const double a = passed.dot(along) / along.squaredNorm();
      const Place height = passed - a * along;
      // on the line from P1 to P3 there is no need for P2
      if (height.norm() > 1e-12 * (passed.norm() + along.norm())) {
        if (!(std::abs(a * (1 - a)) > 1e-9))
          throw Error(where,
                      "P2 is right above P1 or P3, where no parabola passes; move it between them, or off");
        across = height / (a * (1 - a));
      }
    }
    active = movement().moves(0);
  }

  void projectResponse(VecDeriv& dx) const {
    if (active)
      for (const int i : indices) dx[std::size_t(i)].setZero();
  }
  template <class Sink>
  void projectMatrix(Sink const& sink) const {
    if (active)
      for (const int i : indices) sink.fix(i);
  }

  void projectPosition(double time, VecCoord& x) {
    active = movement().moves(time);
    if (!movement().given(time)) return;
    const double r = (time - beginTime) / (endTime - beginTime);
    const Place place = p1 + r * along + r * (1 - r) * across;
    place_points<D>(x, indices, place);
  }
  void projectVelocity(double time, VecDeriv& v) {
    active = movement().moves(time);
    if (!movement().given(time)) return;
    const double length = endTime - beginTime, r = (time - beginTime) / length;
    const Place velocity = (along + (1 - 2 * r) * across) / length;
    move_points<D>(v, indices, velocity);
  }

 private:
  MovementTime movement() const { return {beginTime, endTime}; }
};

}  // namespace sinew
