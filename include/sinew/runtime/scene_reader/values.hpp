// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/engine/transform_engine.hpp>
#include <sinew/runtime/scene_reader/field_links.hpp>
#include <sinew/runtime/scene_reader/implied_values.hpp>
#include <sinew/runtime/scene_reader/loader_of_file.hpp>
#include <sinew/runtime/scene_reader/other_attributes.hpp>

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
    const std::vector<XmlAttribute> placing = take_placing(item);
    std::set<std::string_view> given;
    for (auto const& a : item.element->attributes) attribute(item, a, given);
    if (auto const* src = item.element->attribute("src")) implied_.source(item, *src, given);
    if (item.info->role == RoleKind::visualModel) {
      implied_.fillVisualModel(item, given);
      implied_.fillLooks(item, given);
    }
    place(item, placing);
    if (item.info->role == RoleKind::engine && !item.element->attribute("src"))
      implied_.surroundings(item, given);
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
    if (a.name == "topology") return others_.otherTopology(item, a);
    const bool maps = item.info->role == RoleKind::mapping || item.info->role == RoleKind::engine;
    if (maps && (a.name == "input" || a.name == "output")) return;
    FieldInfo const* field = nullptr;
    for (auto const& f : item.info->fields)
      if (f.isInput && f.known(a.name)) field = &f;
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
      } else if (is_link(a.value)) {
        LinkTarget target;
        if (!follow_field(item, *field, a, target, messages_)) return;
        linked = values_.linkedValue(item, *field, std::move(target));
        item.links[std::string(field->name)] = a.value;
        if (Words(linked).end() && chooses_loaded(*field)) press_none(item, a, "names no element", messages_);
      }
      setField(item, *field, is_link(a.value) ? linked : a.value, a);
    } catch (Error const& error) {
      if (implied_.isLook(item, *field)) return implied_.leaveOut(item, a.name, error.what());
      item.failed = true;
      messages_.addError(item.element->place(a), text('<', item.tag, ">: ", a.name, ": ", error.what()));
    }
  }

  void setField(SceneItem& item, FieldInfo const& field, std::string value, XmlAttribute const& written) {
    if (field.name == "scale3d" && written.name == "scale") value = alike(value);
    if (field.name == "position" && item.info->role == RoleKind::topology) value = in_space(item, value);
    if (item.info->role == RoleKind::state && !is_link(written.value) &&
        dialect::has(fields_of_points, field.name))
      value = whole_points(item, value, written, messages_);
    if (field.isFile) {
      auto const& file = written.file ? written.file : item.element->file;
      value = xml_.find(std::string(Words(value).rest()), file ? file->folder : "");
      files.push_back(value);
    }
    field.read(item.address, value);
  }
};

}  // namespace detail

}  // namespace sinew
