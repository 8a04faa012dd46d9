// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/core/lanes.hpp>

#include <cstddef>
#include <cstring>
#include <type_traits>

namespace sinew::fluid {

// Rows of cells on the host by lanes: a body that is written for L takes one cell or as many as L has lanes.

/// The values of a field from cell i on.
template <class L, class Real>
SINEW_INLINE L load_row(Real const* field, std::ptrdiff_t i) {
  if constexpr (std::is_same_v<L, Real>) {
    return field[i];
  } else {
    L values;
    std::memcpy(&values.v, field + i, sizeof values.v);
    return values;
  }
}
template <class L, class Real>
SINEW_INLINE void store_row(Real* field, std::ptrdiff_t i, L values) {
  if constexpr (std::is_same_v<L, Real>)
    field[i] = values;
  else
    std::memcpy(field + i, &values.v, sizeof values.v);
}

/// f.template operator()<L>(index) for n cells from `first` on: by lanes, and one by one what is left.
template <class Real, class F>
SINEW_INLINE void for_row(std::ptrdiff_t first, int n, F&& f) {
  using L = lanes<Real>;
  constexpr int width = lane_traits<L>::width;
  int k = 0;
  for (; k + width <= n; k += width) f.template operator()<L>(first + k);
  if constexpr (width > 1)
    for (; k < n; ++k) f.template operator()<Real>(first + k);
}

/// Whether lanes of every second cell of a row can be stored without those between, which another thread may
/// read.
template <class Real>
inline constexpr bool stores_every_second =
#if defined(__AVX512F__) && !defined(__CUDACC__)
    true;
#else
    false;
#endif

#if defined(__AVX512F__) && !defined(__CUDACC__)
/// Lanes `parity`, parity + 2, ...
SINEW_INLINE void store_every_second(double* to, int parity, lanes<double> values) {
  _mm512_mask_storeu_pd(to, static_cast<__mmask8>(parity ? 0xaa : 0x55), reinterpret_cast<__m512d>(values.v));
}
SINEW_INLINE void store_every_second(float* to, int parity, lanes<float> values) {
  _mm512_mask_storeu_ps(
      to, static_cast<__mmask16>(parity ? 0xaaaa : 0x5555), reinterpret_cast<__m512>(values.v));
}
#endif

}  // namespace sinew::fluid
