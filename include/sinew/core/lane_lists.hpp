// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/core/lanes.hpp>

#include <cstddef>
#include <cstring>
#include <type_traits>
#include <vector>

#if defined(__AVX512F__) || defined(__AVX2__)
#include <immintrin.h>
#endif

namespace sinew {

// What goes through lists of numbers in lanes: loads of consecutive ones, of those at places, and lists of
// those for which a comparison holds. Plain scalars are one lane.

/// Four numbers of a particle that are fetched at once.
template <class Real>
struct alignas(4 * sizeof(Real)) FourOf {
  Real of[4];
};

namespace detail {

template <class L, class Number>
struct vector_like {
  using type = Number;
};
#if !defined(__CUDACC__)
template <class T, int W, class Number>
struct vector_like<Lanes<T, W>, Number> {
  typedef Number type __attribute__((vector_size(W * sizeof(Number))));
};
#endif

}  // namespace detail

/// The vector of as many numbers as L has lanes; a plain number where that is one.
template <class L, class Number>
using vector_like = typename detail::vector_like<L, Number>::type;

/// The value, or vector, that stands at `from`.
template <class V, class T>
SINEW_INLINE V load_from(T const* from) {
  static_assert(sizeof(V) % sizeof(T) == 0);
  V value;
  std::memcpy(&value, from, sizeof value);
  return value;
}

/// Bit l is set where lane l of the mask is.
SINEW_INLINE unsigned bits_of(bool mask) { return unsigned(mask); }
#if !defined(__CUDACC__)
template <class T, int W>
SINEW_INLINE unsigned bits_of(LaneMask<T, W> const& mask) {
#if defined(__AVX512DQ__)
  if constexpr (W * sizeof(T) == 64 && sizeof(T) == 4)
    return unsigned(_mm512_movepi32_mask(reinterpret_cast<__m512i>(mask.bits)));
  if constexpr (W * sizeof(T) == 64 && sizeof(T) == 8)
    return unsigned(_mm512_movepi64_mask(reinterpret_cast<__m512i>(mask.bits)));
#endif
#if defined(__AVX2__)
  if constexpr (W * sizeof(T) == 32 && sizeof(T) == 4)
    return unsigned(_mm256_movemask_ps(reinterpret_cast<__m256>(mask.bits)));
  if constexpr (W * sizeof(T) == 32 && sizeof(T) == 8)
    return unsigned(_mm256_movemask_pd(reinterpret_cast<__m256d>(mask.bits)));
#endif
  unsigned bits = 0;
  for (int l = 0; l < W; ++l) bits |= unsigned(mask.bits[l] != 0) << l;
  return bits;
}
#endif

/// Writes those lanes whose bit is set one behind the other. All that a vector takes may be written at `to`.
template <class V, class T>
SINEW_INLINE void write_lanes(V const& values, unsigned bits, T* to) {
#if defined(__AVX512F__)
  if constexpr (sizeof(V) == 64 && sizeof(T) == 4) {
    _mm512_storeu_si512(
        to, _mm512_maskz_compress_epi32(static_cast<__mmask16>(bits), reinterpret_cast<__m512i>(values)));
    return;
  }
#endif
  T each[sizeof(V) / sizeof(T)];
  std::memcpy(each, &values, sizeof values);
  for (T const& value : each) {
    *to = value;
    to += bits & 1;
    bits >>= 1;
  }
}

/// The values at so many places as L has lanes.
template <class L, class T>
SINEW_INLINE L load_at(T const* from, int const* places) {
  constexpr int width = lane_traits<L>::width;
  if constexpr (width == 1) {
    return from[places[0]];
  } else {
#if defined(__AVX512F__)
    if constexpr (width == 8 && sizeof(T) == 8)
      return L(reinterpret_cast<typename L::Vector>(_mm512_mask_i32gather_pd(
          _mm512_setzero_pd(), 0xff, _mm256_loadu_si256(reinterpret_cast<__m256i const*>(places)), from, 8)));
    if constexpr (width == 16 && sizeof(T) == 4)
      return L(reinterpret_cast<typename L::Vector>(_mm512_mask_i32gather_ps(
          _mm512_setzero_ps(), 0xffff, _mm512_loadu_si512(reinterpret_cast<void const*>(places)), from, 4)));
#elif defined(__AVX2__)
    if constexpr (width == 4 && sizeof(T) == 8)
      return L(reinterpret_cast<typename L::Vector>(
          _mm256_mask_i32gather_pd(_mm256_setzero_pd(),
                                   from,
                                   _mm_loadu_si128(reinterpret_cast<__m128i const*>(places)),
                                   _mm256_castsi256_pd(_mm256_set1_epi64x(-1)),
                                   8)));
#endif
    L value(0);
    for (int l = 0; l < width; ++l) value.set(l, from[places[l]]);
    return value;
  }
}
/// The four numbers of each.
template <class L, class T>
SINEW_INLINE void load_at(FourOf<T> const* from, int const* places, L (&to)[4]) {
  if constexpr (lane_traits<L>::width >= 4) {
    gather<4, 4>(from->of, places, to);
  } else {
    for (int c = 0; c < 4; ++c) {
      if constexpr (lane_traits<L>::width == 1)
        to[c] = from[places[0]].of[c];
      else
        for (int l = 0; l < lane_traits<L>::width; ++l) to[c].set(l, from[places[l]].of[c]);
    }
  }
}

/// The sum of all lanes, from the first on.
template <class L>
SINEW_INLINE lane_scalar<L> sum_of_lanes(L const& value) {
  lane_scalar<L> all = lane(value, 0);
  for (int l = 1; l < lane_traits<L>::width; ++l) all += lane(value, l);
  return all;
}

}  // namespace sinew
