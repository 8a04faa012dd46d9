// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/core/data_types.hpp>
#include <sinew/core/lanes.hpp>
#include <sinew/core/mesh.hpp>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstring>
#include <vector>

namespace sinew {

/// A point as a weighted sum of four others; where they are fewer, the last weights are zero.
template <class Weight>
struct Carrier {
  std::array<Index, 4> points;
  std::array<Weight, 4> weights;
};

/// The loops of a mapping whose points are carried by elements of the parent: carriers[i] has the first four
/// points of the element of point i, and others[i], where there are hexahedra, the other four.
///   x = sum_k w_k X_k      F_k += w_k f
/// Here both states are in the memory of the host; DataTypes whose vectors are elsewhere bring their own
/// loops, of which ask() begins what apply(), called next with the same arguments, brings from there.
///
/// Points that one element carries, one behind the other in their numbers, as many as fill lanes, are a run:
///   x = X_0 + sum_k w_k (X_k - X_0)
/// with the corners of the element in registers. Weights are kept by corners, in the child's precision; that
/// of the first corner is what others leave of 1.
template <class In, class Out>
struct CarriedPoints {
  using Real = typename Out::Real;
  using Weight = typename In::Real;
  using Carriers = std::vector<Carrier<Weight>>;
  static constexpr int W = native_width<Real>;
  static constexpr std::size_t minimum = W, minimumTransposed = 2 * W;  // points of which a run is faster
  static constexpr bool possible = W >= 4;

  struct Run {
    std::array<Index, 8> corners;
    int count = 0;  // of corners, 4 or 8
    std::size_t first, end;
    std::size_t weights;  // where they begin: those of all points for the second corner, and so on
  };
  std::vector<Run> runs{};
  std::vector<Real> weights{};

  void init(std::size_t /*parents*/, Carriers const& carriers, Carriers const& others) {
    runs.clear(), weights.clear();
    if constexpr (possible) {
      const int count = others.empty() ? 4 : 8;
      auto part = [&](std::size_t i, int k) -> auto const& { return (k < 4 ? carriers : others)[i]; };
      auto corner = [&](std::size_t i, int k) { return part(i, k).points[std::size_t(k % 4)]; };
      for (std::size_t first = 0, end; first < carriers.size(); first = end) {
        auto same = [&](std::size_t i) {
          for (int k = 0; k < count; ++k)
            if (corner(i, k) != corner(first, k)) return false;
          return true;
        };
        for (end = first + 1; end < carriers.size() && same(end);) ++end;
        if (end - first < minimum) continue;
        Run run{{}, count, first, end, weights.size()};
        for (int k = 0; k < count; ++k) run.corners[std::size_t(k)] = corner(first, k);
        for (int k = 1; k < count; ++k)
          for (std::size_t i = first; i < end; ++i)
            weights.push_back(Real(part(i, k).weights[std::size_t(k % 4)]));
        runs.push_back(run);
      }
    }
  }

  void ask(typename Out::VecDeriv const&, typename In::VecDeriv const&) const {}
  void apply(typename Out::VecDeriv& out, typename In::VecDeriv const& in, Carriers const& carriers,
             Carriers const& others) const {
    Weight const* const x = in.data()->data();
    forEachRun(
        carriers.size(),
        minimum,
        [&](Run const& run) { interpolate(run, out, in); },
        [&](std::size_t i) {
          auto sum = [x](Carrier<Weight> const& c, int k) {
            return c.weights[0] * x[3 * c.points[0] + k] + c.weights[1] * x[3 * c.points[1] + k] +
                   c.weights[2] * x[3 * c.points[2] + k] + c.weights[3] * x[3 * c.points[3] + k];
          };
          Weight place[3];
          for (int k = 0; k < 3; ++k) place[k] = sum(carriers[i], k);
          if (!others.empty())
            for (int k = 0; k < 3; ++k) place[k] += sum(others[i], k);
          for (int k = 0; k < 3; ++k) out[i][k] = Real(place[k]);
        });
  }
  void applyJT(typename In::VecDeriv& in, typename Out::VecDeriv const& out, Carriers const& carriers,
               Carriers const& others) const {
    forEachRun(
        carriers.size(),
        minimumTransposed,
        [&](Run const& run) { collect(run, in, out); },
        [&](std::size_t i) {
          auto add = [&](Carrier<Weight> const& c) {
            for (std::size_t k = 0; k < 4; ++k)
              in[std::size_t(c.points[k])] += c.weights[k] * out[i].template cast<Weight>();
          };
          add(carriers[i]);
          if (!others.empty()) add(others[i]);
        });
  }

