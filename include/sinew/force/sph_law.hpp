// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/core/lanes.hpp>

#include <array>
#include <cmath>
#include <numbers>

namespace sinew {

/// What a particle has in the sums of SphLaw; numbers or lanes.
template <class T>
struct SphParticle {
  std::array<T, 3> velocity;
  T weight, density, pressure, volume;  // mass over that of the fluid's, rho, p / rho^2, m / rho
  T fluid = T(1);                       // 0: of a boundary
  std::array<T, 3> normal{T(0), T(0), T(0)};
};

/// The surface tension of Akinci, Akinci, Teschner (2013) between particles of the volume V at rest: cohesion
/// and the differences of normals n_i = h sum_j (m / rho_j) grad W_ij,
///   f_ij = -2 rho_0 / (rho_i + rho_j) c V^2 (s(q) e + (n_i - n_j) / 20),   s = 2 g - 1 below q = 1/2, else
///   g, g(q) = 64 q^3 (1 - q)^3,   c = 8 tension / (pi h^5 int s q^4 dq),
/// and the adhesion to boundaries, -c' V V_k (4 (6 q - 4 q^2 - 2))^(1/4) e from q = 1/2 on. The factor c is
/// such that what pairs pull across a plane in a fluid with a sharp surface is the tension (Fowler 1937); in
/// the paper it depends on units, and 1/20 is its share of normals for water at distances of h / 2.
template <class Real>
struct SphTension {
  static constexpr double momentOfCohesion = 21. / 440;  // int s q^4 dq
  Real cohesion{0}, adhesion{0};                         // c V^2, c' V^2 [N]
  Real radius{1}, atRest{1};

  /// Of a tension and an adhesion [N/m], and the volume of a particle.
  static SphTension of(double tension, double adhesion, double radius, double volume, double density) {
    const double h5 = radius * radius * radius * radius * radius;
    const double unit = 8 / (std::numbers::pi * h5 * momentOfCohesion) * volume * volume;
    return {Real(tension * unit), Real(adhesion * unit), Real(radius), Real(density)};
  }

  /// f_ij = along (x_i - x_j) + apart (n_i - n_j)
  template <class T>
  struct Pull {
    T along, apart;
  };
  SINEW_ANY_SIDE
  template <class T>
  SINEW_INLINE Pull<T> pull(T q, T densities, T ownFluid, T otherFluid) const {
    using std::sqrt, sinew::sqrt;
    const T g = T(64) * q * q * q * (T(1) - q) * (T(1) - q) * (T(1) - q), half(Real(0.5));
    const T both = ownFluid * otherFluid, one = ownFluid + otherFluid - T(2) * both;
    const T strength = T(cohesion) * T(2 * atRest) / densities * both;
    const T rise = select(q > half, T(4) * (T(6) * q - T(4) * q * q - T(2)), T(0));
    const T holds = T(adhesion) * one * sqrt(sqrt(select(rise > T(0), rise, T(0))));
    const T along = -(strength * select(q < half, T(2) * g - T(1), g) + holds) / (q * T(radius));
    return {along, T(Real(-0.05)) * strength};
  }
};

/// The sums over neighbours of SPHFluidForceField, with its formulas: for numbers, lanes and on a device.
/// A pair `p` is of one particle with one neighbour, or with as many as there are lanes: p.d = x_i - x_j, p.q
/// = |d| / radius, p.acts. `other` says what those have that SphParticle has, by functions of these names.
template <class Kernels, class Real>
struct SphLaw {
  Kernels kernels;
  Real mass, atRest, stiffness;                 // J/kg; 0: no pressure
  Real square, viscosity, bulk, soft, tension;  // m^2, mu, 2 mu h m, h^2/100, m times the tension
  bool viscous, artificial, coheres, curved, tense;
  SphTension<Real> surface{};  // where it is tense

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
    if (tense) {
      const auto pull = surface.pull(p.q, own.density + other.density(), own.fluid, other.fluid());
      const T weights = select(p.acts, own.weight * other.weight(), T(0));
      for (std::size_t c = 0; c < 3; ++c)
        sums[c] += weights * (pull.along * p.d[c] + pull.apart * (own.normal[c] - other.normal(c)));
    }
    if (viscous) {
      const T rubs =
          select(p.acts, T(viscosity) * own.volume * other.volume() * kernels.viscosityLaplacian(p.q), T(0));
      for (std::size_t c = 0; c < 3; ++c) sums[c] += rubs * slower[c];
    }
  }

  /// To n / h of SphTension, of the fluid.
  SINEW_ANY_SIDE
  template <class T, class Pairs, class Other>
  SINEW_INLINE void addNormal(Pairs const& p, Other const& other, std::array<T, 3>& n) const {
    const T slope = select(p.acts, other.fluid() * other.volume() * kernels.densitySlope(p.q), T(0));
    for (std::size_t c = 0; c < 3; ++c) n[c] += slope * p.d[c];
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
