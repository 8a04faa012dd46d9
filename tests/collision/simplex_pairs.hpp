// SPDX-License-Identifier: BSL-1.0
#pragma once

#include "catch.hpp"

#include <sinew/collision/closest_points.hpp>

#include <array>
#include <cmath>
#include <cstddef>
#include <random>

/// Random pairs of simplices of every awkward kind, and answers found in other ways than the library's.
namespace simplex_pairs {

using sinew::Simplex;
using sinew::Vec;

constexpr int manyPairs = brief ? 30000 : 1000000;

enum Kind {
  general,
  nearlyParallel,
  parallel,
  coplanar,
  touching,
  nearlyTouching,
  degenerate,
  needles,
  integers,
  scaleRatio,
  farAway,
  kindCount
};

/// Points of doubles; for float they are rounded.
template <class Real, std::size_t NA, std::size_t NB>
struct PairMaker {
  using V = Vec<double, 3>;
  std::mt19937_64 engine;

  double uniform(double low = -1, double high = 1) {
    return low + (high - low) * double(engine() >> 11) * 0x1p-53;
  }
  int whole(int low, int high) { return low + int(engine() % std::uint64_t(high - low + 1)); }
  double small() { return std::pow(10.0, -uniform(0, 17)); }
  V vector() { return V(uniform(), uniform(), uniform()); }
  template <std::size_t N>
  std::array<V, N> cloud(V const& center) {
    std::array<V, N> p;
    for (V& x : p) x = center + vector();
    return p;
  }
  /// Of a vertex, the inside of an edge, or the inside.
  template <std::size_t N>
  V inside(std::array<V, N> const& p) {
    std::array<double, N> w{};
    double sum = 0;
    const std::size_t keep = 1 + engine() % N;
    for (std::size_t i = 0; i < keep; ++i) sum += w[i] = uniform(0.05, 1);
    const std::size_t rotation = engine() % N;
    V x = V::Zero();
    for (std::size_t i = 0; i < N; ++i) x += (w[(i + rotation) % N] / sum) * p[i];
    return x;
  }
  template <std::size_t N>
  void flatten(std::array<V, N>& p, double height) {
    if constexpr (N == 3) p[2] = p[0] + uniform(-0.5, 1.5) * (p[1] - p[0]) + height * vector();
    if constexpr (N == 2) p[1] = p[0] + height * vector();
  }

