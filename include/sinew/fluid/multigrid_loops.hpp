// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/fluid/cell_grid.hpp>

namespace sinew::fluid {

/// One grid of PoissonMultigrid, where its loops run.
template <class Real, int N>
struct LevelView {
  CellGrid<N> grid;
  Each<Real*, N> face;
  Real *surface, *inverse, *share, *x, *b, *r;
  std::uint8_t* open;

  /// (A x) of a cell but for its diagonal, with the sign of b.
  SINEW_INLINE Real around(Real const* of, std::ptrdiff_t i) const {
    Real sum = 0;
    for (std::size_t c = 0; c < axes<N>; ++c) {
      const std::ptrdiff_t s = grid.stride[c];
      sum += face[c][i] * of[i - s] + face[c][i + s] * of[i + s];
    }
    return sum;
  }
};

// Bodies of loops over the cells of a level, or of two, one of which has half as many cells along some axes.

/// inverse = 1 / (sum of the faces of a cell and its surface)
template <class Real, int N>
struct InvertDiagonal {
  LevelView<Real, N> level;
  SINEW_INLINE void operator()(Each<int, N> const&, std::ptrdiff_t i) const {
    Real diagonal = level.surface[i];
    for (std::size_t c = 0; c < axes<N>; ++c)
      diagonal += level.face[c][i] + level.face[c][i + level.grid.stride[c]];
    level.inverse[i] = diagonal > 0 ? 1 / diagonal : Real(0);
  }
};

/// x = what a sweep over the cells of one colour makes of zero.
template <class Real, int N>
struct FirstSweep {
  LevelView<Real, N> level;
  int colour;
  SINEW_INLINE void operator()(Each<int, N> const& at, std::ptrdiff_t i) const {
    int parity = colour;
    for (const int k : at) parity += k;
    level.x[i] = (parity & 1) == 0 ? level.b[i] * level.inverse[i] : Real(0);
  }
};
/// A sweep of Gauss and Seidel over cells of one colour.
template <class Real, int N>
struct Sweep {
  LevelView<Real, N> level;
  SINEW_INLINE void operator()(Each<int, N> const&, std::ptrdiff_t i) const {
    level.x[i] = (level.b[i] + level.around(level.x, i)) * level.inverse[i];
  }
};
/// r = (b - A x) times the shares of interpolated values.
template <class Real, int N>
struct SharedResidual {
  LevelView<Real, N> level;
  SINEW_INLINE void operator()(Each<int, N> const&, std::ptrdiff_t i) const {
    const Real inverse = level.inverse[i];
    level.r[i] = inverse > 0 ? (level.b[i] - level.x[i] / inverse + level.around(level.x, i)) * level.share[i]
                             : Real(0);
  }
};

/// Two levels.
template <class Real, int N>
struct LevelPair {
  LevelView<Real, N> fine, coarse;

