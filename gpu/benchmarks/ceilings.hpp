// SPDX-License-Identifier: BSL-1.0
// What the GPU could do at best, measured beside what the scenes make of it. Compiled by nvcc.
#pragma once

#include <sinew/gpu/device_vector.hpp>
#include <sinew/gpu/fused/team.hpp>

#include <algorithm>
#include <cmath>
#include <vector>

namespace bench {

namespace gpu = sinew::gpu;

/// Seconds of what work() queues on the stream, between two events; the median of five.
template <class Work>
double event_seconds(Work&& work) {
  char const* const what = "a measurement on the GPU";
  cudaEvent_t begin = nullptr, end = nullptr;
  gpu::check(cudaEventCreate(&begin), what);
  gpu::check(cudaEventCreate(&end), what);
  std::vector<float> times(5);
  for (float& milliseconds : times) {
    gpu::wait();
    gpu::check(cudaEventRecord(begin, gpu::stream()), what);
    work();
    gpu::check(cudaEventRecord(end, gpu::stream()), what);
    gpu::check(cudaEventSynchronize(end), what);
    gpu::check(cudaEventElapsedTime(&milliseconds, begin, end), what);
  }
  cudaEventDestroy(begin);
  cudaEventDestroy(end);
  std::sort(times.begin(), times.end());
  return times[2] * 1e-3;
}

/// Seconds of one of the `times` launches that work() queues, as nodes of a CUDA graph.
template <class Work>
double graph_seconds(int times, Work&& work) {
  char const* const what = "a measurement on the GPU";
  cudaGraph_t graph = nullptr;
  cudaGraphExec_t launched = nullptr;
  gpu::check(cudaStreamBeginCapture(gpu::stream(), cudaStreamCaptureModeThreadLocal), what);
  for (int i = 0; i < times; ++i) work();
  gpu::check(cudaStreamEndCapture(gpu::stream(), &graph), what);
  const cudaError_t made = cudaGraphInstantiate(&launched, graph, 0);
  cudaGraphDestroy(graph);
  gpu::check(made, what);
  auto once = [&] { gpu::check(cudaGraphLaunch(launched, gpu::stream()), what); };
  once();
  const double seconds = event_seconds(once);
  cudaGraphExecDestroy(launched);
  return seconds / times;
}

struct Nothing {
  SINEW_HD void operator()(int) const {}
};
/// Seconds of a launch that does nothing, queued by the host one after the other, and in a graph.
inline double launch_seconds() {
  constexpr int times = 1000;
  auto all = [&] {
    for (int i = 0; i < times; ++i) gpu::for_each_index(32, Nothing{});
  };
  all();
  return event_seconds(all) / times;
}
inline double node_seconds() {
  return graph_seconds(1000, [] { gpu::for_each_index(32, Nothing{}); });
}

struct CopyPiece {
  float4 const* from;
  float4* to;
  SINEW_HD void operator()(int i) const { to[i] = from[i]; }
};
/// Bytes a second that a copy reads and writes, of so many in all, in a graph of such copies.
inline double copy_bandwidth(std::size_t bytes) {
  const std::size_t pieces = std::max<std::size_t>(1, bytes / (2 * sizeof(float4)));
  gpu::DeviceArray<float4> from, to;
  from.resize(pieces);
  to.resize(pieces);
  gpu::check(cudaMemsetAsync(from.data(), 77, pieces * sizeof(float4), gpu::stream()), "copy_bandwidth");
  const int times = int(std::clamp<std::size_t>(std::size_t(4e9) / bytes, 4, 200));
  const CopyPiece copy{from.data(), to.data()};
  return double(2 * pieces * sizeof(float4)) /
         graph_seconds(times, [&] { gpu::for_each_index(pieces, copy); });
}

template <class Real>
__global__ void multiply_add(Real* to, Real a, Real b, int rounds) {
  constexpr int sums = 8;
  Real s[sums];
  for (int k = 0; k < sums; ++k) s[k] = Real(threadIdx.x + unsigned(k));
  for (int i = 0; i < rounds; ++i)
#pragma unroll
    for (int k = 0; k < sums; ++k) s[k] = s[k] * a + b;
  Real sum(0);
  for (int k = 0; k < sums; ++k) sum += s[k];
  to[blockIdx.x * blockDim.x + threadIdx.x] = sum;
}
/// Flops a second of multiplications and additions on all multiprocessors that wait for nothing.
template <class Real>
double peak() {
  int device = 0, processors = 0;
  gpu::check(cudaGetDevice(&device), "peak");
  gpu::check(cudaDeviceGetAttribute(&processors, cudaDevAttrMultiProcessorCount, device), "peak");
  const int blocks = 8 * processors, threads = 256, rounds = 20000;
  gpu::DeviceArray<Real> to;
  to.resize(std::size_t(blocks) * threads);
  auto all = [&] {
    multiply_add<Real>
        <<<unsigned(blocks), threads, 0, gpu::stream()>>>(to.data(), Real(0.999), Real(0.001), rounds);
    gpu::check(cudaGetLastError(), "peak");
  };
  all();
  return 2.0 * 8 * rounds * blocks * threads / event_seconds(all);
}

template <class Team>
__device__ void exchange_rounds(Team const& team, int rounds, double* to) {
  __shared__ __align__(16) double buffer[gpu::sum_buffer_size];
  const float one[2] = {1.0f, 2.0f};
  double found = 0;
  team.sync();
  for (int i = 0; i < rounds; ++i) {
    team.announce();
    team.give(one, buffer);
    team.awaitRows();
    team.fetchSums(buffer);
    double total[2];
    team.takeSums(buffer, total);
    found += total[0];
  }
  if (team.rank == 0 && team.thread == 0) to[0] = found;
}
__global__ void __launch_bounds__(384, 1) grid_rounds(int rounds, double* to, gpu::GridMemory memory) {
  exchange_rounds(gpu::GridTeam<1, 1>(memory), rounds, to);
}
__global__ void __launch_bounds__(384, 1) cluster_rounds(int rounds, double* to) {
  exchange_rounds(gpu::ClusterTeam<1, 1>(), rounds, to);
}
/// Seconds in which as many blocks of 384 threads, all of a launch or those of a cluster, exchange two sums
/// as a fused step does in each iteration, with nothing else to do.
inline double exchange_seconds(int blocks, bool cluster) {
  constexpr int rounds = 2000, threads = 384;
  char const* const what = "exchange_seconds";
  gpu::DeviceArray<double> sums, to;
  gpu::DeviceVector<unsigned long long> arrived(2, 0ull);
  gpu::DeviceArray<unsigned> announced;
  announced.resize(std::size_t(blocks));
  sums.resize(4 * std::size_t(blocks));
  to.resize(1);
  std::vector<int> first{0}, others;
  for (int b = 0; b < blocks; ++b) {
    for (int other = std::max(0, b - 4); other < std::min(blocks, b + 5); ++other)
      if (other != b) others.push_back(other);
    first.push_back(int(others.size()));
  }
  const gpu::DeviceVector<int> nearFirst(first), near(others);
  cudaLaunchAttribute attribute{};
  cudaLaunchConfig_t config{};
  config.gridDim = dim3(unsigned(blocks));
  config.blockDim = dim3(threads);
  config.stream = gpu::stream();
  config.attrs = &attribute;
  config.numAttrs = 1;
  if (cluster) {
    gpu::check(cudaFuncSetAttribute(cluster_rounds, cudaFuncAttributeNonPortableClusterSizeAllowed, 1), what);
    attribute.id = cudaLaunchAttributeClusterDimension;
    attribute.val.clusterDim.x = unsigned(blocks);
    attribute.val.clusterDim.y = attribute.val.clusterDim.z = 1;
  } else {
    attribute.id = cudaLaunchAttributeCooperative;
    attribute.val.cooperative = 1;
  }
  gpu::GridMemory memory{
      arrived.device(), 0, announced.data(), sums.data(), nullptr, nearFirst.device(), near.device()};
  auto all = [&] {
    if (cluster)
      gpu::check(cudaLaunchKernelEx(&config, cluster_rounds, rounds, to.data()), what);
    else
      gpu::check(cudaLaunchKernelEx(&config, grid_rounds, rounds, to.data(), memory), what);
    memory.parity = 1 - memory.parity;
  };
  all();
  const double seconds = event_seconds(all) / rounds;
  double found = 0;
  gpu::copy_to_host(&found, to.data(), 1);
  const int given = cluster ? threads : threads - gpu::GridTeam<1, 1>::helpers;
  const double expected = double(given) * blocks * rounds;
  if (std::abs(found - expected) > 1e-10 * expected)
    throw sinew::Error(what, sinew::text(blocks, " blocks have summed up ", found, ", not ", expected));
  return seconds;
}

}  // namespace bench
