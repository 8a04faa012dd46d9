// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/core/compiled.hpp>
#include <sinew/topology/blade.hpp>

#include <cstddef>
#include <limits>
#include <string_view>
#include <vector>

namespace sinew {

/// How a cut is made.
struct CutRules {
  /// A cut passes through a point that is nearer to it than this part of an edge, which it does not split
  /// then.
  double snapping = 0.2;
  /// No element that comes is worse, unless the one is of which it is a part (simplex_quality).
  double quality = 0.1;
  /// How many points a body may have [1].
  std::size_t capacity = std::numeric_limits<std::size_t>::max();
};

/// Throws Error unless a rule has a value that it may have.
void check_rules(std::string_view where, CutRules const& rules);

/// What a blade has done to a body and is not done with.
struct CutFront {
  struct Side {
    Index point;
    int side, stroke;
  };
  std::vector<Crossing> crossings{};  // of elements through which it has not gone yet
  std::vector<Index> points{};        // in which a cut ends
  std::vector<Side> sides{};          // of the points around these
  /// Faces that part when the cut goes on there, since all their points are in its end: in rising order, of a
  /// surface edges with -1 behind.
  std::vector<Triangle> faces{};
  /// The same of surfaces that the body carries, in the order of their mappings, and how many points each of
  /// these has then.
  std::vector<CutFront> carried{};
  std::size_t size = 0;
};

}  // namespace sinew

#if SINEW_DEFINES
namespace sinew {

SINEW_ONCE void check_rules(std::string_view where, CutRules const& rules) {
  if (!(rules.snapping >= 0 && rules.snapping <= 0.5))
    throw Error(where,
                text("snapping is ", rules.snapping, ", but must be from 0 to 0.5, a part of an edge"));
  if (!(rules.quality >= 0 && rules.quality <= 1))
    throw Error(where, text("quality is ", rules.quality, ", but must be from 0 to 1"));
}

}  // namespace sinew
#endif
