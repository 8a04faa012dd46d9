// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/core/role.hpp>

#include <vector>

namespace sinew {

/// A value of one component that follows a value of another one while a typed scene runs: DataLink is the one
/// that there is. `From` and `To` have the `path` of a node, from that of the link on, the `Class` of a
/// component in it, and the `member` that is the value.
template <class C>
concept LinksData = HasRole<C, role::DataLink> && requires(C c) {
  C::From::path;
  C::To::path;
  typename C::From::Class;
  typename C::To::Class;
  C::From::member;
  C::To::member;
  { c.numbers } -> std::same_as<std::vector<double>&>;
  { c.next } -> std::same_as<std::vector<double>&>;
};

template <>
struct Promise<role::DataLink> : NoPromise {
  template <class C>
  static constexpr bool kept = LinksData<C>;
  template <class C>
  struct Broken {
    static_assert(LinksData<C>,
                  "Sinew: a data link has no From or no To; write data_link(At<\"body\", "
                  "&MechanicalObject<Vec3d>::position>{}, At<\"body\", &AverageCoord<Vec3d>::position>{}).");
  };
};

}  // namespace sinew
