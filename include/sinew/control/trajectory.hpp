// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/core/data_types.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <string_view>
#include <vector>

namespace sinew {

/// How a state moves between two keys. linear: along a straight line, and rotating about one axis along the
/// shorter arc (slerp), with constant velocity. cubic: without jumps of the velocity, by cubic Hermite
/// polynomials; orientations by the cumulative cubic of Kim, Kim and Shin (1995). none: it stays at a key
/// until the next.
enum class Interpolation { linear, cubic, none };
inline constexpr std::array<std::string_view, 3> enum_names(Interpolation) {
  return {"linear", "cubic", "none"};
}

/// Positions, and velocities where they are known, of all points of a state at key times. Between them the
/// velocity is that of the movement, or between the velocities given. Before the first and after the last
/// key the state rests there, or all starts again (`loop`): the time between them is a period.
template <class D>
struct Trajectory {
  using Real = typename D::Real;
  using Coord = typename D::Coord;
  using Deriv = typename D::Deriv;

  std::size_t points = 0;
  std::vector<double> times{};        // rising [s]
  typename D::VecCoord positions{};   // key by key
  typename D::VecDeriv velocities{};  // the same; empty where they are not known
  Interpolation interpolation = Interpolation::linear;
  bool loop = false;

  typename D::VecDeriv tangents{};  // after prepare()

  /// Whether a time has a place on the trajectory, and whether the movement goes on after it.
  bool given(double time) const {
    return (loop && moving()) || (time >= times.front() && time <= times.back());
  }
  bool goesOn(double time) const {
    return (loop && moving()) || (time >= times.front() && time < times.back());
  }

  /// What follows from the keys. Tangents at keys without velocities are those of parabolas through three
  /// keys (Catmull-Rom, for uneven times); where a loop closes, over its seam.
  void prepare() {
    tangents.clear();
    if (interpolation != Interpolation::cubic || times.size() < 2) return;
    tangents = velocities;
    if (!tangents.empty()) return;
    const std::size_t last = times.size() - 1;
    const bool closed =
        loop &&
        std::equal(positions.begin(), positions.begin() + std::ptrdiff_t(points), &positions[last * points]);
    for (std::size_t k = 0; k <= last; ++k)
      for (std::size_t i = 0; i < points; ++i) {
        const bool seam = k == 0 || k == last;
        if (seam && !closed) {
          tangents.push_back(slope(k == 0 ? 0 : last - 1, i));
          continue;
        }
        const std::size_t before = k == 0 ? last - 1 : k - 1, after = k == last ? 0 : k;
        const Real h0 = length(before), h1 = length(after);
        const Deriv s0 = slope(before, i), s1 = slope(after, i);
        tangents.push_back((s0 * h1 + s1 * h0) / (h0 + h1));
      }
  }

  void place(double time, typename D::VecCoord& x) const {
    const At at = find(time, false);
    for (std::size_t i = 0; i < points; ++i) x[i] = position(at, i);
  }
  /// `arriving`: at a key the velocity is that of the movement before it, else of that after it.
  void move(double time, bool arriving, typename D::VecDeriv& v) const {
    const At at = find(time, arriving);
    for (std::size_t i = 0; i < points; ++i) v[i] = velocity(at, i);
  }

 private:
  struct At {
    std::size_t key;      // the one before
    double part;          // fraction of the interval to the next, from 0 to 1
    bool rests = false;   // outside of the times
    bool starts = false;  // at the first, from before it
  };

  bool moving() const { return times.size() > 1; }
  Real length(std::size_t key) const { return Real(times[key + 1] - times[key]); }
  Coord const& key(std::size_t k, std::size_t i) const { return positions[k * points + i]; }
  Deriv slope(std::size_t k, std::size_t i) const {
    return D::difference(key(k, i), key(k + 1, i)) / length(k);
  }

