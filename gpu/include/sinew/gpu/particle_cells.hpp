// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/core/boundary_particles.hpp>
#include <sinew/core/lane_lists.hpp>
#include <sinew/gpu/data_types.hpp>
#include <sinew/gpu/reduction.hpp>
#include <sinew/gpu/sorting.hpp>

#include <array>
#include <cmath>
#include <cstdint>
#include <string_view>
#include <utility>

namespace sinew::gpu {

/// Particles in the order of their cells on a device, as SortedParticles has them on the processor: cells by
/// z, then y, then x, so that all that are within the width of a cell of one are in nine ranges.
template <class D>
class ParticleCells {
 public:
  using Real = typename D::Real;
  using Coord = typename D::Coord;
  struct Range {
    int begin, end;
  };

  /// A particle and one within the radius, itself among them.
  struct Pair {
    int other;  // its place
    std::array<Real, 3> d;
    Real q;
    static constexpr bool acts = true;
  };

  /// What loops on the device read.
  struct View {
    FourOf<Real> const* places;  // x, and 0
    int const *order, *cell;     // of each place; cells count from 1
    Range const* ranges;         // of a row of cells around, one behind another
    int stride;
    Real perRadius;

    /// f(pair) for all around the particle in a place.
    template <class F>
    SINEW_HD void each(int place, F&& f) const {
      using std::sqrt;
      const FourOf<Real> own = places[place];
      const Range* range = ranges + cell[place];
      for (int line = 0; line < 9; ++line, range += stride) {
        const Range r = *range;
        for (int j = r.begin; j < r.end; ++j) {
          const FourOf<Real> other = places[j];
          Pair pair{j, {own.of[0] - other.of[0], own.of[1] - other.of[1], own.of[2] - other.of[2]}, Real(0)};
          const Real square =
              (pair.d[0] * pair.d[0] + pair.d[1] * pair.d[1] + pair.d[2] * pair.d[2]) * perRadius * perRadius;
          if (!(square < Real(1))) continue;
          pair.q = sqrt(square);
          if (!(pair.q > Real(1e-9))) pair.q = Real(1e-9);
          f(pair);
        }
      }
    }
  };

  /// Room for so many.
  void reserve(std::size_t n) {
    keys_.resize(n);
    order_.resize(n);
    cell_.resize(n);
    cells_.resize(n + 1);
    ranges_.resize(9 * (n + 1));
    places_.resize(n);
  }
  std::size_t size() const { return size_; }

  /// Sorts n points and those of boundaries behind them. Throws Error where one is not finite, or 2^20 cells
  /// or more from the origin; a step that is recorded does not look.
  void sort(Coord const* points, std::size_t n, Eigen::Vector3d const* boundary, std::size_t more,
            double radius, std::string_view where) {
    size_ = n + more;
    reserve(size_);
    perRadius_ = Real(1 / radius);
    if (size_ == 0) return;
    const Source source{points, boundary, int(n)};
    const Key key{source, 1 / radius, keys_.data(), order_.data()};
    if (recording())
      for_each_index(size_, key);
    else if (sum_on_host(size_, key) > 0)
      refuse(source, radius, where);
    sort_by_key(keys_.data(), order_.data(), size_);
    for_each_index(size_, Begins{keys_.data(), cell_.data()});
    add_up(cell_.data(), size_);
    for_each_index(size_, Cells{keys_.data(), cell_.data(), cells_.data(), int(size_)});
    for_each_index(size_,
                   Around{keys_.data(), cell_.data(), cells_.data(), ranges_.data(), stride(), int(size_)});
    for_each_index(size_, Gather{source, order_.data(), places_.data()});
  }
  View view() const {
    return {places_.data(), order_.data(), cell_.data(), ranges_.data(), stride(), perRadius_};
  }

  // what loops do

  static constexpr std::int64_t half = 1 << 20;  // cells to each side of the origin
  static constexpr std::uint64_t row = std::uint64_t(1) << 21, plane = row << 21;

