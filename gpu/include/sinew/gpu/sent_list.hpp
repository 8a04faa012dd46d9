// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/gpu/execution.hpp>

#include <cstring>
#include <type_traits>
#include <vector>

namespace sinew::gpu {

/// A list of the host of which the device has a copy, sent only where it has changed. T holds nothing but
/// numbers.
template <class T>
class SentList {
  static_assert(std::is_trivially_destructible_v<T>);

 public:
  T* send(std::vector<T> const& now) {
    if (sent_.size() != now.size() ||
        (!now.empty() &&
         std::memcmp(static_cast<void const*>(sent_.data()), now.data(), now.size() * sizeof(T)) != 0)) {
      there_.resize(now.size());
      copy_to_device(there_.data(), now.data(), now.size());
      sent_ = now;
    }
    return there_.data();
  }

 private:
  std::vector<T> sent_{};
  DeviceArray<T> there_{};
};

}  // namespace sinew::gpu
