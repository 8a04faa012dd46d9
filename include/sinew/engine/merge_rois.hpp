// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/core/compiled.hpp>
#include <sinew/core/component.hpp>

#include <vector>

namespace sinew {

/// Several lists of indices as one list of lists. In scene files indices1 is the first.
struct MergeROIs {
  using Role = role::Engine;
  static constexpr std::string_view className = "MergeROIs";

  int nbROIs = 0;
  std::vector<std::vector<int>> indices{};

  static constexpr auto fields() {
    using R = MergeROIs;
    return field_list(
        field("nbROIs", &R::nbROIs, "", "number of lists", range::nonNegative),
        field("indices1", &R::indices, "", "the first list; indices2... the others", range::nonNegative));
  }

  std::vector<std::vector<int>> roiIndices{};  // after update

  static constexpr auto outputs() {
    return field_list(field("roiIndices", &MergeROIs::roiIndices, "", "the lists: [0 1] [2]"));
  }

  /// Throws Error where there are more lists than nbROIs; the output then stays.
  void update(std::string_view where);
};

}  // namespace sinew

#if SINEW_DEFINES
namespace sinew {

SINEW_ONCE void MergeROIs::update(std::string_view where) {
  check_fields(*this, where);
  if (indices.size() > std::size_t(nbROIs))
    throw Error(
        text(where, ": ", className),
        text("there are ", indices.size(), " lists, but nbROIs is ", nbROIs, "; set it to ", indices.size()));
  roiIndices = indices;
  roiIndices.resize(std::size_t(nbROIs));
}

}  // namespace sinew
#endif
