// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/fluid/grid_loops.hpp>
#include <sinew/fluid/multigrid_loops.hpp>
#include <sinew/gpu/execution.hpp>
#include <sinew/gpu/reduction.hpp>

#include <algorithm>
#include <array>

namespace sinew::gpu {

namespace detail {

template <class T>
struct FillWith {
  T* to;
  T value;
  SINEW_HD void operator()(int i) const { to[i] = value; }
};

/// The place of an inner cell by its number.
template <int N>
SINEW_INLINE fluid::Each<int, N> place_of(fluid::CellGrid<N> const& grid, unsigned number) {
  fluid::Each<int, N> at{};
  for (std::size_t c = 0; c + 1 < fluid::axes<N>; ++c) {
    const unsigned n = unsigned(grid.cells[c]), rest = number / n;
    at[c] = int(number - rest * n) + 1;
    number = rest;
  }
  at[fluid::axes<N> - 1] = int(number) + 1;
  return at;
}

// bodies of loops over cells as those over indices

template <int N, class Body>
struct InnerCell {
  fluid::CellGrid<N> grid;
  Body body;
  SINEW_HD void operator()(int k) const {
    const auto at = place_of(grid, unsigned(k));
    of_thread(body)(at, grid.index(at));
  }
};
template <int N, class Body>
struct CellOfColour : InnerCell<N, Body> {
  int colour;
  SINEW_HD void operator()(int k) const {
    const auto at = place_of(this->grid, unsigned(k));
    int parity = colour;
    for (std::size_t c = 0; c < fluid::axes<N>; ++c) parity += at[c];
    if ((parity & 1) == 0) of_thread(this->body)(at, this->grid.index(at));
  }
};
template <int N, class Body>
struct CellBeside {
  fluid::CellGrid<N> grid;
  typename fluid::CellGrid<N>::Side side;
  std::size_t axis;
  Body body;
  SINEW_HD void operator()(int k) const { grid.onBothSides(axis, grid.sideIndex(side, k), body); }
};
template <class Body>
struct Once {
  Body body;
  SINEW_HD void operator()(int) const { body(); }
};
/// A term of a sum over inner cells.
template <int N, class Term>
struct InnerTerm {
  fluid::CellGrid<N> grid;
  Term term;

