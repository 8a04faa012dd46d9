// SPDX-License-Identifier: BSL-1.0
#pragma once

#include "laws/sample.hpp"

#include <sinew/force/gear_spring.hpp>

namespace sample {

// the tangent is the symmetric part of the derivative, which is all of it only where there is no torque:
// torques are tested by tests/force/gear_spring.cpp
template <class... A>
void prepare(GearSpringForceField<A...>& c, Random& random) {
  for (auto& s : c.springs) {
    s.firstParent =
        (s.first + 1) % Body::n;  // bearings in the world are tested by tests/force/gear_spring.cpp
    if (s.second == s.first) s.second = (s.first + 2) % Body::n;
    if (s.secondParent == s.second) s.secondParent = (s.second + 1) % Body::n;
    s.stiffnessRotation = {0, 0};
    for (int& axis : s.freeAxis) axis = random.index(3);
    s.ratio = random(0.5, 2) * (random.index(2) == 0 ? 1 : -1);
  }
}

}  // namespace sample
