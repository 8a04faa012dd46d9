// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/collision/axis_box.hpp>
#include <sinew/core/lanes.hpp>

namespace sinew {

/// A box as two short vectors, (-min, inf) and (max, inf), as search structures hold it: the box around two
/// boxes is a maximum, and the gaps between a and b along the axes are -(a.max + b.-min) and -(a.-min +
/// b.max).
template <class Real>
struct alignas(8 * sizeof(Real)) PackedBox {
  Real low[4], high[4];

  static PackedBox none() {
    constexpr Real inf = std::numeric_limits<Real>::infinity();
    return {{-inf, -inf, -inf, inf}, {-inf, -inf, -inf, inf}};
  }
  static PackedBox of(BasicAxisBox<Real> const& box) {
    constexpr Real inf = std::numeric_limits<Real>::infinity();
    if (box.empty()) return none();
    return {{-box.min[0], -box.min[1], -box.min[2], inf}, {box.max[0], box.max[1], box.max[2], inf}};
  }
  BasicAxisBox<Real> box() const { return {{-low[0], -low[1], -low[2]}, {high[0], high[1], high[2]}}; }

  SINEW_INLINE void include(PackedBox const& other) {
    for (int k = 0; k < 4; k += width) {
      raise(low + k, other.low + k);
      raise(high + k, other.high + k);
    }
  }

  /// As BasicAxisBox::overlaps: the same differences, so the same answer to the last bit.
  SINEW_INLINE bool overlaps(PackedBox const& other, Real margin) const {
#if defined(__CUDACC__)  // whose front end has no such types
#elif defined(__AVX__)
    if constexpr (sizeof(Real) == 8) {
      const __m256d minimum = _mm256_set1_pd(-margin);
      const __m256d a = _mm256_add_pd(_mm256_load_pd(low), _mm256_load_pd(other.high));
      const __m256d b = _mm256_add_pd(_mm256_load_pd(high), _mm256_load_pd(other.low));
      return _mm256_movemask_pd(_mm256_and_pd(_mm256_cmp_pd(a, minimum, _CMP_GE_OQ),
                                              _mm256_cmp_pd(b, minimum, _CMP_GE_OQ))) == 15;
    }
#elif defined(__SSE2__)
    if constexpr (sizeof(Real) == 8) {
      const __m128d minimum = _mm_set1_pd(-margin);
      auto reach = [&](Real const* a, Real const* b) {
        return _mm_cmpge_pd(_mm_add_pd(_mm_load_pd(a), _mm_load_pd(b)), minimum);
      };
      return _mm_movemask_pd(
                 _mm_and_pd(_mm_and_pd(reach(low, other.high), reach(low + 2, other.high + 2)),
                            _mm_and_pd(reach(high, other.low), reach(high + 2, other.low + 2)))) == 3;
    }
#endif
    bool all = true;
    for (int k = 0; k < 3; ++k)
      all &= (low[k] + other.high[k] >= -margin) & (high[k] + other.low[k] >= -margin);
    return all;
  }

  /// As BasicAxisBox::halfArea.
  SINEW_INLINE Real halfArea() const {
    const Real x = low[0] + high[0], y = low[1] + high[1], z = low[2] + high[2];
    return x >= 0 ? x * y + y * z + z * x : 0;
  }

 private:
  static constexpr int width = native_width<Real> < 4 ? native_width<Real> : 4;

  SINEW_INLINE static void raise(Real* to, Real const* from) {
    lanes<Real, width> a, b;
    std::memcpy(&a, to, sizeof a);
    std::memcpy(&b, from, sizeof b);
    a = select(a > b, a, b);
    std::memcpy(to, &a, sizeof a);
  }
};

}  // namespace sinew
