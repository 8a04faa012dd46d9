// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/core/role.hpp>

#include <string>
#include <utility>
#include <vector>

namespace sinew {

// Composes the stages of collision detection in its node, for the models below it: DefaultPipeline is the one
// that there is.

struct CollisionSurface;  // the primitives of a model: collision/collision_surface.hpp

/// The models of a step, in the order of the scene, and the pairs of them that are near each other.
template <class C>
concept HasModelPairs = requires(C c) {
  { c.surfaces } -> std::same_as<std::vector<CollisionSurface*>&>;
  { c.near } -> std::same_as<std::vector<std::pair<int, int>>&>;
};

/// Hook: it has the models of the scene that it lists, takes(surface), wherever these are, instead of those
/// below its node; choose(where, surfaces) finds them at init. It stands in the root, or in a node right below
/// that.
template <class C>
concept ListsModels = requires(C c, std::string const& where, CollisionSurface const& s) {
  { c.takes(s) } -> std::convertible_to<bool>;
  c.choose(where);
};

template <class C>
concept CollisionPipeline = HasRole<C, role::CollisionPipeline> && HasModelPairs<C> &&
                            may_have<C>(named::findNear<C>) && may_have<C>(named::findContacts<C>);

template <>
struct Promise<role::CollisionPipeline> : NoPromise {
  template <class C>
  static constexpr bool kept = CollisionPipeline<C>;
  template <class C>
  struct Broken {
    static_assert(HasModelPairs<C>,
                  "Sinew: a collision pipeline has no 'std::vector<CollisionSurface*> surfaces{}' or no "
                  "'std::vector<std::pair<int, int>> near{}', the models and the pairs of them.");
    static_assert(may_have<C>(named::findNear<C>),
                  "Sinew: a collision pipeline has no 'template <class Broad> void findNear(Broad& broad)', "
                  "which takes the pairs of models from the broad phase.");
    static_assert(
        may_have<C>(named::findContacts<C>),
        "Sinew: a collision pipeline has no 'template <Shape... Known, class Narrow, class Intersection, "
        "class Manager> void findContacts(ShapeList<Known...>, Narrow&, Intersection const&, Manager&, "
        "double dt)', which gives the contacts of these pairs to the manager.");
  };
};

}  // namespace sinew
