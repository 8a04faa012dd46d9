// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/core/compiled.hpp>
#include <sinew/core/component.hpp>

#include <vector>

namespace sinew {

/// A list of labels turned into values: each input value that equals the kth of the indices becomes the kth
/// of the values, and any other the default.
struct Indices2ValuesMapper {
  using Role = role::Engine;
  static constexpr std::string_view className = "Indices2ValuesMapper";

  std::vector<double> inputValues{}, indices{}, values{};
  double defaultValue = 1;

  static constexpr auto fields() {
    using M = Indices2ValuesMapper;
    return field_list(field("inputValues", &M::inputValues, "", "labels"),
                      field("indices", &M::indices, "", "labels that have a value"),
                      field("values", &M::values, "", "their values, one each"),
                      field("defaultValue", &M::defaultValue, "", "value of other labels"));
  }

  std::vector<double> outputValues{};  // after update

  static constexpr auto outputs() {
    return field_list(
        field("outputValues", &Indices2ValuesMapper::outputValues, "", "a value for each label"));
  }

  /// Throws Error unless there is a value for each index; the output then stays.
  void update(std::string_view where);
};

}  // namespace sinew

#if SINEW_DEFINES
#include <algorithm>

namespace sinew {

SINEW_ONCE void Indices2ValuesMapper::update(std::string_view where) {
  check_fields(*this, where);
  if (indices.size() != values.size())
    throw Error(text(where, ": ", className),
                text("there are ", indices.size(), " indices and ", values.size(), " values; give as many"));
  outputValues.clear();
  for (const double label : inputValues) {
    const auto k = std::find(indices.begin(), indices.end(), label) - indices.begin();
    outputValues.push_back(std::size_t(k) < values.size() ? values[std::size_t(k)] : defaultValue);
  }
}

}  // namespace sinew
#endif
