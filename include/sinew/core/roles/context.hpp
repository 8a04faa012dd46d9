// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/core/role.hpp>

namespace sinew {

// A value that holds for its node and all below it. The shortest:
//
//   /// That of the Moon.
//   struct MoonGravity {
//     using Role = role::Context;
//     static constexpr std::string_view className = "MoonGravity";
//     static constexpr auto fields() { return field_list(); }
//     Eigen::Vector3d gravity{0, -1.62, 0};
//   };

template <class C>
concept Context = HasRole<C, role::Context> && requires(C const c) {
  { c.gravity } -> std::convertible_to<Eigen::Vector3d>;
};

template <>
struct Promise<role::Context> : NoPromise {
  template <class C>
  static constexpr bool kept = Context<C>;
  template <class C>
  struct Broken {
    static_assert(Context<C>, "Sinew: a context has no 'Eigen::Vector3d gravity{0, -9.81, 0}' [m/s^2].");
  };
};

}  // namespace sinew
