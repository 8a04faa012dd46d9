// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/core/lane_lists.hpp>
#include <sinew/topology/point_cells.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <string_view>
#include <vector>

namespace sinew {

/// Particles in the order of their cells, and loops over the neighbours of each, as many at once as there are
/// lanes. A place is one in that order. Sums go over neighbours in this order, so that bits repeat.
///
/// Of the particles in the cells around one, five in six are beyond its radius. Two searches in single
/// precision, with a margin for its rounding, leave what is near: one for the box of the particles of a cell,
/// one for each of these. The first loop over the neighbours of a particle lists them, and later ones take
/// the list.
template <class Real, int Width>
class SortedParticles {
 public:
  using L = lanes<Real, Width>;
  static constexpr int width = lane_traits<L>::width;
  static constexpr int listed = 64;  // neighbours of a particle; what has more is searched in each loop

  /// Neighbours of a particle and itself: what is beyond the radius or the list has `acts` false and q = 1.
  /// q is not quite 0, so that slopes are numbers.
  struct Pairs {
    int const* places;
    std::array<L, 3> d;  // x_i - x_j
    L weight;            // of j
    L q;                 // |d| / radius
    decltype(L(0) < L(1)) acts;
  };

  /// Room for so many.
  void reserve(std::size_t particles) {
    cells_.reserve(particles);
    points_.reserve(particles);
    for (auto& one : near_) one.reserve(particles + std::size_t(searched));
    counts_.reserve(particles);
    lists_.reserve(particles * listed);
  }

  /// Throws Error as PointCells does.
  template <class Points>
  void sort(Points const& points, double radius, std::string_view where) {
    const std::size_t n = points.size();
    cells_.sort(points, radius, where);
    radius_ = Real(radius);
    // places, and the centre of a box, are rounded by extent 2^-24 along each axis: 3 sqrt(3) of that at most
    // between two; differences and their squares relatively
    reach_ = float(radius * (1 + 1e-6) + 6 * cells_.extent() / 16777216);
    points_.resize(n);
    for (auto& one : near_) one.resize(n + std::size_t(searched), 0.f);
    counts_.assign(n, unknown);
    lists_.resize(n * listed);
    for (std::size_t k = 0; k < n; ++k) {
      auto const& x = points[std::size_t(order()[k])];
      points_[k] = {{Real(x[0]), Real(x[1]), Real(x[2]), Real(1)}};
      for (int c = 0; c < 3; ++c) near_[std::size_t(c)][k] = float(double(x[c]) - cells_.low()[c]);
    }
  }
  /// The number of the particle in each place.
  std::vector<int> const& order() const { return cells_.order(); }
  /// What pairs have of a particle beside its position: 1 behind sort().
  Real& weight(std::size_t place) { return points_[place].of[3]; }
  Real weight(std::size_t place) const { return points_[place].of[3]; }

  /// f(place, each) for all particles of a share: each(g) calls g(pairs) for all that are around. Lists are
  /// written: two at a time may not loop over the same particles.
  template <class F>
  void forEach(WorkShare const& share, F&& f) {
    Candidates candidates;
    cells_.forEachCell(share, [&](Range const& cell, std::array<Range, 9> const& around) {
      candidates.first = -1;
      for (int i = cell.first; i < cell.second; ++i)
        f(i, [&](auto&& g) {
          if (const int count = counts_[std::size_t(i)]; count != unknown)
            forEachPair(i, lists_.data() + std::size_t(i) * listed, count, g);
          else
            search(i, cell, around, candidates, g);
        });
    });
  }

  static L load(std::vector<Real> const& from, Pairs const& p) { return load_at<L>(from.data(), p.places); }
  static Real sum(L const& value) { return sum_of_lanes(value); }

 private:
  using Range = PointCells::Range;
  using S = lanes<float, width == 1 ? 1 : native_width<float>>;
  using Places = vector_like<S, int>;
  static constexpr int searched = lane_traits<S>::width;
  static constexpr int unknown = -1;

  /// Particles near a box, from one in the ranges of a cell on.
  struct Candidates {
    static constexpr int most = 1024;
    int first = -1;   // among all of the ranges
    int count, next;  // next: of what follows, or -1
    std::array<std::array<float, std::size_t(most + 2 * searched)>, 3> x;
    std::array<int, std::size_t(most + 2 * searched)> places;
  };

  PointCells cells_{};
  std::vector<FourOf<Real>> points_{};        // position and weight
  std::array<std::vector<float>, 3> near_{};  // position from the lowest corner
  std::vector<int> counts_{}, lists_{};       // of neighbours that are near
  Real radius_{1};
  float reach_ = 1;

