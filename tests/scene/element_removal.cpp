// SPDX-License-Identifier: BSL-1.0
#include "element_removal.hpp"

namespace test_element_removal {

TEST_CASE("elements removed at random for thousands of steps: as scenes built afresh, matrix-free") {
  CHECK(removal::remove_at_random(3, 3000, 20, sinew::CGLinearSolver<>{.iterations = 10, .tolerance = 0}) >
        60);
}

}  // namespace test_element_removal
