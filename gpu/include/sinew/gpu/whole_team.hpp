// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/gpu/execution.hpp>

#include <algorithm>

#if !SINEW_CUDA
#include <barrier>
#include <thread>
#include <vector>
#endif

namespace sinew::gpu {

// A method with many short loops, sums between them and decisions by these sums runs as one kernel: its
// threads all go through the same code, share the indices of each loop, and wait for each other only where
// one needs what others have written. All find the same sums, and so take the same decisions.

#if SINEW_CUDA

/// All threads of a launch, whose blocks run at once (cooperative). What they exchange in a sum is in one of
/// two lists, used alternately: of each block a slot for each number, with the round it is of. Who waits for
/// a slot sees all that its block has written before.
class WholeTeam {
 public:
  static constexpr int lanes = 8;  // threads that share a row
  static constexpr int threads = 512, leastThreads = 128, mostNumbers = 4;
  static constexpr int mostKept = 4;  // entries of its first row that a thread has in shared memory

  struct alignas(16) Slot {
    double value;
    long long round;
  };
  /// Slots for so many blocks, behind two with the round of the last launch, how often blocks had come to a
  /// barrier by then, and how often they have; 0 before the first.
  static constexpr std::size_t slotsFor(std::size_t blocks) { return 2 + 2 * mostNumbers * blocks; }
  __device__ WholeTeam(Slot* slots, int kept)
      : slots_(slots + 2),
        round_(slots[0].round),
        arrived_(static_cast<unsigned long long>(slots[1].round)),
        kept_(kept) {}

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
    for (int i = firstRow(); i < n; i += int(gridDim.x * blockDim.x) / lanes) f(i, lane());
  }
  /// f(i, lane, Lanes, joined) by the Lanes threads that share i, also for some i from n on, so that all of a
  /// warp are there: joined(sum) makes of each of its numbers the sum over the lanes. Warps of all blocks
  /// take turns.
  template <int Lanes, class F>
  __device__ void eachTeamOf(int n, F&& f) const {
    const int lane = int(threadIdx.x) % 32, warp = int(threadIdx.x / 32 * gridDim.x + blockIdx.x);
    constexpr int ofWarp = 32 / Lanes;
    for (int first = warp * ofWarp; first < n; first += int(gridDim.x * blockDim.x) / Lanes)
      f(first + lane / Lanes, lane % Lanes, Lanes, [](auto& sum) {
        for (int offset = Lanes / 2; offset > 0; offset /= 2)
          for (auto& s : sum) s += __shfl_xor_sync(0xffffffffu, s, offset);
      });
  }
  __device__ int firstRow() const { return int(blockIdx.x * blockDim.x + threadIdx.x) / lanes; }
  __device__ int lane() const { return int(threadIdx.x) % lanes; }
  /// The sums over the threads of a row, in each of them.
  template <int N>
  __device__ void sumOfRow(double (&value)[N]) const {
    const unsigned mask = ((1u << lanes) - 1) << (threadIdx.x % 32 / lanes * lanes);
    for (int offset = lanes / 2; offset > 0; offset /= 2)
      for (double& v : value) v += __shfl_xor_sync(mask, v, offset);
  }
  /// How many entries of its first row a thread keeps.
  __device__ int kept() const { return kept_; }
  /// Number k of those that this thread keeps, which are all T, behind `before` bytes of others.
  template <class T>
  __device__ T& keeps(std::size_t before, int k) const {
    extern __shared__ unsigned char memory[];
    return reinterpret_cast<T*>(memory + before * blockDim.x)[unsigned(k) * blockDim.x + threadIdx.x];
  }
  /// What was written before by the threads of a row is seen by these behind it.
  __device__ void syncRows() const { __syncwarp(); }
  /// What was written before is seen by all behind it.
  __device__ void sync() {
    double none[1] = {0};
    reduce<1>(none);
  }
  /// The same as sync(), sooner: the blocks count themselves in one place.
  __device__ void barrier() {
    __syncthreads();
    if (threadIdx.x == 0) {
      arrived_ += gridDim.x;
      unsigned long long* const count = counter();
      asm volatile("red.release.gpu.global.add.u64 [%0], 1;" ::"l"(count) : "memory");
      unsigned long long there = 0;
      while (there < arrived_)
        asm volatile("ld.acquire.gpu.global.u64 %0, [%1];" : "=l"(there) : "l"(count) : "memory");
    }
    __syncthreads();
  }
  /// The same as sync(); and each thread gets the sums of the first numbers of all, and the largest of the
  /// others, which are not negative.
  template <int Sums, int N>
  __device__ void reduce(double (&value)[N]) {
    static_assert(N <= mostNumbers && 32 * N <= leastThreads);
    __shared__ double ofWarp[mostNumbers][threads / 32], all[mostNumbers];
    const int lane = int(threadIdx.x) % 32, warp = int(threadIdx.x) / 32, warps = int(blockDim.x) / 32;
    Slot* const list = slots_ + ++round_ % 2 * mostNumbers * gridDim.x;
    for (int k = 0; k < N; ++k) {
      value[k] = ofAllLanes<Sums>(k, value[k]);
      if (lane == 0) ofWarp[k][warp] = value[k];
    }
    __syncthreads();
    if (warp < N) {
      const double own = ofAllLanes<Sums>(warp, lane < warps ? ofWarp[warp][lane] : 0.);
      if (lane == 0) {
        fence();
        give(list + mostNumbers * blockIdx.x + unsigned(warp), own);
      }
      double sum = 0;
      constexpr unsigned together = 5;  // slots on the way at the same time
      for (unsigned first = unsigned(lane); first - unsigned(lane) < gridDim.x; first += 32 * together) {
        Slot one[together];
        bool there = false;
        while (!__all_sync(0xffffffffu, there)) {
          there = true;
          for (unsigned k = 0; k < together; ++k) {
            const unsigned b = first + 32 * k < gridDim.x ? first + 32 * k : blockIdx.x;
            look(list + mostNumbers * b + unsigned(warp), one[k]);
          }
          for (Slot const& s : one) there = there && s.round == round_;
        }
        for (unsigned k = 0; k < together; ++k)
          if (first + 32 * k < gridDim.x) sum = joined<Sums>(warp, sum, one[k].value);
      }
      sum = ofAllLanes<Sums>(warp, sum);
      if (lane == 0) all[warp] = sum;
      fence();
    }
    __syncthreads();
    for (int k = 0; k < N; ++k) value[k] = all[k];
  }
  /// One thread of all.
  __device__ bool first() const { return blockIdx.x == 0 && threadIdx.x == 0; }
  /// Behind a sum at least: the next launch goes on with another round.
  __device__ void end() const {
    if (!first()) return;
    slots_[-2].round = round_;
    slots_[-1].round = static_cast<long long>(arrived_);
  }

