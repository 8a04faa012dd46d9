// SPDX-License-Identifier: BSL-1.0
#pragma once

// What scene files that are dropped onto the page may have: of Standard (sinew/registry.hpp) most that is
// over points and rigids in space, in double precision. With the mappings that measure, fluids and the rest
// the module would be twice as large.
#include <sinew/core/registry.hpp>
#include <sinew/lagrangian.hpp>
#include <sinew/sinew.hpp>

namespace page {

using namespace sinew;

template <class D>
using Bodies =
    Registry<MechanicalObject<D>, UniformMass<D>, DiagonalMass<D>, ConstantForceField<D>, LinearForceField<D>,
             PlaneForceField<D>, RestShapeSpringsForceField<D>, UniformVelocityDampingForceField<D>,
             VirtualCoupling<D>, FixedConstraint<D>, PartialFixedConstraint<D>, LinearMovementConstraint<D>,
             AffineMovementConstraint<D>, LinearVelocityConstraint<D>, AttachProjectiveConstraint<D>,
             AttachProjectiveConstraint<D, Linked>, BoxROI<D>, SphereROI<D>, NearestPointROI<D>>;
using PointConstraints =
    Registry<FixedPlaneConstraint<Vec3d>, OscillatorConstraint<Vec3d>, HermiteSplineConstraint<Vec3d>,
             ParabolicConstraint<Vec3d>, ProjectToPlaneConstraint<Vec3d>, ProjectToLineConstraint<Vec3d>,
             ProjectToPointConstraint<Vec3d>, ProjectDirectionConstraint<Vec3d>>;
using Springs =
    Registry<StiffSpringForceField<Vec3d>, StiffSpringForceField<Vec3d, Linked>, MeshSpringForceField<Vec3d>,
             RegularGridSpringForceField<Vec3d>, PolynomialSpringsForceField<Vec3d>,
             PolynomialSpringsForceField<Vec3d, Linked>, TriangularBendingSprings<Vec3d>,
             QuadularBendingSprings<Vec3d>, FastTriangularBendingSprings<Vec3d>,
             TriangleBendingSprings<Vec3d>, QuadBendingSprings<Vec3d>, AngularSpringForceField<Rigid3d>>;
using Tissue =
    Registry<TetrahedronFEMForceField<Vec3d>, HexahedronFEMForceField<Vec3d>, TriangleFEMForceField<Vec3d>,
             TetrahedronHyperelasticityFEMForceField<Vec3d>, TetrahedronViscoelasticityFEMForceField<Vec3d>,
             MeshMatrixMass<Vec3d>, SurfacePressureForceField<Vec3d>, TrianglePressureForceField<Vec3d>,
             QuadPressureForceField<Vec3d>, EdgePressureForceField<Vec3d>, SphereForceField<Vec3d>>;
using Frames = Registry<BeamFEMForceField<Rigid3d>, BeamMass<Rigid3d>, TriangularShellForceField<Rigid3d>,
                        FixedRotationConstraint<Rigid3d>>;
using Topologies =
    Registry<TetrahedronTopology, MeshTopology, RegularGridTopology, SparseGridTopology, CubeTopology,
             CylinderGridTopology, SphereGridTopology, GridMeshCreator, StringMeshCreator, MeshSubdivision,
             Hexa2TetraTopologicalMapping, Tetra2TriangleTopologicalMapping, Hexa2QuadTopologicalMapping,
             Quad2TriangleTopologicalMapping, Triangle2EdgeTopologicalMapping>;
using Engines = Registry<MeshGmshLoader, MeshOBJLoader, MeshSTLLoader, SphereLoader, PlaneROI<Vec3d>,
                         PairBoxROI<Vec3d>, TransformEngine<Vec3d>, GenerateRigidMass<Rigid3d>>;
template <class Out>
using Mappings =
    Registry<IdentityMapping<Vec3d, Out>, SubsetMapping<Vec3d, Out>, BarycentricMapping<Vec3d, Out>,
             IdentityMapping<Rigid3d, Out>, RigidMapping<Rigid3d, Out>, SkinningMapping<Rigid3d, Out>,
             BeamLinearMapping<Rigid3d, Out>, SubsetMultiMapping<Vec3d, Out>>;
template <template <class> class Solver>
using Assembled = Registry<Solver<CompressedRowSparseMatrixMat3x3d>, Solver<CompressedRowSparseMatrixd>>;
using Solvers = Registry<EulerExplicitSolver, CentralDifferenceSolver, RungeKutta2Solver, RungeKutta4Solver,
                         RungeKutta45Solver, DampVelocitySolver, EulerImplicitSolver, NewmarkImplicitSolver,
                         VariationalSymplecticSolver, BDFOdeSolver, StaticSolver, CGLinearSolver<>,
                         Assembled<CGLinearSolver>, MinResLinearSolver<>, ShewchukPCGLinearSolver<>,
                         Assembled<SparseLDLSolver>, Assembled<CholeskySolver>>;
using Collision =
    Registry<DefaultPipeline, BruteForceBroadPhase, TreeBroadPhase, BVHNarrowPhase, LocalMinDistance,
             MinProximityIntersection, DiscreteIntersection, ContinuousIntersection, DefaultContactManager,
             CarvingManager, PointCollisionModel<Vec3d>, LineCollisionModel<Vec3d>,
             TriangleCollisionModel<Vec3d>, SphereCollisionModel<Vec3d>, SphereCollisionModel<Rigid3d>>;
template <class D>
using Joints = Registry<UncoupledConstraintCorrection<D>, FixedLagrangianConstraint<D>,
                        BilateralLagrangianConstraint<D>, BilateralLagrangianConstraint<D, Linked>>;
using Multipliers = Registry<FreeMotionAnimationLoop, BlockGaussSeidelConstraintSolver, NNCGConstraintSolver,
                             LinearSolverConstraintCorrection, Joints<Vec3d>, Joints<Rigid3d>>;

struct Components : Registry<Gravity, Threads, VisualModel, Bodies<Vec3d>, Bodies<Rigid3d>, PointConstraints,
                             Springs, Tissue, Frames, Topologies, Engines, Mappings<Vec3d>, Mappings<Vec3f>,
                             IdentityMapping<Rigid3d, Rigid3d>, RigidMapping<Rigid3d, Rigid3d>,
                             SubsetMultiMapping<Rigid3d, Rigid3d>, Solvers, Collision, Multipliers> {
  static constexpr bool proved = true;  // as parts of Standard
};

}  // namespace page
