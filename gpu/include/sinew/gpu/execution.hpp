// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/core/error.hpp>
#include <sinew/core/platform.hpp>

#include <thrust/execution_policy.h>
#include <thrust/for_each.h>
#include <thrust/iterator/counting_iterator.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstring>
#include <new>
#include <utility>

// -DTHRUST_DEVICE_SYSTEM says where device work runs: CUDA under nvcc; elsewhere CPP or OMP, on the host
#if THRUST_DEVICE_SYSTEM == THRUST_DEVICE_SYSTEM_CUDA
#define SINEW_CUDA 1
#else
#define SINEW_CUDA 0
#endif

namespace sinew::gpu {

#if SINEW_CUDA
/// Throws Error where a call of CUDA fails: what was asked for, and what CUDA says.
inline void check(cudaError_t code, char const* what) {
  if (code == cudaSuccess) return;
  cudaGetLastError();  // the next call starts afresh
  if (code == cudaErrorNoDevice || code == cudaErrorInsufficientDriver)
    throw Error(what,
                "there is no GPU that this program can use; run it on a machine with one and its driver, or "
                "take DataTypes of the processor, such as Vec3f for CudaVec3f");
  throw Error(what, text("the GPU says: ", cudaGetErrorString(code)));
}
#endif

/// Devices of a program, at most.
inline constexpr int most_devices = 16;

/// The device that the calling thread works on: memory is that of this one, work is queued there. On Thrust's
/// backends for the host its number changes nothing.
inline int current_device() {
  int device = 0;
#if SINEW_CUDA
  check(cudaGetDevice(&device), "Sinew on a GPU");
  if (device >= most_devices)
    throw Error("Sinew on a GPU", text("GPU ", device, "; only ", most_devices, " of a machine are used"));
#endif
  return device;
}
/// How many there are; on the host as many as there may be.
inline int device_count() {
#if SINEW_CUDA
  int count = 0;
  check(cudaGetDeviceCount(&count), "Sinew on a GPU");
  return std::min(count, most_devices);
#else
  return most_devices;
#endif
}

#if SINEW_CUDA
/// The stream on which all work of the calling thread on its device is queued: in order, waited for by the
/// first copy to the host.
inline cudaStream_t stream() {
  static thread_local std::array<cudaStream_t, most_devices> all{};
  cudaStream_t& own = all[std::size_t(current_device())];
  if (!own) check(cudaStreamCreateWithFlags(&own, cudaStreamNonBlocking), "Sinew on a GPU");
  return own;
}
#endif

/// Waits until all that is queued is done. Throws Error where something of it failed.
inline void wait() {
#if SINEW_CUDA
  check(cudaStreamSynchronize(stream()), "Sinew on a GPU");
#endif
}

/// Whether work is being recorded as a graph instead of being done: nothing may ask for its results.
inline bool& recording() {
  static thread_local bool now = false;
  return now;
}

#if SINEW_CUDA
inline constexpr unsigned max_threads = 256;  // of a block
/// Threads of a block for a loop of so many indices: few where the loop is short, so that it is spread over
/// the GPU (Thrust's own loops give 512 indices to a block).
inline unsigned threads_for(std::size_t count) {
  constexpr std::size_t processors = 128;
  return count >= processors * max_threads ? max_threads
         : count >= processors * 128       ? 128
         : count >= processors * 64        ? 64
                                           : 32;
}
namespace detail {
template <class Body>
__global__ void __launch_bounds__(max_threads) each_kernel(unsigned count, Body body) {
  const unsigned i = blockIdx.x * blockDim.x + threadIdx.x;
  if (i < count) body(int(i));
}
}  // namespace detail
#endif

/// body(i) for i = 0 .. count - 1, one thread each. `body` is an object whose operator() is SINEW_HD; no
/// lambda, since those of a template that nvcc compiles in two files are mixed up.
template <class Body>
void for_each_index(std::size_t count, Body const& body) {
  if (count == 0) return;
#if SINEW_CUDA
  const unsigned threads = threads_for(count);
  detail::each_kernel<<<unsigned((count + threads - 1) / threads), threads, 0, stream()>>>(unsigned(count),
                                                                                           body);
  check(cudaGetLastError(), "a loop on the GPU");
#else
  thrust::for_each_n(thrust::device, thrust::counting_iterator<int>(0), int(count), body);
#endif
}

/// *to += *from
struct AddTo {
  double* to;
  double const* from;
  SINEW_HD void operator()(int) const { *to += *from; }
};

/// Queues a copy. What is copied may change when this returns: CUDA has it then, in memory of its own.
template <class T>
void copy_to_device(T* to, T const* from, std::size_t n) {
  if (n == 0) return;
#if SINEW_CUDA
  check(cudaMemcpyAsync(to, from, n * sizeof(T), cudaMemcpyHostToDevice, stream()), "copy to the GPU");
#else
  std::copy_n(from, n, to);
#endif
}
template <class T>
void copy_to_host(T* to, T const* from, std::size_t n) {
  if (n == 0) return;
#if SINEW_CUDA
  check(cudaMemcpyAsync(to, from, n * sizeof(T), cudaMemcpyDeviceToHost, stream()), "copy from the GPU");
  wait();
#else
  std::copy_n(from, n, to);
#endif
}
template <class T>
void copy_on_device(T* to, T const* from, std::size_t n) {
  if (n == 0) return;
#if SINEW_CUDA
  check(cudaMemcpyAsync(to, from, n * sizeof(T), cudaMemcpyDeviceToDevice, stream()), "copy on the GPU");
#else
  std::copy_n(from, n, to);
#endif
}

/// Makes all bytes 0.
template <class T>
void clear_on_device(T* to, std::size_t n) {
  if (n == 0) return;
#if SINEW_CUDA
  check(cudaMemsetAsync(to, 0, n * sizeof(T), stream()), "a loop on the GPU");
#else
  std::memset(static_cast<void*>(to), 0, n * sizeof(T));
#endif
}

/// Memory of the device, not initialised; T holds nothing but numbers. It grows, and stays when it shrinks.
template <class T>
class DeviceArray {
 public:
  DeviceArray() = default;
  DeviceArray(DeviceArray const&) = delete;
  DeviceArray(DeviceArray&& other) noexcept { *this = std::move(other); }
  DeviceArray& operator=(DeviceArray&& other) noexcept {
    std::swap(data_, other.data_);
    std::swap(capacity_, other.capacity_);
    return *this;
  }
  ~DeviceArray() { free(); }

