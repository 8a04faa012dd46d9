// SPDX-License-Identifier: BSL-1.0
#pragma once

#include "catch.hpp"
#include "collision/simplex_pairs.hpp"

#include <sinew/collision/time_of_impact.hpp>

#include <algorithm>
#include <limits>
#include <vector>

/// Motions with a contact at a known time.
namespace known_contacts {

using namespace sinew;
using namespace simplex_pairs;

using Long = long double;
using V = Vec<double, 3>;

template <class Real, std::size_t NA, std::size_t NB>
struct Motion {
  Simplex<Real, NA> a0, a1;
  Simplex<Real, NB> b0, b1;

  template <std::size_t N>
  static std::array<V3<Long>, N> place(Simplex<Real, N> const& from, Simplex<Real, N> const& to,
                                       Vec<Real, 3> const& origin, Long t) {
    const auto p = simplex_pairs::to<Long>(from, origin), q = simplex_pairs::to<Long>(to, origin);
    std::array<V3<Long>, N> x;
    for (std::size_t i = 0; i < N; ++i) x[i] = p[i] + (q[i] - p[i]) * t;
    return x;
  }
  auto atA(Long t) const { return place<NA>(a0, a1, a0[0], t); }
  auto atB(Long t) const { return place<NB>(b0, b1, a0[0], t); }
  Long distance(Long t) const { return std::sqrt(brute_squared_distance(atA(t), atB(t))); }
  /// The documented error of the distance at the time found.
  Long sigma(Long thickness, Long relativeGap) const {
    Long size = 0, extent = thickness;
    auto extend = [&](auto const& p, auto const& q) {
      for (std::size_t i = 0; i < p.size(); ++i)
        for (int k = 0; k < 3; ++k) {
          size = std::max({size, std::abs(Long(p[i][k]) - a0[0][k]), std::abs(Long(q[i][k]) - p[i][k])});
          extent = std::max(extent, std::abs(Long(p[i][k]) - p[0][k]));
        }
    };
    extend(a0, a1);
    extend(b0, b1);
    const Long start = distance(0) - thickness;
    return std::max(relativeGap * (extent > 0 ? std::min(start, extent) : start),
                    32 * Long(std::numeric_limits<Real>::epsilon()) * size);
  }
};

struct Counts {
  int late = 0, missed = 0, early = 0, inside = 0, slow = 0, zero = 0, hits = 0, meet = 0;
};

/// Pairs that touch at a known time, or pass within the thickness of each other: made of a touching pair of
/// every kind and of velocities from 1e-3 to 1e6 sizes a step.
template <class Real, std::size_t NA, std::size_t NB>
Counts count_contacts(int pairs) {
  PairMaker<Real, NA, NB> maker{std::mt19937_64(1000 + NA * 10 + NB)};
  Counts n;
  Simplex<Real, NA> a;
  Simplex<Real, NB> b;
  for (int i = 0; i < pairs; ++i) {
    maker.make(a, b);
    const Real thickness = i % 3 == 0 ? Real(0) : Real(std::pow(10.0, maker.uniform(-4, 0)));
    const auto c = closest_points(a, b);
    const V gap = (c.pointB - c.pointA).template cast<double>();
    V sideways = maker.vector();
    sideways *= double(thickness) * maker.uniform(0, 0.999999) / sideways.norm();
    const double time = maker.uniform(0.01, 0.99);
    const double speed = std::pow(10.0, maker.uniform(-3, 6)),
                 rotation = i % 2 ? std::pow(10.0, maker.uniform(-3, 0.5)) : 0;
    const V velocity = speed * maker.vector();
    Motion<Real, NA, NB> m;
    auto move = [&](auto const& p, V const& shift, V const& v, auto& p0, auto& p1) {
      for (std::size_t k = 0; k < p.size(); ++k) {
        const V x = p[k].template cast<double>() + shift, u = v + rotation * maker.vector();
        p0[k] = (x - time * u).template cast<Real>();
        p1[k] = (x + (1 - time) * u).template cast<Real>();
      }
    };
    move(a, gap, i % 5 ? V(0, 0, 0) : velocity, m.a0, m.a1);
    move(b, sideways, i % 5 ? velocity : V(0, 0, 0), m.b0, m.b1);

    const auto found = time_of_impact(m.a0, m.a1, m.b0, m.b1, thickness);
    const Long sigma = m.sigma(thickness, 1e-3L);
    // the rounded places and velocities meet nearly; steps aim at sigma / 2 with room for rounding
    const bool meets = m.distance(time) <= thickness + sigma / 4;
    n.meet += meets;
    n.missed += meets && !found;
    if (!found) continue;
    ++n.hits;
    n.late += meets && !(Long(*found) <= Long(time));
    const Long d = m.distance(*found);
    if (*found == 0) {
      // contact there already, but for rounding
      ++n.zero;
      n.early += d > thickness + 1.125L * sigma;
    } else {
      n.inside += d <= thickness;
      if (d > thickness + 1.125L * sigma) {
        // the bound on the number of steps
        const auto longer = time_of_impact(m.a0, m.a1, m.b0, m.b1, thickness, Real(1e-3), 100000);
        ++(longer != found ? n.slow : n.early);
      }
    }
  }
  return n;
}

template <class Real, std::size_t NA, std::size_t NB>
void check_known(int pairs) {
  const Counts n = count_contacts<Real, NA, NB>(pairs);
  INFO(NA << " and " << NB << " points: " << n.hits << " hits, " << n.zero << " at 0, slow " << n.slow);
  CHECK(n.meet > pairs - pairs / 20);
  CHECK(n.missed == 0);
  CHECK(n.late == 0);
  CHECK(n.early == 0);
  CHECK(n.inside == 0);
  CHECK(n.slow <= pairs / 1000);
  CHECK(n.zero < pairs / 2);
}

}  // namespace known_contacts
