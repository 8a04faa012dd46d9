// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/core/platform.hpp>

namespace sinew::gpu {

/// Which points blocks of constraints have: of each block its entries, one for each of its points, with the
/// rows there, three numbers a row, from a slot on; of each point the entries that it has, and what of J' G J
/// couples it with: pairs of an entry of the point and another of the same block.
struct ConvexEntries {
  int const *ends, *point, *slot, *blockOf;
  int const *ofPoint, *entry, *pairsOfPoint, *pair, *pointOfPairs;

  SINEW_INLINE int first(int block) const { return ends[block]; }
  SINEW_INLINE int last(int block) const { return ends[block + 1]; }
  SINEW_INLINE int pointOf(int e) const { return point[e]; }
  SINEW_INLINE int slotOf(int e) const { return slot[e]; }
  SINEW_INLINE int blockOfEntry(int e) const { return blockOf[e]; }
  /// f(entry) of a point.
  template <class F>
  SINEW_INLINE void eachOf(int i, F&& f) const {
    for (int k = ofPoint[i]; k < ofPoint[i + 1]; ++k) f(entry[k]);
  }
  SINEW_INLINE int firstPair(int i) const { return pairsOfPoint[i]; }
  SINEW_INLINE int lastPair(int i) const { return pairsOfPoint[i + 1]; }
  SINEW_INLINE int ownOf(int k) const { return pair[2 * k]; }
  SINEW_INLINE int otherOf(int k) const { return pair[2 * k + 1]; }
  SINEW_INLINE int pointOfPair(int k) const { return pointOfPairs[k]; }
};

}  // namespace sinew::gpu
