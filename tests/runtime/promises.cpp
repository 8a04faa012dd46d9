// SPDX-License-Identifier: BSL-1.0
#include "catch.hpp"

#include <sinew/registry.hpp>

namespace test_promises {

using namespace sinew;

TEST_CASE("every class of the registry keeps the promise of its role, and can be assembled") {
  int classes = 0;
  for_each_registered<Extended>([&]<class C>() {
    static_assert(keeps_promise<C>);
    static_assert(Promise<typename C::Role>::template assembled<C>);
    ++classes;
  });
  CHECK(classes > 300);
}

}  // namespace test_promises
