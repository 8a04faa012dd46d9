// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/gpu/execution.hpp>

#include <cstddef>
#include <cstdint>
#include <vector>

#if SINEW_CUDA
#include <cooperative_groups.h>
#endif

namespace sinew::gpu {

/// Those who simulate one copy of a body together: `ranks` blocks, each with its rows and its shared memory.
/// `lanes` threads of a block share a row, and each keeps some of its entries in registers. This one is
/// alone: a thread of the host, for tests, and for machines without a GPU.
struct SerialTeam {
  static constexpr int lanes = 1, keptEntries = 0;
  static constexpr bool global = false;  // whether what is exchanged is in memory that all blocks see
  using Column = std::uint16_t;
  int rank = 0, ranks = 1, thread = 0, threads = 1, copy = 0;

  /// All that was written before, to any memory, is seen by all behind it.
  void sync() const {}
  /// The same place in the shared memory of another block.
  template <class T>
  T& of(int, T& mine) const {
    return mine;
  }
  /// Scalars from one point of an exchanged vector to the next, and the three of a point.
  static constexpr int stride = 3;
  template <class T>
  void load(T const* from, T (&to)[3]) const {
    for (int c = 0; c < 3; ++c) to[c] = from[c];
  }
  /// The sum over the threads of a row, in each of them.
  template <class T>
  T rowSum(T value) const {
    return value;
  }
  /// What a thread has of each of its rows.
  template <class T>
  struct Rows {
    std::vector<T> all{};
    explicit Rows(int n) : all(std::size_t(n)) {}
    T& operator[](int row) { return all[std::size_t(row)]; }
  };
  /// Two sums over the threads of the block, given to all blocks: `sums` has a pair for each of them.
  template <class Real>
  void giveSums(Real const (&value)[2], double*, double* sums) const {
    sums[0] = double(value[0]);
    sums[1] = double(value[1]);
  }
  /// The sums over all blocks, behind a sync(): first asked for, then, when other work is done, taken.
  /// `total` is room for two numbers of the block.
  void fetchSums(double const*, double*) const {}
  void takeSums(double const* sums, double const*, double (&total)[2]) const {
    total[0] = sums[0];
    total[1] = sums[1];
  }
};

#if SINEW_CUDA
/// What teams of a GPU have in common.
template <int Lanes, int KeptEntries>
struct DeviceTeam {
  static constexpr int lanes = Lanes, keptEntries = KeptEntries;
  int rank, ranks, thread = int(threadIdx.x), threads = int(blockDim.x), copy = 0;

  template <class T>
  __device__ T rowSum(T value) const {
    const unsigned first = (threadIdx.x % 32) / Lanes * Lanes;
    const unsigned mask = Lanes == 32 ? 0xffffffffu : ((1u << Lanes) - 1) << first;
    for (int offset = Lanes / 2; offset > 0; offset /= 2) value += __shfl_xor_sync(mask, value, offset);
    return value;
  }
  /// A thread has one row at most.
  template <class T>
  struct Rows {
    T one{};
    __device__ explicit Rows(int) {}
    __device__ T& operator[](int) { return one; }
  };
  /// Sums over the block, in its first 16 threads; `room` holds two numbers a warp.
  template <class Real>
  __device__ double2 blockSums(Real const (&value)[2], double* room) const {
    const int warps = (threads + 31) / 32;
    Real a = value[0], b = value[1];
    for (int offset = 16; offset > 0; offset /= 2) {
      a += __shfl_xor_sync(0xffffffffu, a, offset);
      b += __shfl_xor_sync(0xffffffffu, b, offset);
    }
    double2* const ofWarp = reinterpret_cast<double2*>(room);
    if (thread % 32 == 0) ofWarp[thread / 32] = make_double2(double(a), double(b));
    __syncthreads();
    double2 sum = make_double2(0, 0);
    if (thread < 16)
      for (int w = 0; w < warps; ++w) {
        sum.x += ofWarp[w].x;
        sum.y += ofWarp[w].y;
      }
    return sum;
  }
};

/// The blocks of a cluster: they write to each other's shared memory. GPUs before sm_90 have none, and there
/// it is one block.
template <int Lanes, int KeptEntries>
struct ClusterTeam : DeviceTeam<Lanes, KeptEntries> {
  static constexpr bool global = false;
  using Column = std::uint16_t;

#if defined(__CUDA_ARCH__) && __CUDA_ARCH__ >= 900
  __device__ ClusterTeam() {
    const auto cluster = cooperative_groups::this_cluster();
    this->rank = int(cluster.block_rank());
    this->ranks = int(cluster.num_blocks());
    this->copy = int(blockIdx.x) / this->ranks;
  }
  __device__ void sync() const {
    if (this->ranks > 1)
      cooperative_groups::this_cluster().sync();
    else
      __syncthreads();
  }
  template <class T>
  __device__ T& of(int other, T& mine) const {
    return *cooperative_groups::this_cluster().map_shared_rank(&mine, unsigned(other));
  }
#else
  __device__ ClusterTeam() {
    this->rank = 0;
    this->ranks = 1;
    this->copy = int(blockIdx.x);
  }
  __device__ void sync() const { __syncthreads(); }
  template <class T>
  __device__ T& of(int, T& mine) const {
    return mine;
  }
#endif
  static constexpr int stride = 3;
  template <class T>
  __device__ void load(T const* from, T (&to)[3]) const {
    for (int c = 0; c < 3; ++c) to[c] = from[c];
  }
  template <class Real>
  __device__ void giveSums(Real const (&value)[2], double* room, double* sums) const {
    const double2 own = this->blockSums(value, room);
    if (this->thread < this->ranks) of(this->thread, reinterpret_cast<double2*>(sums)[this->rank]) = own;
  }
  __device__ void fetchSums(double const*, double*) const {}
  __device__ void takeSums(double const* sums, double const*, double (&total)[2]) const {
    total[0] = total[1] = 0;
    for (int k = 0; k < this->ranks; ++k) {
      const double2 one = reinterpret_cast<double2 const*>(sums)[k];
      total[0] += one.x;
      total[1] += one.y;
    }
  }
};

/// All blocks of a launch, which run at once: what they exchange goes through the memory of the GPU.
template <int Lanes, int KeptEntries>
struct GridTeam : DeviceTeam<Lanes, KeptEntries> {
  static constexpr bool global = true;
  using Column = int;
  unsigned long long* arrived;            // how often blocks have in this launch
  mutable unsigned long long waited = 0;  // what it is when all have

