// SPDX-License-Identifier: BSL-1.0
#include "families_of.hpp"

std::vector<bench::Work> bench::in_float_one_by_one() { return forces<WithLanes<Vec3f, 1>>(); }