  At find(double time, bool arriving) const {
    const double begin = times.front(), end = times.back();
    if (!moving()) return {0, 0, time != begin};
    if (loop && (time < begin || time >= end)) {
      double into = std::fmod(time - begin, end - begin);
      if (into < 0) into += end - begin;
      time = into == 0 && arriving ? end : begin + into;
    }
    if (time <= begin) return {0, 0, time < begin, arriving};
    if (time >= end) return {times.size() - 2, 1, time > end};
    const auto next = arriving ? std::lower_bound(times.begin(), times.end(), time)
                               : std::upper_bound(times.begin(), times.end(), time);
    const auto k = std::size_t(next - times.begin()) - 1;
    return {k, (time - times[k]) / (times[k + 1] - times[k])};
  }

  // a key is itself, bit by bit
  Coord position(At const& at, std::size_t i) const {
    const std::size_t k = at.key;
    if (at.part == 1) return key(k + 1, i);
    if (at.part == 0 || interpolation == Interpolation::none) return key(k, i);
    Coord x = key(k, i);
    const Real u = Real(at.part);
    if (interpolation == Interpolation::linear) {
      D::increment(x, D::difference(x, key(k + 1, i)) * u);
      return x;
    }
    const Cubic c = cubic(k, i);
    const auto b = basis(u);
    for (std::size_t n = 0; n < 3; ++n) D::increment(x, c.increments[n] * b[n]);
    return x;
  }
  Deriv velocity(At const& at, std::size_t i) const {
    const std::size_t k = at.key;
    const Real u = Real(at.part);
    const bool stays = interpolation == Interpolation::none;
    if (at.rests) return Deriv::Zero();
    if (!velocities.empty()) {
      Deriv const& first = velocities[k * points + i];
      if (at.part == 0 || (stays && at.part < 1)) return first;
      Deriv const& second = velocities[(k + 1) * points + i];
      if (at.part == 1) return second;
      if (interpolation == Interpolation::linear) return first * (1 - u) + second * u;
    }
    if (stays || at.starts || !moving()) return Deriv::Zero();
    if (interpolation == Interpolation::linear) return slope(k, i);
    const Cubic c = cubic(k, i);
    const auto b = basis(u), rate = basisRate(u);
    Deriv v = c.increments[0] * rate[0];
    for (std::size_t n = 1; n < 3; ++n) {
      if constexpr (D::rigid && D::spatial == 3) {
        Coord rotation = D::zero();
        D::increment(rotation, c.increments[n] * b[n]);
        v.template tail<3>() = rotation.orientation * Vec<Real, 3>(v.template tail<3>());
      }
      v += c.increments[n] * rate[n];
    }
    return v / length(k);
  }

  // The displacement from a key to the next in three increments: x = x0 (+) b1 w1 (+) b2 w2 (+) b3 w3, where
  // (+) is D::increment, with b = (1 - (1-u)^3, 3 u^2 - 2 u^3, u^3), and velocities w1 and w3 times 3/h at
  // the ends.
  struct Cubic {
    std::array<Deriv, 3> increments;
  };
  Cubic cubic(std::size_t k, std::size_t i) const {
    const Real third = length(k) / 3;
    Cubic c;
    c.increments[0] = tangents[k * points + i] * third;
    c.increments[2] = tangents[(k + 1) * points + i] * third;
    Coord from = key(k, i), to = key(k + 1, i);
    D::increment(from, c.increments[0]);
    D::increment(to, c.increments[2] * Real(-1));
    c.increments[1] = D::difference(from, to);
    return c;
  }
  static std::array<Real, 3> basis(Real u) {
    const Real v = 1 - u;
    return {1 - v * v * v, u * u * (3 - 2 * u), u * u * u};
  }
  static std::array<Real, 3> basisRate(Real u) {
    const Real v = 1 - u;
    return {3 * v * v, 6 * u * v, 3 * u * u};
  }
};

}  // namespace sinew
