// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/core/role.hpp>

#include <optional>
#include <string>

namespace sinew {

// Which elements of a body go where a tool touches it: CarvingManager is the one that there is.

/// Whether it removes anything, and below which distance [m]; below that from which contacts act where it
/// says none.
template <class C>
concept HasCarvingDistance = requires(C const c) {
  { c.active } -> std::convertible_to<bool>;
  { c.carvingDistance } -> std::same_as<std::optional<double> const&>;
};
/// Paths of the nodes with the collision models of the tool and of the body, as they are given; init makes
/// `tool` and `body` of them, from the root of the scene on.
template <class C>
concept NamesTool = requires(C c) {
  { c.toolModel } -> std::convertible_to<std::string const&>;
  { c.surfaceModelPath } -> std::convertible_to<std::string const&>;
  { c.tool } -> std::same_as<std::string&>;
  { c.body } -> std::same_as<std::string&>;
};
/// How many elements have gone, and what went wrong.
template <class C>
concept CountsRemoved = requires(C c) {
  { c.removed } -> std::same_as<long&>;
  { c.message } -> std::same_as<std::string&>;
};

template <class C>
concept Carves = HasRole<C, role::Carving> && HasCarvingDistance<C> && NamesTool<C> && CountsRemoved<C>;

template <>
struct Promise<role::Carving> : NoPromise {
  template <class C>
  static constexpr bool kept = Carves<C>;
  template <class C>
  struct Broken {
    static constexpr bool named = NamesTool<C>;  // compilers explain a concept at length
    static_assert(HasCarvingDistance<C>,
                  "Sinew: a component with role::Carving has no 'bool active' or no 'std::optional<double> "
                  "carvingDistance' [m].");
    static_assert(named,
                  "Sinew: a component with role::Carving has no 'std::string toolModel{}, "
                  "surfaceModelPath{}', paths of the models, or no 'std::string tool{}, body{}', which init "
                  "makes of them.");
    static_assert(CountsRemoved<C>,
                  "Sinew: a component with role::Carving has no 'long removed = 0', or no 'std::string "
                  "message{}', which the steps write.");
  };
};

}  // namespace sinew
