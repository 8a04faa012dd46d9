// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/constraint/constrained_points.hpp>

#include <vector>

namespace sinew {

/// Points stay in a plane, where they slide freely: P = I - n n'.
template <class D>
struct ProjectToPlaneConstraint {
  using Role = role::ProjectiveConstraint;
  using DataTypes = D;
  using Real = typename D::Real;
  using VecCoord = typename D::VecCoord;
  using VecDeriv = typename D::VecDeriv;
  using Place = Vec<double, D::spatial>;
  static constexpr std::string_view className = "ProjectToPlaneConstraint";
  static constexpr std::string_view aliases = "ProjectToPlaneProjectiveConstraint PlaneProjectiveConstraint";

  std::vector<int> indices{0};
  Place origin = Place::Zero(), normal = Place::Zero();

  static constexpr auto fields() {
    using F = ProjectToPlaneConstraint;
    return field_list(
        field("indices", &F::indices, "", "points that are held", range::nonNegative).numbersOf(Of::points),
        field("origin", &F::origin, "m", "a point of the plane"),
        field("normal", &F::normal, "", "normal of the plane"));
  }

  Mat<Real, D::size> projector = Mat<Real, D::size>::Identity();
  Place across = Place::Zero();  // unit normal

  void init(InitContext<D> const& context) {
    check_points<ProjectToPlaneConstraint>(context, indices);
    across = unit<ProjectToPlaneConstraint>(context, "normal", normal);
    projector = projector_of_place<D>(Mat<double, D::spatial>::Identity() - across * across.transpose());
  }

  void projectResponse(VecDeriv& dx) const {
    for (const int i : indices) dx[std::size_t(i)] = (projector * dx[std::size_t(i)]).eval();
  }
  template <class Sink>
  void projectMatrix(Sink const& sink) const {
    for (const int i : indices) sink.project(i, projector);
  }

  void projectPosition(double /*time*/, VecCoord& x) const {
    for (const int i : indices) {
      auto& point = x[std::size_t(i)];
      const Place p = D::center(point).template cast<double>();
      set_center<D>(point, Place(p - across * across.dot(p - origin)).template cast<Real>());
    }
  }
  void projectVelocity(double /*time*/, VecDeriv& v) const { projectResponse(v); }
};

}  // namespace sinew
