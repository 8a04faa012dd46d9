// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/engine/transform_engine.hpp>
#include <sinew/runtime/any_component.hpp>
#include <sinew/runtime/scene_reader/attributes.hpp>
#include <sinew/runtime/scene_reader/collect.hpp>
#include <sinew/runtime/scene_reader/links.hpp>

namespace sinew {

namespace detail {

/// The components themselves: made, and given what their attributes say. Links are followed when a value is
/// asked for, so that the order in the file does not matter.
template <class R>
class SceneValues {
 public:
  std::vector<std::string> files{};  // data files that were read

  SceneValues(SceneCollector& collector, XmlReader& xml, SceneMessages& messages)
      : collector_(collector), xml_(xml), messages_(messages) {}

  /// All in and below a node.
  void readAll(ScenePlace& top) {
    for_each_item(top, [&](SceneItem& item) {
      if (item.info) prepare(item);
    });
    for_each_item(top, [&](SceneItem& item) {
      if (item.info) resolve(item);
    });
  }
  AnyComponent<R>& component(SceneItem const& item) { return components_.at(&item); }

 private:
  SceneCollector& collector_;
  XmlReader& xml_;
  SceneMessages& messages_;
  std::map<SceneItem const*, AnyComponent<R>> components_{};

  void prepare(SceneItem& item) {
    item.address = components_.emplace(&item, AnyComponent<R>::make(item.info->type)).first->second.address();
  }

  void resolve(SceneItem& item) {
    if (item.progress == SceneItem::Progress::done || item.failed) return;
    if (item.progress == SceneItem::Progress::busy)
      throw Error("", text("leads in a circle back to '", item.name, "'; break it"));
    item.progress = SceneItem::Progress::busy;
    spell_out(item);
    if (item.failed) return void(item.progress = SceneItem::Progress::done);
    expandFile(item);
    const std::vector<XmlAttribute> placing = take_placing(item);
    std::set<std::string_view> given;
    for (auto const& a : item.element->attributes) attribute(item, a, given);
    if (auto const* src = item.element->attribute("src")) source(item, *src, given);
    if (item.info->role == RoleKind::visualModel) fillVisualModel(item, given);
    place(item, placing);
    if (item.info->role == RoleKind::engine && !item.element->attribute("src")) surroundings(item, given);
    if (item.info->role == RoleKind::state) statePoints(item, given);
    messages_.locate(item, [&] {
      component(item).checkFields("");
      component(item).template visit<role::Engine>([&](auto& engine) { engine.update(item.info->cppName); });
      component(item).template visit<role::Topology>([&](auto& topology) {
        if constexpr (requires { topology.generate(""); }) topology.generate(item.info->cppName);
      });
      component(item)
          .template visit<role::InteractionForceField,
                          role::ProjectiveConstraint,
                          role::LagrangianConstraint>([&](auto& joint) {
            if constexpr (requires { joint.ends.object1; })
              joint.ends.object1 = item.ends[0], joint.ends.object2 = item.ends[1];
          });
    });
    if (item.info->role == RoleKind::mapping) ends(item);
    if (item.info->severalParents)
      component(item).template visit<role::Mapping>([&](auto& mapping) {
        if constexpr (requires { mapping.parents.paths; }) mapping.parents.paths = item.parents;
      });
    item.progress = SceneItem::Progress::done;
  }

  // moves a visual model
  void place(SceneItem& item, std::vector<XmlAttribute> const& placing) {
    if (placing.empty() || item.failed) return;
    FieldInfo const& position = *item.info->field("position");
    TransformEngine<Vec3d> engine;
    for (auto const& a : placing) try {
        auto words = [&](auto& to) { read_value(alike(a.value), to); };
        a.name == "translation" ? words(engine.translation)
        : a.name == "rotation"  ? words(engine.rotation)
                                : words(engine.scale);
      } catch (Error const& error) {
        item.failed = true;
        messages_.addError(item.element->place(a), text('<', item.tag, ">: ", a.name, ": ", error.what()));
      }
    messages_.locate(item, [&] {
      read_value(position.write(item.address), engine.inputPosition);
      engine.update(item.name);
      position.read(item.address, write_value(engine.outputPosition));
      item.links.erase("position");
    });
  }

