// SPDX-License-Identifier: BSL-1.0
#pragma once

#include "laws/sample.hpp"

#include <sinew/force/frame_spring.hpp>

namespace sample {

// between the centres, whose tangent is exact: the torques of arms and angles are tested by
// tests/force/frame_spring.cpp
template <class... A>
void prepare(FrameSpringForceField<A...>& c, Random&) {
  for (auto& s : c.springs) {
    if (s.first == s.second) s.second = (s.first + 1) % Body::n;
    s.firstPoint.setZero();
    s.secondPoint.setZero();
    s.stiffnessRotation = 0;
  }
}

}  // namespace sample
