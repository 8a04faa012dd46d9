// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/gpu/execution.hpp>

#include <array>
#include <cstddef>
#include <utility>
#include <vector>

namespace sinew::gpu {

/// The calling thread works on a device, as long as it lives.
class UseDevice {
 public:
  explicit UseDevice([[maybe_unused]] int device) {
#if SINEW_CUDA
    before_ = current_device();
    if (before_ != device) check(cudaSetDevice(device), "Sinew on several GPUs");
    now_ = device;
#endif
  }
  UseDevice(UseDevice const&) = delete;
  ~UseDevice() {
#if SINEW_CUDA
    if (before_ != now_) cudaSetDevice(before_);
#endif
  }

 private:
#if SINEW_CUDA
  int before_ = 0, now_ = 0;
#endif
};

/// All devices there are; on the host two.
inline std::vector<int> all_devices() {
#if SINEW_CUDA
  std::vector<int> all;
  for (int d = 0; d < device_count(); ++d) all.push_back(d);
  return all;
#else
  return {0, 1};
#endif
}

/// The devices that parts of a body are on; several parts may be on one. One thread of the host queues the
/// work of all of them, and they wait for each other without it.
class DeviceGroup {
 public:
  DeviceGroup() = default;
  /// Throws Error where there is no such device, or where two of them cannot write each other's memory.
  explicit DeviceGroup(std::vector<int> devices, char const* who) : devices_(std::move(devices)) {
    if (devices_.empty()) throw Error(who, "no devices are given; give one at least");
    if (devices_.size() > std::size_t(most_devices))
      throw Error(who, text(devices_.size(), " devices are given; there may be ", most_devices));
    const int count = device_count();
    for (const int d : devices_)
      if (d < 0 || d >= count)
        throw Error(who,
                    text("there is no GPU ", d, "; the ", count, " of this machine are numbered from 0"));
#if SINEW_CUDA
    for (const int d : devices_)
      for (const int other : devices_) befriend(d, other, who);
    for (const int d : devices_) {
      const UseDevice use(d);
      Event e;
      check(cudaEventCreateWithFlags(&e.event, cudaEventDisableTiming), who);
      events_.push_back(std::move(e));
    }
#endif
  }

  std::size_t size() const { return devices_.size(); }
  int device(std::size_t part) const { return devices_[part]; }

  /// f(part) on the device of each part, in turn.
  template <class F>
  void each(F&& f) const {
    for (std::size_t p = 0; p < size(); ++p) {
      const UseDevice use(devices_[p]);
      f(p);
    }
  }
  /// Notes what has been queued on each device.
  void mark() const {
#if SINEW_CUDA
    if (size() > 1) each([&](std::size_t p) { check(cudaEventRecord(events_[p].event, stream()), waiting); });
#endif
  }
  /// What is queued from here on waits for what the others have been seen to do by the last mark().
  void await() const {
#if SINEW_CUDA
    each([&](std::size_t p) {
      for (std::size_t other = 0; other < size(); ++other)
        if (devices_[other] != devices_[p])
          check(cudaStreamWaitEvent(stream(), events_[other].event, 0), waiting);
    });
#endif
  }
  void sync() const {
    mark();
    await();
  }
  /// The host waits for all.
  void wait() const {
    each([](std::size_t) { gpu::wait(); });
  }

 private:
  static constexpr char const* waiting = "GPUs that wait for each other";
  std::vector<int> devices_{};
#if SINEW_CUDA
  struct Event {
    cudaEvent_t event = nullptr;
    Event() = default;
    Event(Event&& other) noexcept : event(std::exchange(other.event, nullptr)) {}
    Event& operator=(Event&& other) noexcept {
      std::swap(event, other.event);
      return *this;
    }
    ~Event() {
      if (event) cudaEventDestroy(event);
    }
  };
  std::vector<Event> events_{};

  // kernels of one device may write the memory of the other
  static void befriend(int device, int other, char const* who) {
    if (device == other) return;
    int can = 0;
    check(cudaDeviceCanAccessPeer(&can, device, other), who);
    if (!can)
      throw Error(who,
                  text("GPU ",
                       device,
                       " cannot write the memory of GPU ",
                       other,
                       "; take GPUs that are joined (nvidia-smi topo -m), or one"));
    const UseDevice use(device);
    const cudaError_t code = cudaDeviceEnablePeerAccess(other, 0);
    if (code == cudaErrorPeerAccessAlreadyEnabled)
      cudaGetLastError();
    else
      check(code, who);
  }
#endif
};

/// A number that is summed up over all parts: each has the sums of all in memory of its own, and adds them up
/// in the same order, so that all find the same bits.
struct SharedSum {
  double const* of;
  int parts;
  SINEW_INLINE double operator()() const {
    double sum = 0;
    for (int p = 0; p < parts; ++p) sum += of[p];
    return sum;
  }
};
/// Where a part puts its own, for all (sum_indices).
struct ToParts {
  std::array<double*, most_devices> of;
  int parts;
  SINEW_INLINE void put(double sum) const {
    for (int p = 0; p < parts; ++p) *of[std::size_t(p)] = sum;
  }
};

}  // namespace sinew::gpu
