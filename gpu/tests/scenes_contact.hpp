// SPDX-License-Identifier: BSL-1.0
#pragma once

#include "scenes.hpp"

#include <sinew/constraint/fixed_constraint.hpp>
#include <sinew/constraint/partial_fixed.hpp>
#include <sinew/force/tetrahedron_fem.hpp>
#include <sinew/lagrangian.hpp>
#include <sinew/solver/cg_linear_solver.hpp>
#include <sinew/solver/euler_implicit.hpp>
#include <sinew/topology/mesh_topology.hpp>
#include <sinew/topology/regular_grid.hpp>

namespace gpu_test {

/// A soft block of 1 x 1 x 0.5 m and `mass` kg on the plane z = 0, whose lowest points touch it.
struct BlockOnPlane {
  static constexpr double mass = 500, g = 9.81;
  int cells = 3;
  double slope = 0, mu = 0.2;  // of the plane [rad]: gravity is turned
  double linearTolerance = 1e-12;

  Mesh mesh() const {
    return regular_grid_tetrahedra(cells + 1, cells + 1, cells / 2 + 1, {0, 0, 0}, {1, 1, 0.5});
  }
  template <class Wanted>
  static std::vector<int> points(Mesh const& m, Wanted&& wanted) {
    std::vector<int> all;
    for (std::size_t i = 0; i < m.positions.size(); ++i)
      if (wanted(m.positions[i])) all.push_back(int(i));
    return all;
  }
  static std::vector<int> bottom(Mesh const& m) {
    return points(m, [](auto const& x) { return x[2] < 1e-9; });
  }
  Gravity gravity() const { return {{g * std::sin(slope), 0, -g * std::cos(slope)}}; }

  template <class D, class E>
  static auto contacts(std::vector<int> first, std::vector<int> second, double friction) {
    return UnilateralLagrangianConstraint<D, E>{.first_point = std::move(first),
                                                .second_point = std::move(second),
                                                .normal = {{0, 0, 1}},
                                                .mu = {friction}};
  }
  template <class D>
  auto onGround(double friction) const {
    const std::vector<int> touching = bottom(mesh());
    return contacts<D, Between<"ground", "body">>(std::vector<int>(touching.size(), 0), touching, friction);
  }
  template <class D>
  static auto ground() {
    return node<"ground">(MechanicalObject<D>{.position = {{0, 0, 0}}});
  }
  static ConvexConstraintSolver solver() { return {.tolerance = 1e-12, .momentumTolerance = 1e-12}; }
  static EulerImplicitSolver ode() { return {.rayleighStiffness = 0.02}; }
  template <class Linear = CGLinearSolver<>>
  Linear linear() const {
    return {.iterations = 200, .tolerance = linearTolerance};
  }
  template <class D>
  static auto material() {
    return TetrahedronFEMForceField<D>{.youngModulus = {2e5}, .poissonRatio = 0.3};
  }

  template <class D, class Linear = CGLinearSolver<>>
  auto make() const {
    const Mesh m = mesh();
    return Simulation{
        node<"root">(FreeMotionAnimationLoop{},
                     solver(),
                     gravity(),
                     onGround<D>(mu),
                     ground<D>(),
                     node<"body">(ode(),
                                  linear<Linear>(),
                                  MeshTopology{.position = m.positions, .tetrahedra = m.tetrahedra},
                                  MechanicalObject<D>{},
                                  UniformMass<D>{.totalMass = mass},
                                  material<D>()))};
  }
};

/// It slides.
struct SlidingBlock : OneBody {
  static constexpr double dt = 0.01;
  static constexpr int steps = 30;
  static constexpr bool onDevice = false;  // the host looks at the contacts
  template <class D>
  static auto make() {
    return BlockOnPlane{.slope = 0.3, .mu = 0.2}.make<D>();
  }
};

/// It is held at a side and, in one direction, at another one; some contacts stick, some slide, some open.
struct HeldBlock : OneBody {
  static constexpr double dt = 0.01;
  static constexpr int steps = 30;
  static constexpr bool onDevice = false;
  template <class D>
  static auto make() {
    const BlockOnPlane b{.slope = 0.7, .mu = 0.3};
    const Mesh m = b.mesh();
    return Simulation{node<"root">(
        FreeMotionAnimationLoop{},
        b.solver(),
        b.gravity(),
        b.onGround<D>(b.mu),
        b.ground<D>(),
        node<"body">(b.ode(),
                     b.linear(),
                     MeshTopology{.position = m.positions, .tetrahedra = m.tetrahedra},
                     MechanicalObject<D>{},
                     UniformMass<D>{.totalMass = b.mass},
                     TetrahedronFEMForceField<D>{.youngModulus = {2e4}, .poissonRatio = 0.3},
                     FixedConstraint<D>{
                         .indices = b.points(m, [](auto const& x) { return x[0] < 1e-9 && x[2] > 0.1; })},
                     PartialFixedConstraint<D>{
                         .indices = b.points(m, [](auto const& x) { return x[1] > 0.99 && x[2] > 0.1; }),
                         .fixedDirections = {true, false, false}}))};
  }
};

/// Two of them on each other under a solver each, the upper one turned by gravity to slide first.
struct StackedBlocks {
  static constexpr double dt = 0.01;
  static constexpr int steps = 40;
  static constexpr bool onDevice = false;
  template <class D>
  static auto make() {
    const BlockOnPlane b{.cells = 2, .slope = 0.25};
    const Mesh m = b.mesh();
    auto above = m.positions;
    for (auto& x : above) x[2] += 0.5;
    return Simulation{
        node<"root">(FreeMotionAnimationLoop{},
                     b.solver(),
                     b.gravity(),
                     b.onGround<D>(0.4),
                     b.contacts<D, Between<"body", "upper">>(
                         b.points(m, [](auto const& x) { return x[2] > 0.49; }), b.bottom(m), 0.1),
                     b.ground<D>(),
                     body<"body", D>(b, m, m.positions),
                     body<"upper", D>(b, m, above))};
  }
  template <class Sim, class F>
  static void each(Sim& sim, F&& f) {
    f(sim.template at<"body">().state());
    f(sim.template at<"upper">().state());
  }

 private:
  template <FixedString Name, class D>
  static auto body(BlockOnPlane const& b, Mesh const& m, std::vector<Eigen::Vector3d> const& positions) {
    return node<Name>(b.ode(),
                      b.linear(),
                      MeshTopology{.position = positions, .tetrahedra = m.tetrahedra},
                      MechanicalObject<D>{},
                      UniformMass<D>{.totalMass = b.mass},
                      b.material<D>());
  }
};

}  // namespace gpu_test
