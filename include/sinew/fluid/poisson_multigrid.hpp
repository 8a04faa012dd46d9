// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/core/point_loop.hpp>
#include <sinew/fluid/gradient_loops.hpp>
#include <sinew/fluid/grid_loops.hpp>
#include <sinew/fluid/multigrid_loops.hpp>

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
template <class Real, int N, class Loops = HostLoops>
class PoissonMultigrid {
 public:
  using Field = typename Loops::template Array<Real>;
  struct Level {
    CellGrid<N> grid{};
    Each<Field, N> face{};                                // c_f of the lower faces of cells
    Field surface{};                                      // d
    typename Loops::template Array<std::uint8_t> open{};  // 0: solid
    Field inverse{};                                      // of the diagonal; 0 where nothing is to be found
    Field share{};                                        // by which interpolated values are multiplied
    Field x{}, b{}, r{};

    LevelView<Real, N> view() {
      LevelView<Real, N> v{grid,
                           {},
                           entries(surface),
                           entries(inverse),
                           entries(share),
                           entries(x),
                           entries(b),
                           entries(r),
                           entries(open)};
      for (std::size_t c = 0; c < axes<N>; ++c) v.face[c] = entries(face[c]);
      return v;
    }
  };
  struct Result {
    int iterations = 0;
    double residual = 0;  // relative to |b|
    bool converged = true;
  };

  /// The matrix is that of cells alone.
  struct NoMore {
    static constexpr bool any = false;
    void operator()(Field const&, Field&) const {}
  };

  void init(CellGrid<N> grid) {
    levels_.clear();
    for (;;) {
      Level& level = levels_.emplace_back();
      level.grid = grid;
      for (auto& face : level.face) Loops::assign(face, grid.size, Real(0));
      for (auto* field : {&level.surface, &level.inverse, &level.share, &level.x, &level.b, &level.r})
        Loops::assign(*field, grid.size, Real(0));
      Loops::assign(level.open, grid.size, std::uint8_t(0));
      auto coarse = grid.cells;
      bool coarser = false;
      for (std::size_t c = 0; c < axes<N>; ++c)
        if (halves(grid, c)) coarse[c] = (coarse[c] + 1) / 2, coarser = true;
      if (!coarser) break;
      grid = CellGrid<N>(coarse, grid.periodic);
    }
    views_.reserve(levels_.size());
    Loops::assign(direction_, levels_[0].grid.size, Real(0));
    Loops::assign(product_, levels_[0].grid.size, Real(0));
    numbers_.init(levels_[0].grid);
  }
  /// Faces, free surface and solids are filled by the caller, then prepare() is called.
  Level& finest() { return levels_[0]; }
  Level const& finest() const { return levels_[0]; }
  std::size_t levelCount() const { return levels_.size(); }

  /// Makes the coarse grids from the finest.
  void prepare(Loops const& loops) {
    look();
    for (std::size_t l = 0; l < views_.size(); ++l) {
      auto const& level = views_[l];
      if (l > 0) loops.cells(level.grid, Coarsen<Real, N>{{views_[l - 1], level}});
      for (std::size_t c = 0; c < axes<N>; ++c) loops.wrap(level.grid, level.face[c]);
      loops.wrap(level.grid, level.open);
      loops.cells(level.grid, InvertDiagonal<Real, N>{level});
    }
    for (std::size_t l = 0; l + 1 < views_.size(); ++l) {
      loops.cells(views_[l].grid, ShareWeights<Real, N>{{{views_[l], views_[l + 1]}}});
      loops.wrap(views_[l].grid, views_[l].share);
    }
  }

  /// x, a first guess at first; finest().b is what is to be reached, and is the residual afterwards. Where no
  /// cell has a free surface, x is known but for a constant in each region. more(x, y) adds to y what the
  /// matrix has beside the equations of cells, symmetric and positive, where more.any says so: the
  /// preconditioner does not know it.
  template <class More = NoMore>
  Result solve(Field& x, double tolerance, int maxIterations, Loops const& loops, More const& more = {}) {
    look();
    LevelView<Real, N> const& top = views_[0];
    CellGrid<N> const& grid = top.grid;
    double* const at = numbers_.at(0);
    loops.sum(grid, numbers_, squares, SquareOf<Real>{top.b});
    const double wanted = std::sqrt(numbers_.read(squares));
    Result result;
    if (!(wanted > 0)) {
      Loops::assign(x, grid.size, Real(0));
      return result;
    }
    loops.wrap(grid, entries(x));
    loops.cells(grid, Multiply<Real, N>{top, entries(std::as_const(x)), entries(product_)});
    if (more.any) more(x, product_);
    loops.sum(grid, numbers_, squares, TakeProduct<Real>{top.b, entries(std::as_const(product_))});
    // a guess that is worse than none
    if (double now = std::sqrt(numbers_.read(squares)); now > wanted) {
      loops.cells(grid, ForgetGuess<Real, N>{top.b, entries(std::as_const(product_)), entries(x)});
      result.residual = 1;
    } else {
      result.residual = now / wanted;
    }
    while (result.residual > tolerance) {
      if (result.iterations == maxIterations) {
        result.converged = false;
        break;
      }
      const bool goesOn = result.iterations > 0;
      loops.cycle(views_.data(), views_.size());  // top.x = M^-1 top.b
      if (goesOn) loops.sum(grid, numbers_, mixed, DotOf<Real>{top.x, entries(std::as_const(product_))});
      loops.once(Turn{at + beta, at + mixed, at + alpha, at + rz, goesOn});
      loops.sum(grid, numbers_, rz, DotOf<Real>{top.x, top.b});
      loops.cells(grid, TakeDirection<Real, N>{top.x, entries(direction_), at + beta, goesOn});
      loops.wrap(grid, entries(direction_));
      const Multiply<Real, N> multiply{top, entries(std::as_const(direction_)), entries(product_)};
      if (more.any) {
        loops.cells(grid, multiply);
        more(direction_, product_);
        loops.sum(grid,
                  numbers_,
                  curvature,
                  DotOf<Real>{entries(std::as_const(direction_)), entries(std::as_const(product_))});
      } else {
        loops.sum(grid, numbers_, curvature, MultiplyAndDot<Real, N>{multiply});
      }
      loops.once(Step{at + alpha, at + rz, at + curvature});
      loops.sum(grid,
                numbers_,
                squares,
                Advance<Real>{entries(x),
                              entries(std::as_const(direction_)),
                              top.b,
                              entries(std::as_const(product_)),
                              at + alpha,
                              at + curvature});
      const auto [left, curved] = numbers_.readTwo(squares);
      if (!(curved > 0)) {
        result.converged = false;
        break;
      }
      result.residual = std::sqrt(left) / wanted;
      ++result.iterations;
    }
    loops.wrap(grid, entries(x));
    return result;
  }

 private:
  std::vector<Level> levels_{};
  std::vector<LevelView<Real, N>> views_{};
  Field direction_{}, product_{};
  typename Loops::Numbers numbers_{};
  // which number is what
  static constexpr std::size_t squares = 0, curvature = 1, rz = 2, mixed = 3, alpha = 4, beta = 5;

  // along a periodic axis an odd number would break the order of colours
  static bool halves(CellGrid<N> const& grid, std::size_t c) {
    return grid.cells[c] > 2 && !(grid.periodic[c] && grid.cells[c] % 2 == 1);
  }
  void look() {
    views_.clear();
    for (Level& level : levels_) views_.push_back(level.view());
  }
};

}  // namespace sinew::fluid
