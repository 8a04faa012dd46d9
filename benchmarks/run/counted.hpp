// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <Eigen/Core>
#include <cmath>
#include <limits>
#include <type_traits>

namespace bench {

/// A number that counts the arithmetic done with numbers of its kind: the scalar of an element law whose
/// operations are wanted. Each of + - * / and each square root, logarithm and exponential is one;
/// comparisons, signs and copies are none.
struct Counted {
  double value;
  static inline long operations = 0;

  Counted() = default;
  template <class S>
  requires std::is_arithmetic_v<S>
  Counted(S s) : value(double(s)) {}

  static Counted after(double v) {
    ++operations;
    return Counted(v);
  }
  friend Counted operator+(Counted a, Counted b) { return after(a.value + b.value); }
  friend Counted operator-(Counted a, Counted b) { return after(a.value - b.value); }
  friend Counted operator*(Counted a, Counted b) { return after(a.value * b.value); }
  friend Counted operator/(Counted a, Counted b) { return after(a.value / b.value); }
  friend Counted operator-(Counted a) { return Counted(-a.value); }
  Counted& operator+=(Counted b) { return *this = *this + b; }
  Counted& operator-=(Counted b) { return *this = *this - b; }
  Counted& operator*=(Counted b) { return *this = *this * b; }
  Counted& operator/=(Counted b) { return *this = *this / b; }
  friend bool operator<(Counted a, Counted b) { return a.value < b.value; }
  friend bool operator>(Counted a, Counted b) { return a.value > b.value; }
  friend bool operator==(Counted a, Counted b) { return a.value == b.value; }
  friend bool operator!=(Counted a, Counted b) { return a.value != b.value; }
  friend Counted sqrt(Counted a) { return after(std::sqrt(a.value)); }
  friend Counted log(Counted a) { return after(std::log(a.value)); }
  friend Counted exp(Counted a) { return after(std::exp(a.value)); }
  friend Counted abs(Counted a) { return Counted(std::abs(a.value)); }
  friend Counted select(bool mask, Counted a, Counted b) { return mask ? a : b; }
  explicit operator double() const { return value; }
};

/// Operations of f().
template <class F>
double operations_of(F&& f) {
  Counted::operations = 0;
  f();
  return double(Counted::operations);
}

}  // namespace bench

template <>
struct std::numeric_limits<bench::Counted> : std::numeric_limits<double> {};

template <>
struct Eigen::NumTraits<bench::Counted> : Eigen::NumTraits<double> {
  using Real = bench::Counted;
  using NonInteger = Real;
  using Nested = Real;
  using Literal = Real;
};
