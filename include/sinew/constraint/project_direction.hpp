// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/constraint/constrained_points.hpp>

#include <vector>

namespace sinew {

/// Each point stays on the line through its rest position along a direction, where it slides freely: P = d
/// d'.
template <class D>
struct ProjectDirectionConstraint {
  using Role = role::ProjectiveConstraint;
  using DataTypes = D;
  using Real = typename D::Real;
  using VecCoord = typename D::VecCoord;
  using VecDeriv = typename D::VecDeriv;
  using Place = Vec<double, D::spatial>;
  static constexpr std::string_view className = "ProjectDirectionConstraint";
  static constexpr std::string_view aliases =
      "ProjectDirectionProjectiveConstraint DirectionProjectiveConstraint";

  std::vector<int> indices{0};
  Place direction = Place::Zero();

  static constexpr auto fields() {
    using F = ProjectDirectionConstraint;
    return field_list(
        field("indices", &F::indices, "", "points that are held", range::nonNegative).numbersOf(Of::points),
        field("direction", &F::direction, "", "direction of the lines"));
  }

  Mat<Real, D::size> projector = Mat<Real, D::size>::Identity();
  Place along = Place::Zero();  // unit direction
  std::vector<Place> origins{};

  void init(InitContext<D> const& context) {
    check_points<ProjectDirectionConstraint>(context, indices);
    along = unit<ProjectDirectionConstraint>(context, "direction", direction);
    projector = projector_of_place<D>(along * along.transpose());
    origins.clear();
    for (const int i : indices)
      origins.push_back(D::center(context.rest[std::size_t(i)]).template cast<double>());
  }

  void projectResponse(VecDeriv& dx) const {
    for (const int i : indices) dx[std::size_t(i)] = (projector * dx[std::size_t(i)]).eval();
  }
  template <class Sink>
  void projectMatrix(Sink const& sink) const {
    for (const int i : indices) sink.project(i, projector);
  }

  void projectPosition(double /*time*/, VecCoord& x) const {
    for (std::size_t k = 0; k < indices.size(); ++k) {
      auto& point = x[std::size_t(indices[k])];
      const Place p = D::center(point).template cast<double>();
      set_center<D>(point, Place(origins[k] + along * along.dot(p - origins[k])).template cast<Real>());
    }
  }
  void projectVelocity(double /*time*/, VecDeriv& v) const { projectResponse(v); }
};

}  // namespace sinew
