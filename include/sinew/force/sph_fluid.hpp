// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/core/boundary_particles.hpp>
#include <sinew/core/component.hpp>
#include <sinew/force/sph_driver.hpp>
#include <sinew/force/sph_kernels.hpp>

#include <algorithm>
#include <string>
#include <string_view>
#include <type_traits>

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
/// Teschner (2007) (2), or that of Akinci, Akinci, Teschner (2013) with adhesion to boundaries (3,
/// SphTension). Forces are those at the start of a step, also for implicit solvers: no part of them is in a
/// system, as in SOFA. Where pairs pull each other apart or together, momentum is kept to rounding, and with
/// the cubic kernel and no viscosity energy is, by the order of the solver. Boundary particles of bodies
/// (FluidBoundary) are neighbours of the mass density V_k, V_k = 1 / sum_l W_kl over those of boundaries, at
/// their velocity and without a pressure of their own (Akinci et al. 2012); they have the opposite force of
/// the last evaluation, which is the mean over the step under an explicit Euler solver. Sums go over
/// neighbours in the order of their cells, so that bits repeat.
template <class D>
struct SPHFluidForceField {
  using Role = role::ForceField;
  using DataTypes = D;
  using Real = typename D::Real;
  using VecCoord = typename D::VecCoord;
  using VecDeriv = typename D::VecDeriv;
  static constexpr std::string_view className = "SPHFluidForceField";

  double radius = 1, mass = 1, pressure = 100, density = 1, viscosity = 0.001, surfaceTension = 0,
         adhesion = 0;
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
        field("adhesion",
              &F::adhesion,
              "N/m",
              "pull of boundary particles under surfaceTensionType 3, at most as strong as that of a surface "
              "tension of this size",
              range::nonNegative),
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
              "0: none, 1: by the curvature, 2: cohesion, 3: cohesion, area and adhesion",
              range::closed(0, 3)));
  }

  /// Curvature is a force on each particle alone, and differences of normals turn a pair; the first viscosity
  /// turns what it slows down.
  ForceProperties properties() const {
    return {.internal = !hasCurvature() && !hasNormals(),
            .objective = !hasCurvature() && !(viscosityType == 1 && viscosity > 0),
            .conservative = kernelType == 1 && !(surfaceTension > 0),
            .exactTangent = false,
            .implicit = false};
  }

  BoundaryParticles boundary{};
  std::string where{};
  std::size_t most = 0;  // particles of the fluid at one time
  SphDriver<D> particles{};

  void init(InitContext<D> const& context) {
    where = text(context.where, ": ", component_name<SPHFluidForceField>());
    most = context.rest.size();
    boundary.clear();
    reserveForBoundary();
  }
  void followPoints(Renumbering const&, std::size_t points) {
    most = std::max(most, points);
    reserveForBoundary();
  }
  void reserveForBoundary() { particles.reserve(most + boundary.size()); }

  /// Shared among threads in passes: the order of the particles, densities, normals, forces.
  static constexpr bool sharesWork = SphDriver<D>::sharesWork;
  static constexpr int passes = 4;
  int shares = 1;
  void split(int threads) { shares = most < 2000 ? 1 : threads; }

  void addForce(MechanicalParams const& p, VecDeriv& f, VecCoord const& x, VecDeriv const& v) {
    const bool whole = p.share.count == 1;
    withLaw([&](auto const& law) {
      if (whole || (p.share.pass == 0 && p.share.index == 0)) {
        particles.sort(law, x, boundary, radius, where);
        particles.takeVelocities(v, boundary);
      }
      if (whole || p.share.pass == 1) particles.findDensities(law, p.share);
      if (whole || p.share.pass == 2) particles.findNormals(law, p.share);
      if (whole || p.share.pass == 3) particles.addForces(law, p.share, f, boundary);
    });
  }
  void addDForce(MechanicalParams const&, VecDeriv&, VecDeriv const&) const {}
  template <class Sink>
  void addToMatrix(MechanicalParams const&, Sink const&) const {}

  /// Of the pressure, with densities by the same kernel (the cubic one) [J]:
  /// sum_i m pressure (ln(rho_i / density) + density / rho_i - 1).
  double potentialEnergy(VecCoord const& x) {
    if (pressureType == 0) return 0;
    double energy = 0;
    withLaw([&](auto const& law) {
      particles.sort(law, x, boundary, radius, where);
      particles.findDensities(law, {});
      energy = particles.energy(law);
    });
    return energy;
  }

 private:
  bool hasCurvature() const { return surfaceTension > 0 && surfaceTensionType == 1; }
  bool hasNormals() const { return surfaceTensionType == 3 && (surfaceTension > 0 || adhesion > 0); }

  template <class F>
  void withLaw(F&& f) const {
    auto with = [&](auto const& kernels) {
      f(SphLaw<std::decay_t<decltype(kernels)>, Real>{
          .kernels = kernels,
          .mass = Real(mass),
          .atRest = Real(density),
          .stiffness = Real(pressureType == 0 ? 0 : pressure),
          .square = Real(mass * mass),
          .viscosity = Real(viscosity),
          .bulk = Real(2 * viscosity * radius * mass),
          .soft = Real(0.01 * radius * radius),
          .tension = Real(mass * surfaceTension),
          .viscous = viscosityType == 1 && viscosity > 0,
          .artificial = viscosityType == 2 && viscosity > 0,
          .coheres = surfaceTension > 0 && surfaceTensionType == 2,
          .curved = hasCurvature(),
          .tense = hasNormals(),
          .surface = SphTension<Real>::of(
              std::max(0.0, surfaceTension), adhesion, radius, mass / density, density)});
    };
    kernelType == 1 ? with(CubicKernels<Real>(Real(radius))) : with(MuellerKernels<Real>(Real(radius)));
  }
};

}  // namespace sinew
