// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/scene/scope.hpp>

#include <array>

namespace sinew::checks {

// What a typed scene must fulfil, on types alone. Each check asserts with one sentence and returns whether it
// holds, so that Simulation can leave out what would only repeat the mistake in other words.

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
    if constexpr (N::template count < role::Topology >> 0) return requires {
        FirstOf<N, role::Topology>::hasTetrahedra;
      };
    else if constexpr (S::ownsState)
      return false;
    else
      return has_tetrahedra<typename S::Above>();
  }
}

template <class C, class S>
constexpr bool acts_on_state() {
  static_assert(S::hasState,
                "Sinew: a force field, mass or constraint has no state to act on. Put it into a node with a "
                "MechanicalObject, "
                "or below one.");
  if constexpr (!S::hasState) {
    return false;
  } else {
    constexpr bool same = std::is_same_v<typename C::DataTypes, DataTypesAt<S>>;
    static_assert(same,
                  "Sinew: a component and the MechanicalObject it acts on have different DataTypes. Give "
                  "both the same, such "
                  "as Vec3d.");
    constexpr bool tetrahedra = !requires { C::needsTetrahedra; }
    || has_tetrahedra<S>();
    static_assert(tetrahedra,
                  "Sinew: a component needs tetrahedra, and its node has no topology with tetrahedra. Add a "
                  "TetrahedronTopology to the node.");
    return same && tetrahedra;
  }
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

/// The nearest scope from S upwards that has an ODE solver; NoScope where none has.
template <class S>
constexpr auto find_solver() {
  if constexpr (std::is_same_v<S, NoScope>)
    return std::type_identity<NoScope>{};
  else if constexpr (S::NodeType::template count<role::OdeSolver> > 0)
    return std::type_identity<S>{};
  else
    return find_solver<typename S::Above>();
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
constexpr bool mapping_parent() {
  using Parent = typename decltype(find_reach<S, Path>())::type;
  constexpr bool found = !std::is_same_v<Parent, NoScope>;
  static_assert(
      found,
      "Sinew: a parent of a mapping is no node. Its paths begin in the node of the mapping, go up by "
      "\"..\" and down by names (\"../left\"); look for a misspelt name.");
  if constexpr (!found) {
    return false;
  } else {
    constexpr bool before = comes_before<S, Path>();
    static_assert(before,
                  "Sinew: a mapping comes before one of its parents, which it follows. Put its node behind "
                  "those of its parents.");
    static_assert(Parent::hasState, "Sinew: a parent of a mapping is a node without a MechanicalObject.");
    if constexpr (!before || !Parent::hasState) {
      return false;
    } else {
      constexpr bool in = std::is_same_v<typename C::In, DataTypesAt<Parent>>;
      static_assert(in, "Sinew: the In of a mapping differs from the DataTypes of one of its parents.");
      constexpr bool together = S::isVisual || std::is_same_v<Solver<S>, Solver<Parent>>;
      static_assert(
          together,
          "Sinew: a mapping has parents under different ODE solvers. Put it and its parents below one "
          "solver.");
      return in && together;
    }
  }
}
template <class C, class S, FixedString... Paths>
constexpr bool mapping_parents(Parents<Paths...>) {
  return (mapping_parent<C, S, Paths>() && ...);
}
template <class C, class S>
constexpr bool mapping_parents(LinkedParents) {
  constexpr bool typed = !HasParents<C>;  // false
  static_assert(typed,
                "Sinew: a mapping in a typed scene names its parents in its type: Parents<\"../left\", "
                "\"../right\">.");
  return typed;
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
constexpr bool mapping_with_parents() {
  constexpr bool child = S::ownsState || S::isVisual;
  static_assert(child,
                "Sinew: a mapping has no child: its node has neither a MechanicalObject nor a VisualModel.");
  if constexpr (!child) {
    return false;
  } else {
    constexpr bool out = mapping_out<C, S>();
    static_assert(out,
                  "Sinew: the Out of a mapping differs from the DataTypes of its child, the MechanicalObject "
                  "in its node (Vec3f for a VisualModel).");
    return out && mapping_parents<C, S>(typename C::Parents{});
  }
}

template <class C, class S>
constexpr bool mapping() {
  constexpr bool child = S::ownsState || S::isVisual, parent = S::Above::hasState;
  static_assert(child,
                "Sinew: a mapping has no child: its node has neither a MechanicalObject nor a VisualModel.");
  static_assert(parent, "Sinew: a mapping has no parent: no node above it has a MechanicalObject.");
  if constexpr (!child || !parent) {
    return false;
  } else {
    constexpr bool in = std::is_same_v<typename C::In, DataTypesAt<typename S::Above>>;
    static_assert(in,
                  "Sinew: the In of a mapping differs from the DataTypes of its parent, the MechanicalObject "
                  "above it.");
    constexpr bool out = mapping_out<C, S>();
    static_assert(out,
                  "Sinew: the Out of a mapping differs from the DataTypes of its child, the MechanicalObject "
                  "in its node (Vec3f "
                  "for a VisualModel).");
    constexpr bool tetrahedra = !requires { C::needsParentTetrahedra; }
    || has_tetrahedra<Owner<typename S::Above>>();
    static_assert(tetrahedra,
                  "Sinew: a mapping needs tetrahedra, and its parent has no topology with tetrahedra.");
    return in && out && tetrahedra;
  }
}

template <class C, class End>
constexpr bool interaction_end() {
  constexpr bool found = !std::is_same_v<End, NoScope>;
  static_assert(found,
                "Sinew: an end of an interaction is no node. Its paths are names joined by '/', from the "
                "children of the node of "
                "the interaction on; look for a misspelt name.");
  if constexpr (!found) {
    return false;
  } else {
    static_assert(End::hasState, "Sinew: an end of an interaction is a node without a MechanicalObject.");
    if constexpr (!End::hasState) {
      return false;
    } else {
      constexpr bool same = std::is_same_v<typename C::DataTypes, DataTypesAt<End>>;
      static_assert(
          same,
          "Sinew: an interaction and the MechanicalObject at one of its ends have different DataTypes.");
      return same;
    }
  }
}

template <class C, class S>
constexpr bool interaction_constraint() {
  using A = AtPath<S, C::Ends::first>;
  using B = AtPath<S, C::Ends::second>;
  if constexpr (!interaction_end<C, A>() || !interaction_end<C, B>()) {
    return false;
  } else {
    constexpr bool independent = !Owner<A>::isMapped && !Owner<B>::isMapped;
    static_assert(independent,
                  "Sinew: a projective constraint acts on a mapped state, which follows its parent. "
                  "Constrain the parent instead.");
    constexpr bool together = std::is_same_v<Solver<S>, Solver<A>> && std::is_same_v<Solver<S>, Solver<B>>;
    static_assert(
        together,
        "Sinew: a constraint joins bodies under different ODE solvers. Put it and both bodies below "
        "one solver.");
    return independent && together;
  }
}

template <class C, class S>
constexpr bool component() {
  using R = typename C::Role;
  if constexpr (std::is_same_v<R, role::State>) {
    static_assert(
        State<C>,
        "Sinew: a component with role::State does not fulfil the concept State of core/component.hpp.");
    return State<C>;
  } else if constexpr (std::is_same_v<R, role::ForceField>) {
    static_assert(ForceField<C>,
                  "Sinew: a component with role::ForceField does not fulfil the concept ForceField of "
                  "core/component.hpp.");
    return ForceField<C> && acts_on_state<C, S>();
  } else if constexpr (WatchesState<C>) {
    return acts_on_state<C, S>();
  } else if constexpr (std::is_same_v<R, role::Mass>) {
    static_assert(
        Mass<C>,
        "Sinew: a component with role::Mass does not fulfil the concept Mass of core/component.hpp.");
    return Mass<C> && acts_on_state<C, S>();
  } else if constexpr (std::is_same_v<R, role::ProjectiveConstraint> && JoinsTwo<C>) {
    static_assert(InteractionConstraint<C>,
                  "Sinew: a component with role::ProjectiveConstraint does not fulfil that concept of "
                  "core/component.hpp.");
    return InteractionConstraint<C> && interaction_constraint<C, S>();
  } else if constexpr (std::is_same_v<R, role::ProjectiveConstraint>) {
    static_assert(ProjectiveConstraint<C>,
                  "Sinew: a component with role::ProjectiveConstraint does not fulfil that concept of "
                  "core/component.hpp.");
    constexpr bool independent = !Owner<S>::isMapped;
    static_assert(independent,
                  "Sinew: a projective constraint acts on a mapped state, which follows its parent. "
                  "Constrain the parent instead.");
    return ProjectiveConstraint<C> && independent && acts_on_state<C, S>();
  } else if constexpr (std::is_same_v<R, role::InteractionForceField>) {
    static_assert(InteractionForceField<C>,
                  "Sinew: a component with role::InteractionForceField does not fulfil that concept of "
                  "core/component.hpp.");
    return InteractionForceField<C> && interaction_end<C, AtPath<S, C::Ends::first>>() &&
           interaction_end<C, AtPath<S, C::Ends::second>>();
  } else if constexpr (std::is_same_v<R, role::Mapping> && HasParents<C>) {
    static_assert(MultiMapping<C>,
                  "Sinew: a component with role::Mapping and several parents does not fulfil the concept "
                  "MultiMapping of core/component.hpp.");
    return MultiMapping<C> && mapping_with_parents<C, S>();
  } else if constexpr (std::is_same_v<R, role::Mapping>) {
    static_assert(
        Mapping<C>,
        "Sinew: a component with role::Mapping does not fulfil the concept Mapping of core/component.hpp.");
    return Mapping<C> && mapping<C, S>();
  } else if constexpr (std::is_same_v<R, role::CollisionModel>) {
    static_assert(
        CollisionModel<C>,
        "Sinew: a component with role::CollisionModel does not fulfil that concept of core/component.hpp.");
    constexpr bool managed = has_contact_manager<S>();
    static_assert(
        managed,
        "Sinew: a collision model has no DefaultPipeline above it that would look for its contacts. Put one "
        "into the root, with a "
        "BruteForceBroadPhase, a BVHNarrowPhase, a MinProximityIntersection and a DefaultContactManager.");
    return CollisionModel<C> && managed && acts_on_state<C, S>();
  } else if constexpr (std::is_same_v<R, role::OdeSolver>) {
    static_assert(OdeSolver<C>,
                  "Sinew: a component with role::OdeSolver does not fulfil the concept OdeSolver of "
                  "core/component.hpp.");
    constexpr bool linear = !C::implicit || has_linear_solver<S>();
    static_assert(linear,
                  "Sinew: an implicit solver has no linear solver. Add one, such as CGLinearSolver<>, to its "
                  "node or above.");
    return OdeSolver<C> && linear;
  } else {
    return true;
  }
}

/// A node that has one stage of collision detection has all of them, once.
template <class N>
constexpr bool whole_pipeline() {
  constexpr std::array stages{N::template count<role::CollisionPipeline>,
                              N::template count<role::BroadPhase>,
                              N::template count<role::NarrowPhase>,
                              N::template count<role::Intersection>,
                              N::template count<role::ContactManager>};
  constexpr bool same = [stages] {
    for (const int n : stages)
      if (n != stages[0] || n > 1) return false;
    return true;
  }();
  static_assert(same,
                "Sinew: collision detection needs one of each stage in its node: a DefaultPipeline, a broad "
                "phase (BruteForceBroadPhase), a "
                "narrow phase (BVHNarrowPhase), an intersection method (MinProximityIntersection), a "
                "DefaultContactManager.");
  return same;
}

template <class S>
constexpr bool one_of_each() {
  using N = typename S::NodeType;
  constexpr bool state = N::template count<role::State> + N::template count<role::VisualModel> <= 1;
  constexpr bool mapping = N::template count<role::Mapping> <= 1, mass = N::template count<role::Mass> <= 1,
                 solver = N::template count<role::OdeSolver> - N::solversBeside <= 1;
  static_assert(state,
                "Sinew: a node has two states. Give each MechanicalObject or VisualModel a node of its own.");
  static_assert(mapping, "Sinew: a node has two mappings; its state can follow one parent.");
  static_assert(mass, "Sinew: a node has two masses. Keep one.");
  static_assert(solver, "Sinew: a node has two ODE solvers. Keep one.");
  return state && mapping && mass && solver && whole_pipeline<N>();
}

/// Proves the scene below a scope.
template <class S>
constexpr bool scene();

template <class S, FixedString Name, class... Cs, class... Ns>
constexpr bool parts(std::type_identity<Node<Name, hana::tuple<Cs...>, hana::tuple<Ns...>>>) {
  return (true && ... && component<Cs, S>()) && (true && ... && scene<typename ScopeOf<Ns, S>::type>());
}

template <class S>
constexpr bool scene() {
  if constexpr (requires { S::provedAtInit; })
    return true;
  else if constexpr (!one_of_each<S>())
    return false;
  else
    return parts<S>(std::type_identity<typename S::NodeType>{});
}

}  // namespace sinew::checks
