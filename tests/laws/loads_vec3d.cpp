// SPDX-License-Identifier: BSL-1.0
#include "force_laws.hpp"

TEST_CASE("loads over Vec3d obey the laws of forces") {
  laws::check_force_fields<sinew::PointLoads<sinew::Vec3d>, sinew::Vec3d>();
  laws::check_force_fields<sinew::SpatialLoads<sinew::Vec3d>, sinew::Vec3d>();
}

TEST_CASE("fluids over Vec3d obey the laws of forces") {
  laws::check_force_fields<sinew::Fluids<sinew::Vec3d>, sinew::Vec3d>();
}
