// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/fluid/grid_loops.hpp>
#include <sinew/fluid/multigrid_loops.hpp>
#include <sinew/gpu/data_types.hpp>
#include <sinew/gpu/grid_kernels.hpp>

#include <array>
#include <cmath>
#include <string_view>

namespace sinew::gpu {

/// Runs the loops of a fluid on a grid on the device, a thread a cell: fluid::HostLoops says what is asked of
/// it. Sums are made in an order of their own that is always the same.
class GridLoops {
 public:
  template <class T>
  using Array = DeviceVector<T>;
  static constexpr bool onHost = false;

  class Numbers {
   public:
    template <int N>
    void init(fluid::CellGrid<N> const&) {
      values_.resize(8);
    }
    double* at(std::size_t k) { return values_.data() + k; }
    double read(std::size_t k) const {
      double value = 0;
      copy_to_host(&value, values_.data() + k, 1);
      return value;
    }
    std::array<double, 2> readTwo(std::size_t k) const {
      std::array<double, 2> two{};
      copy_to_host(two.data(), values_.data() + k, 2);
      return two;
    }

   private:
    WorkArray<double> values_{};
  };

  GridLoops(SomeWorkers const& = {}) {}

  static void checkStep(std::string_view where) {
    if (recording())
      throw Error(where,
                  "the pressure of a fluid on a grid is solved until the host has seen that it is, which a "
                  "recorded step cannot; animate() the simulation");
  }
  template <class T>
  static void assign(DeviceVector<T>& array, std::size_t n, T value) {
    for_each_index(n, detail::FillWith<T>{array.overwrite(n), value});
  }

  template <int N, class Body>
  void cells(fluid::CellGrid<N> const& grid, Body const& body) const {
#if SINEW_CUDA
    detail::launch_cells(grid, -1, body);
#else
    for_each_index(grid.inner(), detail::InnerCell<N, Body>{grid, body});
#endif
  }
  template <int N, class Body>
  void colour(fluid::CellGrid<N> const& grid, int colour, Body const& body) const {
#if SINEW_CUDA
    detail::launch_cells(grid, colour, body);
#else
    for_each_index(grid.inner(), detail::CellOfColour<N, Body>{{grid, body}, colour});
#endif
  }
  template <int N, class Body>
  void sides(fluid::CellGrid<N> const& grid, std::size_t axis, bool edges, Body const& body) const {
    const auto side = grid.side(axis, edges);
    std::size_t count = 1;
    for (const int n : side.count) count *= std::size_t(n);
    for_each_index(count, detail::CellBeside<N, Body>{grid, side, axis, body});
  }
  template <int N, class T>
  void wrap(fluid::CellGrid<N> const& grid, T* field) const {
    for (std::size_t axis = 0; axis < N; ++axis)
      if (grid.periodic[axis]) sides(grid, axis, true, fluid::CopyOther<T>{field});
  }
  /// body(k) for k = 0 .. count - 1.
  template <class Body>
  static void each(std::size_t count, Body const& body) {
    for_each_index(count, body);
  }
  template <class Body>
  void once(Body const& body) const {
    for_each_index(1, detail::Once<Body>{body});
  }

  template <class Real, int N>
  void cycle(fluid::LevelView<Real, N> const* levels, std::size_t count) const {
#if SINEW_CUDA
    // small levels by the threads of one block: launches would take longer than their work
    std::size_t small = count;
    while (small > 1 && count - small + 1 <= detail::SmallLevels<Real, N>::most &&
           levels[small - 1].grid.inner() <= detail::smallLevel)
      --small;
    for (std::size_t l = 0; l < small; ++l)
      fluid::multigrid_down(*this, levels[l], l + 1 < count ? levels + l + 1 : nullptr);
    if (small < count) detail::launch_small_levels(levels + small, count - small);
    for (std::size_t l = std::min(small, count - 1); l-- > 0;)
      fluid::multigrid_up(*this, levels[l], levels[l + 1]);
#else
    fluid::multigrid_cycle(*this, levels, count);
#endif
  }

  template <class Lists, class Real, std::size_t L>
  void join(Lists const& lists, std::size_t n, std::array<Real, L> const& last,
            DeviceVector<Real>& to) const {
    Real* at = to.overwrite(n * lists.size() + L);
    for (auto const* list : lists) {
      copy_on_device(at, list->device(), n);
      at += n;
    }
    copy_to_device(at, last.data(), L);
  }

  template <int N, class Term>
  void sum(fluid::CellGrid<N> const& grid, Numbers& numbers, std::size_t k, Term const& term) const {
    sum_indices(grid.inner(), detail::InnerTerm<N, Term>{grid, term}, numbers.at(k));
  }
  template <int N, class Term>
  double most(fluid::CellGrid<N> const& grid, Numbers& numbers, Term const& term) const {
    most_of_indices(grid.inner(), detail::InnerTerm<N, Term>{grid, term}, numbers.at(0));
    return numbers.read(0);
  }
};

}  // namespace sinew::gpu

template <class H>
struct sinew::fluid::GridLoopsOf<sinew::CudaTypes<H>> {
  using type = sinew::gpu::GridLoops;
};
