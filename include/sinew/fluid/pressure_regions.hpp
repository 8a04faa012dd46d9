// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/fluid/poisson_multigrid.hpp>

#include <cstdlib>
#include <vector>

namespace sinew::fluid {

/// Regions of cells that pressure joins. What no pressure can take away from one without a free surface, as
/// where a body closes a corner of a tank, flows out of all its cells alike.
template <class Real, int N, class Loops = HostLoops>
class PressureRegions {
 public:
  using Level = typename PoissonMultigrid<Real, N, Loops>::Level;

  void init(CellGrid<N> const& grid) {
    if (region_.size() == grid.size) return;
    region_.assign(grid.size, 0);
    queue_.reserve(grid.inner());
  }

  /// Takes the mean out of b in each region without a surface.
  void balance(Level& of) {
    const View level{of};
    std::fill(region_.begin(), region_.end(), 0);
    int number = 0;
    level.grid.forCells({}, [&](std::ptrdiff_t start) {
      if (region_[at(start)] != 0 || !(level.inverse[at(start)] > 0)) return;
      ++number;
      queue_.clear();
      auto join = [&](std::ptrdiff_t i) {
        if (region_[at(i)] != 0) return;
        region_[at(i)] = number;
        queue_.push_back(int(i));
      };
      join(start);
      bool surfaceMet = false;
      double sum = 0;
      for (std::size_t k = 0; k < queue_.size(); ++k) {
        const std::ptrdiff_t i = queue_[k];
        sum += double(level.b[at(i)]);
        surfaceMet = surfaceMet || level.surface[at(i)] > 0;
        level.grid.forNeighbours(i, [&](std::ptrdiff_t j) {
          if (level.inverse[at(j)] > 0 && joined(level, i, j)) join(j);
        });
      }
      if (surfaceMet) return;
      const Real mean = Real(sum / double(queue_.size()));
      for (const int i : queue_) of.b[std::size_t(i)] -= mean;
    });
  }

 private:
  std::vector<int> region_{}, queue_{};

  // on the host, wherever it is
  struct View {
    CellGrid<N> const& grid;
    Each<Real const*, N> face;
    Real const *surface, *inverse, *b;

    explicit View(Level const& level)
        : grid(level.grid),
          face{},
          surface(level.surface.data()),
          inverse(level.inverse.data()),
          b(level.b.data()) {
      for (std::size_t c = 0; c < axes<N>; ++c) face[c] = level.face[c].data();
    }
  };

  static std::size_t at(std::ptrdiff_t i) { return std::size_t(i); }
  // whether pressure joins two cells beside each other, across the ends of a periodic axis, too
  static bool joined(View const& level, std::ptrdiff_t i, std::ptrdiff_t j) {
    const std::ptrdiff_t apart = std::abs(j - i);
    for (std::size_t c = 0; c < axes<N>; ++c) {
      const std::ptrdiff_t s = level.grid.stride[c], n = level.grid.cells[c];
      if (apart == s && level.face[c][at(std::max(i, j))] > 0) return true;
      if (apart == (n - 1) * s && level.face[c][at(std::min(i, j))] > 0) return true;
    }
    return false;
  }
};

}  // namespace sinew::fluid
