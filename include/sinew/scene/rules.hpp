// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/core/component.hpp>

#include <array>
#include <string_view>

namespace sinew::rules {

// What a scene has to fulfil, whether it is typed or composed at run time. Each rule has a name, the
// components that may break it, what is wrong with such a component, and what to do. Typed scenes that break
// a rule do not compile (scene/mistakes.hpp); at run time a rule is an Error, or a warning (only_warns) where
// the component has no effect, as in SOFA.
// clang-format off
#define SINEW_RULES(RULE)                                                                                   \
  RULE(secondState, "a MechanicalObject or VisualModel", "is the second state of its node",                 \
       "keep one, or give it a node of its own")                                                            \
  RULE(secondMapping, "a mapping", "is the second mapping of its node",                                     \
       "keep one: its state can follow one parent, and several with a MultiMapping")                        \
  RULE(secondMass, "a mass", "is the second mass of its node",                                              \
       "keep one, or give it a node of its own")                                                            \
  RULE(secondSolver, "a solver", "is the second ODE solver of its node",                                    \
       "keep one")                                                                                          \
  RULE(secondTopology, "a topology", "is the second topology of its node",                                  \
       "keep one, or give it a node of its own")                                                            \
  RULE(secondStage, "a stage of collision detection",                                                       \
       "is the second of its stage of collision detection in its node",                                     \
       "keep one")                                                                                          \
  RULE(sameNames, "a node", "has two children of the same name",                                            \
       "rename one")                                                                                        \
  RULE(missingStage, "collision detection", "needs one of each stage in its node",                          \
       "give it a DefaultPipeline, a broad phase (BruteForceBroadPhase), a narrow phase "                   \
       "(BVHNarrowPhase), an intersection method (MinProximityIntersection) and a DefaultContactManager")   \
  RULE(loneStage, "a stage of collision detection",                                                         \
       "does nothing: its node has no DefaultPipeline, which would use it",                                 \
       "add one")                                                                                           \
  RULE(noState, "a force field, mass, constraint or collision model", "has no state to act on",             \
       "put it into a node with a MechanicalObject, or below one")                                          \
  RULE(otherDataTypes, "a component", "has other DataTypes than the state on which it acts",                \
       "give both the same, such as Vec3d")                                                                 \
  RULE(stateAcrossSolvers, "a force field, mass, constraint or collision model",                            \
       "acts on a state that the ODE solver above it does not move",                                        \
       "give its node a MechanicalObject, or put the solver above that state")                              \
  RULE(noTetrahedra, "a component", "needs tetrahedra, and its node has no topology with tetrahedra",       \
       "add a TetrahedronTopology to the node")                                                             \
  RULE(constraintOnMapped, "a projective constraint", "acts on a mapped state, which follows its parent",   \
       "constrain the parent instead")                                                                      \
  RULE(constraintAcrossSolvers, "a constraint", "joins bodies under different ODE solvers",                 \
       "put it and both bodies below one solver")                                                           \
  RULE(noEnd, "an interaction", "joins a node that is not there",                                           \
       "give the paths from its node to both ends, names joined by '/', and look for a misspelt name")      \
  RULE(endNotBelow, "an interaction", "joins a node that is not below its own",                             \
       "put it into a node above both ends")                                                                \
  RULE(endWithoutState, "an interaction", "joins a node that has no MechanicalObject",                      \
       "give it one, or join another node")                                                                 \
  RULE(endOfOtherDataTypes, "an interaction", "has other DataTypes than a state that it joins",             \
       "give all the same, such as Vec3d")                                                                  \
  RULE(endsByLinks, "an interaction", "in a typed scene names its ends in its type",                        \
       "write Between<\"left\", \"right\">")                                                                \
  RULE(noChild, "a mapping", "has no child: its node has neither a MechanicalObject nor a VisualModel",     \
       "add one")                                                                                           \
  RULE(noParent, "a mapping", "has no parent: no node above has a MechanicalObject",                        \
       "add one")                                                                                           \
  RULE(mappingIn, "a mapping",                                                                              \
       "maps from other DataTypes than those of its parent, the MechanicalObject above it",                 \
       "give its In those")                                                                                 \
  RULE(mappingOut, "a mapping",                                                                             \
       "maps to other DataTypes than those of its child, the MechanicalObject in its node (Vec3f for a "    \
       "VisualModel)",                                                                                      \
       "give its Out those")                                                                                \
  RULE(noParentTetrahedra, "a mapping", "needs tetrahedra, and its parent has no topology with tetrahedra", \
       "add a TetrahedronTopology to the node of the parent")                                               \
  RULE(parentsByLinks, "a mapping", "in a typed scene names its parents in its type",                       \
       "write Parents<\"../left\", \"../right\">")                                                          \
  RULE(noParents, "a mapping", "has no parents",                                                            \
       "name them: input=\"@../left @../right\"")                                                           \
  RULE(noParentNode, "a mapping", "follows a node that is not there",                                       \
       "give the paths from its node, up by \"..\" and down by names (\"../left\"), and look for a misspelt "\
       "name")                                                                                              \
  RULE(parentComesLater, "a mapping", "comes before a parent, which it follows",                            \
       "move its node behind that of the parent")                                                           \
  RULE(parentWithoutState, "a mapping", "follows a node that has no MechanicalObject",                      \
       "give it one, or follow another node")                                                               \
  RULE(parentOfOtherDataTypes, "a mapping", "maps from other DataTypes than those of a parent",             \
       "give its In those")                                                                                 \
  RULE(parentsAcrossSolvers, "a mapping", "is under another ODE solver than a parent",                      \
       "put both below one solver")                                                                         \
  RULE(noPipeline, "a collision model", "collides with nothing: there is no DefaultPipeline above it",      \
       "put one into the root, with a BruteForceBroadPhase, a BVHNarrowPhase, a MinProximityIntersection "  \
       "and a DefaultContactManager")                                                                       \
  RULE(solverBelowSolver, "a solver", "does nothing: an ODE solver above it moves all that is below",       \
       "remove one")                                                                                        \
  RULE(nothingToMove, "a solver", "does nothing: no state is below that it could move",                     \
       "remove it, or put it above one")                                                                    \
  RULE(besideNoSolver, "a solver", "changes what the ODE solver of its node has done, and there is none",   \
       "put it behind one")                                                                                 \
  RULE(noLinearSolver, "a solver", "is implicit and finds no linear solver",                                \
       "add one, such as CGLinearSolver, to its node or above")
// clang-format on

enum class Rule {
  none,
#define SINEW_RULE(name, who, cause, remedy) name,
  SINEW_RULES(SINEW_RULE)
#undef SINEW_RULE
};

struct Sentence {
  Rule rule;
  std::string_view name, cause, remedy;
};
inline constexpr std::array sentences{
#define SINEW_RULE(name, who, cause, remedy) Sentence{Rule::name, #name, cause, remedy},
    SINEW_RULES(SINEW_RULE)
#undef SINEW_RULE
};
constexpr Sentence const& sentence(Rule rule) { return sentences[std::size_t(rule) - 1]; }

constexpr bool only_warns(Rule rule) {
  return rule == Rule::noPipeline || rule == Rule::loneStage || rule == Rule::solverBelowSolver ||
         rule == Rule::nothingToMove;
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

/// What a component is, as far as rules ask.
struct Kind {
  bool joins = false;    // two states
  bool acts = false;     // on the state of its node
  bool watches = false;  // looks at it only
  bool constrains = false;
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
  kind.collides = HasRole<C, role::CollisionModel>;
  kind.acts = !JoinsTwo<C> && (HasRole<C, role::ForceField> || HasRole<C, role::Mass> || kind.constrains ||
                               kind.collides || kind.watches);
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
    return first_of(facts.ends(),
                    [&](Place const& end) { return joins(end, facts.solved(), kind.constrains); });
  } else if constexpr (kind.acts) {
    const Place own = facts.own();
    if (const Rule rule = acts_on(own, !kind.watches && facts.solved()); rule != Rule::none) return {rule};
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
