// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/gpu/execution.hpp>

#include <algorithm>

#if SINEW_CUDA
#include <cooperative_groups.h>
#else
#include <barrier>
#include <thread>
#include <vector>
#endif

namespace sinew::gpu {

// A method with many short loops, sums between them and decisions by these sums runs as one kernel: its
// threads all go through the same code, share the indices of each loop, and wait for each other only where
// one needs what others have written. All find the same sums, and so take the same decisions.

#if SINEW_CUDA

/// All threads of a launch, whose blocks run at once (cooperative).
class WholeTeam {
 public:
  static constexpr int lanes = 8;  // threads that share a row
  static constexpr int threads = 512, mostNumbers = 4;

  /// `parts`: two lists of mostNumbers for each block.
  __device__ explicit WholeTeam(double* parts) : parts_(parts) {}

  /// f(i) for i = 0 .. n - 1, always in the same thread for the same i. Warps of all blocks take turns, so
  /// that a short loop is spread over the GPU.
  template <class F>
  __device__ void each(int n, F&& f) const {
    const unsigned warp = threadIdx.x / 32 * gridDim.x + blockIdx.x;
    for (int i = int(32 * warp + threadIdx.x % 32); i < n; i += int(gridDim.x * blockDim.x)) f(i);
  }
  /// f(i, lane) by the threads that share row i.
  template <class F>
  __device__ void eachRow(int n, F&& f) const {
    const int thread = int(blockIdx.x * blockDim.x + threadIdx.x);
    for (int i = thread / lanes; i < n; i += int(gridDim.x * blockDim.x) / lanes) f(i, thread % lanes);
  }
  /// The sums over the threads of a row, in each of them.
  template <int N>
  __device__ void sumOfRow(double (&value)[N]) const {
    const unsigned mask = ((1u << lanes) - 1) << (threadIdx.x % 32 / lanes * lanes);
    for (int offset = lanes / 2; offset > 0; offset /= 2)
      for (double& v : value) v += __shfl_xor_sync(mask, v, offset);
  }
  /// What was written before is seen by all behind it.
  __device__ void sync() const { cooperative_groups::this_grid().sync(); }
  /// The same; and each thread gets the sums of the first numbers of all, and the largest of the others.
  template <int Sums, int N>
  __device__ void reduce(double (&value)[N]) {
    static_assert(N <= mostNumbers);
    __shared__ double ofWarp[mostNumbers][threads / 32], all[mostNumbers];
    const int lane = int(threadIdx.x) % 32, warp = int(threadIdx.x) / 32, warps = int(blockDim.x) / 32;
    double* const list = parts_ + (round_++ % 2) * mostNumbers * gridDim.x;
    for (int k = 0; k < N; ++k) {
      value[k] = ofAllLanes<Sums>(k, value[k]);
      if (lane == 0) ofWarp[k][warp] = value[k];
    }
    __syncthreads();
    if (const int k = int(threadIdx.x); k < N) {
      double sum = ofWarp[k][0];
      for (int w = 1; w < warps; ++w) sum = joined<Sums>(k, sum, ofWarp[k][w]);
      list[mostNumbers * blockIdx.x + unsigned(k)] = sum;
    }
    sync();
    if (warp < N) {
      double sum = 0;
      for (unsigned b = unsigned(lane); b < gridDim.x; b += 32)
        sum = joined<Sums>(warp, sum, __ldcg(list + mostNumbers * b + unsigned(warp)));
      sum = ofAllLanes<Sums>(warp, sum);
      if (lane == 0) all[warp] = sum;
    }
    __syncthreads();
    for (int k = 0; k < N; ++k) value[k] = all[k];
  }
  /// One thread of all.
  __device__ bool first() const { return blockIdx.x == 0 && threadIdx.x == 0; }

 private:
  double* parts_;
  unsigned round_ = 0;

