// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/engine/values.hpp>

#include <string>
#include <vector>

namespace sinew {

/// Several lists combined number by number, as far as the shortest goes. The operations are + - * /, where -
/// and / of one list are -x and 1/x, < and >, the smallest and the largest, and of truth values, which are 0
/// or not, ! & | ^ and their contraries !& !| !^. In scene files input1 is the first list.
struct MathOp {
  using Role = role::Engine;
  static constexpr std::string_view className = "MathOp";

  int nbInputs = 2;
  std::string op = "+";
  std::vector<std::vector<double>> inputs{};

  static constexpr auto fields() {
    using M = MathOp;
    return field_list(field("nbInputs", &M::nbInputs, "", "number of lists", range::atLeast(1)),
                      field("op", &M::op, "", "the operation"),
                      field("input1", &M::inputs, "", "the first list; input2... the others"));
  }

  std::vector<double> output{};  // after update

  static constexpr auto outputs() { return field_list(field("output", &MathOp::output, "", "results")); }

  /// Throws Error where there are not nbInputs lists, or no such operation; the output then stays.
  void update(std::string_view where);
};

}  // namespace sinew

#if SINEW_DEFINES
#include <algorithm>
#include <array>

namespace sinew {

SINEW_ONCE void MathOp::update(std::string_view where) {
  check_fields(*this, where);
  const std::string at = text(where, ": ", className);
  if (inputs.size() != std::size_t(nbInputs))
    throw Error(at,
                text("there are ", inputs.size(), " inputs, but nbInputs is ", nbInputs, "; give as many"));
  struct Operation {
    std::string_view name;
    double (*combine)(double, double);
    bool ofTruth = false, contrary = false;
  };
  static constexpr Operation known[] = {
      {"+", [](double a, double b) { return a + b; }},
      {"-", [](double a, double b) { return a - b; }},
      {"*", [](double a, double b) { return a * b; }},
      {"/", [](double a, double b) { return a / b; }},
      {"<", [](double a, double b) { return std::min(a, b); }},
      {">", [](double a, double b) { return std::max(a, b); }},
      {"!", [](double a, double) { return a; }, true, true},
      {"&", [](double a, double b) { return double(a != 0 && b != 0); }, true},
      {"|", [](double a, double b) { return double(a != 0 || b != 0); }, true},
      {"^", [](double a, double b) { return double((a != 0) != (b != 0)); }, true},
      {"!&", [](double a, double b) { return double(a != 0 && b != 0); }, true, true},
      {"!|", [](double a, double b) { return double(a != 0 || b != 0); }, true, true},
      {"!^", [](double a, double b) { return double((a != 0) != (b != 0)); }, true, true}};
  auto const* chosen =
      std::find_if(std::begin(known), std::end(known), [&](auto const& o) { return o.name == op; });
  if (chosen == std::end(known))
    throw Error(at, text("op is '", op, "'; take one of + - * / < > ! & | ^ !& !| !^"));
  std::size_t n = inputs[0].size();
  for (auto const& list : inputs) n = std::min(n, list.size());
  output.clear();
  for (std::size_t i = 0; i < n; ++i) {
    double value = inputs[0][i];
    if (inputs.size() == 1 && (op == "-" || op == "/")) value = chosen->combine(op == "-" ? 0 : 1, value);
    for (std::size_t k = 1; k < inputs.size(); ++k) value = chosen->combine(value, inputs[k][i]);
    if (chosen->ofTruth) value = (value != 0) != chosen->contrary;
    output.push_back(value);
  }
}

}  // namespace sinew
#endif
