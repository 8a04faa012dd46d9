// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/core/role.hpp>

namespace sinew {

// Which primitives of two collision models are near each other. The shortest:
//
//   /// All of them.
//   struct AllPrimitives {
//     using Role = role::NarrowPhase;
//     static constexpr std::string_view className = "AllPrimitives";
//     static constexpr auto fields() { return field_list(); }
//
//     template <class F>
//     void pairs(CollisionSurface const& a, CollisionSurface const& b, F&& f) {
//       for (int i = 0; i < int(a.elements.size()); ++i)
//         for (int j = &a == &b ? i + 1 : 0; j < int(b.elements.size()); ++j) f(i, j);
//     }
//   };

struct CollisionSurface;  // the primitives of a model, with a tree of their boxes: collision/

/// f(element of a, element of b) for each pair that may touch; where both are one model, each pair once.
template <class C>
concept HasPrimitivesNear = requires(C c, CollisionSurface const& a, CollisionSurface const& b,
                                     void (*f)(int, int)) { c.pairs(a, b, f); };

template <class C>
concept FindsPrimitivesNear = HasRole<C, role::NarrowPhase> && HasPrimitivesNear<C>;

// Hook, beside that of an intersection method which is shown all models (LooksAround):

/// It finds all contacts of some pairs of models itself, without an intersection method: of those that it
/// meets(a, b), by contacts(a, b, limit, f), which calls f(contact).
template <class C>
concept MeetsModels = requires(C c, CollisionSurface const& s) {
  { c.meets(s, s) } -> std::convertible_to<bool>;
};

template <>
struct Promise<role::NarrowPhase> : NoPromise {
  template <class C>
  static constexpr bool kept = FindsPrimitivesNear<C>;
  template <class C>
  struct Broken {
    static constexpr bool finds = HasPrimitivesNear<C>;  // compilers explain a concept at length
    static_assert(finds,
                  "Sinew: a narrow phase has no 'template <class F> void pairs(CollisionSurface const& a, "
                  "CollisionSurface const& b, F&& f)', which calls f(i, j) for elements i of a and j of b "
                  "that may touch.");
  };
};

}  // namespace sinew