 private:
  // the runs of at least so many points, and the points between them
  template <class OfRun, class OfPoint>
  SINEW_INLINE void forEachRun(std::size_t points, std::size_t atLeast, OfRun&& ofRun,
                               OfPoint&& ofPoint) const {
    std::size_t i = 0;
    for (auto run = runs.begin();; ++run) {
      while (run != runs.end() && run->end - run->first < atLeast) ++run;
      const bool last = run == runs.end();
      for (const std::size_t end = last ? points : run->first; i < end; ++i) ofPoint(i);
      if (last) return;
      ofRun(*run);
      i = run->end;
    }
  }

  [[gnu::noinline]] void interpolate(Run const& run, typename Out::VecDeriv& out,
                                     typename In::VecDeriv const& in) const {
    if constexpr (possible) {
      if (run.count == 4)
        interpolate<4>(run, out, in);
      else
        interpolate<8>(run, out, in);
    }
  }
  [[gnu::noinline]] void collect(Run const& run, typename In::VecDeriv& in,
                                 typename Out::VecDeriv const& out) const {
    if constexpr (possible) {
      if (run.count == 4)
        collect<4>(run, in, out);
      else
        collect<8>(run, in, out);
    }
  }

  template <int N>
  void interpolate(Run const& run, typename Out::VecDeriv& out, typename In::VecDeriv const& in) const {
    using L = lanes<Real>;
    auto const& origin = in[std::size_t(run.corners[0])];
    L first[3], edges[std::size_t(N) - 1][3];
    for (int c = 0; c < 3; ++c) first[c] = L(Real(origin[c]));
    for (std::size_t k = 1; k < N; ++k)
      for (int c = 0; c < 3; ++c) edges[k - 1][c] = L(Real(in[std::size_t(run.corners[k])][c] - origin[c]));
    const std::size_t n = run.end - run.first;
    Real const* const w = weights.data() + run.weights;
    Real* const to = out[run.first].data();
    // the last points once more with those before them where they fill no lanes: the same bits
    for (std::size_t i = 0; i < n; i += W) {
      const std::size_t from = std::min(i, n - W);
      L sum[3] = {first[0], first[1], first[2]};
      for (std::size_t k = 0; k < N - 1; ++k) {
        const L weight = load(w + k * n + from);
        for (int c = 0; c < 3; ++c) sum[c] += weight * edges[k][c];
      }
      store3(sum, to + 3 * from);
    }
  }

  // f_k = sum_i w_ik f_i for the corners but the first, which receives what is left of the sum of all
  template <int N>
  void collect(Run const& run, typename In::VecDeriv& in, typename Out::VecDeriv const& out) const {
    using L = lanes<Real>;
    L sums[std::size_t(N)][3];
    for (auto& sum : sums)
      for (L& component : sum) component = L(0);
    const std::size_t n = run.end - run.first;
    Real const* const w = weights.data() + run.weights;
    for (std::size_t i = 0; i < n; i += W) {
      const std::size_t from = std::min(i, n - W);
      L f[3];
      load3(out[run.first + from].data(), f);
      for (std::size_t l = 0; l < i - from; ++l)
        for (L& component : f) component.set(int(l), Real(0));
      for (int c = 0; c < 3; ++c) sums[0][c] += f[c];
      for (std::size_t k = 1; k < N; ++k) {
        const L weight = load(w + (k - 1) * n + from);
        for (int c = 0; c < 3; ++c) sums[k][c] += weight * f[c];
      }
    }
    for (int c = 0; c < 3; ++c) {
      typename In::Real rest = 0;
      for (std::size_t k = N; k-- > 0;) {
        const typename In::Real sum = total(sums[k][c]);
        if (k > 0) rest += sum;
        in[std::size_t(run.corners[k])][c] += k > 0 ? sum : sum - rest;
      }
    }
  }

  // by halves
  SINEW_INLINE static Real total(lanes<Real> all) {
    Real parts[std::size_t(W)];
    std::memcpy(parts, &all.v, sizeof parts);
#pragma GCC unroll 8
    for (int half = W / 2; half > 0; half /= 2)
#pragma GCC unroll 8
      for (int l = 0; l < half; ++l) parts[l] += parts[l + half];
    return parts[0];
  }

  SINEW_INLINE static lanes<Real> load(Real const* from) {
    lanes<Real> to;
    std::memcpy(&to.v, from, sizeof to.v);
    return to;
  }
};

}  // namespace sinew
