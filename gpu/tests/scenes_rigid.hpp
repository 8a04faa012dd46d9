// SPDX-License-Identifier: BSL-1.0
#pragma once

#include "scenes.hpp"

#include <sinew/constraint/fixed_constraint.hpp>
#include <sinew/force/angular_spring.hpp>
#include <sinew/solver/cg_linear_solver.hpp>
#include <sinew/solver/euler_implicit.hpp>
#include <sinew/solver/runge_kutta4.hpp>

namespace gpu_test {

/// A body that tumbles about its middle axis while it flies, and another.
struct Tumbling : OneBody {
  static constexpr double dt = 0.01;
  static constexpr int steps = 100;
  static constexpr bool onDevice = true;
  template <class D>
  static auto make() {
    using Deriv = typename D::Deriv;
    typename D::MassType mass;
    mass.mass = 2;
    mass.inertia.setZero();
    for (int c = 0; c < 3; ++c) mass.inertia(c, c) = typename D::Real(c + 1);
    Deriv one, other;
    one << 1, 4, 0, 0.3, 2, 0.1;
    other << 0, 5, 1, 1, 0.2, 3;
    return Simulation{node<"root">(
        Gravity{{0, -9.81, 0}},
        RungeKutta4Solver{},
        node<"body">(MechanicalObject<D>{.position = {D::zero(), D::zero()}, .velocity = {one, other}},
                     UniformMass<D>{.vertexMass = mass}))};
  }
};

/// Bodies whose orientations hang together, the first one held.
struct AngularChain : OneBody {
  static constexpr double dt = 0.01;
  static constexpr int steps = 100;
  static constexpr bool onDevice = true;
  template <class D>
  static auto make() {
    typename D::VecCoord x;
    typename D::Deriv v;
    v << 0.5, 0, 0, 0, 0, 3;
    for (int i = 0; i < 5; ++i) {
      x.push_back(D::zero());
      D::setCenter(x.back(), {typename D::Real(i), 0, 0});
    }
    return Simulation{node<"root">(
        EulerImplicitSolver{},
        CGLinearSolver<>{.iterations = 30, .tolerance = 0},
        node<"body">(MechanicalObject<D>{.position = x, .velocity = {v}},
                     UniformMass<D>{},
                     AngularSpringForceField<D>{.indices = {0, 1, 2, 3, 4}, .angularStiffness = {40}},
                     FixedConstraint<D>{.indices = {0}, .activateProjectVelocity = true}))};
  }
};

}  // namespace gpu_test
