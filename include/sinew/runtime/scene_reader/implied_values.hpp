// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/runtime/scene_reader/component_values.hpp>

#include <algorithm>
#include <array>
#include <set>
#include <string>
#include <string_view>
#include <vector>

namespace sinew {

namespace detail {

/// What a component is not given and takes from others around it.
template <class R>
class ImpliedValues {
 public:
  ImpliedValues(ComponentValues<R>& values, SceneMessages& messages) : values_(values), messages_(messages) {}

  /// src="@loader": all that the loader offers under the name of a field that is not given.
  void source(SceneItem& item, XmlAttribute const& src, std::set<std::string_view>& given) {
    try {
      LinkTarget target = follow_link(item, src.value);
      if (!target.item) target.item = target.place->meant();
      if (!target.item || !target.item->info)
        throw Error("", text(shown(src.value), " leads to no loader; link to a component"));
      checkOrder(item, *target.item);
      for (auto const& field : item.info->fields) {
        if (!field.isInput || given.count(field.name)) continue;
        bool offered = false;
        if (!dialect::container_holds(item.tag, field.name)) continue;
        for (auto const& other : target.item->info->fields)
          if (other.known(field.name) && (!other.isInput || target.item->info->role != RoleKind::engine))
            offered = true;
        if (!offered) continue;
        const std::string words =
            values_.linkedValue(item, field, {target.item, nullptr, std::string(field.name)});
        if (words.empty()) continue;
        field.read(item.address, words);
        item.links[std::string(field.name)] = text(src.value, '.', field.name);
        given.insert(field.name);
      }
    } catch (Error const& error) {
      const std::string message = text('<', item.tag, ">: src: ", error.what());
      if (item.info->role == RoleKind::visualModel)  // nothing moves otherwise for a picture that is missing
        return void(messages_.warnings.insert(text(item.element->place(src), ": ", message)));
      item.failed = true;
      messages_.addError(item.element->place(src), message);
    }
  }

  /// Throws Error where elements of second order would be left out by what takes those of first order.
  void checkOrder(SceneItem const& item, SceneItem& from) {
    auto takes = [&](std::string_view list) {
      FieldInfo const* const field = item.info->field(list);
      return field && field->isInput;
    };
    if (!takes("tetrahedra") && !takes("hexahedra")) return;
    for (const std::string_view list : {"quadraticTetrahedra", "quadraticHexahedra", "triquadraticHexahedra"})
      if (!takes(list) && offered(*from.info, list) &&
          !values_.valueOf({&from, nullptr, std::string(list)}).empty())
        throw Error("",
                    text(link_to(from),
                         " has ",
                         list,
                         ", elements of second order, and this takes those of first order only; give it a "
                         "mesh of first order (in Gmsh, Mesh.ElementOrder = 1)"));
  }

  /// Whether a link leads to what an engine makes that goes on in each step, from a component that has all
  /// that the engine is given but the places of points.
  static bool takesLaw(SceneItem const& item, LinkTarget const& target) {
    if (!target.item || !target.item->info || target.item->info->traits.law.empty() ||
        target.item->info->traits.law != target.data || item.info->role == RoleKind::engine)
      return false;
    auto const& fields = target.item->info->fields;
    return std::all_of(fields.begin(), fields.end(), [&](FieldInfo const& field) {
      return !field.isInput || field.name == "position" || field.name == "rest_position" ||
             item.info->field(field.name);
    });
  }
  /// The component takes all that the engine was given, and does it itself.
  void law(SceneItem& item, FieldInfo const& linked, SceneItem& engine, std::set<std::string_view>& given) {
    for (auto const& field : item.info->fields) {
      if (!field.isInput || field.name == linked.name || item.element->attribute(field.name)) continue;
      FieldInfo const* const from = engine.info->field(field.name);
      if (!from || !from->isInput) continue;
      const std::string name(field.name);
      field.read(item.address, values_.valueOf({&engine, nullptr, name}));
      if (engine.element->attribute(name)) item.links[name] = text(link_to(engine), '.', name);
      given.insert(field.name);
    }
  }

  /// What a selection is not told, it takes from the state and the topology around it.
  void surroundings(SceneItem& item, std::set<std::string_view>& given) {
    SceneItem* named = nullptr;  // the topology that it names
    if (auto const* link = item.element->attribute("topology"); link && is_link(link->value)) try {
        named = follow_link(item, link->value).item;
      } catch (Error const&) {  // as in SOFA, that of the node then
      }
    for (auto const& field : item.info->fields) {
      if (!field.isInput || given.count(field.name)) continue;
      for (ScenePlace* at = item.place; at; at = at->parent) {
        SceneItem* from = nullptr;
        std::string data(field.name);
        const bool besides = field.name == "rest_position" && !item.info->traits.law.empty();
        if ((field.name == "position" || besides) && !item.info->dataTypes.empty()) {
          from = at->ofRole(RoleKind::state);
          data = item.info->traits.ofPositions && !besides ? "position" : "rest_position";
          if (!from) from = at->ofRole(RoleKind::topology), data = "position";
        } else if (dialect::has(topologyLists, field.name)) {
          from = named && named->info ? named : at->ofRole(RoleKind::topology);
        }
        if (!from || !offered(*from->info, data) || takesFrom(*from, item)) continue;
        messages_.locate(item, [&] {
          field.read(item.address, values_.valueOf({from, nullptr, data}));
          item.links[std::string(field.name)] =
              text(from == named ? link_to(*from) : text('@', from->name), '.', data);
        });
        break;
      }
    }
  }

