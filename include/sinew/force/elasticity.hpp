// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/core/data_types.hpp>

namespace sinew {

/// Of an isotropic linear material: stress = 2 mu e + lambda tr(e) I                                [Pa]
struct LameModuli {
  double lambda, mu;
};

/// mu = E/(2 (1 + nu))
constexpr double shear_modulus(double youngModulus, double poissonRatio) {
  return youngModulus / (2 * (1 + poissonRatio));
}
/// lambda = E nu/((1 + nu)(1 - 2 nu))
constexpr LameModuli lame_moduli(double youngModulus, double poissonRatio) {
  const double E = youngModulus, nu = poissonRatio;
  return {E * nu / ((1 + nu) * (1 - 2 * nu)), shear_modulus(E, nu)};
}
/// The same of a sheet that is free across its plane (plane stress): lambda = E nu/(1 - nu^2)
constexpr LameModuli plane_stress_moduli(double youngModulus, double poissonRatio) {
  const double E = youngModulus, nu = poissonRatio;
  return {E * nu / (1 - nu * nu), shear_modulus(E, nu)};
}

/// e = sym(F) - one I, of a deformation gradient (one = 1) or of a gradient of displacements (one = 0), for
/// scalars and lanes.
template <class Real>
SINEW_INLINE Mat<Real, 3> small_strain(Mat<Real, 3> const& f, Real one) {
  Mat<Real, 3> e;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j <= i; ++j) e(i, j) = e(j, i) = i == j ? f(i, i) - one : Real(0.5) * (f(i, j) + f(j, i));
  return e;
}

/// What the law of an element needs of an isotropic linear material, for scalars and lanes.
template <class Real>
struct IsotropicMaterial {
  using Mat3 = Mat<Real, 3>;
  Real mu, lambda;  // [Pa]

  /// mu e:e + lambda/2 tr(e)^2                                                                   [J/m^3]
  SINEW_INLINE Real energy(Mat3 const& e) const {
    const Real trace = e(0, 0) + e(1, 1) + e(2, 2);
    Real square(0);
    for (int i = 0; i < 9; ++i) square += e(i) * e(i);
    return mu * square + Real(0.5) * lambda * trace * trace;
  }
  /// factor (2 mu e + lambda tr(e) I)
  SINEW_INLINE Mat3 stress(Mat3 const& e, Real factor) const {
    const Real mu2 = Real(2) * mu * factor, pressure = lambda * factor * (e(0, 0) + e(1, 1) + e(2, 2));
    Mat3 s;
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j <= i; ++j) s(i, j) = s(j, i) = i == j ? mu2 * e(i, i) + pressure : mu2 * e(i, j);
    return s;
  }
  /// factor (lambda m + mu m' + mu tr(m) I): how two points hold each other whose shape functions have the
  /// gradients h_i and h_j, with m the integral of h_i h_j'
  SINEW_INLINE Mat3 stiffness(Mat3 const& m, Real factor) const {
    const Real trace = mu * (m(0, 0) + m(1, 1) + m(2, 2));
    Mat3 s;
    for (int c = 0; c < 3; ++c)
      for (int r = 0; r < 3; ++r) {
        s(r, c) = factor * (lambda * m(r, c) + mu * m(c, r));
        if (r == c) s(r, c) += factor * trace;
      }
    return s;
  }
};

}  // namespace sinew
