// SPDX-License-Identifier: BSL-1.0
#pragma once

#include "laws/sample.hpp"

#include <sinew/mapping/deformable_on_rigid_frame_mapping.hpp>

namespace sample {

// 18 points of nine bodies
template <class... A>
constexpr std::size_t child_points(DeformableOnRigidFrameMapping<A...> const&) {
  return 18;
}
template <class... A>
void prepare(DeformableOnRigidFrameMapping<A...>& c, Random& random) {
  c.index = random.index(9);
  c.repartition.clear();
  if (random.index(2) == 0) c.repartition = {2};
  if (random.index(3) == 0) c.repartition = {1, 3, 0, 4, 2, 2, 2, 1, 3};
}

}  // namespace sample
