// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/contact.hpp>
#include <sinew/core/registry.hpp>
#include <sinew/engine/mesh_vtk_loader.hpp>
#include <sinew/mechanics.hpp>
#include <sinew/mpi/petsc_linear_solver.hpp>
#include <sinew/mpi/read_gmsh.hpp>
#include <sinew/mpi/simulation.hpp>
#include <sinew/runtime/read_scene.hpp>
#include <sinew/runtime/runtime.hpp>
#include <sinew/visual/visual_model.hpp>

#include <array>
#include <cstddef>
#include <string>

namespace sinew::mpi {

namespace detail {
struct GmshFormatOfRanks : sinew::detail::GmshFormat {
  static Mesh read(std::string const& path) {
    Communicator* const ranks = ReadTogether::now();
    return ranks ? read_gmsh(path, *ranks) : io::read_gmsh(path);
  }
};
}  // namespace detail

/// What scene files may have that several processes step together: the classes that are distributed, and
/// engines that make their data before the scene starts.
using DistributableBodies =
    Registry<Gravity, MeshLoader<detail::GmshFormatOfRanks>, MeshVTKLoader, MeshOBJLoader, BoxROI<Vec3d>,
             SphereROI<Vec3d>, PlaneROI<Vec3d>, MeshTopology, TetrahedronTopology, MechanicalObject<Vec3d>,
             UniformMass<Vec3d>, DiagonalMass<Vec3d>, MeshMatrixMass<Vec3d>, CGLinearSolver<>,
             PetscLinearSolver<>, IdentityMapping<Vec3d, Vec3d>, SubsetMapping<Vec3d, Vec3d>,
             BarycentricMapping<Vec3d, Vec3d>>;
using DistributableSolvers = Registry<EulerImplicitSolver, EulerExplicitSolver, NewmarkImplicitSolver,
                                      BDFOdeSolver, VariationalSymplecticSolver, StaticSolver,
                                      RungeKutta2Solver, RungeKutta4Solver, CentralDifferenceSolver>;
using LookedAt = Registry<VisualModel, IdentityMapping<Vec3d, Vec3f>, SubsetMapping<Vec3d, Vec3f>,
                          BarycentricMapping<Vec3d, Vec3f>, RigidMapping<Rigid3d, Vec3f>>;
using DistributableRigids =
    Registry<MechanicalObject<Rigid3d>, UniformMass<Rigid3d>, RigidMapping<Rigid3d, Vec3d>,
             JointSpringForceField<Rigid3d>, JointSpringForceField<Rigid3d, Linked>,
             ConstantForceField<Rigid3d>, RestShapeSpringsForceField<Rigid3d>,
             UniformVelocityDampingForceField<Rigid3d>, FixedConstraint<Rigid3d>,
             PartialFixedConstraint<Rigid3d>, TriangularShellForceField<Rigid3d>, BeamFEMForceField<Rigid3d>>;
using DistributableElements =
    Registry<TetrahedronHyperelasticityFEMForceField<Vec3d>, TetrahedronViscoelasticityFEMForceField<Vec3d>,
             PrismFEMForceField<Vec3d>, PyramidFEMForceField<Vec3d>, QuadraticTetrahedronFEMForceField<Vec3d>,
             TriangleFEMForceField<Vec3d>, TriangularTensorMassForceField<Vec3d>,
             TriangularQuadraticSpringsForceField<Vec3d>, TriangularBiquadraticSpringsForceField<Vec3d>,
             QuadBendingFEMForceField<Vec3d>, TrianglePressureForceField<Vec3d>,
             QuadPressureForceField<Vec3d>>;
using DistributableForces =
    Registry<TetrahedronFEMForceField<Vec3d>, HexahedronFEMForceField<Vec3d>, MeshSpringForceField<Vec3d>,
             StiffSpringForceField<Vec3d>, StiffSpringForceField<Vec3d, Linked>, PlaneForceField<Vec3d>,
             SphereForceField<Vec3d>, EllipsoidForceField<Vec3d>, ConicalForceField<Vec3d>,
             ConstantForceField<Vec3d>, LinearForceField<Vec3d>, TorsionForceField<Vec3d>,
             RestShapeSpringsForceField<Vec3d>, PolynomialRestShapeSpringsForceField<Vec3d>,
             UniformVelocityDampingForceField<Vec3d>, DiagonalVelocityDampingForceField<Vec3d>>;
using DistributableConstraints =
    Registry<FixedConstraint<Vec3d>, PartialFixedConstraint<Vec3d>, FixedPlaneConstraint<Vec3d>,
             LinearMovementConstraint<Vec3d>, LinearVelocityConstraint<Vec3d>,
             AffineMovementConstraint<Vec3d>, OscillatorConstraint<Vec3d>, ParabolicConstraint<Vec3d>,
             HermiteSplineConstraint<Vec3d>, ProjectDirectionConstraint<Vec3d>,
             ProjectToPointConstraint<Vec3d>, ProjectToLineConstraint<Vec3d>,
             ProjectToPlaneConstraint<Vec3d>>;
using DistributableContact =
    Registry<DefaultPipeline, BruteForceBroadPhase, BVHNarrowPhase, MinProximityIntersection,
             LocalMinDistance, DefaultContactManager, PointCollisionModel<Vec3d>, LineCollisionModel<Vec3d>,
             TriangleCollisionModel<Vec3d>, SphereCollisionModel<Vec3d>>;
struct Distributable
    : Registry<DistributableBodies, DistributableSolvers, LookedAt, DistributableRigids,
               DistributableElements, DistributableForces, DistributableConstraints, DistributableContact> {
  using Distribution = mpi::Distribution;
};

namespace detail {
/// Whether each class that files may have can be shared out, and files may have each that can.
consteval bool files_have_what_is_distributed() {
  bool all = true;
  std::array<bool, distributed_classes.size()> had{};
  for_each_registered<Distributable>([&]<class C> {
    all = all && is_distributed<C>();
    for (std::size_t i = 0; i < had.size(); ++i) had[i] = had[i] || distributed_classes[i] == C::className;
  });
  for (const bool one : had) all = all && one;
  return all;
}
static_assert(files_have_what_is_distributed(),
              "Distributable and distributed_classes name the same classes; add what one of them lacks");
}  // namespace detail

}  // namespace sinew::mpi
