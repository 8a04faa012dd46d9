// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/core/platform.hpp>

#include <thrust/execution_policy.h>
#include <thrust/for_each.h>
#include <thrust/iterator/counting_iterator.h>

#include <cstddef>

#if THRUST_DEVICE_SYSTEM == THRUST_DEVICE_SYSTEM_CUDA
#include <thrust/system/cuda/execution_policy.h>
#endif

namespace sinew::gpu {

/// Where Sinew's device work runs: Thrust's device system, which is chosen by -DTHRUST_DEVICE_SYSTEM (CUDA
/// under nvcc; CPP or OMP elsewhere). On CUDA work is queued, runs in order, and is waited for by the first
/// copy to the host.
inline auto queue() {
#if THRUST_DEVICE_SYSTEM == THRUST_DEVICE_SYSTEM_CUDA
  return thrust::cuda::par_nosync;
#else
  return thrust::device;
#endif
}

/// body(i) for i = 0 .. count - 1, one thread each. `body` is an object whose operator() is SINEW_HD.
template <class Body>
void for_each_index(std::size_t count, Body const& body) {
  thrust::for_each_n(queue(), thrust::counting_iterator<int>(0), int(count), body);
}

}  // namespace sinew::gpu
