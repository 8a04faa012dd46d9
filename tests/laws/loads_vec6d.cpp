// SPDX-License-Identifier: BSL-1.0
#include "force_laws.hpp"

TEST_CASE("loads over Vec6d obey the laws of forces") {
  laws::check_force_fields<sinew::PointLoads<sinew::Vec6d>, sinew::Vec6d>();
}
