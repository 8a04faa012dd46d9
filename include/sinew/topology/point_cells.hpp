// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/core/error.hpp>
#include <sinew/core/work_share.hpp>

#include <Eigen/Core>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <string_view>
#include <utility>
#include <vector>

namespace sinew {

/// Points sorted by the cubic cells in which they lie, cells by z, then y, then x, and those of a cell by
/// their numbers: all points within `width` of one are in nine ranges of that order, one for each row of
/// cells around its own. Nothing is allocated for as many points as reserve() was told of.
class PointCells {
 public:
  using Range = std::pair<int, int>;  // of places in the order, the second behind the last

  void reserve(std::size_t points) {
    for (auto* entries : {&entries_, &room_}) entries->reserve(points);
    order_.reserve(points);
    cells_.reserve(points + 1);
  }

  /// Throws Error where the width is not positive, a point is not finite, or points are more than 2^20 cells
  /// apart along an axis.
  template <class Points>
  void sort(Points const& points, double width, std::string_view where) {
    const std::size_t n = points.size();
    order_.resize(n);
    entries_.resize(n);
    room_.resize(n);
    cells_.clear();
    if (!(width > 0) || !std::isfinite(width))
      throw Error(where, text("cells for points are ", width, " m wide; give a width above 0"));
    if (n == 0) return;
    Eigen::Array3d low = Eigen::Array3d::Constant(std::numeric_limits<double>::infinity()), high = -low;
    for (std::size_t i = 0; i < n; ++i) {
      const Eigen::Array3d x = points[i].template cast<double>().array();
      if (!x.isFinite().all())
        throw Error(where, text("the position of point ", i, " is not a finite number"));
      low = low.min(x);
      high = high.max(x);
    }
    low_ = low;
    extent_ = (high - low).maxCoeff();
    const Eigen::Array3d size = ((high - low) / width).floor() + 1;
    if (!(size <= 1048576).all())
      throw Error(where,
                  text("points are ",
                       extent_,
                       " m apart, more than 2^20 cells of ",
                       width,
                       " m; look for points that have flown away, or take a larger radius"));
    // a cell without points is left at both ends of a row, so that rows do not meet
    rowLength_ = std::uint64_t(size[0]) + 2;
    planeLength_ = rowLength_ * (std::uint64_t(size[1]) + 2);
    for (std::size_t i = 0; i < n; ++i) {
      const Eigen::Array3d cell =
          ((points[i].template cast<double>().array() - low) / width).floor().min(size - 1);
      entries_[i] = {(std::uint64_t(cell[2]) + 1) * planeLength_ + (std::uint64_t(cell[1]) + 1) * rowLength_ +
                         std::uint64_t(cell[0]) + 1,
                     int(i)};
    }
    sortEntries((std::uint64_t(size[2]) + 2) * planeLength_);
    for (std::size_t k = 0; k < n; ++k) {
      order_[k] = entries_[k].point;
      if (cells_.empty() || cells_.back().key != entries_[k].key) cells_.push_back({entries_[k].key, int(k)});
    }
    cells_.push_back({std::numeric_limits<std::uint64_t>::max(), int(n)});
  }

  /// The points in their order.
  std::vector<int> const& order() const { return order_; }
  /// The lowest corner of the box of all points, and its longest side.
  Eigen::Array3d const& low() const { return low_; }
  double extent() const { return extent_; }
  std::size_t cellCount() const { return cells_.empty() ? 0 : cells_.size() - 1; }

  /// f(places of the points of a cell, the nine ranges around) for each cell that has points, of those that a
  /// share has.
  template <class F>
  void forEachCell(WorkShare const& share, F&& f) const {
    const std::size_t first = share.begin(cellCount()), end = share.end(cellCount());
    if (first == end) return;
    std::array<std::size_t, 9> from;  // rising with the cells
    for (std::size_t row = 0; row < 9; ++row)
      from[row] = std::size_t(std::lower_bound(cells_.begin(),
                                               cells_.end(),
                                               firstKey(cells_[first].key, row),
                                               [](Cell const& c, std::uint64_t key) { return c.key < key; }) -
                              cells_.begin());
    std::array<Range, 9> ranges;
    for (std::size_t c = first; c < end; ++c) {
      for (std::size_t row = 0; row < 9; ++row) {
        const std::uint64_t key = firstKey(cells_[c].key, row);
        while (cells_[from[row]].key < key) ++from[row];
        std::size_t to = from[row];
        while (cells_[to].key <= key + 2) ++to;
        ranges[row] = {cells_[from[row]].begin, cells_[to].begin};
      }
      f(Range{cells_[c].begin, cells_[c + 1].begin}, ranges);
    }
  }

 private:
  struct Entry {
    std::uint64_t key;
    int point;
  };
  struct Cell {
    std::uint64_t key;
    int begin;
  };
  std::vector<Entry> entries_{}, room_{};
  std::vector<int> order_{};
  std::vector<Cell> cells_{};  // one more, behind the last
  std::uint64_t rowLength_ = 0, planeLength_ = 0;
  Eigen::Array3d low_{0, 0, 0};
  double extent_ = 0;

  // of the first of three cells in one of the rows around a cell
  std::uint64_t firstKey(std::uint64_t key, std::size_t row) const {
    return key - planeLength_ - rowLength_ - 1 + (row / 3) * planeLength_ + (row % 3) * rowLength_;
  }
  // by eleven bits at a time from the lowest on, which keeps the order of equals
  void sortEntries(std::uint64_t end) {
    constexpr int bits = 11;
    constexpr std::uint64_t buckets = std::uint64_t(1) << bits;
    for (int shift = 0; shift == 0 || (shift < 64 && (end >> shift) > 0); shift += bits) {
      std::array<int, buckets + 1> begin{};
      for (Entry const& e : entries_) ++begin[(e.key >> shift) % buckets + 1];
      for (std::size_t b = 0; b < buckets; ++b) begin[b + 1] += begin[b];
      for (Entry const& e : entries_) room_[std::size_t(begin[(e.key >> shift) % buckets]++)] = e;
      entries_.swap(room_);
    }
  }
};

}  // namespace sinew
