// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/core/lanes.hpp>
#include <sinew/topology/point_cells.hpp>

#include <array>
#include <cmath>
#include <cstring>
#include <string_view>
#include <vector>

namespace sinew {

/// Particles in the order of their cells, and loops over the neighbours of each, as many at once as there are
/// lanes. A place is one in that order. Sums go over neighbours in this order, so that bits repeat.
template <class Real, int Width>
class SortedParticles {
 public:
  using L = lanes<Real, Width>;
  static constexpr int width = lane_traits<L>::width;

  /// Neighbours of a particle and itself: what is beyond the radius or the range has `acts` false and q = 1.
  /// q is not quite 0, so that slopes are numbers.
  struct Pairs {
    int first;           // place of the first
    std::array<L, 3> d;  // x_i - x_j
    L q;                 // |d| / radius
    decltype(L(0) < L(1)) acts;
  };

  /// Room for so many; a vector of values in their order has `room()` entries, for lanes that reach over the
  /// last.
  void reserve(std::size_t particles) {
    cells_.reserve(particles);
    for (auto& one : positions_) one.reserve(particles + std::size_t(width));
  }
  std::size_t room() const { return positions_[0].size(); }

  /// Throws Error as PointCells does.
  template <class Points>
  void sort(Points const& points, double radius, std::string_view where) {
    cells_.sort(points, radius, where);
    perRadius_ = Real(1 / radius);
    for (auto& one : positions_) one.resize(points.size() + std::size_t(width), Real(0));
    for (std::size_t k = 0; k < points.size(); ++k)
      for (int c = 0; c < 3; ++c) positions_[std::size_t(c)][k] = Real(points[std::size_t(order()[k])][c]);
  }
  std::array<std::vector<Real>, 3> const& positions() const { return positions_; }
  /// The number of the particle in each place.
  std::vector<int> const& order() const { return cells_.order(); }

  /// f(place, each) for all particles of a share: each(g) calls g(pairs) for all that are around.
  template <class F>
  void forEach(WorkShare const& share, F&& f) const {
    L numbers(0);
    if constexpr (width > 1)
      for (int l = 0; l < width; ++l) numbers.set(l, Real(l));
    cells_.forEachCell(
        share, [&](PointCells::Range const& cell, std::array<PointCells::Range, 9> const& around) {
          for (int i = cell.first; i < cell.second; ++i) {
            std::array<L, 3> x;
            for (std::size_t c = 0; c < 3; ++c) x[c] = L(positions_[c][std::size_t(i)]);
            f(i, [&](auto&& g) {
              for (auto const& [begin, end] : around)
                for (int j = begin; j < end; j += width) {
                  Pairs pairs{.first = j, .d = {}, .q = L(0), .acts = numbers < L(Real(end - j))};
                  L square(0);
                  for (std::size_t c = 0; c < 3; ++c) {
                    pairs.d[c] = x[c] - load(positions_[c], j);
                    square += pairs.d[c] * pairs.d[c];
                  }
                  using std::sqrt, sinew::sqrt;
                  pairs.q = sqrt(square) * L(perRadius_);
                  pairs.acts = both(pairs.acts, pairs.q < L(1));
                  if (!any(pairs.acts)) continue;
                  pairs.q = select(pairs.acts, select(pairs.q > L(Real(1e-9)), pairs.q, L(Real(1e-9))), L(1));
                  g(pairs);
                }
            });
          }
        });
  }

  static L load(std::vector<Real> const& from, int place) {
    L value;
    std::memcpy(&value, from.data() + place, sizeof value);
    return value;
  }
  static Real sum(L const& value) {
    Real all = lane(value, 0);
    for (int l = 1; l < width; ++l) all += lane(value, l);
    return all;
  }

 private:
  PointCells cells_{};
  std::array<std::vector<Real>, 3> positions_{};
  Real perRadius_{1};
};

}  // namespace sinew
