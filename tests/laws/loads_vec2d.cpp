// SPDX-License-Identifier: BSL-1.0
#include "force_laws.hpp"

TEST_CASE("loads over Vec2d obey the laws of forces") {
  laws::check_force_fields<sinew::PointLoads<sinew::Vec2d>, sinew::Vec2d>();
}
