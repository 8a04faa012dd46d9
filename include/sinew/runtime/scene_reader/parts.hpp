// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/runtime/class_table.hpp>
#include <sinew/runtime/dialect.hpp>
#include <sinew/runtime/xml_document.hpp>

#include <array>
#include <map>
#include <memory>
#include <set>

namespace sinew {

namespace detail {

struct ScenePlace;

/// A component of a scene file on its way into a tree.
struct SceneItem {
  enum class Progress { fresh, busy, done };
  ScenePlace* place;
  XmlElement* element;
  std::string tag, name;
  std::vector<ClassInfo const*> candidates{};
  ClassInfo const* info = nullptr;
  void* address = nullptr;  // of the component, when it is made (SceneValues)
  Progress progress = Progress::fresh;
  std::map<std::string, std::string, std::less<>> links{};
  std::string moved{};  // the link from which positions come that are moved once more
  std::array<std::string, 2> ends{};
  std::vector<std::string> parents{};  // of a mapping with several
  ScenePlace* home = nullptr;          // of an interaction: the node above both its ends, where it belongs
  bool failed = false;
};

/// A node of a scene file.
struct ScenePlace {
  XmlElement* element;
  std::string name;
  ScenePlace* parent = nullptr;
  std::vector<std::unique_ptr<ScenePlace>> children{};
  std::vector<std::unique_ptr<SceneItem>> items{};
  std::string state{};  // DataTypes of the state of this node; empty: none
  bool visual = false;
  std::vector<XmlElement*> newton{};  // settings for ODE solvers
  std::vector<XmlElement*> preconditioners{}, densities{};

  SceneItem* find(std::string_view itemName) const {
    for (auto const& item : items)
      if (item->name == itemName) return item.get();
    for (auto const& item : items)
      if (item->tag == itemName || (item->info && item->info->name == itemName)) return item.get();
    return nullptr;
  }
  ScenePlace* child(std::string_view childName) const {
    for (auto const& c : children)
      if (c->name == childName) return c.get();
    return nullptr;
  }
  /// The component of a role; of several topologies the last, as in SOFA.
  SceneItem* ofRole(RoleKind role) const {
    SceneItem* found = nullptr;
    for (auto const& item : items)
      if (item->info && item->info->role == role && (!found || role == RoleKind::topology))
        found = item.get();
    return found;
  }
  /// The component that a link to the node means: its state, or a visual model that has its name, which in
  /// SOFA stands in the node above (split_visuals.hpp).
  SceneItem* meant() const {
    if (SceneItem* const own = ofRole(RoleKind::state)) return own;
    SceneItem* const shown = ofRole(RoleKind::visualModel);
    return shown && shown->name == name ? shown : nullptr;
  }
  /// The nearest node upwards, from this one on, that has a state.
  ScenePlace const* owner() const { return !state.empty() ? this : parent ? parent->owner() : nullptr; }
  bool above(ScenePlace const& other) const {
    return this == &other || (other.parent && above(*other.parent));
  }
  std::string path() const { return parent ? text(parent->path(), '/', name) : text('/', name); }
};

/// What is said of a scene file: all mistakes at once, and what has no effect.
struct SceneMessages {
  std::vector<std::string> errors{};
  std::set<std::string, std::less<>> ignored{}, warnings{};

  void addError(std::string const& place, std::string_view what) {
    errors.push_back(text(place, ": ", what));
  }
  void addError(XmlElement const& at, std::string_view what) {
    addError(at.place(), text('<', at.tag, ">: ", what));
  }
  /// f(), whose Error is one of the item.
  template <class F>
  void locate(SceneItem& item, F&& f) {
    if (item.failed) return;
    try {
      f();
    } catch (Error const& error) {
      item.failed = true;
      // the element has said the class
      const std::string own = item.info ? text(item.info->cppName, ": ") : std::string();
      std::string_view cause = error.what();
      while (!own.empty() && cause.starts_with(own)) cause.remove_prefix(own.size());
      addError(*item.element, cause);
    }
  }
};

/// Name of an element, or another word where it has none; without what links are made of.
inline std::string name_of(XmlElement const& element, std::string_view otherwise) {
  auto const* name = element.attribute("name");
  std::string given = name && !name->value.empty() ? name->value : std::string(otherwise);
  for (char& c : given)
    if (c == '/' || c == ' ') c = '_';
  return given;
}
inline std::string tag_of(XmlElement const& element) {
  auto const* type = element.tag == "Object" ? element.attribute("type") : nullptr;
  return type ? type->value : element.tag;
}
/// What to do about a word that is not known, behind a message.
template <class Names>
std::string suggestion(std::string_view word, Names const& known) {
  const std::string nearest = nearest_name(word, known);
  return nearest.empty() ? "; correct the name, or remove it" : text("; did you mean '", nearest, "'?");
}
inline bool is_link(std::string_view value) {
  const std::size_t first = value.find_first_not_of(" \t\r\n");
  return first != value.npos && value[first] == '@';
}
/// A link that leads to a component from anywhere.
inline std::string link_to(SceneItem const& item) { return text('@', item.place->path(), '/', item.name); }
/// Path from the outermost node on: "/liver/skin".
inline std::string from_top(ScenePlace const& place) {
  const std::string path = place.path();
  const std::string below = path.substr(std::min(path.find('/', 1), path.size()));
  return below.empty() ? "/" : below;
}
/// What a component offers under a name: a result goes before a field of the same name.
inline FieldInfo const* offered(ClassInfo const& info, std::string_view name) {
  for (auto const& f : info.fields)
    if (!f.isInput && f.known(name)) return &f;
  return info.field(name);
}

/// f(item), of all in and below a place, also of those that f adds.
template <class F>
void for_each_item(ScenePlace& place, F&& f) {
  for (std::size_t i = 0; i < place.items.size(); ++i) f(*place.items[i]);
  for (auto& child : place.children) for_each_item(*child, f);
}

}  // namespace detail

}  // namespace sinew
