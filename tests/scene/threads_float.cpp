// SPDX-License-Identifier: BSL-1.0
// The same of floats, of springs, and of loads on points.
#include "threaded_bodies.hpp"

#include <sinew/force/plane_force_field.hpp>
#include <sinew/force/regular_grid_spring.hpp>
#include <sinew/force/sphere_force_field.hpp>
#include <sinew/topology/regular_grid_topology.hpp>

namespace test_threads_float {

using namespace sinew;
using namespace threaded;

TEST_CASE("a body of floats has the same bits with any number of threads", "[threads]") {
  const Mesh mesh = block();
  same_bits([&](int n) { return fem<Vec3f, CompressedRowSparseMatrixMat3x3f>(mesh, n); });
}

TEST_CASE("a grid of springs has the same bits with any number of threads", "[threads]") {
  same_bits([](int threads) {
    return Simulation{
        node<"root">(Threads{.count = threads},
                     Gravity{},
                     EulerImplicitSolver{.rayleighMass = 0.1},
                     CGLinearSolver<CompressedRowSparseMatrixMat3x3d>{.iterations = 8, .tolerance = 0},
                     RegularGridTopology{.n = {11, 12, 20}, .max = {10, 11, 19}},
                     MechanicalObject<Vec3d>{},
                     UniformMass<Vec3d>{.totalMass = 1},
                     RegularGridSpringForceField<Vec3d>{.stiffness = 4500, .damping = 1},
                     FixedConstraint<Vec3d>{.indices = {0, 1, 2, 3}})};
  });
}

TEST_CASE("points that meet a plane and a sphere have the same bits with any number of threads",
          "[threads]") {
  // half of 16,000 points are behind the plane at the start, and some in the sphere: above 4,096 they are
  // shared out
  same_bits([](int threads) {
    return Simulation{
        node<"root">(Threads{.count = threads},
                     Gravity{},
                     EulerImplicitSolver{},
                     CGLinearSolver<CompressedRowSparseMatrixMat3x3d>{.iterations = 8, .tolerance = 0},
                     RegularGridTopology{.n = {20, 40, 20}, .min = {0, -1, 0}, .max = {1, 1, 1}},
                     MechanicalObject<Vec3d>{},
                     UniformMass<Vec3d>{.totalMass = 1},
                     PlaneForceField<Vec3d>{.normal = {0.1, 1, 0.2}, .stiffness = 3},
                     SphereForceField<Vec3d>{.center = {0.5, 0.5, 0.5}, .radius = 0.4, .stiffness = 2})};
  });
}

}  // namespace test_threads_float
