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

/// The threads that simulate one copy of a body together: `ranks` blocks, each with its rows and its shared
/// memory. `lanes` threads of a block share a row, and each keeps some of its entries in registers. This one
/// is alone: a thread of the host, for tests, and for machines without a GPU.
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
  /// What was written before by the threads of a row is seen by these behind it.
  void syncRows() const {}
  /// The sums over all threads of the first numbers, and the largest of the others, which are not negative,
  /// in each of them; all that was written before is seen by all. `room`: joint_buffer_size numbers in shared
  /// memory.
  template <int Sums, int N>
  void join(double (&)[N], double*) const {}
  /// What a thread has of each of its rows.
  template <class T>
  struct Rows {
    std::vector<T> all{};
    explicit Rows(int n) : all(std::size_t(n)) {}
    T& operator[](int row) { return all[std::size_t(row)]; }
  };
  /// An exchange, in which all take part, one call after the other: rows have been published, which
  /// announce() says; each thread gives two numbers; behind awaitRows() those rows may be loaded that others
  /// have published; fetchSums() and takeSums() bring the sums over all threads of all blocks. `buffer` is
  /// the same in each.
  void announce() const {}
  template <class Real>
  void give(Real const (&value)[2], double* buffer) const {
    buffer[0] = double(value[0]);
    buffer[1] = double(value[1]);
  }
  void awaitRows() const {}
  void fetchSums(double*) const {}
  void takeSums(double const* buffer, double (&total)[2]) const {
    total[0] = buffer[0];
    total[1] = buffer[1];
  }
};
/// Numbers in `buffer`: two lists of a pair for each block of a cluster, and a pair for each warp.
inline constexpr int list_buffer_size = 2 * 2 * 16, sum_buffer_size = list_buffer_size + 2 * 32;
/// Numbers for join(), of at most so many at once: two lists for the blocks of a cluster, a list for the
/// warps, and what comes of it.
inline constexpr int most_joined = 4, joint_list_size = most_joined * 16,
                     joint_buffer_size = 2 * joint_list_size + most_joined * 32 + most_joined;

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
  mutable unsigned round = 0;  // exchanges so far; of two lists, used alternately

  /// Puts the sums over the threads of the warp into `buffer`.
  template <class Real>
  __device__ void giveOfWarp(Real const (&value)[2], double* buffer) const {
    Real a = value[0], b = value[1];
    for (int offset = 16; offset > 0; offset /= 2) {
      a += __shfl_xor_sync(0xffffffffu, a, offset);
      b += __shfl_xor_sync(0xffffffffu, b, offset);
    }
    double2* const ofWarp = reinterpret_cast<double2*>(buffer + list_buffer_size);
    if (thread % 32 == 0) ofWarp[thread / 32] = make_double2(double(a), double(b));
  }
  static __device__ double2 pair(double const* list, int k) {
    return reinterpret_cast<double2 const*>(list)[k];
  }

  __device__ void syncRows() const { __syncwarp(); }
  mutable unsigned joins = 0;  // so far
  template <int Sums>
  static __device__ double joined(int k, double a, double b) {
    return k < Sums ? a + b : fmax(a, b);
  }
  template <int Sums>
  static __device__ double joinedOfWarp(int k, double value) {
    for (int offset = 16; offset > 0; offset /= 2)
      value = joined<Sums>(k, value, __shfl_xor_sync(0xffffffffu, value, offset));
    return value;
  }
  /// Puts what comes of each warp into its list, `room` behind those of the blocks.
  template <int Sums, int N>
  __device__ void joinWarps(double (&value)[N], double* room) const {
    static_assert(N <= most_joined);
    for (int k = 0; k < N; ++k) {
      const double own = joinedOfWarp<Sums>(k, value[k]);
      if (thread % 32 == 0) room[2 * joint_list_size + 32 * k + thread / 32] = own;
    }
    __syncthreads();
    ++joins;
  }
  /// Number k of the block.
  template <int Sums>
  __device__ double joinedOfBlock(int k, double const* room) const {
    double own = 0;
    for (int w = 0; w < (threads + 31) / 32; ++w)
      own = joined<Sums>(k, own, room[2 * joint_list_size + 32 * k + w]);
    return own;
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
    sync();  // a block that has not begun has no shared memory to write to
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
  __device__ void announce() const { ++this->round; }
  template <class Real>
  __device__ void give(Real const (&value)[2], double* buffer) const {
    this->giveOfWarp(value, buffer);
    __syncthreads();
    if (this->thread >= this->ranks) return;
    double2 own = make_double2(0, 0);
    for (int w = 0; w < (this->threads + 31) / 32; ++w) {
      const double2 one = this->pair(buffer + list_buffer_size, w);
      own.x += one.x;
      own.y += one.y;
    }
    of(this->thread, reinterpret_cast<double2*>(list(buffer))[this->rank]) = own;
  }
  template <int Sums, int N>
  __device__ void join(double (&value)[N], double* room) const {
    this->template joinWarps<Sums>(value, room);
    double* const list = room + this->joins % 2 * joint_list_size;
    if (this->thread < this->ranks * N) {
      const int k = this->thread % N;
      of(this->thread / N, list[most_joined * this->rank + k]) = this->template joinedOfBlock<Sums>(k, room);
    }
    sync();
    for (int k = 0; k < N; ++k) {
      value[k] = 0;
      for (int r = 0; r < this->ranks; ++r)
        value[k] = this->template joined<Sums>(k, value[k], list[most_joined * r + k]);
    }
  }
  __device__ void awaitRows() const { sync(); }
  __device__ void fetchSums(double*) const {}
  __device__ void takeSums(double* buffer, double (&total)[2]) const {
    total[0] = total[1] = 0;
    for (int k = 0; k < this->ranks; ++k) {
      const double2 one = this->pair(list(buffer), k);
      total[0] += one.x;
      total[1] += one.y;
    }
  }

 private:
  __device__ double* list(double* buffer) const { return buffer + this->round % 2 * (list_buffer_size / 2); }
};