  SINEW_INLINE bool halved(std::size_t c) const { return fine.grid.cells[c] != coarse.grid.cells[c]; }
};

/// Coarse faces, surfaces and solids: those of fine cells, twice as large along each halved axis.
template <class Real, int N>
struct Coarsen : LevelPair<Real, N> {
  SINEW_INLINE void operator()(Each<int, N> const& at, std::ptrdiff_t i) const {
    LevelView<Real, N> const &from = this->fine, &to = this->coarse;
    int ways = 0;
    for (std::size_t c = 0; c < axes<N>; ++c) ways += this->halved(c);
    Each<Real, N> faces{};
    Real surface = 0;
    std::uint8_t open = 0;
    for (int child = 0; child < 1 << ways; ++child) {
      Each<int, N> place = at;
      Each<bool, N> lower{};
      bool inside = true;
      int bit = 0;
      for (std::size_t c = 0; c < axes<N>; ++c) {
        lower[c] = true;
        if (this->halved(c)) {
          const bool second = child >> bit++ & 1;
          place[c] = 2 * at[c] - (second ? 0 : 1);
          lower[c] = !second;
          inside = inside && place[c] <= from.grid.cells[c];
        }
      }
      if (!inside) continue;
      const std::ptrdiff_t f = from.grid.index(place);
      for (std::size_t c = 0; c < axes<N>; ++c)
        if (lower[c]) faces[c] += from.face[c][f];
      surface += from.surface[f];
      open = open || from.open[f];
    }
    for (std::size_t c = 0; c < axes<N>; ++c) to.face[c][i] = this->halved(c) ? faces[c] / 2 : faces[c];
    to.surface[i] = surface / 2;
    to.open[i] = open;
  }
};

/// Multilinear interpolation between centres of coarse cells: along each axis 3/4 of the nearer and 1/4 of
/// the farther.
template <class Real, int N>
struct Interpolation : LevelPair<Real, N> {
  struct Between {
    int near, far;
    Real weight;
  };
  SINEW_INLINE Between between(std::size_t c, int i) const {
    if (!this->halved(c)) return {i, i, Real(1)};
    const int parent = (i + 1) / 2;
    return {parent, i % 2 == 1 ? parent - 1 : parent + 1, Real(0.75)};
  }
  /// f(index of the cell with x = 0 in a row of coarse cells, weight) for the rows around a fine one.
  template <class F>
  SINEW_INLINE void forCoarseRows(Each<int, N> const& at, F&& f) const {
    Each<Between, N> places{};
    for (std::size_t c = 1; c < axes<N>; ++c) places[c] = between(c, at[c]);
    for (int way = 0; way < 1 << (N - 1); ++way) {
      std::ptrdiff_t base = 0;
      Real weight = 1;
      for (std::size_t c = 1; c < axes<N>; ++c) {
        const bool far = way >> (c - 1) & 1;
        base += (far ? places[c].far : places[c].near) * this->coarse.grid.stride[c];
        weight *= far ? 1 - places[c].weight : places[c].weight;
      }
      if (weight > 0) f(base, weight);
    }
  }
  /// out(weight times the interpolated `value`) for the rows around a fine cell.
  template <class Value, class Out>
  SINEW_INLINE void ofCell(Each<int, N> const& at, Value&& value, Out&& out) const {
    const bool alongX = this->halved(0);
    const Between x = between(0, at[0]);
    forCoarseRows(at, [&](std::ptrdiff_t base, Real weight) {
      out(alongX ? weight * (Real(0.75) * value(base + x.near) + Real(0.25) * value(base + x.far))
                 : weight * value(base + x.near));
    });
  }
  /// out(x of a fine cell, weight times the interpolated `value`) for all of a row: the same, cell by cell of
  /// a coarse row.
  template <class Value, class Out>
  SINEW_INLINE void ofRow(Each<int, N> const& at, Value&& value, Out&& out) const {
    const int n = this->fine.grid.cells[0];
    const bool alongX = this->halved(0);
    forCoarseRows(at, [&](std::ptrdiff_t base, Real weight) {
      if (!alongX) {
        for (int i = 1; i <= n; ++i) out(i, weight * value(base + i));
        return;
      }
      for (int i = 1, parent = 1; i <= n; i += 2, ++parent) {
        const Real here = Real(0.75) * value(base + parent);
        out(i, weight * (here + Real(0.25) * value(base + parent - 1)));
        if (i < n) out(i + 1, weight * (here + Real(0.25) * value(base + parent + 1)));
      }
    });
  }
};
/// What interpolated values of a fine cell are multiplied by, so that solids have no share in them.
template <class Real, int N>
struct ShareWeights : Interpolation<Real, N> {
  SINEW_INLINE void operator()(Each<int, N> const& at, std::ptrdiff_t i) const {
    Real sum = 0;
    this->ofCell(
        at, [&](std::ptrdiff_t k) { return isOpen(k); }, [&](Real w) { sum += w; });
    this->fine.share[i] = this->fine.inverse[i] > 0 && sum > 0 ? 1 / sum : Real(0);
  }
  void row(Each<int, N> const& at, std::ptrdiff_t first, int n) const {
    Real* share = this->fine.share + first - 1;
    for (int i = 1; i <= n; ++i) share[i] = 0;
    this->ofRow(
        at, [&](std::ptrdiff_t k) { return isOpen(k); }, [&](int i, Real w) { share[i] += w; });
    for (int i = 1; i <= n; ++i)
      share[i] = this->fine.inverse[first - 1 + i] > 0 && share[i] > 0 ? 1 / share[i] : Real(0);
  }

