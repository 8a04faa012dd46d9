// SPDX-License-Identifier: BSL-1.0
#include "collision/known_contacts.hpp"

namespace test_time_of_impact {

using namespace known_contacts;

TEST_CASE("time_of_impact is never late and hardly early", "[collision]") {
  const int pairs = manyPairs / 10;
  check_known<double, 1, 1>(pairs);
  check_known<double, 1, 2>(pairs);
  check_known<double, 1, 3>(pairs);
  check_known<double, 2, 1>(pairs / 10);
  check_known<double, 2, 2>(pairs);
  check_known<double, 2, 3>(pairs / 2);
  check_known<double, 3, 1>(pairs / 10);
  check_known<double, 3, 2>(pairs / 10);
  check_known<double, 3, 3>(pairs / 5);
}

}  // namespace test_time_of_impact