/// What the blocks of a launch exchange in the memory of the GPU.
struct GridMemory {
  unsigned long long* arrived;  // two counters, used alternately by launches
  int parity;
  unsigned* announced;          // by each block: the exchange up to which others may load its rows
  double* sums;                 // two lists of a pair for each block
  double* joint;                // two lists of most_joined for each block
  int const *nearFirst, *near;  // of each block: those whose rows it loads, and that load its own
};

/// All blocks of a launch, which run at once: what they exchange goes through the memory of the GPU. In an
/// exchange a block waits for the rows of those around it only, and for the sums of all while its own rows
/// are multiplied. Two warps of each block, the last, have no rows: one announces those of the block and
/// waits for the others', the other exchanges the sums, whose last bits say of which round they are.
///
/// There are two lists of sums, and two vectors of rows, used alternately. Who writes to one has all sums of
/// the round before; these were given by blocks that had taken, and loaded, all of what is now overwritten.
template <int Lanes, int KeptEntries>
struct GridTeam : DeviceTeam<Lanes, KeptEntries> {
  static constexpr bool global = true;
  static constexpr int helpers = 64;  // threads without rows
  using Column = int;
  GridMemory memory;
  mutable unsigned long long waited = 0;  // how often blocks have arrived when all have
  int nearBegin, nearEnd;

