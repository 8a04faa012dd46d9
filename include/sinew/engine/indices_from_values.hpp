// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/engine/values.hpp>

#include <vector>

namespace sinew {

/// Where values stand in a list: the first place of each, or with recursiveSearch all places of all of them.
struct IndicesFromValues {
  using Role = role::Engine;
  static constexpr std::string_view className = "IndicesFromValues";
  static constexpr bool sizedValues = true;

  std::vector<double> values{}, global{};
  bool recursiveSearch = false;
  int size = 1;

  static constexpr auto fields() {
    using E = IndicesFromValues;
    return field_list(field("values", &E::values, "", "values that are looked for"),
                      field("global", &E::global, "", "the list in which they are"),
                      field("recursiveSearch", &E::recursiveSearch, "", "whether all places are found"),
                      size_of_values<E>());
  }

  // after update
  std::vector<int> indices{}, otherIndices{};

  static constexpr auto outputs() {
    using E = IndicesFromValues;
    return field_list(field("indices", &E::indices, "", "places of the values"),
                      field("otherIndices",
                            &E::otherIndices,
                            "",
                            "with recursiveSearch the other places, for each value again"));
  }

  /// Throws Error where a value is not in the list; the outputs then stay.
  void update(std::string_view where);
};

}  // namespace sinew

#if SINEW_DEFINES
#include <algorithm>

namespace sinew {

SINEW_ONCE void IndicesFromValues::update(std::string_view where) {
  check_fields(*this, where);
  const std::string at = text(where, ": ", className);
  const std::size_t n = count_values(at, "values", values, size),
                    m = count_values(at, "global", global, size);
  std::vector<int> found, others;
  for (std::size_t i = 0; i < n; ++i) {
    const auto value = values.begin() + std::ptrdiff_t(i) * size;
    bool isThere = false;
    for (std::size_t j = 0; j < m && (recursiveSearch || !isThere); ++j) {
      const bool same = std::equal(value, value + size, global.begin() + std::ptrdiff_t(j) * size);
      if (same) found.push_back(int(j));
      if (!same && recursiveSearch) others.push_back(int(j));
      isThere = isThere || same;
    }
    if (!isThere && !recursiveSearch)
      throw Error(at, text("value ", i, " is not in global; remove it, or link global to another list"));
  }
  indices = std::move(found), otherIndices = std::move(others);
}

}  // namespace sinew
#endif
