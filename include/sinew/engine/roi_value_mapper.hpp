// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/core/compiled.hpp>
#include <sinew/core/component.hpp>

#include <vector>

namespace sinew {

/// A list with a value for each of several regions: that of a later region counts, and what is in none has
/// the default. In scene files indices1 and value1 are of the first region.
struct ROIValueMapper {
  using Role = role::Engine;
  static constexpr std::string_view className = "ROIValueMapper";

  int nbROIs = 0;
  std::vector<std::vector<int>> indices{};
  std::vector<std::vector<double>> values{};
  double defaultValue = 0;

  static constexpr auto fields() {
    using M = ROIValueMapper;
    return field_list(field("nbROIs", &M::nbROIs, "", "number of regions", range::nonNegative),
                      field("indices1", &M::indices, "", "of the first region", range::closed(0, 1 << 26)),
                      field("value1", &M::values, "", "of the first region"),
                      field("defaultValue", &M::defaultValue, "", "value of what is in no region"));
  }

  std::vector<double> outputValues{};  // after update

  static constexpr auto outputs() {
    return field_list(field("outputValues", &ROIValueMapper::outputValues, "", "up to the highest index"));
  }

  /// Throws Error unless each of at most nbROIs regions has one value; the output then stays.
  void update(std::string_view where);
};

}  // namespace sinew

#if SINEW_DEFINES
namespace sinew {

SINEW_ONCE void ROIValueMapper::update(std::string_view where) {
  check_fields(*this, where);
  const std::string at = text(where, ": ", className);
  if (indices.size() > std::size_t(nbROIs) || values.size() > std::size_t(nbROIs))
    throw Error(at,
                text("there are more regions than nbROIs, which is ", nbROIs, "; set it to their number"));
  for (std::size_t r = 0; r < indices.size(); ++r)
    if (!indices[r].empty() && (r >= values.size() || values[r].size() != 1))
      throw Error(at, text("region ", r + 1, " has not one value; give value", r + 1));
  outputValues.clear();
  for (std::size_t r = 0; r < indices.size(); ++r)
    for (const int i : indices[r]) {
      if (std::size_t(i) >= outputValues.size()) outputValues.resize(std::size_t(i) + 1, defaultValue);
      outputValues[std::size_t(i)] = values[r][0];
    }
}

}  // namespace sinew
#endif
