// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/core/lanes.hpp>

#include <numbers>

namespace sinew {

// Kernels of smoothed particle hydrodynamics in space, of the support h: functions of q = r / h below 1, for
// numbers and lanes. A kernel W [1/m^3] has the integral 1; `slope` is g [1/m^5] of its gradient, grad W = g
// (x_i - x_j).

/// One of Mueller, Charypar, Gross (2003) for each quantity: that of densities is smooth at r = 0, that of
/// pressures is steepest there, and that of viscosity has a Laplacian that is positive everywhere.
template <class Real>
class MuellerKernels {
 public:
  static constexpr bool conservative = false;  // densities and pressures have other kernels

  explicit MuellerKernels(Real h)
      : density_(315 / (64 * std::numbers::pi_v<Real> * h * h * h)),
        pressure_(15 / (std::numbers::pi_v<Real> * h * h * h)),
        viscosity_(15 / (2 * std::numbers::pi_v<Real> * h * h * h)),
        perSquare_(1 / (h * h)) {}

  /// (1 - q^2)^3
  template <class T>
  SINEW_INLINE T density(T q) const {
    const T a = T(1) - q * q;
    return T(density_) * a * a * a;
  }
  template <class T>
  SINEW_INLINE T densitySlope(T q) const {
    const T a = T(1) - q * q;
    return T(-6 * density_ * perSquare_) * a * a;
  }
  template <class T>
  SINEW_INLINE T densityLaplacian(T q) const {
    return T(-6 * density_ * perSquare_) * (T(1) - q * q) * (T(3) - T(7) * q * q);
  }
  /// Of (1 - q)^3.
  template <class T>
  SINEW_INLINE T pressureSlope(T q) const {
    const T a = T(1) - q;
    return T(-3 * pressure_ * perSquare_) * a * a / q;
  }
  /// Of -q^3/2 + q^2 + 1/(2 q) - 1.
  template <class T>
  SINEW_INLINE T viscosityLaplacian(T q) const {
    return T(6 * viscosity_ * perSquare_) * (T(1) - q);
  }

 private:
  Real density_, pressure_, viscosity_, perSquare_;
};

/// The cubic spline (Monaghan 1992) for all quantities: 1/6 - q^2 + q^3 below 1/2, (1 - q)^3 / 3 above.
template <class Real>
class CubicKernels {
 public:
  static constexpr bool conservative = true;

  explicit CubicKernels(Real h)
      : factor_(48 / (std::numbers::pi_v<Real> * h * h * h)), perSquare_(factor_ / (h * h)) {}

  template <class T>
  SINEW_INLINE T density(T q) const {
    const T a = T(1) - q;
    return T(factor_) * select(q < T(Real(0.5)), T(Real(1) / 6) - q * q * a, a * a * a * T(Real(1) / 3));
  }
  template <class T>
  SINEW_INLINE T densitySlope(T q) const {
    const T a = T(1) - q;
    return T(perSquare_) * select(q < T(Real(0.5)), T(3) * q - T(2), -a * a / q);
  }
  template <class T>
  SINEW_INLINE T densityLaplacian(T q) const {
    return T(perSquare_) * select(q < T(Real(0.5)), T(12) * q - T(6), T(6) - T(4) * q - T(2) / q);
  }
  template <class T>
  SINEW_INLINE T pressureSlope(T q) const {
    return densitySlope(q);
  }
  template <class T>
  SINEW_INLINE T viscosityLaplacian(T q) const {
    return densityLaplacian(q);
  }

 private:
  Real factor_, perSquare_;
};

/// The kernel of Wendland (1995) of class C2, (1 - q)^4 (1 + 4 q): its Fourier transform is positive, so that
/// particles do not pair (Dehnen, Aly 2012).
template <class Real>
class WendlandKernel {
 public:
  /// `factor` times the kernel whose integral is 1.
  explicit WendlandKernel(Real h, Real factor = 1)
      : factor_(factor * 21 / (2 * std::numbers::pi_v<Real> * h * h * h)),
        perSquare_(-20 * factor_ / (h * h)) {}

  template <class T>
  SINEW_INLINE T density(T q) const {
    const T a = (T(1) - q) * (T(1) - q);
    return T(factor_) * a * a * (T(1) + T(4) * q);
  }
  template <class T>
  SINEW_INLINE T densitySlope(T q) const {
    const T a = T(1) - q;
    return T(perSquare_) * a * a * a;
  }

 private:
  Real factor_, perSquare_;
};

}  // namespace sinew
