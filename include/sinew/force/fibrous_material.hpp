// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/force/hyperelastic_response.hpp>

#include <cstddef>
#include <limits>

namespace sinew {

// Materials with directions. Their energy is a sum of functions of J = det F and of measures K of C = F'F, in
// the axes of the element; the derivative of a measure is a matrix of directions T:
//   dK = T : dC = 2 (F T) : dF

/// A measure of the strain with its derivative T by C, and, where T changes with C, its coefficients b,
/// dT_ij = b_ij dC_ij / 2 [K, b without unit].
template <class Real>
struct DirectedStrain {
  Real k;
  Mat<Real, 3> t;
  bool curved = false;
  Mat<Real, 3> b;
};

/// The one measure is K = Q = sum b_ij E_ij^2, E = (C - I)/2, and T_ij = b_ij E_ij.
struct Costa {
  template <class Real, class P>
  SINEW_INLINE static DirectedStrain<Real> strain(P const& p, Mat<Real, 3> const& c) {
    DirectedStrain<Real> out;
    out.k = Real(0);
    out.curved = true;
    constexpr int number[3][3] = {{2, 3, 5}, {3, 4, 6}, {5, 6, 7}};  // of a coefficient among the parameters
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j) {
        const Real e = Real(0.5) * (i == j ? Real(c(i, j) - Real(1)) : c(i, j));
        out.b(i, j) = Real(p[std::size_t(number[i][j])]);
        out.t(i, j) = out.b(i, j) * e;
        out.k += out.t(i, j) * e;
      }
    return out;
  }
  template <class Real, class P>
  SINEW_INLINE static detail::InvariantResponse<Real> at(P const& p, Real q, Real j, Real threshold) {
    const detail::Continued<Real> volume(j, threshold);
    const auto power = volume.power(lane_scalar<Real>(-4) / 3);
    const auto e = detail::exponential(Real(power.f * q));
    const Real half = Real(0.5) * Real(p[0]);
    detail::InvariantResponse<Real> r;
    r.add({half * (e.f - Real(1)), half * e.d, half * e.dd}, power, q);
    r.add(volume.entropy(Real(p[1])));
    return r;
  }
};

/// Its measures are I1, and for each family of fibres K = H : C with the structure tensor H = kappa I +
/// (1 - 3 kappa) a a', of which the trace is 1; T is I, or H.
struct HolzapfelGasserOgden {
  template <class Real, class P, class A>
  SINEW_INLINE static DirectedStrain<Real> strain(P const& p, A const& along, int m, Mat<Real, 3> const& c) {
    DirectedStrain<Real> out;
    using Scalar = lane_scalar<Real>;
    const bool fibres = m > 0;
    const Scalar even = fibres ? Scalar(p[4]) : Scalar(1), share = fibres ? Scalar(1 - 3 * p[4]) : Scalar(0);
    auto const* const a = along.data() + (fibres ? 3 * (m - 1) : 0);
    out.k = Real(0);
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j) {
        out.t(i, j) = Real((i == j ? even : Scalar(0)) + share * a[i] * a[j]);
        out.k += out.t(i, j) * c(i, j);
      }
    return out;
  }
  template <class Real, class P>
  SINEW_INLINE static detail::InvariantResponse<Real> at(P const& p, int m, Real k, Real j, Real threshold) {
    const detail::Continued<Real> volume(j, threshold);
    const auto power = volume.power(lane_scalar<Real>(-2) / 3);
    detail::InvariantResponse<Real> r;
    if (m == 0) {
      const Real half = Real(0.5) * Real(p[0]);
      r.add({half * (power.f * k - Real(3)), half, Real(0)}, power, k);
      r.add(volume.barrier(Real(0), Real(p[1])));
      return r;
    }
    // at rest, where rounding would decide, the tangent is that of tension
    const Real k1(p[2]), k2(p[3]), strain = power.f * k - Real(1);
    const auto slack = strain < Real(-64 * std::numeric_limits<lane_scalar<Real>>::epsilon());
    const Real e = select(strain < Real(0), Real(0), strain);
    const auto g = detail::exponential(Real(k2 * e * e));
    r.add({k1 * (g.f - Real(1)) / (Real(2) * k2),
           k1 * e * g.d,
           select(slack, Real(0), Real(k1 * (g.d + Real(2) * k2 * e * e * g.dd)))},
          power,
          k);
    return r;
  }
};

}  // namespace sinew
