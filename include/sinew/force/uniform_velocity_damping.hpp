// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/core/component.hpp>

namespace sinew {

/// Damping that slows every degree of freedom: f = -c v [N]; B = -c I, which implicit steps see only with
/// `implicit`.
template <class D>
struct UniformVelocityDampingForceField {
  using Role = role::ForceField;
  using DataTypes = D;
  using Real = typename D::Real;
  using VecCoord = typename D::VecCoord;
  using VecDeriv = typename D::VecDeriv;
  static constexpr std::string_view className = "UniformVelocityDampingForceField";

  double dampingCoefficient = 0.1;
  bool implicit = false;

  static constexpr auto fields() {
    using F = UniformVelocityDampingForceField;
    return field_list(
        field("dampingCoefficient", &F::dampingCoefficient, "N s/m", "force per speed", range::nonNegative)
            .also("damping")
            .whileRunning(),
        field("implicit", &F::implicit, "", "the damping is part of the matrix of implicit steps"));
  }

  static constexpr ForceProperties properties() { return {.internal = false, .objective = false}; }

  std::size_t size = 0;

  void init(InitContext<D> const& context) { size = context.rest.size(); }
  void followPoints(Renumbering const&, std::size_t points) { size = points; }

  void addForce(MechanicalParams const&, VecDeriv& f, VecCoord const&, VecDeriv const& v) const {
    for (std::size_t i = 0; i < v.size(); ++i) f[i] -= Real(dampingCoefficient) * v[i];
  }
  void addDForce(MechanicalParams const& p, VecDeriv& df, VecDeriv const& dx) const {
    if (!implicit || p.b == 0) return;
    for (std::size_t i = 0; i < dx.size(); ++i) df[i] -= Real(p.b * dampingCoefficient) * dx[i];
  }
  double potentialEnergy(VecCoord const&) const { return 0; }
  template <class Sink>
  void addToMatrix(MechanicalParams const& p, Sink const& sink) const {
    if (!implicit) return;
    const Mat<Real, D::size> block = Real(-p.b * dampingCoefficient) * Mat<Real, D::size>::Identity();
    for (std::size_t i = 0; i < size; ++i) sink.add(int(i), int(i), block);
  }
};

}  // namespace sinew
