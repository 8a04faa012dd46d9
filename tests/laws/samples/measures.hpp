// SPDX-License-Identifier: BSL-1.0
#pragma once

#include "laws/sample.hpp"

#include <sinew/mapping/distance_from_target_mapping.hpp>
#include <sinew/mapping/distance_to_plane_mapping.hpp>
#include <sinew/mapping/square_distance_mapping.hpp>
#include <sinew/mapping/square_mapping.hpp>

namespace sample {

template <class I, class O>
void prepare(DistanceFromTargetMapping<I, O>& c, Random& random) {
  c.indices = {3, 20, 11, 3};
  c.targetPositions.clear();
  for (int k = 0; k < 5; ++k) c.targetPositions.push_back(coord<I>(random, 4));
  c.restLengths = {0.5, 1, 0};
}
template <class I, class O>
constexpr std::size_t child_points(DistanceFromTargetMapping<I, O> const&) {
  return 0;
}
template <class I, class O>
constexpr std::size_t child_points(DistanceToPlaneMapping<I, O> const&) {
  return 0;
}
template <class I, class O>
constexpr std::size_t child_points(SquareMapping<I, O> const&) {
  return 0;
}
template <class I, class O>
constexpr bool stabilizes(DistanceFromTargetMapping<I, O> const&) {
  return true;
}
template <class I, class O>
constexpr bool stabilizes(SquareDistanceMapping<I, O> const&) {
  return true;
}
template <class I, class O>
constexpr bool stabilizes(SquareMapping<I, O> const&) {
  return true;
}

}  // namespace sample
