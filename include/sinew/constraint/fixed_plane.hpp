// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/constraint/constrained_points.hpp>

#include <vector>

namespace sinew {

/// Points never change their velocity along a direction: given ones, and those that lie at rest between two
/// planes across it, dmin < x.direction < dmax. They slide in their plane.
template <class D>
struct FixedPlaneConstraint {
  using Role = role::ProjectiveConstraint;
  using DataTypes = D;
  using VecDeriv = typename D::VecDeriv;
  using Direction = Vec<double, D::spatial>;
  static constexpr std::string_view className = "FixedPlaneConstraint";
  static constexpr std::string_view aliases = "FixedPlaneProjectiveConstraint";

  Direction direction = Direction::Zero();
  double dmin = 0, dmax = 0;
  std::vector<int> indices{};

  static constexpr auto fields() {
    using F = FixedPlaneConstraint;
    return field_list(
        field("direction", &F::direction, "", "normal of the planes"),
        field("dmin", &F::dmin, "m", "lowest x.direction of points to be held"),
        field("dmax", &F::dmax, "m", "highest x.direction of points to be held; none where it is dmin"),
        field("indices", &F::indices, "", "more points to be held", range::nonNegative)
            .numbersOf(Of::points));
  }

  Mat<typename D::Real, D::size> projector = Mat<typename D::Real, D::size>::Identity();
  std::vector<int> held{};

  void init(InitContext<D> const& context) {
    check_points<FixedPlaneConstraint>(context, indices);
    if (dmax < dmin)
      throw Error(place_of<FixedPlaneConstraint>(context),
                  text("dmin is ", dmin, " m and dmax ", dmax, " m; give dmin below dmax"));
    const Direction n = unit<FixedPlaneConstraint>(context, "direction", direction);
    projector = projector_of_place<D>(Mat<double, D::spatial>::Identity() - n * n.transpose());
    held = indices;
    for (std::size_t i = 0; i < context.rest.size(); ++i) {
      const double d = D::center(context.rest[i]).template cast<double>().dot(direction);
      if (d > dmin && d < dmax) held.push_back(int(i));
    }
    // a point is projected once
    std::sort(held.begin(), held.end());
    held.erase(std::unique(held.begin(), held.end()), held.end());
  }

  void projectResponse(VecDeriv& dx) const {
    for (const int i : held) dx[std::size_t(i)] = (projector * dx[std::size_t(i)]).eval();
  }
  template <class Sink>
  void projectMatrix(Sink const& sink) const {
    for (const int i : held) sink.project(i, projector);
  }
};

}  // namespace sinew
