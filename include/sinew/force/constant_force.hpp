// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/core/component.hpp>

#include <vector>

namespace sinew {

/// The same force at all times on chosen points: one force for all of `indices`, or one for each.
template <class D>
struct ConstantForceField {
  using Role = role::ForceField;
  using DataTypes = D;
  using VecCoord = typename D::VecCoord;
  using VecDeriv = typename D::VecDeriv;
  static constexpr std::string_view className = "ConstantForceField";

  std::vector<int> indices{};
  VecDeriv forces{};

  static constexpr auto fields() {
    using F = ConstantForceField;
    return field_list(field("indices", &F::indices, "", "points that the forces act on", range::nonNegative),
                      field("forces", &F::forces, "N", "one force for all indices, or one for each"));
  }

  // a constant torque in space has no energy: what it does depends on the path of the rotation
  static constexpr ForceProperties properties() {
    return {.internal = false, .objective = false, .conservative = !(D::rigid && D::spatial == 3)};
  }

  VecCoord rest{};

  void init(InitContext<D> const& context) {
    const std::string where = text(context.where, ": ", component_name<ConstantForceField>());
    if (forces.size() != 1 && forces.size() != indices.size())
      throw Error(where,
                  text("forces has ",
                       forces.size(),
                       " entries for ",
                       indices.size(),
                       " indices; give one force, or one for each index"));
    for (const int i : indices)
      if (std::size_t(i) >= context.rest.size())
        throw Error(where,
                    text("indices has ",
                         i,
                         ", but the state has ",
                         context.rest.size(),
                         " points, numbered from 0; correct the index"));
    rest = context.rest;
  }

  typename D::Deriv const& force(std::size_t i) const { return forces.size() == 1 ? forces[0] : forces[i]; }

  void addForce(MechanicalParams const&, VecDeriv& f, VecCoord const&, VecDeriv const&) const {
    for (std::size_t i = 0; i < indices.size(); ++i) f[std::size_t(indices[i])] += force(i);
  }
  void addDForce(MechanicalParams const&, VecDeriv&, VecDeriv const&) const {}
  template <class Sink>
  void addToMatrix(MechanicalParams const&, Sink const&) const {}

  /// E = -sum f.(x - x_rest), torques by the rotation vector from rest                   [J]
  double potentialEnergy(VecCoord const& x) const {
    double energy = 0;
    for (std::size_t i = 0; i < indices.size(); ++i)
      energy -=
          double(force(i).dot(D::difference(rest[std::size_t(indices[i])], x[std::size_t(indices[i])])));
    return energy;
  }
};

}  // namespace sinew
