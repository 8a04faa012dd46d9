// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/core/deferred_sums.hpp>

#include <algorithm>
#include <cstddef>
#include <vector>

namespace sinew {

/// The deferred summands of N scalars each, of DeferredSums.
template <class Real, int N>
struct KeptSums {
  DeferredSums deferred{};
  mutable std::vector<Real> values{};

  /// forEachPlace(piece, f) calls f(place) for each of the `each` summands of a piece; -1 is none.
  template <class ForEachPlace>
  void plan(int shares, std::size_t pieces, std::size_t each, ForEachPlace&& forEachPlace) {
    int last = 0;
    for (std::size_t p = 0; p < pieces; ++p)
      forEachPlace(p, [&](int place) { last = std::max(last, place); });
    deferred.plan(shares, pieces, each, std::size_t(last) + 1, forEachPlace);
    values.resize(deferred.entryCount() * N);
  }

  /// For each summand of a piece: its entry of the buffer, or -1; null where all are added at once.
  int const* entriesOf(std::size_t piece) const {
    return deferred.firstOf[piece] >= 0 ? deferred.entries.data() + deferred.firstOf[piece] : nullptr;
  }
  Real* entry(int number) const { return values.data() + std::ptrdiff_t(number) * N; }

  /// add(place, summand) for the deferred summands of the places of a share.
  template <class Add>
  void addDeferred(WorkShare share, Add&& add) const {
    deferred.addDeferred(share, [&](int place, std::size_t number) { add(place, entry(int(number))); });
  }
};

}  // namespace sinew
