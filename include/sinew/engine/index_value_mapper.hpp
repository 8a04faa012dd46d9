// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/core/compiled.hpp>
#include <sinew/core/component.hpp>

#include <vector>

namespace sinew {

/// A list of values in which some have another one: outputValues = inputValues, but for `value` at the
/// indices. Where these go beyond the end, what is between has the default. One after the other make a list
/// of several regions.
struct IndexValueMapper {
  using Role = role::Engine;
  static constexpr std::string_view className = "IndexValueMapper";

  std::vector<double> inputValues{};
  std::vector<int> indices{};
  double value = 0, defaultValue = 1;

  static constexpr auto fields() {
    using M = IndexValueMapper;
    return field_list(field("inputValues", &M::inputValues, "", "values that there are; may be none"),
                      field("indices", &M::indices, "", "places of the value", range::closed(0, 1 << 26)),
                      field("value", &M::value, "", "the value there"),
                      field("defaultValue", &M::defaultValue, "", "value of places that have none"));
  }

  std::vector<double> outputValues{};  // after update

  static constexpr auto outputs() {
    return field_list(field("outputValues", &IndexValueMapper::outputValues, "", "all values"));
  }

  void update(std::string_view where);
};

}  // namespace sinew

#if SINEW_DEFINES
namespace sinew {

SINEW_ONCE void IndexValueMapper::update(std::string_view where) {
  check_fields(*this, where);
  outputValues = inputValues;
  for (const int i : indices) {
    if (std::size_t(i) >= outputValues.size()) outputValues.resize(std::size_t(i) + 1, defaultValue);
    outputValues[std::size_t(i)] = value;
  }
}

}  // namespace sinew
#endif
