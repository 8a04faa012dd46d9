// SPDX-License-Identifier: BSL-1.0
// The scenes of the table: what the yardstick and SOFA were measured with.
#pragma once

#include <sinew/constraint/fixed_constraint.hpp>
#include <sinew/context/gravity.hpp>
#include <sinew/force/regular_grid_spring.hpp>
#include <sinew/force/tetrahedron_fem.hpp>
#include <sinew/mass/diagonal_mass.hpp>
#include <sinew/mass/uniform_mass.hpp>
#include <sinew/scene/simulation.hpp>
#include <sinew/solver/cg_linear_solver.hpp>
#include <sinew/solver/euler_implicit.hpp>
#include <sinew/state/mechanical_object.hpp>
#include <sinew/topology/regular_grid.hpp>
#include <sinew/topology/regular_grid_topology.hpp>
#include <sinew/topology/tetrahedron_topology.hpp>

#include <array>
#include <vector>

namespace bench {

using namespace sinew;

template <class D>
typename D::VecCoord points_of(Mesh const& mesh) {
  typename D::VecCoord points;
  for (auto const& p : mesh.positions) points.push_back(p.template cast<typename D::Real>());
  return points;
}

inline EulerImplicitSolver damped_euler() { return {.rayleighStiffness = 0.1, .rayleighMass = 0.1}; }

template <class D>
TetrahedronFEMForceField<D> corotational(std::vector<double> youngModulus = {3000},
                                         double poissonRatio = 0.3) {
  return {.youngModulus = youngModulus, .poissonRatio = poissonRatio, .method = RotationMethod::gradient};
}

/// One body of density 1, its points 3, 39 and 64 fixed, and what solves it.
template <class D, class... Solvers>
auto solved_body(Mesh const& mesh, TetrahedronFEMForceField<D> const& force, Solvers const&... solvers) {
  return Simulation{node<"root">(Gravity{{0, -9.81, 0}},
                                 solvers...,
                                 TetrahedronTopology{mesh.tetrahedra},
                                 MechanicalObject<D>{points_of<D>(mesh)},
                                 DiagonalMass<D>{.massDensity = 1},
                                 force,
                                 FixedConstraint<D>{.indices = {3, 39, 64}})};
}

/// The same, corotational, nu 0.3, with implicit Euler and Rayleigh damping 0.1/0.1.
template <class D, class Linear>
auto body(Mesh const& mesh, Linear const& linear, double youngModulus = 3000) {
  return solved_body<D>(mesh, corotational<D>({youngModulus}), damped_euler(), linear);
}

/// A grid of unit cells with springs along the lines, both diagonals of each quad and the four of each cube,
/// of stiffness 4500 over their length; total mass 1, points 0 to 3 fixed, the same solver.
template <class D, class Linear>
auto spring_grid(std::array<int, 3> n, Linear linear) {
  return Simulation{node<"root">(Gravity{{0, -9.81, 0}},
                                 damped_euler(),
                                 linear,
                                 RegularGridTopology{.n = n, .max = {n[0] - 1.0, n[1] - 1.0, n[2] - 1.0}},
                                 MechanicalObject<D>{},
                                 UniformMass<D>{.totalMass = 1},
                                 RegularGridSpringForceField<D>{.stiffness = 4500, .damping = 0},
                                 FixedConstraint<D>{.indices = {0, 1, 2, 3}})};
}

/// 25 iterations with no early exit.
template <class Matrix>
CGLinearSolver<Matrix> all_iterations(int iterations = 25) {
  return {.iterations = iterations, .tolerance = 0};
}

/// A unit cube of n cells along each edge, six tetrahedra a cell.
inline Mesh block(int n) { return regular_grid_tetrahedra(n + 1, n + 1, n + 1, {0, 0, 0}, {1, 1, 1}); }

}  // namespace bench
