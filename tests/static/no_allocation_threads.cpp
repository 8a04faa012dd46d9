// SPDX-License-Identifier: BSL-1.0
// Counts every allocation of any thread while scenes with several step after init.
#include "static/allocations.hpp"

#include "catch.hpp"

#include <sinew/constraint/fixed_constraint.hpp>
#include <sinew/context/gravity.hpp>
#include <sinew/control/threads.hpp>
#include <sinew/force/tetrahedron_fem.hpp>
#include <sinew/mass/uniform_mass.hpp>
#include <sinew/scene/simulation.hpp>
#include <sinew/solver/cg_linear_solver.hpp>
#include <sinew/solver/euler_implicit.hpp>
#include <sinew/state/mechanical_object.hpp>
#include <sinew/topology/regular_grid.hpp>
#include <sinew/topology/tetrahedron_topology.hpp>

#include <type_traits>

using namespace sinew;

TEST_CASE("no step of several threads allocates, in any of them") {
  const Mesh mesh = regular_grid_tetrahedra(9, 9, 9, {0, 0, 0}, {1, 1, 1});
  auto count = [&]<class D>(std::type_identity<D>, auto linear) {
    typename D::VecCoord points;
    for (auto const& p : mesh.positions) points.push_back(p.template cast<typename D::Real>());
    Simulation sim{node<"root">(Threads{.count = 2},
                                Gravity{},
                                EulerImplicitSolver{},
                                linear,
                                TetrahedronTopology{mesh.tetrahedra},
                                MechanicalObject<D>{points},
                                UniformMass<D>{},
                                TetrahedronFEMForceField<D>{},
                                FixedConstraint<D>{.indices = {0, 1, 2}})};
    sim.init();
    CHECK(sim.root().template first<role::ForceField>().driver.shares == 2);
    const long before = allocations;
    for (int i = 0; i < 20; ++i) sim.animate(0.001);
    return allocations - before;
  };
  constexpr std::type_identity<Vec3d> doubles;
  CHECK(count(doubles, CGLinearSolver<>{.iterations = 5}) == 0);
  CHECK(count(doubles, CGLinearSolver<CompressedRowSparseMatrixMat3x3d>{.iterations = 5}) == 0);
  // in float rows of the matrix are sliced on any processor
  CHECK(count(std::type_identity<Vec3f>{},
              CGLinearSolver<CompressedRowSparseMatrixMat3x3f>{.iterations = 5}) == 0);
}