 private:
  Slot* slots_;
  long long round_;
  unsigned long long arrived_;  // of the first thread of a block
  int kept_;

  __device__ unsigned long long* counter() const {
    return reinterpret_cast<unsigned long long*>(&slots_[-1].value);
  }
  static __device__ void fence() { asm volatile("fence.acq_rel.gpu;" ::: "memory"); }
  static __device__ void look(Slot const* from, Slot& to) {
    asm volatile("ld.relaxed.gpu.global.v2.b64 {%0, %1}, [%2];"
                 : "=d"(to.value), "=l"(to.round)
                 : "l"(from)
                 : "memory");
  }
  __device__ void give(Slot* to, double value) const {
    asm volatile("st.relaxed.gpu.global.v2.b64 [%0], {%1, %2};" ::"l"(to), "d"(value), "l"(round_)
                 : "memory");
  }
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
__global__ void __launch_bounds__(WholeTeam::threads, 1)
    whole_kernel(Body body, WholeTeam::Slot* slots, int kept) {
  WholeTeam team(slots, kept);
  body(team);
  team.end();
}
}  // namespace detail

/// Room for what the blocks of a team exchange.
using TeamMemory = DeviceArray<WholeTeam::Slot>;

inline int processors_of_device() {
  char const* const what = "the processors of the GPU";
  int device = 0, processors = 0;
  check(cudaGetDevice(&device), what);
  check(cudaDeviceGetAttribute(&processors, cudaDevAttrMultiProcessorCount, device), what);
  return processors;
}

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
  template <int, class F>
  void eachTeamOf(int n, F&& f) const {
    eachRow(n, [&](int i, int) { f(i, 0, 1, [](auto&) {}); });
  }
  int firstRow() const { return -1; }  // keeps none
  int lane() const { return 0; }
  int kept() const { return 0; }
  template <class T>
  T& keeps(std::size_t, int) const {
    static thread_local T none{};
    return none;
  }
  template <int N>
  void sumOfRow(double (&)[N]) const {}
  void syncRows() const {}
  void sync() const {
    if (shared_) shared_->barrier.arrive_and_wait();
  }
  void barrier() const { sync(); }
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

