// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/core/compiled.hpp>
#include <sinew/core/work_share.hpp>

#include <atomic>
#include <exception>
#include <system_error>
#include <thread>
#include <type_traits>
#include <utility>
#include <vector>

namespace sinew {

/// Threads that wait for work, and the one of the caller, which does its share, and that of a thread which
/// has not come when it is done. They spin for some microseconds before they sleep, unless there are more of
/// them than the machine has.
class Workers {
 public:
  explicit Workers(int count);
  Workers(Workers const&) = delete;
  ~Workers() { stop(); }

  int count() const { return int(threads_.size()) + 1; }

  /// f(share) for the shares of the work, each in one thread. When all have ended, what the first of them has
  /// thrown is thrown.
  template <class F>
  void run(F&& f) {
    call_ = [](void* context, WorkShare share) {
      (*static_cast<std::remove_reference_t<F>*>(context))(share);
    };
    context_ = const_cast<void*>(static_cast<void const*>(std::addressof(f)));
    busy_.store(int(threads_.size()), std::memory_order_relaxed);
    begin();
    doShare(0);
    for (int i = count() - 1; i > 0; --i) take(i, round_.load(std::memory_order_relaxed));
    await(busy_, [](int busy) { return busy == 0; });
    if (failed_.load(std::memory_order_relaxed)) [[unlikely]]
      raise();
  }

  /// Room for sums of shares, which run() may fill.
  void reserveSums(std::size_t n) {
    if (sums_.size() < n) sums_.resize(n);
  }
  double* sums() { return sums_.data(); }
  std::size_t sumCount() const { return sums_.size(); }

 private:
  std::vector<std::thread> threads_{};
  std::vector<std::exception_ptr> errors_;
  // the round in which a share was taken last
  struct alignas(64) Taken {
    std::atomic<int> round{0};
  };
  std::vector<Taken> taken_;
  std::vector<double> sums_{};
  int spins_;
  void (*call_)(void*, WorkShare) = nullptr;
  void* context_ = nullptr;
  std::atomic<bool> ending_{false};
  alignas(64) std::atomic<int> round_{0};
  alignas(64) std::atomic<int> busy_{0};
  std::atomic<bool> failed_{false};

  void begin() {
    round_.fetch_add(1, std::memory_order_release);
    round_.notify_all();
  }
  void doShare(int index) {
    try {
      call_(context_, WorkShare{index, count()});
    } catch (...) {
      errors_[std::size_t(index)] = std::current_exception();
      failed_.store(true, std::memory_order_relaxed);
    }
  }
  // Does a share, unless another thread does. A round lasts until all its shares are done, so that what a
  // thread that comes late takes for the work of its round is that.
  void take(int index, int round);
  void work(int index);
  template <class Done>
  void await(std::atomic<int> const& value, Done&& done) const {
    for (int i = 0; i < spins_; ++i) {
      if (done(value.load(std::memory_order_acquire))) return;
#if defined(__x86_64__) || defined(__i386__)
      __builtin_ia32_pause();
#elif defined(__aarch64__)
      asm volatile("yield");
#endif
    }
    for (int now; !done(now = value.load(std::memory_order_acquire));)
      value.wait(now, std::memory_order_acquire);
  }
  void raise() {
    failed_ = false;
    std::exception_ptr first;
    for (auto& error : errors_)
      if (auto e = std::exchange(error, nullptr); e && !first) first = e;
    std::rethrow_exception(first);
  }
  void stop() {
    ending_.store(true, std::memory_order_relaxed);
    begin();
    for (auto& thread : threads_) thread.join();
  }
};

/// Workers that may be none, as the operations of a scene see them.
struct SomeWorkers {
  Workers* workers = nullptr;

  int count() const { return workers ? workers->count() : 1; }
  template <class F>
  void run(F&& f) const {
    if (workers)
      workers->run(f);
    else
      f(WorkShare{});
  }
  void reserveSums(std::size_t n) const {
    if (workers) workers->reserveSums(n);
  }
  double* sums() const { return workers ? workers->sums() : nullptr; }
};

/// The workers of a scope, whatever their type.
inline SomeWorkers some_workers(SomeWorkers const& workers) { return workers; }
inline SomeWorkers some_workers(OneThread const&) { return {}; }

}  // namespace sinew

#if SINEW_DEFINES
#include <sinew/core/error.hpp>

#include <memory>

namespace sinew {

SINEW_ONCE Workers::Workers(int count)
    : errors_(std::size_t(count)),
      taken_(std::size_t(count)),
      spins_(unsigned(count) <= std::thread::hardware_concurrency() ? 4000 : 0) {
  threads_.reserve(std::size_t(count) - 1);
  try {
    for (int i = 1; i < count; ++i) threads_.emplace_back([this, i] { work(i); });
  } catch (std::system_error const& error) {
    stop();
    throw Error("Threads",
                text("cannot start ", count, " threads (", error.what(), "); take a smaller count"));
  }
}

SINEW_ONCE void Workers::take(int index, int round) {
  int before = round - 1;
  if (!taken_[std::size_t(index)].round.compare_exchange_strong(before, round, std::memory_order_acq_rel))
    return;
  doShare(index);
  if (busy_.fetch_sub(1, std::memory_order_acq_rel) == 1) busy_.notify_one();
}

SINEW_ONCE void Workers::work(int index) {
  for (int round = 0;;) {
    await(round_, [&](int now) { return now != round; });
    round = round_.load(std::memory_order_acquire);
    if (ending_.load(std::memory_order_relaxed)) return;
    take(index, round);
  }
}

}  // namespace sinew
#endif
