// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/gpu/execution.hpp>

#include <array>
#include <cstddef>

namespace sinew::gpu {

/// Room for sums that are being made; one for each device of a thread of the host.
struct SumBuffer {
  static constexpr unsigned blocks = 1056;  // at most; eight on each of 132 multiprocessors
  DeviceArray<double> parts{};              // one a block, and behind them the sum for the host
  DeviceArray<unsigned> counts{};           // blocks that are done; 0 between sums
};
inline SumBuffer& sum_buffer() {
  static thread_local std::array<SumBuffer, most_devices> all{};
  SumBuffer& buffer = all[std::size_t(current_device())];
  if (!buffer.parts.data()) {
    buffer.parts.resize(SumBuffer::blocks + 1);
    buffer.counts.resize(1);
    const unsigned none = 0;
    copy_to_device(buffer.counts.data(), &none, 1);
  }
  return buffer;
}

namespace detail {

/// What a thread calls for each of its indices: `term`, or what term.ofThread() makes of it once.
template <class Term>
SINEW_INLINE decltype(auto) of_thread(Term const& term) {
  if constexpr (requires { term.ofThread(); })
    return term.ofThread();
  else
    return (term);
}

/// Where a sum goes: to one place, or as `put` has it.
SINEW_INLINE void put_sum(double* to, double sum) { *to = sum; }
template <class To>
SINEW_INLINE void put_sum(To const& to, double sum) {
  to.put(sum);
}

#if SINEW_CUDA
/// The sum of one value a thread, in the same order whenever the block has the same size; valid in thread 0.
__device__ inline double block_sum(double value) {
  __shared__ double ofWarp[max_threads / 32];
  for (int offset = 16; offset > 0; offset /= 2) value += __shfl_down_sync(0xffffffffu, value, offset);
  __syncthreads();
  if (threadIdx.x % 32 == 0) ofWarp[threadIdx.x / 32] = value;
  __syncthreads();
  double sum = 0;
  if (threadIdx.x == 0)
    for (unsigned w = 0; w < blockDim.x / 32; ++w) sum += ofWarp[w];
  return sum;
}

/// The last block that is done adds up what all have found.
template <class Term, class To>
__global__ void __launch_bounds__(max_threads)
    sum_kernel(unsigned count, Term term, double* parts, unsigned* done, To to) {
  double sum = 0;
  auto const& ofThread = of_thread(term);
  for (unsigned i = blockIdx.x * blockDim.x + threadIdx.x; i < count; i += gridDim.x * blockDim.x)
    sum += ofThread(int(i));
  sum = block_sum(sum);
  __shared__ bool last;
  if (threadIdx.x == 0) {
    parts[blockIdx.x] = sum;
    __threadfence();
    last = atomicAdd(done, 1u) == gridDim.x - 1;
  }
  __syncthreads();
  if (!last) return;
  __threadfence();
  double all = 0;
  for (unsigned b = threadIdx.x; b < gridDim.x; b += blockDim.x) all += __ldcg(parts + b);
  all = block_sum(all);
  if (threadIdx.x == 0) {
    put_sum(to, all);
    *done = 0;
  }
}

#endif

}  // namespace detail

/// *to = the sum of term(i) for i = 0 .. count - 1; `to` is on the device, or an object whose put(sum) is
/// called there; term(i) is called once for each i and may write. The order of the sum depends on `count`
/// alone.
template <class Term, class To>
void sum_indices(std::size_t count, Term const& term, To to) {
#if SINEW_CUDA
  SumBuffer& buffer = sum_buffer();
  const unsigned threads = threads_for(count), needed = unsigned((count + threads - 1) / threads);
  const unsigned blocks = std::max(1u, std::min(SumBuffer::blocks, needed));
  detail::sum_kernel<<<blocks, threads, 0, stream()>>>(
      unsigned(count), term, buffer.parts.data(), buffer.counts.data(), to);
  check(cudaGetLastError(), "a sum on the GPU");
#else
  double sum = 0;
  auto const& ofThread = detail::of_thread(term);
  for (std::size_t i = 0; i < count; ++i) sum += ofThread(int(i));
  detail::put_sum(to, sum);
#endif
}
/// The same, brought to the host, which waits for it.
template <class Term>
double sum_on_host(std::size_t count, Term const& term) {
  double* const buffer = sum_buffer().parts.data() + SumBuffer::blocks;
  sum_indices(count, term, buffer);
  double sum = 0;
  copy_to_host(&sum, buffer, 1);
  return sum;
}

}  // namespace sinew::gpu
