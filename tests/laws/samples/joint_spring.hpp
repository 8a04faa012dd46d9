// SPDX-License-Identifier: BSL-1.0
#pragma once

#include "laws/sample.hpp"

#include <sinew/force/joint_spring.hpp>

namespace sample {

// the tangent holds the axes of joints, which then count only where all are as stiff: torques are tested by
// tests/force/joint_spring.cpp
template <class... A>
void prepare(JointSpringForceField<A...>& c, Random& random) {
  for (auto& s : c.springs) {
    if (s.first == s.second) s.second = (s.first + 1) % Body::n;
    s.limitX = s.limitY = s.limitZ = {-10, 10};
    s.stiffnessTranslation.fill(random(1, 2));
    s.stiffnessRotation.fill(0);
    s.stiffnessLimit = 0;
  }
}

}  // namespace sample