  void attribute(SceneItem& item, XmlAttribute const& a, std::set<std::string_view>& given) {
    static constexpr std::array own = std::to_array<std::string_view>({"name", "template", "src", "type"});
    if (dialect::has(own, a.name) && !(a.name == "type" && item.element->tag != "Object")) return;
    if (a.name == "object1" || a.name == "object2") return;
    if (a.name == "topology") return otherTopology(item, a);
    const bool maps = item.info->role == RoleKind::mapping || item.info->role == RoleKind::engine;
    if (maps && (a.name == "input" || a.name == "output")) return;
    FieldInfo const* field = nullptr;
    for (auto const& f : item.info->fields)
      if (f.isInput && f.known(a.name)) field = &f;
    if (!field) {
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
      return;
    }
    given.insert(field->name);
    try {
      std::string linked;
      if (is_link(a.value) && item.info->role == RoleKind::carving) {
        const LinkTarget model = follow_link(item, a.value);  // a model, by its node
        linked = (model.item ? model.item->place : model.place)->path();
        linked.erase(0, linked.find('/', 1));  // from the root on
      } else if (is_link(a.value)) {
        LinkTarget target;
        if (!followed(item, *field, a, target)) return;
        linked = linkedValue(item, *field, std::move(target));
        item.links[std::string(field->name)] = a.value;
        if (Words(linked).end() && choosesLoaded(*field)) pressNone(item, a, "names no element");
      }
      setField(item, *field, is_link(a.value) ? linked : a.value, a);
    } catch (Error const& error) {
      item.failed = true;
      messages_.addError(item.element->place(a), text('<', item.tag, ">: ", a.name, ": ", error.what()));
    }
  }

