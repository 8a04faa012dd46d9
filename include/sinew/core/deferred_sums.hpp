// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/core/work_share.hpp>

#include <cstddef>
#include <vector>

namespace sinew {

/// What the shares of several threads would add to the same place. Each share adds directly to the places
/// that no share before it touches, and stores the other summands in a buffer; when all shares are done,
/// these are added in the order of the work. So a place receives the same summands in the same order as from
/// one thread.
struct DeferredSums {
  std::vector<int> firstOf{};  // of each piece of work: where its `entries` begin; -1: nothing is deferred
  std::vector<int> entries{};  // for each summand: its entry of the buffer; -1: added at once
  std::vector<int> places{}, startOf{};  // the places, and where the entries of each begin

  std::size_t entryCount() const { return places.empty() ? 0 : std::size_t(startOf.back()); }

  /// forEachSummand(piece, f) calls f(place) for each summand of a piece of work, in the order of addition;
  /// each piece has `each` summands, a place of -1 is none.
  template <class ForEachSummand>
  void plan(int shares, std::size_t pieces, std::size_t each, std::size_t placeCount,
            ForEachSummand&& forEachSummand) {
    std::vector<int> first(placeCount, -1), count(placeCount + 1, 0);
    auto isDeferred = [&](int place, int share) { return place >= 0 && first[std::size_t(place)] != share; };
    firstOf.assign(pieces, -1);
    int used = 0;
    for (int k = 0; k < shares; ++k) {
      const WorkShare share{k, shares};
      for (std::size_t p = share.begin(pieces); p < share.end(pieces); ++p)
        forEachSummand(p, [&](int place) {
          if (place >= 0 && first[std::size_t(place)] < 0) first[std::size_t(place)] = k;
          if (!isDeferred(place, k)) return;
          ++count[std::size_t(place)];
          if (firstOf[p] < 0) firstOf[p] = int(each) * used++;
        });
    }
    places.clear();
    startOf.assign(1, 0);
    std::vector<int>& next = count;
    for (std::size_t place = 0; place < placeCount; ++place) {
      if (count[place] == 0) continue;
      places.push_back(int(place));
      startOf.push_back(startOf.back() + count[place]);
      next[place] = startOf[startOf.size() - 2];
    }
    entries.assign(each * std::size_t(used), -1);
    for (int k = 0; k < shares; ++k) {
      const WorkShare share{k, shares};
      for (std::size_t p = share.begin(pieces); p < share.end(pieces); ++p) {
        std::size_t entry = std::size_t(firstOf[p]);
        if (firstOf[p] >= 0)
          forEachSummand(p, [&](int place) {
            entries[entry++] = isDeferred(place, k) ? next[std::size_t(place)]++ : -1;
          });
      }
    }
  }

  /// add(place, entry) for the deferred summands of the places of a share.
  template <class Add>
  void addDeferred(WorkShare share, Add&& add) const {
    for (std::size_t i = share.begin(places.size()); i < share.end(places.size()); ++i)
      for (int entry = startOf[i]; entry < startOf[i + 1]; ++entry) add(places[i], std::size_t(entry));
  }
};

}  // namespace sinew
