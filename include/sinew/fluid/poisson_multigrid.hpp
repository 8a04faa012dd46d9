// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/fluid/cell_grid.hpp>

#include <cmath>
#include <vector>

namespace sinew::fluid {

/// The equations of pressure on a grid of cells,
///   sum over faces of c_f (q_i - q_j) + d_i q_i = b_i,
/// where c_f >= 0 joins two fluid cells and d_i >= 0 a cell to a free surface where q = 0. They are solved by
/// conjugate gradients, preconditioned by one V-cycle of geometric multigrid: red and black Gauss-Seidel
/// before and behind in opposite order, multilinear interpolation between centres of cells, its transpose for
/// residuals, and coarse faces that conduct as those of which they consist (Trottenberg, Oosterlee, Schueller
/// 2001; of irregular domains McAdams, Sifakis, Teran 2010). Interpolation takes no value from solids: its
/// weights are shared out among the other cells. The product of the weights is in the flexible form of Polak
/// and Ribiere, since sweeps over a seam with an odd number of cells are not quite symmetric. Bits do not
/// depend on the number of threads.
template <class Real, int N>
class PoissonMultigrid {
 public:
  struct Level {
    CellGrid<N> grid{};
    Each<std::vector<Real>, N> face{};  // c_f of the lower faces of cells
    std::vector<Real> surface{};        // d
    std::vector<std::uint8_t> open{};   // 0: solid
    std::vector<Real> inverse{};        // of the diagonal; 0 where nothing is to be found
    std::vector<Real> share{};          // by which interpolated values are multiplied
    std::vector<Real> x{}, b{}, r{};
  };
  struct Result {
    int iterations = 0;
    double residual = 0;  // relative to |b|
    bool converged = true;
  };

  /// The matrix is that of cells alone.
  struct NoMore {
    void operator()(std::vector<Real> const&, std::vector<Real>&) const {}
  };

  void init(CellGrid<N> grid) {
    levels_.clear();
    for (;;) {
      Level& level = levels_.emplace_back();
      level.grid = grid;
      for (auto& face : level.face) face.assign(grid.size, Real(0));
      for (auto* field : {&level.surface, &level.inverse, &level.share, &level.x, &level.b, &level.r})
        field->assign(grid.size, Real(0));
      level.open.assign(grid.size, 0);
      auto coarse = grid.cells;
      bool coarser = false;
      for (std::size_t c = 0; c < axes<N>; ++c)
        if (halves(grid, c)) coarse[c] = (coarse[c] + 1) / 2, coarser = true;
      if (!coarser) break;
      grid = CellGrid<N>(coarse, grid.periodic);
    }
    direction_.assign(levels_[0].grid.size, Real(0));
    product_ = direction_;
    sums_.assign(levels_[0].grid.rows(), 0.0);
  }
  /// Faces, free surface and solids are filled by the caller, then prepare() is called.
  Level& finest() { return levels_[0]; }
  Level const& finest() const { return levels_[0]; }
  std::size_t levelCount() const { return levels_.size(); }

  /// Makes the coarse grids from the finest.
  void prepare(SomeWorkers workers) {
    for (std::size_t l = 0; l < levels_.size(); ++l) {
      if (l > 0) coarsen(levels_[l - 1], levels_[l], workers);
      finishFaces(levels_[l], workers);
    }
    for (std::size_t l = 0; l + 1 < levels_.size(); ++l) shareWeights(levels_[l], levels_[l + 1], workers);
  }

