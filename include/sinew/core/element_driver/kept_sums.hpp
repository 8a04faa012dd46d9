// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/core/late_sums.hpp>

#include <algorithm>
#include <cstddef>
#include <vector>

namespace sinew {

/// Summands of N scalars that the parts of a work keep for places of other parts, see LateSums.
template <class Real, int N>
struct KeptSums {
  LateSums late{};
  mutable std::vector<Real> values{};

  /// forEachPlace(piece, f) calls f(place) for each of the `each` summands of a piece; -1 is none.
  template <class ForEachPlace>
  void plan(int parts, std::size_t pieces, std::size_t each, ForEachPlace&& forEachPlace) {
    int last = 0;
    for (std::size_t p = 0; p < pieces; ++p)
      forEachPlace(p, [&](int place) { last = std::max(last, place); });
    late.plan(parts, pieces, each, std::size_t(last) + 1, forEachPlace);
    values.resize(late.roomCount() * N);
  }

  /// For each summand of a piece: the room that keeps it, or -1; null where all are added at once.
  int const* roomsOf(std::size_t piece) const {
    return late.firstOf[piece] >= 0 ? late.rooms.data() + late.firstOf[piece] : nullptr;
  }
  Real* room(int number) const { return values.data() + std::ptrdiff_t(number) * N; }

  /// add(place, summand) for what the places of a part receive late.
  template <class Add>
  void addLate(Part part, Add&& add) const {
    late.addLate(part, [&](int place, std::size_t number) { add(place, room(int(number))); });
  }
};

}  // namespace sinew
