// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/core/data_types.hpp>
#include <sinew/core/lanes.hpp>
#include <sinew/core/platform.hpp>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstring>
#include <type_traits>
#include <utility>
#include <vector>

namespace sinew {

namespace detail {

template <int N, class Real>
SINEW_INLINE void add_some(Real* to, Real const* from) {
  typedef Real Some __attribute__((vector_size(N * sizeof(Real))));
  Some sum, more;
  std::memcpy(&sum, to, sizeof sum);
  std::memcpy(&more, from, sizeof more);
  sum += more;
  std::memcpy(to, &sum, sizeof sum);
}
// to[0..N) += from[0..N), four at a time, then two
template <int N, class Target, class Real>
SINEW_INLINE void add_to(Target* to, Real const* from) {
  int i = 0;
  if constexpr (std::is_same_v<Target, Real>) {
    for (; i + 4 <= N; i += 4) add_some<4>(to + i, from + i);
    if (i + 2 <= N) add_some<2>(to + i, from + i), i += 2;
  }
  for (; i < N; ++i) to[i] += Target(from[i]);
}

}  // namespace detail

/// W elements of a law in lanes: the scalars of their Rest interleaved, their tangents, and their points. A
/// pack with fewer elements is filled up with copies of its last one, which are computed and never scattered.
template <template <class> class LawOf, class D, int W>
struct ElementPack {
  using Real = typename D::Real;
  using L = lanes<Real, W>;
  using DL = typename D::template rebind<L>;
  using Law = LawOf<DL>;
  using Rest = typename LawOf<D>::Rest;
  static constexpr int arity = Law::arity;
  template <class Value>
  using OfPoints = Value[std::size_t(arity)];
  template <class Value>
  using OfLanes = Value[std::size_t(W)];
  // an end of an element: the first point of the state that it lives on
  template <class Value>
  using Ends = std::array<Value*, std::size_t(arity)>;
  using Indices = std::array<int, std::size_t(arity)>;
  template <class Value>
  static constexpr int realsOf = int(sizeof(Value) / sizeof(Real));

  typename Law::Rest rest;
  typename Law::Tangent tangent;
  OfPoints<OfLanes<int>> index;
  int active;
  bool hasLast;  // one of the points may be the last of its state: nothing may be read behind it

  /// Takes the elements from `first` on, of which one may have the point `last`.
  template <class Elements, class Rests>
  void fill(Elements const& elements, Rests const& restOf, std::size_t first, int last) {
    static_assert(sizeof(typename Law::Rest) == W * sizeof(Rest),
                  "a law's Rest holds only scalars of its Real");
    constexpr std::size_t reals = sizeof(Rest) / sizeof(Real);
    active = int(std::min<std::size_t>(W, elements.size() - first));
    Real interleaved[reals * W];
    for (int l = 0; l < W; ++l) {
      const std::size_t e = first + std::size_t(std::min(l, active - 1));
      Real one[reals];
      const Rest own = restOf[e];
      std::memcpy(one, &own, sizeof one);
      for (std::size_t r = 0; r < reals; ++r) interleaved[r * W + std::size_t(l)] = one[r];
      for (int k = 0; k < arity; ++k) {
        index[k][l] = elements[e][std::size_t(k)];
        hasLast |= index[k][l] == last;
      }
    }
    std::memcpy(static_cast<void*>(&rest), interleaved, sizeof interleaved);
    std::memset(static_cast<void*>(&tangent), 0, sizeof tangent);
  }
  Indices pointsOf(std::size_t lane) const {
    Indices points;
    for (int k = 0; k < arity; ++k) points[std::size_t(k)] = index[k][lane];
    return points;
  }
  /// The element of a lane becomes that of another pack's; its tangent does not follow.
  void take(std::size_t lane, ElementPack const& from, std::size_t fromLane) {
    for (std::size_t r = 0; r < sizeof(Rest) / sizeof(Real); ++r)
      std::memcpy(reinterpret_cast<char*>(&rest) + (r * W + lane) * sizeof(Real),
                  reinterpret_cast<char const*>(&from.rest) + (r * W + fromLane) * sizeof(Real),
                  sizeof(Real));
    for (int k = 0; k < arity; ++k) index[k][lane] = from.index[k][fromLane];
  }

  /// The values of the points, in lanes.
  template <class Value, class LaneValue>
  SINEW_INLINE void gather(Ends<Value const> const& from, OfPoints<LaneValue>& to) const {
    constexpr int n = realsOf<Value>;
    if constexpr (n == 3 && W >= 4)
      if (!hasLast) {
        for (int k = 0; k < arity; ++k)
          gather3(
              reinterpret_cast<Real const*>(from[std::size_t(k)]), index[k], reinterpret_cast<L*>(&to[k]));
        return;
      }
    if constexpr (W == 1)
      for (int k = 0; k < arity; ++k) to[k] = from[std::size_t(k)][index[k][0]];
    else
      for (int k = 0; k < arity; ++k) {
        OfLanes<Real const*> values;
        for (int l = 0; l < W; ++l)
          values[l] = reinterpret_cast<Real const*>(from[std::size_t(k)] + index[k][l]);
        auto component = [&]<int... Lane>(int c, std::integer_sequence<int, Lane...>)
            __attribute__((always_inline)) {
          reinterpret_cast<L*>(&to[k])[c] = typename L::Vector{values[Lane][c]...};
        };
        [&]<int... C>(std::integer_sequence<int, C...>) __attribute__((always_inline)) {
          (component(C, std::make_integer_sequence<int, W>{}), ...);
        }
        (std::make_integer_sequence<int, n>{});
      }
  }

  /// Adds what the points receive, that of the elements that fill up left out.
  SINEW_INLINE void scatter(OfPoints<typename DL::Deriv>& from, Ends<typename D::Deriv> const& to) const {
    constexpr int n = realsOf<typename D::Deriv>;
    if constexpr (W == 1) {
      for (int k = 0; k < arity; ++k) {
        to[std::size_t(k)][index[k][0]] += from[k];
      }
    } else if constexpr (n == 3 && W >= 4) {
      if (active != W) [[unlikely]]
        for (int k = 0; k < arity; ++k)
          for (int c = 0; c < n; ++c)
            for (int l = active; l < W; ++l) from[k][c].set(l, Real(0));
      [&]<int... K>(std::integer_sequence<int, K...>) __attribute__((always_inline)) {
        (add3(reinterpret_cast<L const*>(&from[K]), reinterpret_cast<Real*>(to[K]), index[K]), ...);
      }
      (std::make_integer_sequence<int, arity>{});
    } else {
      alignas(64) OfPoints<OfLanes<Real[std::size_t(n + 3) / 4 * 4]>> ofLane;
      [&]<int... K>(std::integer_sequence<int, K...>) __attribute__((always_inline)) {
        (transpose<n>(reinterpret_cast<L const*>(&from[K]), ofLane[K]), ...);
      }
      (std::make_integer_sequence<int, arity>{});
      auto add = [&](int k, int l) __attribute__((always_inline)) {
        detail::add_to<n>(reinterpret_cast<Real*>(to[std::size_t(k)] + index[k][l]), ofLane[k][l]);
      };
      for (int k = 0; k < arity; ++k)
        if (active == W)
          for (int l = 0; l < W; ++l) add(k, l);
        else
          for (int l = 0; l < active; ++l) add(k, l);
    }
  }
};

}  // namespace sinew
