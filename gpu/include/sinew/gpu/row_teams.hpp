// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/gpu/execution.hpp>

#include <cstddef>

namespace sinew::gpu {

#if SINEW_CUDA
namespace detail {
template <int Lanes, class Body>
__global__ void __launch_bounds__(max_threads) row_team_kernel(unsigned count, Body body) {
  using Real = typename Body::Real;
  const unsigned thread = blockIdx.x * blockDim.x + threadIdx.x;
  const unsigned i = thread / Lanes, lane = thread % Lanes;
  Real sum[Body::sums];
  for (Real& s : sum) s = Real(0);
  if (i < count) body.part(int(i), int(lane), Lanes, sum);
  for (int offset = Lanes / 2; offset > 0; offset /= 2)
    for (Real& s : sum) s += __shfl_xor_sync(0xffffffffu, s, offset);
  if (i < count && lane == 0) body.finish(int(i), sum);
}
}  // namespace detail
#endif

/// For i = 0 .. count - 1 body.finish(i, sum), where each of the `lanes` of a team has added its part of the
/// Body::sums numbers of type Body::Real by body.part(i, lane, lanes, sum), of what it takes in turn. A team
/// has Lanes threads on a GPU, a power of two up to 32, and one on the host. The order of sums is always the
/// same.
template <int Lanes, class Body>
void for_each_row(std::size_t count, Body const& body) {
  if (count == 0) return;
#if SINEW_CUDA
  const std::size_t all = count * Lanes;
  const unsigned threads = threads_for(all);
  detail::row_team_kernel<Lanes>
      <<<unsigned((all + threads - 1) / threads), threads, 0, stream()>>>(unsigned(count), body);
  check(cudaGetLastError(), "a loop on the GPU");
#else
  for (std::size_t i = 0; i < count; ++i) {
    typename Body::Real sum[Body::sums] = {};
    body.part(int(i), 0, 1, sum);
    body.finish(int(i), sum);
  }
#endif
}
/// The same with few lanes where there are many rows, and with 32 where there are few.
template <class Body>
void for_each_row(std::size_t count, Body const& body) {
  if (count >= 16384)
    for_each_row<8>(count, body);
  else
    for_each_row<32>(count, body);
}

}  // namespace sinew::gpu
