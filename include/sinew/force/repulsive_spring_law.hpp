// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/force/spring_law.hpp>

namespace sinew {

/// The spring of SpringLaw while it is shorter than without force; else there is none, its damping included.
///   E = k/2 min(0, l - L)^2                                                              [J]
template <class D>
struct RepulsiveSpringLaw : SpringLaw<D> {
  using typename SpringLaw<D>::Real;
  using typename SpringLaw<D>::Coord;
  using typename SpringLaw<D>::Deriv;
  using typename SpringLaw<D>::Rest;
  using typename SpringLaw<D>::Tangent;

  SINEW_HD Real energy(Rest const& rest, Coord const (&x)[2]) const {
    using std::sqrt, sinew::sqrt;
    const Real length = sqrt((x[1] - x[0]).squaredNorm());
    const Real stretch = select(length < rest.length, length - rest.length, Real(0));
    return Real(0.5) * rest.stiffness * stretch * stretch;
  }

  SINEW_HD void force(Rest const& rest, Coord const (&x)[2], Deriv const (&v)[2], Deriv (&f)[2],
                      Tangent& tangent) const {
    using std::sqrt, sinew::sqrt;
    const Deriv d = x[1] - x[0];
    const Real length = sqrt(d.squaredNorm());
    const Real threshold = rest.length * Real(1e-9) + Real(std::numeric_limits<lane_scalar<Real>>::min());
    const Real inverse =
        select(length < rest.length, select(length > threshold, Real(1) / length, Real(0)), Real(0));
    tangent.direction = d * inverse;
    const Real force =
        rest.stiffness * (length - rest.length) + rest.damping * (v[1] - v[0]).dot(tangent.direction);
    tangent.tension = force * inverse;
    f[0] = tangent.direction * force;
    f[1] = -f[0];
  }
};

}  // namespace sinew
