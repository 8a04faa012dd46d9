// SPDX-License-Identifier: BSL-1.0
#include "constraint_laws.hpp"

using namespace sinew;

TEST_CASE("states on a trajectory are held as by a projector, and move as they say") {
  laws::check_constraints<Playback<Vec1d>, Vec1d>();
  laws::check_constraints<Playback<Vec3d>, Vec3d>();
  laws::check_constraints<Playback<Rigid2d>, Rigid2d>();
  laws::check_constraints<Playback<Rigid3d>, Rigid3d>();
  laws::check_constraints<Playback<Rigid3f>, Rigid3f>();
}
