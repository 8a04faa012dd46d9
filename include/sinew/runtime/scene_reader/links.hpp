// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/runtime/scene_reader/parts.hpp>

#include <algorithm>
#include <optional>

namespace sinew {

namespace detail {

/// The words of a link: "@name", "@../x/y", "@/x/y", "@[-1].position", "@name.position".
struct LinkWords {
  std::string path, data{};     // "../x/y", "position"
  std::optional<int> offset{};  // of "@[-1]": from the component that has the link to another of its node
  bool based = false;           // the path starts at one place; another one at each node upwards
};
/// None where it is no link.
inline std::optional<LinkWords> read_link(std::string_view link) {
  std::string whole(Words(link).rest());
  if (!whole.starts_with('@')) return {};
  std::replace(whole.begin(), whole.end(), ' ', '_');  // as in names
  std::string_view path = std::string_view(whole).substr(1);
  LinkWords words;
  const std::size_t slash = path.rfind('/') == path.npos ? 0 : path.rfind('/') + 1;
  if (const std::string_view last = path.substr(slash); last != "." && last != "..")
    if (const std::size_t dot = last.rfind('.'); dot != last.npos) {
      words.data = std::string(last.substr(dot + 1));
      path = path.substr(0, slash + dot);
    }
  if (path.starts_with('['))
    words.offset = read_number<int>(path.substr(1, std::min(path.find(']'), path.size()) - 1));
  words.path = std::string(path);
  words.based = path.starts_with('/') || path.starts_with("./") || path.starts_with("../") || path == "." ||
                path == ".." || path.empty();
  return words;
}

/// The links of which a list has the values one behind the other, "@first @second"; none of one with blanks
/// in a name.
inline std::vector<std::string> several_links(std::string_view value) {
  std::vector<std::string> links;
  for (Words words(value); !words.end();) {
    links.emplace_back(words.next());
    if (!links.back().starts_with('@')) return {};
  }
  return links;
}

/// What a link leads to: a component or a node, and what of it.
struct LinkTarget {
  SceneItem* item = nullptr;
  ScenePlace* place = nullptr;
  std::string data{};
};

// path, from a node on
inline bool walk_link(ScenePlace& from, std::string_view path, LinkTarget& target) {
  ScenePlace* at = &from;
  while (!path.empty()) {
    const std::string_view step = path.substr(0, path.find('/'));
    path.remove_prefix(std::min(step.size() + 1, path.size()));
    if (step == "..") {
      at = at->parent;
    } else if (!step.empty() && step != ".") {
      ScenePlace* const child = at->child(step);
      SceneItem* const named = at->find(step);
      if (path.empty() && named && (!child || named->name == step)) return target.item = named, true;
      if (!child && !at->parent && step == at->name) continue;
      at = child;
    }
    if (!at) return false;
  }
  target.place = at;
  return true;
}

/// What a link of a component leads to. Throws Error where that is nothing.
inline LinkTarget follow_link(SceneItem& item, std::string_view link) {
  const std::optional<LinkWords> words = read_link(link);
  if (!words) throw Error("", text(shown(link), " is no link; a link starts with @"));
  LinkTarget target{.data = words->data};
  if (words->offset) {
    const auto& items = item.place->items;
    for (std::size_t i = 0; i < items.size(); ++i)
      if (items[i].get() == &item) {
        const long at = long(i) + *words->offset;
        if (at < 0 || at >= long(items.size()))
          throw Error("", text(shown(link), " leads outside the node; it has ", items.size(), " components"));
        target.item = items[std::size_t(at)].get();
      }
    if (!target.item) throw Error("", text(shown(link), " leads nowhere"));
    return target;
  }
  const std::string_view path = words->path;
  ScenePlace* from = item.place;
  if (path.starts_with('/'))
    while (from->parent) from = from->parent;
  while (from) {
    if (walk_link(*from, path, target)) return target;
    from = words->based ? nullptr : from->parent;
  }
  std::vector<std::string> known;
  for (ScenePlace* at = item.place; at; at = at->parent) {
    for (auto const& other : at->items) known.push_back(other->name);
    for (auto const& child : at->children) known.push_back(child->name);
  }
  const std::string_view last = path.substr(path.rfind('/') == path.npos ? 0 : path.rfind('/') + 1);
  throw Error("", text(shown(link), " leads nowhere", suggestion(last, known)));
}

/// The node with a state that an attribute's link leads to, or whose component it leads to; none where it
/// leads nowhere, which is said.
inline ScenePlace* follow_to_node(SceneItem& item, XmlAttribute const& attribute, SceneMessages& messages) {
  try {
    const LinkTarget target = follow_link(item, attribute.value);
    ScenePlace* place = target.item ? target.item->place : target.place;
    if (!place->owner())
      throw Error("", text("leads to '", place->name, "', which has no MechanicalObject; link to a state"));
    while (place->state.empty()) place = place->parent;
    return place;
  } catch (Error const& error) {
    messages.addError(item.element->place(attribute),
                      text('<', item.tag, ">: ", attribute.name, ": ", error.what()));
    return nullptr;
  }
}

}  // namespace detail

}  // namespace sinew
