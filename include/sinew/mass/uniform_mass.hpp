// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/mass/lumped_mass.hpp>

#include <optional>

namespace sinew {

/// The same mass at every point: `vertexMass`, or `totalMass` shared out evenly. Rigid bodies have a mass and
/// an inertia in body axes; `totalMass` scales both.
template <class D>
struct UniformMass {
  using Role = role::Mass;
  using DataTypes = D;
  using Real = typename D::Real;
  using VecCoord = typename D::VecCoord;
  using VecDeriv = typename D::VecDeriv;
  using MassType = typename D::MassType;
  static constexpr std::string_view className = "UniformMass";

  std::optional<MassType> vertexMass{};  // 1 kg (and unit inertia) when neither is given
  std::optional<double> totalMass{};

  static constexpr auto fields() {
    return field_list(
        field("vertexMass", &UniformMass::vertexMass, "kg", "mass of each point", range::positive)
            .also("mass vertexmass"),
        field("totalMass", &UniformMass::totalMass, "kg", "mass of all points together", range::positive)
            .also("totalmass"));
  }

  LumpedMass<D> lumped{};

  void init(InitContext<D> const& context) {
    const std::string where = text(context.where, ": ", component_name<UniformMass>());
    if (vertexMass && totalMass)
      throw Error(where, "vertexMass and totalMass are both given; give one of them");
    MassType mass = vertexMass.value_or(unit());
    if (totalMass) {
      if (context.rest.empty())
        throw Error(where, "the state has no points to share totalMass; give it positions");
      const Real share = Real(*totalMass) / Real(context.rest.size());
      if constexpr (D::rigid)
        mass = {share, share * mass.inertia};
      else
        mass = share;
    }
    lumped.init(where, {mass});
  }

  void addForce(MechanicalParams const& p, VecDeriv& f, VecCoord const& x, VecDeriv const& v) const {
    lumped.addForce(p, f, x, v);
  }
  void addMDx(VecDeriv& f, VecCoord const& x, VecDeriv const& dx, double factor) const {
    lumped.addMDx(f, x, dx, Real(factor));
  }
  void accFromF(VecDeriv& a, VecCoord const& x, VecDeriv const& f) const { lumped.accFromF(a, x, f); }
  double kineticEnergy(VecCoord const& x, VecDeriv const& v) const { return lumped.kineticEnergy(x, v); }
  template <class Sink>
  void addToMatrix(MechanicalParams const& p, VecCoord const& x, Sink const& sink) const {
    lumped.addToMatrix(x, Real(p.m), sink);
  }

 private:
  static MassType unit() {
    if constexpr (D::rigid)
      return {};
    else
      return MassType(1);
  }
};

}  // namespace sinew
