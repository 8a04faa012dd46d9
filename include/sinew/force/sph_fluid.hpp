// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/core/boundary_particles.hpp>
#include <sinew/core/component.hpp>
#include <sinew/force/sorted_particles.hpp>
#include <sinew/force/sph_kernels.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <string_view>
#include <vector>

namespace sinew {

/// A fluid of particles of one mass m, by smoothed particle hydrodynamics (Mueller, Charypar, Gross 2003;
/// Monaghan 1992), with the terms and units of SOFA's plugin SofaSphFluid:
///   rho_i = sum_j m W_ij,   p_i = pressure (rho_i - density)
///   f_i = -sum_j m^2 (p_i / rho_i^2 + p_j / rho_j^2) grad W_ij
///         + sum_j m^2 viscosity / (rho_i rho_j) lap W_ij (v_j - v_i)
/// over all particles nearer than the radius h. The artificial viscosity (2) has a pressure in the place of
/// the second sum, between what comes nearer: -m viscosity h (v_ij x_ij) / ((q^2 + h^2/100) (rho_i +
/// rho_j)/2), q = r/h. Surface tension is -m tension c n / |n| with n = sum_j (m/rho_j - m/rho_i) grad W_ij
/// and c the same sum of lap W_ij (1), or the cohesion -tension m sum_j W_ij (x_i - x_j) of Becker and
/// Teschner (2007) (2). Forces are those at the start of a step, also for implicit solvers: no part of them
/// is in a system, as in SOFA. Where pairs pull each other apart or together, momentum is kept to rounding,
/// and with the cubic kernel and no viscosity energy is, by the order of the solver.
/// Boundary particles of bodies (FluidBoundary) are neighbours of the mass density V_k, V_k = 1 / sum_l W_kl
/// over those of boundaries, at their velocity and without a pressure of their own (Akinci et al. 2012); they
/// have the opposite force of the last evaluation, which is the mean over the step under an explicit Euler
/// solver. Sums go over neighbours in the order of their cells, so that bits repeat.
template <class D>
struct SPHFluidForceField {
  using Role = role::ForceField;
  using DataTypes = D;
  using Real = typename D::Real;
  using VecCoord = typename D::VecCoord;
  using VecDeriv = typename D::VecDeriv;
  static constexpr std::string_view className = "SPHFluidForceField";

  double radius = 1, mass = 1, pressure = 100, density = 1, viscosity = 0.001, surfaceTension = 0;
  int kernelType = 0, pressureType = 1, viscosityType = 1, surfaceTensionType = 1;

  static constexpr auto fields() {
    using F = SPHFluidForceField;
    return field_list(
        field("radius", &F::radius, "m", "how far particles act on each other", range::positive),
        field("mass",
              &F::mass,
              "kg",
              "of each particle, for densities; what moves it is the mass of its node",
              range::positive),
        field("pressure",
              &F::pressure,
              "J/kg",
              "pressure for a density above that at rest",
              range::nonNegative),
        field("density", &F::density, "kg/m^3", "at rest", range::positive),
        field("viscosity",
              &F::viscosity,
              "Pa s",
              "dynamic viscosity, or the factor of the artificial one",
              range::nonNegative),
        field("surfaceTension", &F::surfaceTension, "N/m", "0 or below: none"),
        field("kernelType",
              &F::kernelType,
              "",
              "0: those of Mueller et al., 1: the cubic spline",
              range::closed(0, 1)),
        field("pressureType", &F::pressureType, "", "0: none, 1: as above", range::closed(0, 1)),
        field("viscosityType",
              &F::viscosityType,
              "",
              "0: none, 1: by the Laplacian of the kernel, 2: artificial",
              range::closed(0, 2)),
        field("surfaceTensionType",
              &F::surfaceTensionType,
              "",
              "0: none, 1: by the curvature, 2: cohesion",
              range::closed(0, 2)));
  }

  /// Curvature is a force on each particle alone; the first viscosity turns what it slows down.
  ForceProperties properties() const {
    return {.internal = !hasCurvature(),
            .objective = !hasCurvature() && !(viscosityType == 1 && viscosity > 0),
            .conservative = kernelType == 1 && !(surfaceTension > 0),
            .exactTangent = false,
            .implicit = false};
  }

  BoundaryParticles boundary{};
  std::string where{};
  std::size_t size = 0, most = 0;  // of particles, now and at one time

