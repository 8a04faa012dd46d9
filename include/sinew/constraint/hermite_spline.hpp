// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/constraint/constrained_points.hpp>

#include <vector>

namespace sinew {

/// Points move along a cubic between two times, and are free before and after. With u from 0 to 1 in time and
///   H0 = 2 s^3 - 3 s^2 + 1,  H1 = s^3 - 2 s^2 + s,  H2 = 3 s^2 - 2 s^3,  H3 = s^3 - s^2
/// (Hermite's polynomials) the path is x = X0 H0(s) + dX0 H1(s) + X1 H2(s) + dX1 H3(s), and s itself goes
/// from 0 to 1 as s = SX0 H1(u) + H2(u) + SX1 H3(u), with the second numbers of SX0 and SX1: slopes of 1 at
/// both ends make s = u, slopes of 0 start and end at rest. Rigid bodies move with their centre and do not
/// rotate.
template <class D>
struct HermiteSplineConstraint {
  using Role = role::ProjectiveConstraint;
  using DataTypes = D;
  using Real = typename D::Real;
  using VecCoord = typename D::VecCoord;
  using VecDeriv = typename D::VecDeriv;
  using Place = Vec<double, D::spatial>;
  static constexpr std::string_view className = "HermiteSplineConstraint";
  static constexpr std::string_view aliases = "HermiteSplineProjectiveConstraint";

  std::vector<int> indices{};
  double beginTime = 0, endTime = 0;
  Place x0 = Place::Zero(), dx0 = Place::Zero(), x1 = Place::Zero(), dx1 = Place::Zero();
  Eigen::Vector2d sx0{0, 0}, sx1{0, 0};

  static constexpr auto fields() {
    using F = HermiteSplineConstraint;
    return field_list(
        field("indices", &F::indices, "", "points that are moved", range::nonNegative).numbersOf(Of::points),
        field("BeginTime", &F::beginTime, "s", "when the movement begins"),
        field("EndTime", &F::endTime, "s", "when it ends"),
        field("X0", &F::x0, "m", "where it begins"),
        field("dX0", &F::dx0, "m", "derivative of the path by s there"),
        field("X1", &F::x1, "m", "where it ends"),
        field("dX1", &F::dx1, "m", "derivative of the path by s there"),
        field("SX0", &F::sx0, "", "slope of s by u where it begins, the second number"),
        field("SX1", &F::sx1, "", "slope of s by u where it ends, the second number"));
  }

  bool active = false;  // at the end of the last step

  void init(InitContext<D> const& context) {
    check_points<HermiteSplineConstraint>(context, indices);
    check_begin_and_end<HermiteSplineConstraint>(context, beginTime, endTime, indices.empty());
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
    const Eigen::Vector4d h = hermite(progress(time)[0]);
    const Place place = x0 * h[0] + dx0 * h[1] + x1 * h[2] + dx1 * h[3];
    place_points<D>(x, indices, place);
  }
  void projectVelocity(double time, VecDeriv& v) {
    active = movement().moves(time);
    if (!movement().given(time)) return;
    const auto [s, rate] = progress(time);
    const Eigen::Vector4d h = hermiteRate(s) * rate;
    const Place velocity = x0 * h[0] + dx0 * h[1] + x1 * h[2] + dx1 * h[3];
    move_points<D>(v, indices, velocity);
  }

 private:
  MovementTime movement() const { return {beginTime, endTime}; }

  static Eigen::Vector4d hermite(double s) {
    const double s2 = s * s, s3 = s2 * s;
    return {2 * s3 - 3 * s2 + 1, s3 - 2 * s2 + s, 3 * s2 - 2 * s3, s3 - s2};
  }
  static Eigen::Vector4d hermiteRate(double s) {
    const double s2 = s * s;
    return {6 * s2 - 6 * s, 3 * s2 - 4 * s + 1, 6 * s - 6 * s2, 3 * s2 - 2 * s};
  }
  // s and ds/dt
  std::array<double, 2> progress(double time) const {
    const double u = (time - beginTime) / (endTime - beginTime);
    const Eigen::Vector4d h = hermite(u), rate = hermiteRate(u);
    return {sx0[1] * h[1] + h[2] + sx1[1] * h[3],
            (sx0[1] * rate[1] + rate[2] + sx1[1] * rate[3]) / (endTime - beginTime)};
  }
};

}  // namespace sinew
