// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/scene/scope.hpp>

#include <type_traits>

namespace sinew {

/// f(model, its state, scope of its node, std::type_identity of their DataTypes) for each collision model at
/// and below a scope.
template <class S, class F>
void for_each_collision_model(S const& scope, F&& f) {
  traverse(scope, on<role::CollisionModel>([&](auto& model, auto const& at) {
             using D = typename std::decay_t<decltype(model)>::DataTypes;
             f(model, at.template state<D>(), at, std::type_identity<D>{});
           }));
}

}  // namespace sinew