  /// Of two counters launches take turns: the one that is not counted with is 0 for the next.
  __device__ GridTeam(unsigned long long* counters, int turn) : arrived(counters + turn) {
    this->rank = int(blockIdx.x);
    this->ranks = int(gridDim.x);
    if (blockIdx.x == 0 && threadIdx.x == 0) counters[1 - turn] = 0;
  }
  // what the block has written is seen behind the addition, what others have behind the last look at it
  __device__ void sync() const {
    __syncthreads();
    if (threadIdx.x == 0) {
      waited += gridDim.x;
      asm volatile("red.release.gpu.global.add.u64 [%0], 1;" ::"l"(arrived) : "memory");
      unsigned long long now = 0;
      while (now < waited)
        asm volatile("ld.acquire.gpu.global.u64 %0, [%1];" : "=l"(now) : "l"(arrived) : "memory");
    }
    __syncthreads();
  }
  template <class T>
  __device__ T& of(int, T& mine) const {
    return mine;
  }
  static constexpr int stride = 4;  // one load of 16 bytes, or two
  __device__ void load(float const* from, float (&to)[3]) const {
    const float4 all = __ldcg(reinterpret_cast<float4 const*>(from));
    to[0] = all.x, to[1] = all.y, to[2] = all.z;
  }
  __device__ void load(double const* from, double (&to)[3]) const {
    const double2 two = __ldcg(reinterpret_cast<double2 const*>(from));
    to[0] = two.x, to[1] = two.y, to[2] = __ldcg(from + 2);
  }
  template <class Real>
  __device__ void giveSums(Real const (&value)[2], double* room, double* sums) const {
    const double2 own = this->blockSums(value, room);
    if (this->thread == 0) reinterpret_cast<double2*>(sums)[this->rank] = own;
  }
  // by the last warp, which has no rows: were it all of them, they would wait for each other at a few
  // addresses
  __device__ void fetchSums(double const* sums, double* total) const {
    if (this->thread < this->threads - 32) return;
    double a = 0, b = 0;
    for (int k = this->thread % 32; k < this->ranks; k += 32) {
      const double2 one = __ldcg(reinterpret_cast<double2 const*>(sums) + k);
      a += one.x;
      b += one.y;
    }
    for (int offset = 16; offset > 0; offset /= 2) {
      a += __shfl_xor_sync(0xffffffffu, a, offset);
      b += __shfl_xor_sync(0xffffffffu, b, offset);
    }
    if (this->thread % 32 == 0) *reinterpret_cast<double2*>(total) = make_double2(a, b);
  }
  __device__ void takeSums(double const*, double const* sum, double (&total)[2]) const {
    __syncthreads();
    total[0] = sum[0];
    total[1] = sum[1];
  }
};
#endif

}  // namespace sinew::gpu
