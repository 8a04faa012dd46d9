// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/core/component.hpp>
#include <sinew/state/vector_operations.hpp>

#include <vector>

namespace sinew {

/// Degrees of freedom of one body: its state vectors, found by their ids. Sized by `position`, or by the
/// mapping of the node when `position` is empty.
template <class D>
struct MechanicalObject {
  using Role = role::State;
  using DataTypes = D;
  using VecCoord = typename D::VecCoord;
  using VecDeriv = typename D::VecDeriv;
  static constexpr std::string_view className = "MechanicalObject";

  VecCoord position{};      // current positions [m]; those given are the initial ones
  VecDeriv velocity{};      // current velocities [m/s]; zero when not given
  VecCoord restPosition{};  // undeformed positions [m]; the initial ones when not given

  static constexpr auto fields() {
    using M = MechanicalObject;
    return field_list(field("position", &M::position, "m", "positions at the start"),
                      field("velocity", &M::velocity, "m/s", "velocities at the start"),
                      field("rest_position", &M::restPosition, "m", "undeformed positions"));
  }

  // after init
  VecDeriv force{}, dx{};
  VecCoord freePosition{};
  std::vector<VecCoord> auxiliaryCoords{};
  std::vector<VecDeriv> auxiliaryDerivs{};
  VecCoord resetPosition{};
  VecDeriv resetVelocity{};
  int dofOffset = -1;  // first scalar of this state in the assembled system of its solver

  std::size_t size() const { return position.size(); }

  void init(std::string const& where) {
    const std::size_t n = position.size();
    auto same = [&](std::size_t given, std::string_view name) {
      if (given != 0 && given != n)
        throw Error(where, text(component_name<MechanicalObject>(), ": ", name, " has ", given,
                                " entries, position has ", n, "; give one for each, or none"));
    };
    same(velocity.size(), "velocity");
    same(restPosition.size(), "rest_position");
    if constexpr (D::rigid && D::spatial == 3)
      for (std::size_t i = 0; i < n; ++i) {
        const auto norm = position[i].orientation.norm();
        if (!(norm > 1e-6))
          throw Error(where, text(component_name<MechanicalObject>(), ": the orientation of position ", i,
                                  " is zero; give a quaternion of length 1"));
        position[i].orientation.coeffs() /= norm;
      }
    if (velocity.empty()) velocity.assign(n, D::Deriv::Zero());
    if (restPosition.empty()) restPosition = position;
    force.assign(n, D::Deriv::Zero());
    dx.assign(n, D::Deriv::Zero());
    freePosition = position;
    resetPosition = position;
    resetVelocity = velocity;
  }

  void reserve(Auxiliary needed) {
    while (auxiliaryCoords.size() < std::size_t(needed.coords)) auxiliaryCoords.push_back(position);
    while (auxiliaryDerivs.size() < std::size_t(needed.derivs)) auxiliaryDerivs.push_back(dx);
  }

  void reset() {
    position = resetPosition;
    velocity = resetVelocity;
  }

  VecCoord& operator[](CoordId id) {
    switch (id.index) {
      case vec_id::position.index:
        return position;
      case vec_id::restPosition.index:
        return restPosition;
      case vec_id::freePosition.index:
        return freePosition;
      default:
        return auxiliaryCoords[std::size_t(id.index - CoordId::reserved)];
    }
  }
  VecDeriv& operator[](DerivId id) {
    switch (id.index) {
      case vec_id::velocity.index:
        return velocity;
      case vec_id::force.index:
        return force;
      case vec_id::dx.index:
        return dx;
      default:
        return auxiliaryDerivs[std::size_t(id.index - DerivId::reserved)];
    }
  }
};

}  // namespace sinew