  template <int Sums>
  static __device__ double joined(int k, double a, double b) {
    return k < Sums ? a + b : fmax(a, b);
  }
  template <int Sums>
  static __device__ double ofAllLanes(int k, double value) {
    for (int offset = 16; offset > 0; offset /= 2)
      value = joined<Sums>(k, value, __shfl_xor_sync(0xffffffffu, value, offset));
    return value;
  }
};

namespace detail {
template <class Body>
__global__ void __launch_bounds__(WholeTeam::threads, 1) whole_kernel(Body body, double* parts) {
  WholeTeam team(parts);
  body(team);
}
}  // namespace detail

#else

/// Threads of the host, usually one.
class WholeTeam {
 public:
  static constexpr int lanes = 1, mostNumbers = 4;

  struct Shared {
    std::barrier<> barrier;
    std::vector<double> parts;
    explicit Shared(int threads) : barrier(threads), parts(2 * mostNumbers * std::size_t(threads)) {}
  };
  explicit WholeTeam(int thread = 0, int threads = 1, Shared* shared = nullptr)
      : thread_(thread), threads_(threads), shared_(shared) {}

  template <class F>
  void each(int n, F&& f) const {
    for (int i = thread_; i < n; i += threads_) f(i);
  }
  // in other threads than each(), as on a GPU
  template <class F>
  void eachRow(int n, F&& f) const {
    for (int i = n - 1 - thread_; i >= 0; i -= threads_) f(i, 0);
  }
  template <int N>
  void sumOfRow(double (&)[N]) const {}
  void sync() const {
    if (shared_) shared_->barrier.arrive_and_wait();
  }
  template <int Sums, int N>
  void reduce(double (&value)[N]) {
    static_assert(N <= mostNumbers);
    if (!shared_) return;
    double* const list = shared_->parts.data() + (round_++ % 2) * mostNumbers * std::size_t(threads_);
    std::copy_n(value, N, list + mostNumbers * thread_);
    sync();
    std::copy_n(list, N, value);
    for (int t = 1; t < threads_; ++t)
      for (int k = 0; k < N; ++k) {
        const double other = list[mostNumbers * t + k];
        value[k] = k < Sums ? value[k] + other : std::max(value[k], other);
      }
  }
  bool first() const { return thread_ == 0; }

 private:
  int thread_, threads_;
  Shared* shared_;
  unsigned round_ = 0;
};

/// How many threads of the host a team has; tests ask for more than one.
inline int& host_team_threads() {
  static thread_local int threads = 1;
  return threads;
}

#endif

/// Room for what the blocks of a team exchange.
using TeamMemory = DeviceArray<double>;

/// body(team) in all threads of a team, for work with so many rows; body is an object whose operator() is
/// SINEW_HD.
template <class Body>
void run_whole_team(std::size_t rows, Body const& body, TeamMemory& memory) {
#if SINEW_CUDA
  char const* const what = "a step with constraints on the GPU";
  int device = 0, processors = 0;
  check(cudaGetDevice(&device), what);
  check(cudaDeviceGetAttribute(&processors, cudaDevAttrMultiProcessorCount, device), what);
  const std::size_t needed = (rows * WholeTeam::lanes + WholeTeam::threads - 1) / WholeTeam::threads;
  const unsigned blocks = unsigned(std::clamp<std::size_t>(needed, 1, std::size_t(processors)));
  memory.resize(2 * WholeTeam::mostNumbers * std::size_t(blocks));
  cudaLaunchAttribute attribute{};
  attribute.id = cudaLaunchAttributeCooperative;
  attribute.val.cooperative = 1;
  cudaLaunchConfig_t config{};
  config.gridDim = dim3(blocks);
  config.blockDim = dim3(WholeTeam::threads);
  config.stream = stream();
  config.attrs = &attribute;
  config.numAttrs = 1;
  check(cudaLaunchKernelEx(&config, detail::whole_kernel<Body>, body, memory.data()), what);
#else
  (void)rows;
  (void)memory;
  const int threads = host_team_threads();
  if (threads == 1) {
    WholeTeam alone;
    body(alone);
    return;
  }
  WholeTeam::Shared shared(threads);
  std::vector<std::thread> all;
  for (int t = 0; t < threads; ++t)
    all.emplace_back([&body, &shared, t, threads] {
      WholeTeam team(t, threads, &shared);
      body(team);
    });
  for (std::thread& t : all) t.join();
#endif
}

}  // namespace sinew::gpu
