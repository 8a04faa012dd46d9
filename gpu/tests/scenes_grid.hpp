// SPDX-License-Identifier: BSL-1.0
#pragma once

#include "scenes.hpp"

#include <sinew/constraint/fixed_constraint.hpp>
#include <sinew/constraint/partial_fixed.hpp>
#include <sinew/force/hexahedron_fem.hpp>
#include <sinew/force/plane_force_field.hpp>
#include <sinew/force/regular_grid_spring.hpp>
#include <sinew/solver/cg_linear_solver.hpp>
#include <sinew/solver/euler_implicit.hpp>
#include <sinew/topology/regular_grid_topology.hpp>

namespace gpu_test {

/// Hexahedra, with a solver that goes on to a tolerance.
struct HexahedraBar : OneBody {
  static constexpr double dt = 0.01;
  static constexpr int steps = 40;
  static constexpr bool onDevice = true;
  template <class D>
  static auto make() {
    return Simulation{node<"root">(
        Gravity{{0, -9.81, 0}},
        EulerImplicitSolver{.rayleighStiffness = 0.01, .rayleighMass = 0.1},
        CGLinearSolver<>{.iterations = 300, .tolerance = 1e-13},
        node<"body">(RegularGridTopology{.n = {5, 3, 3}, .min = {0, 0, 0}, .max = {2, 1, 1}},
                     MechanicalObject<D>{},
                     UniformMass<D>{.totalMass = 500},
                     HexahedronFEMForceField<D>{
                         .youngModulus = {1e5}, .poissonRatio = 0.3, .method = HexahedronMethod::nearest},
                     FixedConstraint<D>{.indices = {0, 5, 10, 15, 20, 25, 30, 35, 40}}))};
  }
};

/// A grid of springs that falls on a plane, some of it held from moving along x and z.
struct GridOnPlane : OneBody {
  static constexpr double dt = 0.01;
  static constexpr int steps = 100;
  static constexpr bool onDevice = true;
  template <class D>
  static auto make() {
    return Simulation{node<"root">(
        Gravity{{1, -9.81, 0}},
        EulerImplicitSolver{.rayleighStiffness = 0, .rayleighMass = 0.1},
        CGLinearSolver<>{.iterations = 20, .tolerance = 0},
        node<"body">(RegularGridTopology{.n = {4, 4, 4}, .min = {0, 0, 0}, .max = {1, 1, 1}},
                     MechanicalObject<D>{},
                     UniformMass<D>{.totalMass = 5},
                     RegularGridSpringForceField<D>{.stiffness = 200, .damping = 1},
                     PlaneForceField<D>{.d = -0.2, .stiffness = 500, .damping = 5},
                     PartialFixedConstraint<D>{.indices = {60, 61, 62, 63}, .fixedDirections = {1, 0, 1}}))};
  }
};

}  // namespace gpu_test
