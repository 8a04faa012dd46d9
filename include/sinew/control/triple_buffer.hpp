// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/core/platform.hpp>

#include <array>
#include <atomic>
#include <cstdint>

namespace sinew {

/// The latest value of a state, from one thread to one other. Neither ever waits: of three slots the writer
/// owns one, the reader another, and the third lies between them; an exchange of one byte swaps a slot for
/// it. The reader sees whole values only, in the order in which they were written, and skips those that were
/// overwritten.
template <class T>
class TripleBuffer {
 public:
  explicit TripleBuffer(T const& initial = T{}) : slots_{Slot{initial}, Slot{initial}, Slot{initial}} {}

  /// By the writing thread alone.
  void write(T const& value) {
    slots_[back_].value = value;
    // release: the value is there before the slot is; acquire: the reader is done with the slot that returns
    back_ = between_.exchange(std::uint8_t(back_ | fresh), std::memory_order_acq_rel) & index;
  }

  /// By the reading thread alone: takes the latest value; false where there is none since the last time.
  bool update() {
    if ((between_.load(std::memory_order_relaxed) & fresh) == 0) return false;
    front_ = between_.exchange(front_, std::memory_order_acq_rel) & index;
    return true;
  }
  /// By the reading thread alone: what update() took last, or the initial value.
  T const& read() const { return slots_[front_].value; }

 private:
  static constexpr std::uint8_t fresh = 4, index = 3;
  static_assert(std::atomic<std::uint8_t>::is_always_lock_free);

  // a cache line each, so that the threads do not slow each other down
  struct alignas(64) Slot {
    T value;
  };
  std::array<Slot, 3> slots_;
  alignas(64) std::uint8_t back_ = 0;
  alignas(64) std::uint8_t front_ = 1;
  alignas(64) std::atomic<std::uint8_t> between_{2};
};

}  // namespace sinew
