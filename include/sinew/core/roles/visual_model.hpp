// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/core/role.hpp>

#include <string>

namespace sinew {

// Positions that follow by the mapping of their node and take no part in mechanics. The shortest:
//
//   /// Points to look at.
//   struct Markers {
//     using Role = role::VisualModel;
//     using DataTypes = Vec3f;
//     static constexpr std::string_view className = "Markers";
//     static constexpr auto fields() { return field_list(); }
//
//     Vec3f::VecCoord position{};
//
//     void init(std::string const&) {}
//   };

template <class C>
concept Visual = HasRole<C, role::VisualModel> && requires(C c, std::string where) {
  { c.position } -> std::same_as<Vec3f::VecCoord&>;
  c.init(where);
};

template <>
struct Promise<role::VisualModel> : NoPromise {
  template <class C>
  static constexpr bool kept = Visual<C>;
  template <class C>
  struct Broken {
    static_assert(
        Visual<C>,
        "Sinew: a visual model has no 'Vec3f::VecCoord position{}', or no 'void init(std::string const& "
        "where)'.");
  };
};

}  // namespace sinew
