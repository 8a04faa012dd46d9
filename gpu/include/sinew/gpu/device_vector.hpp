// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/gpu/execution.hpp>

#include <algorithm>
#include <cstddef>
#include <initializer_list>
#include <utility>
#include <vector>

namespace sinew::gpu {

/// Entries that have crossed between host and device since the start of the program, or since a test has set
/// them to 0.
struct Transfers {
  std::size_t toDevice = 0, toHost = 0;
};
inline Transfers& transfers() {
  static thread_local Transfers count;
  return count;
}

/// A vector that the host sees as std::vector, and device loops by device(). Each side gets a copy when it
/// first asks for it, and a new one when the other has written since: what runs on the device alone never
/// crosses. Memory of the device is taken at the first device(). Not for several threads at once, not even
/// to read.
template <class T>
class DeviceVector {
 public:
  using value_type = T;
  using iterator = typename std::vector<T>::iterator;
  using const_iterator = typename std::vector<T>::const_iterator;

  DeviceVector() = default;
  explicit DeviceVector(std::size_t n) : size_(n), host_(n) {}
  DeviceVector(std::size_t n, T const& value) : size_(n), host_(n, value) {}
  DeviceVector(std::initializer_list<T> list) : size_(list.size()), host_(list) {}
  DeviceVector(std::vector<T> list) : size_(list.size()), host_(std::move(list)) {}
  template <class Iterator>
  DeviceVector(Iterator from, Iterator to) : host_(from, to) {
    size_ = host_.size();
  }
  DeviceVector(DeviceVector const& other) { *this = other; }
  DeviceVector(DeviceVector&& other) noexcept { *this = std::move(other); }
  DeviceVector& operator=(DeviceVector const& other) {
    if (this == &other) return *this;
    if (other.newest_ == Side::device) {
      device_.resize(other.size_);
      copy_on_device(device_.data(), other.device_.data(), other.size_);
      writtenOnDevice();
    } else {
      host_ = other.host_;
      newest_ = Side::host;
    }
    size_ = other.size_;
    return *this;
  }
  DeviceVector& operator=(DeviceVector&& other) noexcept {
    size_ = std::exchange(other.size_, 0);
    newest_ = std::exchange(other.newest_, Side::host);
    host_ = std::move(other.host_);
    other.host_.clear();
    device_ = std::move(other.device_);
    arrival_ = std::move(other.arrival_);
    arriving_ = std::exchange(other.arriving_, false);
    return *this;
  }

  std::size_t size() const { return size_; }
  bool empty() const { return size_ == 0; }

  // the device's side

  T const* device() const {
    upload();
    return device_.data();
  }
  /// What the host has of it is old from here on.
  T* device() {
    upload();
    writtenOnDevice();
    return device_.data();
  }
  /// The same where all entries are written: what they were does not cross.
  T* overwrite() {
    device_.resize(size_);
    writtenOnDevice();
    return device_.data();
  }
  /// Of so many entries.
  T* overwrite(std::size_t n) {
    size_ = n;
    return overwrite();
  }

  /// Begins to bring it to the host, which goes on meanwhile: when it looks, it waits for that alone.
  void bringToHost() const {
    if (newest_ != Side::device || arriving_ || size_ == 0) return;
    arrival_.begin(device_.data(), size_);
    arriving_ = true;
  }

  // the host's side

  /// Whether the host may look at it without a copy.
  bool isOnHost() const { return newest_ != Side::device; }

  std::vector<T> const& host() const {
    download();
    return host_;
  }
  std::vector<T>& host() {
    download();
    newest_ = Side::host;
    return host_;
  }
  /// The same where the host writes all entries.
  T* overwriteOnHost() {
    host_.resize(size_);
    newest_ = Side::host;
    return host_.data();
  }
  T* data() { return host().data(); }
  T const* data() const { return host().data(); }
  T& operator[](std::size_t i) { return host()[i]; }
  T const& operator[](std::size_t i) const { return host()[i]; }
  T& front() { return host().front(); }
  T const& front() const { return host().front(); }
  T& back() { return host().back(); }
  T const& back() const { return host().back(); }
  iterator begin() { return host().begin(); }
  iterator end() { return host().end(); }
  const_iterator begin() const { return host().begin(); }
  const_iterator end() const { return host().end(); }
  void reserve(std::size_t n) { host().reserve(n); }
  template <class... Args>
  void resize(std::size_t n, Args const&... value) {
    if (n == size_) return;
    host().resize(n, value...);
    size_ = n;
  }
  template <class... Args>
  void assign(Args&&... args) {
    newest_ = Side::host;
    host_.assign(std::forward<Args>(args)...);
    size_ = host_.size();
  }
  void push_back(T const& value) {
    host().push_back(value);
    ++size_;
  }
  template <class... Args>
  T& emplace_back(Args&&... args) {
    host().emplace_back(std::forward<Args>(args)...);
    ++size_;
    return host_.back();
  }
  template <class Iterator>
  iterator insert(const_iterator at, Iterator from, Iterator to) {
    const auto first = host().insert(at, from, to);
    size_ = host_.size();
    return first;
  }
  iterator erase(const_iterator from, const_iterator to) {
    const auto next = host().erase(from, to);
    size_ = host_.size();
    return next;
  }
  void clear() {
    host_.clear();
    size_ = 0;
    newest_ = Side::host;
  }
  void swap(DeviceVector& other) noexcept { std::swap(*this, other); }
  bool operator==(DeviceVector const& other) const { return host() == other.host(); }

 private:
  enum class Side { host, device, both };
  std::size_t size_ = 0;
  mutable Side newest_ = Side::host;
  mutable std::vector<T> host_{};
  mutable DeviceArray<T> device_{};
  mutable Arrival<T> arrival_{};
  mutable bool arriving_ = false;  // what the device has is in arrival_

  void writtenOnDevice() {
    newest_ = Side::device;
    arriving_ = false;
  }

  void upload() const {
    if (newest_ != Side::host) return;
    device_.resize(size_);
    copy_to_device(device_.data(), host_.data(), size_);
    transfers().toDevice += size_;
    newest_ = Side::both;
  }
  void download() const {
    if (newest_ != Side::device) return;
    host_.resize(size_);
    if (std::exchange(arriving_, false))
      arrival_.take(host_.data(), size_);
    else
      copy_to_host(host_.data(), device_.data(), size_);
    transfers().toHost += size_;
    newest_ = Side::both;
  }
};

template <class T>
T* entries(DeviceVector<T>& v) {
  return v.device();
}
template <class T>
T const* entries(DeviceVector<T> const& v) {
  return v.device();
}
template <class T>
T* overwritten(DeviceVector<T>& v) {
  return v.overwrite();
}
template <class T>
void bring_to_host(DeviceVector<T> const& v) {
  v.bringToHost();
}

}  // namespace sinew::gpu
