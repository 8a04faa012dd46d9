// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/scene/checks.hpp>

namespace sinew::checks {

/// Says one rule that is broken: the first in the scene, by component C (void: by the node) of this node. The
/// constructor of Simulation takes it as its last argument, so that the compiler comes here straight from the
/// user's line.
template <Rule R, class C, FixedString Node>
struct Wrong {
  static constexpr Rule rule = R;
#define SINEW_RULE(name, who, cause, remedy) \
  static_assert(R != Rule::name, "Sinew: " who " " cause "; " remedy ".");
#include <sinew/scene/rules.def>
};

// asserted as concepts, of which the compiler says what is missing
#define SINEW_PROMISE(Role, Concept, ...)                                                          \
  template <class C, FixedString Node>                                                             \
  requires HasRole<C, role::Role> __VA_ARGS__ struct Unfulfilled<C, Node> {                        \
    static_assert(Concept<C>, "Sinew: a component with role::" #Role                               \
                              " does not fulfil the concept " #Concept " of core/component.hpp."); \
  };
SINEW_PROMISE(State, State)
SINEW_PROMISE(ForceField, ForceField)
SINEW_PROMISE(Mass, Mass)
SINEW_PROMISE(ProjectiveConstraint, ProjectiveConstraint, &&(!JoinsTwo<C>))
SINEW_PROMISE(ProjectiveConstraint, InteractionConstraint, &&JoinsTwo<C>)
SINEW_PROMISE(InteractionForceField, InteractionForceField)
SINEW_PROMISE(Mapping, Mapping, &&(!HasParents<C>))
SINEW_PROMISE(Mapping, MultiMapping, &&HasParents<C>)
SINEW_PROMISE(CollisionModel, CollisionModel)
SINEW_PROMISE(OdeSolver, OdeSolver)
#undef SINEW_PROMISE

}  // namespace sinew::checks
