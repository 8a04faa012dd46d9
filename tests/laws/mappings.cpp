// SPDX-License-Identifier: BSL-1.0
#include "mapping_laws.hpp"

TEST_CASE("every mapping obeys the laws of mappings") {
  int found = 0;
  sinew::for_each_registered<sinew::Extended>([&]<class C>() {
    if constexpr (sinew::HasRole<C, sinew::role::Mapping>) {
      laws::MappingSuite<C>{}.run();
      ++found;
    }
  });
  CHECK(found > 0);
}