struct TeamMemory {};

#endif

/// Whether a thread of the largest team has one row of so many at most.
inline bool has_row_for_each([[maybe_unused]] std::size_t rows) {
#if SINEW_CUDA
  return rows * WholeTeam::lanes <= std::size_t(processors_of_device()) * WholeTeam::threads;
#else
  return true;
#endif
}

/// body(team) in all threads of a team, for work with so many rows; body is an object whose operator() is
/// SINEW_HD, waits for the team once at least, and says how many bytes of shared memory an entry of a row
/// needs, `entryBytes`.
template <class Body>
void run_whole_team(std::size_t rows, Body const& body, TeamMemory& memory) {
#if SINEW_CUDA
  char const* const what = "a kernel over the whole GPU";
  int device = 0;
  check(cudaGetDevice(&device), what);
  // over the whole GPU, in warps
  constexpr std::size_t warp = 32;
  const std::size_t most = std::size_t(processors_of_device()), needed = rows * WholeTeam::lanes;
  const std::size_t threads = std::clamp<std::size_t>(
      (needed + warp * most - 1) / (warp * most) * warp, WholeTeam::leastThreads, WholeTeam::threads);
  const std::size_t blocks = std::clamp<std::size_t>((needed + threads - 1) / threads, 1, most);
  if (!memory.data()) {
    memory.resize(WholeTeam::slotsFor(most));
    clear_on_device(memory.data(), WholeTeam::slotsFor(most));
  }
  int sharedMost = 0;
  check(cudaDeviceGetAttribute(&sharedMost, cudaDevAttrMaxSharedMemoryPerBlockOptin, device), what);
  constexpr std::size_t ofSums = 4096;
  const std::size_t entry = threads * Body::entryBytes;
  const std::size_t kept =  // in pairs
      entry == 0
          ? 0
          : std::min<std::size_t>(WholeTeam::mostKept, (std::size_t(sharedMost) - ofSums) / entry) / 2 * 2;
  const std::size_t shared = kept * entry;
  check(cudaFuncSetAttribute(
            detail::whole_kernel<Body>, cudaFuncAttributeMaxDynamicSharedMemorySize, int(shared)),
        what);
  cudaLaunchAttribute attribute{};
  attribute.id = cudaLaunchAttributeCooperative;
  attribute.val.cooperative = 1;
  cudaLaunchConfig_t config{};
  config.gridDim = dim3(unsigned(blocks));
  config.blockDim = dim3(unsigned(threads));
  config.dynamicSmemBytes = shared;
  config.stream = stream();
  config.attrs = &attribute;
  config.numAttrs = 1;
  check(cudaLaunchKernelEx(&config, detail::whole_kernel<Body>, body, memory.data(), int(kept)), what);
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
