// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/core/assembly.hpp>
#include <sinew/core/element_driver/pack.hpp>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <type_traits>
#include <utility>
#include <vector>

namespace sinew {

namespace detail {

// f(i, j) for each pair of points i <= j of so many: constants, each with code of its own, where these are
// few
template <int Arity, class F>
void for_each_pair(F&& f) {
  if constexpr (Arity > 8) {
    for (int i = 0; i < Arity; ++i)
      for (int j = i; j < Arity; ++j) f(i, j);
  } else {
    [&]<int... P>(std::integer_sequence<int, P...>) {
      (
          [&] {
            constexpr int i = P / Arity, j = P % Arity;
            if constexpr (i <= j) f(std::integral_constant<int, i>{}, std::integral_constant<int, j>{});
          }(),
          ...);
    }(std::make_integer_sequence<int, Arity * Arity>{});
  }
}
// whether two such numbers are known to be one
template <class I, class J>
inline constexpr bool same_point = !std::is_integral_v<I> && std::is_same_v<I, J>;
template <int Arity>
constexpr int pair_number(int i, int j) {
  return i * Arity - i * (i - 1) / 2 + j - i;
}

// to += block or its transpose, row-major; vectors are made of scalars in registers, since what is written
// scalar by scalar cannot be read back at once as a vector
template <int N, class Target, class Block>
SINEW_INLINE void add_scalars(Target* to, Block const& block, bool isTransposed) {
  auto entry = [&](int r, int c) { return isTransposed ? block(c, r) : block(r, c); };
#if !defined(__CUDACC__)
  if constexpr (N == 3 && std::is_same_v<Target, typename Block::Scalar>) {
    typedef Target Four __attribute__((vector_size(4 * sizeof(Target))));
    const Four more[2] = {{entry(0, 0), entry(0, 1), entry(0, 2), entry(1, 0)},
                          {entry(1, 1), entry(1, 2), entry(2, 0), entry(2, 1)}};
    for (int i = 0; i < 2; ++i) {
      Four sum;
      std::memcpy(&sum, to + 4 * i, sizeof sum);
      sum += more[i];
      std::memcpy(to + 4 * i, &sum, sizeof sum);
    }
    to[8] += entry(2, 2);
    return;
  }
#endif
  for (int r = 0; r < N; ++r)
    for (int c = 0; c < N; ++c) to[r * N + c] += entry(r, c);
}

// the block of each lane, or its transpose, row-major as the matrix has it
template <bool Symmetric, int N, class L, class Real, std::size_t W, std::size_t Size>
SINEW_INLINE void separate(Mat<L, N> const& block, std::uint16_t transposed, Real (&ofLane)[W][Size]) {
  const auto isTransposed = lanes_of_bits<L>(transposed);
  L rows[std::size_t(N * N)];
  for (int r = 0; r < N; ++r)
    for (int c = 0; c < N; ++c)
      rows[r * N + c] =
          Symmetric || r == c ? block(r, c) : select(isTransposed, L(block(c, r)), L(block(r, c)));
  transpose<N * N>(rows, ofLane);
}

}  // namespace detail

/// Where the blocks of a pack stand in the matrix of the solver: the slot of the one on or above the
/// diagonal, and, a bit for each lane, whether it is the transpose of the law's block(i, j).
template <int Pairs, int W>
struct ElementSlots {
  static_assert(W <= 16);
  int slot[std::size_t(Pairs)][std::size_t(W)];
  std::uint16_t transposed[std::size_t(Pairs)];

  void set(int pair, int lane, bool isTransposed) {
    transposed[pair] = std::uint16_t((transposed[pair] & ~(1 << lane)) | isTransposed << lane);
  }
  /// `first`: the number of the block of the body's first point.
  template <class Pack, class Matrix>
  void bind(Pack const& pack, int first, Matrix& matrix) {
    detail::for_each_pair<Pack::arity>([&](auto i, auto j) {
      const int pair = detail::pair_number<Pack::arity>(i, j);
      for (int l = 0; l < W; ++l) {
        const int a = first + pack.index[i][l], b = first + pack.index[j][l];
        slot[pair][l] = matrix.slot(std::min(a, b), std::max(a, b));
        set(pair, l, a > b);
      }
    });
  }
  void take(int lane, ElementSlots const& from, int fromLane) {
    for (int p = 0; p < Pairs; ++p) {
      slot[p][lane] = from.slot[p][fromLane];
      set(p, lane, from.transposed[p] >> fromLane & 1);
    }
  }
};

namespace detail {

// the block of points i and j of each element of a pack, and its transpose, to any sink
template <int SideI, int SideJ, int N, class Law, class Sink, class Pack>
void add_pair(Law const& law, Sink const& sink, Pack const& pack, int i, int j, typename Pack::Real k,
              typename Pack::Real b) {
  using Real = typename Pack::Real;
  using L = typename Pack::L;
  Mat<L, N> block;
  if constexpr (Sink::phase == AssemblyPhase::add)
    block = law.block(pack.rest, pack.tangent, i, j, L(k), L(b));
  for (int l = 0; l < pack.active; ++l) {
    Mat<Real, N> one = Mat<Real, N>::Zero();
    if constexpr (Sink::phase == AssemblyPhase::add)
      for (int c = 0; c < N * N; ++c) one(c) = lane(block(c), l);
    sink.template add<SideI, SideJ>(pack.index[i][l], pack.index[j][l], one);
    if (i != j) sink.template add<SideJ, SideI>(pack.index[j][l], pack.index[i][l], one.transpose().eval());
  }
}

// all blocks of elements whose point i is on the end Sides[i]
template <int... Side>
constexpr int side_of(std::integer_sequence<int, Side...>, int i) {
  constexpr int sides[]{Side...};
  return sides[i];
}
template <class Sides, int N, class Law, class Sink, class Pack, class Real>
void add_between(Law const& law, Sink const& sink, Pack const& pack, Real k, Real b) {
  for_each_pair<Pack::arity>([&]<class I, class J>(I i, J j) {
    add_pair<side_of(Sides{}, I::value), side_of(Sides{}, J::value), N>(law, sink, pack, i, j, k, b);
  });
}

// all blocks of an element that is alone in its pack, to their slots
template <int N, class Law, class Pack, class Slots, class Matrix, class Real>
void add_blocks_of_one(Law const& law, Pack const& pack, Slots const& slots, Matrix& matrix, Real k, Real b) {
  for_each_pair<Pack::arity>([&](auto i, auto j) {
    const int pair = pair_number<Pack::arity>(i, j);
    add_scalars<N>(matrix.block(slots.slot[pair][0]),
                   law.block(pack.rest, pack.tangent, i, j, k, b),
                   i != j && slots.transposed[pair] != 0);
  });
}

}  // namespace detail

}  // namespace sinew
