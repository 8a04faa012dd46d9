// SPDX-License-Identifier: BSL-1.0
#pragma once

#include "laws/sample.hpp"

#include <sinew/force/interaction_ellipsoid_force_field.hpp>

namespace sample {

// spheres, which have an energy, on a body that is turned; others are tested by
// tests/force/interaction_ellipsoid_force_field.cpp
template <class D>
void prepare(InteractionEllipsoidForceField<D>& c, Random& random) {
  c.center = {vector<Eigen::Vector3d>(random), vector<Eigen::Vector3d>(random)};
  c.vradius = {Eigen::Vector3d::Constant(random(3, 4)), Eigen::Vector3d::Constant(random(2, 3))};
  c.frames = {coord<Rigid3d>(random, 0.5), coord<Rigid3d>(random, 0.5)};
  c.bodyIndex = random.index(2);
}
template <class D>
void complete(InteractionEllipsoidForceField<D>& c, Random&) {
  c.forcesOnBody = false;
}

}  // namespace sample
