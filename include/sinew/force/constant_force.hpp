// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/core/component.hpp>
#include <sinew/core/lists.hpp>

#include <optional>
#include <vector>

namespace sinew {

/// The same force at all times on chosen points, on all where none are chosen. It is given by the first of
/// these that is there: `forces`, one for all points or one for each; `force`, on each point; `totalForce`,
/// shared evenly between the points.
template <class D>
struct ConstantForceField {
  using Role = role::ForceField;
  static constexpr bool isLoad = true;
  using DataTypes = D;
  using Real = typename D::Real;
  using Deriv = typename D::Deriv;
  using VecCoord = typename D::VecCoord;
  using VecDeriv = typename D::VecDeriv;
  static constexpr std::string_view className = "ConstantForceField";

  std::vector<int> indices{};
  VecDeriv forces{};
  std::optional<Deriv> force{}, totalForce{};

  static constexpr auto fields() {
    using F = ConstantForceField;
    return field_list(
        field("indices", &F::indices, "", "points that the forces act on; none for all", range::nonNegative)
            .numbersOf(Of::points)
            .also("points")
            .whileRunning(),
        field("forces", &F::forces, "N", "one force for all indices, or one for each")
            .oneEach(Of::entries)
            .whileRunning(),
        field("force", &F::force, "N", "force on each point, where forces is not given").whileRunning(),
        field("totalForce", &F::totalForce, "N", "force that the points share evenly, where neither is given")
            .whileRunning());
  }

  // a constant torque in space has no energy: what it does depends on the path of the rotation
  static constexpr ForceProperties properties() {
    return {.internal = false, .objective = false, .conservative = !(D::rigid && D::spatial == 3)};
  }

  bool none = false;  // all of them have been removed

  static constexpr auto state() {
    return field_list(field("none", &ConstantForceField::none, "", "all of the points have been removed"));
  }

  VecCoord rest{};
  std::size_t size = 0;  // points that a force acts on

  void init(InitContext<D> const& context) {
    if (!none) rest = context.rest;
    takeValues(context.where, context.rest.size());
  }
  void takeValues(std::string_view place, std::size_t points) {
    const auto where = [&] { return text(place, ": ", component_name<ConstantForceField>()); };
    size = 0;
    if (none) return;
    size = indices.empty() ? points : indices.size();
    if (forces.empty() && !force && !totalForce)
      throw Error(where(), "there is no force; give one of forces, force and totalForce");
    if (!forces.empty() && forces.size() != 1 && forces.size() != size)
      throw Error(where(),
                  text("forces has ",
                       forces.size(),
                       " entries for ",
                       size,
                       " indices; give one force, or one for each index"));
    check_points(where, "indices", indices, points);
  }

  /// Of the whole scene, before ranks have parts of it: the share of a point in a total stays what it is.
  void shareOut() {
    if (forces.empty() && !force && totalForce && size > 0) force = *totalForce / Real(size);
  }

  std::size_t point(std::size_t i) const { return indices.empty() ? i : std::size_t(indices[i]); }
  /// Force on point(i).
  Deriv load(std::size_t i) const {
    if (!forces.empty()) return forces.size() == 1 ? forces[0] : forces[i];
    return force ? *force : Deriv(*totalForce / Real(size));
  }

  void addForce(MechanicalParams const&, VecDeriv& f, VecCoord const&, VecDeriv const&) const {
    for (std::size_t i = 0; i < size; ++i) f[point(i)] += load(i);
  }
  void addDForce(MechanicalParams const&, VecDeriv&, VecDeriv const&) const {}
  template <class Sink>
  void addToMatrix(MechanicalParams const&, Sink const&) const {}

  /// E = -sum f.(x - x_rest), torques by the rotation vector from rest                   [J]
  double potentialEnergy(VecCoord const& x) const {
    double energy = 0;
    for (std::size_t i = 0; i < size; ++i)
      energy -= double(load(i).dot(D::difference(rest[point(i)], x[point(i)])));
    return energy;
  }
};

}  // namespace sinew
