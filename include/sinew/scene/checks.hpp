// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/scene/scope.hpp>

#include <type_traits>

namespace sinew::checks {

/// What can be wrong in a typed scene, in the order of the sentences of scene/mistakes.hpp.
enum class Mistake {
  none,
  twoStates,
  twoMappings,
  twoMasses,
  twoSolvers,
  partOfPipeline,
  noState,
  otherDataTypes,
  stateAcrossSolvers,
  noTetrahedra,
  constraintOnMapped,
  constraintAcrossSolvers,
  noEnd,
  endWithoutState,
  endOfOtherDataTypes,
  noChild,
  noParent,
  mappingIn,
  mappingOut,
  noParentTetrahedra,
  linkedParents,
  noParentNode,
  parentComesLater,
  parentWithoutState,
  parentOfOtherDataTypes,
  parentsAcrossSolvers,
  noPipeline,
  noLinearSolver,
  notState,
  notForceField,
  notMass,
  notProjectiveConstraint,
  notInteractionConstraint,
  notInteractionForceField,
  notMapping,
  notMultiMapping,
  notCollisionModel,
  notOdeSolver
};

template <Mistake, class C, FixedString Node>
struct Wrong;
/// What stands where Wrong would, in a scene without a mistake.
struct Right {};

// What a typed scene must fulfil, on types alone. Each check returns the first mistake that it finds; nothing
// is asserted here (scene/mistakes.hpp says it), and Simulation leaves out what would only repeat the mistake
// in other words.

/// The nearest scope from S upwards that owns a state; NoScope where none does.
template <class S>
constexpr auto find_owner() {
  if constexpr (!S::hasState)
    return std::type_identity<NoScope>{};
  else if constexpr (S::ownsState)
    return std::type_identity<S>{};
  else
    return find_owner<typename S::Above>();
}
template <class S>
using Owner = typename decltype(find_owner<S>())::type;

template <class N, class R>
using FirstOf = std::decay_t<decltype(std::declval<N&>().template first<R>())>;

/// DataTypes of the state on which components of S act.
template <class S>
using DataTypesAt = typename FirstOf<typename Owner<S>::NodeType, role::State>::DataTypes;

template <class S>
constexpr bool has_linear_solver() {
  if constexpr (std::is_same_v<S, NoScope>)
    return false;
  else
    return S::NodeType::template count<role::LinearSolver> > 0 || has_linear_solver<typename S::Above>();
}

template <class S>
constexpr bool has_contact_manager() {
  if constexpr (std::is_same_v<S, NoScope>)
    return false;
  else
    return S::NodeType::template count<role::ContactManager> > 0 || has_contact_manager<typename S::Above>();
}

/// Tetrahedra are in reach of components of this scope that act on its points.
template <class S>
constexpr bool has_tetrahedra() {
  if constexpr (std::is_same_v<S, NoScope>) {
    return false;
  } else {
    using N = typename S::NodeType;
    constexpr bool topology = N::template count < role::Topology >> 0;
    if constexpr (topology) return requires {
        FirstOf<N, role::Topology>::hasTetrahedra;
      };
    else if constexpr (S::ownsState)
      return false;
    else
      return has_tetrahedra<typename S::Above>();
  }
}

template <class S>
constexpr auto find_solver();

template <class C, class S>
constexpr Mistake acts_on_state() {
  if constexpr (!S::hasState)
    return Mistake::noState;
  else if constexpr (!std::is_same_v<typename C::DataTypes, DataTypesAt<S>>)
    return Mistake::otherDataTypes;
  else if constexpr (!WatchesState<C> && !std::is_same_v<decltype(checks::find_solver<S>()),
                                                         decltype(checks::find_solver<Owner<S>>())>)
    return Mistake::stateAcrossSolvers;
  else if constexpr (requires { C::needsTetrahedra; })
    return has_tetrahedra<S>() ? Mistake::none : Mistake::noTetrahedra;
  else
    return Mistake::none;
}

/// The scope at a path below S; NoScope where there is none.
template <class S, FixedString Path>
constexpr auto find_path() {
  if constexpr (Path.view().empty()) {
    return std::type_identity<S>{};
  } else {
    constexpr int i = S::NodeType::childIndex(detail::first_name(Path.view()));
    if constexpr (i < 0)
      return std::type_identity<NoScope>{};
    else
      return find_path<typename ScopeOf<typename S::NodeType::template Child<std::size_t(i)>, S>::type,
                       detail::rest_of_path<Path>()>();
  }
}
template <class S, FixedString Path>
using AtPath = typename decltype(find_path<S, Path>())::type;

/// The scope whose ODE solver moves S: the topmost that has one; NoScope where none has.
template <class S>
constexpr auto find_solver() {
  if constexpr (std::is_same_v<S, NoScope>) {
    return std::type_identity<NoScope>{};
  } else {
    using Above = typename decltype(find_solver<typename S::Above>())::type;
    if constexpr (!std::is_same_v<Above, NoScope>)
      return std::type_identity<Above>{};
    else if constexpr ((S::NodeType::template count<role::OdeSolver>)-S::NodeType::solversBeside > 0)
      return std::type_identity<S>{};
    else
      return std::type_identity<NoScope>{};
  }
}
template <class S>
using Solver = typename decltype(find_solver<S>())::type;

/// The scope at a path from S that may begin with ".."; NoScope where there is none.
template <class S, FixedString Path>
constexpr auto find_reach() {
  if constexpr (std::is_same_v<S, NoScope>)
    return std::type_identity<NoScope>{};
  else if constexpr (detail::first_name(Path.view()) == "..")
    return find_reach<typename S::Above, detail::rest_of_path<Path>()>();
  else
    return find_path<S, Path>();
}
/// Whether that is before S in a traversal. `Branch`: the scope below S on the way there, S itself at first.
template <class S, FixedString Path, class Branch = S>
constexpr bool comes_before() {
  if constexpr (detail::first_name(Path.view()) == "..")
    return comes_before<typename S::Above, detail::rest_of_path<Path>(), S>();
  else if constexpr (std::is_same_v<Branch, S>)
    return false;
  else if constexpr (Path.view().empty())
    return true;
  else
    return S::NodeType::childIndex(detail::first_name(Path.view())) <
           S::NodeType::childIndex(Branch::NodeType::name.view());
}

template <class C, class S, FixedString Path>
constexpr Mistake mapping_parent() {
  using Parent = typename decltype(find_reach<S, Path>())::type;
  if constexpr (std::is_same_v<Parent, NoScope>)
    return Mistake::noParentNode;
  else if constexpr (!comes_before<S, Path>())
    return Mistake::parentComesLater;
  else if constexpr (!Parent::hasState)
    return Mistake::parentWithoutState;
  else if constexpr (!std::is_same_v<typename C::In, DataTypesAt<Parent>>)
    return Mistake::parentOfOtherDataTypes;
  else if constexpr (!S::isVisual && !std::is_same_v<Solver<S>, Solver<Parent>>)
    return Mistake::parentsAcrossSolvers;
  else
    return Mistake::none;
}
template <class C, class S, FixedString... Paths>
constexpr Mistake mapping_parents(Parents<Paths...>) {
  Mistake m = Mistake::none;
  (void)(((m = mapping_parent<C, S, Paths>()) == Mistake::none) && ...);
  return m;
}
template <class C, class S>
constexpr Mistake mapping_parents(LinkedParents) {
  return Mistake::linkedParents;
}

/// The Out of a mapping is that of the state, or visual model, in its node.
template <class C, class S>
constexpr bool mapping_out() {
  if constexpr (S::ownsState)
    return std::is_same_v<typename C::Out, DataTypesAt<S>>;
  else
    return std::is_same_v<typename C::Out, Vec3f>;
}

template <class C, class S>
constexpr Mistake mapping() {
  if constexpr (!S::ownsState && !S::isVisual) {
    return Mistake::noChild;
  } else if constexpr (HasParents<C>) {
    return mapping_out<C, S>() ? mapping_parents<C, S>(typename C::Parents{}) : Mistake::mappingOut;
  } else if constexpr (!S::Above::hasState) {
    return Mistake::noParent;
  } else if constexpr (!std::is_same_v<typename C::In, DataTypesAt<typename S::Above>>) {
    return Mistake::mappingIn;
  } else if constexpr (!mapping_out<C, S>()) {
    return Mistake::mappingOut;
  } else if constexpr (!S::isVisual && !std::is_same_v<Solver<S>, Solver<typename S::Above>>) {
    return Mistake::parentsAcrossSolvers;
  } else if constexpr (requires { C::needsParentTetrahedra; }) {
    return has_tetrahedra<Owner<typename S::Above>>() ? Mistake::none : Mistake::noParentTetrahedra;
  } else {
    return Mistake::none;
  }
}

template <class C, class End>
constexpr Mistake interaction_end() {
  if constexpr (std::is_same_v<End, NoScope>)
    return Mistake::noEnd;
  else if constexpr (!End::hasState)
    return Mistake::endWithoutState;
  else if constexpr (!std::is_same_v<typename C::DataTypes, DataTypesAt<End>>)
    return Mistake::endOfOtherDataTypes;
  else
    return Mistake::none;
}

template <class S, class End>
constexpr bool moved_by_another() {
  return !std::is_same_v<Solver<S>, NoScope> && !std::is_same_v<Solver<S>, Solver<Owner<End>>>;
}
template <class C, class S>
constexpr Mistake interaction() {
  using A = AtPath<S, C::Ends::first>;
  using B = AtPath<S, C::Ends::second>;
  constexpr auto first = interaction_end<C, A>(), second = interaction_end<C, B>();
  if constexpr (first != Mistake::none)
    return first;
  else if constexpr (second != Mistake::none)
    return second;
  else
    return moved_by_another<S, A>() || moved_by_another<S, B>() ? Mistake::stateAcrossSolvers : Mistake::none;
}

template <class C, class S>
constexpr Mistake interaction_constraint() {
  using A = AtPath<S, C::Ends::first>;
  using B = AtPath<S, C::Ends::second>;
  constexpr auto ends = interaction<C, S>();
  if constexpr (ends != Mistake::none)
    return ends;
  else if constexpr (Owner<A>::isMapped || Owner<B>::isMapped)
    return Mistake::constraintOnMapped;
  else if constexpr (!std::is_same_v<Solver<S>, Solver<A>> || !std::is_same_v<Solver<S>, Solver<B>>)
    return Mistake::constraintAcrossSolvers;
  else
    return Mistake::none;
}

template <class C, class S>
constexpr Mistake component() {
  using R = typename C::Role;
  if constexpr (std::is_same_v<R, role::State>) {
    return State<C> ? Mistake::none : Mistake::notState;
  } else if constexpr (std::is_same_v<R, role::ForceField>) {
    return ForceField<C> ? acts_on_state<C, S>() : Mistake::notForceField;
  } else if constexpr (WatchesState<C>) {
    return acts_on_state<C, S>();
  } else if constexpr (std::is_same_v<R, role::Mass>) {
    return Mass<C> ? acts_on_state<C, S>() : Mistake::notMass;
  } else if constexpr (std::is_same_v<R, role::ProjectiveConstraint> && JoinsTwo<C>) {
    return InteractionConstraint<C> ? interaction_constraint<C, S>() : Mistake::notInteractionConstraint;
  } else if constexpr (std::is_same_v<R, role::ProjectiveConstraint>) {
    if constexpr (!ProjectiveConstraint<C>)
      return Mistake::notProjectiveConstraint;
    else
      return Owner<S>::isMapped ? Mistake::constraintOnMapped : acts_on_state<C, S>();
  } else if constexpr (std::is_same_v<R, role::InteractionForceField>) {
    return InteractionForceField<C> ? interaction<C, S>() : Mistake::notInteractionForceField;
  } else if constexpr (std::is_same_v<R, role::Mapping>) {
    if constexpr (HasParents<C>)
      return MultiMapping<C> ? mapping<C, S>() : Mistake::notMultiMapping;
    else
      return Mapping<C> ? mapping<C, S>() : Mistake::notMapping;
  } else if constexpr (std::is_same_v<R, role::CollisionModel>) {
    if constexpr (!CollisionModel<C>)
      return Mistake::notCollisionModel;
    else
      return has_contact_manager<S>() ? acts_on_state<C, S>() : Mistake::noPipeline;
  } else if constexpr (std::is_same_v<R, role::OdeSolver>) {
    if constexpr (!OdeSolver<C>)
      return Mistake::notOdeSolver;
    else
      return !C::implicit || has_linear_solver<S>() ? Mistake::none : Mistake::noLinearSolver;
  } else {
    return Mistake::none;
  }
}

/// A node has one state, mapping, mass and solver at most; and one stage of collision detection brings all of
/// them, once.
template <class N>
constexpr Mistake one_of_each() {
  const auto stages = {N::template count<role::CollisionPipeline>,
                       N::template count<role::BroadPhase>,
                       N::template count<role::NarrowPhase>,
                       N::template count<role::Intersection>,
                       N::template count<role::ContactManager>};
  if (N::template count<role::State> + N::template count < role::VisualModel >> 1) return Mistake::twoStates;
  if (N::template count < role::Mapping >> 1) return Mistake::twoMappings;
  if (N::template count < role::Mass >> 1) return Mistake::twoMasses;
  if (N::template count<role::OdeSolver> - N::solversBeside > 1) return Mistake::twoSolvers;
  for (const int n : stages)
    if (n != *stages.begin() || n > 1) return Mistake::partOfPipeline;
  return Mistake::none;
}

/// The first mistake of the scene below a scope, as the type that says it.
template <class S>
constexpr auto scene();

template <class R>
inline constexpr bool right = std::is_same_v<R, std::type_identity<Right>>;

template <class First, class... Others>
constexpr auto first_wrong(First first, Others... others) {
  if constexpr (!right<First> || sizeof...(Others) == 0)
    return first;
  else
    return checks::first_wrong(others...);
}

template <Mistake M, class C, class S>
constexpr auto verdict() {
  if constexpr (M == Mistake::none)
    return std::type_identity<Right>{};
  else
    return std::type_identity<Wrong<M, C, S::NodeType::name>>{};
}

template <class S, class Name, class... Cs, class... Ns>
constexpr auto parts(std::type_identity<Node<Name, hana::tuple<Cs...>, hana::tuple<Ns...>>>) {
  if constexpr (((component<Cs, S>() == Mistake::none) && ...) &&
                (right<decltype(scene<typename ScopeOf<Ns, S>::type>())> && ...))
    return std::type_identity<Right>{};
  else
    return checks::first_wrong(verdict<component<Cs, S>(), Cs, S>()...,
                               scene<typename ScopeOf<Ns, S>::type>()...);
}

template <class S>
constexpr auto scene() {
  if constexpr (requires { S::provedAtInit; }) {
    return std::type_identity<Right>{};
  } else {
    constexpr auto node = one_of_each<typename S::NodeType>();
    if constexpr (node != Mistake::none)
      return verdict<node, void, S>();
    else
      return parts<S>(std::type_identity<typename S::NodeType>{});
  }
}

/// Right, or what is wrong in a scene.
template <class S>
using Verdict = typename decltype(scene<S>())::type;

}  // namespace sinew::checks
