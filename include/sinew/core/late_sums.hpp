// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/core/part.hpp>

#include <cstddef>
#include <vector>

namespace sinew {

/// What several parts of a work would add to the same place. Each part adds to a place that no part before it
/// has touched, and keeps what it has for others in a room of its own; when all parts are done, that is added
/// in the order of the work. So a place receives the same summands in the same order as from one thread.
struct LateSums {
  std::vector<int> firstOf{};  // of each piece of work: where its `rooms` begin; -1: nothing is kept
  std::vector<int> rooms{};    // for each summand: the room that keeps it; -1: added at once
  std::vector<int> places{}, startOf{};  // the places, and where the rooms of each begin

  std::size_t roomCount() const { return places.empty() ? 0 : std::size_t(startOf.back()); }

  /// forEachSummand(piece, f) calls f(place) for each summand of a piece of work, in the order of addition;
  /// each piece has `each` summands, a place of -1 is none.
  template <class ForEachSummand>
  void plan(int parts, std::size_t pieces, std::size_t each, std::size_t placeCount,
            ForEachSummand&& forEachSummand) {
    std::vector<int> first(placeCount, -1), count(placeCount + 1, 0);
    auto isLate = [&](int place, int part) { return place >= 0 && first[std::size_t(place)] != part; };
    firstOf.assign(pieces, -1);
    int used = 0;
    for (int k = 0; k < parts; ++k) {
      const Part part{k, parts};
      for (std::size_t p = part.begin(pieces); p < part.end(pieces); ++p)
        forEachSummand(p, [&](int place) {
          if (place >= 0 && first[std::size_t(place)] < 0) first[std::size_t(place)] = k;
          if (!isLate(place, k)) return;
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
    rooms.assign(each * std::size_t(used), -1);
    for (int k = 0; k < parts; ++k) {
      const Part part{k, parts};
      for (std::size_t p = part.begin(pieces); p < part.end(pieces); ++p) {
        std::size_t room = std::size_t(firstOf[p]);
        if (firstOf[p] >= 0)
          forEachSummand(
              p, [&](int place) { rooms[room++] = isLate(place, k) ? next[std::size_t(place)]++ : -1; });
      }
    }
  }

  /// add(place, room) for what the places of a part receive late.
  template <class Add>
  void addLate(Part part, Add&& add) const {
    for (std::size_t i = part.begin(places.size()); i < part.end(places.size()); ++i)
      for (int room = startOf[i]; room < startOf[i + 1]; ++room) add(places[i], std::size_t(room));
  }
};

}  // namespace sinew
