// SPDX-License-Identifier: BSL-1.0
#pragma once

// What scene files that are dropped onto the page may have: the components that most scenes are made of. All
// of them (sinew/registry.hpp) would be a download of several times that size.
#include <sinew/core/registry.hpp>
#include <sinew/lagrangian.hpp>
#include <sinew/sinew.hpp>

namespace page {

using namespace sinew;

template <class D>
using Bodies =
    Registry<MechanicalObject<D>, UniformMass<D>, DiagonalMass<D>, ConstantForceField<D>, LinearForceField<D>,
             PlaneForceField<D>, RestShapeSpringsForceField<D>, UniformVelocityDampingForceField<D>,
             FixedConstraint<D>, PartialFixedConstraint<D>, LinearMovementConstraint<D>, BoxROI<D>>;
using Springs = Registry<StiffSpringForceField<Vec3d>, StiffSpringForceField<Vec3d, Linked>,
                         MeshSpringForceField<Vec3d>, RegularGridSpringForceField<Vec3d>,
                         TriangularBendingSprings<Vec3d>, QuadularBendingSprings<Vec3d>>;
using Tissue = Registry<TetrahedronFEMForceField<Vec3d>, HexahedronFEMForceField<Vec3d>,
                        TriangleFEMForceField<Vec3d>, TetrahedronHyperelasticityFEMForceField<Vec3d>,
                        MeshMatrixMass<Vec3d>, SurfacePressureForceField<Vec3d>, SphereForceField<Vec3d>>;
using Topologies =
    Registry<TetrahedronTopology, MeshTopology, RegularGridTopology, SparseGridTopology, CubeTopology,
             CylinderGridTopology, SphereGridTopology, Hexa2TetraTopologicalMapping,
             Tetra2TriangleTopologicalMapping, Hexa2QuadTopologicalMapping, Quad2TriangleTopologicalMapping,
             MeshGmshLoader, MeshOBJLoader, MeshSTLLoader, SphereROI<Vec3d>, PlaneROI<Vec3d>>;
template <class Out>
using Mappings = Registry<IdentityMapping<Vec3d, Out>, SubsetMapping<Vec3d, Out>,
                          BarycentricMapping<Vec3d, Out>, RigidMapping<Rigid3d, Out>>;
template <template <class> class Solver>
using Assembled = Registry<Solver<CompressedRowSparseMatrixMat3x3d>, Solver<CompressedRowSparseMatrixd>>;
using Solvers =
    Registry<EulerExplicitSolver, RungeKutta4Solver, EulerImplicitSolver, NewmarkImplicitSolver, StaticSolver,
             CGLinearSolver<>, Assembled<CGLinearSolver>, Assembled<SparseLDLSolver>>;
using Collision =
    Registry<DefaultPipeline, BruteForceBroadPhase, TreeBroadPhase, BVHNarrowPhase, LocalMinDistance,
             MinProximityIntersection, DiscreteIntersection, DefaultContactManager,
             PointCollisionModel<Vec3d>, LineCollisionModel<Vec3d>, TriangleCollisionModel<Vec3d>,
             SphereCollisionModel<Vec3d>, SphereCollisionModel<Rigid3d>>;
using Multipliers =
    Registry<FreeMotionAnimationLoop, BlockGaussSeidelConstraintSolver, LinearSolverConstraintCorrection,
             UncoupledConstraintCorrection<Vec3d>, UncoupledConstraintCorrection<Rigid3d>>;

struct Components : Registry<Gravity, Threads, VisualModel, Bodies<Vec3d>, Bodies<Rigid3d>, Springs, Tissue,
                             Topologies, Mappings<Vec3d>, Mappings<Vec3f>, IdentityMapping<Rigid3d, Rigid3d>,
                             RigidMapping<Rigid3d, Rigid3d>, Solvers, Collision, Multipliers> {
  static constexpr bool proved = true;  // as parts of Standard
};

}  // namespace page
