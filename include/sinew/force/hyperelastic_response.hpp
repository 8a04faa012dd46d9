// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/core/data_types.hpp>

#include <cmath>

namespace sinew {

// What energies of hyperelastic materials are made of: functions with two derivatives, which are there for
// every deformation, crushed and inverted ones too.

namespace detail {

/// f(a), lane by lane: for functions that have no instruction.
template <class Real, class F>
SINEW_INLINE Real each_lane(Real a, F&& f) {
  if constexpr (lane_traits<Real>::width == 1) {
    return f(a);
  } else {
    for (int l = 0; l < lane_traits<Real>::width; ++l) a.v[l] = f(a.v[l]);
    return a;
  }
}
template <class Real>
SINEW_INLINE Real log_of(Real a) {
  using std::log;
  return each_lane(a, [](auto s) { return log(s); });
}
template <class Real>
SINEW_INLINE Real exp_of(Real a) {
  using std::exp;
  return each_lane(a, [](auto s) { return exp(s); });
}

/// A function of one variable with its first two derivatives.
template <class Real>
struct Jet {
  Real f, d, dd;

  /// The Taylor polynomial from here at a distance.
  SINEW_INLINE Jet taylor(Real by) const { return {f + by * (d + Real(0.5) * by * dd), d + by * dd, dd}; }
  /// The same with a curvature that fades as (1 - by/width)^-3: a straight line far from here, where by < 0.
  SINEW_INLINE Jet fading(Real by, Real width) const {
    const Real t = Real(1) / (Real(1) - by / width), curvature = Real(0.5) * dd * width;
    return {f + by * (d - curvature) + curvature * width * (t - Real(1)),
            d + curvature * (t * t - Real(1)),
            dd * t * t * t};
  }
  SINEW_INLINE Jet square() const { return {f * f, Real(2) * f * d, Real(2) * (d * d + f * dd)}; }
};

/// e^y, continued above y = 50 by its Taylor polynomial of degree 2: no strain makes it overflow.
template <class Real>
SINEW_INLINE Jet<Real> exponential(Real y) {
  const Real held = select(y > Real(50), Real(50), y), e = exp_of(held);
  return Jet<Real>{e, e, e}.taylor(y - held);
}

/// Functions of a ratio, continued below `threshold`.
template <class Real>
struct Continued {
  Real width, ratio, by, log, inverse;

  SINEW_INLINE Continued(Real value, Real threshold)
      : width(threshold),
        ratio(select(value < threshold, threshold, value)),
        by(value - ratio),
        log(log_of(ratio)),
        inverse(Real(1) / ratio) {}
  /// ratio^e with e < 0
  SINEW_INLINE Jet<Real> power(lane_scalar<Real> e) const {
    const Real f = exp_of(Real(Real(e) * log)), d = Real(e) * f * inverse;
    return Jet<Real>{f, d, Real(e - 1) * d * inverse}.fading(by, width);
  }
  /// -a ln + b/2 ln^2
  SINEW_INLINE Jet<Real> barrier(Real a, Real b) const {
    return Jet<Real>{log * (Real(0.5) * b * log - a),
                     (b * log - a) * inverse,
                     (a + b * (Real(1) - log)) * inverse * inverse}
        .fading(by, width);
  }
  /// a (r ln r - r + 1)
  SINEW_INLINE Jet<Real> entropy(Real a) const {
    return Jet<Real>{a * (ratio * (log - Real(1)) + Real(1)), a * log, a * inverse}.fading(by, width);
  }
};

/// W(I1, I2, J) and its derivatives; those that no material has are left out.
template <class Real>
struct InvariantResponse {
  Real w{0}, w1{0}, w2{0}, wJ{0}, w11{0}, w1J{0}, w2J{0}, wJJ{0};

  /// A function of J.
  SINEW_INLINE void add(Jet<Real> const& u) { w += u.f, wJ += u.d, wJJ += u.dd; }
  /// phi(q(J) I1)
  SINEW_INLINE void add(Jet<Real> const& phi, Jet<Real> const& q, Real i1) {
    const Real slope = q.d * i1;
    w += phi.f, w1 += phi.d * q.f, wJ += phi.d * slope;
    w11 += phi.dd * q.f * q.f, w1J += phi.dd * q.f * slope + phi.d * q.d;
    wJJ += phi.dd * slope * slope + phi.d * q.dd * i1;
  }
};

}  // namespace detail

}  // namespace sinew
