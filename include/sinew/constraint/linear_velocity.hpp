// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/constraint/constrained_points.hpp>

#include <array>
#include <vector>

namespace sinew {

/// Points move with a velocity given at key times and linear between them, from their rest positions at the
/// first: x(t) = x_rest + integral of v. Outside of the key times they are free, or go on with the last
/// velocity. `coordinates` chooses coordinates; the angular velocity of a rigid body in space is given as a
/// whole.
template <class D>
struct LinearVelocityConstraint {
  using Role = role::ProjectiveConstraint;
  using DataTypes = D;
  using Real = typename D::Real;
  using Coord = typename D::Coord;
  using Deriv = typename D::Deriv;
  using VecCoord = typename D::VecCoord;
  using VecDeriv = typename D::VecDeriv;
  static constexpr std::string_view className = "LinearVelocityConstraint";
  static constexpr std::string_view aliases = "LinearVelocityProjectiveConstraint";

  std::vector<int> indices{0};
  std::vector<double> keyTimes{0};
  VecDeriv velocities{Deriv::Zero()};
  std::vector<int> coordinates{};
  bool continueAfterEnd = false;

  static constexpr auto fields() {
    using F = LinearVelocityConstraint;
    return field_list(
        field("indices", &F::indices, "", "points that are moved", range::nonNegative).numbersOf(Of::points),
        field("keyTimes", &F::keyTimes, "s", "key times, in rising order"),
        field("velocities", &F::velocities, "m/s", "velocity of the points at each key time"),
        field("coordinates",
              &F::coordinates,
              "",
              "coordinates that are moved; none for all",
              range::nonNegative),
        field("continueAfterEnd", &F::continueAfterEnd, "", "the last velocity stays"));
  }

  VecCoord start{};
  std::array<int, D::size> mask{};  // 1 for each coordinate that is moved
  bool active = false;              // at the end of the last step

  void init(InitContext<D> const& context) {
    check_points<LinearVelocityConstraint>(context, indices);
    check_key_times<LinearVelocityConstraint>(context, keyTimes, velocities.size(), "velocities");
    mask.fill(coordinates.empty() ? 1 : 0);
    for (const int c : coordinates) {
      if (c >= D::size)
        throw Error(
            place_of<LinearVelocityConstraint>(context),
            text("coordinates has ", c, ", but a point has ", D::size, ", numbered from 0; correct it"));
      mask[std::size_t(c)] = 1;
      if constexpr (D::rigid)
        if (c >= D::spatial) std::fill(mask.begin() + D::spatial, mask.end(), 1);
    }
    start.clear();
    for (const int i : indices) start.push_back(context.rest[std::size_t(i)]);
    active = moves(0);
  }

  void projectResponse(VecDeriv& dx) const {
    if (!active) return;
    for (const int i : indices)
      for (int c = 0; c < D::size; ++c)
        if (mask[std::size_t(c)]) dx[std::size_t(i)][c] = 0;
  }
  template <class Sink>
  void projectMatrix(Sink const& sink) const {
    if (active)
      for (const int i : indices) sink.fix(i, mask);
  }

  void projectPosition(double time, VecCoord& x) {
    active = moves(time);
    if (!given(time)) return;
    const Deriv displacement = integral(time);
    for (std::size_t k = 0; k < indices.size(); ++k) {
      Coord& place = x[std::size_t(indices[k])];
      Coord moved = start[k];
      D::increment(moved, displacement);
      if constexpr (D::rigid) {
        for (int c = 0; c < D::spatial; ++c)
          if (mask[std::size_t(c)]) place.center[c] = moved.center[c];
        if (mask[D::spatial]) place.orientation = moved.orientation;
      } else {
        for (int c = 0; c < D::size; ++c)
          if (mask[std::size_t(c)]) place[c] = moved[c];
      }
    }
  }
  void projectVelocity(double time, VecDeriv& v) {
    active = moves(time);
    if (!given(time)) return;
    const Deriv now = velocity(time);
    for (const int i : indices)
      for (int c = 0; c < D::size; ++c)
        if (mask[std::size_t(c)]) v[std::size_t(i)][c] = now[c];
  }

 private:
  // in the step from a time on; at a time
  bool moves(double time) const {
    return time >= keyTimes.front() && (continueAfterEnd || time < keyTimes.back());
  }
  bool given(double time) const {
    return time >= keyTimes.front() && (continueAfterEnd || time <= keyTimes.back());
  }

  Deriv velocity(double time) const {
    if (time >= keyTimes.back()) return velocities.back();
    const KeyInterval key = key_interval(keyTimes, time);
    return velocities[key.first] * Real(1 - key.part) + velocities[key.first + 1] * Real(key.part);
  }
  // from the first key time on; the velocity is linear in pieces, so the rule of trapezia is exact
  Deriv integral(double time) const {
    Deriv sum = Deriv::Zero();
    for (std::size_t k = 0; k + 1 < keyTimes.size() && keyTimes[k] < time; ++k) {
      const double end = std::min(time, keyTimes[k + 1]);
      const Deriv last = end < keyTimes[k + 1] ? velocity(end) : velocities[k + 1];
      sum += (velocities[k] + last) * Real(0.5 * (end - keyTimes[k]));
    }
    if (time > keyTimes.back()) sum += velocities.back() * Real(time - keyTimes.back());
    return sum;
  }
};

}  // namespace sinew
