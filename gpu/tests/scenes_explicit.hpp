// SPDX-License-Identifier: BSL-1.0
#pragma once

#include "scenes.hpp"

#include <sinew/constraint/fixed_constraint.hpp>
#include <sinew/force/plane_force_field.hpp>
#include <sinew/force/regular_grid_spring.hpp>
#include <sinew/force/tetrahedron_hyperelasticity.hpp>
#include <sinew/solver/euler_explicit.hpp>
#include <sinew/solver/runge_kutta2.hpp>
#include <sinew/solver/runge_kutta4.hpp>
#include <sinew/topology/mesh_topology.hpp>
#include <sinew/topology/regular_grid.hpp>
#include <sinew/topology/regular_grid_topology.hpp>

namespace gpu_test {

/// A grid of springs that swings.
template <class Solver>
struct SwingingGrid : OneBody {
  static constexpr double dt = 0.002;
  static constexpr int steps = 100;
  static constexpr bool onDevice = true;
  template <class D>
  static auto make() {
    return Simulation{
        node<"root">(Gravity{{0, -9.81, 0}},
                     Solver{},
                     node<"body">(RegularGridTopology{.n = {5, 4, 3}, .min = {0, 0, 0}, .max = {1, 1, 1}},
                                  MechanicalObject<D>{},
                                  UniformMass<D>{.totalMass = 5},
                                  RegularGridSpringForceField<D>{.stiffness = 500, .damping = 2},
                                  FixedConstraint<D>{.indices = {0, 20, 40}}))};
  }
};

/// A hyperelastic cube that falls on a plane.
struct HyperelasticCube : OneBody {
  static constexpr double dt = 0.002;
  static constexpr int steps = 100;
  static constexpr bool onDevice = true;
  template <class D>
  static auto make() {
    const Mesh mesh = regular_grid_tetrahedra(4, 4, 4, {0, 0, 0}, {1, 1, 1});
    return Simulation{node<"root">(
        Gravity{{0, -9.81, 0}},
        RungeKutta4Solver{},
        node<"body">(MeshTopology{.position = mesh.positions, .tetrahedra = mesh.tetrahedra},
                     MechanicalObject<D>{.velocity = {{0.3, -2, 0.1}}},
                     UniformMass<D>{.totalMass = 100},
                     TetrahedronHyperelasticityFEMForceField<D>{
                         .materialName = HyperelasticMaterial::NeoHookean, .parameterSet = {2e4, 4e4}},
                     PlaneForceField<D>{.d = -0.05, .stiffness = 3000, .damping = 5}))};
  }
};

}  // namespace gpu_test
