// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/context/gravity.hpp>
#include <sinew/runtime/scene_files.hpp>
#include <sinew/runtime/scene_reader/classes.hpp>
#include <sinew/runtime/scene_reader/collect.hpp>
#include <sinew/runtime/scene_reader/live_links.hpp>
#include <sinew/runtime/scene_reader/set_attribute.hpp>
#include <sinew/runtime/scene_reader/values.hpp>
#include <sinew/runtime/scope.hpp>
#include <sinew/scene/solvers.hpp>

#include <algorithm>
#include <memory>
#include <set>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace sinew {

namespace detail {

/// Builds a runtime tree from the elements of a scene file, in SOFA's dialect.
template <class R>
class SceneReader {
 public:
  SceneReader(ReadSceneOptions const& options)
      : options_(options), xml_(options.dataPaths, options.missing) {}

  ReadScene<R> read(std::string const& path) { return build(xml_.read(path)); }
  ReadScene<R> parse(std::string const& path, std::string content) {
    return build(xml_.parse(path, std::move(content)));
  }

 private:
  ReadSceneOptions const& options_;
  XmlReader xml_;
  SceneMessages messages_{};
  std::vector<ClassInfo> table_ = make_class_table<R>();
  SceneItems items_{table_, options_.lenient, messages_};
  SceneClasses classes_{table_, messages_};
  SceneValues<R> values_{items_, xml_, messages_};
  std::vector<SceneItem*> moved_{};
  std::set<SceneItem const*> dataOnly_{};  // topologies
  std::vector<ViewElement> view_{};

  ReadScene<R> build(XmlElement root) {
    if (root.tag != "Node")
      throw SceneError(
          {text(root.place(), ": <", root.tag, ">: the outermost element of a scene is <Node>")});
    xml_.expandObjects(
        root, [this](XmlElement const& e) { return items_.names().kindOf(e) != ElementKind::unknown; });
    for (auto const& [path, value] : options_.set) set_attribute(root, path, value);
    addDataPaths(root);
    ScenePlace top{&root, name_of(root, "root"), nullptr};
    SceneCollector(items_, messages_).collectAll(top);
    classes_.decideAll(top);
    values_.readAll(top);
    for_each_item(top, [&](SceneItem& item) {
      if (item.home && item.home != item.place) moved_.push_back(&item);
      if (item.info && item.info->role == RoleKind::topology && holdsDataOnly(*item.place, item))
        dataOnly_.insert(&item);
    });
    ReadScene<R> scene{RuntimeNode<R>(top.name)};
    if (messages_.errors.empty()) scene.root.live = detail::LiveLinks<R>(messages_).find(top);
    readNode(top, scene);
    fill(top, scene.root);
    scene.root.view = std::move(view_);
    addConstraintSolver(top, scene.root);
    if (!messages_.errors.empty()) throw SceneError(messages_.errors);
    scene.ignored.assign(messages_.ignored.begin(), messages_.ignored.end());
    scene.warnings.assign(messages_.warnings.begin(), messages_.warnings.end());
    scene.warnings.insert(scene.warnings.end(), xml_.warnings.begin(), xml_.warnings.end());
    scene.files = values_.files;
    return scene;
  }

  // <AddDataRepository path="meshes"/> names a folder of data, from that of its file on
  void addDataPaths(XmlElement const& in) {
    for (XmlElement const& child : in.children) {
      addDataPaths(child);
      if (!dialect::has(dialect::dataRepositories, tag_of(child))) continue;
      auto const* path = child.attribute("path");
      if (!path || path->value.empty()) continue;
      const bool absolute = path->value.starts_with('/');
      xml_.addDataPath(absolute || !child.file ? path->value : child.file->folder + path->value);
    }
  }

  // An animation loop without a constraint solver takes the one by default, as in SOFA.
  void addConstraintSolver(ScenePlace const& top, RuntimeNode<R>& root) {
    SceneItem const* const loop = top.ofRole(RoleKind::animationLoop);
    if (!loop || any_below<role::ConstraintSolver>(RuntimeScope<R>(root))) return;
    for (ClassInfo const& info : table_)
      if (info.role == RoleKind::constraintSolver && info.traits.takenByDefault) {
        messages_.warnings.insert(text(loop->element->place(),
                                       ": <",
                                       loop->tag,
                                       "> finds no constraint solver, and takes a ",
                                       info.name,
                                       "; add one to the scene"));
        root.add(RuntimeEntry<R>{
            AnyComponent<R>::make(info.type), std::string(info.name), loop->element->place()});
        return;
      }
  }

  void readNode(ScenePlace const& place, ReadScene<R>& scene) {
    auto number = [&](std::string_view name, auto& to) {
      auto const* a = place.element->attribute(name);
      if (!a) return;
      try {
        read_value(a->value, to);
      } catch (Error const& error) {
        messages_.addError(place.element->place(*a), text("<Node>: ", name, ": ", error.what()));
      }
    };
    number("dt", scene.dt);
    number("time", scene.time);
    number("step", scene.step);
    if (!(scene.dt > 0) || !std::isfinite(scene.dt))
      messages_.addError(place.element->place(),
                         text("<Node>: dt is ", scene.dt, " s, but must be a finite number greater than 0"));
  }