  void init(InitContext<D> const& context) {
    where = text(context.where, ": ", component_name<SPHFluidForceField>());
    size = most = context.rest.size();
    boundary.clear();
    reserveForBoundary();
  }
  void followPoints(Renumbering const&, std::size_t points) {
    size = points;
    most = std::max(most, points);
    reserveForBoundary();
  }
  void reserveForBoundary() {
    const std::size_t all = most + boundary.size();
    particles.reserve(all);
    joined.reserve(all);
    moving.reserve(all);
    for (auto* one : {&densities, &volumes, &fluid}) one->reserve(all);
  }

  /// Shared among threads in three passes: the order of the particles, densities, forces.
  static constexpr bool sharesWork = true;
  static constexpr int passes = 3;
  int shares = 1;
  void split(int threads) { shares = most < 2000 ? 1 : threads; }

  void addForce(MechanicalParams const& p, VecDeriv& f, VecCoord const& x, VecDeriv const& v) {
    const bool whole = p.share.count == 1;
    if (whole || (p.share.pass == 0 && p.share.index == 0)) {
      sort(x);
      for (std::size_t k = 0; k < particles.order().size(); ++k) {
        const auto i = std::size_t(particles.order()[k]);
        for (int c = 0; c < 3; ++c)
          moving[k].of[c] = i < size ? v[i][c] : Real(boundary.velocities[i - size][c]);
      }
    }
    withKernels([&](auto const& kernels) {
      if (whole || p.share.pass == 1) findDensities(kernels, p.share);
      if (whole || p.share.pass == 2) addForces(kernels, p.share, f);
    });
  }
  void addDForce(MechanicalParams const&, VecDeriv&, VecDeriv const&) const {}
  template <class Sink>
  void addToMatrix(MechanicalParams const&, Sink const&) const {}

  /// Of the pressure, with densities by the same kernel (the cubic one) [J]:
  /// sum_i m pressure (ln(rho_i / density) + density / rho_i - 1).
  double potentialEnergy(VecCoord const& x) {
    if (pressureType == 0) return 0;
    sort(x);
    double sum = 0;
    withKernels([&](auto const& kernels) { findDensities(kernels, {}); });
    for (std::size_t k = 0; k < particles.order().size(); ++k) {
      if (fluid[k] == 0) continue;
      const double d = double(densities[k]) / density;
      sum += mass * pressure * (std::log(d) + 1 / d - 1);
    }
    return sum;
  }

  // in the order of the particles
  SortedParticles<Real, lane_width<D>()> particles{};  // weights: mass over that of the fluid's
  std::vector<FourOf<Real>> moving{};                  // velocity, p / rho^2
  std::vector<Real> densities{}, volumes{}, fluid{};   // m / rho; 1 for the fluid, 0 for the boundary
  VecCoord joined{};                                   // the fluid, then the boundary

 private:
  using Particles = SortedParticles<Real, lane_width<D>()>;
  using Pairs = typename Particles::Pairs;
  using L = typename Particles::L;

  bool hasCurvature() const { return surfaceTension > 0 && surfaceTensionType == 1; }
  bool hasCohesion() const { return surfaceTension > 0 && surfaceTensionType == 2; }

  void sort(VecCoord const& x) {
    size = x.size();
    if (boundary.size() == 0) {
      particles.sort(x, radius, where);
    } else {
      joined.assign(x.begin(), x.end());
      for (auto const& p : boundary.positions) joined.push_back(p.template cast<Real>());
      particles.sort(joined, radius, where);
    }
    const std::size_t all = particles.order().size();
    moving.resize(all);
    for (auto* one : {&densities, &volumes}) one->resize(all, Real(1));
    fluid.assign(all, Real(1));
    if (boundary.size() > 0) withKernels([&](auto const& kernels) { findBoundary(kernels); });
  }
  // masses and volumes of the boundary, at the density at rest and without pressure
  template <class Kernels>
  void findBoundary(Kernels const& kernels) {
    for (std::size_t k = 0; k < particles.order().size(); ++k)
      if (std::size_t(particles.order()[k]) >= size) fluid[k] = 0;
    particles.forEach({}, [&](int i, auto const& each) {
      const auto at = std::size_t(i);
      if (fluid[at] != 0) return;
      L around(0);
      each([&](Pairs const& p) {
        around += select(p.acts, (L(1) - load(fluid, p)) * kernels.density(p.q), L(0));
      });
      volumes[at] = 1 / sum(around);
      particles.weight(at) = Real(density / mass) * volumes[at];
      densities[at] = Real(density);
      moving[at].of[3] = 0;
    });
  }
  static L load(std::vector<Real> const& from, Pairs const& p) { return Particles::load(from, p); }
  static Real sum(L const& value) { return Particles::sum(value); }
  template <class F>
  void withKernels(F&& f) const {
    kernelType == 1 ? f(CubicKernels<Real>(Real(radius))) : f(MuellerKernels<Real>(Real(radius)));
  }

