// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/core/roles/collision_pipeline.hpp>
#include <sinew/scene/scope.hpp>
#include <sinew/scene/solvers.hpp>

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

/// f(scope) with that whose models the pipeline in the node of a scope collides: of one that lists them, the
/// root.
template <class S, class Root, class F>
void with_collision_scope(S const& scope, Root const& root, F&& f) {
  bool listed = false;
  with_first<role::CollisionPipeline>(scope, [&](auto const& pipeline) {
    if constexpr (ListsModels<std::decay_t<decltype(pipeline)>>) {
      listed = true;
      f(root);
    }
  });
  if (!listed) f(scope);
}

}  // namespace sinew
