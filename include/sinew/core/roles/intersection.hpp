// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/core/role.hpp>

#include <array>
#include <concepts>
#include <span>
#include <string_view>

namespace sinew {

// Where two primitives meet. The shortest:
//
//   /// Contacts at the closest points of what is nearer than a distance.
//   struct NearerThan {
//     using Role = role::Intersection;
//     static constexpr std::string_view className = "NearerThan";
//     static constexpr bool continuous = false;
//
//     double distance = 0.1;
//
//     static constexpr auto fields() {
//       return field_list(field("distance", &NearerThan::distance, "m", "between surfaces", range::positive));
//     }
//     double reach() const { return distance; }
//     template <Shape A, Shape B>
//     std::optional<Contact> intersect(PrimitivePair<A, B> const& pair) const {
//       auto contact = contact_at(pair, pair.cornersA(), pair.cornersB());
//       if (contact && contact->distance > distance) return std::nullopt;
//       if (contact) contact->limit = distance;
//       return contact;
//     }
//   };

enum class Shape;         // of primitives: hull, point, line, triangle, sphere (collision/shape.hpp)
struct Contact;           // collision/contact.hpp
struct CollisionSurface;  // collision/collision_surface.hpp
template <Shape A, Shape B, class SurfaceA = CollisionSurface, class SurfaceB = SurfaceA>
struct PrimitivePair;  // collision/proximity.hpp

/// What an intersection method sees of the motion of a step: nothing; that points go on as fast as they are;
/// or that they go where the free motion of the step takes them, which is known only behind that.
enum class StepMotion { none, inertia, freeMotion };
inline constexpr std::array<std::string_view, 3> enum_names(StepMotion) {
  return {"none", "inertia", "freeMotion"};
}
inline constexpr std::array<std::array<std::string_view, 2>, 6> enum_aliases(StepMotion) {
  return {{{"0", "none"},
           {"1", "inertia"},
           {"2", "freeMotion"},
           {"None", "none"},
           {"Inertia", "inertia"},
           {"FreeMotion", "freeMotion"}}};
}

/// Whether it looks at the motion of a step, so that boxes are around where primitives come from and go to.
template <class C>
concept SaysContinuous = requires {
  { C::continuous } -> std::convertible_to<bool>;
};
/// How far from each other two primitives may be that have a contact [m].
template <class C>
concept HasReach = requires(C const c) {
  { c.reach() } -> std::convertible_to<double>;
};
/// The contact of two primitives, as an std::optional. Of pairs of shapes that a scene does not have, nothing
/// is asked.
template <class C, Shape A, Shape B>
concept Intersects = requires(C const c, PrimitivePair<A, B> const& pair) {
  { *c.intersect(pair) } -> std::convertible_to<Contact const&>;
};
namespace detail {
// of points (1), lines (2) or triangles (3)
template <class C, int A, int B>
concept IntersectsSimplices = Intersects<C, Shape(A), Shape(B)> || Intersects<C, Shape(B), Shape(A)>;
}  // namespace detail
template <class C>
concept IntersectsSome = detail::IntersectsSimplices<C, 1, 1> || detail::IntersectsSimplices<C, 1, 2> ||
                         detail::IntersectsSimplices<C, 1, 3> || detail::IntersectsSimplices<C, 2, 2> ||
                         detail::IntersectsSimplices<C, 2, 3> || detail::IntersectsSimplices<C, 3, 3>;

template <class C>
concept IntersectionMethod =
    HasRole<C, role::Intersection> && SaysContinuous<C> && HasReach<C> && IntersectsSome<C>;

// Hooks:

/// One that is continuous says what it sees of the motion; else this is inertia.
template <class C>
concept ChoosesMotion = requires(C const c) {
  { c.motion() } -> std::same_as<StepMotion>;
};
/// It says which models it compares; else these are all that complement each other (has_pairs in
/// collision/proximity.hpp).
template <class C>
concept ChoosesModels = requires(C const c, CollisionSurface const& s) {
  { c.compares(s, s) } -> std::convertible_to<bool>;
};
/// It is shown all models of the scene, when they are initialised.
template <class C>
concept LooksAround = requires(C c, std::span<CollisionSurface* const> surfaces) { c.lookAround(surfaces); };
/// Its contacts with hulls, whose geometry is the library's (HullContacts), act below limit() [m].
template <class C>
concept MeetsHulls = requires(C const c) {
  { c.limit() } -> std::convertible_to<double>;
};

/// What a method sees of the motion of a step.
template <class C>
StepMotion motion_seen_by([[maybe_unused]] C const& method) {
  if constexpr (ChoosesMotion<C>)
    return method.motion();
  else
    return C::continuous ? StepMotion::inertia : StepMotion::none;
}

template <>
struct Promise<role::Intersection> : NoPromise {
  template <class C>
  static constexpr bool kept = IntersectionMethod<C>;
  template <class C>
  struct Broken {
    static constexpr bool intersects = IntersectsSome<C>;  // compilers explain a concept at length
    static_assert(SaysContinuous<C>,
                  "Sinew: an intersection method does not say whether it looks at the motion of a step; "
                  "write 'static constexpr bool continuous = false;'.");
    static_assert(HasReach<C>,
                  "Sinew: an intersection method has no 'double reach() const', the distance up to which "
                  "it has contacts [m].");
    static_assert(intersects,
                  "Sinew: an intersection method has no 'template <Shape A, Shape B> std::optional<Contact> "
                  "intersect(PrimitivePair<A, B> const& pair) const', the contact of two primitives, if they "
                  "have one.");
  };
};

}  // namespace sinew
