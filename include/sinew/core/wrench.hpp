// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/core/platform.hpp>

#include <Eigen/Core>

namespace sinew {

/// Force [N] and torque [N m].
struct Wrench {
  Eigen::Vector3d force{0, 0, 0}, torque{0, 0, 0};
};

}  // namespace sinew