  __device__ explicit GridTeam(GridMemory const& all) : memory(all) {
    this->rank = int(blockIdx.x);
    this->ranks = int(gridDim.x);
    nearBegin = memory.nearFirst[this->rank];
    nearEnd = memory.nearFirst[this->rank + 1];
    // the counter of the next launch; and behind the first sync() there is nothing of the last one
    if (this->thread == 0) {
      if (this->rank == 0) memory.arrived[1 - memory.parity] = 0;
      memory.announced[this->rank] = 0;
      for (int list = 0; list < 2; ++list)
        reinterpret_cast<double2*>(memory.sums)[list * this->ranks + this->rank] = make_double2(0, 0);
    }
  }
  // what the block has written is seen behind the addition, what others have behind the last look at it
  __device__ void sync() const {
    __syncthreads();
    if (threadIdx.x == 0) {
      unsigned long long* const arrived = memory.arrived + memory.parity;
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
  __device__ void announce() const {
    ++this->round;
    if (this->thread < rowThreads()) {
      arrive(rowsPublished);
    } else if (this->thread < rowThreads() + 32) {
      await(rowsPublished);
      if (this->thread % 32 == 0)
        asm volatile("st.release.gpu.global.u32 [%0], %1;" ::"l"(memory.announced + this->rank),
                     "r"(this->round)
                     : "memory");
      for (int first = nearBegin; first < nearEnd; first += 32) {
        const int k = first + this->thread % 32;
        unsigned const* const other = memory.announced + memory.near[k < nearEnd ? k : first];
        unsigned now = 0;
        while (!__all_sync(0xffffffffu, now >= this->round))
          asm volatile("ld.acquire.gpu.global.u32 %0, [%1];" : "=r"(now) : "l"(other) : "memory");
      }
    }
  }
  template <int Sums, int N>
  __device__ void join(double (&value)[N], double* room) const {
    this->template joinWarps<Sums>(value, room);
    double* const list = memory.joint + this->joins % 2 * (most_joined * std::ptrdiff_t(this->ranks));
    if (this->thread < N)
      __stcg(list + most_joined * this->rank + this->thread,
             this->template joinedOfBlock<Sums>(this->thread, room));
    sync();
    double* const all = room + joint_buffer_size - most_joined;
    for (int k = this->thread / 32; k < N; k += this->threads / 32) {
      double own = 0;
      for (int r = this->thread % 32; r < this->ranks; r += 32)
        own = this->template joined<Sums>(k, own, __ldcg(list + most_joined * r + k));
      own = this->template joinedOfWarp<Sums>(k, own);
      if (this->thread % 32 == 0) all[k] = own;
    }
    __syncthreads();
    for (int k = 0; k < N; ++k) value[k] = all[k];
  }
  __device__ void awaitRows() const {
    if (this->thread < rowThreads() + 32) await(rowsAround);
  }
  template <class Real>
  __device__ void give(Real const (&value)[2], double* buffer) const {
    if (this->thread >= rowThreads()) return;
    this->giveOfWarp(value, buffer);
    arrive(sumsGiven);
  }
  __device__ void fetchSums(double* buffer) const {
    if (this->thread < rowThreads() + 32) return;
    await(sumsGiven);
    const int lane = this->thread % 32;
    double2 own = make_double2(0, 0), all = own;
    if (lane < rowThreads() / 32) own = this->pair(buffer + list_buffer_size, lane);
    own = sumOfWarp(own);
    double* const list = memory.sums + this->round % 2 * (2 * std::ptrdiff_t(this->ranks));
    if (lane == 0)
      asm volatile("st.relaxed.gpu.global.v2.f64 [%0], {%1, %2};" ::"l"(list + 2 * this->rank),
                   "d"(marked(own.x)),
                   "d"(marked(own.y))
                   : "memory");
    constexpr int together = 5;
    for (int first = lane; first - lane < this->ranks; first += 32 * together) {
      double2 one[together];
      long long others = 1;
      while (!__all_sync(0xffffffffu, others == 0)) {
        for (int k = 0; k < together; ++k)
          look(list + 2 * (first + 32 * k < this->ranks ? first + 32 * k : this->rank), one[k]);
        others = 0;
        for (int k = 0; k < together; ++k)
          others |= (lastBit(one[k].x) ^ mark()) | (lastBit(one[k].y) ^ mark());
      }
      for (int k = 0; k < together; ++k)
        if (first + 32 * k < this->ranks) all.x += unmarked(one[k].x), all.y += unmarked(one[k].y);
    }
    all = sumOfWarp(all);
    if (lane == 0) reinterpret_cast<double2*>(buffer)[this->round % 2] = all;
  }
  __device__ void takeSums(double const* buffer, double (&total)[2]) const {
    __syncthreads();
    const double2 all = this->pair(buffer, int(this->round % 2));
    total[0] = all.x;
    total[1] = all.y;
  }

 private:
  // barriers of the block besides that of __syncthreads, of the threads with rows and one of the two warps
  enum Barrier { rowsPublished = 1, sumsGiven, rowsAround };
  __device__ int rowThreads() const { return this->threads - helpers; }
  __device__ void arrive(Barrier barrier) const {
    __syncwarp();
    asm volatile("barrier.cta.arrive %0, %1;" ::"r"(int(barrier)), "r"(rowThreads() + 32) : "memory");
  }
  __device__ void await(Barrier barrier) const {
    __syncwarp();
    asm volatile("barrier.cta.sync %0, %1;" ::"r"(int(barrier)), "r"(rowThreads() + 32) : "memory");
  }
  static __device__ double2 sumOfWarp(double2 value) {
    for (int offset = 16; offset > 0; offset /= 2) {
      value.x += __shfl_xor_sync(0xffffffffu, value.x, offset);
      value.y += __shfl_xor_sync(0xffffffffu, value.y, offset);
    }
    return value;
  }
  // the last bit of sums that are given in this round; of those that stand in their place it is the other.
  // Who has them takes it away: a sum does not depend on the number of its round.
  __device__ long long mark() const { return (this->round + 1) / 2 % 2; }
  static __device__ long long lastBit(double value) { return __double_as_longlong(value) & 1; }
  static __device__ double unmarked(double value) {
    return __longlong_as_double(__double_as_longlong(value) & ~1ll);
  }
  __device__ double marked(double value) const {
    return __longlong_as_double(__double_as_longlong(unmarked(value)) | mark());
  }
  static __device__ void look(double const* from, double2& value) {
    asm volatile("ld.relaxed.gpu.global.v2.f64 {%0, %1}, [%2];"
                 : "=d"(value.x), "=d"(value.y)
                 : "l"(from)
                 : "memory");
  }
};
#endif

}  // namespace sinew::gpu
