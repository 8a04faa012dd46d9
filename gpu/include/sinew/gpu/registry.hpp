// SPDX-License-Identifier: BSL-1.0
#pragma once

// Components over the DataTypes of a device, for scene files: template="CudaVec3f". A program has them with
// Registry<Standard, CudaStandard>; CudaScenes is less, and compiles in a fraction of the time.
#include <sinew/gpu/gpu.hpp>

#include <sinew/registry.hpp>

namespace sinew {

// points and rigid bodies
template <class D>
using CudaBodies = Registry<MechanicalObject<D>, UniformMass<D>, RestShapeSpringsForceField<D>,
                            FixedConstraint<D>, PartialFixedConstraint<D>>;
template <class D>
using CudaPoints = Registry<CudaBodies<D>, DiagonalMass<D>, PointSprings<D>, PlaneForceField<D>,
                            SphereForceField<D>, TriangleFEMForceField<D>, TetrahedronFEMForceField<D>,
                            HexahedronFEMForceField<D>, TetrahedronHyperelasticityFEMForceField<D>,
                            UnilateralLagrangianConstraint<D>, UnilateralLagrangianConstraint<D, Linked>,
                            SPHFluidForceField<D>, PointCollisionModel<D>, SphereCollisionModel<D>>;
template <class D>
using CudaRigids = Registry<CudaBodies<D>, AngularSpringForceField<D>>;
// to states of the device, and to models of the host
template <class In>
using CudaPointMappings =
    Registry<SpatialMappings<In, In>, SpatialMappings<In, Vec3d>, SpatialMappings<In, Vec3f>>;
template <class Rigid, class Point>
using CudaRigidMappings =
    Registry<RigidMapping<Rigid, Point>, RigidMapping<Rigid, Vec3d>, RigidMapping<Rigid, Vec3f>,
             IdentityMapping<Rigid, Rigid>, IdentityMapping<Rigid, Point>>;

/// What runs on a device, over its DataTypes.
struct CudaStandard
    : Registry<CudaPoints<CudaVec3f>, CudaPoints<CudaVec3d>, CudaRigids<CudaRigid3f>, CudaRigids<CudaRigid3d>,
               CudaPointMappings<CudaVec3f>, CudaPointMappings<CudaVec3d>,
               CudaRigidMappings<CudaRigid3f, CudaVec3f>, CudaRigidMappings<CudaRigid3d, CudaVec3d>,
               Fluid2D<CudaVec2f>, Fluid2D<CudaVec2d>, Fluid3D<CudaVec3f>, Fluid3D<CudaVec3d>> {};

/// And what stands around that in a scene: meshes, selections, solvers, those of constraints by multipliers,
/// collision models and obstacles of the host.
struct CudaScenes
    : Registry<Gravity, MeshTopology, RegularGridTopology, VisualModel, MeshGmshLoader, MeshOBJLoader,
               BoxROI<Vec3d>, BoxROI<Vec3f>, EulerExplicitSolver, EulerImplicitSolver, CGLinearSolver<>,
               CGLinearSolver<CompressedRowSparseMatrixMat3x3d>,
               CGLinearSolver<CompressedRowSparseMatrixMat3x3f>, ShewchukPCGLinearSolver<>,
               ShewchukPCGLinearSolver<CompressedRowSparseMatrixMat3x3d>, MultigridLinearSolver<>,
               DefaultPipeline, BruteForceBroadPhase, BVHNarrowPhase, MinProximityIntersection,
               DefaultContactManager, FreeMotionAnimationLoop, ConvexConstraintSolver,
               PointCollisionModel<Vec3d>, TriangleCollisionModel<Vec3d>, SphereCollisionModel<Vec3d>,
               MechanicalObject<Vec3d>, MechanicalObject<Vec3f>, Fluid2D<Vec2d>, Fluid3D<Vec3d>,
               ImmersedSolid<Vec3d>, CudaStandard> {};

}  // namespace sinew
