// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/lagrangian/contact_potential.hpp>

#include <cmath>
#include <limits>

namespace sinew {

/// The t where the derivative of the convex function 1/2 t^2 curvature + t slope + l(t) vanishes: Newton's
/// method inside the interval in which it changes its sign. terms(t) are the derivatives of l, a
/// contact_potential::Slope; `looks` counts its calls behind the first.
template <class Terms>
SINEW_HD double exact_line_search(double slope, double curvature, Terms&& terms, int& looks) {
  const double first = std::abs(slope + terms(0.0).first);
  double low = 0, high = std::numeric_limits<double>::infinity(), t = 1;
  for (int i = 0; i < 50; ++i) {
    ++looks;
    const contact_potential::Slope of = terms(t);
    const double at = slope + t * curvature + of.first;
    if (!(std::abs(at) > 1e-3 * first)) break;
    (at < 0 ? low : high) = t;
    double next = t - at / (curvature + of.second);
    if (!(next > low && next < high)) next = std::isinf(high) ? 2 * low : (low + high) / 2;
    if (next == t) break;
    t = next;
  }
  return t;
}

}  // namespace sinew
