// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/core/compiled.hpp>
#include <sinew/core/component.hpp>

#include <array>
#include <string_view>
#include <vector>

namespace sinew {

/// What becomes of two sets.
enum class SetOperation { unite, intersection, difference, symmetricDifference };
constexpr auto enum_names(SetOperation) {
  return std::to_array<std::string_view>({"union", "intersection", "difference", "symmetric_difference"});
}

/// Two sets of numbers made one: what is in either, in both, in the first only, or in one only. Numbers rise,
/// each once.
struct MergeSets {
  using Role = role::Engine;
  static constexpr std::string_view className = "MergeSets";

  std::vector<int> in1{}, in2{};
  SetOperation op = SetOperation::unite;

  static constexpr auto fields() {
    using M = MergeSets;
    return field_list(field("in1", &M::in1, "", "the first set"),
                      field("in2", &M::in2, "", "the second set"),
                      field("op", &M::op, "", "what is made of them"));
  }

  std::vector<int> out{};  // after update

  static constexpr auto outputs() { return field_list(field("out", &MergeSets::out, "", "the set")); }

  void update(std::string_view where);
};

}  // namespace sinew

#if SINEW_DEFINES
#include <algorithm>
#include <iterator>
#include <set>

namespace sinew {

SINEW_ONCE void MergeSets::update(std::string_view where) {
  check_fields(*this, where);
  const std::set<int> a(in1.begin(), in1.end()), b(in2.begin(), in2.end());
  out.clear();
  const auto to = std::back_inserter(out);
  if (op == SetOperation::unite) std::set_union(a.begin(), a.end(), b.begin(), b.end(), to);
  if (op == SetOperation::intersection) std::set_intersection(a.begin(), a.end(), b.begin(), b.end(), to);
  if (op == SetOperation::difference) std::set_difference(a.begin(), a.end(), b.begin(), b.end(), to);
  if (op == SetOperation::symmetricDifference)
    std::set_symmetric_difference(a.begin(), a.end(), b.begin(), b.end(), to);
}

}  // namespace sinew
#endif
