// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/collision/axis_box.hpp>
#include <sinew/core/lanes.hpp>

namespace sinew {

/// A box as one vector, (-min, max, inf, inf), as search structures hold it. The box around two is one
/// maximum; the gaps between two along the axes are -(a + b'), where b' has the halves of b exchanged: one
/// sum and one comparison, eight lanes wide.
template <class Real>
struct alignas(8 * sizeof(Real)) PackedBox {
  Real h[8];

  static PackedBox none() {
    constexpr Real inf = std::numeric_limits<Real>::infinity();
    return {-inf, -inf, -inf, -inf, -inf, -inf, inf, inf};
  }
  static PackedBox of(BasicAxisBox<Real> const& box) {
    constexpr Real inf = std::numeric_limits<Real>::infinity();
    if (box.empty()) return none();
    return {-box.min[0], -box.min[1], -box.min[2], box.max[0], box.max[1], box.max[2], inf, inf};
  }
  BasicAxisBox<Real> box() const { return {{-h[0], -h[1], -h[2]}, {h[3], h[4], h[5]}}; }

  SINEW_INLINE PackedBox exchanged() const { return {h[3], h[4], h[5], h[0], h[1], h[2], h[6], h[7]}; }

  SINEW_INLINE void include(PackedBox const& other) {
    constexpr int width = native_width<Real> < 8 ? native_width<Real> : 8;
    for (int k = 0; k < 8; k += width) {
      lanes<Real, width> a, b;
      std::memcpy(&a, h + k, sizeof a);
      std::memcpy(&b, other.h + k, sizeof b);
      a = select(a > b, a, b);
      std::memcpy(h + k, &a, sizeof a);
    }
  }

  /// BasicAxisBox::overlaps of this box and of that which `exchanged` comes from: the same differences, so
  /// the same answer to the last bit.
  SINEW_INLINE bool overlaps(PackedBox const& exchanged, Real margin) const {
    [[maybe_unused]] Real const* b = exchanged.h;
#if defined(__AVX512F__)
    if constexpr (sizeof(Real) == 8) {
      const __m512d sum = _mm512_add_pd(_mm512_load_pd(h), _mm512_load_pd(b));
      return _mm512_cmp_pd_mask(sum, _mm512_set1_pd(-margin), _CMP_GE_OQ) == 0xff;
    }
#elif defined(__AVX__)
    if constexpr (sizeof(Real) == 8) {
      const __m256d low = _mm256_add_pd(_mm256_load_pd(h), _mm256_load_pd(b));
      const __m256d high = _mm256_add_pd(_mm256_load_pd(h + 4), _mm256_load_pd(b + 4));
      const __m256d least = _mm256_set1_pd(-margin);
      return _mm256_movemask_pd(_mm256_and_pd(_mm256_cmp_pd(low, least, _CMP_GE_OQ),
                                              _mm256_cmp_pd(high, least, _CMP_GE_OQ))) == 15;
    }
#elif defined(__SSE2__)
    if constexpr (sizeof(Real) == 8) {
      const __m128d least = _mm_set1_pd(-margin);
      __m128d all = _mm_cmpge_pd(_mm_add_pd(_mm_load_pd(h), _mm_load_pd(b)), least);
      all = _mm_and_pd(all, _mm_cmpge_pd(_mm_add_pd(_mm_load_pd(h + 2), _mm_load_pd(b + 2)), least));
      all = _mm_and_pd(all, _mm_cmpge_pd(_mm_add_pd(_mm_load_pd(h + 4), _mm_load_pd(b + 4)), least));
      return _mm_movemask_pd(all) == 3;
    }
#endif
    bool all = true;
    for (int k = 0; k < 6; ++k) all &= h[k] + b[k] >= -margin;
    return all;
  }

  /// As BasicAxisBox::halfArea.
  SINEW_INLINE Real halfArea() const {
    const Real x = h[0] + h[3], y = h[1] + h[4], z = h[2] + h[5];
    return x >= 0 ? x * y + y * z + z * x : 0;
  }
};

}  // namespace sinew
