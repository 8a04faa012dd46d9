// SPDX-License-Identifier: BSL-1.0
#include "force_laws.hpp"

TEST_CASE("forces of hyperelastic and viscoelastic bodies over Vec3d obey the laws of forces") {
  laws::check_force_fields<sinew::HyperelasticForces<sinew::Vec3d>, sinew::Vec3d>();
}
