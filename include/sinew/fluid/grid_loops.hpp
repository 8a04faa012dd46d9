// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/fluid/cell_grid.hpp>

#include <cmath>
#include <string_view>
#include <vector>

namespace sinew::fluid {

/// What a thread calls for each of its cells: `body`, or what body.ofThread() makes of it once, as of numbers
/// that it reads.
template <class Body>
SINEW_INLINE auto for_thread(Body const& body) {
  if constexpr (requires { body.ofThread(); })
    return body.ofThread();
  else
    return body;
}

/// Runs the loops of a fluid on a grid: here on the host, shared by its threads. What runs them on a device
/// has the same members (sinew/gpu/grid_loops.hpp). Bodies of loops are objects with nothing but numbers and
/// addresses that entries() gave, whose operator() is SINEW_HD; they write what is of their cell, and read
/// nothing that another writes. One may have a row(place, index, count) that does a row of cells at once on
/// the host, with the same bits.
class HostLoops {
 public:
  template <class T>
  using Array = std::vector<T>;
  static constexpr bool onHost = true;

  /// Numbers that loops find, and which others read where they are.
  struct Numbers {
    std::vector<double> rows{};  // sums of them
    double value[8] = {};

    template <int N>
    void init(CellGrid<N> const& grid) {
      rows.assign(grid.rows(), 0.0);
    }
    double* at(std::size_t k) { return &value[k]; }
    double read(std::size_t k) const { return value[k]; }
    std::array<double, 2> readTwo(std::size_t k) const { return {value[k], value[k + 1]}; }
  };

  HostLoops(SomeWorkers const& workers = {}) : workers_(workers) {}
  HostLoops(Workers* workers) : workers_{workers} {}
  SomeWorkers workers() const { return workers_; }

  /// Throws Error where a step cannot be made now.
  static void checkStep(std::string_view /*where*/) {}

  template <class T>
  static void assign(std::vector<T>& array, std::size_t n, T value) {
    array.assign(n, value);
  }

  /// body(place, index) for each inner cell.
  template <int N, class Body>
  void cells(CellGrid<N> const& grid, Body const& body) const {
    grid.forRows(workers_, [&](std::size_t row, std::ptrdiff_t first) {
      const auto own = for_thread(body);  // whose addresses no store can change
      Each<int, N> at = grid.place(row);
      const int n = grid.cells[0];
      if constexpr (requires { own.row(at, first, n); }) {
        own.row(at, first, n);
      } else {
        for (int k = 0; k < n; ++k) {
          at[0] = k + 1;
          own(at, first + k);
        }
      }
    });
  }
  /// The same for those inner cells whose coordinates and `colour` have an even sum: no two are neighbours.
  template <int N, class Body>
  void colour(CellGrid<N> const& grid, int colour, Body const& body) const {
    grid.forRows(workers_, [&](std::size_t row, std::ptrdiff_t first) {
      const auto own = for_thread(body);
      Each<int, N> at = grid.place(row);
      int parity = colour;
      for (const int k : at) parity += k;
      const int n = grid.cells[0];
      if constexpr (requires { own.row(at, first, parity & 1, n); }) {
        own.row(at, first, parity & 1, n);
      } else {
        for (int k = parity & 1; k < n; k += 2) {
          at[0] = k + 1;
          own(at, first + k);
        }
      }
    });
  }
  /// body(outer, inner, other, side) for all cells beside the sides across an axis (CellGrid::forSides).
  template <int N, class Body>
  void sides(CellGrid<N> const& grid, std::size_t axis, bool edges, Body const& body) const {
    grid.forSides(axis, edges, body);
  }
  template <int N, class T>
  void wrap(CellGrid<N> const& grid, T* field) const {
    grid.wrap(std::span<T>(field, grid.size));
  }
  /// body() once.
  template <class Body>
  void once(Body const& body) const {
    body();
  }

  /// One V-cycle over the levels of PoissonMultigrid.
  template <class Level>
  void cycle(Level const* levels, std::size_t count) const {
    multigrid_cycle(*this, levels, count);
  }

  /// to = the lists of so many entries one behind the other, then `last`.
  template <class Lists, class Real, std::size_t L>
  void join(Lists const& lists, std::size_t n, std::array<Real, L> const& last, std::vector<Real>& to) const {
    to.resize(n * lists.size() + L);
    workers_.run([&](WorkShare share) {
      for (std::size_t k = 0; k < lists.size(); ++k)
        std::copy(lists[k]->begin() + std::ptrdiff_t(share.begin(n)),
                  lists[k]->begin() + std::ptrdiff_t(share.end(n)),
                  to.begin() + std::ptrdiff_t(k * n + share.begin(n)));
    });
    std::copy(last.begin(), last.end(), to.end() - std::ptrdiff_t(L));
  }

  /// Number k = the sum of term(index) over inner cells, which it may also change; in an order that does not
  /// depend on threads.
  template <int N, class Term>
  void sum(CellGrid<N> const& grid, Numbers& numbers, std::size_t k, Term const& term) const {
    grid.forRows(workers_, [&](std::size_t row, std::ptrdiff_t first) {
      const auto own = for_thread(term);
      const int n = grid.cells[0];
      if constexpr (requires { own.row(first, n); }) {
        numbers.rows[row] = own.row(first, n);
      } else {
        double rowSum = 0;
        for (std::ptrdiff_t i = first; i < first + n; ++i) rowSum += own(i);
        numbers.rows[row] = rowSum;
      }
    });
    double total = 0;
    for (std::size_t row = 0; row < grid.rows(); ++row) total += numbers.rows[row];
    numbers.value[k] = total;
  }
  /// The largest term(index) >= 0 of inner cells; not finite where one of them is not.
  template <int N, class Term>
  double most(CellGrid<N> const& grid, Numbers& numbers, Term const& term) const {
    grid.forRows(workers_, [&](std::size_t row, std::ptrdiff_t first) {
      const Term own = term;
      double rowMost = 0;
      for (std::ptrdiff_t i = first; i < first + grid.cells[0]; ++i) {
        const double u = own(i);
        if (!(u <= rowMost)) rowMost = u;
        if (!std::isfinite(u)) break;
      }
      numbers.rows[row] = rowMost;
    });
    double most = 0;
    for (std::size_t row = 0; row < grid.rows(); ++row)
      if (!(numbers.rows[row] <= most)) {
        most = numbers.rows[row];
        if (!std::isfinite(most)) return most;
      }
    return most;
  }

 private:
  SomeWorkers workers_{};
};

/// What runs the loops of a fluid over some DataTypes; those of a device have their own.
template <class D>
struct GridLoopsOf {
  using type = HostLoops;
};
template <class D>
using GridLoops = typename GridLoopsOf<D>::type;

}  // namespace sinew::fluid
