// SPDX-License-Identifier: BSL-1.0
// The same of floats, and of springs.
#include "threaded_bodies.hpp"

#include <sinew/force/regular_grid_spring.hpp>
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

}  // namespace test_threads_float
