// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/force/angular_spring.hpp>

namespace gpu_test {

using namespace sinew;

struct AngularSprings {
  static constexpr int variants = 1;
  template <class D>
  static auto make(int) {
    return AngularSpringForceField<D>{.indices = {1, 2, 3, 4, 7, 9, 20, 41, 59}, .angularStiffness = {30}};
  }
};

}  // namespace gpu_test