  /// x, a first guess at first; finest().b is what is to be reached, and is the residual afterwards. Where no
  /// cell has a free surface, x is known but for a constant in each region. more(x, y) adds to y what the
  /// matrix has beside the equations of cells, symmetric and positive: the preconditioner does not know it.
  template <class More = NoMore>
  Result solve(std::vector<Real>& x, double tolerance, int maxIterations, SomeWorkers workers,
               More const& more = {}) {
    Level& top = levels_[0];
    CellGrid<N> const& grid = top.grid;
    auto at = [](auto& field, std::ptrdiff_t i) -> auto& { return field[std::size_t(i)]; };
    auto dot = [&](std::vector<Real> const& a, std::vector<Real> const& b) {
      return grid.sum(workers, sums_, [&](std::ptrdiff_t i) { return double(at(a, i)) * double(at(b, i)); });
    };
    const double wanted = std::sqrt(dot(top.b, top.b));
    Result result;
    if (!(wanted > 0)) {
      std::fill(x.begin(), x.end(), Real(0));
      return result;
    }
    grid.wrap(std::span<Real>(x));
    multiply(top, x, product_, workers);
    more(x, product_);
    grid.forCells(workers, [&](std::ptrdiff_t i) { at(top.b, i) -= at(product_, i); });
    // a guess that is worse than none
    if (double now = std::sqrt(dot(top.b, top.b)); now > wanted) {
      grid.forCells(workers, [&](std::ptrdiff_t i) {
        at(top.b, i) += at(product_, i);
        at(x, i) = Real(0);
      });
      result.residual = 1;
    } else {
      result.residual = now / wanted;
    }
    double rz = 0, alpha = 0;
    while (result.residual > tolerance) {
      if (result.iterations == maxIterations) {
        result.converged = false;
        break;
      }
      cycle(0, workers);  // top.x = M^-1 top.b
      double beta = 0;
      if (result.iterations > 0 && rz != 0) beta = -alpha * dot(top.x, product_) / rz;
      rz = dot(top.x, top.b);
      const Real share = Real(beta);
      grid.forCells(workers,
                    [&](std::ptrdiff_t i) { at(direction_, i) = at(top.x, i) + share * at(direction_, i); });
      if (result.iterations == 0)
        grid.forCells(workers, [&](std::ptrdiff_t i) { at(direction_, i) = at(top.x, i); });
      grid.wrap(std::span<Real>(direction_));
      multiply(top, direction_, product_, workers);
      more(direction_, product_);
      const double curvature = dot(direction_, product_);
      if (!(curvature > 0)) {
        result.converged = false;
        break;
      }
      alpha = rz / curvature;
      const Real step = Real(alpha);
      grid.forCells(workers, [&](std::ptrdiff_t i) {
        at(x, i) += step * at(direction_, i);
        at(top.b, i) -= step * at(product_, i);
      });
      result.residual = std::sqrt(dot(top.b, top.b)) / wanted;
      ++result.iterations;
    }
    grid.wrap(std::span<Real>(x));
    return result;
  }

 private:
  std::vector<Level> levels_{};
  std::vector<Real> direction_{}, product_{};
  std::vector<double> sums_{};

  // along a periodic axis an odd number would break the order of colours
  static bool halves(CellGrid<N> const& grid, std::size_t c) {
    return grid.cells[c] > 2 && !(grid.periodic[c] && grid.cells[c] % 2 == 1);
  }
  static bool halved(Level const& fine, Level const& coarse, std::size_t c) {
    return fine.grid.cells[c] != coarse.grid.cells[c];
  }

  static void coarsen(Level const& fine, Level& coarse, SomeWorkers workers) {
    int ways = 0;
    for (std::size_t c = 0; c < axes<N>; ++c) ways += halved(fine, coarse, c);
    // faces and distances are twice as large along each halved axis
    coarse.grid.forRows(workers, [&](std::size_t row, std::ptrdiff_t first) {
      auto at = coarse.grid.place(row);
      for (std::ptrdiff_t i = first; at[0] <= coarse.grid.cells[0]; ++at[0], ++i) {
        Each<Real, N> faces{};
        Real surface = 0;
        std::uint8_t open = 0;
        for (int child = 0; child < 1 << ways; ++child) {
          Each<int, N> place = at;
          Each<bool, N> lower{};
          bool inside = true;
          for (std::size_t c = 0, bit = 0; c < axes<N>; ++c) {
            lower[c] = true;
            if (halved(fine, coarse, c)) {
              const bool second = child >> bit++ & 1;
              place[c] = 2 * at[c] - (second ? 0 : 1);
              lower[c] = !second;
              inside = inside && place[c] <= fine.grid.cells[c];
            }
          }
          if (!inside) continue;
          const auto f = std::size_t(fine.grid.index(place));
          for (std::size_t c = 0; c < axes<N>; ++c)
            if (lower[c]) faces[c] += fine.face[c][f];
          surface += fine.surface[f];
          open = open || fine.open[f];
        }
        const auto k = std::size_t(i);
        for (std::size_t c = 0; c < axes<N>; ++c)
          coarse.face[c][k] = halved(fine, coarse, c) ? faces[c] / 2 : faces[c];
        coarse.surface[k] = surface / 2;
        coarse.open[k] = open;
      }
    });
  }
  static void finishFaces(Level& level, SomeWorkers workers) {
    for (std::size_t c = 0; c < axes<N>; ++c) level.grid.wrap(std::span<Real>(level.face[c]));
    level.grid.wrap(std::span<std::uint8_t>(level.open));
    level.grid.forCells(workers, [&](std::ptrdiff_t i) {
      const auto k = std::size_t(i);
      Real diagonal = level.surface[k];
      for (std::size_t c = 0; c < axes<N>; ++c)
        diagonal += level.face[c][k] + level.face[c][std::size_t(i + level.grid.stride[c])];
      level.inverse[k] = diagonal > 0 ? 1 / diagonal : Real(0);
    });
  }

