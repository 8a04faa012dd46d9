// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/gpu/execution.hpp>

#include <thrust/scan.h>
#include <thrust/sort.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace sinew::gpu {

#if SINEW_CUDA
/// Memory that Thrust's algorithms work in; it is kept, so that no step asks for any once one has been made.
/// It is that of a thread: a step that is recorded (RecordedStep) is launched by the thread that recorded it.
class ScratchMemory {
 public:
  using value_type = char;

  char* allocate(std::ptrdiff_t bytes) {
    for (Block& block : blocks_)
      if (!block.taken && block.size >= bytes) {
        block.taken = true;
        return block.memory.data();
      }
    blocks_.push_back({{}, bytes, true});
    blocks_.back().memory.resize(std::size_t(bytes));
    return blocks_.back().memory.data();
  }
  void deallocate(char* memory, std::size_t) {
    for (Block& block : blocks_) block.taken = block.taken && block.memory.data() != memory;
  }

 private:
  struct Block {
    DeviceArray<char> memory;
    std::ptrdiff_t size;
    bool taken;
  };
  std::vector<Block> blocks_{};
};
inline ScratchMemory& scratch_memory() {
  static thread_local std::array<ScratchMemory, most_devices> all{};
  return all[std::size_t(current_device())];
}
#endif

namespace detail {
/// f(policy) with that of Thrust for the queue of the calling thread.
template <class F>
void with_policy(F&& f) {
#if SINEW_CUDA
  f(thrust::cuda::par_nosync(scratch_memory()).on(stream()));
#else
  f(thrust::device);
#endif
}
}  // namespace detail

/// Sorts the values by their keys, both on the device; the order of equals stays.
inline void sort_by_key(std::uint64_t* keys, int* values, std::size_t n) {
  detail::with_policy(
      [&](auto const& policy) { thrust::stable_sort_by_key(policy, keys, keys + n, values); });
}
/// Each becomes the sum of all up to itself.
inline void add_up(int* values, std::size_t n) {
  detail::with_policy(
      [&](auto const& policy) { thrust::inclusive_scan(policy, values, values + n, values); });
}

}  // namespace sinew::gpu
