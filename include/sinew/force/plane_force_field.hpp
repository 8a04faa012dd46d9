// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/core/component.hpp>
#include <sinew/force/point_penalty.hpp>

#include <limits>

namespace sinew {

/// Penalty force of a plane n.x = d on a point behind it, at depth h = d - n.x > 0 (of any sign with
/// bilateral).
///   E = k/2 h^2,  f = k h n - c |h| v,  no longer than maxForce where that is above 0           [J], [N]
///   df/dx = -k n n',  df/dv = -c |h| I;  of a force cut to maxForce along u, 0 and -c' (I - u u')
/// The change of the damping with the depth is left out of the tangent, which keeps it symmetric.
template <class D>
struct PlanePenalty {
  using Real = typename D::Real;
  using Coord = typename D::Coord;
  using Deriv = typename D::Deriv;
  using Place = Vec<Real, D::spatial>;
  static constexpr int arity = 1;
  static constexpr bool usesVelocity = true;

  Place normal = Place::Zero();
  Real d{0}, maxForce{0}, maxPush{0};  // maxPush = maxForce / |n|
  bool limited = false, bilateral = false;

  struct Rest {
    Real stiffness, damping;
  };
  struct Tangent {
    Real stiffness,
        damping;  // k, and c |h|, of a point that the plane pushes and whose force is not cut; else 0 and c'
    Real cut[D::spatial];  // u where the force is cut, else 0
  };

  SINEW_HD Real energy(Rest const& rest, Coord const (&x)[1]) const {
    const Real h = depth(x[0]), zero(0);
    const auto acts = is_touched(h, bilateral);
    const Real free = Real(0.5) * rest.stiffness * h * h;
    if (!limited) return select(acts, free, zero);
    // beyond the depth where k |h| |n| = maxForce the force stays, and the energy is linear
    const Real distance = select(h > zero, h, -h);
    const Real kink = Real(0.5) * maxPush * maxPush / select(rest.stiffness > zero, rest.stiffness, Real(1));
    return select(acts, select(rest.stiffness * distance > maxPush, maxPush * distance - kink, free), zero);
  }

  SINEW_HD void force(Rest const& rest, Coord const (&x)[1], Deriv const (&v)[1], Deriv (&f)[1],
                      Tangent& tangent) const {
    using std::sqrt, sinew::sqrt;
    const Real h = depth(x[0]), zero(0);
    const auto acts = is_touched(h, bilateral);
    const Real push = select(acts, rest.stiffness * h, zero);
    Real damping = select(acts, rest.damping * select(h > zero, h, -h), zero);
    Real stiffness = select(acts, rest.stiffness, zero);
    Place force;
    for (int c = 0; c < D::spatial; ++c) force[c] = push * normal[c] - damping * v[0][c];
    if (limited) {
      Real square(std::numeric_limits<lane_scalar<Real>>::min());
      for (int c = 0; c < D::spatial; ++c) square += force[c] * force[c];
      const auto over = square > maxForce * maxForce;
      const Real inverse = Real(1) / sqrt(square), scale = select(over, maxForce * inverse, Real(1));
      for (int c = 0; c < D::spatial; ++c) {
        tangent.cut[c] = select(over, force[c] * inverse, zero);
        force[c] = force[c] * scale;
      }
      damping = damping * scale;
      stiffness = select(over, zero, stiffness);
    } else {
      for (int c = 0; c < D::spatial; ++c) tangent.cut[c] = zero;
    }
    tangent.stiffness = stiffness;
    tangent.damping = damping;
    for (int c = 0; c < D::size; ++c) f[0][c] = c < D::spatial ? force[c < D::spatial ? c : 0] : zero;
  }

  SINEW_HD void dforce(Rest const& rest, Tangent const& tangent, Deriv const (&dx)[1], Deriv (&df)[1], Real k,
                       Real b) const {
    push_place<D>(block(rest, tangent, 0, 0, k, b), dx[0], df[0]);
  }

  SINEW_INLINE Mat<Real, D::size> block(Rest const&, Tangent const& tangent, int, int, Real k, Real b) const {
    const Real along = -k * tangent.stiffness, all = -b * tangent.damping;
    Mat<Real, D::size> block;
    for (int c = 0; c < D::size; ++c)
      for (int r = 0; r < D::size; ++r) {
        block(r, c) = Real(0);
        if (r < D::spatial && c < D::spatial)
          block(r, c) = along * normal[r] * normal[c] - all * tangent.cut[r] * tangent.cut[c];
        if (r < D::spatial && r == c) block(r, c) += all;
      }
    return block;
  }

 private:
  SINEW_INLINE Real depth(Coord const& x) const {
    const Place p = D::center(x);
    Real h = d;
    for (int c = 0; c < D::spatial; ++c) h -= normal[c] * p[c];
    return h;
  }
};

/// A plane that pushes points back to the side that its normal shows.
template <class D>
struct PlaneForceField {
  using Role = role::ForceField;
  static constexpr bool sharesWork = true;
  using DataTypes = D;
  using Real = typename D::Real;
  using Normal = Vec<double, D::spatial>;
  static constexpr std::string_view className = "PlaneForceField";

  Normal normal = Normal::Unit(D::spatial > 1 ? 1 : 0);
  double d = 0, stiffness = 500, damping = 5, maxForce = 0;
  bool bilateral = false;

  static constexpr auto fields() {
    using F = PlaneForceField;
    return field_list(
        field("normal", &F::normal, "", "normal of the plane, used at the length given").whileRunning(),
        field("d", &F::d, "m", "the plane is where normal.x = d").whileRunning(),
        field("stiffness", &F::stiffness, "N/m", "force per depth behind the plane", range::nonNegative),
        field("damping", &F::damping, "N s/m^2", "force per depth and speed", range::nonNegative),
        field("maxForce", &F::maxForce, "N", "largest force on a point; 0 for any", range::nonNegative),
        field("bilateral", &F::bilateral, "", "points in front of the plane are drawn to it"));
  }

  static constexpr ForceProperties properties() { return {.internal = false, .objective = false}; }

  using Driver = ElementDriver<PlanePenalty, D>;
  Driver driver{};

  void init(InitContext<D> const& context) {
    takeValues(context.where, context.rest.size());
    init_each_point(driver, context.rest.size(), {Real(stiffness), Real(damping)});
  }
  void takeValues(std::string_view where, std::size_t /*points*/) const {
    if (!(normal.norm() > 0))
      throw Error(text(where, ": ", component_name<PlaneForceField>()),
                  "normal is zero; give the normal of the plane");
  }
  void followPoints(Renumbering const&, std::size_t points)
  requires(counts_points<Driver>)
  {
    driver.initPoints(points, {Real(stiffness), Real(damping)});
  }

  /// The plane as it stands now, for lanes or one element at a time: it may move from step to step.
  template <class L>
  L law() const {
    using R = typename L::Real;
    L law;
    for (int c = 0; c < D::spatial; ++c) law.normal[c] = R(normal[c]);
    law.d = R(d);
    law.maxForce = R(maxForce);
    law.maxPush = R(maxForce / normal.norm());
    law.limited = maxForce > 0;
    law.bilateral = bilateral;
    return law;
  }
};

}  // namespace sinew