  /// An engine between two states that names them by object1 and object2 has their points at rest.
  void pairOfStates(SceneItem& item, std::set<std::string_view>& given) {
    static constexpr std::array pairs =
        std::to_array<std::array<std::string_view, 2>>({{"object1", "position1"}, {"object2", "position2"}});
    for (auto const& pair : pairs) {
      const std::string_view object = pair[0], position = pair[1];
      auto const* link = item.element->attribute(object);
      FieldInfo const* const field = item.info->field(position);
      if (!link || !field || !field->isInput || given.count(position)) continue;
      auto const* rest = item.element->attribute("useRestPosition");
      const bool moved = rest && (rest->value == "0" || rest->value == "false");
      messages_.locate(item, [&] {
        LinkTarget target = follow_link(item, link->value);
        if (!target.item) target.item = target.place->ofRole(RoleKind::state);
        if (!target.item) throw Error("", text(object, ": ", shown(link->value), " leads to no state"));
        target.data = moved ? "position" : "rest_position";
        item.links[std::string(position)] = text(link_to(*target.item), '.', target.data);
        field->read(item.address, values_.valueOf(target));
        given.insert(position);
      });
    }
  }

  /// A state that is given no points starts at rest, where it is told how; else it takes, at init, those of
  /// the topology of its node; here it takes those of another where that has none. One of its own without any
  /// topology has one point, at the origin, and none beside what makes points while the scene runs.
  void statePoints(SceneItem& item, std::set<std::string_view> const& given) {
    if (given.count("position")) return movedPoints(item);
    if (given.count("rest_position") && !item.failed)
      if (const std::string rest = item.info->field("rest_position")->write(item.address); !rest.empty())
        return item.info->field("position")->read(item.address, rest);
    SceneItem const* const used = item.place->ofRole(RoleKind::topology);
    if (SceneItem* topology = values_.withPoints(*item.place)) {
      if (topology != used) values_.takeFrom(item, "position", *topology, "position");
    } else if (!used && !item.place->ofRole(RoleKind::mapping) && !pointsChange(*item.place)) {
      values_.component(item).template visit<role::State>(
          [&](auto& state) { state.position.push_back(std::decay_t<decltype(state)>::DataTypes::zero()); });
    }
  }

  /// Whether the points of a node are those of the state above it.
  static bool isIdentity(ScenePlace const& place) {
    SceneItem const* const mapping = place.ofRole(RoleKind::mapping);
    return mapping && mapping->info->traits.samePoints;
  }

  static bool pointsChange(ScenePlace const& place) {
    return std::any_of(place.items.begin(), place.items.end(), [](auto const& other) {
      return other->info && other->info->traits.changesPoints;
    });
  }

  /// A visual model without vertices has, below a mapping of the same points, those of the state above,
  /// otherwise those of the nearest topology; and its elements, where it has none of its own.
  void fillVisualModel(SceneItem& item, std::set<std::string_view> const& given) {
    if (given.count("position")) return;
    SceneItem* topology = nullptr;
    for (ScenePlace* at = item.place; at && !topology; at = at->parent) {
      topology = at->ofRole(RoleKind::topology);
      if (!at->state.empty()) break;
    }
    if (isIdentity(*item.place))
      messages_.locate(item, [&] {
        std::string words;
        ScenePlace* at = item.place;
        do {
          at = at->parent;
          while (at->state.empty()) at = at->parent;
          words = values_.valueOf({at->ofRole(RoleKind::state), nullptr, "position"});
        } while (words.empty() && isIdentity(*at));
        if (at->state.find("Rigid3") != at->state.npos) words = every(words, 7, 3, "");
        item.info->field("position")->read(item.address, words);
      });
    else if (topology && offered(*topology->info, "position"))
      values_.takeFrom(item, "position", *topology, "position");
    std::size_t points = 0;
    values_.component(item).template visit<role::VisualModel>(
        [&](auto const& v) { points = v.mesh.positions.size(); });
    static constexpr std::array lists = std::to_array<std::string_view>({"edges", "triangles", "quads"});
    if (!topology || item.failed ||
        std::any_of(lists.begin(), lists.end(), [&](std::string_view list) { return given.count(list); }))
      return;
    for (const std::string_view list : lists) {
      if (!offered(*topology->info, list)) continue;
      std::vector<int> corners;
      messages_.locate(item, [&] {
        read_value(values_.valueOf({topology, nullptr, std::string(list)}), corners);
      });
      if (std::all_of(corners.begin(), corners.end(), [&](int i) { return i >= 0 && i < int(points); }))
        values_.takeFrom(item, list, *topology, list);
    }
  }

