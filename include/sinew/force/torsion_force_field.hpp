// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/core/component.hpp>
#include <sinew/core/lists.hpp>

#include <Eigen/Geometry>

#include <string>
#include <string_view>
#include <vector>

namespace sinew {

/// A load that turns points about an axis of the direction u through o: it grows with the distance from it.
///   f_i = T u x (x_i - o),   of rigid bodies at their centres, and on these the torque T u too
/// T is a force per distance [N/m], whose torque about the axis is T r^2 on each point, and of rigid bodies a
/// torque [N m]; that is SOFA's rule. It has no energy, and the symmetric part of its derivative, which the
/// systems of implicit solvers have, is zero: it is that of the start of a step. (SOFA takes T (I - u u') for
/// the derivative, which is not that of the force.)
template <class D>
struct TorsionForceField {
  using Role = role::ForceField;
  using DataTypes = D;
  using Real = typename D::Real;
  using VecCoord = typename D::VecCoord;
  using VecDeriv = typename D::VecDeriv;
  static_assert(D::spatial == 3 && (D::rigid || D::size == 3),
                "Sinew: TorsionForceField is for points and rigid bodies in space (Vec3d, Rigid3d).");
  static constexpr std::string_view className = "TorsionForceField";

  std::vector<int> indices{};
  double torque = 0;
  Eigen::Vector3d axis{0, 0, 0}, origin{0, 0, 0};

  static constexpr auto fields() {
    using F = TorsionForceField;
    return field_list(
        field("indices", &F::indices, "", "points that it acts on", range::nonNegative).numbersOf(Of::points),
        field("torque", &F::torque, "N/m", "force per distance from the axis; of rigid bodies a torque too"),
        field("axis", &F::axis, "", "direction of the axis, of any length but 0"),
        field("origin", &F::origin, "m", "a point of the axis"));
  }

  static constexpr ForceProperties properties() {
    return {.internal = false,
            .objective = false,
            .conservative = false,
            .exactTangent = false,
            .implicit = false};
  }

  Vec<Real, 3> turning = Vec<Real, 3>::Zero();  // T u

  void init(InitContext<D> const& context) {
    const std::string where = text(context.where, ": ", component_name<TorsionForceField>());
    check_points(where, "indices", indices, context.rest.size());
    if (!(axis.norm() > 0))
      throw Error(where, "axis is 0 0 0, which has no direction; give that of the axis about which it turns");
    turning = (torque * axis.normalized()).template cast<Real>();
  }
  /// The warning of init; empty for none.
  std::string_view warning() const {
    return indices.empty() ? "there are no indices, so that it acts on no point; give it some" : "";
  }

  void addForce(MechanicalParams const&, VecDeriv& f, VecCoord const& x, VecDeriv const&) const {
    const Vec<Real, 3> o = origin.template cast<Real>();
    for (const int i : indices) {
      const Vec<Real, 3> arm = D::center(x[std::size_t(i)]) - o;
      f[std::size_t(i)].template head<3>() += turning.cross(arm);
      if constexpr (D::rigid) f[std::size_t(i)].template tail<3>() += turning;
    }
  }
  void addDForce(MechanicalParams const&, VecDeriv&, VecDeriv const&) const {}
  template <class Sink>
  void addToMatrix(MechanicalParams const&, Sink const&) const {}
  double potentialEnergy(VecCoord const&) const { return 0; }
};

}  // namespace sinew
