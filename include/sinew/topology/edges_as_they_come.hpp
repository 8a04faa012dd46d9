// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/topology/adjacency.hpp>

#include <algorithm>
#include <array>
#include <map>
#include <vector>

namespace sinew::detail {

/// The sides of elements in the order in which they come, each once, lower end first.
class EdgesAsTheyCome {
 public:
  template <class Element, std::size_t N>
  void add(std::vector<Element> const& elements, std::array<EdgeCorners, N> const& corners) {
    for (Element const& element : elements)
      for (auto const& [i, j] : corners) {
        const auto [a, b] = std::minmax(element[i], element[j]);
        if (numbers.emplace(Edge{a, b}, Index(edges.size())).second) edges.push_back({a, b});
      }
  }
  std::vector<Edge> edges{};
  std::map<Edge, Index> numbers{};
};

}  // namespace sinew::detail
