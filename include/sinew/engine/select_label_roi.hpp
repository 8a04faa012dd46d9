// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/core/compiled.hpp>
#include <sinew/core/component.hpp>

#include <vector>

namespace sinew {

/// The points, or elements, that have one of some labels.
struct SelectLabelROI {
  using Role = role::Engine;
  static constexpr std::string_view className = "SelectLabelROI";

  std::vector<std::vector<int>> labels{};
  std::vector<int> selectLabels{};

  static constexpr auto fields() {
    using R = SelectLabelROI;
    return field_list(field("labels", &R::labels, "", "labels of each point or element: [1 2] [] [3]"),
                      field("selectLabels", &R::selectLabels, "", "labels that are wanted"));
  }

  std::vector<int> indices{};  // after update

  static constexpr auto outputs() {
    return field_list(field("indices", &SelectLabelROI::indices, "", "what has one of them"));
  }

  void update(std::string_view where);
};

}  // namespace sinew

#if SINEW_DEFINES
#include <algorithm>

namespace sinew {

SINEW_ONCE void SelectLabelROI::update(std::string_view where) {
  check_fields(*this, where);
  indices.clear();
  for (std::size_t i = 0; i < labels.size(); ++i)
    if (std::find_first_of(labels[i].begin(), labels[i].end(), selectLabels.begin(), selectLabels.end()) !=
        labels[i].end())
      indices.push_back(int(i));
}

}  // namespace sinew
#endif
