// SPDX-License-Identifier: BSL-1.0
#include "same_bits.hpp"
#include "string_on_rigid/scene.hpp"

namespace test_same_bits_string {

using namespace sinew;

TEST_CASE("a string on a rigid body: typed and runtime tree have the same bits, explicit") {
  same_bits::check(examples::string_on_rigid(EulerExplicitSolver{}), 0.001);
  same_bits::check(examples::string_on_rigid(RungeKutta4Solver{}), 0.001);
}

TEST_CASE("a string on a rigid body: typed and runtime tree have the same bits, implicit") {
  same_bits::check(examples::string_on_rigid(EulerImplicitSolver{}, CGLinearSolver<>{}), 0.01);
}

TEST_CASE("a string on a rigid body: typed and runtime tree have the same bits, assembled through mappings") {
  same_bits::check(
      examples::string_on_rigid(EulerImplicitSolver{}, CGLinearSolver<CompressedRowSparseMatrixMat3x3d>{}),
      0.01);
  same_bits::check(
      examples::string_on_rigid(EulerImplicitSolver{}, CGLinearSolver<CompressedRowSparseMatrixd>{}), 0.01);
}

}  // namespace test_same_bits_string
