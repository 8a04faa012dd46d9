// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/constraint/constrained_points.hpp>

#include <array>
#include <vector>

namespace sinew {

/// Points stay in one place, wherever they start. Rigid bodies rotate about it freely.
template <class D>
struct ProjectToPointConstraint {
  using Role = role::ProjectiveConstraint;
  using DataTypes = D;
  using Real = typename D::Real;
  using VecCoord = typename D::VecCoord;
  using VecDeriv = typename D::VecDeriv;
  using Place = Vec<double, D::spatial>;
  static constexpr std::string_view className = "ProjectToPointConstraint";
  static constexpr std::string_view aliases = "ProjectToPointProjectiveConstraint PointProjectiveConstraint";

  std::vector<int> indices{0};
  Place point = Place::Zero();
  bool fixAll = false;

  static constexpr auto fields() {
    using F = ProjectToPointConstraint;
    return field_list(
        field("indices", &F::indices, "", "points that are held", range::nonNegative).numbersOf(Of::points),
        field("point", &F::point, "m", "where they are held"),
        field("fixAll", &F::fixAll, "", "all points are held"));
  }

  std::array<int, D::size> mask{};  // 1 for the coordinates of the place
  std::size_t size = 0;

  void init(InitContext<D> const& context) {
    if (!fixAll) check_points<ProjectToPointConstraint>(context, indices);
    std::fill_n(mask.begin(), D::spatial, 1);
    size = context.rest.size();
  }

  void projectResponse(VecDeriv& dx) const {
    forEachPoint([&](int i) { dx[std::size_t(i)].template head<D::spatial>().setZero(); });
  }
  template <class Sink>
  void projectMatrix(Sink const& sink) const {
    forEachPoint([&](int i) { sink.fix(i, mask); });
  }
  void projectPosition(double /*time*/, VecCoord& x) const {
    forEachPoint([&](int i) { set_center<D>(x[std::size_t(i)], point.template cast<Real>()); });
  }
  void projectVelocity(double /*time*/, VecDeriv& v) const { projectResponse(v); }

  template <class F>
  void forEachPoint(F&& f) const {
    if (fixAll)
      for (std::size_t i = 0; i < size; ++i) f(int(i));
    else
      for (const int i : indices) f(i);
  }
};

}  // namespace sinew