  // where a link leads; false where an element does without
  bool followed(SceneItem& item, FieldInfo const& field, XmlAttribute const& a, LinkTarget& target) {
    try {
      target = follow_link(item, a.value);
    } catch (Error const& error) {
      if (!choosesLoaded(field)) throw;
      pressNone(item, a, error.what());
      return false;
    }
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
  static bool moves(ScenePlace const& place) {
    ScenePlace const* const owner = place.owner();
    for (ScenePlace const* at = owner; at; at = at->parent)
      if (at->ofRole(RoleKind::odeSolver)) return true;
    if (!owner) return false;
    return owner->ofRole(RoleKind::mapping) ||
           std::any_of(owner->items.begin(), owner->items.end(), [](auto const& item) {
             return item->info && item->info->traits.movesState;
           });
  }
  // the elements that bear a load: a link to none is meant, or a mistake that SOFA lets pass
  static bool choosesLoaded(FieldInfo const& field) {
    static constexpr std::array lists =
        std::to_array<std::string_view>({"triangleList", "quadList", "edgeIndices"});
    return dialect::has(lists, field.name);
  }
  void pressNone(SceneItem& item, XmlAttribute const& a, std::string_view why) {
    if (auto const* none = item.info->field("none")) none->read(item.address, "1");
    messages_.warnings.insert(text(item.element->place(a),
                                   ": <",
                                   item.tag,
                                   ">: ",
                                   a.name,
                                   ": ",
                                   why,
                                   "; no element bears the load by its number, as in SOFA"));
  }

  // of points in space for frames: these are not rotated
  std::string linkedValue(SceneItem& item, FieldInfo const& field, LinkTarget target) {
    if (!target.item) target.item = target.place->ofRole(RoleKind::state);
    const std::string types = target.item && target.item->info ? target.item->info->dataTypes : "Rigid3d";
    const bool inSpace = types.empty() || types.find("Vec3") != types.npos;
    std::string words = valueOf(std::move(target));
    if (!inSpace || item.info->role != RoleKind::state || !dialect::has(places, field.name)) return words;
    if (item.info->dataTypes.find("Rigid3") != std::string_view::npos) return every(words, 3, 3, "0 0 0 1 ");
    if (item.info->dataTypes.find("Rigid2") != std::string_view::npos) return every(words, 3, 2, "0 ");
    return words;
  }
  static constexpr auto places = std::to_array<std::string_view>({"position", "rest_position"});

  // positions as they are written: as in SOFA numbers at the end that are no whole point are left out; an
  // orientation of zeros is none
  std::string wholePoints(SceneItem& item, std::string const& value, XmlAttribute const& a) {
    const std::string_view types = item.info->dataTypes;
    const std::size_t each = types.find("Rigid3") != types.npos   ? 7
                             : types.find("Rigid2") != types.npos ? 3
                             : types.find("Vec") != types.npos
                                 ? std::size_t(types[types.find("Vec") + 3] - '0')
                                 : 1;
    std::vector<std::string> numbers;
    for (Words words(value); !words.end();) numbers.emplace_back(words.next());
    auto note = [&](auto const&... what) {
      messages_.warnings.insert(text(item.element->place(a), ": <", item.tag, ">: ", a.name, ": ", what...));
    };
    const std::size_t left = numbers.size() % each;
    bool changed = left > 0 && numbers.size() > each;
    if (changed) {
      numbers.resize(numbers.size() - left);
      note("goes on with ",
           left,
           " of the ",
           each,
           " numbers of a point, which are left out; give all, or none");
    }
    auto zero = [](std::string const& word) {
      double number = 1;
      return io::parse_number(word, number) && number == 0;
    };
    for (std::size_t i = 0; each == 7 && i + each <= numbers.size(); i += each)
      if (std::all_of(
              numbers.begin() + std::ptrdiff_t(i) + 3, numbers.begin() + std::ptrdiff_t(i + each), zero)) {
        numbers[i + 6] = "1";
        note("the orientation of point ", i / each, " is zero; it is taken for none, 0 0 0 1");
        changed = true;
      }
    if (!changed) return value;
    std::string all;
    for (auto const& number : numbers) all += text(number, ' ');
    return all;
  }

  // what would make another scene of this one
  void notSimulated(SceneItem& item, XmlAttribute const& a, dialect::NotSimulated const& known) {
    if (dialect::is_standard(known, a.value)) return;
    // a picture has neither forces nor masses
    if (a.name.starts_with("map") && item.info->role == RoleKind::mapping && item.place->state.empty())
      return;
    if (dialect::another_method(item.tag))
      return void(messages_.warnings.insert(text(item.element->place(a),
                                                 ": <",
                                                 item.tag,
                                                 ">: ",
                                                 a.name,
                                                 " is of SOFA's method and has no effect here")));
    for (auto const& other : dialect::anotherLaw)
      if (other.className == item.info->name && other.attribute == a.name)
        return void(messages_.warnings.insert(
            text(item.element->place(a), ": <", item.tag, ">: ", a.name, ": ", other.difference)));
    const std::string_view standard = known.standard.substr(0, known.standard.find('|'));
    const std::string what =
        text('<', item.tag, ">: ", a.name, " is not simulated: only its default ", shown(standard), " is");
    if (collector_.lenient())
      return void(messages_.warnings.insert(text(item.element->place(a), ": ", what, "; it is left out")));
    item.failed = true;
    messages_.addError(item.element->place(a),
                       text(what, "; remove it, or read the scene with --lenient, which leaves it out"));
  }

  // all of a node act over its last topology
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

  void setField(SceneItem& item, FieldInfo const& field, std::string value, XmlAttribute const& written) {
    if (field.name == "scale3d" && written.name == "scale") value = alike(value);
    if (field.name == "position" && item.info->role == RoleKind::topology) value = in_space(item, value);
    if (item.info->role == RoleKind::state && !is_link(written.value) && dialect::has(places, field.name))
      value = wholePoints(item, value, written);
    if (field.isFile) {
      auto const& file = written.file ? written.file : item.element->file;
      value = xml_.find(std::string(Words(value).rest()), file ? file->folder : "");
      files.push_back(value);
    }
    field.read(item.address, value);
  }

  // src="@loader": all that the loader offers under the name of a field that is not given
  void source(SceneItem& item, XmlAttribute const& src, std::set<std::string_view>& given) {
    try {
      const LinkTarget target = follow_link(item, src.value);
      if (!target.item || !target.item->info)
        throw Error("", text(shown(src.value), " leads to no loader; link to a component"));
      for (auto const& field : item.info->fields) {
        if (!field.isInput || given.count(field.name)) continue;
        bool offered = false;
        if (!dialect::container_holds(item.tag, field.name)) continue;
        for (auto const& other : target.item->info->fields)
          if (other.known(field.name) && (!other.isInput || target.item->info->role != RoleKind::engine))
            offered = true;
        if (!offered) continue;
        const std::string words = linkedValue(item, field, {target.item, nullptr, std::string(field.name)});
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

  // what a selection is not told, it takes from the state and the topology around it
  void surroundings(SceneItem& item, std::set<std::string_view>& given) {
    for (auto const& field : item.info->fields) {
      if (!field.isInput || given.count(field.name)) continue;
      for (ScenePlace* at = item.place; at; at = at->parent) {
        SceneItem* from = nullptr;
        std::string data(field.name);
        if (field.name == "position" && !item.info->dataTypes.empty()) {
          from = at->ofRole(RoleKind::state);
          data = "rest_position";
          if (!from) from = at->ofRole(RoleKind::topology), data = "position";
        } else if (dialect::has(topologyLists, field.name)) {
          from = at->ofRole(RoleKind::topology);
        }
        if (!from || !offered(*from->info, data)) continue;
        messages_.locate(item, [&] {
          field.read(item.address, valueOf({from, nullptr, data}));
          item.links[std::string(field.name)] = text('@', from->name, '.', data);
        });
        break;
      }
    }
  }
  static constexpr auto topologyLists =
      std::to_array<std::string_view>({"edges", "triangles", "quads", "tetrahedra", "hexahedra"});

  // A state that is given no points takes, at init, those of the topology of its node; here it takes those of
  // another where that has none. One of its own without any topology has one point, at the origin.
  void statePoints(SceneItem& item, std::set<std::string_view> const& given) {
    if (given.count("position")) return movedPoints(item);
    SceneItem const* const used = item.place->ofRole(RoleKind::topology);
    if (SceneItem* topology = withPoints(*item.place)) {
      if (topology != used) takeFrom(item, "position", *topology, "position");
    } else if (!used && !item.place->ofRole(RoleKind::mapping)) {
      component(item).template visit<role::State>(
          [&](auto& state) { state.position.push_back(std::decay_t<decltype(state)>::DataTypes::zero()); });
    }
  }
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
  SceneItem* withPoints(ScenePlace& place) {
    for (auto item = place.items.rbegin(); item != place.items.rend(); ++item)
      if ((*item)->info && (*item)->info->role == RoleKind::topology && offered(*(*item)->info, "position") &&
          !valueOf({item->get(), nullptr, "position"}).empty())
        return item->get();
    return nullptr;
  }
  void takeFrom(SceneItem& item, std::string_view name, SceneItem& from, std::string_view data) {
    messages_.locate(item, [&] {
      item.info->field(name)->read(item.address, valueOf({&from, nullptr, std::string(data)}));
      item.links[std::string(name)] = text(link_to(from), '.', data);
    });
  }

  static bool isIdentity(ScenePlace const& place) {
    SceneItem const* const mapping = place.ofRole(RoleKind::mapping);
    return mapping && mapping->info->traits.samePoints;
  }

  // A visual model without vertices has, below a mapping of the same points, those of the state above,
  // otherwise those of the nearest topology; and its elements, where it has none of its own.
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
          words = valueOf({at->ofRole(RoleKind::state), nullptr, "position"});
        } while (words.empty() && isIdentity(*at));
        if (at->state.find("Rigid3") != at->state.npos) words = every(words, 7, 3, "");
        item.info->field("position")->read(item.address, words);
      });
    else if (topology && offered(*topology->info, "position"))
      takeFrom(item, "position", *topology, "position");
    std::size_t points = 0;
    component(item).template visit<role::VisualModel>(
        [&](auto const& v) { points = v.mesh.positions.size(); });
    static constexpr std::array lists = std::to_array<std::string_view>({"edges", "triangles", "quads"});
    if (!topology || item.failed ||
        std::any_of(lists.begin(), lists.end(), [&](std::string_view list) { return given.count(list); }))
      return;
    for (const std::string_view list : lists) {
      if (!offered(*topology->info, list)) continue;
      std::vector<int> corners;
      messages_.locate(item, [&] { read_value(valueOf({topology, nullptr, std::string(list)}), corners); });
      if (std::all_of(corners.begin(), corners.end(), [&](int i) { return i >= 0 && i < int(points); }))
        takeFrom(item, list, *topology, list);
    }
  }

