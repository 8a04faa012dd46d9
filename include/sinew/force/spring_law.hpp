// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/core/data_types.hpp>

#include <limits>

namespace sinew {

/// Linear spring with damping between two points.
///   E = k/2 (l - L)^2,  l = |d|,  d = x1 - x0                                          [J]
///   f0 = -f1 = F u,  F = k (l - L) + c d'.u,  u = d/l                                  [N]
///   df0/dx1 = F/l (I - u u') + k u u',  df0/dv1 = c u u'
/// The change of the damping force with u is left out of the tangent, which keeps it symmetric. Two points in
/// one place have no direction, and no force. A negative length -L stands for a string of length L: while it
/// is shorter than that it acts as if it were not there, its damping included.
template <class D>
struct SpringLaw {
  using Real = typename D::Real;
  using Coord = typename D::Coord;
  using Deriv = typename D::Deriv;
  static constexpr int arity = 2;
  static constexpr bool usesVelocity = true, oneByOne = true, symmetricBlocks = true;

  struct Rest {
    Real stiffness, damping, length;
  };
  struct Tangent {
    Deriv direction;
    Real tension;  // F/l
  };

  SINEW_HD Real energy(Rest const& rest, Coord const (&x)[2]) const {
    using std::sqrt, sinew::sqrt;
    const Real length = sqrt((x[1] - x[0]).squaredNorm());
    const Real stretch = select(length > -rest.length, length - unstretched(rest), Real(0));
    return Real(0.5) * rest.stiffness * stretch * stretch;
  }

  SINEW_HD void force(Rest const& rest, Coord const (&x)[2], Deriv const (&v)[2], Deriv (&f)[2],
                      Tangent& tangent) const {
    using std::sqrt, sinew::sqrt;
    const Deriv d = x[1] - x[0];
    const Real length = sqrt(d.squaredNorm()), natural = unstretched(rest);
    // of a string its length; of others next to nothing
    const Real threshold = (natural - rest.length) * Real(0.5) + natural * Real(1e-9) +
                           Real(std::numeric_limits<lane_scalar<Real>>::min());
    const Real inverse = select(length > threshold, Real(1) / length, Real(0));
    tangent.direction = d * inverse;
    const Real force =
        rest.stiffness * (length - natural) + rest.damping * (v[1] - v[0]).dot(tangent.direction);
    tangent.tension = force * inverse;
    f[0] = tangent.direction * force;
    f[1] = -f[0];
  }

  SINEW_HD void dforce(Rest const& rest, Tangent const& tangent, Deriv const (&dx)[2], Deriv (&df)[2], Real k,
                       Real b) const {
    const Deriv d = dx[1] - dx[0];
    const Real along = d.dot(tangent.direction);
    df[0] = d * (k * tangent.tension) + tangent.direction * (axial(rest, tangent, k, b) * along);
    df[1] = -df[0];
  }

  SINEW_INLINE Mat<Real, D::size> block(Rest const& rest, Tangent const& tangent, int i, int j, Real k,
                                        Real b) const {
    const Real sign(i == j ? -1 : 1);
    const Real diagonal = sign * k * tangent.tension, axis = sign * axial(rest, tangent, k, b);
    Mat<Real, D::size> block;
    for (int c = 0; c < D::size; ++c)
      for (int r = 0; r < D::size; ++r) {
        block(r, c) = axis * tangent.direction[r] * tangent.direction[c];
        if (r == c) block(r, c) += diagonal;
      }
    return block;
  }

 private:
  SINEW_INLINE static Real unstretched(Rest const& rest) {
    return select(rest.length < Real(0), -rest.length, rest.length);
  }
  SINEW_INLINE static Real axial(Rest const& rest, Tangent const& tangent, Real k, Real b) {
    return k * (rest.stiffness - tangent.tension) + b * rest.damping;
  }
};

}  // namespace sinew
