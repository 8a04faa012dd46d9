// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/core/compiled.hpp>
#include <sinew/core/component.hpp>

#include <vector>

namespace sinew {

/// Numbers renumbered: one that stands at place k of the indices becomes k; with transpose k becomes what
/// stands there. Others stay as they are.
struct MapIndices {
  using Role = role::Engine;
  static constexpr std::string_view className = "MapIndices";

  std::vector<int> in{}, indices{};
  bool transpose = false;

  static constexpr auto fields() {
    using M = MapIndices;
    return field_list(field("in", &M::in, "", "numbers, such as those of elements"),
                      field("indices", &M::indices, "", "the new numbering: old numbers in their new order"),
                      field("transpose", &M::transpose, "", "whether new numbers become old ones"));
  }

  std::vector<int> out{};  // after update

  static constexpr auto outputs() {
    return field_list(field("out", &MapIndices::out, "", "the same with new numbers").also("outStr"));
  }

  void update(std::string_view where);
};

}  // namespace sinew

#if SINEW_DEFINES
#include <map>

namespace sinew {

SINEW_ONCE void MapIndices::update(std::string_view where) {
  check_fields(*this, where);
  std::map<int, int> number;
  for (std::size_t k = 0; k < indices.size(); ++k)
    if (transpose)
      number[int(k)] = indices[k];
    else
      number[indices[k]] = int(k);
  out = in;
  for (int& i : out)
    if (const auto known = number.find(i); known != number.end()) i = known->second;
}

}  // namespace sinew
#endif