  /// Throws Error where the device has no such memory; what was there stays.
  void resize(std::size_t n) {
    if (n <= capacity_) return;
#if SINEW_CUDA
    T* made = nullptr;
    const cudaError_t code = cudaMalloc(reinterpret_cast<void**>(&made), n * sizeof(T));
    if (code == cudaErrorMemoryAllocation) {
      std::size_t left = 0, all = 0;
      cudaGetLastError();
      cudaMemGetInfo(&left, &all);
      throw Error("memory of the GPU",
                  text(n * sizeof(T) >> 20,
                       " MiB are needed, ",
                       left >> 20,
                       " of ",
                       all >> 20,
                       " MiB are free; make the body smaller, or take CudaVec3f for CudaVec3d"));
    }
    check(code, "memory of the GPU");
#else
    T* const made = static_cast<T*>(::operator new(n * sizeof(T), std::align_val_t(64)));
#endif
    free();
    data_ = made;
    capacity_ = n;
  }
  T* data() const { return data_; }

 private:
  T* data_ = nullptr;
  std::size_t capacity_ = 0;

  void free() {
    if (!data_) return;
#if SINEW_CUDA
    cudaFree(data_);
#else
    ::operator delete(data_, std::align_val_t(64));
#endif
    data_ = nullptr;
  }
};

/// Memory of the device for what is made anew each time: a copy has memory of its own, once it asks for it.
template <class T>
struct WorkArray : DeviceArray<T> {
  WorkArray() = default;
  WorkArray(WorkArray const&) : DeviceArray<T>() {}
  WorkArray(WorkArray&&) = default;
  WorkArray& operator=(WorkArray const&) { return *this; }
  WorkArray& operator=(WorkArray&&) = default;
};

/// A copy on its way from the device to the host, in memory that a GPU writes while the host goes on.
template <class T>
class Arrival {
 public:
  Arrival() = default;
  Arrival(Arrival const&) = delete;
  Arrival(Arrival&& other) noexcept { *this = std::move(other); }
  Arrival& operator=(Arrival&& other) noexcept {
    std::swap(buffer_, other.buffer_);
    std::swap(capacity_, other.capacity_);
#if SINEW_CUDA
    std::swap(there_, other.there_);
#endif
    return *this;
  }
  ~Arrival() { free(); }

  /// Queues the copy of n entries.
  void begin(T const* from, std::size_t n) {
    if (n > capacity_) {
      free();
#if SINEW_CUDA
      check(cudaMallocHost(reinterpret_cast<void**>(&buffer_), n * sizeof(T)),
            "memory for copies from the GPU");
      check(cudaEventCreateWithFlags(&there_, cudaEventDisableTiming), "copy from the GPU");
#else
      buffer_ = static_cast<T*>(::operator new(n * sizeof(T), std::align_val_t(64)));
#endif
      capacity_ = n;
    }
#if SINEW_CUDA
    check(cudaMemcpyAsync(buffer_, from, n * sizeof(T), cudaMemcpyDeviceToHost, stream()),
          "copy from the GPU");
    check(cudaEventRecord(there_, stream()), "copy from the GPU");
#else
    std::copy_n(from, n, buffer_);
#endif
  }
  /// What has come, once it was taken.
  T const* data() const { return buffer_; }
  /// Waits for it, and for nothing that has been queued since.
  void take(T* to, std::size_t n) const {
#if SINEW_CUDA
    check(cudaEventSynchronize(there_), "copy from the GPU");
#endif
    std::copy_n(buffer_, n, to);
  }

 private:
  T* buffer_ = nullptr;
  std::size_t capacity_ = 0;
#if SINEW_CUDA
  cudaEvent_t there_ = nullptr;
#endif

  void free() {
    if (!buffer_) return;
#if SINEW_CUDA
    cudaFreeHost(buffer_);
    if (there_) cudaEventDestroy(there_);
    there_ = nullptr;
#else
    ::operator delete(buffer_, std::align_val_t(64));
#endif
    buffer_ = nullptr;
    capacity_ = 0;
  }
};

}  // namespace sinew::gpu
