// SPDX-License-Identifier: BSL-1.0
// How many GPUs the program can use; for main_cuda.cpp, which nvcc does not compile.
#include <sinew/gpu/execution.hpp>

namespace gpu_test {

int devices() {
  int count = 0;
#if SINEW_CUDA
  if (cudaGetDeviceCount(&count) != cudaSuccess) count = 0;
#endif
  return count;
}

}  // namespace gpu_test
