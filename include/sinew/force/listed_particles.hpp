// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/force/sorted_particles.hpp>

#include <array>
#include <cstddef>
#include <string_view>
#include <vector>

#if defined(__AVX512F__) || defined(__AVX2__)
#include <immintrin.h>
#endif

namespace sinew {

/// Particles in the order of their cells with a list of the neighbours of each, for what goes through them
/// many times while they stand: of the particles in the cells around one, five in six are beyond its radius.
/// Sums go over neighbours in the order of their cells, so that bits repeat.
template <class Real, int Width>
class ListedParticles {
 public:
  using Sorted = SortedParticles<Real, Width>;
  using L = typename Sorted::L;
  static constexpr int width = Sorted::width;

  /// As SortedParticles::Pairs; `places` are those of the neighbours.
  struct Pairs {
    int const* places;
    std::array<L, 3> d;  // x_i - x_j
    L q;                 // |d| / radius, not quite 0
    decltype(L(0) < L(1)) acts;
  };

  /// Room for so many with 64 neighbours each; more of them in the mean allocate.
  void reserve(std::size_t particles) {
    sorted_.reserve(particles);
    first_.reserve(particles + 1);
    counts_.reserve(particles);
    neighbours_.reserve(64 * particles);
  }
  std::size_t room() const { return sorted_.room(); }
  std::vector<int> const& order() const { return sorted_.order(); }

  /// Sorts and lists; inShares(f) calls f(share) for all shares of the work. Throws Error as PointCells does.
  template <class Points, class InShares>
  void sort(Points const& points, double radius, std::string_view where, InShares&& inShares) {
    sorted_.sort(points, radius, where);
    perRadius_ = Real(1 / radius);
    const std::size_t n = points.size();
    counts_.resize(n);
    first_.resize(n + 1);
    inShares([&](WorkShare share) {
      sorted_.forEach(share, [&](int i, auto const& each) {
        int count = 0;
        each([&](auto const& p) { count += actives(p); });
        counts_[std::size_t(i)] = count;
      });
    });
    first_[0] = 0;
    for (std::size_t i = 0; i < n; ++i)
      first_[i + 1] = first_[i] + (std::size_t(counts_[i]) + width - 1) / width * width;
    neighbours_.resize(first_[n]);
    inShares([&](WorkShare share) {
      sorted_.forEach(share, [&](int i, auto const& each) {
        int* next = neighbours_.data() + first_[std::size_t(i)];
        int* const end = neighbours_.data() + first_[std::size_t(i) + 1];
        each([&](auto const& p) {
          const unsigned bits = bits_of(p.acts);
          for (int l = 0; l < width; ++l)
            if (bits >> l & 1) *next++ = p.first + l;
        });
        while (next != end) *next++ = i;
      });
    });
  }

  /// f(place, each) for all particles of a share: each(g) calls g(pairs) for all that are around.
  template <class F>
  void forEach(WorkShare const& share, F&& f) const {
    L numbers(0);
    if constexpr (width > 1)
      for (int l = 0; l < width; ++l) numbers.set(l, Real(l));
    const std::size_t n = counts_.size();
    for (std::size_t i = share.begin(n); i < share.end(n); ++i) {
      std::array<L, 3> x;
      for (std::size_t c = 0; c < 3; ++c) x[c] = L(sorted_.positions()[c][i]);
      f(int(i), [&](auto&& g) {
        for (int k = 0; k < counts_[i]; k += width) {
          Pairs pairs{.places = neighbours_.data() + first_[i] + k,
                      .d = {},
                      .q = L(0),
                      .acts = numbers < L(Real(counts_[i] - k))};
          L square(0);
          for (std::size_t c = 0; c < 3; ++c) {
            pairs.d[c] = x[c] - load(sorted_.positions()[c], pairs);
            square += pairs.d[c] * pairs.d[c];
          }
          using std::sqrt, sinew::sqrt;
          pairs.q = sqrt(square) * L(perRadius_);
          pairs.q = select(pairs.acts, select(pairs.q > L(Real(1e-9)), pairs.q, L(Real(1e-9))), L(1));
          g(pairs);
        }
      });
    }
  }

  /// The values of neighbours.
  static L load(std::vector<Real> const& from, Pairs const& p) {
#if defined(__AVX512F__)
    if constexpr (width == 8 && sizeof(Real) == 8)
      return L(reinterpret_cast<typename L::Vector>(
          _mm512_mask_i32gather_pd(_mm512_setzero_pd(),
                                   0xff,
                                   _mm256_loadu_si256(reinterpret_cast<__m256i const*>(p.places)),
                                   from.data(),
                                   8)));
#elif defined(__AVX2__)
    if constexpr (width == 4 && sizeof(Real) == 8)
      return L(reinterpret_cast<typename L::Vector>(
          _mm256_mask_i32gather_pd(_mm256_setzero_pd(),
                                   from.data(),
                                   _mm_loadu_si128(reinterpret_cast<__m128i const*>(p.places)),
                                   _mm256_castsi256_pd(_mm256_set1_epi64x(-1)),
                                   8)));
#endif
    L value(0);
    if constexpr (width > 1)
      for (int l = 0; l < width; ++l) value.set(l, from[std::size_t(p.places[l])]);
    else
      value = from[std::size_t(p.places[0])];
    return value;
  }
  static Real sum(L const& value) { return Sorted::sum(value); }

 private:
  Sorted sorted_{};
  std::vector<int> counts_{}, neighbours_{};  // lists filled up to whole lanes with the particle itself
  std::vector<std::size_t> first_{};
  Real perRadius_{1};

  template <class Mask>
  static unsigned bits_of(Mask const& acts) {
    if constexpr (width > 1) {
      unsigned bits = 0;
      for (int l = 0; l < width; ++l) bits |= unsigned(acts.bits[l] != 0) << l;
      return bits;
    } else {
      return unsigned(acts);
    }
  }
  template <class SortedPairs>
  static int actives(SortedPairs const& p) {
    return __builtin_popcount(bits_of(p.acts));
  }
};

}  // namespace sinew
