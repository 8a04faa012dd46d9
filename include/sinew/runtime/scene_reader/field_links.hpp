// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/runtime/dialect.hpp>
#include <sinew/runtime/scene_reader/links.hpp>

#include <algorithm>
#include <array>

namespace sinew {

namespace detail {

/// Whether a constraint in the node of a state that no mapping moves holds all of its points in all
/// directions: those of one point, or each.
inline bool is_held(ScenePlace const& owner) {
  if (owner.ofRole(RoleKind::mapping)) return false;
  auto on = [](std::string_view word) { return word == "1" || word == "true"; };
  auto valueOf = [](SceneItem const& item, std::string_view name) {
    auto const* given = item.element->attribute(name);
    return given ? std::string_view(given->value) : std::string_view();
  };
  SceneItem const* const state = owner.ofRole(RoleKind::state);
  if (!state || !valueOf(*state, "velocity").empty()) return false;  // it goes on with that
  std::size_t numbers = 0;
  for (Words words(valueOf(*state, "position")); !words.end(); words.next()) ++numbers;
  const std::string_view types = owner.state;
  const std::size_t ofPoint = types.starts_with("Rigid3")                    ? 7
                              : types.starts_with("Vec") && types.size() > 3 ? std::size_t(types[3] - '0')
                                                                             : 3;
  return std::any_of(owner.items.begin(), owner.items.end(), [&](auto const& item) {
    if (!item->info || item->element->attribute("activeDirections") || item->element->attribute("active") ||
        (item->info->name != "FixedConstraint" && item->info->name != "PartialFixedConstraint"))
      return false;
    if (item->info->name == "PartialFixedConstraint") {
      std::size_t directions = 0, held = 0;
      for (Words words(valueOf(*item, "fixedDirections")); !words.end(); ++directions)
        held += std::size_t(on(words.next()));
      if (held != directions) return false;
    }
    if (on(Words(valueOf(*item, "fixAll")).rest())) return true;
    const std::string_view indices = Words(valueOf(*item, "indices")).rest();
    return numbers == ofPoint && (indices.empty() || indices == "0");
  });
}

/// Whether what is in a node moves.
inline bool moves(ScenePlace const& place) {
  ScenePlace const* const owner = place.owner();
  if (owner && is_held(*owner)) return false;
  for (ScenePlace const* at = owner; at; at = at->parent)
    if (at->ofRole(RoleKind::odeSolver)) return true;
  if (!owner) return false;
  return owner->ofRole(RoleKind::mapping) ||
         std::any_of(owner->items.begin(), owner->items.end(), [](auto const& item) {
           return item->info && item->info->traits.movesState;
         });
}
/// Whether a field chooses the elements that bear a load: a link to none is meant, or a mistake that
/// SOFA lets pass.
inline bool chooses_loaded(FieldInfo const& field) {
  static constexpr std::array lists =
      std::to_array<std::string_view>({"triangleList", "quadList", "edgeIndices"});
  return dialect::has(lists, field.name);
}
/// The attribute by which the nearest topology of a component has SOFA make faces of its volumes; null for
/// none. They are not made here.
inline XmlAttribute const* makes_faces(SceneItem const& item) {
  for (ScenePlace const* place = item.place; place; place = place->parent)
    if (SceneItem const* const topology = place->ofRole(RoleKind::topology)) {
      for (std::string_view name : {"createTriangleArray", "createQuadArray"})
        if (auto const* a = topology->element->attribute(name);
            a && !a->value.empty() && a->value != "0" && a->value != "false")
          return a;
      return nullptr;
    }
  return nullptr;
}
/// No element bears the load.
inline void press_none(SceneItem& item, XmlAttribute const& a, std::string_view why,
                       SceneMessages& messages) {
  if (auto const* none = item.info->field("none")) none->read(item.address, "1");
  XmlAttribute const* const faces = makes_faces(item);
  messages.warnings.insert(text(item.element->place(a),
                                ": <",
                                item.tag,
                                ">: ",
                                a.name,
                                ": ",
                                why,
                                "; no element bears the load by its number, ",
                                faces ? text("while in SOFA those may that ",
                                             faces->name,
                                             " makes, and which are not made here; give the topology its "
                                             "triangles or quads, as a topological mapping makes them")
                                      : std::string("as in SOFA")));
}

/// What a value is whose link leads nowhere, where it is as without the attribute; empty where that is a
/// mistake.
inline std::string_view without_link(SceneItem const& item, FieldInfo const& field) {
  if (item.info->role == RoleKind::engine && field.name == "position" && !item.info->dataTypes.empty())
    return "the points of its node are taken, where SOFA's would choose none";
  if (item.info->role == RoleKind::state && field.name == "rest_position" &&
      item.place->ofRole(RoleKind::mapping))
    return "its points are at rest where the mapping has them then";
  return "";
}

/// The BoxROI over points that move of which a list of elements to remove is; null for another list.
inline SceneItem const* moving_box(SceneItem const& item, FieldInfo const& field, LinkTarget const& target) {
  if (!field.name.ends_with("ToRemove") || !item.info->field("box") || !target.item || !target.item->info ||
      target.item->info->name != "BoxROI")
    return nullptr;
  auto const* position = target.item->element->attribute("position");
  if (!position || !is_link(position->value)) return nullptr;
  const LinkTarget points = follow_link(*target.item, position->value);
  const bool moving = points.item && points.item->info && points.item->info->role == RoleKind::state &&
                      points.data == "position";
  return moving ? target.item : nullptr;
}

/// Where the link of a field leads; false where an element does without.
inline bool follow_field(SceneItem& item, FieldInfo const& field, XmlAttribute const& a, LinkTarget& target,
                         SceneMessages& messages) {
  try {
    target = follow_link(item, a.value);
  } catch (Error const& error) {
    const std::string_view otherwise = without_link(item, field);
    if (chooses_loaded(field))
      press_none(item, a, error.what(), messages);
    else if (otherwise.empty())
      throw;
    else
      messages.warnings.insert(
          text(item.element->place(a), ": <", item.tag, ">: ", a.name, ": ", otherwise, ": ", error.what()));
    return false;
  }
  for (auto const& whole : dialect::wholeLinks)
    if (target.data.empty() && target.item && field.name == whole.field)
      target.data = std::string(whole.data);
  if (field.name == "external_rest_shape") {
    if (target.data.empty()) target.data = "position";
    if (moves(target.item ? *target.item->place : *target.place))
      throw Error("",
                  text(shown(a.value),
                       " moves, but springs are to a place that stays; join the two bodies by a "
                       "StiffSpringForceField"));
  }
  return true;
}

/// Input and output of a mapping say what the tree says: the state above, and that of its node.
inline void check_ends(SceneItem& item, SceneMessages& messages) {
  for (std::string_view name : {"input", "input1", "output"}) {
    auto const* a = item.element->attribute(name);
    if (!a || !is_link(a->value) || (item.info->severalParents && name != "output")) continue;
    try {
      const LinkTarget target = follow_link(item, a->value);
      ScenePlace const* const place = target.item ? target.item->place : target.place;
      if (name == "output") {
        if (place != item.place && !(place->parent == item.place || item.place->parent == place))
          throw Error("",
                      text("leads to the node '",
                           place->name,
                           "', but a mapping moves what is in its own node; move it there"));
      } else if (place->owner() != (item.place->parent ? item.place->parent->owner() : nullptr) &&
                 place != item.place) {
        throw Error("",
                    text("leads to '",
                         place->name,
                         "', but a mapping follows the nearest state above its node; put the node below '",
                         place->name,
                         "'"));
      }
    } catch (Error const& error) {
      messages.addError(item.element->place(*a), text('<', item.tag, ">: ", a->name, ": ", error.what()));
    }
  }
}

}  // namespace detail

}  // namespace sinew
