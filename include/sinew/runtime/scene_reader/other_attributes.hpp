// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/runtime/dialect.hpp>
#include <sinew/runtime/dialect_attributes.hpp>
#include <sinew/runtime/scene_reader/links.hpp>

#include <algorithm>
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
    if (a.name.starts_with('_'))  // how scenes switch an attribute off
      return void(messages_.warnings.insert(
          text(item.element->place(a),
               ": <",
               item.tag,
               ">: ",
               a.name,
               " has no effect, as in SOFA, where nothing is called so; remove it, or its underscore")));
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

  /// `geometryState`, a link to the points of the elements of a mass, and `tagMechanics`, a tag of those of
  /// a diffusion: the points are those of the state, or of the body on which its values lie.
  void geometry(SceneItem& item, XmlAttribute const& a) {
    ScenePlace const *const used = placeOfPoints(item), *named = nullptr;
    if (a.name == "tagMechanics") {
      named = tagged(*item.place, a.value);
    } else if (is_link(a.value)) {
      try {
        const LinkTarget target = follow_link(item, a.value);
        named = target.item ? target.item->place : target.place;
      } catch (Error const&) {
        return;  // as in SOFA, the points of the topology then
      }
    }
    if (!named || !used || named == used) return;
    item.failed = true;
    messages_.addError(item.element->place(a),
                       text('<',
                            item.tag,
                            ">: ",
                            a.name,
                            " leads to the points of '",
                            named->name,
                            "', but its elements are over those of '",
                            used->name,
                            "'; put it below the node of the points"));
  }

 private:
  // the node of the points of the elements of a component (BodyView)
  static ScenePlace const* placeOfPoints(SceneItem const& item) {
    ScenePlace const* at = item.place;
    for (; at; at = at->parent)
      if (at->ofRole(RoleKind::topology) || !at->state.empty()) break;
    if (!at || at->ofRole(RoleKind::topology) || at->state.starts_with("Vec3")) return item.place->owner();
    for (at = at->parent; at && !at->ofRole(RoleKind::topology);) at = at->parent;
    while (at && !at->state.starts_with("Vec3")) at = at->parent;
    return at;
  }
  // the nearest node upwards whose state in space has a tag
  static ScenePlace const* tagged(ScenePlace const& place, std::string_view tag) {
    for (ScenePlace const* at = &place; at; at = at->parent) {
      SceneItem const* const state = at->state.starts_with("Vec3") ? at->ofRole(RoleKind::state) : nullptr;
      auto const* tags = state ? state->element->attribute("tags") : nullptr;
      for (Words words(tags ? std::string_view(tags->value) : std::string_view()); !words.end();)
        if (words.next() == tag) return at;
    }
    return nullptr;
  }

  // Whether there are forces, masses or constraints (`map`: mapForces, mapMasses, mapConstraints) on the
  // mapped state of a node, or on what follows it.
  static bool bringsBack(ScenePlace const& mapped, std::string_view map) {
    ScenePlace const* top = &mapped;
    while (top->parent) top = top->parent;
    const std::string path = from_top(mapped);
    return anyBelow(*top, [&](SceneItem const& item) {
      if (!item.info) return false;
      auto leadsHere = [&](std::string const& end) {
        return end == path || std::string_view(end).starts_with(text(path, '/'));
      };
      const bool here =
          mapped.above(*item.place) || std::any_of(item.ends.begin(), item.ends.end(), leadsHere);
      switch (item.info->role) {
        case RoleKind::mapping:
          return std::any_of(item.parents.begin(), item.parents.end(), leadsHere);
        case RoleKind::forceField:
        case RoleKind::interactionForceField:
          return here && map == "mapForces";
        case RoleKind::mass:  // which has a weight
          return here && map != "mapConstraints";
        case RoleKind::lagrangianConstraint:
          return here && map == "mapConstraints";
        case RoleKind::collisionModel:
          return here && (item.element->attribute("contactResponse") ||
                          (map == "mapConstraints" ? contactsAre(*top, true)
                                                   : map == "mapForces" && contactsAre(*top, false)));
        default:
          return false;
      }
    });
  }
  // contacts of a scene are constraints by multipliers, or penalty forces
  static bool contactsAre(ScenePlace const& top, bool constraints) {
    return anyBelow(top, [&](SceneItem const& item) {
      if (!item.info || item.info->role != RoleKind::contactManager) return false;
      auto const* response = item.element->attribute("response");
      return constraints == (response && response->value.find("Constraint") != std::string::npos);
    });
  }
  template <class F>
  static bool anyBelow(ScenePlace const& place, F const& f) {
    return std::any_of(place.items.begin(), place.items.end(), [&](auto const& item) { return f(*item); }) ||
           std::any_of(place.children.begin(), place.children.end(), [&](auto const& child) {
             return anyBelow(*child, f);
           });
  }

  bool lenient_;
  SceneMessages& messages_;

  // what would make another scene of this one
  void notSimulated(SceneItem& item, XmlAttribute const& a, dialect::NotSimulated const& known) {
    if (dialect::is_standard(known, a.value)) return;
    // what a mapping does not bring back makes no difference where there is none of it
    if (a.name.starts_with("map") && item.info->role == RoleKind::mapping &&
        (item.place->state.empty() || !bringsBack(*item.place, a.name)))
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
