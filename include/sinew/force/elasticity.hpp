// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/core/platform.hpp>

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

}  // namespace sinew
