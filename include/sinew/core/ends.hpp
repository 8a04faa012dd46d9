// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <algorithm>
#include <cstddef>
#include <string>
#include <string_view>

namespace sinew {

/// A string that can be a template argument: names and paths of a typed scene.
template <std::size_t N>
struct FixedString {
  char chars[N]{};
  constexpr FixedString(char const (&literal)[N]) { std::copy_n(literal, N, chars); }
  constexpr std::string_view view() const { return {chars, N - 1}; }
  constexpr bool operator==(FixedString const&) const = default;
};

/// A force field inside the body of its own node.
struct Within {
  static std::string name() { return "Within"; }
};

/// The two ends of an interaction: paths from the node where the component sits to the nodes of the two
/// states.
template <FixedString First, FixedString Second>
struct Between {
  static constexpr auto first = First;
  static constexpr auto second = Second;
  static std::string name() {
    return std::string("Between<\"")
        .append(First.view())
        .append("\", \"")
        .append(Second.view())
        .append("\">");
  }
};

/// Two ends found at run time: paths of nodes from the node of the component on ("", "liver/skin",
/// "../liver",
/// "/liver").
struct Linked {
  std::string object1{}, object2{};
  static std::string name() { return "Linked"; }
};

}  // namespace sinew