  /// Where a RigidMapping says of another number of points than there are which bodies carry them, all are
  /// carried by that of `index`, or the first, as in SOFA.
  void bodiesOfPoints(SceneItem& item) {
    FieldInfo const* const bodies = item.info->field("rigidIndexPerPoint");
    if (!bodies || item.failed) return;
    SceneItem* child = item.place->ofRole(RoleKind::state);
    if (!child) child = item.place->ofRole(RoleKind::visualModel);
    FieldInfo const* const own = item.info->field("initialPoints");
    if (!child || !child->info || child->failed || !own) return;
    auto entries = [](FieldInfo const& field, SceneItem const& of) {
      return field.type->entries(static_cast<char const*>(of.address) + field.offset);
    };
    const std::size_t named = entries(*bodies, item);
    std::size_t points = entries(*own, item);
    if (points == 0) points = entries(*child->info->field("position"), *child);
    if (named < 2 || points == 0 || named == points) return;
    auto const* const index = item.element->attribute("index");
    const std::string body = index ? index->value : "0";
    messages_.locate(item, [&] { bodies->read(item.address, body); });
    messages_.warnings.insert(text(item.element->place(),
                                   ": <",
                                   item.tag,
                                   ">: rigidIndexPerPoint has ",
                                   named,
                                   " entries for ",
                                   points,
                                   " points; body ",
                                   body,
                                   " carries all of them, as in SOFA"));
  }

  /// A field of a visual model that says how its faces look: nothing moves otherwise without it.
  static bool isLook(SceneItem const& item, FieldInfo const& field) {
    static constexpr std::array ofMesh =
        std::to_array<std::string_view>({"position", "edges", "triangles", "quads"});
    return item.info->role == RoleKind::visualModel && !dialect::has(ofMesh, field.name);
  }
  void leaveOut(SceneItem& item, std::string_view name, std::string_view why) {
    messages_.warnings.insert(
        text(item.element->place(), ": <", item.tag, ">: ", name, ": ", why, "; it is left out"));
  }
  /// Texcoords of a loader come with their numbers at the corners of faces. Those that do not fit are left
  /// out.
  void fillLooks(SceneItem& item, std::set<std::string_view> const& given) {
    if (const auto link = item.links.find("texcoords"); link != item.links.end() && !item.failed) {
      const LinkTarget from = follow_link(item, link->second);
      for (const std::string_view list : {"textureTriangles", "textureQuads"})
        if (!given.count(list) && from.item && from.item->info && from.data == "texcoords" &&
            offered(*from.item->info, list))
          values_.takeFrom(item, list, *from.item, list);
    }
    values_.component(item).template visit<role::VisualModel>([&](auto& visual) {
      if constexpr (requires { visual.wrongLooks(); }) {
        const std::string wrong = visual.wrongLooks();
        if (wrong.empty()) return;
        visual.setLooks({});
        for (auto const& field : item.info->fields)
          if (isLook(item, field)) item.links.erase(std::string(field.name));
        leaveOut(item, "texcoords and materials of its faces", wrong);
      }
    });
  }

 private:
  ComponentValues<R>& values_;
  SceneMessages& messages_;

  static constexpr auto topologyLists =
      std::to_array<std::string_view>({"edges", "triangles", "quads", "tetrahedra", "hexahedra"});

  // those that an engine has moved, from its input_position, are the points of the topology all the same
  void movedPoints(SceneItem& item) {
    SceneItem* from = &item;
    for (std::string_view name : {"position", "input_position"}) {
      FieldInfo const* const field = from->info->field(name);
      const auto link = field ? from->links.find(field->name) : from->links.end();
      if (link == from->links.end()) return;
      from = follow_link(*from, link->second).item;
      if (!from || !from->info) return;
    }
    if (from == item.place->ofRole(RoleKind::topology))
      if (FieldInfo const* const same = item.info->field("points_of_topology")) same->read(item.address, "1");
  }
  // whether links of a component lead to another one, through others or not
  static bool takesFrom(SceneItem& from, SceneItem const& item) {
    std::set<SceneItem const*> seen;
    return takesFrom(from, item, seen);
  }
  static bool takesFrom(SceneItem& from, SceneItem const& item, std::set<SceneItem const*>& seen) {
    if (&from == &item) return true;
    if (!seen.insert(&from).second || seen.size() > 1000) return false;
    for (auto const& a : from.element->attributes) {
      if (!is_link(a.value) || a.name == "input" || a.name == "output") continue;
      try {
        if (SceneItem* const to = follow_link(from, a.value).item; to && takesFrom(*to, item, seen))
          return true;
      } catch (Error const&) {  // is said where the attribute is read
      }
    }
    return false;
  }
};

}  // namespace detail

}  // namespace sinew
