// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/core/component.hpp>
#include <sinew/force/point_penalty.hpp>

#include <limits>

namespace sinew {

/// Penalty force of a sphere on a point inside it, at depth h = r - l > 0 (of any sign with bilateral), where
/// l is the distance from the centre and u the direction away from it.
///   E = k/2 h^2,  f = k h u - c |h| v                                                          [J], [N]
///   df/dx = k h/l (I - u u') - k u u',  df/dv = -c |h| I
/// The change of the damping with the depth is left out of the tangent, which keeps it symmetric. A point in
/// the centre has no direction, and is damped only.
template <class D>
struct SpherePenalty {
  using Real = typename D::Real;
  using Coord = typename D::Coord;
  using Deriv = typename D::Deriv;
  using Place = Vec<Real, D::spatial>;
  static constexpr int arity = 1;
  static constexpr bool usesVelocity = true;

  Place center = Place::Zero();
  Real radius{1};
  bool bilateral = false;

  struct Rest {
    Real stiffness, damping;
  };
  struct Tangent {
    Real direction[D::spatial];       // u
    Real stiffness, across, damping;  // k, k h/l, c |h|; 0 for a point that is not touched
  };

  SINEW_HD Real energy(Rest const& rest, Coord const (&x)[1]) const {
    using std::sqrt, sinew::sqrt;
    const Place away = from(x[0]);
    const Real h = radius - sqrt(square(away));
    return select(is_touched(h, bilateral), Real(0.5) * rest.stiffness * h * h, Real(0));
  }

  SINEW_HD void force(Rest const& rest, Coord const (&x)[1], Deriv const (&v)[1], Deriv (&f)[1],
                      Tangent& tangent) const {
    using std::sqrt, sinew::sqrt;
    const Place away = from(x[0]);
    const Real zero(0), l = sqrt(square(away)), h = radius - l;
    const auto acts = is_touched(h, bilateral);
    const Real inverse = select(l > Real(1e-9) * radius, Real(1) / l, zero);
    tangent.stiffness = select(acts, rest.stiffness, zero);
    tangent.across = tangent.stiffness * h * inverse;
    tangent.damping = select(acts, rest.damping * select(h > zero, h, -h), zero);
    for (int c = 0; c < D::size; ++c) f[0][c] = zero;
    for (int c = 0; c < D::spatial; ++c) {
      tangent.direction[c] = away[c] * inverse;
      f[0][c] = tangent.across * away[c] - tangent.damping * v[0][c];
    }
  }

  SINEW_HD void dforce(Rest const& rest, Tangent const& tangent, Deriv const (&dx)[1], Deriv (&df)[1], Real k,
                       Real b) const {
    push_place<D>(block(rest, tangent, 0, 0, k, b), dx[0], df[0]);
  }

  SINEW_INLINE Mat<Real, D::size> block(Rest const&, Tangent const& tangent, int, int, Real k, Real b) const {
    const Real along = -k * (tangent.stiffness + tangent.across),
               all = k * tangent.across - b * tangent.damping;
    Mat<Real, D::size> block;
    for (int c = 0; c < D::size; ++c)
      for (int r = 0; r < D::size; ++r) {
        block(r, c) = Real(0);
        if (r < D::spatial && c < D::spatial)
          block(r, c) = along * tangent.direction[r] * tangent.direction[c];
        if (r < D::spatial && r == c) block(r, c) += all;
      }
    return block;
  }

 private:
  SINEW_INLINE Place from(Coord const& x) const {
    Place away = D::center(x);
    for (int c = 0; c < D::spatial; ++c) away[c] -= center[c];
    return away;
  }
  SINEW_INLINE static Real square(Place const& p) {
    Real sum(std::numeric_limits<lane_scalar<Real>>::min());
    for (int c = 0; c < D::spatial; ++c) sum += p[c] * p[c];
    return sum;
  }
};

/// A sphere that pushes points out.
template <class D>
struct SphereForceField {
  using Role = role::ForceField;
  static constexpr bool sharesWork = true;
  using DataTypes = D;
  using Real = typename D::Real;
  using Center = Vec<double, D::spatial>;
  static constexpr std::string_view className = "SphereForceField";

  Center center = Center::Zero();
  double radius = 1, stiffness = 500, damping = 5;
  bool bilateral = false;

  static constexpr auto fields() {
    using F = SphereForceField;
    return field_list(
        field("center", &F::center, "m", "centre of the sphere").whileRunning(),
        field("radius", &F::radius, "m", "radius of the sphere", range::positive).whileRunning(),
        field("stiffness", &F::stiffness, "N/m", "force per depth inside the sphere", range::nonNegative),
        field("damping", &F::damping, "N s/m^2", "force per depth and speed", range::nonNegative),
        field("bilateral", &F::bilateral, "", "points outside are drawn to the sphere"));
  }

  static constexpr ForceProperties properties() { return {.internal = false, .objective = false}; }

  using Driver = ElementDriver<SpherePenalty, D>;
  Driver driver{};

  void init(InitContext<D> const& context) {
    init_each_point(driver, context.rest.size(), {Real(stiffness), Real(damping)});
  }
  void followPoints(Renumbering const&, std::size_t points)
  requires(counts_points<Driver>)
  {
    driver.initPoints(points, {Real(stiffness), Real(damping)});
  }

  /// The sphere as it stands now, for lanes or one element at a time: it may move from step to step.
  template <class L>
  L law() const {
    using R = typename L::Real;
    L law;
    for (int c = 0; c < D::spatial; ++c) law.center[c] = R(center[c]);
    law.radius = R(radius);
    law.bilateral = bilateral;
    return law;
  }
};

}  // namespace sinew