  Kind make(Simplex<Real, NA>& outA, Simplex<Real, NB>& outB) {
    const Kind kind = Kind(engine() % kindCount);
    auto a = cloud<NA>(V::Zero());
    auto b = cloud<NB>(uniform(0, 2) * vector());
    double scale = 1;
    V shift = V::Zero();
    // b's edges out of those of a, which two cases need
    auto along = [&](double noise) {
      for (std::size_t j = 1; j < NB; ++j) {
        V e = V::Zero();
        for (std::size_t i = 1; i < NA; ++i) e += double(whole(-3, 3)) / 2 * (a[i] - a[0]);
        b[j] = b[0] + e + noise * vector();
      }
    };
    switch (kind) {
      case nearlyParallel:
        along(small());
        break;
      case parallel:
        for (auto& x : a) x = (x * 256).array().round() / 256;  // sums of these are exact
        for (auto& x : b) x = (x * 256).array().round() / 256;
        along(0);
        break;
      case coplanar:
        if (engine() % 2) {
          for (auto& x : a) x[2] = 0.25;
          for (auto& x : b) x[2] = engine() % 8 ? 0.25 : 0.25 + 1e-3;
        } else {
          for (auto& x : a) x = V(x[0], x[1], x[0] + x[1]);
          for (auto& x : b) x = V(x[0], x[1], x[0] + x[1]);
        }
        break;
      case touching:
      case nearlyTouching: {
        if (engine() % 4 == 0) flatten(a, small());
        if (engine() % 4 == 0) flatten(b, small());
        const V move = inside(a) - inside(b) + (kind == touching ? 0.0 : small()) * vector();
        for (auto& x : b) x += move;
        break;
      }
      case degenerate:
        if (engine() % 2) flatten(a, 0);
        if (engine() % 2) flatten(b, 0);
        if (NA == 3 && engine() % 3 == 0) a[NA - 1] = a[engine() % NA];
        if (NB == 3 && engine() % 3 == 0) b[NB - 1] = b[engine() % NB];
        if (engine() % 8 == 0) a.fill(a[0]);
        if (engine() % 8 == 0) b.fill(b[0]);
        if (engine() % 2) {
          const V move = inside(a) - inside(b);
          for (auto& x : b) x += move;
        }
        break;
      case needles:
        flatten(a, small());
        if (engine() % 2) flatten(b, small());
        break;
      case integers:
        for (auto& x : a) x = V(whole(-4, 4), whole(-4, 4), whole(-4, 4));
        for (auto& x : b) x = V(whole(-4, 4), whole(-4, 4), whole(-4, 4));
        break;
      case scaleRatio: {
        const double ratio = std::pow(10.0, uniform(-6, 6));
        const V at = inside(a);
        for (auto& x : b) x = at + ratio * x;
        scale = std::pow(10.0, uniform(-2, 2));
        break;
      }
      case farAway:
        shift = 1000 * vector();
        break;
      default:
        break;
    }
    for (std::size_t i = 0; i < NA; ++i) outA[i] = (scale * (a[i] + shift)).template cast<Real>();
    for (std::size_t i = 0; i < NB; ++i) outB[i] = (scale * (b[i] + shift)).template cast<Real>();
    return kind;
  }
};

/// Vectors of any scalar, __float128 too.
template <class S>
struct V3 {
  S x, y, z;
  V3 operator+(V3 const& o) const { return {x + o.x, y + o.y, z + o.z}; }
  V3 operator-(V3 const& o) const { return {x - o.x, y - o.y, z - o.z}; }
  V3 operator*(S s) const { return {x * s, y * s, z * s}; }
  S dot(V3 const& o) const { return x * o.x + y * o.y + z * o.z; }
};
template <class S, class Real, std::size_t N>
std::array<V3<S>, N> to(Simplex<Real, N> const& p, Vec<Real, 3> const& origin) {
  std::array<V3<S>, N> q;
  for (std::size_t i = 0; i < N; ++i)
    q[i] = {S(p[i][0]) - S(origin[0]), S(p[i][1]) - S(origin[1]), S(p[i][2]) - S(origin[2])};
  return q;
}

/// Square of the distance, as least over all pairs of faces (sets of points I of a, J of b) whose affine
/// hulls are nearest at points inside both: |a_0 - b_0 + D y|^2 least, by orthogonalisation of the columns of
/// D. By Caratheodory's theorem no more than three columns are needed; dependent ones are left to smaller
/// sets.
template <class S, std::size_t NA, std::size_t NB>
S brute_squared_distance(std::array<V3<S>, NA> const& a, std::array<V3<S>, NB> const& b) {
  S minimum = -1;
  for (unsigned setA = 1; setA < (1u << NA); ++setA)
    for (unsigned setB = 1; setB < (1u << NB); ++setB) {
      V3<S> column[4]{};
      bool ofA[4]{};
      int count = 0;
      std::size_t i0 = 0, j0 = 0;
      while (!(setA >> i0 & 1)) ++i0;
      while (!(setB >> j0 & 1)) ++j0;
      if (__builtin_popcount(setA) + __builtin_popcount(setB) > 5) continue;
      for (std::size_t i = i0 + 1; i < NA; ++i)
        if (setA >> i & 1) ofA[count] = true, column[count++] = a[i] - a[i0];
      for (std::size_t j = j0 + 1; j < NB; ++j)
        if (setB >> j & 1) ofA[count] = false, column[count++] = b[j0] - b[j];
      const V3<S> start = a[i0] - b[j0];
      V3<S> q[4]{}, rest = start;
      S r[4][4]{}, y[4]{}, c[4]{};
      bool independent = true;
      for (int k = 0; k < count && independent; ++k) {
        q[k] = column[k];
        for (int pass = 0; pass < 3; ++pass)
          for (int l = 0; l < k; ++l) {
            const S h = q[l].dot(q[k]) / q[l].dot(q[l]);
            r[l][k] = r[l][k] + h;
            q[k] = q[k] - q[l] * h;
          }
        independent = q[k].dot(q[k]) > column[k].dot(column[k]) * S(1e-60);
        if (!independent) break;
        c[k] = -q[k].dot(rest) / q[k].dot(q[k]);
        rest = rest + q[k] * c[k];
      }
      if (!independent) continue;
      S sumA = 0, sumB = 0;
      bool inside = true;
      for (int k = count - 1; k >= 0; --k) {
        y[k] = c[k];
        for (int l = k + 1; l < count; ++l) y[k] = y[k] - r[k][l] * y[l];
        inside = inside && y[k] >= 0;
        (ofA[k] ? sumA : sumB) += y[k];
      }
      if (!inside || sumA > 1 || sumB > 1) continue;
      V3<S> d = start;
      for (int k = 0; k < count; ++k) d = d + column[k] * y[k];
      const S square = d.dot(d);
      if (minimum < 0 || square < minimum) minimum = square;
    }
  return minimum;
}

/// How far a and b are apart along d: a lower bound of their distance, whatever d is.
template <class S, std::size_t NA, std::size_t NB>
S separation(std::array<V3<S>, NA> const& a, std::array<V3<S>, NB> const& b, V3<S> const& d) {
  S low = b[0].dot(d), high = a[0].dot(d);
  for (auto const& x : b) low = std::min(low, x.dot(d));
  for (auto const& x : a) high = std::max(high, x.dot(d));
  return (low - high) / std::sqrt(d.dot(d));
}

}  // namespace simplex_pairs
