// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/core/renumbering.hpp>
#include <sinew/topology/border.hpp>

#include <algorithm>
#include <cstddef>
#include <optional>
#include <vector>

namespace sinew {

/// Between which points that were there others come.
class OldCorners {
 public:
  OldCorners(std::size_t points, std::vector<Origin> const& come) : points_(points) {
    for (Origin const& o : come) {
      std::vector<Index> corners;
      for (const Index i : {o.a, o.b, o.c < 0 ? o.a : o.c}) add(i, corners);
      of_.push_back(std::move(corners));
    }
  }
  /// The sorted corners of the face, with as many as this one, in which it lies; empty for none.
  template <class Face>
  std::optional<Face> around(Face const& face) const {
    std::vector<Index> corners;
    for (const Index i : face) add(i, corners);
    if (corners.size() != face.size()) return {};
    Face outer;
    std::copy(corners.begin(), corners.end(), outer.begin());
    return sorted_corners(outer);
  }

 private:
  std::size_t points_;
  std::vector<std::vector<Index>> of_{};

  void add(Index i, std::vector<Index>& corners) const {
    if (std::size_t(i) >= points_) {
      for (const Index old : of_[std::size_t(i) - points_]) add(old, corners);
    } else if (std::find(corners.begin(), corners.end(), i) == corners.end()) {
      corners.push_back(i);
    }
  }
};

}  // namespace sinew
