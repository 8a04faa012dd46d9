// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/core/data_types.hpp>
#include <sinew/core/lanes.hpp>

#include <cmath>
#include <limits>

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

}  // namespace sinew
