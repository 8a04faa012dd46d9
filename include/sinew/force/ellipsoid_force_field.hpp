// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/core/component.hpp>
#include <sinew/core/element_driver.hpp>

#include <limits>
#include <vector>

namespace sinew {

/// Penalty force of an ellipsoid on a point inside it, or, with a negative stiffness, outside. With d from
/// the centre, r the radii, and what is a distance close to the surface,
///   n = sqrt(sum_c d_c^2/r_c^2),   g_c = d_c/r_c^2,   h = (1 - n)/|g|
///   f = |k| h g - c |1 - n| v                                                                     [N]
///   df/dx = |k| (h G - g g'/(n |g|) - h (g (G g)' + (G g) g')/(2 |g|^2)),   G = diag(1/r_c^2)
/// The last term is the symmetric part of what the length of g adds. The change of the damping with the depth
/// is left out. The force has an energy where the radii are alike, |k|/2 (1 - n)^2 r.
template <class D>
struct EllipsoidPenalty {
  using Real = typename D::Real;
  using Coord = typename D::Coord;
  using Deriv = typename D::Deriv;
  static constexpr int arity = 1;
  static constexpr bool usesVelocity = true;

  Vec<Real, D::size> center = Vec<Real, D::size>::Zero(), inverse = Vec<Real, D::size>::Ones();  // 1/r^2
  Real stiffness{500}, damping{5};                                                               // |k|, c
  bool outside = false;

  struct Rest {
    Real factor;  // 1
  };
  struct Tangent {
    Mat<Real, D::size> slope;  // df/dx
    Real damping;              // c |1 - n|
  };

  SINEW_HD Real energy(Rest const&, Coord const (&x)[1]) const {
    Shape s;
    look(x[0], s);
    return select(touches(s), Real(0.5) * stiffness * s.part * s.part * s.norm / s.slope, Real(0));
  }
  SINEW_HD void force(Rest const&, Coord const (&x)[1], Deriv const (&v)[1], Deriv (&f)[1],
                      Tangent& t) const {
    Shape s;
    look(x[0], s);
    const Real zero(0), k = select(touches(s), stiffness, zero), h = s.part / s.slope;
    const auto away = s.part < zero;
    t.damping = select(touches(s), damping * select(away, -s.part, s.part), zero);
    for (int c = 0; c < D::size; ++c) f[0][c] = k * h * s.gradient[c] - t.damping * v[0][c];
    for (int c = 0; c < D::size; ++c)
      for (int r = 0; r < D::size; ++r) {
        const Real both = s.gradient[r] * s.gradient[c];
        t.slope(r, c) =
            -k * both * (Real(1) / (s.norm * s.slope) + Real(0.5) * h * (inverse[r] + inverse[c]) / s.slope2);
        if (r == c) t.slope(r, c) += k * h * inverse[r];
      }
  }
  SINEW_HD void dforce(Rest const&, Tangent const& t, Deriv const (&dx)[1], Deriv (&df)[1], Real k,
                       Real b) const {
    for (int r = 0; r < D::size; ++r) {
      df[0][r] = -b * t.damping * dx[0][r];
      for (int c = 0; c < D::size; ++c) df[0][r] += k * t.slope(r, c) * dx[0][c];
    }
  }
  SINEW_INLINE Mat<Real, D::size> block(Rest const&, Tangent const& t, int, int, Real k, Real b) const {
    Mat<Real, D::size> block;
    for (int c = 0; c < D::size; ++c)
      for (int r = 0; r < D::size; ++r) {
        block(r, c) = k * t.slope(r, c);
        if (r == c) block(r, c) -= b * t.damping;
      }
    return block;
  }

 private:
  struct Shape {
    Real norm, part, slope, slope2;  // n, 1 - n, |g|, |g|^2
    Real gradient[D::size];
  };
  // a point in the centre has no direction, and no force but damping
  SINEW_INLINE void look(Coord const& x, Shape& s) const {
    using std::sqrt, sinew::sqrt;
    const Real least(std::numeric_limits<lane_scalar<Real>>::min());
    Real square = least;
    s.slope2 = least;
    for (int c = 0; c < D::size; ++c) {
      const Real d = x[c] - center[c];
      s.gradient[c] = d * inverse[c];
      square += d * s.gradient[c];
      s.slope2 += s.gradient[c] * s.gradient[c];
    }
    s.norm = sqrt(square);
    s.part = Real(1) - s.norm;
    s.slope = sqrt(s.slope2);
  }
  SINEW_INLINE auto touches(Shape const& s) const {
    auto acts = s.part > Real(0);
    if (outside) acts = s.part < Real(0);
    return acts;
  }
};

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

  void init(InitContext<D> const& context) {
    std::vector<typename Driver::Indices> points(context.rest.size());
    for (std::size_t i = 0; i < points.size(); ++i) points[i] = {int(i)};
    driver.init(points, std::vector<typename Driver::Rest>(points.size(), {Real(1)}));
  }
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
