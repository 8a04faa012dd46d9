// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/core/registry.hpp>
#include <sinew/engine/gid_mesh_loader.hpp>
#include <sinew/engine/mesh_off_loader.hpp>
#include <sinew/engine/mesh_ply_loader.hpp>
#include <sinew/engine/mesh_trian_loader.hpp>
#include <sinew/engine/mesh_vtk_loader.hpp>
#include <sinew/fluid/fluid2d.hpp>
#include <sinew/fluid/fluid3d.hpp>
#include <sinew/lagrangian.hpp>
#include <sinew/sinew.hpp>
#include <sinew/solver/dfsph.hpp>

// a program that links libccd may have hulls in scene files; CMake's sinew::standard says so, where it has
// them
#ifdef SINEW_CCD
#include <sinew/collision/convex_collision_model.hpp>
#include <sinew/collision/obb_collision_model.hpp>
#include <sinew/collision/rigid_capsule_collision_model.hpp>
#endif

namespace sinew {

/// Components over one DataTypes of points, of rigids, and over none.
template <class D>
using PointSprings = Registry<StiffSpringForceField<D>, StiffSpringForceField<D, Linked>,
                              MeshSpringForceField<D>, RegularGridSpringForceField<D>>;
template <class D>
using RigidLoads =
    Registry<ConstantForceField<D>, LinearForceField<D>, RestShapeSpringsForceField<D>, PlaneForceField<D>,
             UniformVelocityDampingForceField<D>, DiagonalVelocityDampingForceField<D>, VirtualCoupling<D>>;
template <class D>
using PointLoads = Registry<RigidLoads<D>, SphereForceField<D>>;
template <class D>
using SpatialLoads = Registry<ConicalForceField<D>, TaitSurfacePressureForceField<D>, EllipsoidForceField<D>,
                              InteractionEllipsoidForceField<D>, TorsionForceField<D>>;
template <class D>
using Particles = Registry<ParticleSource<D>, ParticleSink<D>>;
template <class D>
using Fluids = Registry<SPHFluidForceField<D>, FluidBoundary<D>, ImmersedSolid<D>,
                        ParticlesRepulsionForceField<D>, Particles<D>>;
template <class D>
using ElementForces =
    Registry<TetrahedronFEMForceField<D>, HexahedronFEMForceField<D>, HexahedronCompositeFEMForceField<D>,
             PyramidFEMForceField<D>, PrismFEMForceField<D>, QuadraticTetrahedronFEMForceField<D>,
             QuadraticHexahedronFEMForceField<D>, TriquadraticHexahedronFEMForceField<D>,
             TriangleFEMForceField<D>, SurfacePressureForceField<D>, TrianglePressureForceField<D>,
             QuadPressureForceField<D>, EdgePressureForceField<D>, OscillatingTorsionPressureForceField<D>,
             TriangularQuadraticSpringsForceField<D>, TriangularBiquadraticSpringsForceField<D>,
             TriangularTensorMassForceField<D>, QuadBendingFEMForceField<D>>;
template <class D>
using HyperelasticForces =
    Registry<TetrahedronHyperelasticityFEMForceField<D>, TetrahedronViscoelasticityFEMForceField<D>>;
template <class D>
using SpatialSprings =
    Registry<TriangularBendingSprings<D>, TriangleBendingSprings<D>, QuadularBendingSprings<D>,
             QuadBendingSprings<D>, FastTriangularBendingSprings<D>, PolynomialSpringsForceField<D>,
             PolynomialSpringsForceField<D, Linked>, PolynomialRestShapeSpringsForceField<D>,
             RepulsiveSpringForceField<D>, RepulsiveSpringForceField<D, Linked>, VectorSpringForceField<D>,
             VectorSpringForceField<D, Linked>>;
template <class D>
using FrameElements = Registry<BeamFEMForceField<D>, BeamMass<D>, TriangularShellForceField<D>>;
// wires
template <class D>
using Rods = Registry<AdaptiveBeamForceField<D>, AdaptiveBeamMass<D>, InterventionalRadiologyController<D>,
                      BeamInterpolation<D>, WireBeamInterpolation<D>, WireRestShape<D>, RodStraightSection,
                      RodSpireSection, AdaptiveBeamMapping<D, Vec3d>>;
template <class D>
using SpatialRigids =
    Registry<AngularSpringForceField<D>, TorsionForceField<D>, FixedRotationConstraint<D>, FrameElements<D>,
             FrameSpringForceField<D>, FrameSpringForceField<D, Linked>, GearSpringForceField<D>,
             GearSpringForceField<D, Linked>, JointSpringForceField<D>, JointSpringForceField<D, Linked>,
             StiffSpringForceField<D>, StiffSpringForceField<D, Linked>,
             PatchTestMovementProjectiveConstraint<D>>;
template <class D>
using PointConstraints =
    Registry<FixedConstraint<D>, PartialFixedConstraint<D>, FixedPlaneConstraint<D>,
             LinearMovementConstraint<D>, AffineMovementConstraint<D>, LinearVelocityConstraint<D>,
             OscillatorConstraint<D>, HermiteSplineConstraint<D>, ParabolicConstraint<D>,
             ProjectToPlaneConstraint<D>, ProjectToLineConstraint<D>, ProjectToPointConstraint<D>,
             ProjectDirectionConstraint<D>, AttachProjectiveConstraint<D>,
             AttachProjectiveConstraint<D, Linked>>;
template <class D>
using PointComponents = Registry<MechanicalObject<D>, UniformMass<D>, DiagonalMass<D>, MeshMatrixMass<D>,
                                 PointSprings<D>, PointLoads<D>, PointConstraints<D>>;
template <class D>
using SpatialComponents =
    Registry<PointComponents<D>, HexahedronCompositeFEMMass<D>, SpatialLoads<D>, ElementForces<D>,
             HyperelasticForces<D>, SpatialSprings<D>, Fluids<D>, PatchTestMovementProjectiveConstraint<D>>;
template <class D>
using RigidComponents =
    Registry<MechanicalObject<D>, UniformMass<D>, DiagonalMass<D>, RigidLoads<D>, PointConstraints<D>>;
template <class Rigid, class Point, class OtherPoint>
using RigidMappings =
    Registry<IdentityMapping<Rigid, Rigid>, IdentityMapping<Rigid, Point>, RigidMapping<Rigid, Rigid>,
             RigidMapping<Rigid, Point>, RigidMapping<Rigid, OtherPoint>, BeamLinearMapping<Rigid, Point>,
             BeamLinearMapping<Rigid, OtherPoint>, TubularMapping<Rigid, Point>,
             TubularMapping<Rigid, OtherPoint>>;
template <class In, class Out>
using PointMappings = Registry<IdentityMapping<In, Out>, SubsetMapping<In, Out>>;
template <class In, class Out>
using SpatialMappings =
    Registry<PointMappings<In, Out>, BarycentricMapping<In, Out>, HexahedronCompositeFEMMapping<In, Out>>;

// values on the points of a body, such as temperatures
template <class D>
using BodyFields = Registry<TetrahedronDiffusionFEMForceField<D>, TetrahedronReactionFEMForceField<D>>;

// what scenes over the rarer DataTypes, and in single precision, need
template <class D>
using CoreRigids =
    Registry<MechanicalObject<D>, UniformMass<D>, ConstantForceField<D>, RestShapeSpringsForceField<D>,
             UniformVelocityDampingForceField<D>, FixedConstraint<D>, PartialFixedConstraint<D>>;
template <class D>
using CorePoints =
    Registry<CoreRigids<D>, DiagonalMass<D>, StiffSpringForceField<D>, StiffSpringForceField<D, Linked>>;
template <class D>
using CoreBodies =
    Registry<CorePoints<D>, MeshSpringForceField<D>, TetrahedronFEMForceField<D>, HexahedronFEMForceField<D>>;

// states over time, from files and to files
template <class D>
using Playback = Registry<ReadState<D>, WriteState<D>>;

using StandardForces =
    Registry<SpatialComponents<Vec3d>, RigidComponents<Rigid3d>, SpatialRigids<Rigid3d>, CorePoints<Vec1d>,
             MeshSpringForceField<Vec1d>, BodyFields<Vec1d>, MeshMatrixMass<Vec1d>,
             LinearMovementConstraint<Vec1d>, PositionBasedDynamicsProjectiveConstraint<Vec3d>,
             PositionBasedDynamicsProjectiveConstraint<Rigid3d>, CorePoints<Vec2d>,
             MeshSpringForceField<Vec2d>, PlaneForceField<Vec2d>, Particles<Vec2d>, ImmersedSolid<Vec2d>,
             CorePoints<Vec6d>, CoreRigids<Rigid2d>, CoreBodies<Vec3f>, CoreRigids<Rigid3f>>;
using MeasuringMappings =
    Registry<DistanceMapping<Vec3d, Vec1d>, DistanceMapping<Rigid3d, Vec1d>, DistanceMapping<Vec2d, Vec1d>,
             VolumeMapping<Vec3d, Vec1d>, CenterOfMassMapping<Vec3d, Vec3d>,
             CenterOfMassMapping<Rigid3d, Vec3d>, AreaMapping<Vec3d, Vec1d>,
             SquareDistanceMapping<Vec3d, Vec1d>, SquareDistanceMapping<Rigid3d, Vec1d>,
             DistanceFromTargetMapping<Vec3d, Vec1d>, DistanceFromTargetMapping<Rigid3d, Vec1d>,
             DistanceToPlaneMapping<Vec3d, Vec1d>, DistanceToPlaneMapping<Rigid3d, Vec1d>,
             SquareMapping<Vec1d, Vec1d>>;
// bodies joined by hinges and slides, alone or on a base
template <class In, class Out>
using ArticulatedMappings =
    Registry<ArticulatedSystemMapping<In, Out>, ArticulatedSystemMapping<In, Out, Out, LinkedParents>>;
using MultiMappings =
    Registry<SubsetMultiMapping<Vec3d, Vec3d>, SubsetMultiMapping<Vec2d, Vec2d>,
             SubsetMultiMapping<Vec1d, Vec1d>, SubsetMultiMapping<Rigid3d, Rigid3d>,
             SubsetMultiMapping<Rigid3d, Vec3d>, SubsetMultiMapping<Vec3d, Vec3f>,
             IdentityMultiMapping<Vec3d, Vec3d>, IdentityMultiMapping<Rigid3d, Rigid3d>,
             DistanceMultiMapping<Vec3d, Vec1d>, DistanceMultiMapping<Rigid3d, Vec1d>,
             DeformableOnRigidFrameMapping<Vec3d, Rigid3d, Vec3d>, ArticulatedMappings<Vec1d, Rigid3d>>;
using SurfaceMappings = Registry<SPHFluidSurfaceMapping<Vec3d, Vec3f>>;
using SkinningMappings = Registry<SkinningMapping<Rigid3d, Vec3d>, SkinningMapping<Rigid3d, Vec3f>>;
using StandardMappings =
    Registry<MultiMappings, SkinningMappings, SurfaceMappings, MeasuringMappings,
             SpatialMappings<Vec3d, Vec3d>, SpatialMappings<Vec3d, Vec3f>, SpatialMappings<Vec3f, Vec3f>,
             SpatialMappings<Vec3f, Vec3d>, BarycentricMapping<Vec3d, Rigid3d>, PointMappings<Vec1d, Vec1d>,
             PointMappings<Vec2d, Vec2d>, PointMappings<Vec6d, Vec6d>, RigidMappings<Rigid3d, Vec3d, Vec3f>,
             RigidMappings<Rigid3f, Vec3f, Vec3d>, IdentityMapping<Rigid2d, Rigid2d>,
             RigidMapping<Rigid2d, Rigid2d>, RigidMapping<Rigid2d, Vec2d>>;
template <template <class> class Solver>
using AssembledSolvers =
    Registry<Solver<CompressedRowSparseMatrixMat3x3d>, Solver<CompressedRowSparseMatrixd>>;
using StandardSolvers =
    Registry<EulerExplicitSolver, CentralDifferenceSolver, RungeKutta2Solver, RungeKutta4Solver,
             RungeKutta45Solver, EulerImplicitSolver, NewmarkImplicitSolver, VariationalSymplecticSolver,
             BDFOdeSolver, StaticSolver, DampVelocitySolver, DFSPHSolver, CGLinearSolver<>,
             AssembledSolvers<CGLinearSolver>, CGLinearSolver<CompressedRowSparseMatrixMat3x3f>,
             MinResLinearSolver<>, AssembledSolvers<MinResLinearSolver>, ShewchukPCGLinearSolver<>,
             AssembledSolvers<ShewchukPCGLinearSolver>, AssembledSolvers<MultigridLinearSolver>,
             AssembledSolvers<SparseLDLSolver>, AssembledSolvers<CholeskySolver>,
             AssembledSolvers<PrecomputedLinearSolver>>;
template <class D>
using Regions = Registry<BoxROI<D>, SphereROI<D>, PairBoxROI<D>, NearestPointROI<D>>;
// meshes made, merged and divided, and what is known of them
using MeshEngines =
    Registry<GenerateGrid, GenerateCylinder, GenerateSphere, ExtrudeSurface, ExtrudeEdgesAndGenerateQuads,
             ExtrudeQuadsAndGenerateHexas, RandomPointDistributionInSurface, Spiral, MeshClosingEngine,
             MeshBarycentricMapperEngine, MeshTetraStuffing, JoinPoints, NormalsFromPoints, SmoothMeshEngine,
             DilateEngine, MergeMeshes<Vec3d>, MergePoints<Vec3d>, VolumeFromTriangles<Vec3d>,
             VolumeFromVolumetricElements<Vec3d>, MeshBoundaryROI, MeshROI<Vec3d>, MeshSplittingEngine,
             MeshSampler, MeshSubsetEngine, ProximityROI<Vec3d>, ComplementaryROI>;
// lists of numbers, values and places
using ListEngines = Registry<MergeVectors, MergeSets, MergeROIs, SelectLabelROI, ValuesFromIndices,
                             IndicesFromValues, DifferenceEngine, SumEngine, NormEngine, MathOp, MapIndices,
                             IndexValueMapper, Indices2ValuesMapper, ROIValueMapper,
                             ValuesFromPositions<Vec3d>, HausdorffDistance, AverageCoord<Vec3d>>;
using PlacingEngines =
    Registry<TransformPosition, TranslateTransformMatrixEngine, RotateTransformMatrixEngine,
             ScaleTransformMatrixEngine, InvertTransformMatrixEngine, Vertex2Frame, QuatToRigidEngine,
             RigidToQuatEngine, DisplacementMatrixEngine, ProjectiveTransformEngine>;
template <class D>
using SpatialEngines = Registry<Regions<D>, PlaneROI<D>, TransformEngine<D>, SubsetTopology<D>>;
using StandardEngines =
    Registry<MeshGmshLoader, MeshOBJLoader, MeshSTLLoader, MeshVTKLoader, MeshOffLoader, MeshPLYLoader,
             GIDMeshLoader, MeshTrianLoader, VoxelGridLoader, SphereLoader, MeshEngines, ListEngines,
             PlacingEngines, GenerateRigidMass<Rigid3d>, Hexa2TetraTopologicalMapping,
             Hexa2PrismTopologicalMapping, Tetra2TriangleTopologicalMapping, Hexa2QuadTopologicalMapping,
             Quad2TriangleTopologicalMapping, Triangle2EdgeTopologicalMapping, Edge2QuadTopologicalMapping,
             Mesh2PointTopologicalMapping, SimpleTesselatedTetraTopologicalMapping, SpatialEngines<Vec3d>,
             PointsFromIndices<Vec3d>, ClusteringEngine<Vec3d>, ShapeMatching<Vec3d>, Regions<Vec3f>,
             SpatialEngines<Rigid3d>, BoxROI<Vec1d>, Regions<Vec2d>, Regions<Rigid2d>>;
using StandardTopologies =
    Registry<TetrahedronTopology, MeshTopology, RegularGridTopology, SparseGridTopology,
             SparseGridRamificationTopology, SparseGridMultipleTopology, SurfaceSampling>;
// meshes that need no file
using MadeMeshes = Registry<CubeTopology, CylinderGridTopology, SphereGridTopology, GridMeshCreator,
                            StringMeshCreator, MeshSubdivision>;

template <class D>
using PointCollisionModels =
    Registry<PointCollisionModel<D>, LineCollisionModel<D>, TriangleCollisionModel<D>,
             SphereCollisionModel<D>, CapsuleCollisionModel<D>, TetrahedronCollisionModel<D>>;
#ifdef SINEW_CCD
using ConvexCollisionModels =
    Registry<ConvexCollisionModel<Rigid3d>, OBBCollisionModel<Rigid3d>, CapsuleCollisionModel<Rigid3d>>;
#else
using ConvexCollisionModels = Registry<>;
#endif
using StandardCollision =
    Registry<DefaultPipeline, SubCollisionPipeline, BruteForceBroadPhase, TreeBroadPhase, BVHNarrowPhase,
             RayTraceNarrowPhase, LocalMinDistance, MinProximityIntersection, DiscreteIntersection,
             ContinuousIntersection, DefaultContactManager, CarvingManager, CuttingManager,
             PointCollisionModels<Vec3d>, SphereCollisionModel<Rigid3d>,
             RigidDistanceGridCollisionModel<Rigid3d>, ConvexCollisionModels>;

template <class D>
using LagrangianJoints = Registry<FixedLagrangianConstraint<D>, BilateralLagrangianConstraint<D>,
                                  BilateralLagrangianConstraint<D, Linked>, SlidingLagrangianConstraint<D>,
                                  SlidingLagrangianConstraint<D, Linked>>;
template <class D>
using LagrangianContacts =
    Registry<UnilateralLagrangianConstraint<D>, UnilateralLagrangianConstraint<D, Linked>,
             AugmentedLagrangianConstraint<D>, AugmentedLagrangianConstraint<D, Linked>>;
using LagrangianConstraints =
    Registry<LagrangianJoints<Vec3d>, LagrangianJoints<Rigid3d>, LagrangianContacts<Vec3d>,
             FixedLagrangianConstraint<Vec1d>, FixedLagrangianConstraint<Vec2d>,
             FixedLagrangianConstraint<Vec6d>, UniformLagrangianConstraint<Vec1d>,
             StopperLagrangianConstraint<Vec1d>>;
using StandardMultipliers =
    Registry<FreeMotionAnimationLoop, BlockGaussSeidelConstraintSolver, UnbuiltGaussSeidelConstraintSolver,
             NNCGConstraintSolver, ImprovedJacobiConstraintSolver, LCPConstraintSolver,
             PreconditionedConjugateResidual, ConvexConstraintSolver, LinearSolverConstraintCorrection,
             UncoupledConstraintCorrection<Vec3d>, UncoupledConstraintCorrection<Rigid3d>,
             PrecomputedConstraintCorrection<Vec3d>, PrecomputedConstraintCorrection<Rigid3d>,
             LagrangianConstraints>;

using GridFluids = Registry<Fluid2D<Vec2d>, Fluid3D<Vec3d>, Fluid3D<Vec3f>>;
using ChangingTopologies =
    Registry<TopologicalChangeProcessor, TopologyBoundingTrasher<Vec3d>, TearingEngine<Vec3d>>;

/// Every component that Sinew brings, over the DataTypes that scenes use.
struct Standard
    : Registry<Gravity, Threads, MultiStepAnimationLoop, StandardTopologies, MadeMeshes, ChangingTopologies,
               VisualModel, StandardEngines, GridFluids, StandardForces, StandardMappings, StandardSolvers,
               StandardCollision, StandardMultipliers, Playback<Vec3d>, Playback<Rigid3d>, Rods<Rigid3d>> {
  static constexpr bool proved = true;  // tests/runtime/promises.cpp
};

/// The same over the rarer DataTypes too: what the law suites prove.
struct Extended
    : Registry<Standard, SpatialComponents<Vec3f>, PointComponents<Vec1d>, PointComponents<Vec1f>,
               PointComponents<Vec2d>, PointComponents<Vec2f>, PointComponents<Vec6d>, PointComponents<Vec6f>,
               RigidComponents<Rigid2d>, RigidComponents<Rigid2f>, RigidComponents<Rigid3f>,
               SpatialRigids<Rigid3f>, IdentityMapping<Rigid2f, Rigid2f>, RigidMapping<Rigid2d, Vec2f>,
               RigidMapping<Rigid2f, Vec2f>, RigidMapping<Rigid2f, Vec2d>, DistanceMapping<Vec3f, Vec1f>,
               VolumeMapping<Vec3f, Vec1f>, CenterOfMassMapping<Vec3d, Vec3f>,
               SkinningMapping<Rigid3f, Vec3f>, Playback<Vec1d>, Playback<Vec2d>, Playback<Vec6d>,
               Playback<Vec3f>, Playback<Rigid2d>, Playback<Rigid3f>, Fluid2D<Vec2f>> {
  static constexpr bool proved = true;
};

}  // namespace sinew
