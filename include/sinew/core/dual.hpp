// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/core/lanes.hpp>

namespace sinew {

/// A value with its derivatives in N directions (Clifford's dual numbers): the scalar of a function whose
/// tangent is wanted as exactly as the function is. T is a scalar, or lanes of them.
template <class T, int N>
struct Dual {
  T value;
  T slope[std::size_t(N)];

  Dual() = default;
  SINEW_INLINE Dual(T v) : value(v) {
    for (int i = 0; i < N; ++i) slope[i] = T(0);
  }
  template <class S>
  requires(std::is_arithmetic_v<S> && !std::is_same_v<S, T>)
  SINEW_INLINE Dual(S s) : Dual(T(s)) {}

  /// g(value), where g' is known.
  SINEW_INLINE Dual through(T g, T derivative) const {
    Dual r(g);
    for (int i = 0; i < N; ++i) r.slope[i] = derivative * slope[i];
    return r;
  }

  SINEW_INLINE friend Dual operator+(Dual const& a, Dual const& b) {
    Dual r(a.value + b.value);
    for (int i = 0; i < N; ++i) r.slope[i] = a.slope[i] + b.slope[i];
    return r;
  }
  SINEW_INLINE friend Dual operator-(Dual const& a, Dual const& b) {
    Dual r(a.value - b.value);
    for (int i = 0; i < N; ++i) r.slope[i] = a.slope[i] - b.slope[i];
    return r;
  }
  SINEW_INLINE friend Dual operator*(Dual const& a, Dual const& b) {
    Dual r(a.value * b.value);
    for (int i = 0; i < N; ++i) r.slope[i] = a.slope[i] * b.value + a.value * b.slope[i];
    return r;
  }
  SINEW_INLINE friend Dual operator*(T a, Dual const& b) {
    Dual r(a * b.value);
    for (int i = 0; i < N; ++i) r.slope[i] = a * b.slope[i];
    return r;
  }
  SINEW_INLINE friend Dual operator/(Dual const& a, Dual const& b) {
    const T inverse = T(1) / b.value;
    Dual r(a.value * inverse);
    for (int i = 0; i < N; ++i) r.slope[i] = (a.slope[i] - r.value * b.slope[i]) * inverse;
    return r;
  }
  SINEW_INLINE friend Dual operator-(Dual const& a) {
    Dual r(-a.value);
    for (int i = 0; i < N; ++i) r.slope[i] = -a.slope[i];
    return r;
  }
  SINEW_INLINE Dual& operator+=(Dual const& b) { return *this = *this + b; }
  SINEW_INLINE Dual& operator-=(Dual const& b) { return *this = *this - b; }
  SINEW_INLINE Dual& operator*=(Dual const& b) { return *this = *this * b; }
};

template <class T, int N>
SINEW_INLINE Dual<T, N> sqrt(Dual<T, N> const& a) {
  using std::sqrt, sinew::sqrt;
  const T root = sqrt(a.value);
  return a.through(root, T(0.5) / root);
}
template <class Mask, class T, int N>
SINEW_INLINE Dual<T, N> select(Mask const& mask, Dual<T, N> const& a, Dual<T, N> const& b) {
  Dual<T, N> r(select(mask, a.value, b.value));
  for (int i = 0; i < N; ++i) r.slope[i] = select(mask, a.slope[i], b.slope[i]);
  return r;
}

/// The value of a dual number, or of what is none.
template <class T>
SINEW_INLINE T const& value_of(T const& a) {
  return a;
}
template <class T, int N>
SINEW_INLINE T const& value_of(Dual<T, N> const& a) {
  return a.value;
}

template <class T, int N>
struct lane_traits<Dual<T, N>> : lane_traits<T> {};

}  // namespace sinew

template <class T, int N>
struct Eigen::NumTraits<sinew::Dual<T, N>> : Eigen::NumTraits<sinew::lane_scalar<T>> {
  using Real = sinew::Dual<T, N>;
  using NonInteger = Real;
  using Nested = Real;
  using Literal = sinew::lane_scalar<T>;
  enum { RequireInitialization = 0 };
};
