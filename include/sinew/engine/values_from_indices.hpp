// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/engine/values.hpp>

#include <vector>

namespace sinew {

/// Some values of a list, in the order of their indices.
struct ValuesFromIndices {
  using Role = role::Engine;
  static constexpr std::string_view className = "ValuesFromIndices";
  static constexpr bool sizedValues = true;

  std::vector<double> in{};
  std::vector<int> indices{};
  int size = 1;

  static constexpr auto fields() {
    using V = ValuesFromIndices;
    return field_list(field("in", &V::in, "", "values to choose from"),
                      field("indices", &V::indices, "", "those that are chosen", range::nonNegative),
                      size_of_values<V>());
  }

  std::vector<double> out{};  // after update

  static constexpr auto outputs() {
    return field_list(field("out", &ValuesFromIndices::out, "", "the chosen values"));
  }

  /// Throws Error where an index is out of range; the output then stays.
  void update(std::string_view where);
};

}  // namespace sinew

#if SINEW_DEFINES
#include <sinew/core/lists.hpp>

namespace sinew {

SINEW_ONCE void ValuesFromIndices::update(std::string_view where) {
  check_fields(*this, where);
  const auto at = [&] { return text(where, ": ", className); };
  check_numbers(at, "indices", indices, count_values(at, "in", in, size), "values", "in");
  out.clear();
  for (const int i : indices) {
    const auto first = in.begin() + std::ptrdiff_t(i) * size;
    out.insert(out.end(), first, first + size);
  }
}

}  // namespace sinew
#endif
