// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/scene/rules.hpp>
#include <sinew/scene/scope.hpp>

#include <type_traits>

namespace sinew::checks {

using rules::Place;
using rules::Rule;

/// A rule that component C (void: the node itself) of a node breaks (scene/mistakes.hpp).
template <Rule, class C, FixedString Node>
struct Wrong;
/// What stands where those would, in a scene without a mistake.
struct Right {};

// What rules.hpp asks of a typed scene, on types alone. Nothing is asserted here, and Simulation leaves out
// what would only repeat the mistake in other words.

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

/// A component of role R is in the node of S, or above.
template <class S, class R>
constexpr bool has_above() {
  if constexpr (std::is_same_v<S, NoScope>)
    return false;
  else
    return S::NodeType::template count<R> > 0 || has_above<typename S::Above, R>();
}

/// A pipeline of a node right below the root of S lists its models.
template <class N>
constexpr bool lists_models = false;
template <class Name, class... Cs, class Ns>
constexpr bool lists_models<Node<Name, hana::tuple<Cs...>, Ns>> = (ListsModels<Cs> || ...);
template <class Cs, class... Ns>
constexpr bool lists_below(NodeParts<Cs, hana::tuple<Ns...>> const*) {
  return (lists_models<Ns> || ...);
}
template <class S>
constexpr bool has_listing() {
  if constexpr (requires { typename S::Above::NodeType; })
    return has_listing<typename S::Above>();
  else
    return lists_below(static_cast<typename S::NodeType const*>(nullptr));
}

/// Tetrahedra are in reach of components of this scope that act on its points.
template <class S>
constexpr bool has_tetrahedra() {
  if constexpr (std::is_same_v<S, NoScope>) {
    return false;
  } else {
    using N = typename S::NodeType;
    constexpr bool topology = N::template count < role::Topology >> 0;
    if constexpr (topology)
      return requires { FirstOf<N, role::Topology>::mayHaveTetrahedra; };
    else if constexpr (S::ownsState)
      return false;
    else
      return has_tetrahedra<typename S::Above>();
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

/// A node has an ODE solver that integrates.
template <class N>
inline constexpr bool solves = (N::template count<role::OdeSolver>)-N::solversBeside > 0;

/// The scope whose ODE solver moves S: the topmost that has one; NoScope where none has.
template <class S>
constexpr auto find_solver() {
  if constexpr (std::is_same_v<S, NoScope>) {
    return std::type_identity<NoScope>{};
  } else {
    using Above = typename decltype(find_solver<typename S::Above>())::type;
    if constexpr (!std::is_same_v<Above, NoScope>)
      return std::type_identity<Above>{};
    else if constexpr (solves<typename S::NodeType>)
      return std::type_identity<S>{};
    else
      return std::type_identity<NoScope>{};
  }
}
template <class S>
using Solver = typename decltype(find_solver<S>())::type;

/// The nearest linear solver from S upwards keeps a matrix.
template <class S>
constexpr bool needs_pattern_above() {
  if constexpr (std::is_same_v<S, NoScope>)
    return false;
  else if constexpr (S::NodeType::template count < role::LinearSolver >> 0)
    return needs_pattern<FirstOf<typename S::NodeType, role::LinearSolver>>;
  else
    return needs_pattern_above<typename S::Above>();
}

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

/// There is a state in the node of S, or below, that no mapping moves; in a runtime node there may be.
template <class S>
constexpr bool integrates();
template <class S, class Name, class... Cs, class... Ns>
constexpr bool integrates_below(std::type_identity<Node<Name, hana::tuple<Cs...>, hana::tuple<Ns...>>>) {
  return (integrates<typename ScopeOf<Ns, S>::type>() || ...);
}
template <class S>
constexpr bool integrates() {
  if constexpr (requires { S::provedAtInit; })
    return true;
  else
    return (S::ownsState && !S::isMapped) ||
           checks::integrates_below<S>(std::type_identity<typename S::NodeType>{});
}

/// How P stands to a component over D in S, at a path from there or above it.
template <class S, class P, class D>
constexpr Place place() {
  Place found;
  if constexpr (std::is_same_v<P, NoScope>) {
    found.there = false;
  } else if constexpr (P::hasState) {
    found.state = true;
    found.sameDataTypes = std::is_same_v<D, DataTypesAt<P>>;
    found.mapped = Owner<P>::isMapped;
    found.sameSolver = std::is_same_v<Solver<S>, Solver<Owner<P>>>;
  }
  return found;
}
template <class S, class D, FixedString Path>
constexpr Place place_before() {
  using P = typename decltype(find_reach<S, Path>())::type;
  Place found = place<S, P, D>();
  if constexpr (!std::is_same_v<P, NoScope>) found.before = comes_before<S, Path>();
  return found;
}
template <class S, class C, FixedString... Paths>
constexpr std::array<Place, sizeof...(Paths)> places_before(Parents<Paths...>) {
  return []<std::size_t... K>(std::index_sequence<K...>) {
    return std::array<Place, sizeof...(Paths)>{place_before<S, InOfParent<C, ParentNumber<K>>, Paths>()...};
  }(std::index_sequence_for<Named<Paths>...>{});
}
template <FixedString... Paths>
constexpr std::size_t count_of(Parents<Paths...>) {
  return sizeof...(Paths);
}

/// What rules::broken asks about a component C of a typed node.
template <class C, class S>
struct Facts {
  using N = typename S::NodeType;
  static constexpr bool solved() { return !std::is_same_v<Solver<S>, NoScope>; }
  static constexpr bool solverAbove() { return !std::is_same_v<Solver<typename S::Above>, NoScope>; }
  static constexpr bool solverHere() { return solves<N> && !solverAbove(); }
  static constexpr bool integrates() { return checks::integrates<S>(); }
  static constexpr bool linearSolver() { return has_above<S, role::LinearSolver>(); }
  static constexpr bool inRoot() { return std::is_same_v<typename S::Above, NoScope>; }
  static constexpr bool constraintSolver() { return N::template holds<role::ConstraintSolver>; }
  static constexpr bool severalConstraintSolvers() { return count_below<N, role::ConstraintSolver>() > 1; }
  static constexpr bool loopInRoot() { return has_above<S, role::AnimationLoop>(); }
  static constexpr bool pipelineAbove() {
    return has_above<S, role::CollisionPipeline>() || has_listing<S>();
  }
  static constexpr bool pipelineHere() { return N::template count<role::CollisionPipeline> > 0; }
  static constexpr bool allStages() {
    return N::template count < role::BroadPhase >> 0 && N::template count < role::NarrowPhase >> 0 &&
           N::template count < role::Intersection >> 0 && N::template count < role::ContactManager >> 0;
  }
  static constexpr bool visual() { return S::isVisual; }
  static constexpr bool tetrahedra() { return has_tetrahedra<S>(); }
  static constexpr bool parentTetrahedra() {
    if constexpr (S::Above::hasState)
      return has_tetrahedra<Owner<typename S::Above>>();
    else
      return false;
  }
  static constexpr Place own() { return place<S, S, typename C::DataTypes>(); }
  static constexpr Place parent() { return place<S, typename S::Above, typename C::In>(); }
  static constexpr Place child() {
    if constexpr (S::ownsState)
      return {.state = true, .sameDataTypes = std::is_same_v<typename C::Out, DataTypesAt<S>>};
    else
      return {.sameDataTypes = std::is_same_v<typename C::Out, Vec3f>};
  }
  static constexpr Rule named() {
    if constexpr (HasParents<C>) {
      if constexpr (std::is_same_v<typename C::Parents, LinkedParents>)
        return Rule::parentsByLinks;
      else
        return HasTwoKindsOfParents<C> && count_of(typename C::Parents{}) != 2 ? Rule::notTwoParents
                                                                               : Rule::none;
    } else {
      return std::is_same_v<typename C::Ends, Linked> ? Rule::endsByLinks : Rule::none;
    }
  }
  static constexpr std::array<Place, 2> ends() {
    if constexpr (named() == Rule::none)
      return {place<S, AtPath<S, C::Ends::first>, typename C::DataTypes>(),
              place<S, AtPath<S, C::Ends::second>, typename C::DataTypes>()};
    else
      return {};
  }
  static constexpr auto parents() {
    if constexpr (named() == Rule::none)
      return places_before<S, C>(typename C::Parents{});
    else
      return std::array<Place, 0>{};
  }
};

template <class R>
inline constexpr bool right = std::is_same_v<R, std::type_identity<Right>>;

template <Rule R, class C, class S>
constexpr auto verdict() {
  if constexpr (R == Rule::none)
    return std::type_identity<Right>{};
  else
    return std::type_identity<Wrong<R, C, S::NodeType::name>>{};
}
/// Whether the ODE solver that moves S has a linear solver that assembles a matrix.
template <class S>
constexpr bool assembles() {
  if constexpr (std::is_same_v<Solver<S>, NoScope>) {
    return false;
  } else {
    using Ode = FirstOf<typename Solver<S>::NodeType, role::OdeSolver>;
    if constexpr (Ode::implicit || SolvesMass<Ode>)
      return needs_pattern_above<Solver<S>>();
    else
      return false;
  }
}

template <class C, class S>
constexpr auto component() {
  using Promised = Promise<typename C::Role>;
  constexpr Rule rule = rules::broken<rules::kind_of<C>()>(Facts<C, S>{}).rule;
  if constexpr (rule != Rule::none)
    return verdict<rule, C, S>();
  else if constexpr (assembles<S>() && !(HasRole<C, role::Mapping> && S::isVisual) &&
                     !Promised::template assembled<C>)
    return std::type_identity<typename Promised::template NotAssembled<C>>{};
  else
    return std::type_identity<Right>{};
}

/// What a node has too many of.
template <class N>
constexpr Rule too_many() {
  if (N::template count<role::State> + N::template count < role::VisualModel >> 1) return Rule::secondState;
  if (N::template count < role::Mapping >> 1) return Rule::secondMapping;
  if (N::template count < role::Mass >> 1) return Rule::secondMass;
  if (N::template count<role::OdeSolver> - N::solversBeside > 1) return Rule::secondSolver;
  if (N::template count < role::Topology >> 1) return Rule::secondTopology;
  for (const int n : {N::template count<role::CollisionPipeline>,
                      N::template count<role::BroadPhase>,
                      N::template count<role::NarrowPhase>,
                      N::template count<role::Intersection>,
                      N::template count<role::ContactManager>})
    if (n > 1) return Rule::secondStage;
  if (N::template count < role::AnimationLoop >> 1 || N::template count < role::ConstraintSolver >> 1 ||
      N::template count < role::StepDivision >> 1)
    return Rule::secondLoop;
  return N::childNamesDiffer() ? Rule::none : Rule::sameNames;
}

/// The first mistake of the scene below a scope, as the type that says it.
template <class S>
constexpr auto scene();

/// A rule is broken that says more than that a component has no effect.
template <class R>
inline constexpr bool grave = !right<R>;
template <Rule R, class C, FixedString Node>
inline constexpr bool grave<std::type_identity<Wrong<R, C, Node>>> = !rules::only_warns(R);

/// The first verdict that is wrong, a grave one if there is one; Right where none is.
template <class... Verdicts>
constexpr auto worst(Verdicts... verdicts) {
  if constexpr ((grave<Verdicts> || ...))
    return hana::at_c<detail::true_at<grave<Verdicts>...>[0]>(hana::tuple<Verdicts...>(verdicts...));
  else if constexpr (((!right<Verdicts>) || ...))
    return hana::at_c<detail::true_at<!right<Verdicts>...>[0]>(hana::tuple<Verdicts...>(verdicts...));
  else
    return std::type_identity<Right>{};
}

template <class S, class Name, class... Cs, class... Ns>
constexpr auto parts(std::type_identity<Node<Name, hana::tuple<Cs...>, hana::tuple<Ns...>>>) {
  return checks::worst(component<Cs, S>()..., scene<typename ScopeOf<Ns, S>::type>()...);
}

template <class S>
constexpr auto scene() {
  if constexpr (requires { S::provedAtInit; }) {
    return std::type_identity<typename S::NodeType::Verdict>{};
  } else {
    constexpr auto node = too_many<typename S::NodeType>();
    if constexpr (node != Rule::none)
      return verdict<node, void, S>();
    else
      return parts<S>(std::type_identity<typename S::NodeType>{});
  }
}

/// Whether all components of a node and below keep their promises. Runtime nodes have the verdict on their
/// registry (runtime/registry_checks.hpp).
template <class N>
inline constexpr bool all_kept = true;
template <class Name, class... Cs, class... Ns>
inline constexpr bool all_kept<Node<Name, hana::tuple<Cs...>, hana::tuple<Ns...>>> =
    (true && ... && keeps_promise<Cs>)&&(true && ... && all_kept<Ns>);
/// The first component of some nodes that does not.
template <class... Parts>
struct FirstBroken;
template <class First, class... Rest>
struct FirstBroken<First, Rest...> : FirstBroken<Rest...> {};
template <Component C, class... Rest>
requires(!keeps_promise<C>)
struct FirstBroken<C, Rest...> : std::type_identity<C> {};
template <class Name, class... Cs, class... Ns, class... Rest>
struct FirstBroken<Node<Name, hana::tuple<Cs...>, hana::tuple<Ns...>>, Rest...>
    : FirstBroken<Cs..., Ns..., Rest...> {};

/// What is no node, and so no scene.
template <class N>
struct NoScene;

template <class S>
constexpr auto proof() {
  if constexpr (!is_node<typename S::NodeType>)
    return std::type_identity<NoScene<typename S::NodeType>>{};
  else if constexpr (all_kept<typename S::NodeType>)
    return scene<S>();
  else
    return broken_promise<typename FirstBroken<typename S::NodeType>::type>();
}

/// Right, or what is wrong in a scene: first with a component, then with where it stands.
template <class S>
using Verdict = typename decltype(proof<S>())::type;

}  // namespace sinew::checks
