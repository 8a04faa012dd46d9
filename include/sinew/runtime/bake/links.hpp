// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/runtime/bake/classes.hpp>
#include <sinew/runtime/scene_reader/links.hpp>

#include <array>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

namespace sinew {

namespace detail {

/// Where components of a runtime tree lead to: ends, parents and links.
template <class R>
class BakeLinks {
 public:
  using Node = RuntimeNode<R>;
  using Entry = RuntimeEntry<R>;
  struct Source {
    Node* node;
    Entry* entry;
    std::size_t field;
  };

  explicit BakeLinks(BakeClasses<R> const& classes) : classes_(classes) {}

  /// The nodes that an interaction joins; null of what joins none.
  std::array<Node*, 2> endsOf(Node& node, Entry const& entry) const {
    Linked const* const ends = entry.component.ends();
    if (!ends) return {};
    return {node.resolve(ends->object1), node.resolve(ends->object2)};
  }
  /// The paths of the parents of a mapping with several, as C++ has them: "\"../left\", \"../right\"".
  std::string parentsOf(Node& node, Entry const& entry) const {
    std::string all;
    if (auto const* parents = entry.component.parents())
      for (auto const& path : *parents)
        all += text(all.empty() ? "" : ", ", cpp_literal(relativePath(node, *node.resolve(path))));
    return all;
  }
  /// The path from a node to one below it.
  static std::string pathFrom(Node const& above, Node const& node) {
    std::string path;
    for (Node const* at = &node; at != &above; at = at->parent())
      path = path.empty() ? at->name : text(at->name, '/', path);
    return path;
  }

  /// The first of the chain of links that ends at this field which holds the same value in the same type, or
  /// in that of what an optional field holds. Those of `busy`, which are being written, are passed over.
  std::optional<Source> source(Node& node, Entry& entry, std::size_t field,
                               std::set<Entry const*> const& busy, std::size_t depth = 0) const {
    ClassInfo const& info = classes_.infoOf(entry);
    const auto link = entry.links.find(info.fields[field].name);
    if (link == entry.links.end() || depth > 1000) return {};
    std::string data;
    const auto [at, from] = follow(node, entry, link->second, data);
    if (!from) return {};
    const std::string value = info.fields[field].write(entry.component.address());
    std::vector<std::pair<Entry*, std::string_view>> places{{from, data}};
    // a state takes its points from the topology of its node, and rests where it starts
    if (classes_.infoOf(*from).role == RoleKind::state) {
      places.push_back({from, "position"});
      if (at->topology()) places.push_back({at->topology(), "position"});
    }
    for (auto const& [place, name] : places) {
      // the type of an interaction says where it stands
      if (classes_.infoOf(*place).joins || classes_.infoOf(*place).severalParents || busy.count(place))
        continue;
      auto const& fields = classes_.infoOf(*place).fields;
      std::optional<std::size_t> found;
      for (std::size_t f = 0; f < fields.size(); ++f)
        if (fields[f].known(name) && (!found || !fields[f].isInput)) found = f;
      if (!found) continue;
      // an optional takes what it holds, too
      std::type_info const& offered = *classes_.codeOf(*place).fields[*found].type().type;
      TypeCode const& wanted = classes_.codeOf(entry).fields[field].type();
      if ((offered != *wanted.type && offered != *wanted.held) ||
          fields[*found].write(place->component.address()) != value)
        continue;
      if (fields[*found].isInput)
        if (auto deeper = source(*at, *place, *found, busy, depth + 1)) return deeper;
      return Source{at, place, *found};
    }
    return {};
  }

 private:
  BakeClasses<R> const& classes_;

  // "../left"
  static std::string relativePath(Node const& node, Node const& to) {
    std::string up;
    for (Node const* at = &node; at; at = at->parent()) {
      for (Node const* below = &to; below; below = below->parent())
        if (below == at) {
          const std::string down = pathFrom(*at, to);
          return down.empty() ? up : up.empty() ? down : text(up, '/', down);
        }
      up += up.empty() ? ".." : "/..";
    }
    return up;
  }
  Entry* named(Node& node, std::string_view name) const {
    if (Entry* entry = node.find(name)) return entry;
    for (auto& entry : node.components())
      if (classes_.infoOf(entry).known(name)) return &entry;
    return nullptr;
  }
  // the component that a link leads to, and the name behind its dot; as read_scene follows links
  std::pair<Node*, Entry*> follow(Node& from, Entry const& entry, std::string_view link,
                                  std::string& data) const {
    const std::optional<LinkWords> words = read_link(link);
    if (!words) return {};
    data = words->data;
    if (words->offset) {
      const long at = long(&entry - from.components().data()) + *words->offset;
      if (at < 0 || at >= long(from.components().size())) return {};
      return {&from, &from.components()[std::size_t(at)]};
    }
    const std::string_view path = words->path;
    for (Node* at = path.starts_with('/') ? &from.top() : &from; at;
         at = words->based ? nullptr : at->parent())
      if (const auto found = walk(*at, path); found.second) return found;
    return {};
  }
  std::pair<Node*, Entry*> walk(Node& from, std::string_view path) const {
    Node* at = &from;
    while (!path.empty()) {
      const std::string_view step = path.substr(0, path.find('/'));
      path.remove_prefix(std::min(step.size() + 1, path.size()));
      if (step == "..") {
        at = at->parent();
      } else if (!step.empty() && step != ".") {
        if (Entry* entry = named(*at, step); entry && path.empty()) return {at, entry};
        Node* const child = at->find_node(step);
        if (!child && !at->parent() && step == at->name) continue;
        at = child;
      }
      if (!at) return {};
    }
    return {at, at->state()};
  }
};

}  // namespace detail

}  // namespace sinew
