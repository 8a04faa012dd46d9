// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/core/role.hpp>

namespace sinew {

// Primitives over the points of a state that collide. Its `surface` (collision/collision_surface.hpp) does
// the rest: PointCollisionModel is the shortest.

template <class C>
concept SaysShape = requires { C::shape; };
template <class C>
concept HasSurface = requires(C c) { c.surface.elements; };

/// Primitives over the points of a state, at init; the rest is done with its `surface` (collision/).
template <class C>
concept CollisionModel = HasRole<C, role::CollisionModel> && HasInit<C> && SaysShape<C> && HasSurface<C>;

template <>
struct Promise<role::CollisionModel> : NoPromise {
  template <class C>
  static constexpr bool kept = CollisionModel<C>;
  template <class C>
  struct Broken {
    static_assert(HasDataTypes<C>,
                  "Sinew: a collision model has no DataTypes; write 'using DataTypes = D;' with those of the "
                  "state whose points collide, such as Vec3d.");
    static_assert(!HasDataTypes<C> || HasInit<C>,
                  "Sinew: a collision model has no 'void init(InitContext<DataTypes> const& context)'.");
    static_assert(
        SaysShape<C>,
        "Sinew: a collision model does not say what its primitives are; write 'static constexpr Shape "
        "shape = Shape::triangle;', or another shape.");
    static_assert(HasSurface<C>,
                  "Sinew: a collision model has no 'CollisionSurface surface{}', its primitives.");
  };
};

}  // namespace sinew
