// SPDX-License-Identifier: BSL-1.0
#include "element_removal.hpp"

namespace test_element_removal_direct {

TEST_CASE("elements removed at random for thousands of steps: as scenes built afresh, with a direct solver") {
  CHECK(removal::remove_at_random(
            3, 2000, 16, sinew::SparseLDLSolver<sinew::CompressedRowSparseMatrixMat3x3d>{}) > 60);
}

}  // namespace test_element_removal_direct
