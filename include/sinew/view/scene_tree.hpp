// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/runtime/class_table.hpp>
#include <sinew/runtime/node.hpp>
#include <sinew/scene/node.hpp>

#include <boost/hana/for_each.hpp>

#include <string>
#include <utility>
#include <vector>

namespace sinew::view {

/// A line of the tree of a scene: a node, or below it a component.
struct TreeLine {
  int depth = 0;
  std::string name{};       // of the node; of the component what it is called
  std::string className{};  // "TetrahedronFEMForceField<Vec3d>"; empty: a node
};

/// A line of a tree, and for a component where it is and what its class says of itself.
struct FoundLine : TreeLine {
  std::string path{};  // of the node
  void* component = nullptr;
  ClassInfo const* info = nullptr;
  bool mapped = false;  // the state of the node follows that of another
};

namespace detail {

/// What a class says of itself, for as long as the program runs.
template <class C>
ClassInfo const& class_of_component() {
  static const ClassInfo info = [] {
    const C defaults{};
    return sinew::detail::class_info(-1, sinew::detail::class_row<C>(), component_name<C>(), &defaults);
  }();
  return info;
}
template <class R>
ClassInfo const& class_of_type(RuntimeNode<R> const&, int type) {
  static const std::vector<ClassInfo> table = make_class_table<R>();
  return table[std::size_t(type)];
}

template <class Node>
inline constexpr bool is_runtime_node = requires(Node& node) { node.labelOf(*node.components().begin()); };

template <class Node, class F>
void walk_tree(Node& node, int depth, std::string const& above, F& f) {
  FoundLine line;
  line.depth = depth;
  if constexpr (is_runtime_node<Node>)
    line.name = node.name;
  else
    line.name = Node::name.view();
  line.path = text(above, '/', line.name);
  f(std::as_const(line));
  const std::string path = line.path;
  ++line.depth;
  line.name.clear();
  auto show = [&](ClassInfo const& info, std::string className, void* component) {
    line.className = std::move(className);
    line.info = &info;
    line.component = component;
    f(std::as_const(line));
  };
  if constexpr (is_runtime_node<Node>) {
    line.mapped = node.mapping() != nullptr;
    for (auto& entry : node.components()) {
      line.name = entry.name;
      show(class_of_type(node, entry.component.type()), entry.component.name(), entry.component.address());
    }
    for (auto& child : node.children()) walk_tree(*child, depth + 1, path, f);
  } else {
    line.mapped = Node::template count<role::Mapping> > 0;
    node.forEachComponent(on<AnyRole>(
        [&]<class C>(C& component) { show(class_of_component<C>(), component_name<C>(), &component); }));
    boost::hana::for_each(node.children, [&](auto& child) { walk_tree(child, depth + 1, path, f); });
  }
}

}  // namespace detail

/// f(FoundLine) for all nodes and components below a root, each node before what is below it.
template <class Root, class F>
void for_each_line(Root& root, F&& f) {
  detail::walk_tree(root, 0, {}, f);
}

/// All nodes and components, each node before what is below it.
template <class Simulation>
std::vector<TreeLine> scene_tree(Simulation& simulation) {
  std::vector<TreeLine> lines;
  for_each_line(simulation.root(), [&](FoundLine const& line) { lines.push_back(line); });
  return lines;
}

}  // namespace sinew::view
