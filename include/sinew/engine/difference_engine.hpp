// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/engine/values.hpp>

#include <vector>

namespace sinew {

/// The differences of the values of two lists, one by one: output = input - substractor.
struct DifferenceEngine {
  using Role = role::Engine;
  static constexpr std::string_view className = "DifferenceEngine";
  static constexpr bool sizedValues = true;

  std::vector<double> input{}, substractor{};
  int size = 1;

  static constexpr auto fields() {
    using E = DifferenceEngine;
    return field_list(field("input", &E::input, "", "values"),
                      field("substractor", &E::substractor, "", "what is subtracted from each"),
                      size_of_values<E>());
  }

  std::vector<double> output{};  // after update

  static constexpr auto outputs() {
    return field_list(field("output", &DifferenceEngine::output, "", "the differences"));
  }

  /// Throws Error unless both lists have as many values; the output then stays.
  void update(std::string_view where);
};

}  // namespace sinew

#if SINEW_DEFINES
namespace sinew {

SINEW_ONCE void DifferenceEngine::update(std::string_view where) {
  check_fields(*this, where);
  const auto at = [&] { return text(where, ": ", className); };
  const std::size_t n = count_values(at, "input", input, size),
                    m = count_values(at, "substractor", substractor, size);
  if (n != m) throw Error(at(), text("input has ", n, " values and substractor ", m, "; give both as many"));
  output = input;
  for (std::size_t i = 0; i < output.size(); ++i) output[i] -= substractor[i];
}

}  // namespace sinew
#endif