  // A topology with other points than the state above its node, which has none, over which nothing acts: its
  // points and elements are those of engines and pictures, and are theirs by now.
  bool holdsDataOnly(ScenePlace const& place, SceneItem& topology) {
    FieldInfo const* const position = topology.info->field("position");
    if (!place.state.empty() || !position || !topology.address || !nothingActs(place)) return false;
    ScenePlace const* const owner = place.owner();
    SceneItem* const state = owner ? owner->ofRole(RoleKind::state) : nullptr;
    if (!state || !state->address) return false;
    const std::string points = position->write(topology.address);
    std::size_t numbers = 0, own = 0;
    for (Words words(points); !words.end(); words.next()) ++own;
    values_.component(*state).template visit<role::State>(
        [&](auto const& s) { numbers = 3 * s.position.size(); });
    return own > 0 && own != numbers;
  }
  static bool nothingActs(ScenePlace const& place) {
    const auto acts = [](std::unique_ptr<SceneItem> const& item) {
      if (!item->info) return false;
      const RoleKind role = item->info->role;
      return role != RoleKind::engine && role != RoleKind::topology && role != RoleKind::visualModel &&
             role != RoleKind::mapping;
    };
    return std::none_of(place.items.begin(), place.items.end(), acts) &&
           std::all_of(place.children.begin(), place.children.end(), [](auto const& child) {
             return !child->state.empty() || nothingActs(*child);
           });
  }

  // those written in a node that belong there, then those that belong there and are written elsewhere
  std::vector<SceneItem*> itemsOf(ScenePlace& place) {
    std::vector<SceneItem*> items;
    SceneItem const* const topology = place.ofRole(RoleKind::topology);
    for (auto& item : place.items) {
      if (item->info && item->info->role == RoleKind::topology &&
          (item.get() != topology || dataOnly_.count(item.get())))
        continue;
      if (!item->home || item->home == &place) items.push_back(item.get());
    }
    for (SceneItem* item : moved_)
      if (item->home == &place) items.push_back(item);
    return items;
  }

  // what an element says of how the scene is looked at: all of its attributes, or some
  void keepView(ScenePlace const& place, XmlElement const& element, std::string const& tag,
                std::span<std::string_view const> of = {}) {
    ViewElement kept{.path = place.path(),
                     .tag = tag,
                     .origin = element.place(),
                     .folder = element.file ? element.file->folder : std::string()};
    for (XmlAttribute const& a : element.attributes)
      if (of.empty() || dialect::has(of, a.name))
        kept.attributes.emplace_back(a.name, a.name == "texturename" ? image(a.value, kept.folder) : a.value);
    if (of.empty() || !kept.attributes.empty()) view_.push_back(std::move(kept));
  }

  // the file of an image; where there is none, pictures say so
  std::string image(std::string const& name, std::string const& folder) const {
    try {
      return xml_.find(name, folder);
    } catch (Error const&) {
      return name;
    }
  }

  void fill(ScenePlace& place, RuntimeNode<R>& node) {
    for (XmlElement const& child : place.element->children)
      if (const std::string tag = tag_of(child); dialect::has(dialect::ofViews, tag))
        keepView(place, child, tag);
    auto const* gravity = place.element->attribute("gravity");
    if (gravity && place.parent) {
      messages_.warnings.insert(
          text(place.element->place(*gravity),
               ": <Node>: gravity has an effect in the outermost node only, as in SOFA; for what is "
               "below another, put <Gravity gravity=\"",
               gravity->value,
               "\"/> into it"));
      gravity = nullptr;
    }
    if (!place.parent) {
      Gravity value;
      try {
        if (gravity) read_value(gravity->value, value.gravity);
      } catch (Error const& error) {
        messages_.addError(place.element->place(*gravity), text("<Node>: gravity: ", error.what()));
      }
      if (!place.ofRole(RoleKind::context)) {
        node.add(value);
        node.components().back().origin = place.element->place();
      }
    }
    static constexpr std::array known =
        std::to_array<std::string_view>({"name", "gravity", "dt", "activated", "step", "type"});
    for (auto const& a : place.element->attributes)
      if (!dialect::has(known, a.name) && !dialect::has(dialect::nodeAttributesWithoutMeaning, a.name) &&
          !a.name.starts_with("show"))
        messages_.addError(place.element->place(a),
                           text("<Node> has no attribute '", a.name, "'", suggestion(a.name, known)));
    for (SceneItem* item : itemsOf(place))
      if (item->address && !item->failed) {
        if (item->info->role == RoleKind::visualModel)
          keepView(place, *item->element, item->tag, looks_of_visuals);
        RuntimeEntry<R> entry{
            std::move(values_.component(*item)), item->name, item->element->place(), std::move(item->links)};
        node.add(std::move(entry));
      }
    for (auto& child : place.children) fill(*child, node.addChild(child->name));
  }
};

/// What f() returns; an Error of it as that of a scene file.
template <class F>
auto as_scene_error(F&& f) {
  try {
    return f();
  } catch (SceneError const&) {
    throw;
  } catch (Error const& error) {
    throw SceneError({error.what()});
  }
}

}  // namespace detail

template <class R>
ReadScene<R> read_scene(std::string const& path, ReadSceneOptions const& options,
                        checks::RegistryVerdict<R>) {
  return detail::as_scene_error([&] { return detail::SceneReader<R>(options).read(path); });
}
template <class R>
ReadScene<R> parse_scene(std::string const& path, std::string content, ReadSceneOptions const& options,
                         checks::RegistryVerdict<R>) {
  return detail::as_scene_error(
      [&] { return detail::SceneReader<R>(options).parse(path, std::move(content)); });
}

}  // namespace sinew