  // The two coarse cells between whose centres that of a fine one lies, and the share of the nearer.
  struct Between {
    int near, far;
    Real weight;
  };
  static Between between(bool halved, int i) {
    if (!halved) return {i, i, Real(1)};
    const int parent = (i + 1) / 2;
    return {parent, i % 2 == 1 ? parent - 1 : parent + 1, Real(0.75)};
  }
  // f(index of the cell with x = 0 in a row of coarse cells, weight) for the rows around a fine one
  template <class F>
  static void forCoarseRows(Level const& fine, Level const& coarse, Each<int, N> const& at, F&& f) {
    Each<Between, N> places{};
    for (std::size_t c = 1; c < axes<N>; ++c) places[c] = between(halved(fine, coarse, c), at[c]);
    for (int way = 0; way < 1 << (N - 1); ++way) {
      std::ptrdiff_t base = 0;
      Real weight = 1;
      for (std::size_t c = 1; c < axes<N>; ++c) {
        const bool far = way >> (c - 1) & 1;
        base += (far ? places[c].far : places[c].near) * coarse.grid.stride[c];
        weight *= far ? 1 - places[c].weight : places[c].weight;
      }
      if (weight > 0) f(base, weight);
    }
  }
  // out[i] of a fine row += weight * the interpolated `value`
  template <class Value, class Out>
  static void interpolateRow(Level const& fine, Level const& coarse, Each<int, N> const& at, Value&& value,
                             Out&& out) {
    const bool alongX = halved(fine, coarse, 0);
    forCoarseRows(fine, coarse, at, [&](std::ptrdiff_t base, Real weight) {
      if (!alongX) {
        for (int i = 1; i <= fine.grid.cells[0]; ++i) out(i, weight * value(base + i));
        return;
      }
      for (int i = 1, parent = 1; i <= fine.grid.cells[0]; i += 2, ++parent) {
        const Real here = Real(0.75) * value(base + parent);
        out(i, weight * (here + Real(0.25) * value(base + parent - 1)));
        if (i < fine.grid.cells[0]) out(i + 1, weight * (here + Real(0.25) * value(base + parent + 1)));
      }
    });
  }
  static void shareWeights(Level& fine, Level const& coarse, SomeWorkers workers) {
    fine.grid.forRows(workers, [&](std::size_t row, std::ptrdiff_t first) {
      Real* share = fine.share.data() + first - 1;
      for (int i = 1; i <= fine.grid.cells[0]; ++i) share[i] = 0;
      interpolateRow(
          fine,
          coarse,
          fine.grid.place(row),
          [&](std::ptrdiff_t k) { return coarse.open[std::size_t(k)] ? Real(1) : Real(0); },
          [&](int i, Real w) { share[i] += w; });
      for (int i = 1; i <= fine.grid.cells[0]; ++i)
        share[i] = fine.inverse[std::size_t(first - 1 + i)] > 0 && share[i] > 0 ? 1 / share[i] : Real(0);
    });
    fine.grid.wrap(std::span<Real>(fine.share));
  }

  // (A x) of a cell but for its diagonal, with the sign of b
  static Real around(Level const& level, Real const* x, std::ptrdiff_t i) {
    Real sum = 0;
    for (std::size_t c = 0; c < axes<N>; ++c) {
      const std::ptrdiff_t s = level.grid.stride[c];
      Real const* face = level.face[c].data();
      sum += face[i] * x[i - s] + face[i + s] * x[i + s];
    }
    return sum;
  }
  static void multiply(Level const& level, std::vector<Real> const& x, std::vector<Real>& y,
                       SomeWorkers workers) {
    level.grid.forCells(workers, [&](std::ptrdiff_t i) {
      const Real inverse = level.inverse[std::size_t(i)];
      y[std::size_t(i)] = inverse > 0 ? x[std::size_t(i)] / inverse - around(level, x.data(), i) : Real(0);
    });
  }
  static void sweep(Level& level, int colour, SomeWorkers workers) {
    level.grid.forRows(workers, [&](std::size_t row, std::ptrdiff_t first) {
      const auto at = level.grid.place(row);
      int parity = colour;
      for (std::size_t c = 0; c < axes<N>; ++c) parity += at[c];
      Real* x = level.x.data();
      for (std::ptrdiff_t i = first + (parity & 1), end = first + level.grid.cells[0]; i < end; i += 2)
        x[i] = (level.b[std::size_t(i)] + around(level, x, i)) * level.inverse[std::size_t(i)];
    });
    level.grid.wrap(std::span<Real>(level.x));
  }
  // x = what a sweep over one colour makes of zero
  static void firstSweep(Level& level, int colour, SomeWorkers workers) {
    level.grid.forRows(workers, [&](std::size_t row, std::ptrdiff_t first) {
      const auto at = level.grid.place(row);
      int parity = colour;
      for (std::size_t c = 0; c < axes<N>; ++c) parity += at[c];
      for (std::ptrdiff_t i = 0; i < level.grid.cells[0]; ++i) {
        const auto k = std::size_t(first + i);
        level.x[k] = ((i ^ parity) & 1) == 0 ? level.b[k] * level.inverse[k] : Real(0);
      }
    });
    level.grid.wrap(std::span<Real>(level.x));
  }

