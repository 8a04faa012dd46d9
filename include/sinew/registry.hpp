// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/core/registry.hpp>
#include <sinew/sinew.hpp>

namespace sinew {

/// Components over one DataTypes of points, of rigids, and over none.
template <class D>
using PointComponents =
    Registry<MechanicalObject<D>, UniformMass<D>, DiagonalMass<D>, StiffSpringForceField<D>,
             StiffSpringForceField<D, Linked>, ConstantForceField<D>, FixedConstraint<D>>;
template <class D>
using SpatialComponents = Registry<PointComponents<D>, TetrahedronFEMForceField<D>>;
template <class D>
using RigidComponents =
    Registry<MechanicalObject<D>, UniformMass<D>, DiagonalMass<D>, ConstantForceField<D>, FixedConstraint<D>>;
template <class Rigid, class Point, class OtherPoint>
using RigidMappings =
    Registry<IdentityMapping<Rigid, Rigid>, RigidMapping<Rigid, Point>, RigidMapping<Rigid, OtherPoint>>;
template <class In, class Out>
using PointMappings = Registry<IdentityMapping<In, Out>, SubsetMapping<In, Out>>;
template <class In, class Out>
using SpatialMappings = Registry<PointMappings<In, Out>, BarycentricMapping<In, Out>>;

using StandardForces = Registry<SpatialComponents<Vec3d>, SpatialComponents<Vec3f>, PointComponents<Vec1d>,
                                PointComponents<Vec2d>, PointComponents<Vec6d>, RigidComponents<Rigid2d>,
                                RigidComponents<Rigid3d>, RigidComponents<Rigid3f>>;
using StandardMappings =
    Registry<SpatialMappings<Vec3d, Vec3d>, SpatialMappings<Vec3d, Vec3f>, SpatialMappings<Vec3f, Vec3f>,
             SpatialMappings<Vec3f, Vec3d>, PointMappings<Vec1d, Vec1d>, PointMappings<Vec2d, Vec2d>,
             PointMappings<Vec6d, Vec6d>, RigidMappings<Rigid3d, Vec3d, Vec3f>,
             RigidMappings<Rigid3f, Vec3f, Vec3d>, RigidMapping<Rigid2d, Vec2d>,
             IdentityMapping<Rigid2d, Rigid2d>>;
using StandardSolvers =
    Registry<EulerExplicitSolver, RungeKutta2Solver, RungeKutta4Solver, EulerImplicitSolver, CGLinearSolver<>,
             CGLinearSolver<CompressedRowSparseMatrixMat3x3d>,
             CGLinearSolver<CompressedRowSparseMatrixMat3x3f>, CGLinearSolver<CompressedRowSparseMatrixd>,
             CGLinearSolver<CompressedRowSparseMatrixf>>;

/// Every component that Sinew brings, over the DataTypes that scenes use.
struct Standard
    : Registry<Gravity, TetrahedronTopology, VisualModel, StandardForces, StandardMappings, StandardSolvers> {
};

/// The same over the rarer DataTypes too: what the law suites prove.
struct Extended
    : Registry<Standard, PointComponents<Vec1f>, PointComponents<Vec2f>, PointComponents<Vec6f>,
               RigidComponents<Rigid2f>, RigidMapping<Rigid2d, Vec2f>, RigidMapping<Rigid2f, Vec2f>,
               RigidMapping<Rigid2f, Vec2d>, IdentityMapping<Rigid2f, Rigid2f>> {};

}  // namespace sinew
