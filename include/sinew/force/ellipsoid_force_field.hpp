// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/core/component.hpp>
#include <sinew/force/ellipsoid_penalty.hpp>
#include <sinew/force/point_penalty.hpp>

namespace sinew {

/// An ellipsoid, its axes those of the world, that pushes points out; with a negative stiffness, in.
template <class D>
struct EllipsoidForceField {
  static_assert(!D::rigid, "Sinew: EllipsoidForceField is for points.");
  using Role = role::ForceField;
  using DataTypes = D;
  using Real = typename D::Real;
  using Place = Vec<double, D::size>;
  static constexpr std::string_view className = "EllipsoidForceField";

  Place center = Place::Zero(), vradius = Place::Ones();
  double stiffness = 500, damping = 5;

  static constexpr auto fields() {
    using F = EllipsoidForceField;
    return field_list(
        field("center", &F::center, "m", "centre of the ellipsoid"),
        field("vradius", &F::vradius, "m", "radius along each axis", range::positive),
        field("stiffness", &F::stiffness, "N", "force in the centre; negative: on points outside, inwards"),
        field("damping",
              &F::damping,
              "N s/m",
              "force per speed, times how far the point is from the surface in "
              "parts of the radius",
              range::nonNegative));
  }

  ForceProperties properties() const {
    const bool sphere = (vradius.array() == vradius[0]).all();
    return {.internal = false, .objective = false, .conservative = sphere, .exactTangent = sphere};
  }

  using Driver = ElementDriver<EllipsoidPenalty, D>;
  Driver driver{};

  void init(InitContext<D> const& context) { init_each_point(driver, context.rest.size(), {Real(1)}); }
  void followPoints(Renumbering const&, std::size_t points)
  requires(counts_points<Driver>)
  {
    driver.initPoints(points, {Real(1)});
  }

  /// The ellipsoid as it stands now, for lanes or one element at a time: it may move from step to step.
  template <class L>
  L law() const {
    using R = typename L::Real;
    L law;
    for (int c = 0; c < D::size; ++c) {
      law.center[c] = R(center[c]);
      law.inverse[c] = R(1 / (vradius[c] * vradius[c]));
    }
    law.stiffness = R(stiffness < 0 ? -stiffness : stiffness);
    law.damping = R(damping);
    law.outside = stiffness < 0;
    return law;
  }
};

}  // namespace sinew
