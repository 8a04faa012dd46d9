// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/engine/transform_engine.hpp>
#include <sinew/runtime/scene_reader/elements_of_points.hpp>
#include <sinew/runtime/scene_reader/field_links.hpp>
#include <sinew/runtime/scene_reader/implied_values.hpp>
#include <sinew/runtime/scene_reader/loader_of_file.hpp>
#include <sinew/runtime/scene_reader/other_attributes.hpp>

#include <algorithm>
#include <array>
#include <set>
#include <string>
#include <vector>

namespace sinew {

namespace detail {

/// The components themselves: made, and given what their attributes say. Links are followed when a value is
/// asked for, so that the order in the file does not matter.
template <class R>
class SceneValues {
 public:
  std::vector<std::string> files{};  // data files that were read

  SceneValues(SceneItems& items, XmlReader& xml, SceneMessages& messages)
      : items_(items), xml_(xml), messages_(messages) {}
  SceneValues(SceneValues const&) = delete;  // its parts know where it is
  SceneValues& operator=(SceneValues const&) = delete;

  /// All in and below a node.
  void readAll(ScenePlace& top) {
    for_each_item(top, [&](SceneItem& item) {
      if (item.info) values_.make(item);
    });
    for_each_item(top, [&](SceneItem& item) {
      if (item.info) resolve(item);
    });
    for_each_item(top, [&](SceneItem& item) {
      if (item.info && item.info->role == RoleKind::mapping) implied_.bodiesOfPoints(item);
    });
  }
  AnyComponent<R>& component(SceneItem const& item) { return values_.component(item); }

 private:
  SceneItems& items_;
  XmlReader& xml_;
  SceneMessages& messages_;
  OtherAttributes others_{items_.lenient(), messages_};
  ComponentValues<R> values_{messages_, [this](SceneItem& item) { resolve(item); }};
  ImpliedValues<R> implied_{values_, messages_};

  void resolve(SceneItem& item) {
    if (item.progress == SceneItem::Progress::done || item.failed) return;
    if (item.progress == SceneItem::Progress::busy)
      throw Error("", text("leads in a circle back to '", item.name, "'; break it"));
    item.progress = SceneItem::Progress::busy;
    spell_out(item);
    if (item.failed) return void(item.progress = SceneItem::Progress::done);
    if (SceneItem* loader = add_loader(item, items_, messages_)) values_.make(*loader);
    messages_.locate(item, [&] {
      SceneItem* const above = topology_above(item);
      if (!above || !hasPointsOf(*item.place, *above)) return;
      if (SceneItem* topology = add_topology(item, *above, items_)) {
        values_.make(*topology);
        resolve(*topology);  // nothing links to it
      }
    });
    const std::vector<XmlAttribute> placing = take_placing(item);
    const std::vector<XmlAttribute> more = take_second_translation(item);
    std::set<std::string_view> given;
    if (item.info->traits.sizedValues) setSize(item, given);
    for (auto const& a : item.element->attributes) attribute(item, a, given);
    if (auto const* src = item.element->attribute("src")) implied_.source(item, *src, given);
    if (item.info->role == RoleKind::visualModel) {
      implied_.fillVisualModel(item, given);
      implied_.fillLooks(item, given);
    }
    place(item, placing);
    for (auto const& a : more) moveFurther(item, a);
    if (item.info->role == RoleKind::engine) implied_.pairOfStates(item, given);
    if (item.info->role == RoleKind::engine && !item.element->attribute("src"))
      implied_.surroundings(item, given);
    fitLists(item);
    if (item.info->role == RoleKind::state) implied_.statePoints(item, given);
    messages_.locate(item, [&] {
      component(item).checkFields("");
      component(item).template visit<role::Engine>([&](auto& engine) { engine.update(item.info->cppName); });
      component(item).template visit<role::Topology>([&](auto& topology) {
        if constexpr (requires { topology.generate(""); }) topology.generate(item.info->cppName);
      });
    });
    if (Linked* ends = component(item).ends()) *ends = {item.ends[0], item.ends[1]};
    if (item.info->role == RoleKind::mapping) check_ends(item, messages_);
    if (auto* parents = component(item).parents()) *parents = item.parents;
    item.progress = SceneItem::Progress::done;
  }

  // whether a topology has as many points as the state of a node, which has those of the state above where it
  // is mapped onto the same
  bool hasPointsOf(ScenePlace const& node, SceneItem& topology) {
    auto numbers = [this](SceneItem& of) {
      std::size_t count = 0;
      const std::string all = values_.valueOf({&of, nullptr, "position"});
      for (Words words(all); !words.end(); words.next()) ++count;
      return count;
    };
    ScenePlace const* at = &node;
    std::size_t own = 0;
    while (at && (own = numbers(*at->ofRole(RoleKind::state))) == 0 && implied_.isIdentity(*at))
      at = at->parent->owner();
    return own > 0 && offered(*topology.info, "position") && own == numbers(topology);
  }

