// SPDX-License-Identifier: BSL-1.0
#include "force_laws.hpp"

using namespace sinew;
using D = Vec3f;

// the other groups have files of their own, so that each builds in seconds
static_assert(
    laws::count_force_fields<Extended, D>() ==
        laws::count_force_fields<Registry<PointSprings<D>, PointLoads<D>, SpatialLoads<D>, ElementForces<D>,
                                          HyperelasticForces<D>, SpatialSprings<D>, Fluids<D>>,
                                 D>(),
    "a force field over Vec3f is in no group that the laws are run on");

TEST_CASE("springs over Vec3f obey the laws of forces") { laws::check_force_fields<PointSprings<D>, D>(); }
