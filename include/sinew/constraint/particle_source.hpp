// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/constraint/constrained_points.hpp>
#include <sinew/core/memory_limit.hpp>
#include <sinew/core/point_change.hpp>

#include <algorithm>
#include <cstdint>
#include <vector>

namespace sinew {

/// A source of particles, as in SOFA's plugin SofaSphFluid: at t_k = max(start, delay) + k delay, up to
/// `stop`, one comes at each centre,
///   x = scale center + translation + noise,   v = velocity,
/// and is at the start of the first step after t_k where it has moved to since. Each coordinate of the noise
/// is even from 0 to that of `radius`, the same in each run; without it (addNoise="false") particles are
/// moved by `radius`. The newest go on with `velocity`, whatever pushes them, like a piston that the others
/// leave: each time that more come, half of those held are let go, the oldest first, and all of them at
/// `stop`. A state may start without points. It has `capacity` of them at most, for which room is made at
/// init, so that a step allocates nothing; one more is an error. A reset takes the state back to the points
/// that it started with.
template <class D>
struct ParticleSource {
  static_assert(!D::rigid && D::size == D::spatial,
                "Sinew: a ParticleSource makes points; take Vec3d, Vec3f, Vec2d, Vec2f, Vec1d or Vec1f.");
  using Role = role::ProjectiveConstraint;
  using DataTypes = D;
  using Real = typename D::Real;
  using Coord = typename D::Coord;
  using Deriv = typename D::Deriv;
  using VecCoord = typename D::VecCoord;
  using VecDeriv = typename D::VecDeriv;
  static constexpr std::string_view className = "ParticleSource";

  Coord translation = D::zero();
  double scale = 1;
  VecCoord center = VecCoord(1, D::zero());
  Coord radius = D::zero();
  Deriv velocity = Deriv::Zero();
  double delay = 0.01, start = 0, stop = 1e10;
  bool addNoise = true;
  int capacity = 10000;

  static constexpr auto fields() {
    using S = ParticleSource;
    return field_list(
        field("translation", &S::translation, "m", "moves the centres"),
        field("scale", &S::scale, "", "stretches the centres, before they are moved"),
        field("center", &S::center, "m", "where particles come, one at each place"),
        field("radius", &S::radius, "m", "how far noise moves a particle at most, along each axis"),
        field("velocity", &S::velocity, "m/s", "of the particles that come"),
        field("delay", &S::delay, "s", "time from one particle at a centre to the next", range::positive),
        field("start", &S::start, "s", "time of the first; no earlier than after one delay"),
        field("stop", &S::stop, "s", "time after which none comes"),
        field("addNoise", &S::addNoise, "", "particles come at random around the centres"),
        field("capacity",
              &S::capacity,
              "",
              "how many points the state may have, those that it starts with counted",
              range::positive));
  }

  // for checkpoints
  int batches = 0;          // that have come: so many particles at each centre
  std::vector<int> held{};  // points that go on with `velocity`
  static constexpr auto state() {
    using S = ParticleSource;
    return field_list(
        field("batches", &S::batches, "", "how many have come at each centre", range::nonNegative),
        field("held", &S::held, "", "points that go on with the velocity of the source", range::nonNegative));
  }

  std::string where{};
  /// In the step that begins: where the first of those that come will stand, and how many batches there are.
  struct Coming {
    int first = 0, batches = 0;
    bool stopped = false;
  };
  Coming coming{};

  void init(InitContext<D> const& context) {
    where = place_of<ParticleSource>(context);
    if (center.empty()) throw Error(where, "center is empty; give the places where particles come");
    if (addNoise && (radius.array() < Real(0)).any())
      throw Error(where, "radius has a negative coordinate; noise moves by 0 to radius along each axis");
    if (velocity.isZero(0) && (!addNoise || radius.isZero(0)))
      throw Error(where,
                  "velocity is 0 and so is the radius of the noise: each particle would come where the one "
                  "before is; give one of them");
    if (stop < start)
      throw Error(
          where,
          text("stop is ", stop, " s and start ", start, " s, so that none comes; put stop behind start"));
    if (context.rest.size() > std::size_t(capacity))
      throw Error(where,
                  text("the state starts with ",
                       context.rest.size(),
                       " points, and capacity is ",
                       capacity,
                       "; raise it above that by what is to come"));
    check_memory(where, text("room for ", capacity, " points (capacity)"), capacity);
    check_points(where, "held", held, context.rest.size());
    held.reserve(2 * center.size());
  }

  void changePoints(StepAhead const& ahead, VecCoord const& x, PointChange<D>& change) {
    if (ahead.step == 1) reset();
    coming = {.first = int(x.size() + change.positions.size())};
    // times of steps are sums, and miss a time by rounding
    const double rounding = 1e-3 * ahead.dt, first = std::max(start, delay);
    for (int batch = batches; first + batch * delay <= std::min(ahead.begin, stop) + rounding; ++batch) {
      if (change.size() + center.size() > std::size_t(capacity))
        throw Error(where,
                    text("the state has ",
                         change.size(),
                         " points at ",
                         ahead.begin,
                         " s and ",
                         center.size(),
                         " more come, above the capacity of ",
                         capacity,
                         "; raise capacity, give an earlier stop, or let a ParticleSink take points away"));
      const Deriv moved = velocity * Real(ahead.begin - (first + batch * delay));
      for (std::size_t c = 0; c < center.size(); ++c)
        change.add(center[c] * Real(scale) + translation + around(batch, c) + moved, velocity);
      ++coming.batches;
    }
    coming.stopped = ahead.begin > stop + rounding;
  }
  /// Those that changePoints has announced have come.
  void acceptPoints() {
    int next = coming.first;
    for (int k = 0; k < coming.batches; ++k) {
      held.erase(held.begin(), held.end() - std::ptrdiff_t(held.size() / 2));
      for (std::size_t c = 0; c < center.size(); ++c) held.push_back(next++);
    }
    batches += coming.batches;
    if (coming.stopped) held.clear();
    coming = {};
  }
  void followPoints(Renumbering const& points, std::size_t) {
    const auto before = int(points.now.size()), stayed = int(points.kept.size());
    std::size_t stay = 0;
    for (const int i : held)
      if (i >= before)
        held[stay++] = i - before + stayed;  // what has just come
      else if (points.stays(i))
        held[stay++] = points.now[std::size_t(i)];
    held.resize(stay);
  }
  void reset() {
    batches = 0;
    held.clear();
  }

  void projectResponse(VecDeriv& dx) const {
    for (const int i : held) dx[std::size_t(i)].setZero();
  }
  template <class Sink>
  void projectMatrix(Sink const& sink) const {
    for (const int i : held) sink.fix(i);
  }

 private:
  Coord around(int batch, std::size_t c) const {
    if (!addNoise) return radius;
    Coord noise = radius;
    for (int k = 0; k < D::size; ++k)
      noise[k] *=
          even((std::uint64_t(batch) * center.size() + c) * std::uint64_t(D::size) + std::uint64_t(k));
    return noise;
  }
  // of a sequence of numbers even in [0, 1) (Steele, Lea, Flood 2014: SplitMix64), one of them
  static Real even(std::uint64_t place) {
    std::uint64_t z = (place + 1) * 0x9e3779b97f4a7c15u;
    z = (z ^ z >> 30) * 0xbf58476d1ce4e5b9u;
    z = (z ^ z >> 27) * 0x94d049bb133111ebu;
    return Real((z ^ z >> 31) >> 40) * Real(0x1p-24);
  }
};

}  // namespace sinew
