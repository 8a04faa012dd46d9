// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/core/role.hpp>

#include <span>

namespace sinew {

// Which collision models are near each other. The shortest:
//
//   /// All of them.
//   struct AllModels {
//     using Role = role::BroadPhase;
//     static constexpr std::string_view className = "AllModels";
//     static constexpr auto fields() { return field_list(); }
//
//     template <class F>
//     void pairs(std::span<CollisionSurface* const> models, F&& f) {
//       for (int i = 0; i < int(models.size()); ++i)
//         for (int j = i; j < int(models.size()); ++j) f(i, j);
//     }
//   };

struct CollisionSurface;  // the primitives of a model, with their box: collision/collision_surface.hpp

/// f(i, j), i <= j, for each pair of models that may touch, and for a model with itself; each time in the
/// same order.
template <class C>
concept HasModelsNear =
    requires(C c, std::span<CollisionSurface* const> models, void (*f)(int, int)) { c.pairs(models, f); };

template <class C>
concept FindsModelsNear = HasRole<C, role::BroadPhase> && HasModelsNear<C>;

template <>
struct Promise<role::BroadPhase> : NoPromise {
  template <class C>
  static constexpr bool kept = FindsModelsNear<C>;
  template <class C>
  struct Broken {
    static constexpr bool finds = HasModelsNear<C>;  // compilers explain a concept at length
    static_assert(finds,
                  "Sinew: a broad phase has no 'template <class F> void "
                  "pairs(std::span<CollisionSurface* const> models, F&& f)', which calls f(i, j), i <= j, "
                  "for models that may touch.");
  };
};

}  // namespace sinew
