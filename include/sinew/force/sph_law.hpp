// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/core/lanes.hpp>

#include <array>
#include <cmath>

namespace sinew {

/// What a particle has in the sums of SphLaw; numbers or lanes.
template <class T>
struct SphParticle {
  std::array<T, 3> velocity;
  T weight, density, pressure, volume;  // mass over that of the fluid's, rho, p / rho^2, m / rho
};

/// The sums over neighbours of SPHFluidForceField, with its formulas: for numbers, lanes and on a device.
/// A pair `p` is of one particle with one neighbour, or with as many as there are lanes: p.d = x_i - x_j, p.q
/// = |d| / radius, p.acts. `other` says what those have that SphParticle has, by functions of these names.
template <class Kernels, class Real>
struct SphLaw {
  Kernels kernels;
  Real mass, atRest, stiffness;                 // J/kg; 0: no pressure
  Real square, viscosity, bulk, soft, tension;  // m^2, mu, 2 mu h m, h^2/100, m times the tension
  bool viscous, artificial, coheres, curved;

  /// To the sum that `mass` times is a density.
  SINEW_ANY_SIDE
  template <class T, class Pairs, class Other>
  SINEW_INLINE void addDensity(Pairs const& p, Other const& other, T& sum) const {
    sum += select(p.acts, other.weight() * kernels.density(p.q), T(0));
  }
  SINEW_INLINE Real pressureOf(Real density) const {
    return stiffness * (density - atRest) / (density * density);
  }

  /// The forces of pairs.
  SINEW_ANY_SIDE
  template <class T, class Pairs, class Other>
  SINEW_INLINE void addForces(SphParticle<T> const& own, Pairs const& p, Other const& other,
                              std::array<T, 3>& sums) const {
    T pushes = -T(square) * (own.pressure + other.pressure());
    std::array<T, 3> slower;  // v_j - v_i
    for (std::size_t c = 0; c < 3; ++c) slower[c] = other.velocity(c) - own.velocity[c];
    if (artificial) {
      T apart(0);
      for (std::size_t c = 0; c < 3; ++c) apart -= slower[c] * p.d[c];
      pushes += select(apart < T(0), apart, T(0)) * T(bulk) /
                ((p.q * p.q + T(soft)) * (own.density + other.density()));
    }
    T along = pushes * kernels.pressureSlope(p.q);
    if (coheres) along += -T(tension) * kernels.density(p.q);
    along = select(p.acts, own.weight * other.weight() * along, T(0));
    for (std::size_t c = 0; c < 3; ++c) sums[c] += along * p.d[c];
    if (viscous) {
      const T rubs =
          select(p.acts, T(viscosity) * own.volume * other.volume() * kernels.viscosityLaplacian(p.q), T(0));
      for (std::size_t c = 0; c < 3; ++c) sums[c] += rubs * slower[c];
    }
  }

  /// n and c of the tension by the curvature.
  SINEW_ANY_SIDE
  template <class T, class Pairs, class Other>
  SINEW_INLINE void addCurvature(T const& ownVolume, Pairs const& p, Other const& other, std::array<T, 3>& n,
                                 T& c) const {
    const T more = select(p.acts, other.volume() - ownVolume, T(0));
    const T slope = more * kernels.densitySlope(p.q);
    for (std::size_t k = 0; k < 3; ++k) n[k] += slope * p.d[k];
    c += more * kernels.densityLaplacian(p.q);
  }
  /// -m tension c n / |n|
  SINEW_INLINE std::array<Real, 3> curvatureForce(std::array<Real, 3> n, Real c) const {
    using std::sqrt;
    const Real length = sqrt(n[0] * n[0] + n[1] * n[1] + n[2] * n[2]);
    const Real factor = length > Real(1e-6) ? -tension * c / length : Real(0);
    for (std::size_t k = 0; k < 3; ++k) n[k] *= factor;
    return n;
  }

  /// Of a particle, by its density [J].
  SINEW_INLINE double energy(Real density) const {
    using std::log;
    const double d = double(density) / double(atRest);
    return double(mass) * double(stiffness) * (log(d) + 1 / d - 1);
  }
};

}  // namespace sinew
