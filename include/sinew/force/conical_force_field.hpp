// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/core/component.hpp>
#include <sinew/force/point_penalty.hpp>

#include <cmath>
#include <limits>
#include <numbers>
#include <string>
#include <string_view>

namespace sinew {

/// Penalty force of a cone on a point outside of it. The cone is the part of a ball about its apex, of the
/// radius h, in which directions are at most an angle a off the axis n: a convex body, of which P(x) is the
/// place nearest to x. With u the direction of P(x) - x
///   E = k/2 |P(x) - x|^2,  f = k (P(x) - x) - c (u.v) u                                        [J], [N]
///   df/dx = -k (I - dP/dx),  df/dv = -c u u'
/// Of y = x - apex with the parts z = n.y along the axis and r = |y - z n| across it, e = cos(a) n + sin(a)
/// (y - z n)/r is the direction along the side, and q that around the axis:
///   behind the side   P = t e, t = z cos(a) + r sin(a) in [0, h],  dP/dx = e e' + sin(a) t/r q q'
///   behind the rim    t = h,  dP/dx = sin(a) h/r q q';  behind the apex P = 0
///   behind the cap    P = h y/|y|,  dP/dx = h/|y| (I - y y'/|y|^2)
template <class D>
struct ConePenalty {
  using Real = typename D::Real;
  using Coord = typename D::Coord;
  using Deriv = typename D::Deriv;
  using Vec3 = Vec<Real, 3>;
  static constexpr int arity = 1;
  static constexpr bool usesVelocity = true;

  Vec3 apex = Vec3::Zero(), axis = Vec3(Real(0), Real(0), Real(1));
  Real height{1}, cosine{1}, sine{0};  // of the angle

  struct Rest {
    Real stiffness, damping;
  };
  struct Tangent {
    Real slope[6];      // I - dP/dx: xx, yy, zz, xy, xz, yz; 0 inside
    Real direction[3];  // u, 0 inside
  };

  SINEW_HD Real energy(Rest const& rest, Coord const (&x)[1]) const {
    const Vec3 back = nearest(x[0]).back;
    return Real(0.5) * rest.stiffness * dot(back, back);
  }

  SINEW_HD void force(Rest const& rest, Coord const (&x)[1], Deriv const (&v)[1], Deriv (&f)[1],
                      Tangent& tangent) const {
    using std::sqrt, sinew::sqrt;
    const Nearest p = nearest(x[0]);
    for (int k = 0; k < 6; ++k) tangent.slope[k] = p.slope[k];
    const Real zero(0), distance = sqrt(dot(p.back, p.back) + tiny());
    const Real inverse = select(distance > Real(1e-12) * height, Real(1) / distance, zero);
    Real speed(0);
    for (int c = 0; c < 3; ++c) {
      tangent.direction[c] = p.back[c] * inverse;
      speed += tangent.direction[c] * v[0][c];
    }
    for (int c = 0; c < 3; ++c)
      f[0][c] = rest.stiffness * p.back[c] - rest.damping * speed * tangent.direction[c];
  }

  SINEW_HD void dforce(Rest const& rest, Tangent const& tangent, Deriv const (&dx)[1], Deriv (&df)[1], Real k,
                       Real b) const {
    const Mat<Real, 3> m = block(rest, tangent, 0, 0, k, b);
    for (int r = 0; r < 3; ++r) df[0][r] = m(r, 0) * dx[0][0] + m(r, 1) * dx[0][1] + m(r, 2) * dx[0][2];
  }

  SINEW_INLINE Mat<Real, 3> block(Rest const& rest, Tangent const& tangent, int, int, Real k, Real b) const {
    Mat<Real, 3> block;
    for (int c = 0; c < 3; ++c)
      for (int r = 0; r < 3; ++r)
        block(r, c) = -k * rest.stiffness * tangent.slope[r == c ? r : r + c + 2] -
                      b * rest.damping * tangent.direction[r] * tangent.direction[c];
    return block;
  }

