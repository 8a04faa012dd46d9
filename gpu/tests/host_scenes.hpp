// SPDX-License-Identifier: BSL-1.0
#pragma once

// For host_scenes_*.cpp, which instantiate on_host.

#include "scenes.hpp"

namespace gpu_test {

template <class Scene, class H>
Course on_host() {
  return run<Scene, H>([] {});
}

}  // namespace gpu_test