 private:
  SINEW_INLINE Real isOpen(std::ptrdiff_t k) const { return this->coarse.open[k] ? Real(1) : Real(0); }
};
/// x of the fine level += the interpolated x of the coarse one.
template <class Real, int N>
struct AddInterpolated : Interpolation<Real, N> {
  SINEW_INLINE void operator()(Each<int, N> const& at, std::ptrdiff_t i) const {
    Real x = this->fine.x[i];
    const Real share = this->fine.share[i];
    this->ofCell(
        at, [&](std::ptrdiff_t k) { return this->coarse.x[k]; }, [&](Real value) { x += share * value; });
    this->fine.x[i] = x;
  }
  void row(Each<int, N> const& at, std::ptrdiff_t first, int) const {
    Real* x = this->fine.x + first - 1;
    Real const* share = this->fine.share + first - 1;
    Real const* from = this->coarse.x;
    this->ofRow(
        at, [&](std::ptrdiff_t k) { return from[k]; }, [&](int i, Real value) { x[i] += share[i] * value; });
  }
};
/// b of the coarse level = the transpose of interpolation of r.
template <class Real, int N>
struct Restrict : LevelPair<Real, N> {
  /// f(index of the cell with x = 0 in a row of fine cells, weight) for the rows that take from a coarse one.
  template <class F>
  SINEW_INLINE void forFineRows(Each<int, N> const& at, F&& f) const {
    constexpr int ways = N == 2 ? 4 : 16;
    for (int way = 0; way < ways; ++way) {
      std::ptrdiff_t base = 0;
      Real weight = 1;
      for (std::size_t c = 1; c < axes<N>; ++c) {
        const int k = way >> (2 * (c - 1)) & 3;
        int place = at[c];
        if (this->halved(c)) {
          place = 2 * at[c] - 2 + k;
          weight *=
              place <= this->fine.grid.cells[c] + 1 ? (k == 1 || k == 2 ? Real(0.75) : Real(0.25)) : Real(0);
        } else if (k > 0) {
          weight = 0;
        }
        base += place * this->fine.grid.stride[c];
      }
      if (weight > 0) f(base, weight);
    }
  }
  SINEW_INLINE Real sum(Real const* r, int i, Real last) const {
    return Real(0.25) * (r[2 * i - 2] + last) + Real(0.75) * (r[2 * i - 1] + r[2 * i]);
  }
  SINEW_INLINE void operator()(Each<int, N> const& at, std::ptrdiff_t k) const {
    const int i = at[0];
    const bool alongX = this->halved(0), isLast = 2 * i + 1 > this->fine.grid.cells[0] + 1;
    Real b = 0;
    if (this->coarse.inverse[k] > 0)
      forFineRows(at, [&](std::ptrdiff_t base, Real weight) {
        Real const* r = this->fine.r + base;
        b += weight * (alongX ? sum(r, i, isLast ? Real(0) : r[2 * i + 1]) : r[i]);
      });
    this->coarse.b[k] = b;
  }
  void row(Each<int, N> const& at, std::ptrdiff_t first, int n) const {
    Real* b = this->coarse.b + first - 1;
    for (int i = 1; i <= n; ++i) b[i] = 0;
    const bool alongX = this->halved(0), odd = 2 * n + 1 > this->fine.grid.cells[0] + 1;
    forFineRows(at, [&](std::ptrdiff_t base, Real weight) {
      Real const* r = this->fine.r + base;
      if (!alongX) {
        for (int i = 1; i <= n; ++i) b[i] += weight * r[i];
        return;
      }
      for (int i = 1; i < n; ++i) b[i] += weight * sum(r, i, r[2 * i + 1]);
      b[n] += weight * sum(r, n, odd ? Real(0) : r[2 * n + 1]);
    });
    for (int i = 1; i <= n; ++i)
      if (!(this->coarse.inverse[first - 1 + i] > 0)) b[i] = 0;
  }
};

// Sweeps before and behind go through the colours in opposite order.

SINEW_ANY_SIDE
template <class Loops, class Real, int N>
SINEW_HD void multigrid_down(Loops const& loops, LevelView<Real, N> const& level,
                             LevelView<Real, N> const* coarse) {
  loops.cells(level.grid, FirstSweep<Real, N>{level, 0});
  loops.wrap(level.grid, level.x);
  loops.colour(level.grid, 1, Sweep<Real, N>{level});
  loops.wrap(level.grid, level.x);
  if (!coarse) {
    // the coarsest: sweeps there and back
    for (int k = 0; k < 34; ++k) {
      loops.colour(level.grid, k < 16 ? k & 1 : (k + 1) & 1, Sweep<Real, N>{level});
      loops.wrap(level.grid, level.x);
    }
    return;
  }
  loops.cells(level.grid, SharedResidual<Real, N>{level});
  loops.wrap(level.grid, level.r);
  loops.cells(coarse->grid, Restrict<Real, N>{{level, *coarse}});
}
SINEW_ANY_SIDE
template <class Loops, class Real, int N>
SINEW_HD void multigrid_up(Loops const& loops, LevelView<Real, N> const& level,
                           LevelView<Real, N> const& coarse) {
  loops.cells(level.grid, AddInterpolated<Real, N>{{{level, coarse}}});
  loops.wrap(level.grid, level.x);
  loops.colour(level.grid, 1, Sweep<Real, N>{level});
  loops.wrap(level.grid, level.x);
  loops.colour(level.grid, 0, Sweep<Real, N>{level});
  loops.wrap(level.grid, level.x);
}
/// One V-cycle over `count` levels: x = M^-1 b of the first.
SINEW_ANY_SIDE
template <class Loops, class Real, int N>
SINEW_HD void multigrid_cycle(Loops const& loops, LevelView<Real, N> const* levels, std::size_t count) {
  for (std::size_t l = 0; l < count; ++l)
    multigrid_down(loops, levels[l], l + 1 < count ? levels + l + 1 : nullptr);
  for (std::size_t l = count - 1; l-- > 0;) multigrid_up(loops, levels[l], levels[l + 1]);
}

}  // namespace sinew::fluid