  /// Fills `to` from number `first` of those in the ranges on.
  void find(Range const& cell, std::array<Range, 9> const& around, int first, Candidates& to) const {
    std::array<S, 3> centre, half;
    for (std::size_t c = 0; c < 3; ++c) {
      const auto [low, high] =
          std::minmax_element(near_[c].begin() + cell.first, near_[c].begin() + cell.second);
      centre[c] = S(0.5f * (*low + *high));
      half[c] = S(0.5f * (*high - *low) * 1.000001f);
    }
    const S limit(reach_ * reach_);
    Places numbers{};
    if constexpr (searched > 1)
      for (int l = 0; l < searched; ++l) numbers[l] = l;
    to.first = first;
    to.count = 0;
    int before = 0;  // of earlier ranges
    for (auto const& [begin, end] : around) {
      for (int j = begin + std::max(0, first - before); j < end; j += searched) {
        if (to.count > Candidates::most) {
          to.next = before + j - begin;
          return;
        }
        S square(0);
        std::array<vector_like<S, float>, 3> x;
        for (std::size_t c = 0; c < 3; ++c) {
          using std::abs, sinew::abs;
          x[c] = load_from<vector_like<S, float>>(near_[c].data() + j);
          S apart = abs(S(x[c]) - centre[c]) - half[c];
          apart = select(apart > S(0), apart, S(0));
          square += apart * apart;
        }
        const unsigned bits = bits_of(square < limit) & first_bits(end - j);
        const auto place = std::size_t(to.count);
        for (std::size_t c = 0; c < 3; ++c) write_lanes(x[c], bits, &to.x[c][place]);
        write_lanes(numbers + j, bits, &to.places[place]);
        to.count += __builtin_popcount(bits);
      }
      before += end - begin;
    }
    to.next = -1;
  }
  static constexpr unsigned first_bits(int count) {
    return count >= searched ? ~0u >> (32 - searched) : (1u << count) - 1;
  }

  // lists the neighbours of a particle where there are few enough
  template <class G>
  void search(int i, Range const& cell, std::array<Range, 9> const& around, Candidates& candidates, G&& g) {
    constexpr int room = 256;
    std::array<int, std::size_t(room + 2 * searched)> found;
    int count = 0;
    bool all = true;
    std::array<S, 3> x;
    for (std::size_t c = 0; c < 3; ++c) x[c] = S(near_[c][std::size_t(i)]);
    const S limit(reach_ * reach_);
    for (int from = 0; from >= 0; from = candidates.next) {
      if (candidates.first != from) find(cell, around, from, candidates);
      for (int k = 0; k < candidates.count; k += searched) {
        S square(0);
        for (std::size_t c = 0; c < 3; ++c) {
          const S d = x[c] - load_from<S>(candidates.x[c].data() + k);
          square += d * d;
        }
        const unsigned bits = bits_of(square < limit) & first_bits(candidates.count - k);
        write_lanes(load_from<Places>(candidates.places.data() + k), bits, found.data() + count);
        count += __builtin_popcount(bits);
        if (count > room) {
          forEachPair(i, found.data(), room, g);
          std::copy(found.begin() + room, found.begin() + count, found.begin());
          count -= room;
          all = false;
        }
      }
    }
    std::fill_n(found.begin() + count, width, i);
    if (all && count <= listed) {
      counts_[std::size_t(i)] = count;
      std::copy_n(found.begin(), listed, lists_.begin() + std::ptrdiff_t(i) * listed);
    }
    forEachPair(i, found.data(), count, g);
  }

  template <class G>
  void forEachPair(int i, int const* places, int count, G&& g) const {
    L numbers(0);
    if constexpr (width > 1)
      for (int l = 0; l < width; ++l) numbers.set(l, Real(l));
    std::array<L, 3> x;
    for (std::size_t c = 0; c < 3; ++c) x[c] = L(points_[std::size_t(i)].of[c]);
    const L tiny(Real(1e-18) * radius_ * radius_), perRadius(1 / radius_);
    for (int k = 0; k < count; k += width) {
      L other[4], square(0);
      load_at(points_.data(), places + k, other);
      Pairs pairs{
          .places = places + k, .d = {}, .weight = other[3], .q = L(0), .acts = numbers < L(Real(count - k))};
      for (std::size_t c = 0; c < 3; ++c) {
        pairs.d[c] = x[c] - other[c];
        square += pairs.d[c] * pairs.d[c];
      }
      using std::sqrt, sinew::sqrt;
      pairs.q = sqrt(select(square > tiny, square, tiny)) * perRadius;
      pairs.acts = both(pairs.acts, pairs.q < L(1));
      pairs.q = select(pairs.acts, pairs.q, L(1));
      g(pairs);
    }
  }
};

}  // namespace sinew
