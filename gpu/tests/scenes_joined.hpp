// SPDX-License-Identifier: BSL-1.0
#pragma once

#include "scenes.hpp"

#include <sinew/constraint/fixed_constraint.hpp>
#include <sinew/force/constant_force.hpp>
#include <sinew/force/regular_grid_spring.hpp>
#include <sinew/force/stiff_spring.hpp>
#include <sinew/solver/cg_linear_solver.hpp>
#include <sinew/solver/cholesky_solver.hpp>
#include <sinew/solver/euler_implicit.hpp>
#include <sinew/topology/regular_grid_topology.hpp>

namespace gpu_test {

/// Two blocks of springs under one solver, joined by springs.
struct TwoBlocks {
  static constexpr double dt = 0.01;
  static constexpr int steps = 100;
  static constexpr bool onDevice = true;
  template <FixedString Name, class D>
  static auto block(double x, std::vector<int> fixed) {
    return node<Name>(RegularGridTopology{.n = {3, 3, 3}, .min = {x, 0, 0}, .max = {x + 1, 1, 1}},
                      MechanicalObject<D>{},
                      UniformMass<D>{.totalMass = 5},
                      RegularGridSpringForceField<D>{.stiffness = 300, .damping = 1},
                      FixedConstraint<D>{.indices = fixed});
  }
  template <class D>
  static auto make() {
    return Simulation{node<"root">(
        Gravity{{0, -9.81, 0}},
        EulerImplicitSolver{},
        CGLinearSolver<>{.iterations = 25, .tolerance = 0},
        StiffSpringForceField<D, Between<"a", "b">>{
            {{2, 0, 200, 1, {}}, {11, 9, 200, 1, {}}, {26, 24, 200, 1, {}}, {26, 18, 50, 0, 1.0}}},
        block<"a", D>(0, {0, 3, 6, 9, 12, 15, 18, 21, 24}),
        block<"b", D>(1.5, {2}))};
  }
  template <class Sim, class F>
  static void each(Sim& sim, F&& f) {
    f(sim.template at<"a">().state());
    f(sim.template at<"b">().state());
  }
};

/// A component that works on the host: what it reads and writes crosses.
struct HostForce : OneBody {
  static constexpr double dt = 0.01;
  static constexpr int steps = 100;
  static constexpr bool onDevice = false;
  template <class D>
  static auto make() {
    return Simulation{
        node<"root">(EulerImplicitSolver{},
                     CGLinearSolver<>{.iterations = 25, .tolerance = 0},
                     node<"body">(RegularGridTopology{.n = {4, 3, 3}, .min = {0, 0, 0}, .max = {1, 1, 1}},
                                  MechanicalObject<D>{},
                                  UniformMass<D>{.totalMass = 5},
                                  RegularGridSpringForceField<D>{.stiffness = 300, .damping = 1},
                                  ConstantForceField<D>{.indices = {3, 7}, .force = {{5, 20, 1}}},
                                  FixedConstraint<D>{.indices = {0, 4, 8, 12}}))};
  }
};

/// A system that is assembled and solved on the host.
struct Assembled : OneBody {
  static constexpr double dt = 0.01;
  static constexpr int steps = 100;
  static constexpr bool onDevice = false;
  template <class D>
  static auto make() {
    return Simulation{
        node<"root">(Gravity{{0, -9.81, 0}},
                     EulerImplicitSolver{},
                     CholeskySolver<>{},
                     node<"body">(RegularGridTopology{.n = {4, 3, 3}, .min = {0, 0, 0}, .max = {1, 1, 1}},
                                  MechanicalObject<D>{},
                                  UniformMass<D>{.totalMass = 5},
                                  RegularGridSpringForceField<D>{.stiffness = 300, .damping = 1},
                                  FixedConstraint<D>{.indices = {0, 4, 8, 12}}))};
  }
};

}  // namespace gpu_test