  // translation2 of a state comes behind its translation
  void moveFurther(SceneItem& item, XmlAttribute const& a) {
    FieldInfo const& field = *item.info->field("translation");
    Eigen::Vector3d first, second;
    try {
      read_value(is_link(a.value) ? values_.linkedValue(item, field, follow_link(item, a.value)) : a.value,
                 second);
      read_value(field.write(item.address), first);
      field.read(item.address, write_value(Eigen::Vector3d(first + second)));
    } catch (Error const& error) {
      item.failed = true;
      messages_.addError(item.element->place(a), text('<', item.tag, ">: ", a.name, ": ", error.what()));
    }
  }

  // the size of values that a template names; else that of the first link counts
  static void setSize(SceneItem& item, std::set<std::string_view>& given) {
    auto const* types = item.element->attribute("template");
    if (item.element->attribute("size")) given.insert("size");
    if (!types || given.count("size")) return;
    const std::string name = canonical_template(types->value);
    std::string size;
    if (name.starts_with("Vec") && name.size() == 5) size = name.substr(3, 1);
    if (name.starts_with("Rigid3")) size = "7";
    if (name.starts_with("Rigid2")) size = "3";
    if (size.empty()) return;
    item.info->field("size")->read(item.address, size);
    given.insert("size");
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
      if (const auto link = item.links.find("position"); link != item.links.end()) {
        item.moved = link->second;
        item.links.erase(link);
      }
    });
  }

  // a mapping of which one or another class has two parents of different kinds, named each by a link
  static bool ofTwoParents(SceneItem const& item) {
    return std::any_of(
        item.candidates.begin(), item.candidates.end(), [](auto const* c) { return !c->in2.empty(); });
  }
  void attribute(SceneItem& item, XmlAttribute const& a, std::set<std::string_view>& given) {
    static constexpr std::array own = std::to_array<std::string_view>({"name", "template", "src", "type"});
    if (dialect::has(own, a.name) && !(a.name == "type" && item.element->tag != "Object")) return;
    if (a.name == "object1" || a.name == "object2") return;
    if ((a.name == "topology" || a.name == "useRestPosition") && item.info->role == RoleKind::engine) return;
    if (a.name == "topology") return others_.otherTopology(item, a);
    if ((a.name == "geometryState" && item.info->role == RoleKind::mass) ||
        (a.name == "tagMechanics" && item.info->role == RoleKind::forceField))
      return others_.geometry(item, a);
    const bool maps = item.info->role == RoleKind::mapping || item.info->traits.joinsTopologies;
    if (maps && (a.name == "input" || a.name == "output")) return;
    if ((a.name == "input1" || a.name == "input2") && ofTwoParents(item)) return;
    FieldInfo const* field = nullptr;
    int number = -1;  // of a list among several
    for (auto const& f : item.info->fields) {
      if (!f.isInput) continue;
      if (const int n = f.numberOf(a.name); n >= 0) field = &f, number = n;
      if (number < 0 && f.known(a.name)) field = &f;
    }
    if (!field) return others_.withoutField(item, a);
    given.insert(field->name);
    try {
      std::string linked;
      const bool namesNode = item.info->role == RoleKind::carving ||
                             (item.info->role == RoleKind::cutting && field->name != "indices");
      if (is_link(a.value) && namesNode) {
        const LinkTarget model = follow_link(item, a.value);  // a model, by its node
        linked = (model.item ? model.item->place : model.place)->path();
        linked.erase(0, linked.find('/', 1));  // from the root on
      } else if (const auto several = several_links(a.value); several.size() > 1) {
        XmlAttribute one = a;
        for (std::string const& link : several) {
          LinkTarget target;
          one.value = link;
          if (follow_field(item, *field, one, target, messages_))
            linked += values_.linkedValue(item, *field, std::move(target)) + ' ';
        }
      } else if (is_link(a.value)) {
        LinkTarget target;
        if (!follow_field(item, *field, a, target, messages_)) return void(given.erase(field->name));
        if (implied_.takesLaw(item, target)) return implied_.law(item, *field, *target.item, given);
        if (item.info->traits.sizedValues && given.insert("size").second)
          if (const std::size_t size = values_.sizeOfValues(target); size > 0)
            item.info->field("size")->read(item.address, std::to_string(size));
        SceneItem const* const box = moving_box(item, *field, target);
        linked = values_.linkedValue(item, *field, std::move(target));
        if (box) {  // what is in it at the time
          item.info->field("box")->read(item.address, box->info->field("box")->write(box->address));
          linked.clear();
        }
        item.links[number < 0 ? std::string(field->name) : a.name] = a.value;
        if (Words(linked).end() && chooses_loaded(*field)) press_none(item, a, "names no element", messages_);
      }
      std::string const& value = is_link(a.value) ? linked : a.value;
      if (number >= 0)
        setNumbered(item, *field, std::size_t(number), value);
      else
        setField(item, *field, value, a);
    } catch (Error const& error) {
      if (implied_.isLook(item, *field)) return implied_.leaveOut(item, a.name, error.what());
      item.failed = true;
      messages_.addError(item.element->place(a), text('<', item.tag, ">: ", a.name, ": ", error.what()));
    }
  }