  template <class Kernels>
  void findDensities(Kernels const& kernels, WorkShare const& share) {
    const Real m = Real(mass), atRest = Real(density), stiffness = Real(pressureType == 0 ? 0 : pressure);
    particles.forEach(share, [&](int i, auto const& each) {
      if (fluid[std::size_t(i)] == 0) return;
      L around(0);
      each([&](Pairs const& p) { around += select(p.acts, p.weight * kernels.density(p.q), L(0)); });
      const Real rho = m * sum(around);
      densities[std::size_t(i)] = rho;
      moving[std::size_t(i)].of[3] = stiffness * (rho - atRest) / (rho * rho);
      volumes[std::size_t(i)] = m / rho;
    });
  }
  // -m tension c n / |n|
  template <class Kernels, class Each>
  std::array<Real, 3> curvatureForce(Kernels const& kernels, int i, Each const& each) const {
    const L own(volumes[std::size_t(i)]);
    std::array<L, 3> n{L(0), L(0), L(0)};
    L curvature(0);
    each([&](Pairs const& p) {
      const L more = select(p.acts, load(volumes, p) - own, L(0));
      const L slope = more * kernels.densitySlope(p.q);
      for (std::size_t c = 0; c < 3; ++c) n[c] += slope * p.d[c];
      curvature += more * kernels.densityLaplacian(p.q);
    });
    std::array<Real, 3> force;
    Real square(0);
    for (std::size_t c = 0; c < 3; ++c) force[c] = sum(n[c]), square += force[c] * force[c];
    const Real length = std::sqrt(square);
    const Real factor =
        length > Real(1e-6) ? -Real(mass * surfaceTension) * sum(curvature) / length : Real(0);
    for (Real& one : force) one *= factor;
    return force;
  }
  template <class Kernels>
  void addForces(Kernels const& kernels, WorkShare const& share, VecDeriv& f) {
    const bool viscous = viscosityType == 1 && viscosity > 0,
               artificial = viscosityType == 2 && viscosity > 0;
    const bool coheres = hasCohesion(), curved = hasCurvature();
    const L square{Real(mass * mass)}, bulk{Real(2 * viscosity * radius * mass)},
        soft{Real(0.01 * radius * radius)};
    const L drag{Real(viscosity)}, cohesion{Real(-surfaceTension * mass)};
    particles.forEach(share, [&](int i, auto const& each) {
      const auto at = std::size_t(i);
      const L pushed(moving[at].of[3]), rho(densities[at]), volume(volumes[at]);
      std::array<L, 3> v, sums{L(0), L(0), L(0)};
      for (std::size_t c = 0; c < 3; ++c) v[c] = L(moving[at].of[c]);
      const bool wall = fluid[at] == 0;
      const L own(particles.weight(at));
      each([&](Pairs const& p) {
        auto acts = p.acts;  // walls do not act on walls
        if (wall) acts = both(acts, load(fluid, p) > L(0));
        L other[4];
        load_at(moving.data(), p.places, other);
        L pushes = -square * (pushed + other[3]);
        std::array<L, 3> slower;  // v_j - v_i
        for (std::size_t c = 0; c < 3; ++c) slower[c] = other[c] - v[c];
        if (artificial) {
          L apart(0);
          for (std::size_t c = 0; c < 3; ++c) apart -= slower[c] * p.d[c];
          pushes +=
              select(apart < L(0), apart, L(0)) * bulk / ((p.q * p.q + soft) * (rho + load(densities, p)));
        }
        L along = pushes * kernels.pressureSlope(p.q);
        if (coheres) along += cohesion * kernels.density(p.q);
        along = select(acts, own * p.weight * along, L(0));
        for (std::size_t c = 0; c < 3; ++c) sums[c] += along * p.d[c];
        if (viscous) {
          const L rubs =
              select(acts, drag * volume * load(volumes, p) * kernels.viscosityLaplacian(p.q), L(0));
          for (std::size_t c = 0; c < 3; ++c) sums[c] += rubs * slower[c];
        }
      });
      std::array<Real, 3> tension{};
      const auto point = std::size_t(particles.order()[at]);
      if (wall) {
        for (std::size_t c = 0; c < 3; ++c)
          boundary.forces[point - size][Eigen::Index(c)] = double(sum(sums[c]));
        return;
      }
      if (curved) tension = curvatureForce(kernels, i, each);
      for (std::size_t c = 0; c < 3; ++c) f[point][Eigen::Index(c)] += sum(sums[c]) + tension[c];
    });
  }
};

}  // namespace sinew