 private:
  struct Nearest {
    Vec3 back;      // P(x) - x
    Real slope[6];  // I - dP/dx
  };
  static constexpr Real tiny() { return Real(std::numeric_limits<lane_scalar<Real>>::min()); }
  SINEW_INLINE static Real dot(Vec3 const& a, Vec3 const& b) {
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
  }
  SINEW_INLINE Nearest nearest(Coord const& x) const {
    using std::sqrt, sinew::sqrt;
    const Real zero(0), one(1);
    Vec3 y, across, e, q;
    for (int c = 0; c < 3; ++c) y[c] = x[c] - apex[c];
    const Real z = dot(y, axis), length = sqrt(dot(y, y) + tiny());
    for (int c = 0; c < 3; ++c) across[c] = y[c] - z * axis[c];
    const Real r = sqrt(dot(across, across) + tiny());
    const Real perR = select(r > Real(1e-9) * height, one / r, zero);
    for (int c = 0; c < 3; ++c) {
      across[c] = across[c] * perR;
      e[c] = cosine * axis[c] + sine * across[c];
    }
    for (int c = 0; c < 3; ++c)
      q[c] = axis[(c + 1) % 3] * across[(c + 2) % 3] - axis[(c + 2) % 3] * across[(c + 1) % 3];

    const auto beside = r * cosine > z * sine;  // the angle of y is larger than that of the cone
    const Real along = z * cosine + r * sine;
    const auto onSide = both(along > zero, along < height);
    const Real t = select(along > zero, select(along < height, along, height), zero);
    const auto behindCap = both(length > height, z * sine >= r * cosine);
    const Real scale = select(behindCap, height / length, one);  // of y, where it is not beside

    Nearest p;
    for (int c = 0; c < 3; ++c) p.back[c] = select(beside, t * e[c] - y[c], (scale - one) * y[c]);
    const Real ofE = select(onSide, one, zero), ofQ = sine * t * perR, perLength = one / length;
    for (int k = 0; k < 6; ++k) {
      const int i = k < 3 ? k : k == 5 ? 1 : 0, j = k < 3 ? k : k == 3 ? 1 : 2;
      const Real unit(k < 3 ? 1 : 0);
      const Real side = unit - ofE * e[i] * e[j] - ofQ * q[i] * q[j];
      const Real cap = (one - scale) * unit + scale * y[i] * perLength * y[j] * perLength;
      p.slope[k] = select(beside, side, select(behindCap, cap, zero));
    }
    return p;
  }
};

/// A cone that holds points inside.
template <class D>
struct ConicalForceField {
  using Role = role::ForceField;
  static constexpr bool sharesWork = true;
  using DataTypes = D;
  using Real = typename D::Real;
  static_assert(D::spatial == 3 && !D::rigid, "Sinew: ConicalForceField is for points in space");
  static constexpr std::string_view className = "ConicalForceField";

  Eigen::Vector3d coneCenter{0, 0, 0}, coneHeight{0, 0, 1};
  double coneAngle = 10, stiffness = 500, damping = 5;

  static constexpr auto fields() {
    using F = ConicalForceField;
    return field_list(
        field("coneCenter", &F::coneCenter, "m", "apex of the cone"),
        field("coneHeight", &F::coneHeight, "m", "its axis, as long as the cone reaches from the apex"),
        field("coneAngle", &F::coneAngle, "degrees", "between its axis and its side", range::closed(0, 90)),
        field("stiffness", &F::stiffness, "N/m", "force per distance from the cone", range::nonNegative),
        field("damping",
              &F::damping,
              "N s/m",
              "force per speed along that distance, outside",
              range::nonNegative));
  }

  static constexpr ForceProperties properties() { return {.internal = false, .objective = false}; }

  using Driver = ElementDriver<ConePenalty, D>;
  Driver driver{};

  /// Throws Error where the cone has no height.
  void init(InitContext<D> const& context) {
    if (!(coneHeight.norm() > 0))
      throw Error(text(context.where, ": ", component_name<ConicalForceField>()),
                  "coneHeight is zero; give the axis of the cone, as long as it reaches from its apex");
    init_each_point(driver, context.rest.size(), {Real(stiffness), Real(damping)});
  }
  void followPoints(Renumbering const&, std::size_t points)
  requires(counts_points<Driver>)
  {
    driver.initPoints(points, {Real(stiffness), Real(damping)});
  }

  /// The cone as it stands now: it may move from step to step.
  template <class L>
  L law() const {
    using R = typename L::Real;
    L law;
    const Eigen::Vector3d axis = coneHeight.normalized();
    for (int c = 0; c < 3; ++c) law.apex[c] = R(Real(coneCenter[c])), law.axis[c] = R(Real(axis[c]));
    const double angle = coneAngle * std::numbers::pi / 180;
    law.height = R(Real(coneHeight.norm()));
    law.cosine = R(Real(std::cos(angle)));
    law.sine = R(Real(std::sin(angle)));
    return law;
  }
};

}  // namespace sinew
