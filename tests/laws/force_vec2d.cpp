// SPDX-License-Identifier: BSL-1.0
#include "force_laws.hpp"

using namespace sinew;
using D = Vec2d;

// The other groups have files of their own, so that each builds in seconds. A solid in the plane needs closed
// lines, which a random body has not: tests/fluid/immersed_solid.cpp.
static_assert(laws::count_force_fields<Extended, D>() ==
                  laws::count_force_fields<Registry<PointSprings<D>, PointLoads<D>, ImmersedSolid<D>>, D>(),
              "a force field over Vec2d is in no group that the laws are run on");

TEST_CASE("springs over Vec2d obey the laws of forces") { laws::check_force_fields<PointSprings<D>, D>(); }
