// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/sinew.hpp>

namespace sinew {

/// A list of component types, closed: what the law suites prove, and what scenes at run time may be made of.
/// A list of one's own extends another: Registry<Standard, MyForce<Vec3d>>.
template <class... Entries>
struct Registry {};

namespace detail {
template <class Entry, class F>
constexpr void for_each_entry(std::type_identity<Entry>, F&& f) {
  f.template operator()<Entry>();
}
template <class... Entries, class F>
constexpr void for_each_entry(std::type_identity<Registry<Entries...>>, F&& f) {
  (for_each_entry(std::type_identity<Entries>{}, f), ...);
}
}  // namespace detail

/// f.operator()<C>() for each component of a registry and of those inside it.
template <class R, class F>
constexpr void for_each_registered(F&& f) {
  detail::for_each_entry(std::type_identity<R>{}, f);
}

/// Components over one DataTypes of points, of rigids, and over none.
template <class D>
using PointSprings =
    Registry<StiffSpringForceField<D>, MeshSpringForceField<D>, RegularGridSpringForceField<D>>;
template <class D>
using RigidLoads = Registry<ConstantForceField<D>, LinearForceField<D>, RestShapeSpringsForceField<D>,
                            PlaneForceField<D>, UniformVelocityDampingForceField<D>>;
template <class D>
using PointLoads = Registry<RigidLoads<D>, SphereForceField<D>>;
template <class D>
using ElementForces = Registry<TetrahedronFEMForceField<D>, HexahedronFEMForceField<D>,
                               TriangleFEMForceField<D>, SurfacePressureForceField<D>>;
template <class D>
using PointConstraints =
    Registry<FixedConstraint<D>, PartialFixedConstraint<D>, FixedPlaneConstraint<D>,
             LinearMovementConstraint<D>, AffineMovementConstraint<D>, LinearVelocityConstraint<D>,
             OscillatorConstraint<D>, ProjectToPlaneConstraint<D>, ProjectToLineConstraint<D>,
             ProjectToPointConstraint<D>, ProjectDirectionConstraint<D>>;
template <class D>
using PointComponents = Registry<MechanicalObject<D>, UniformMass<D>, DiagonalMass<D>, MeshMatrixMass<D>,
                                 PointSprings<D>, PointLoads<D>, PointConstraints<D>>;
template <class D>
using SpatialComponents = Registry<PointComponents<D>, ElementForces<D>>;
template <class D>
using RigidComponents =
    Registry<MechanicalObject<D>, UniformMass<D>, DiagonalMass<D>, RigidLoads<D>, PointConstraints<D>>;
template <class Rigid, class Point, class OtherPoint>
using RigidMappings =
    Registry<IdentityMapping<Rigid, Rigid>, RigidMapping<Rigid, Point>, RigidMapping<Rigid, OtherPoint>>;
template <class In, class Out>
using PointMappings = Registry<IdentityMapping<In, Out>, SubsetMapping<In, Out>>;
template <class In, class Out>
using SpatialMappings = Registry<PointMappings<In, Out>, BarycentricMapping<In, Out>>;

using StandardForces = Registry<SpatialComponents<Vec3d>, SpatialComponents<Vec3f>, PointComponents<Vec1d>,
                                PointComponents<Vec1f>, PointComponents<Vec2d>, PointComponents<Vec2f>,
                                PointComponents<Vec6d>, PointComponents<Vec6f>, RigidComponents<Rigid2d>,
                                RigidComponents<Rigid2f>, RigidComponents<Rigid3d>, RigidComponents<Rigid3f>>;
using StandardMappings =
    Registry<SpatialMappings<Vec3d, Vec3d>, SpatialMappings<Vec3d, Vec3f>, SpatialMappings<Vec3f, Vec3f>,
             SpatialMappings<Vec3f, Vec3d>, PointMappings<Vec1d, Vec1d>, PointMappings<Vec2d, Vec2d>,
             PointMappings<Vec6d, Vec6d>, RigidMappings<Rigid3d, Vec3d, Vec3f>,
             RigidMappings<Rigid3f, Vec3f, Vec3d>, RigidMappings<Rigid2d, Vec2d, Vec2f>,
             RigidMappings<Rigid2f, Vec2f, Vec2d>>;
template <template <class> class Solver>
using AssembledSolvers =
    Registry<Solver<CompressedRowSparseMatrixMat3x3d>, Solver<CompressedRowSparseMatrixMat3x3f>,
             Solver<CompressedRowSparseMatrixd>, Solver<CompressedRowSparseMatrixf>>;
using StandardSolvers =
    Registry<EulerExplicitSolver, CentralDifferenceSolver, RungeKutta2Solver, RungeKutta4Solver,
             RungeKutta45Solver, EulerImplicitSolver, NewmarkImplicitSolver, VariationalSymplecticSolver,
             BDFOdeSolver, StaticSolver, CGLinearSolver<>, AssembledSolvers<CGLinearSolver>,
             MinResLinearSolver<>, AssembledSolvers<MinResLinearSolver>, ShewchukPCGLinearSolver<>,
             AssembledSolvers<ShewchukPCGLinearSolver>, AssembledSolvers<SparseLDLSolver>,
             AssembledSolvers<CholeskySolver>>;
template <class D>
using Regions = Registry<BoxROI<D>, SphereROI<D>>;
template <class D>
using SpatialEngines = Registry<Regions<D>, PlaneROI<D>, TransformEngine<D>>;
// MeshVTKLoader is not among them: it needs pugixml
using StandardEngines =
    Registry<MeshGmshLoader, MeshOBJLoader, MeshSTLLoader, SphereLoader, SpatialEngines<Vec3d>,
             SpatialEngines<Vec3f>, SpatialEngines<Rigid3d>, SpatialEngines<Rigid3f>, Regions<Vec1d>,
             Regions<Vec1f>, Regions<Vec2d>, Regions<Vec2f>, Regions<Vec6d>, Regions<Vec6f>, Regions<Rigid2d>,
             Regions<Rigid2f>>;
using StandardTopologies =
    Registry<TetrahedronTopology, MeshTopology, RegularGridTopology, SparseGridTopology>;

/// Every component that Sinew brings.
using Standard = Registry<Gravity, StandardTopologies, VisualModel, StandardEngines, StandardForces,
                          StandardMappings, StandardSolvers>;

}  // namespace sinew