  // x = M^-1 b of a level
  void cycle(std::size_t l, SomeWorkers workers) {
    Level& level = levels_[l];
    firstSweep(level, 0, workers);
    sweep(level, 1, workers);
    if (l + 1 == levels_.size()) {
      for (int k = 0; k < 8; ++k) sweep(level, 0, workers), sweep(level, 1, workers);
      for (int k = 0; k < 9; ++k) sweep(level, 1, workers), sweep(level, 0, workers);
      return;
    }
    Level& coarse = levels_[l + 1];
    level.grid.forCells(workers, [&](std::ptrdiff_t i) {
      const auto k = std::size_t(i);
      const Real inverse = level.inverse[k];
      level.r[k] = inverse > 0 ? (level.b[k] - level.x[k] / inverse + around(level, level.x.data(), i)) *
                                     level.share[k]
                               : Real(0);
    });
    level.grid.wrap(std::span<Real>(level.r));
    restrictTo(level, coarse, workers);
    cycle(l + 1, workers);
    level.grid.forRows(workers, [&](std::size_t row, std::ptrdiff_t first) {
      Real* x = level.x.data() + first - 1;
      Real const* share = level.share.data() + first - 1;
      interpolateRow(
          level,
          coarse,
          level.grid.place(row),
          [&](std::ptrdiff_t k) { return coarse.x[std::size_t(k)]; },
          [&](int i, Real value) { x[i] += share[i] * value; });
    });
    level.grid.wrap(std::span<Real>(level.x));
    sweep(level, 1, workers);
    sweep(level, 0, workers);
  }

  // b of the coarse level = the transpose of interpolation of r
  static void restrictTo(Level const& fine, Level& coarse, SomeWorkers workers) {
    coarse.grid.forRows(workers, [&](std::size_t row, std::ptrdiff_t first) {
      const auto at = coarse.grid.place(row);
      for (int i = 0; i < coarse.grid.cells[0]; ++i) coarse.b[std::size_t(first + i)] = 0;
      const bool alongX = halved(fine, coarse, 0);
      forFineRows(fine, coarse, at, [&](std::ptrdiff_t base, Real weight) {
        Real const* r = fine.r.data() + base;
        Real* b = coarse.b.data() + first - 1;
        const int n = coarse.grid.cells[0], last = fine.grid.cells[0] + 1;
        if (!alongX) {
          for (int i = 1; i <= n; ++i) b[i] += weight * r[i];
          return;
        }
        for (int i = 1; i < n; ++i)
          b[i] +=
              weight * (Real(0.25) * (r[2 * i - 2] + r[2 * i + 1]) + Real(0.75) * (r[2 * i - 1] + r[2 * i]));
        b[n] += weight * (Real(0.25) * (r[2 * n - 2] + (2 * n + 1 <= last ? r[2 * n + 1] : Real(0))) +
                          Real(0.75) * (r[2 * n - 1] + r[2 * n]));
      });
      for (int i = 0; i < coarse.grid.cells[0]; ++i)
        if (!(coarse.inverse[std::size_t(first + i)] > 0)) coarse.b[std::size_t(first + i)] = 0;
    });
  }
  // f(index of the cell with x = 0 in a row of fine cells, weight) for the rows that take from a coarse one
  template <class F>
  static void forFineRows(Level const& fine, Level const& coarse, Each<int, N> const& at, F&& f) {
    constexpr std::array<Real, 4> weights{Real(0.25), Real(0.75), Real(0.75), Real(0.25)};
    constexpr int ways = N == 2 ? 4 : 16;
    for (int way = 0; way < ways; ++way) {
      std::ptrdiff_t base = 0;
      Real weight = 1;
      for (std::size_t c = 1; c < axes<N>; ++c) {
        const int k = way >> (2 * (c - 1)) & 3;
        int place = at[c];
        if (halved(fine, coarse, c)) {
          place = 2 * at[c] - 2 + k;
          weight *= place <= fine.grid.cells[c] + 1 ? weights[std::size_t(k)] : Real(0);
        } else if (k > 0) {
          weight = 0;
        }
        base += place * fine.grid.stride[c];
      }
      if (weight > 0) f(base, weight);
    }
  }
};

}  // namespace sinew::fluid
