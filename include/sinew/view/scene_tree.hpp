// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/core/fields.hpp>
#include <sinew/scene/node.hpp>

#include <algorithm>
#include <string>
#include <type_traits>
#include <vector>

namespace sinew::view {

/// A line of the tree of a scene: a node, or below it a component.
struct TreeLine {
  int depth = 0;
  std::string name{};       // of the node; of the component what it is called
  std::string className{};  // "TetrahedronFEMForceField<Vec3d>"; empty: a node
};

namespace detail {

template <class Node>
void add_runtime_tree(Node& node, int depth, std::vector<TreeLine>& lines) {
  lines.push_back({depth, node.name, {}});
  for (auto const& entry : node.components())
    lines.push_back({depth + 1, entry.name, std::string(entry.component.name())});
  for (auto const& child : node.children()) add_runtime_tree(*child, depth + 1, lines);
}

}  // namespace detail

/// All nodes and components, each node before what is below it.
template <class Simulation>
std::vector<TreeLine> scene_tree(Simulation& simulation) {
  std::vector<TreeLine> lines;
  if constexpr (requires { simulation.root().components(); }) {
    detail::add_runtime_tree(simulation.root(), 0, lines);
  } else {
    std::string last;
    simulation.template visit<AnyRole>([&](auto const& component, auto const& scope) {
      using C = std::decay_t<decltype(component)>;
      const std::string path = scope.path();
      const int depth = int(std::count(path.begin(), path.end(), '/'));
      if (path != last) lines.push_back({depth - 1, path.substr(path.rfind('/') + 1), {}});
      last = path;
      lines.push_back({depth, {}, component_name<C>()});
    });
  }
  return lines;
}

}  // namespace sinew::view
