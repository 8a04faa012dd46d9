// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/scene/checks.hpp>

namespace sinew::checks {

/// Says one mistake: the first in the scene, made by component C (void: by the node) in this node. The
/// constructor of Simulation takes it as its last argument, so that the compiler comes here straight from the
/// user's line.
template <Mistake M, class C, FixedString Node>
struct Wrong {
  static_assert(M != Mistake::twoStates,
                "Sinew: a node has two states. Give each MechanicalObject or VisualModel a node of its own.");
  static_assert(M != Mistake::twoMappings,
                "Sinew: a node has two mappings; its state can follow one parent.");
  static_assert(M != Mistake::twoMasses, "Sinew: a node has two masses. Keep one.");
  static_assert(M != Mistake::twoSolvers, "Sinew: a node has two ODE solvers. Keep one.");
  static_assert(
      M != Mistake::partOfPipeline,
      "Sinew: collision detection needs one of each stage in its node: a DefaultPipeline, a broad phase "
      "(BruteForceBroadPhase), a narrow phase (BVHNarrowPhase), an intersection method "
      "(MinProximityIntersection), a DefaultContactManager.");
  static_assert(M != Mistake::noState,
                "Sinew: a force field, mass or constraint has no state to act on. Put it into a node with a "
                "MechanicalObject, or below one.");
  static_assert(
      M != Mistake::otherDataTypes,
      "Sinew: a component and the MechanicalObject it acts on have different DataTypes. Give both the "
      "same, such as Vec3d.");
  static_assert(
      M != Mistake::stateAcrossSolvers,
      "Sinew: a force field, mass, constraint or collision model below an ODE solver acts on a state above that "
      "solver, which does not move it. Give its node a MechanicalObject, or put the solver above the state.");
  static_assert(M != Mistake::noTetrahedra,
                "Sinew: a component needs tetrahedra, and its node has no topology with tetrahedra. Add a "
                "TetrahedronTopology to the node.");
  static_assert(
      M != Mistake::constraintOnMapped,
      "Sinew: a projective constraint acts on a mapped state, which follows its parent. Constrain the "
      "parent instead.");
  static_assert(
      M != Mistake::constraintAcrossSolvers,
      "Sinew: a constraint joins bodies under different ODE solvers. Put it and both bodies below one "
      "solver.");
  static_assert(
      M != Mistake::noEnd,
      "Sinew: an end of an interaction is no node. Its paths are names joined by '/', from the children "
      "of the node of the interaction on; look for a misspelt name.");
  static_assert(M != Mistake::endWithoutState,
                "Sinew: an end of an interaction is a node without a MechanicalObject.");
  static_assert(
      M != Mistake::endOfOtherDataTypes,
      "Sinew: an interaction and the MechanicalObject at one of its ends have different DataTypes.");
  static_assert(M != Mistake::noChild,
                "Sinew: a mapping has no child: its node has neither a MechanicalObject nor a VisualModel.");
  static_assert(M != Mistake::noParent,
                "Sinew: a mapping has no parent: no node above it has a MechanicalObject.");
  static_assert(
      M != Mistake::mappingIn,
      "Sinew: the In of a mapping differs from the DataTypes of its parent, the MechanicalObject above it.");
  static_assert(
      M != Mistake::mappingOut,
      "Sinew: the Out of a mapping differs from the DataTypes of its child, the MechanicalObject in its "
      "node (Vec3f for a VisualModel).");
  static_assert(M != Mistake::noParentTetrahedra,
                "Sinew: a mapping needs tetrahedra, and its parent has no topology with tetrahedra.");
  static_assert(M != Mistake::linkedParents,
                "Sinew: a mapping in a typed scene names its parents in its type: Parents<\"../left\", "
                "\"../right\">.");
  static_assert(
      M != Mistake::noParentNode,
      "Sinew: a parent of a mapping is no node. Its paths begin in the node of the mapping, go up by "
      "\"..\" and down by names (\"../left\"); look for a misspelt name.");
  static_assert(
      M != Mistake::parentComesLater,
      "Sinew: a mapping comes before one of its parents, which it follows. Put its node behind those of "
      "its parents.");
  static_assert(M != Mistake::parentWithoutState,
                "Sinew: a parent of a mapping is a node without a MechanicalObject.");
  static_assert(M != Mistake::parentOfOtherDataTypes,
                "Sinew: the In of a mapping differs from the DataTypes of one of its parents.");
  static_assert(
      M != Mistake::parentsAcrossSolvers,
      "Sinew: a mapping and a parent of it are under different ODE solvers. Put both below one solver.");
  static_assert(
      M != Mistake::noPipeline,
      "Sinew: a collision model has no DefaultPipeline above it that would look for its contacts. Put one "
      "into the root, with a BruteForceBroadPhase, a BVHNarrowPhase, a MinProximityIntersection and a "
      "DefaultContactManager.");
  static_assert(
      M != Mistake::noLinearSolver,
      "Sinew: an implicit solver has no linear solver. Add one, such as CGLinearSolver<>, to its node or "
      "above.");
};

// asserted as concepts, of which the compiler says what is missing
template <class C, FixedString Node>
struct Wrong<Mistake::notState, C, Node> {
  static_assert(
      State<C>,
      "Sinew: a component with role::State does not fulfil the concept State of core/component.hpp.");
};
template <class C, FixedString Node>
struct Wrong<Mistake::notForceField, C, Node> {
  static_assert(ForceField<C>,
                "Sinew: a component with role::ForceField does not fulfil the concept ForceField of "
                "core/component.hpp.");
};
template <class C, FixedString Node>
struct Wrong<Mistake::notMass, C, Node> {
  static_assert(Mass<C>,
                "Sinew: a component with role::Mass does not fulfil the concept Mass of core/component.hpp.");
};
template <class C, FixedString Node>
struct Wrong<Mistake::notProjectiveConstraint, C, Node> {
  static_assert(ProjectiveConstraint<C>,
                "Sinew: a component with role::ProjectiveConstraint does not fulfil that concept of "
                "core/component.hpp.");
};
template <class C, FixedString Node>
struct Wrong<Mistake::notInteractionConstraint, C, Node> {
  static_assert(InteractionConstraint<C>,
                "Sinew: a component with role::ProjectiveConstraint and two ends does not fulfil the concept "
                "InteractionConstraint of core/component.hpp.");
};
template <class C, FixedString Node>
struct Wrong<Mistake::notInteractionForceField, C, Node> {
  static_assert(InteractionForceField<C>,
                "Sinew: a component with role::InteractionForceField does not fulfil that concept of "
                "core/component.hpp.");
};
template <class C, FixedString Node>
struct Wrong<Mistake::notMapping, C, Node> {
  static_assert(
      Mapping<C>,
      "Sinew: a component with role::Mapping does not fulfil the concept Mapping of core/component.hpp.");
};
template <class C, FixedString Node>
struct Wrong<Mistake::notMultiMapping, C, Node> {
  static_assert(MultiMapping<C>,
                "Sinew: a component with role::Mapping and several parents does not fulfil the concept "
                "MultiMapping of core/component.hpp.");
};
template <class C, FixedString Node>
struct Wrong<Mistake::notCollisionModel, C, Node> {
  static_assert(
      CollisionModel<C>,
      "Sinew: a component with role::CollisionModel does not fulfil that concept of core/component.hpp.");
};
template <class C, FixedString Node>
struct Wrong<Mistake::notOdeSolver, C, Node> {
  static_assert(OdeSolver<C>,
                "Sinew: a component with role::OdeSolver does not fulfil the concept OdeSolver of "
                "core/component.hpp.");
};

}  // namespace sinew::checks
