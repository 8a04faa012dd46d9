// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/core/boundary_particles.hpp>
#include <sinew/core/component.hpp>

#include <algorithm>
#include <string_view>

namespace sinew {

/// Makes the points of its state boundary particles (Akinci, Ihmsen, Akinci, Solenthaler, Teschner 2012): all
/// fluids of the scene meet them, as neighbours of the volume c / sum_l W_kl, over all boundary particles,
/// and the force of the fluids over the step acts on them. In a node below a body, which a mapping moves, it
/// goes back to that body, rigid or soft. Points are to cover the surface at the distance of the particles of
/// the fluid (SurfaceSampling). The solver of the fluid comes before that of the body, so that the two have
/// the same impulse in the same step.
template <class D>
struct FluidBoundary {
  using Role = role::ForceField;
  using DataTypes = D;
  using VecCoord = typename D::VecCoord;
  using VecDeriv = typename D::VecDeriv;
  static_assert(!D::rigid && D::spatial == 3 && D::size == 3,
                "Sinew: boundary particles are points in space; take Vec3d or Vec3f.");
  static constexpr bool isLoad = true, boundsFluids = true;
  static constexpr std::string_view className = "FluidBoundary";

  static constexpr auto fields() { return field_list(); }

  static constexpr ForceProperties properties() {
    return {.internal = false, .objective = false, .conservative = false};
  }

  VecDeriv forces{};  // of the fluids, over the last step [N]

  void init(InitContext<D> const& context) { forces.resize(context.rest.size(), D::Deriv::Zero()); }
  void reset() { std::fill(forces.begin(), forces.end(), typename D::Deriv(D::Deriv::Zero())); }

  void addForce(MechanicalParams const&, VecDeriv& f, VecCoord const&, VecDeriv const&) const {
    for (std::size_t i = 0; i < forces.size(); ++i) f[i] += forces[i];
  }
  void addDForce(MechanicalParams const&, VecDeriv&, VecDeriv const&) const {}
  template <class Sink>
  void addToMatrix(MechanicalParams const&, Sink const&) const {}
  double potentialEnergy(VecCoord const&) const { return 0; }
};

}  // namespace sinew
