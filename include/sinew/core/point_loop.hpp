// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/core/platform.hpp>

#include <cstddef>
#include <vector>

namespace sinew {

/// Where a loop finds the entries of a vector. DataTypes whose vectors live on a device overload it: there it
/// is an address of the device.
template <class T>
T* entries(std::vector<T>& v) {
  return v.data();
}
template <class T>
T const* entries(std::vector<T> const& v) {
  return v.data();
}
/// The same for a loop that writes all entries: what they were need not be there.
template <class T>
T* overwritten(std::vector<T>& v) {
  return v.data();
}

/// body(i) for i = 0 .. count - 1, where the vectors of D are. `body` has nothing but numbers and addresses
/// that entries() gave, and is SINEW_HD; the order in which a device takes the points must not matter.
template <class D, class Body>
void each_point(std::size_t count, Body const& body) {
  if constexpr (requires { D::eachPoint(count, body); })
    D::eachPoint(count, body);
  else
    for (std::size_t i = 0; i < count; ++i) body(int(i));
}

}  // namespace sinew
