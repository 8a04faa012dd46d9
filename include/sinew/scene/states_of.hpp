// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/core/role.hpp>
#include <sinew/core/roles/constraint_correction.hpp>
#include <sinew/core/roles/step_callback.hpp>

namespace sinew {

/// A component that acts on a state or on two, or looks at one: it is initialised on them, and follows where
/// they change.
template <class C>
concept ActsOnState = JoinsTwo<C> || HasRole<C, role::ForceField> || HasRole<C, role::Mass> ||
                      HasRole<C, role::ProjectiveConstraint> || HasRole<C, role::LagrangianConstraint> ||
                      HasRole<C, role::CollisionModel> || CorrectsState<C> || WatchesState<C>;

/// f(scope of the node in which a component is), or f(first, second) with those of the two ends of one that
/// joins two states.
template <class C, class S, class F>
void with_scopes_of(C const& c, S const& scope, F&& f) {
  if constexpr (JoinsTwo<C>)
    scope.withEnds(c, f);
  else
    f(scope);
}

/// f(state) on which a component acts, or f(first, second).
template <class C, class S, class F>
void with_states_of(C const& c, S const& scope, F&& f) {
  using D = typename C::DataTypes;
  with_scopes_of(c, scope, [&](auto const&... at) { f(at.template state<D>()...); });
}

/// f(first, second) with the degrees of freedom of these states in an assembled system; the same twice for
/// one.
template <class C, class S, class F>
void with_dofs_of(C const& c, S const& scope, F&& f) {
  using D = typename C::DataTypes;
  if constexpr (JoinsTwo<C>)
    scope.withEnds(c, [&](auto const& a, auto const& b) {
      a.template withDofs<D>(
          [&](auto const& first) { b.template withDofs<D>([&](auto const& second) { f(first, second); }); });
    });
  else
    scope.template withDofs<D>([&](auto const& dofs) { f(dofs, dofs); });
}

}  // namespace sinew
