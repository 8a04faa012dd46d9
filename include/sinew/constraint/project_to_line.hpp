// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/constraint/constrained_points.hpp>

#include <vector>

namespace sinew {

/// Points stay on a line, where they slide freely: P = d d'.
template <class D>
struct ProjectToLineConstraint {
  using Role = role::ProjectiveConstraint;
  using DataTypes = D;
  using Real = typename D::Real;
  using VecCoord = typename D::VecCoord;
  using VecDeriv = typename D::VecDeriv;
  using Place = Vec<double, D::spatial>;
  static constexpr std::string_view className = "ProjectToLineConstraint";
  static constexpr std::string_view aliases = "ProjectToLineProjectiveConstraint LineProjectiveConstraint";

  std::vector<int> indices{0};
  Place origin = Place::Zero(), direction = Place::Zero();

  static constexpr auto fields() {
    using F = ProjectToLineConstraint;
    return field_list(
        field("indices", &F::indices, "", "points that are held", range::nonNegative).numbersOf(Of::points),
        field("origin", &F::origin, "m", "a point of the line"),
        field("direction", &F::direction, "", "direction of the line"));
  }

  Mat<Real, D::size> projector = Mat<Real, D::size>::Identity();
  Place along = Place::Zero();  // unit direction

  void init(InitContext<D> const& context) {
    check_points<ProjectToLineConstraint>(context, indices);
    along = unit<ProjectToLineConstraint>(context, "direction", direction);
    projector = projector_of_place<D>(along * along.transpose());
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
      set_center<D>(point, Place(origin + along * along.dot(p - origin)).template cast<Real>());
    }
  }
  void projectVelocity(double /*time*/, VecDeriv& v) const { projectResponse(v); }
};

}  // namespace sinew
