// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/core/boundary_particles.hpp>
#include <sinew/core/data_types.hpp>
#include <sinew/core/fields.hpp>
#include <sinew/core/immersed_body.hpp>
#include <sinew/core/point_change.hpp>
#include <sinew/core/renumbering.hpp>
#include <sinew/core/role.hpp>
#include <sinew/core/roles/animation_loop.hpp>
#include <sinew/core/roles/behavior_model.hpp>
#include <sinew/core/roles/broad_phase.hpp>
#include <sinew/core/roles/carving.hpp>
#include <sinew/core/roles/collision_model.hpp>
#include <sinew/core/roles/collision_pipeline.hpp>
#include <sinew/core/roles/constraint_correction.hpp>
#include <sinew/core/roles/constraint_solver.hpp>
#include <sinew/core/roles/contact_manager.hpp>
#include <sinew/core/roles/context.hpp>
#include <sinew/core/roles/cutting.hpp>
#include <sinew/core/roles/data_link.hpp>
#include <sinew/core/roles/engine.hpp>
#include <sinew/core/roles/execution.hpp>
#include <sinew/core/roles/force_field.hpp>
#include <sinew/core/roles/interaction_force_field.hpp>
#include <sinew/core/roles/intersection.hpp>
#include <sinew/core/roles/lagrangian_constraint.hpp>
#include <sinew/core/roles/linear_solver.hpp>
#include <sinew/core/roles/mapping.hpp>
#include <sinew/core/roles/mass.hpp>
#include <sinew/core/roles/narrow_phase.hpp>
#include <sinew/core/roles/ode_solver.hpp>
#include <sinew/core/roles/projective_constraint.hpp>
#include <sinew/core/roles/state.hpp>
#include <sinew/core/roles/step_callback.hpp>
#include <sinew/core/roles/step_division.hpp>
#include <sinew/core/roles/topological_change.hpp>
#include <sinew/core/roles/topology.hpp>
#include <sinew/core/roles/visual_model.hpp>
#include <sinew/core/vec_id.hpp>

namespace sinew {

// What a component has, whatever its role. The shortest of each role is in its header.

template <class C>
concept NamesRole = requires { typename C::Role; };
template <class C>
concept HasKnownRole = NamesRole<C> && (detail::role_index<typename C::Role> >= 0);
template <class C>
concept HasClassName = requires {
  { C::className } -> std::convertible_to<std::string_view>;
};
template <class C>
concept HasConstantFields =
    HasFields<C> && requires { typename std::bool_constant<(static_cast<void>(C::fields()), true)>; };
namespace detail {
template <class C, class... Owner, class... T>
constexpr bool are_members(boost::hana::tuple<Field<Owner, T>...> const*) {
  return (std::is_base_of_v<Owner, C> && ...);
}
}  // namespace detail
template <class C>
concept ListsOwnFields =
    HasConstantFields<C> && detail::are_members<C>(static_cast<decltype(C::fields())*>(nullptr));

/// A component: a default-constructible class with a role, a name and fields.
template <class C>
concept Component = HasKnownRole<C> && HasClassName<C> && ListsOwnFields<C>;

// What it may have beside these.

/// A component that acts on its state before a step, whatever its role (`actsBeforeStep`): a recorder, a
/// replay, a controller, a haptic device. It has one of these, called with the state on which it acts before
/// any solver works; first all beforeStep of a scene, from the root to the leaves, then all beginStep.
///   beforeStep(ahead, state)   looks at the state as the last step has left it;
///   beginStep(ahead, state)    may move it, and returns whether it did: what is mapped from it then follows.
template <class C>
concept ActsBeforeStep = requires {
  requires C::actsBeforeStep;
  typename C::DataTypes;
};

/// One that says that it does not with its DataTypes (`actsBeforeStep = false`), and may have those
/// functions.
template <class C>
concept IdleBeforeStep = requires {
  C::actsBeforeStep;
  requires !C::actsBeforeStep;
};

/// A component, whatever its role, that a step leaves other than init did, in more than what the next step
/// computes anew: reset() makes it what it was, at time 0. It may return a bool: true says that elements are
/// there again whose places in a matrix have to be found.
template <class C>
concept Resettable = requires(C c) { c.reset(); };

/// A component that is given the masses of the points at init: those of its parent, where it is a mapping.
template <class C>
inline constexpr bool needs_masses = requires { C::needsMasses; };

/// A force field or a mass that may be over values on a body: its state has no topology of its own then, and
/// the elements are those of the body above (BodyView).
template <class C>
inline constexpr bool over_body = [] {
  if constexpr (requires { C::overBody; })
    return bool(C::overBody);
  else
    return false;
}();

/// A component that makes something of fields which may take other values while the scene runs
/// (Field::whileRunning): takeValues(where, points) does that, and checks them. `points` is how many points
/// the state has on which it acts. It is called between two steps, and allocates nothing for no more entries
/// than there were before. What it throws stops the step.
template <class C>
concept TakesValues =
    requires(C c, std::string_view where, std::size_t points) { c.takeValues(where, points); };

/// Whether a component does all that its role and its hooks promise.
template <class C>
concept ActsAsSaid =
    is_called(named::beginStep<C> || named::beforeStep<C>, ActsBeforeStep<C> || IdleBeforeStep<C>) &&
    (!ActsBeforeStep<C> || may_have<C>(named::beginStep<C> || named::beforeStep<C>)) &&
    is_called(named::reset<C>, Resettable<C>) && is_called(named::takeValues<C>, TakesValues<C>);
template <class C>
inline constexpr bool keeps_promise =
    spelled_right<C> && ActsAsSaid<C> && Promise<typename C::Role>::template kept<C>;

/// Says which hook nothing calls.
template <class C>
struct Uncalled {
  static_assert(
      ActsBeforeStep<C> || IdleBeforeStep<C> || !(named::beginStep<C> || named::beforeStep<C>),
      "Sinew: a component has a beginStep or beforeStep that nothing calls; add 'static constexpr bool "
      "actsBeforeStep = true;' and the DataTypes of the state on which it acts.");
  static_assert(
      !ActsBeforeStep<C> || may_have<C>(named::beginStep<C> || named::beforeStep<C>),
      "Sinew: a component says actsBeforeStep and has neither 'bool beginStep(StepAhead const& step, "
      "State& state)' nor 'void beforeStep(StepAhead const& step, State const& state)'.");
  static_assert(
      is_called(named::reset<C>, Resettable<C>),
      "Sinew: a component has a reset that nothing calls; write 'void reset()', or 'bool reset()'.");
  static_assert(is_called(named::takeValues<C>, TakesValues<C>),
                "Sinew: a component has a takeValues that nothing calls; write 'void "
                "takeValues(std::string_view where, std::size_t points)'.");
};

/// The type that says in a sentence what is wrong with a component that does not keep its promise.
template <class C>
constexpr auto broken_promise() {
  if constexpr (!spelled_right<C>)
    return std::type_identity<Misspelt<C>>{};
  else if constexpr (!Promise<typename C::Role>::template kept<C>)
    return std::type_identity<typename Promise<typename C::Role>::template Broken<C>>{};
  else
    return std::type_identity<Uncalled<C>>{};
}

}  // namespace sinew
