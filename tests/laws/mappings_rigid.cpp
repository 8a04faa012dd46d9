// SPDX-License-Identifier: BSL-1.0
#include "mapping_laws.hpp"

TEST_CASE("every mapping from rigid bodies obeys the laws of mappings") {
  laws::check_mappings<sinew::Extended, true>();
}
