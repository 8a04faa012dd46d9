// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <algorithm>
#include <cmath>
#include <numbers>

namespace elastica {

// The elastica: a slender cantilever under a dead load P at its tip, a = P L^2 / EI (Bisshopp & Drucker
// 1945). With the tip angle f, k^2 = (1 + sin f)/2, sin(t) = 1/(k sqrt 2):
//   sqrt a = K(k) - F(t, k),   deflection = 1 - 2 (E(k) - E(t, k)) / sqrt a,   reach = sqrt(2 sin f / a)
struct Tip {
  double deflection, reach, angle;  // lengths against L
};

// Simpson's rule for the elliptic integrals from t to pi/2, whose integrands are smooth
inline double elliptic(double k, double t, double power) {
  const int n = 2000;
  double sum = 0;
  for (int i = 0; i <= n; ++i) {
    const double s = k * std::sin(t + (std::numbers::pi / 2 - t) * i / n);
    sum += (i == 0 || i == n ? 1 : i % 2 ? 4 : 2) * std::pow(1 - s * s, power);
  }
  return sum * (std::numbers::pi / 2 - t) / n / 3;
}
inline Tip tip(double a) {
  double low = 0, high = std::numbers::pi / 2;
  auto modulus = [](double f) { return std::sqrt((1 + std::sin(f)) / 2); };
  auto start = [&](double f) { return std::asin(std::min(1.0, 1 / (modulus(f) * std::sqrt(2.0)))); };
  for (int i = 0; i < 60; ++i) {
    const double f = (low + high) / 2;
    (elliptic(modulus(f), start(f), -0.5) < std::sqrt(a) ? low : high) = f;
  }
  return {
      1 - 2 * elliptic(modulus(low), start(low), 0.5) / std::sqrt(a), std::sqrt(2 * std::sin(low) / a), low};
}

}  // namespace elastica
