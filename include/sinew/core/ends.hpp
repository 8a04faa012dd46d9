// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/core/platform.hpp>

#include <algorithm>
#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace sinew {

/// A string that can be a template argument: names and paths of a typed scene.
template <std::size_t N>
struct FixedString {
  char chars[N]{};
  constexpr FixedString(char const (&literal)[N]) { std::copy_n(literal, N, chars); }
  constexpr std::string_view view() const { return {chars, N - 1}; }
  constexpr bool operator==(FixedString const&) const = default;
};

/// A string as a type, which templates deduce. (nvcc does not deduce the string itself.)
template <FixedString String>
struct Named {
  static constexpr auto value = String;
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
template <class C>
concept HasLinkedEnds = requires(C c) { c.ends.object1; };

/// The parents of a mapping that has several: paths from its node to nodes before it, up by ".." and down by
/// names ("../left", "../right/corner").
template <FixedString... Paths>
struct Parents {
  static std::vector<std::string> list() { return {std::string(Paths.view())...}; }
  static std::string name() {
    std::string all;
    for (auto const& path : list()) all.append(all.empty() ? "\"" : ", \"").append(path).append("\"");
    return "Parents<" + all + ">";
  }
};

/// Parents found at run time, by paths as those of Linked.
struct LinkedParents {
  std::vector<std::string> paths{};
  static std::string name() { return "LinkedParents"; }
};
template <class C>
concept HasLinkedParents = requires(C c) { c.parents.paths; };

}  // namespace sinew
