// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/engine/values.hpp>

#include <vector>

namespace sinew {

/// The norm of each value of a list:
///   |x|_p = (sum |x_i|^p)^(1/p),  the largest |x_i| for p < 0, and the number of those that are not 0 for 0
struct NormEngine {
  using Role = role::Engine;
  static constexpr std::string_view className = "NormEngine";
  static constexpr bool sizedValues = true;

  std::vector<double> input{};
  int normType = 2, size = 3;

  static constexpr auto fields() {
    using E = NormEngine;
    return field_list(field("input", &E::input, "", "values, such as points"),
                      field("normType", &E::normType, "", "p; negative for the largest entry"),
                      size_of_values<E>());
  }

  std::vector<double> output{};  // after update

  static constexpr auto outputs() {
    return field_list(field("output", &NormEngine::output, "", "the norm of each value"));
  }

  /// Throws Error unless the numbers are whole values; the output then stays.
  void update(std::string_view where);
};

}  // namespace sinew

#if SINEW_DEFINES
#include <Eigen/Core>

#include <cmath>

namespace sinew {

SINEW_ONCE void NormEngine::update(std::string_view where) {
  check_fields(*this, where);
  const std::size_t n = count_values([&] { return text(where, ": ", className); }, "input", input, size);
  output.clear();
  for (std::size_t i = 0; i < n; ++i) {
    const Eigen::Map<Eigen::ArrayXd const> x(input.data() + i * std::size_t(size), size);
    output.push_back(normType < 0    ? x.abs().maxCoeff()
                     : normType == 0 ? double((x != 0).count())
                     : normType == 2 ? std::sqrt(x.square().sum())
                                     : std::pow(x.abs().pow(normType).sum(), 1.0 / normType));
  }
}

}  // namespace sinew
#endif
