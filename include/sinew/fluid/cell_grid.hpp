// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/core/workers.hpp>

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

namespace sinew::fluid {

/// One for each axis.
template <int N>
inline constexpr std::size_t axes = std::size_t(N);
template <class T, int N>
using Each = std::array<T, axes<N>>;

/// A box of cells in N dimensions with a layer of cells around it, the walls or, along a periodic axis,
/// copies of the cells at the other end. All fields over it have a value for each cell of both, x fastest: of
/// a cell, or of its lower face along some axis. Inner cells are numbered from 1 along each axis.
template <int N>
struct CellGrid {
  static_assert(N == 2 || N == 3);
  Each<int, N> cells{};
  Each<bool, N> periodic{};
  Each<std::ptrdiff_t, N> stride{};
  std::size_t size = 0;  // of a field

  CellGrid() = default;
  CellGrid(Each<int, N> const& n, Each<bool, N> const& wraps) : cells(n), periodic(wraps) {
    size = 1;
    for (std::size_t c = 0; c < axes<N>; ++c) {
      stride[c] = std::ptrdiff_t(size);
      size *= std::size_t(cells[c]) + 2;
    }
  }

  SINEW_INLINE std::size_t rows() const {
    std::size_t n = 1;
    for (std::size_t c = 1; c < axes<N>; ++c) n *= std::size_t(cells[c]);
    return n;
  }
  SINEW_INLINE std::size_t inner() const { return rows() * std::size_t(cells[0]); }
  /// y, and z, of a row of cells along x, from 1.
  SINEW_INLINE Each<int, N> place(std::size_t row) const {
    Each<int, N> at{};
    at[0] = 1;
    for (std::size_t c = 1; c < axes<N>; ++c) {
      at[c] = int(row % std::size_t(cells[c])) + 1;
      row /= std::size_t(cells[c]);
    }
    return at;
  }
  SINEW_INLINE std::ptrdiff_t index(Each<int, N> const& at) const {
    std::ptrdiff_t i = 0;
    for (std::size_t c = 0; c < axes<N>; ++c) i += at[c] * stride[c];
    return i;
  }
  /// The inverse.
  SINEW_INLINE Each<int, N> placeOf(std::ptrdiff_t i) const {
    Each<int, N> at{};
    for (std::size_t d = axes<N>; d-- > 0; i %= stride[d]) at[d] = int(i / stride[d]);
    return at;
  }

  /// f(row, index of its first inner cell) for the rows of a share of the work.
  template <class F>
  void forRows(WorkShare share, F&& f) const {
    for (std::size_t row = share.begin(rows()); row < share.end(rows()); ++row) f(row, index(place(row)));
  }
  /// The same by all threads, where there is enough to do.
  template <class F>
  void forRows(SomeWorkers workers, F&& f) const {
    if (inner() < 4096)
      forRows(WorkShare{}, f);
    else
      workers.run([&](WorkShare share) { forRows(share, f); });
  }
  /// f(index) for each inner cell.
  template <class F>
  void forCells(SomeWorkers workers, F&& f) const {
    forRows(workers, [&](std::size_t, std::ptrdiff_t first) {
      for (std::ptrdiff_t i = first, end = first + cells[0]; i < end; ++i) f(i);
    });
  }
  /// The sum of f(index) over inner cells: of each row, then of rows in their order, so that its bits do not
  /// depend on the threads. `sums` has room for each row.
  template <class F>
  double sum(SomeWorkers workers, std::span<double> sums, F&& f) const {
    forRows(workers, [&](std::size_t row, std::ptrdiff_t first) {
      double rowSum = 0;
      for (std::ptrdiff_t i = first, end = first + cells[0]; i < end; ++i) rowSum += double(f(i));
      sums[row] = rowSum;
    });
    double total = 0;
    for (std::size_t row = 0; row < rows(); ++row) total += sums[row];
    return total;
  }

  /// The cells beside the lower side across an axis, counted through: how many there are along each of the
  /// other axes, and the index in the layer around of one of them. With `edges` also beside the layers of the
  /// axes before, so that edges and corners are filled when all axes have been gone through in their order.
  struct Side {
    Each<int, N> low{}, count{};
  };
  SINEW_INLINE Side side(std::size_t axis, bool edges) const {
    Side s;
    for (std::size_t c = 0; c < axes<N>; ++c) {
      const bool whole = edges && c < axis;
      s.low[c] = c == axis || whole ? 0 : 1;
      s.count[c] = c == axis ? 1 : cells[c] + (whole ? 2 : 0);
    }
    return s;
  }
  SINEW_INLINE std::ptrdiff_t sideIndex(Side const& s, int number) const {
    std::ptrdiff_t i = 0;
    for (std::size_t c = 0; c < axes<N>; ++c) {
      i += (s.low[c] + number % s.count[c]) * stride[c];
      number /= s.count[c];
    }
    return i;
  }
  /// f(index in the layer around, index of the inner cell next to it, index of that at the other end, side)
  /// on the two sides across an axis, 0 and 1, of a cell of the lower layer.
  template <class F>
  SINEW_INLINE void onBothSides(std::size_t axis, std::ptrdiff_t base, F&& f) const {
    const std::ptrdiff_t n = cells[axis], s = stride[axis];
    f(base, base + s, base + n * s, 0);
    f(base + (n + 1) * s, base + n * s, base + s, 1);
  }
  /// The same for all cells beside the sides.
  template <class F>
  void forSides(std::size_t axis, bool edges, F&& f) const {
    const Side s = side(axis, edges);
    Each<int, N> at = s.low;
    for (;;) {
      onBothSides(axis, index(at), f);
      std::size_t c = 0;
      for (; c < N; ++c) {
        if (++at[c] < s.low[c] + s.count[c]) break;
        at[c] = s.low[c];
      }
      if (c == axes<N>) return;
    }
  }
  /// Copies what is at the other end into the layer around, along periodic axes.
  template <class T>
  void wrap(std::span<T> field) const {
    for (std::size_t axis = 0; axis < N; ++axis)
      if (periodic[axis])
        forSides(axis, true, [&](std::ptrdiff_t outer, std::ptrdiff_t, std::ptrdiff_t other, int) {
          field[std::size_t(outer)] = field[std::size_t(other)];
        });
  }

  /// f(neighbour) of an inner cell and its place, across the ends of periodic axes
  template <class F>
  SINEW_INLINE void forNeighbours(Each<int, N> const& at, std::ptrdiff_t i, F&& f) const {
    for (std::size_t d = axes<N>; d-- > 0;) {
      const std::ptrdiff_t s = stride[d], n = cells[d];
      if (at[d] > 1)
        f(i - s);
      else if (periodic[d])
        f(i + (n - 1) * s);
      if (at[d] < n)
        f(i + s);
      else if (periodic[d])
        f(i - (n - 1) * s);
    }
  }
  template <class F>
  void forNeighbours(std::ptrdiff_t i, F&& f) const {
    forNeighbours(placeOf(i), i, f);
  }
};

/// What is in the layer around = what is at the other end (CellGrid::forSides).
template <class T>
struct CopyOther {
  T* field;
  SINEW_INLINE void operator()(std::ptrdiff_t outer, std::ptrdiff_t, std::ptrdiff_t other, int) const {
    field[outer] = field[other];
  }
};

}  // namespace sinew::fluid
