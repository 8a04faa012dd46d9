// SPDX-License-Identifier: BSL-1.0
#include "catch.hpp"
#include "registry_scene.hpp"

#include <sinew/constraint/fixed_plane.hpp>
#include <sinew/constraint/partial_fixed.hpp>
#include <sinew/constraint/project_to_line.hpp>
#include <sinew/sinew.hpp>
#include <sinew/topology/regular_grid.hpp>

namespace test_constrained_systems {

using namespace sinew;

namespace {

/// A hanging block, three of its points held in skew directions, after some steps with one linear solver.
template <class Linear>
Vec3d::VecCoord fallen(Linear linear) {
  const Mesh mesh = regular_grid_tetrahedra(4, 3, 3, {0, 0, 0}, {3, 2, 2});
  linear.iterations = 400;
  linear.tolerance = 1e-13;
  RegistryScene sim{node<"root">(
      Gravity{{1, -9.81, 2}},
      EulerImplicitSolver{.rayleighStiffness = 0.01},
      linear,
      TetrahedronTopology{mesh.tetrahedra},
      MechanicalObject<Vec3d>{mesh.positions},
      UniformMass<Vec3d>{.totalMass = 10},
      TetrahedronFEMForceField<Vec3d>{.youngModulus = {3000}, .poissonRatio = 0.3},
      FixedPlaneConstraint<Vec3d>{.direction = {1, 2, 0}, .dmin = -0.5, .dmax = 0.5},
      PartialFixedConstraint<Vec3d>{.indices = {7}, .fixedDirections = {0, 1, 0}},
      ProjectToLineConstraint<Vec3d>{.indices = {20}, .origin = mesh.positions[20], .direction = {1, 2, 3}})};
  sim.init();
  for (int i = 0; i < 20; ++i) sim.animate(0.02);
  auto const& x = sim.root().state().position;
  // what the constraints hold has not moved; the rest has
  for (std::size_t i = 0; i < x.size(); ++i) {
    const Eigen::Vector3d d = x[i] - mesh.positions[i];
    const double across = mesh.positions[i].dot(Eigen::Vector3d(1, 2, 0));
    if (across > -0.5 && across < 0.5) CHECK(std::abs(d.dot(Eigen::Vector3d(1, 2, 0))) < 1e-12);
    CHECK(d.norm() > 1e-4);
  }
  CHECK(x[7][1] == mesh.positions[7][1]);
  CHECK((x[20] - mesh.positions[20]).cross(Eigen::Vector3d(1, 2, 3)).norm() < 1e-12);
  return x;
}

}  // namespace

TEST_CASE("oblique constraints: matrix-free and assembled solvers agree") {
  const auto free = fallen(CGLinearSolver<>{}),
             blocks = fallen(CGLinearSolver<CompressedRowSparseMatrixMat3x3d>{}),
             scalars = fallen(CGLinearSolver<CompressedRowSparseMatrixd>{});
  // each solve is good to 1e-13 of its right-hand side
  for (std::size_t i = 0; i < free.size(); ++i) {
    CHECK((free[i] - blocks[i]).norm() < 1e-10);
    CHECK((free[i] - scalars[i]).norm() < 1e-10);
  }
}

}  // namespace test_constrained_systems
