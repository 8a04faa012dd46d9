// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/runtime/dialect.hpp>
#include <sinew/runtime/dialect_attributes.hpp>
#include <sinew/runtime/scene_reader/links.hpp>

#include <string>
#include <vector>

namespace sinew {

namespace detail {

/// What becomes of attributes that are no fields of a class of the registry.
class OtherAttributes {
 public:
  OtherAttributes(bool lenient, SceneMessages& messages) : lenient_(lenient), messages_(messages) {}

  /// Of an attribute that is none of the fields of its class.
  void withoutField(SceneItem& item, XmlAttribute const& a) {
    if (dialect::without_effect(item.info->name, a.name)) return;
    if (auto const* known = dialect::not_simulated(item.info->name, a.name))
      return notSimulated(item, a, *known);
    std::vector<std::string_view> names;
    for (auto const& f : item.info->fields)
      if (f.isInput) {
        names.push_back(f.name);
        for_each_name(f.aliases, [&](std::string_view alias) { names.push_back(alias); });
      }
    item.failed = true;
    messages_.addError(item.element->place(a),
                       text('<', item.tag, "> has no attribute '", a.name, "'", suggestion(a.name, names)));
  }

  /// `topology`, a link to one: all of a node act over its last topology.
  void otherTopology(SceneItem& item, XmlAttribute const& a) {
    if (!is_link(a.value)) return;
    SceneItem const* linked = nullptr;
    try {
      linked = follow_link(item, a.value).item;
    } catch (Error const&) {
      return;  // as in SOFA, the topology of the node then
    }
    SceneItem const* used = nullptr;
    for (ScenePlace* at = item.place; at && !used; at = at->parent) used = at->ofRole(RoleKind::topology);
    if (linked && linked != used && linked->info && linked->info->role == RoleKind::topology)
      messages_.warnings.insert(text(item.element->place(a),
                                     ": <",
                                     item.tag,
                                     ">: topology leads to '",
                                     linked->name,
                                     "', but it acts over '",
                                     used ? used->name : "",
                                     "', the last topology of the nearest node that has one"));
  }

 private:
  bool lenient_;
  SceneMessages& messages_;

  // what would make another scene of this one
  void notSimulated(SceneItem& item, XmlAttribute const& a, dialect::NotSimulated const& known) {
    if (dialect::is_standard(known, a.value)) return;
    // a picture has neither forces nor masses
    if (a.name.starts_with("map") && item.info->role == RoleKind::mapping && item.place->state.empty())
      return;
    for (auto const& other : dialect::anotherLaw)
      if (other.className == item.info->name && other.attribute == a.name)
        return void(messages_.warnings.insert(
            text(item.element->place(a), ": <", item.tag, ">: ", a.name, ": ", other.difference)));
    const std::string_view standard = known.standard.substr(0, known.standard.find('|'));
    const std::string what =
        text('<', item.tag, ">: ", a.name, " is not simulated: only its default ", shown(standard), " is");
    if (lenient_)
      return void(messages_.warnings.insert(text(item.element->place(a), ": ", what, "; it is left out")));
    item.failed = true;
    messages_.addError(item.element->place(a),
                       text(what, "; remove it, or read the scene with --lenient, which leaves it out"));
  }
};

}  // namespace detail

}  // namespace sinew