  struct Source {
    Coord const* points;
    Eigen::Vector3d const* boundary;
    int n;
    SINEW_HD double at(int i, int axis) const {
      return i < n ? double(points[i][axis]) : boundary[i - n][axis];
    }
  };
  // 1 for a point that has no cell
  struct Key {
    Source source;
    double perWidth;
    std::uint64_t* keys;
    int* order;
    SINEW_HD double operator()(int i) const {
      using std::floor;
      std::uint64_t key = 0;
      bool good = true;
      for (int axis = 2; axis >= 0; --axis) {
        const double c = floor(source.at(i, axis) * perWidth);
        const bool in = c > -double(half) + 1 && c < double(half) - 1;  // not for NaN
        good = good && in;
        key = (key << 21) + (in ? std::uint64_t(std::int64_t(c) + half) : 0);
      }
      keys[i] = key;
      order[i] = i;
      return good ? 0 : 1;
    }
  };
  struct Begins {
    std::uint64_t const* keys;
    int* begins;
    SINEW_HD void operator()(int i) const { begins[i] = i == 0 || keys[i] != keys[i - 1] ? 1 : 0; }
  };
  // first place of each cell, and behind the last how many there are
  struct Cells {
    std::uint64_t const* keys;
    int const* cell;
    int* first;
    int n;
    SINEW_HD void operator()(int i) const {
      if (i == 0 || cell[i] != cell[i - 1]) first[cell[i] - 1] = i;
      if (i == n - 1) first[cell[i]] = n;
    }
  };
  struct Around {
    std::uint64_t const* keys;
    int const *cell, *first;
    Range* ranges;
    int stride, n;
    SINEW_HD void operator()(int i) const {
      if (i > 0 && cell[i] == cell[i - 1]) return;
      const int count = cell[n - 1];
      for (int r = 0; r < 9; ++r) {
        const std::uint64_t from =
            keys[i] - plane - row - 1 + std::uint64_t(r / 3) * plane + std::uint64_t(r % 3) * row;
        int low = 0, high = count;  // the first cell from there on
        while (low < high) {
          const int middle = (low + high) / 2;
          if (keys[first[middle]] < from)
            low = middle + 1;
          else
            high = middle;
        }
        int end = low;
        while (end < count && keys[first[end]] <= from + 2) ++end;
        ranges[r * stride + cell[i]] = {first[low], first[end]};
      }
    }
  };
  struct Gather {
    Source source;
    int const* order;
    FourOf<Real>* places;
    SINEW_HD void operator()(int i) const {
      const int k = order[i];
      places[i] = {{Real(source.at(k, 0)), Real(source.at(k, 1)), Real(source.at(k, 2)), Real(0)}};
    }
  };

 private:
  int stride() const { return int(size_) + 1; }

  void refuse(Source source, double radius, std::string_view where) const {
    std::vector<Coord> points(std::size_t(source.n));
    std::vector<Eigen::Vector3d> boundary(size_ - points.size());
    copy_to_host(points.data(), source.points, points.size());
    copy_to_host(boundary.data(), source.boundary, boundary.size());
    source.points = points.data();
    source.boundary = boundary.data();
    std::uint64_t key = 0;
    int number = 0;
    for (int i = 0; i < int(size_); ++i) {
      Source one = source;
      one.points += i < source.n ? i : 0;
      one.boundary += i < source.n ? 0 : i - source.n;
      one.n = i < source.n ? 1 : 0;
      if (Key{one, 1 / radius, &key, &number}(0) == 0) continue;
      const std::array<double, 3> x{source.at(i, 0), source.at(i, 1), source.at(i, 2)};
      if (!std::isfinite(x[0]) || !std::isfinite(x[1]) || !std::isfinite(x[2]))
        throw Error(where, text("the position of point ", i, " is not a finite number"));
      throw Error(where,
                  text("point ",
                       i,
                       " is at (",
                       x[0],
                       ", ",
                       x[1],
                       ", ",
                       x[2],
                       ") m, more than 2^20 cells of ",
                       radius,
                       " m from the origin; look for points that have flown away, or take a larger radius"));
    }
  }

  std::size_t size_ = 0;
  Real perRadius_{1};
  WorkArray<std::uint64_t> keys_{};
  WorkArray<int> order_{}, cell_{}, cells_{};
  WorkArray<Range> ranges_{};
  WorkArray<FourOf<Real>> places_{};
};

}  // namespace sinew::gpu
