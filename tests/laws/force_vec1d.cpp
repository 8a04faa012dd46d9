// SPDX-License-Identifier: BSL-1.0
#include "force_laws.hpp"

using namespace sinew;
using D = Vec1d;

// the other groups have files of their own, so that each builds in seconds
static_assert(laws::count_force_fields<Extended, D>() ==
                  laws::count_force_fields<Registry<PointSprings<D>, PointLoads<D>, BodyFields<D>>, D>(),
              "a force field over Vec1d is in no group that the laws are run on");

TEST_CASE("springs over Vec1d obey the laws of forces") { laws::check_force_fields<PointSprings<D>, D>(); }

TEST_CASE("diffusion over Vec1d obeys the laws of forces") { laws::check_force_fields<BodyFields<D>, D>(); }