  // a file that a visual model or a topology names is read by a loader of its own
  void expandFile(SceneItem& item) {
    if (item.info->field("filename") || item.info->field("fileTopology") ||
        dialect::without_effect(item.info->name, "filename"))
      return;
    auto& attributes = item.element->attributes;
    auto named = std::find_if(attributes.begin(), attributes.end(), [](XmlAttribute const& a) {
      return a.name == "filename" || a.name == "fileMesh" || a.name == "fileTopology";
    });
    if (named == attributes.end()) return;
    const XmlAttribute file = *named;
    const std::string ending = io::lower_case(
        std::string_view(file.value).substr(std::min(file.value.rfind('.'), file.value.size())));
    ClassInfo const* const loader = collector_.loaderOf(ending);
    if (!loader) {
      item.failed = true;
      return messages_.addError(item.element->place(file),
                                text('<',
                                     item.tag,
                                     ">: ",
                                     file.name,
                                     ": ",
                                     shown(file.value),
                                     " has no ending that is known; meshes are ",
                                     collector_.endings()));
    }
    XmlElement& element = collector_.partOf(*item.element, loader->name);
    element.attributes = {{"name", text(item.name, "_loader"), file.offset},
                          {"filename", file.value, file.offset}};
    attributes.erase(named);
    // a surface is moved where it is read
    for (auto a = attributes.begin(); a != attributes.end();)
      if (a->name == "translation" || a->name == "rotation" || a->name == "scale" || a->name == "scale3d") {
        element.attributes.push_back(*a);
        a = attributes.erase(a);
      } else {
        ++a;
      }
    auto made = collector_.makeItem(*item.place, element);
    if (!made) return void(item.failed = true);
    made->info = made->candidates[0];
    prepare(*made);
    item.element->set("src", text('@', made->name));
    auto& items = item.place->items;
    items.insert(std::find_if(items.begin(), items.end(), [&](auto const& i) { return i.get() == &item; }),
                 std::move(made));
  }

