// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/force/plane_force_field.hpp>
#include <sinew/force/regular_grid_spring.hpp>
#include <sinew/force/sphere_force_field.hpp>

namespace gpu_test {

using namespace sinew;

/// Springs of a grid, two-way or as strings.
struct GridSprings {
  static constexpr int variants = 2;
  template <class D>
  static auto make(int v) {
    return RegularGridSpringForceField<D>{.stiffness = 100, .damping = 3, .elongationOnly = v == 1};
  }
};

/// One-sided, two-sided, with the force limited.
struct PenaltyPlane {
  static constexpr int variants = 3;
  template <class D>
  static auto make(int v) {
    return PlaneForceField<D>{.normal = {0.3, 1, -0.2},
                              .d = 0.8,
                              .stiffness = 200,
                              .damping = 7,
                              .maxForce = v == 2 ? 60.0 : 0.0,
                              .bilateral = v == 1};
  }
};

struct PenaltySphere {
  static constexpr int variants = 2;
  template <class D>
  static auto make(int v) {
    return SphereForceField<D>{
        .center = {0.2, 0.9, 0.4}, .radius = 0.8, .stiffness = 300, .damping = 4, .bilateral = v == 1};
  }
};

}  // namespace gpu_test
