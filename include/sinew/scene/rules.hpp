// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/core/component.hpp>
#include <sinew/scene/states_of.hpp>

#include <array>
#include <string_view>

namespace sinew::rules {

/// The rules that a scene has to fulfil (scene/rules.def). Typed scenes that break a rule do not compile
/// (scene/mistakes.hpp); at run time a rule that is broken is an Error, or a warning (only_warns) where the
/// component has no effect, as in SOFA.
enum class Rule {
  none,
#define SINEW_RULE(name, who, cause, remedy) name,
#include <sinew/scene/rules.def>
};

struct Sentence {
  Rule rule;
  std::string_view name, cause, remedy;
};
inline constexpr std::array sentences{
#define SINEW_RULE(name, who, cause, remedy) Sentence{Rule::name, #name, cause, remedy},
#include <sinew/scene/rules.def>
};
constexpr Sentence const& sentence(Rule rule) { return sentences[std::size_t(rule) - 1]; }

constexpr bool only_warns(Rule rule) {
  return rule == Rule::noPipeline || rule == Rule::loneStage || rule == Rule::solverBelowSolver ||
         rule == Rule::nothingToMove || rule == Rule::severalConstraintSolvers;
}

/// A node with which a component has to do: its own, or one that it names. What cannot be asked of a node,
/// such as the DataTypes of a state that is not there, is false.
struct Place {
  bool there = true;           // there is such a node
  bool state = false;          // it has a state, or one above
  bool sameDataTypes = false;  // that is over the DataTypes of the component
  bool mapped = false;         // that follows a parent
  bool sameSolver = true;  // the ODE solver that moves it is that of the component's node, or neither has one
  bool below = true;       // it is below the component's node
  bool before = true;      // traversals come there before they come to the component
};

/// The rule that a component breaks, and for which of its ends or parents.
struct Broken {
  Rule rule = Rule::none;
  std::size_t which = 0;
};

constexpr Rule acts_on(Place const& own, bool solved) {
  if (!own.state) return Rule::noState;
  if (!own.sameDataTypes) return Rule::otherDataTypes;
  return solved && !own.sameSolver ? Rule::stateAcrossSolvers : Rule::none;
}
constexpr Rule joins(Place const& end, bool solved, bool constrains) {
  if (!end.there) return Rule::noEnd;
  if (!end.below) return Rule::endNotBelow;
  if (!end.state) return Rule::endWithoutState;
  if (!end.sameDataTypes) return Rule::endOfOtherDataTypes;
  if (solved && !end.sameSolver) return Rule::stateAcrossSolvers;
  if (constrains && end.mapped) return Rule::constraintOnMapped;
  return constrains && !end.sameSolver ? Rule::constraintAcrossSolvers : Rule::none;
}
constexpr Rule joins_by_multipliers(Place const& end) {
  if (!end.there) return Rule::noEnd;
  if (!end.state) return Rule::endWithoutState;
  return end.sameDataTypes ? Rule::none : Rule::endOfOtherDataTypes;
}
constexpr Rule follows(Place const& parent, bool mechanical) {
  if (!parent.state) return Rule::noParent;
  if (!parent.sameDataTypes) return Rule::mappingIn;
  return mechanical && !parent.sameSolver ? Rule::parentsAcrossSolvers : Rule::none;
}
constexpr Rule follows_named(Place const& parent, bool mechanical) {
  if (!parent.there) return Rule::noParentNode;
  if (!parent.before) return Rule::parentComesLater;
  if (!parent.state) return Rule::parentWithoutState;
  if (!parent.sameDataTypes) return Rule::parentOfOtherDataTypes;
  return mechanical && !parent.sameSolver ? Rule::parentsAcrossSolvers : Rule::none;
}

/// The properties of a component that rules ask for.
struct Kind {
  bool joins = false;    // two states
  bool acts = false;     // on the state of its node
  bool watches = false;  // looks at it only
  bool constrains = false;
  bool byMultipliers = false;          // a constraint
  bool loop = false, divides = false;  // an animation loop; divides steps
  bool collides = false;
  bool maps = false, severalParents = false;
  bool stage = false, pipeline = false;  // of collision detection; composes its stages
  bool solves = false, beside = false, implicit = false;
  bool needsTetrahedra = false, needsParentTetrahedra = false;
};
template <class C>
constexpr Kind kind_of() {
  Kind kind;
  kind.joins = JoinsTwo<C>;
  kind.watches = WatchesState<C>;
  kind.constrains = HasRole<C, role::ProjectiveConstraint>;
  kind.byMultipliers = HasRole<C, role::LagrangianConstraint>;
  kind.loop = HasRole<C, role::AnimationLoop>;
  kind.divides = HasRole<C, role::StepDivision>;
  kind.collides = HasRole<C, role::CollisionModel>;
  kind.acts = ActsOnState<C> && !JoinsTwo<C>;
  kind.maps = HasRole<C, role::Mapping>;
  kind.severalParents = HasParents<C>;
  kind.stage = HasRole<C, role::BroadPhase> || HasRole<C, role::NarrowPhase> ||
               HasRole<C, role::Intersection> || HasRole<C, role::ContactManager>;
  kind.pipeline = HasRole<C, role::CollisionPipeline>;
  if constexpr (HasRole<C, role::OdeSolver>) {
    kind.solves = true;
    kind.beside = stands_beside<C>;
    kind.implicit = C::implicit;
  }
  kind.needsTetrahedra = requires { C::needsTetrahedra; };
  kind.needsParentTetrahedra = requires { C::needsParentTetrahedra; };
  return kind;
}

/// The first rule that a component breaks. `facts`, of either tree, knows what is around it:
///   own()                  the place of the state on which it acts
///   ends(), parents()      the places that it names, a range; parent(): the place of the parent above
///   named()                Rule::none, or what is wrong with how it names them
///   child()                its node, as the child of a mapping (state: its own; sameDataTypes: as Out)
///   visual()               its node has a visual model
///   solved(), solverAbove(), solverHere()   an ODE solver moves its node, from above, from its own
///   integrates()           there is a state here or below that no mapping moves
///   inRoot(), loopInRoot()   its node is the root; the root has an animation loop
///   constraintSolver(), severalConstraintSolvers()   there is one, are several, here or below
///   linearSolver(), pipelineAbove(), pipelineHere(), allStages(), tetrahedra(), parentTetrahedra()
///                          they are in reach
template <Kind kind, class Facts>
constexpr Broken broken(Facts const& facts) {
  [[maybe_unused]] auto first_of = [](auto const& places, auto rule_of) {
    std::size_t which = 0;
    for (Place const& place : places) {
      if (const Rule rule = rule_of(place); rule != Rule::none) return Broken{rule, which};
      ++which;
    }
    return Broken{};
  };
  if constexpr (kind.joins) {
    if (const Rule rule = facts.named(); rule != Rule::none) return {rule};
    if (kind.byMultipliers && !facts.loopInRoot()) return {Rule::noLoop};
    return first_of(facts.ends(), [&](Place const& end) {
      return kind.byMultipliers ? joins_by_multipliers(end) : joins(end, facts.solved(), kind.constrains);
    });
  } else if constexpr (kind.acts) {
    const Place own = facts.own();
    if (kind.byMultipliers && !facts.loopInRoot()) return {Rule::noLoop};
    const bool ofOneSolver = !kind.watches && !kind.byMultipliers;
    if (const Rule rule = acts_on(own, ofOneSolver && facts.solved()); rule != Rule::none) return {rule};
    if (kind.constrains && own.mapped) return {Rule::constraintOnMapped};
    if (kind.needsTetrahedra && !facts.tetrahedra()) return {Rule::noTetrahedra};
    if (kind.collides && !facts.pipelineAbove()) return {Rule::noPipeline};
  } else if constexpr (kind.maps) {
    const Place child = facts.child();
    if (!child.state && !facts.visual()) return {Rule::noChild};
    if (!child.sameDataTypes) return {Rule::mappingOut};
    if constexpr (kind.severalParents) {
      if (const Rule rule = facts.named(); rule != Rule::none) return {rule};
      return first_of(facts.parents(),
                      [&](Place const& parent) { return follows_named(parent, child.state); });
    } else {
      if (const Rule rule = follows(facts.parent(), child.state); rule != Rule::none) return {rule};
      if (kind.needsParentTetrahedra && !facts.parentTetrahedra()) return {Rule::noParentTetrahedra};
    }
  } else if constexpr (kind.loop) {
    if (!facts.inRoot()) return {Rule::loopNotInRoot};
    if (!facts.constraintSolver()) return {Rule::noConstraintSolver};
    if (facts.severalConstraintSolvers()) return {Rule::severalConstraintSolvers};
  } else if constexpr (kind.divides) {
    if (!facts.inRoot()) return {Rule::loopNotInRoot};
  } else if constexpr (kind.stage) {
    if (!facts.pipelineHere()) return {Rule::loneStage};
  } else if constexpr (kind.pipeline) {
    if (!facts.allStages()) return {Rule::missingStage};
  } else if constexpr (kind.solves) {
    if (kind.beside && !facts.solverHere()) return {Rule::besideNoSolver};
    if (!kind.beside && facts.solverAbove()) return {Rule::solverBelowSolver};
    if (!kind.beside && !facts.integrates()) return {Rule::nothingToMove};
    if (kind.implicit && !facts.linearSolver()) return {Rule::noLinearSolver};
  }
  return {};
}

}  // namespace sinew::rules