  // input and output of a mapping say what the tree says: the state above, and that of its node
  void ends(SceneItem& item) {
    for (std::string_view name : {"input", "output"}) {
      auto const* a = item.element->attribute(name);
      if (!a || !is_link(a->value) || (item.info->severalParents && name == "input")) continue;
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
        messages_.addError(item.element->place(*a), text('<', item.tag, ">: ", a->name, ": ", error.what()));
      }
    }
  }

  /// The words of a field of a component, which is made for that if it is not yet.
  std::string valueOf(LinkTarget target) {
    if (!target.item) {
      if (!target.place->ofRole(RoleKind::state))
        throw Error("", text("leads to the node '", target.place->name, "'; link to a component"));
      target.item = target.place->ofRole(RoleKind::state);
    }
    SceneItem& item = *target.item;
    if (!item.info) throw Error("", text("leads to ", item.name, ", which is wrong itself"));
    resolve(item);
    FieldInfo const* const field = offered(*item.info, target.data);
    if (!field) {
      std::vector<std::string_view> names;
      for (auto const& f : item.info->fields) names.push_back(f.name);
      throw Error("",
                  text("'",
                       item.name,
                       "' (",
                       item.info->name,
                       ") has no '",
                       target.data,
                       "'",
                       suggestion(target.data, names)));
    }
    if (item.info->role == RoleKind::state) return stateValue(item, *field);
    return field->write(item.address);
  }

  // a state takes its points from the topology of its node, and rests where it starts, at init; here it has
  // to be known before
  std::string stateValue(SceneItem& item, FieldInfo const& field) {
    AnyComponent<R> copy(component(item));
    std::vector<Eigen::Vector3d> points;
    if (item.info->field("position")->write(item.address).empty())
      if (SceneItem* topology = withPoints(*item.place))
        read_value(valueOf({topology, nullptr, "position"}), points);
    std::string words;
    copy.template visit<role::State>([&](auto& state) {
      if constexpr (requires { state.place("", points); }) state.place("", points);
      words = field.write(&state);
      if (words.empty() && field.name == "rest_position") words = item.info->field("position")->write(&state);
    });
    return words;
  }
};

}  // namespace detail

}  // namespace sinew