  SINEW_INLINE auto ofThread() const
  requires requires(Term const& t) { t.ofThread(); }
  {
    return InnerTerm<N, std::decay_t<decltype(term.ofThread())>>{grid, term.ofThread()};
  }
  SINEW_HD double operator()(int k) const
  requires requires(Term const& t) { t(std::ptrdiff_t()); }
  {
    return term(grid.index(place_of(grid, unsigned(k))));
  }
};

#if SINEW_CUDA
/// body(place, index) for inner cells, or for those of a colour: a thread each.
template <int N, class Body>
__global__ void __launch_bounds__(max_threads) cells_kernel(const __grid_constant__ fluid::CellGrid<N> grid,
                                                            int colour, const __grid_constant__ Body body) {
  fluid::Each<int, N> at{};
  const int across = int(blockIdx.x * blockDim.x + threadIdx.x);
  auto const& own = of_thread(body);
  auto row = [&] {
    int first = 0;
    if (colour >= 0) {
      first = colour + 1;
      for (std::size_t c = 1; c < fluid::axes<N>; ++c) first += at[c];
      first = (first & 1) + across;
    }
    at[0] = across + first + 1;
    if (at[0] <= grid.cells[0]) own(at, grid.index(at));
  };
  for (int y = int(blockIdx.y * blockDim.y + threadIdx.y); y < grid.cells[1];
       y += int(gridDim.y * blockDim.y)) {
    at[1] = y + 1;
    if constexpr (N == 3)
      for (int z = int(blockIdx.z); z < grid.cells[2]; z += int(gridDim.z)) {
        at[2] = z + 1;
        row();
      }
    else
      row();
  }
}
template <int N, class Body>
void launch_cells(fluid::CellGrid<N> const& grid, int colour, Body const& body) {
  constexpr unsigned most = 65535;
  const unsigned across = unsigned(colour < 0 ? grid.cells[0] : (grid.cells[0] + 1) / 2);
  unsigned x = 32, y = grid.inner() >= 65536 ? 8 : 4;
  while (x > 4 && x / 2 >= across) x /= 2, y *= 2;
  const dim3 threads(x, y);
  const unsigned rows = (unsigned(grid.cells[1]) + y - 1) / y;
  const dim3 blocks((across + x - 1) / x,
                    std::min(most, rows),
                    N == 3 ? std::min(most, unsigned(grid.cells[fluid::axes<N> - 1])) : 1);
  cells_kernel<<<blocks, threads, 0, stream()>>>(grid, colour, body);
  check(cudaGetLastError(), "a loop over the cells of a fluid");
}

/// Levels of multigrid with so few cells are run by one block.
inline constexpr std::size_t smallLevel = 4096;
template <class Real, int N>
struct SmallLevels {
  static constexpr std::size_t most = 12;
  std::array<fluid::LevelView<Real, N>, most> level;
  std::size_t count;
};
/// The loops of one block, whose threads wait for each other behind each.
struct BlockLoops {
  template <int N, class Body>
  __device__ void cells(fluid::CellGrid<N> const& grid, Body const& body) const {
    for (unsigned k = threadIdx.x; k < unsigned(grid.inner()); k += blockDim.x) {
      const auto at = place_of(grid, k);
      body(at, grid.index(at));
    }
    __syncthreads();
  }
  template <int N, class Body>
  __device__ void colour(fluid::CellGrid<N> const& grid, int colour, Body const& body) const {
    for (unsigned k = threadIdx.x; k < unsigned(grid.inner()); k += blockDim.x) {
      const auto at = place_of(grid, k);
      int parity = colour;
      for (std::size_t c = 0; c < fluid::axes<N>; ++c) parity += at[c];
      if ((parity & 1) == 0) body(at, grid.index(at));
    }
    __syncthreads();
  }
  template <int N, class T>
  __device__ void wrap(fluid::CellGrid<N> const& grid, T* field) const {
    for (std::size_t axis = 0; axis < N; ++axis) {
      if (!grid.periodic[axis]) continue;
      const auto side = grid.side(axis, true);
      int count = 1;
      for (std::size_t c = 0; c < fluid::axes<N>; ++c) count *= side.count[c];
      for (int k = int(threadIdx.x); k < count; k += int(blockDim.x))
        grid.onBothSides(axis, grid.sideIndex(side, k), fluid::CopyOther<T>{field});
      __syncthreads();
    }
  }
};
template <class Real, int N>
__global__ void __launch_bounds__(1024)
    small_levels_kernel(const __grid_constant__ SmallLevels<Real, N> levels) {
  fluid::multigrid_cycle(BlockLoops{}, levels.level.data(), levels.count);
}
template <class Real, int N>
void launch_small_levels(fluid::LevelView<Real, N> const* from, std::size_t count) {
  SmallLevels<Real, N> levels{};
  std::copy_n(from, count, levels.level.begin());
  levels.count = count;
  const auto threads = unsigned(std::min<std::size_t>(1024, (from[0].grid.inner() + 31) / 32 * 32));
  small_levels_kernel<<<1, threads, 0, stream()>>>(levels);
  check(cudaGetLastError(), "the coarse grids of a fluid");
}

/// As a maximum of their bits: those of numbers >= 0 are in their order, and behind them come infinity and
/// what is no number.
template <class Term>
__global__ void __launch_bounds__(max_threads) most_kernel(unsigned count, Term term, double* to) {
  unsigned long long most = 0;
  auto const& ofThread = of_thread(term);
  for (unsigned i = blockIdx.x * blockDim.x + threadIdx.x; i < count; i += gridDim.x * blockDim.x)
    most = max(most, static_cast<unsigned long long>(__double_as_longlong(ofThread(int(i)))));
  for (int offset = 16; offset > 0; offset /= 2)
    most = max(most, __shfl_down_sync(0xffffffffu, most, offset));
  if (threadIdx.x % 32 == 0) atomicMax(reinterpret_cast<unsigned long long*>(to), most);
}
#endif

}  // namespace detail

/// *to = the largest term(i) >= 0 for i = 0 .. count - 1; not finite where one of them is not.
template <class Term>
void most_of_indices(std::size_t count, Term const& term, double* to) {
#if SINEW_CUDA
  clear_on_device(to, 1);
  const unsigned needed = unsigned((count + max_threads - 1) / max_threads);
  detail::most_kernel<<<std::max(1u, std::min(SumBuffer::blocks, needed)), max_threads, 0, stream()>>>(
      unsigned(count), term, to);
  check(cudaGetLastError(), "a maximum on the GPU");
#else
  double most = 0;
  auto const& ofThread = detail::of_thread(term);
  for (std::size_t i = 0; i < count; ++i)
    if (const double value = ofThread(int(i)); !(value <= most)) {
      most = value;
      if (!(most <= 1e308)) break;
    }
  *to = most;
#endif
}

}  // namespace sinew::gpu
