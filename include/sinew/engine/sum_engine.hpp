// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/engine/values.hpp>

#include <vector>

namespace sinew {

/// The sum of all values of a list.
struct SumEngine {
  using Role = role::Engine;
  static constexpr std::string_view className = "SumEngine";
  static constexpr bool sizedValues = true;

  std::vector<double> input{};
  int size = 1;

  static constexpr auto fields() {
    return field_list(field("input", &SumEngine::input, "", "values"), size_of_values<SumEngine>());
  }

  std::vector<double> output{};  // after update

  static constexpr auto outputs() {
    return field_list(field("output", &SumEngine::output, "", "their sum, one value"));
  }

  /// Throws Error unless the numbers are whole values; the output then stays.
  void update(std::string_view where);
};

}  // namespace sinew

#if SINEW_DEFINES
namespace sinew {

SINEW_ONCE void SumEngine::update(std::string_view where) {
  check_fields(*this, where);
  count_values(text(where, ": ", className), "input", input, size);
  output.assign(std::size_t(size), 0);
  for (std::size_t i = 0; i < input.size(); ++i) output[i % output.size()] += input[i];
}

}  // namespace sinew
#endif
