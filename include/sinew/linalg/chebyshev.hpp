// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/core/platform.hpp>

#include <span>

namespace sinew {

/// Coefficients of the smoother
///   d_k = turn(k) d_{k-1} + gain(k) r_{k-1} / bound,  x_k = x_{k-1} + d_k,  r_k = r_{k-1} - A d_k,  k =
///   1, 2...
/// for a matrix with eigenvalues up to `bound`: Chebyshev polynomials of the fourth kind, which make |r| in a
/// multigrid cycle smallest of all that know this one number (Lottes, Optimal polynomial smoothers for
/// multigrid V-cycles, Numer. Linear Algebra Appl. 2023, algorithm 2 with beta = 1).
struct ChebyshevSmoother {
  SINEW_HD static float turn(int k) { return float(2 * k - 3) / float(2 * k + 1); }
  SINEW_HD static float gain(int k) { return float(8 * k - 4) / float(2 * k + 1); }
};

/// The largest eigenvalue of the symmetric tridiagonal matrix of n rows with this diagonal and these entries
/// beside it, by bisection with the sequence of Sturm (Golub, Van Loan 2013, 8.4.1), to seven digits.
SINEW_HD inline double largest_eigenvalue(double const* diagonal, double const* beside, int n) {
  auto size = [](double x) { return x < 0 ? -x : x; };
  // by the circles of Gershgorin
  double low = diagonal[0], high = diagonal[0];
  for (int i = 0; i < n; ++i) {
    const double radius = (i > 0 ? size(beside[i - 1]) : 0) + (i + 1 < n ? size(beside[i]) : 0);
    if (diagonal[i] > low) low = diagonal[i];
    if (diagonal[i] + radius > high) high = diagonal[i] + radius;
  }
  auto above = [&](double x) {  // whether x is above all eigenvalues: all pivots of T - x I are negative
    double pivot = diagonal[0] - x;
    for (int i = 1; i < n && pivot < 0; ++i) pivot = diagonal[i] - x - beside[i - 1] * beside[i - 1] / pivot;
    return pivot < 0;
  };
  for (int i = 0; i < 60 && high - low > 1e-7 * size(high); ++i) {
    const double middle = 0.5 * (low + high);
    (above(middle) ? high : low) = middle;
  }
  return high;
}
inline double largest_eigenvalue(std::span<double const> diagonal, std::span<double const> beside) {
  return largest_eigenvalue(diagonal.data(), beside.data(), int(diagonal.size()));
}

}  // namespace sinew
