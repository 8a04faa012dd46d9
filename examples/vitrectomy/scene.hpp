// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/collision/brute_force_broad_phase.hpp>
#include <sinew/collision/bvh_narrow_phase.hpp>
#include <sinew/collision/contact_manager.hpp>
#include <sinew/collision/default_pipeline.hpp>
#include <sinew/collision/line_collision_model.hpp>
#include <sinew/collision/min_proximity_intersection.hpp>
#include <sinew/collision/sphere_collision_model.hpp>
#include <sinew/constraint/fixed_constraint.hpp>
#include <sinew/context/gravity.hpp>
#include <sinew/control/read_state.hpp>
#include <sinew/mapping/rigid_mapping.hpp>
#include <sinew/mapping/subset_mapping.hpp>
#include <sinew/mass/diagonal_mass.hpp>
#include <sinew/scene/simulation.hpp>
#include <sinew/solver/cg_linear_solver.hpp>
#include <sinew/solver/euler_implicit.hpp>
#include <sinew/state/mechanical_object.hpp>
#include <sinew/topology/mesh_topology.hpp>
#include <sinew/visual/visual_model.hpp>

#include "components.hpp"
#include "eye.hpp"

namespace examples {

/// The stages' last one, which knows how to cut.
using CuttingContacts = sinew::ContactManager<sinew::PenalityContactForceField, SpringRemovalContact>;

/// The scene of figure 3 of Faure et al. (2007). D: the DataTypes of the membranes.
template <class D = sinew::Vec3d>
auto vitrectomy_scene(Eye const& eye) {
  using namespace sinew;
  return Simulation{node<"root">(
      Gravity{{0, 0, 0}},
      DefaultPipeline{},
      BruteForceBroadPhase{},
      BVHNarrowPhase{},
      MinProximityIntersection{.alarmDistance = eye.contactDistance, .contactDistance = eye.contactDistance},
      CuttingContacts{},
      node<"eye">(EulerImplicitSolver{.rayleighStiffness = 0.01, .rayleighMass = 10},
                  CGLinearSolver<>{.iterations = 25, .tolerance = 0},
                  MeshTopology{.quads = eye.quads},
                  MechanicalObject<D>{.position = eye.position},
                  DiagonalMass<D>{.massDensity = eye.density},
                  StiffSpringForceField<D>{.springs = eye.springs},
                  CuttableSpringForceField<D>{.springs = eye.cuttable},
                  FixedConstraint<D>{.indices = eye.fixed},
                  SphereCollisionModel<D>{.radius = eye.sphereRadius},
                  node<"retina">(VisualModel{eye.retina}, SubsetMapping<D, Vec3f>{}),
                  node<"scar">(VisualModel{eye.scar}, SubsetMapping<D, Vec3f>{})),
      node<"tool">(MechanicalObject<Rigid3d>{.position = {eye.places[0]}},
                   ReadState<Rigid3d>{.keyTimes = eye.times, .keyPositions = eye.places},
                   node<"handle">(VisualModel{eye.handle}, RigidMapping<Rigid3d, Vec3f>{}),
                   node<"tip">(VisualModel{eye.tip}, RigidMapping<Rigid3d, Vec3f>{}),
                   node<"blade">(MeshTopology{.position = eye.blade.positions, .edges = eye.blade.edges},
                                 MechanicalObject<Vec3d>{},
                                 LineCollisionModel<Vec3d>{.contactResponse = "SpringRemovalContact"},
                                 RigidMapping<Rigid3d, Vec3d>{})))};
}

}  // namespace examples
