// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/core/compiled.hpp>
#include <sinew/core/component.hpp>

#include <vector>

namespace sinew {

/// The points that are in none of some sets. In scene files setIndices1 is the first set.
struct ComplementaryROI {
  using Role = role::Engine;
  static constexpr std::string_view className = "ComplementaryROI";

  std::vector<Eigen::Vector3d> position{};
  int nbSet = 0;
  std::vector<std::vector<int>> setIndices{};

  static constexpr auto fields() {
    using R = ComplementaryROI;
    return field_list(field("position", &R::position, "m", "all points"),
                      field("nbSet", &R::nbSet, "", "number of sets", range::nonNegative),
                      field("setIndices1",
                            &R::setIndices,
                            "",
                            "the first set; setIndices2... the others",
                            range::nonNegative));
  }

  // after update
  std::vector<int> indices{};
  std::vector<Eigen::Vector3d> pointsInROI{};

  static constexpr auto outputs() {
    using R = ComplementaryROI;
    return field_list(field("indices", &R::indices, "", "the points in no set"),
                      field("pointsInROI", &R::pointsInROI, "m", "where they are"));
  }

  /// Throws Error where there are more sets than nbSet, or an index is out of range; the outputs then stay.
  void update(std::string_view where);
};

}  // namespace sinew

#if SINEW_DEFINES
#include <sinew/core/lists.hpp>

namespace sinew {

SINEW_ONCE void ComplementaryROI::update(std::string_view where) {
  check_fields(*this, where);
  const std::string at = text(where, ": ", className);
  if (setIndices.size() > std::size_t(nbSet))
    throw Error(at,
                text("there are ",
                     setIndices.size(),
                     " sets, but nbSet is ",
                     nbSet,
                     "; set it to ",
                     setIndices.size()));
  std::vector<bool> in(position.size());
  for (auto const& set : setIndices) check_numbers(at, "setIndices", set, in.size(), "points", "position");
  for (auto const& set : setIndices)
    for (const int i : set) in[std::size_t(i)] = true;
  indices.clear(), pointsInROI.clear();
  for (std::size_t i = 0; i < in.size(); ++i)
    if (!in[i]) {
      indices.push_back(int(i));
      pointsInROI.push_back(position[i]);
    }
}

}  // namespace sinew
#endif