  // one list of a list of lists, or all of them, each in brackets
  static void setNumbered(SceneItem& item, FieldInfo const& field, std::size_t number,
                          std::string const& value) {
    if (number == 0 && value.find('[') != value.npos) return field.read(item.address, value);
    std::vector<std::string> lists = split_lists(field.write(item.address));
    if (lists.size() <= number) lists.resize(number + 1);
    lists[number] = value;
    field.read(item.address, join_lists(lists));
  }

  void setField(SceneItem& item, FieldInfo const& field, std::string value, XmlAttribute const& written) {
    if (field.name == "scale3d" && written.name == "scale") value = alike(value);
    if (field.name == "position" && item.info->role == RoleKind::topology) value = in_space(item, value);
    if (item.info->role == RoleKind::state && !is_link(written.value) &&
        dialect::has(fields_of_points, field.name))
      value = whole_points(item, value, written, messages_);
    if (field.isFile) {
      auto const& file = written.file ? written.file : item.element->file;
      const std::string folder = file ? file->folder : "";
      std::string found;
      for (std::string const& name : field.fileNames(value)) {
        // SOFA's names of shapes, such as #cube, are no files
        if (!name.starts_with('#')) files.push_back(xml_.find(name, folder));
        found += text(found.empty() ? "" : " ", name.starts_with('#') ? name : files.back());
      }
      value = found;
    }
    const std::string part = is_link(written.value) ? value : inPart(item, field, value, written);
    field.read(item.address, part);
  }

  void warn(SceneItem const& item, XmlAttribute const& a, std::string_view what) {
    messages_.warnings.insert(text(item.element->place(a), ": <", item.tag, ">: ", a.name, ": ", what));
  }
  // as much of a value as SOFA reads
  std::string inPart(SceneItem const& item, FieldInfo const& field, std::string const& value,
                     XmlAttribute const& written) {
    Words words(value);
    if (field.kind == "whole number" && !words.end()) {
      // SOFA reads digits up to the first other letter: 1 of 1e4
      const std::string_view word = words.next();
      const std::size_t digits = std::min(word.find_first_not_of("0123456789"), word.size());
      double number = 0;
      if (!words.end() || digits == 0 || digits == word.size() || !io::parse_number(word, number))
        return value;
      warn(item,
           written,
           text(shown(word), " is read as ", word.substr(0, digits), ", as in SOFA; write a whole number"));
      return std::string(word.substr(0, digits));
    }
    if (!dialect::is_read_in_part(item.info->name, written.name)) return value;
    std::size_t most = 1;  // words
    if (field.kind.find("inertia") != field.kind.npos)
      most = item.info->dataTypes.find("Rigid2") != item.info->dataTypes.npos ? 3 : 11;
    std::string part;
    std::size_t count = 0;
    for (; !words.end(); ++count) {
      const std::string_view word = words.next();
      if (count < most) part += text(part.empty() ? "" : " ", word);
    }
    if (count <= most) return value;
    warn(item, written, text("has ", count, " numbers; the first ", most, " are taken, as in SOFA"));
    return part;
  }
  // of a list that has as many entries as another one further ones are left out, or the first is for all
  void fitLists(SceneItem& item) {
    for (auto const& rule : dialect::asManyAs) {
      if (rule.className != item.info->name || item.failed) continue;
      FieldInfo const &list = *item.info->field(rule.list), &other = *item.info->field(rule.other);
      auto count = [&](FieldInfo const& f) {
        return f.type->entries(static_cast<char*>(item.address) + f.offset);
      };
      const std::size_t n = count(list), wanted = count(other);
      auto const& given = item.element->attributes;
      const auto a =
          std::find_if(given.begin(), given.end(), [&](auto const& one) { return list.known(one.name); });
      if (wanted == 0 || a == given.end() || (rule.firstForAll ? n < 2 || n == wanted : n <= wanted))
        continue;
      std::vector<std::string> words;
      const std::string all = list.write(item.address);
      for (Words w(all); !w.end();) words.emplace_back(w.next());
      std::string first;
      for (std::size_t k = 0; k < words.size() / n * (rule.firstForAll ? 1 : wanted); ++k)
        first += text(words[k], ' ');
      list.read(item.address, first);
      warn(item,
           *a,
           text("has ",
                n,
                " entries for ",
                wanted,
                " of ",
                rule.other,
                rule.firstForAll ? "; the first is that of all, as in SOFA"
                                 : "; the first ones are taken, as in SOFA"));
    }
  }
};

}  // namespace detail

}  // namespace sinew
