// SPDX-License-Identifier: BSL-1.0
#include "collision/known_contacts.hpp"

namespace test_time_of_impact_float {

using namespace known_contacts;

TEST_CASE("time_of_impact is never late and hardly early in floats", "[collision]") {
  const int pairs = manyPairs / 20;
  check_known<float, 1, 2>(pairs);
  check_known<float, 1, 3>(pairs);
  check_known<float, 2, 2>(pairs);
  check_known<float, 3, 3>(pairs / 4);
}

}  // namespace test_time_of_impact_float
