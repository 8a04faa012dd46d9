// SPDX-License-Identifier: BSL-1.0
#pragma once

#include "scenes.hpp"

#include <sinew/constraint/fixed_constraint.hpp>
#include <sinew/constraint/partial_fixed.hpp>
#include <sinew/force/constant_force.hpp>
#include <sinew/force/plane_force_field.hpp>
#include <sinew/force/rest_shape_springs.hpp>
#include <sinew/force/tetrahedron_fem.hpp>
#include <sinew/mapping/identity_mapping.hpp>
#include <sinew/solver/cg_linear_solver.hpp>
#include <sinew/solver/euler_implicit.hpp>
#include <sinew/solver/pcg_linear_solver.hpp>
#include <sinew/topology/mesh_topology.hpp>
#include <sinew/topology/regular_grid.hpp>

#include <tuple>
#include <type_traits>

namespace gpu_test {

/// A bar that is a hundred times stiffer at one end than at the other, held at the stiff one, on rails there
/// and pressed into a floor at the other, solved with few iterations: another preconditioner gives another
/// motion. (The matrix is no part of the type: nvcc has another.)
template <PreconditionerMethod Method, bool Use = true, int Iterations = 8, bool Assembled = false>
struct Preconditioned : OneBody {
  static constexpr double dt = 0.02;
  static constexpr int steps = 20;
  static constexpr bool onDevice = true;
  template <class D>
  static auto make() {
    using Matrix = std::conditional_t<Assembled, CompressedRowSparseMatrixMat3x3d, GraphScattered>;
    const Mesh mesh = regular_grid_tetrahedra(7, 3, 3, {0, 0, 0}, {3, 1, 1});
    std::vector<int> fixed, rails;
    std::vector<typename D::Real> stiffness;
    for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
      if (mesh.positions[i][0] < 0.01) fixed.push_back(int(i));
      if (mesh.positions[i][0] > 0.4 && mesh.positions[i][0] < 0.6) rails.push_back(int(i));
    }
    for (auto const& t : mesh.tetrahedra)
      stiffness.push_back(mesh.positions[std::size_t(t[0])][0] < 1.4 ? typename D::Real(1e6)
                                                                     : typename D::Real(1e4));
    return Simulation{node<"root">(
        Gravity{{0, -9.81, 0}},
        EulerImplicitSolver{.rayleighStiffness = 0.01, .rayleighMass = 0.1},
        ShewchukPCGLinearSolver<Matrix>{
            .iterations = Iterations, .tolerance = 0, .usePrecond = Use, .precondition = Method},
        node<"body">(MeshTopology{.position = mesh.positions, .tetrahedra = mesh.tetrahedra},
                     MechanicalObject<D>{},
                     UniformMass<D>{.totalMass = 300},
                     TetrahedronFEMForceField<D>{.youngModulus = {stiffness.begin(), stiffness.end()},
                                                 .poissonRatio = 0.4},
                     PlaneForceField<D>{.normal = {0, 1, 0}, .d = -0.1, .stiffness = 1e4, .damping = 10},
                     FixedConstraint<D>{.indices = fixed},
                     PartialFixedConstraint<D>{.indices = rails, .fixedDirections = {true, false, false}}))};
  }
};
using BlockJacobiBar = Preconditioned<PreconditionerMethod::blockJacobi>;
using JacobiBar = Preconditioned<PreconditionerMethod::jacobi>;
using PlainBar = Preconditioned<PreconditionerMethod::blockJacobi, false>;
using AssembledBar = Preconditioned<PreconditionerMethod::blockJacobi, true, 8, true>;

