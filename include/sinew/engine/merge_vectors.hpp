// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/core/compiled.hpp>
#include <sinew/core/component.hpp>

#include <vector>

namespace sinew {

/// Several lists of numbers, points or indices as one, one after the other. In scene files input1 is the
/// first, input2 the second.
struct MergeVectors {
  using Role = role::Engine;
  static constexpr std::string_view className = "MergeVectors";

  int nbInputs = 2;
  std::vector<std::vector<double>> inputs{};

  static constexpr auto fields() {
    using M = MergeVectors;
    return field_list(field("nbInputs", &M::nbInputs, "", "number of lists", range::nonNegative),
                      field("input1", &M::inputs, "", "the first list; input2... the others"));
  }

  std::vector<double> output{};  // after update

  static constexpr auto outputs() {
    return field_list(field("output", &MergeVectors::output, "", "all of them"));
  }

  /// Throws Error where there are more lists than nbInputs.
  void update(std::string_view where);
};

}  // namespace sinew

#if SINEW_DEFINES
namespace sinew {

SINEW_ONCE void MergeVectors::update(std::string_view where) {
  check_fields(*this, where);
  if (inputs.size() > std::size_t(nbInputs))
    throw Error(text(where, ": ", className),
                text("there are ",
                     inputs.size(),
                     " inputs, but nbInputs is ",
                     nbInputs,
                     "; set it to ",
                     inputs.size()));
  output.clear();
  for (auto const& list : inputs) output.insert(output.end(), list.begin(), list.end());
}

}  // namespace sinew
#endif
