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
using PointComponents = Registry<MechanicalObject<D>, UniformMass<D>, DiagonalMass<D>,
                                 StiffSpringForceField<D>, ConstantForceField<D>, FixedConstraint<D>>;
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
                                PointComponents<Vec1f>, PointComponents<Vec2d>, PointComponents<Vec2f>,
                                PointComponents<Vec6d>, PointComponents<Vec6f>, RigidComponents<Rigid2d>,
                                RigidComponents<Rigid2f>, RigidComponents<Rigid3d>, RigidComponents<Rigid3f>>;
using StandardMappings =
    Registry<SpatialMappings<Vec3d, Vec3d>, SpatialMappings<Vec3d, Vec3f>, SpatialMappings<Vec3f, Vec3f>,
             SpatialMappings<Vec3f, Vec3d>, PointMappings<Vec1d, Vec1d>, PointMappings<Vec2d, Vec2d>,
             PointMappings<Vec6d, Vec6d>, RigidMappings<Rigid3d, Vec3d, Vec3f>,
             RigidMappings<Rigid3f, Vec3f, Vec3d>, RigidMappings<Rigid2d, Vec2d, Vec2f>,
             RigidMappings<Rigid2f, Vec2f, Vec2d>>;
using StandardSolvers =
    Registry<EulerExplicitSolver, RungeKutta2Solver, RungeKutta4Solver, EulerImplicitSolver, CGLinearSolver<>,
             CGLinearSolver<CompressedRowSparseMatrixMat3x3d>,
             CGLinearSolver<CompressedRowSparseMatrixMat3x3f>, CGLinearSolver<CompressedRowSparseMatrixd>,
             CGLinearSolver<CompressedRowSparseMatrixf>>;

/// Every component that Sinew brings.
using Standard =
    Registry<Gravity, TetrahedronTopology, VisualModel, StandardForces, StandardMappings, StandardSolvers>;

}  // namespace sinew