/// Two bars under one solver whose matrix is assembled; with points mapped to one of them, and pushed, the
/// host has to assemble it.
template <bool Mapped>
struct TwoAssembled {
  static constexpr double dt = 0.02;
  static constexpr int steps = 20;
  static constexpr bool onDevice = !Mapped;
  template <class Sim, class F>
  static void each(Sim& sim, F&& f) {
    f(sim.template at<"a">().state());
    f(sim.template at<"b">().state());
  }
  template <class D>
  static auto make() {
    const Mesh mesh = regular_grid_tetrahedra(4, 3, 2, {0, 0, 0}, {2, 1, 1});
    auto parts = [&](double youngModulus) {
      return std::tuple(MeshTopology{.position = mesh.positions, .tetrahedra = mesh.tetrahedra},
                        MechanicalObject<D>{},
                        UniformMass<D>{.totalMass = 100},
                        TetrahedronFEMForceField<D>{.youngModulus = {youngModulus}, .poissonRatio = 0.3},
                        FixedConstraint<D>{.indices = {0, 4, 8, 12, 16, 20}});
    };
    [[maybe_unused]] const ConstantForceField<D> push{.indices = {3, 7}, .force = {{5, 20, 1}}};
    auto a = std::apply([](auto... c) { return node<"a">(c...); }, parts(1e6));
    auto b = std::apply(
        [&](auto... c) {
          if constexpr (Mapped)
            return node<"b">(c..., node<"child">(MechanicalObject<D>{}, IdentityMapping<D, D>{}, push));
          else
            return node<"b">(c...);
        },
        parts(2e5));
    // solved to the end: on the way the iterates of this system carry rounding of 1e-8
    return Simulation{
        node<"root">(Gravity{{0, -9.81, 0}},
                     EulerImplicitSolver{.rayleighStiffness = 0.01},
                     CGLinearSolver<CompressedRowSparseMatrixMat3x3d>{.iterations = 300, .tolerance = 0},
                     std::move(a),
                     std::move(b))};
  }
};

/// Points that the host pushes, and that have no elements: a matrix of masses alone.
struct LoosePoints : OneBody {
  static constexpr double dt = 0.02;
  static constexpr int steps = 5;
  static constexpr bool onDevice = false;
  template <class D>
  static auto make() {
    typename D::VecCoord at;
    for (int i = 0; i < 40; ++i) at.push_back({typename D::Real(0.02 * i), 0, 0});
    return Simulation{
        node<"root">(Gravity{{0, -9.81, 0}},
                     EulerImplicitSolver{},
                     CGLinearSolver<CompressedRowSparseMatrixMat3x3d>{.iterations = 3, .tolerance = 0},
                     node<"body">(MechanicalObject<D>{.position = at},
                                  UniformMass<D>{.vertexMass = 2},
                                  ConstantForceField<D>{.indices = {3, 39}, .force = {{5, 20, 1}}}))};
  }
};

/// Rigid bodies of unlike inertia on springs to where they are at rest: blocks of six.
struct RigidsOnSprings : OneBody {
  static constexpr double dt = 0.02;
  static constexpr int steps = 20;
  static constexpr bool onDevice = true;
  template <class D>
  static auto make() {
    using Real = typename D::Real;
    std::vector<typename D::Coord> at;
    std::vector<typename D::Deriv> v;
    for (int i = 0; i < 5; ++i) {
      typename D::Coord c{};
      c.center = {Real(i), Real(0), Real(0)};
      at.push_back(c);
      typename D::Deriv w;
      w << Real(0), Real(0.1 * i), Real(0), Real(1), Real(0.2 * i), Real(-0.5);
      v.push_back(w);
    }
    typename D::MassType mass{};
    mass.mass = Real(2);
    mass.inertia = (Eigen::Matrix<Real, 3, 1>(Real(0.1), Real(0.4), Real(2))).asDiagonal();
    return Simulation{node<"root">(
        EulerImplicitSolver{},
        ShewchukPCGLinearSolver<>{.iterations = 3, .tolerance = 0},
        node<"body">(MechanicalObject<D>{.position = at, .velocity = v},
                     UniformMass<D>{.vertexMass = mass},
                     RestShapeSpringsForceField<D>{.stiffness = {40}, .angularStiffness = {5}}))};
  }
};

}  // namespace gpu_test
