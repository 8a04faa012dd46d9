// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/constraint/constrained_points.hpp>
#include <sinew/core/placement.hpp>

#include <numbers>
#include <vector>

namespace sinew {

/// Points move as given at key times, linearly between them: by a movement from their rest positions, or
/// through absolute positions. Outside of the key times they are free. The last three numbers of a movement
/// of a rigid body in space are angles [rad] about x, then y, then z; between two orientations it rotates
/// about one axis.
template <class D>
struct LinearMovementConstraint {
  using Role = role::ProjectiveConstraint;
  using DataTypes = D;
  using Real = typename D::Real;
  using Coord = typename D::Coord;
  using Deriv = typename D::Deriv;
  using VecCoord = typename D::VecCoord;
  using VecDeriv = typename D::VecDeriv;
  static constexpr std::string_view className = "LinearMovementConstraint";
  static constexpr std::string_view aliases = "LinearMovementProjectiveConstraint";
  static constexpr bool rotates = D::rigid && D::spatial == 3;

  std::vector<int> indices{0};
  std::vector<double> keyTimes{0};
  VecDeriv movements{Deriv::Zero()};
  bool relativeMovements = true;

  static constexpr auto fields() {
    using F = LinearMovementConstraint;
    return field_list(
        field("indices", &F::indices, "", "points that are moved", range::nonNegative).numbersOf(Of::points),
        field("keyTimes", &F::keyTimes, "s", "key times, in rising order"),
        field("movements", &F::movements, "m", "movement of the points at each key time"),
        field("relativeMovements",
              &F::relativeMovements,
              "",
              "movements start from rest, else from the origin"));
  }

  VecCoord start{};         // positions of the indices that movements start from
  VecCoord orientations{};  // of the movements of rigid bodies in space
  bool active = false;      // at the end of the last step

  void init(InitContext<D> const& context) {
    check_points<LinearMovementConstraint>(context, indices);
    check_key_times<LinearMovementConstraint>(context, keyTimes, movements.size(), "movements");
    start.clear();
    for (const int i : indices) start.push_back(relativeMovements ? context.rest[std::size_t(i)] : D::zero());
    if constexpr (rotates) {
      orientations.assign(movements.size(), D::zero());
      for (std::size_t k = 0; k < movements.size(); ++k)
        orientations[k].orientation =
            rotation_of_degrees(movements[k].template tail<3>().template cast<double>() *
                                (180 / std::numbers::pi))
                .template cast<Real>();
    }
    active = movement().moves(0);
  }

  void projectResponse(VecDeriv& dx) const {
    if (active)
      for (const int i : indices) dx[std::size_t(i)].setZero();
  }
  template <class Sink>
  void projectMatrix(Sink const& sink) const {
    if (active)
      for (const int i : indices) sink.fix(i);
  }

  void projectPosition(double time, VecCoord& x) {
    active = movement().moves(time);
    if (!movement().given(time)) return;
    const KeyInterval key = key_interval(keyTimes, time);
    const Deriv m = movements[key.first] * Real(1 - key.part) + movements[key.first + 1] * Real(key.part);
    for (std::size_t k = 0; k < indices.size(); ++k) {
      Coord& place = x[std::size_t(indices[k])];
      place = start[k];
      if constexpr (rotates) {
        place.center += m.template head<3>();
        place.orientation = place.orientation * orientations[key.first].orientation.slerp(
                                                    Real(key.part), orientations[key.first + 1].orientation);
      } else {
        D::increment(place, m);
      }
    }
  }

  void projectVelocity(double time, VecDeriv& v) {
    active = movement().moves(time);
    if (!movement().given(time)) return;
    const KeyInterval key = key_interval(keyTimes, time);
    Deriv rate = (movements[key.first + 1] - movements[key.first]) / Real(key.length);
    for (std::size_t k = 0; k < indices.size(); ++k) {
      if constexpr (rotates) {
        const Deriv angularRate =
            D::difference(orientations[key.first], orientations[key.first + 1]) / Real(key.length);
        rate.template tail<3>() = start[k].orientation * angularRate.template tail<3>();
      }
      v[std::size_t(indices[k])] = rate;
    }
  }

 private:
  MovementTime movement() const { return {keyTimes.front(), keyTimes.back()}; }
};

}  // namespace sinew
