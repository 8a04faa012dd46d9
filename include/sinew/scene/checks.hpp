// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/scene/scope.hpp>

namespace sinew::checks {

// What a scope of a typed scene says about itself, types only. `void` stands for "none".

template <class S>
struct state_of {
  using type = void;
};
template <class S>
requires(S::hasState) struct state_of<S> {
  template <class T>
  static auto find() {
    if constexpr (T::ownsState)
      return std::type_identity<std::decay_t<decltype(std::declval<typename T::NodeType&>().state())>>{};
    else
      return find<typename T::Above>();
  }
  using type = typename decltype(find<S>())::type;
};
template <class S>
using StateOf = typename state_of<S>::type;

template <class S>
constexpr bool has_linear_solver() {
  if constexpr (std::is_same_v<S, NoScope>)
    return false;
  else
    return S::NodeType::template count<role::LinearSolver> > 0 || has_linear_solver<typename S::Above>();
}

/// Tetrahedra are in reach of components of this scope that act on its points.
template <class S>
constexpr bool has_tetrahedra() {
  if constexpr (std::is_same_v<S, NoScope>) {
    return false;
  } else {
    using N = typename S::NodeType;
    if constexpr (N::template count < role::Topology >> 0) return requires {
        std::decay_t<decltype(std::declval<N&>().template first<role::Topology>())>::hasTetrahedra;
      };
    else if constexpr (S::ownsState)
      return false;
    else
      return has_tetrahedra<typename S::Above>();
  }
}
/// The scope that owns the nearest state, from S upwards.
template <class S>
constexpr auto owner() {
  if constexpr (S::ownsState)
    return std::type_identity<S>{};
  else
    return owner<typename S::Above>();
}

// Each check is a function of its own, so that the compiler's note names the component and the node.

template <class C, class S>
constexpr void acts_on_state() {
  static_assert(S::hasState,
                "Sinew: a force field, mass or constraint has no state to act on. Put it into a node with a "
                "MechanicalObject, or below one.");
  if constexpr (S::hasState)
    static_assert(std::is_same_v<typename C::DataTypes, typename StateOf<S>::DataTypes>,
                  "Sinew: a component and the MechanicalObject it acts on have different DataTypes. Give "
                  "both the same, "
                  "such as Vec3d.");
  if constexpr (requires { C::needsTetrahedra; })
    static_assert(has_tetrahedra<S>(),
                  "Sinew: a component needs tetrahedra, and its node has no topology with tetrahedra. Add a "
                  "TetrahedronTopology to the node.");
}

template <class C, class S>
constexpr void mapping() {
  using Above = typename S::Above;
  constexpr bool child = S::ownsState || S::isVisual;
  static_assert(child,
                "Sinew: a mapping has no child: its node has neither a MechanicalObject nor a VisualModel.");
  static_assert(Above::hasState, "Sinew: a mapping has no parent: no node above it has a MechanicalObject.");
  if constexpr (Above::hasState)
    static_assert(std::is_same_v<typename C::In, typename StateOf<Above>::DataTypes>,
                  "Sinew: the In of a mapping differs from the DataTypes of its parent, the MechanicalObject "
                  "above it.");
  if constexpr (S::ownsState)
    static_assert(
        std::is_same_v<typename C::Out, typename StateOf<S>::DataTypes>,
        "Sinew: the Out of a mapping differs from the DataTypes of the MechanicalObject in its node.");
  else if constexpr (S::isVisual)
    static_assert(std::is_same_v<typename C::Out, Vec3f>,
                  "Sinew: a mapping to a VisualModel has Out = Vec3f.");
  if constexpr (Above::hasState && requires { C::needsParentTetrahedra; }) {
    using Owner = typename decltype(owner<Above>())::type;
    static_assert(has_tetrahedra<Owner>(),
                  "Sinew: a mapping needs tetrahedra, and its parent has no topology with tetrahedra.");
  }
}

template <class S>
constexpr bool mapped_state() {
  return decltype(owner<S>())::type::isMapped;
}

template <class C, class S>
constexpr void component() {
  using R = typename C::Role;
  if constexpr (std::is_same_v<R, role::State>) {
    static_assert(
        State<C>,
        "Sinew: a component with role::State does not fulfil the concept State of core/component.hpp.");
  } else if constexpr (std::is_same_v<R, role::ForceField>) {
    acts_on_state<C, S>();
    static_assert(ForceField<C>,
                  "Sinew: a component with role::ForceField does not fulfil the concept ForceField of "
                  "core/component.hpp.");
  } else if constexpr (std::is_same_v<R, role::Mass>) {
    acts_on_state<C, S>();
    static_assert(
        Mass<C>,
        "Sinew: a component with role::Mass does not fulfil the concept Mass of core/component.hpp.");
  } else if constexpr (std::is_same_v<R, role::ProjectiveConstraint>) {
    acts_on_state<C, S>();
    static_assert(ProjectiveConstraint<C>,
                  "Sinew: a component with role::ProjectiveConstraint does not fulfil the concept of "
                  "core/component.hpp.");
    if constexpr (S::hasState)
      static_assert(!mapped_state<S>(),
                    "Sinew: a projective constraint acts on a mapped state, which follows its parent. "
                    "Constrain the parent instead.");
  } else if constexpr (std::is_same_v<R, role::Mapping>) {
    mapping<C, S>();
    static_assert(
        Mapping<C>,
        "Sinew: a component with role::Mapping does not fulfil the concept Mapping of core/component.hpp.");
  } else if constexpr (std::is_same_v<R, role::OdeSolver>) {
    static_assert(OdeSolver<C>,
                  "Sinew: a component with role::OdeSolver does not fulfil the concept OdeSolver of "
                  "core/component.hpp.");
    if constexpr (C::implicit)
      static_assert(has_linear_solver<S>(),
                    "Sinew: an implicit solver has no linear solver. Add one, such as "
                    "CGLinearSolver<>, to its node or above.");
  }
}

template <class C, class S>
constexpr void interaction(S const& scope) {
  static_assert(InteractionForceField<C>,
                "Sinew: a component with role::InteractionForceField does not fulfil the concept of "
                "core/component.hpp.");
  auto end = []<class E>(E const&) {
    static_assert(E::hasState, "Sinew: an end of an interaction is a node without a MechanicalObject.");
    if constexpr (E::hasState)
      static_assert(
          std::is_same_v<typename C::DataTypes, typename StateOf<E>::DataTypes>,
          "Sinew: an interaction and the MechanicalObject at one of its ends have different DataTypes.");
  };
  scope.template descend<C::Ends::first>(end);
  scope.template descend<C::Ends::second>(end);
}

/// Proves the scene below a scope: every static_assert of this file for every node.
template <class S>
void scene(S const& scope) {
  using N = typename S::NodeType;
  static_assert(N::template count<role::State> + N::template count<role::VisualModel> <= 1,
                "Sinew: a node has two states. Give each MechanicalObject or VisualModel a node of its own.");
  static_assert(N::template count<role::Mapping> <= 1,
                "Sinew: a node has two mappings; its state can follow one parent.");
  static_assert(N::template count<role::Mass> <= 1, "Sinew: a node has two masses. Keep one.");
  static_assert(N::template count<role::OdeSolver> <= 1, "Sinew: a node has two ODE solvers. Keep one.");
  scope.forEachComponent([&](auto& c) {
    using C = std::decay_t<decltype(c)>;
    component<C, S>();
    if constexpr (HasRole<C, role::InteractionForceField>) interaction<C>(scope);
  });
  scope.forEachChild([](auto const& child) { scene(child); });
}

}  // namespace sinew::checks
