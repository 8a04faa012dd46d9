// SPDX-License-Identifier: BSL-1.0
#include "force_laws.hpp"

TEST_CASE("loads over Vec3f obey the laws of forces") {
  laws::check_force_fields<sinew::PointLoads<sinew::Vec3f>, sinew::Vec3f>();
  laws::check_force_fields<sinew::SpatialLoads<sinew::Vec3f>, sinew::Vec3f>();
}

TEST_CASE("fluids over Vec3f obey the laws of forces") {
  laws::check_force_fields<sinew::Fluids<sinew::Vec3f>, sinew::Vec3f>();
}
