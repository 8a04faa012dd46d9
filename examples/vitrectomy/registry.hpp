// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/core/registry.hpp>
#include <sinew/engine/box_roi.hpp>
#include <sinew/engine/mesh_loader.hpp>

#include "scene.hpp"

namespace examples {

/// What vitrectomy.scn is made of: a program for one kind of scene carries no more than it needs, and
/// compiles in the time of that. All of Sinew and the two components here are Registry<Standard, ...>.
struct VitrectomyComponents
    : sinew::Registry<sinew::Gravity, sinew::DefaultPipeline, sinew::BruteForceBroadPhase,
                      sinew::BVHNarrowPhase, sinew::MinProximityIntersection, CuttingContacts,
                      sinew::EulerImplicitSolver, sinew::CGLinearSolver<>, sinew::MeshOBJLoader,
                      sinew::BoxROI<sinew::Vec3d>, sinew::MeshTopology, sinew::MechanicalObject<sinew::Vec3d>,
                      sinew::MechanicalObject<sinew::Rigid3d>, sinew::DiagonalMass<sinew::Vec3d>,
                      sinew::StiffSpringForceField<sinew::Vec3d>, CuttableSpringForceField<sinew::Vec3d>,
                      sinew::FixedConstraint<sinew::Vec3d>, sinew::SphereCollisionModel<sinew::Vec3d>,
                      sinew::LineCollisionModel<sinew::Vec3d>, sinew::ReadState<sinew::Rigid3d>,
                      sinew::VisualModel, sinew::SubsetMapping<sinew::Vec3d, sinew::Vec3f>,
                      sinew::RigidMapping<sinew::Rigid3d, sinew::Vec3f>,
                      sinew::RigidMapping<sinew::Rigid3d, sinew::Vec3d>> {};

}  // namespace examples
