// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/runtime/scene_reader/items.hpp>
#include <sinew/runtime/scene_reader/links.hpp>

#include <algorithm>
#include <array>
#include <memory>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace sinew {

namespace detail {

/// Collision pipelines among some models, as SOFA has them: with links to their models and to their stages,
/// which may stand in one node for several pipelines. Each moves with its stages into a node of its own.
class SubPipelines {
 public:
  static constexpr std::string_view className = "SubCollisionPipeline",
                                    composite = "CompositeCollisionPipeline";

  SubPipelines(SceneItems& items, SceneMessages& messages) : items_(items), messages_(messages) {}

  /// An element that says which of them there are.
  void addComposite(ScenePlace& place, XmlElement& element) {
    items_.hasNoChildren(element);
    composites_.push_back({&place, &element});
  }

  /// All below a node, after all of it has been collected.
  void giveNodes(ScenePlace& top) {
    std::vector<SceneItem*> all;
    for_each_item(top, [&](SceneItem& item) {
      if (isOf(item, className)) all.push_back(&item);
    });
    if (!composites_.empty()) leaveOutUnlisted(all);
    // all links are followed before anything moves
    std::vector<std::vector<SceneItem*>> linked;
    for (SceneItem* item : all) {
      linked.push_back(stagesOf(*item));
      nameModels(*item);
    }
    for (std::size_t i = 0; i < all.size(); ++i)
      if (linked[i].size() == stages.size()) giveNode(top, *all[i], linked[i]);
  }

 private:
  struct Composite {
    ScenePlace* place;
    XmlElement* element;
  };
  static constexpr std::array<std::pair<std::string_view, RoleKind>, 4> stages{
      {{"broadPhaseDetection", RoleKind::broadPhase},
       {"narrowPhaseDetection", RoleKind::narrowPhase},
       {"intersectionMethod", RoleKind::intersection},
       {"contactManager", RoleKind::contactManager}}};

  SceneItems& items_;
  SceneMessages& messages_;
  std::vector<Composite> composites_{};
  std::vector<ScenePlace*> made_{};

  static bool isOf(SceneItem const& item, std::string_view name) { return item.candidates[0]->name == name; }
  static bool hasRole(SceneItem const& item, RoleKind role) { return item.candidates[0]->role == role; }
  /// The links of a list, each from its @ on; a name may have blanks.
  static std::vector<std::string> linksOf(std::string_view list) {
    std::vector<std::string> all;
    while (!list.empty()) {
      const std::size_t next = std::min(list.find('@', 1), list.size());
      if (std::string one(Words(list.substr(0, next)).rest()); !one.empty()) all.push_back(std::move(one));
      list.remove_prefix(next);
    }
    return all;
  }
  void wrong(XmlElement const& element, XmlAttribute const& a, std::string_view what) {
    messages_.addError(element.place(a), text('<', element.tag, ">: ", a.name, ": ", what));
  }
  // what a link leads to; none where it leads nowhere, which is said
  LinkTarget follow(SceneItem& item, XmlAttribute const& a, std::string_view link) {
    try {
      return follow_link(item, link);
    } catch (Error const& error) {
      item.failed = true;
      wrong(*item.element, a, error.what());
      return {};
    }
  }

  void leaveOutUnlisted(std::vector<SceneItem*>& all) {
    std::vector<SceneItem*> listed;
    for (Composite const& c : composites_) {
      SceneItem self{c.place, c.element, std::string(composite), name_of(*c.element, composite)};
      for (XmlAttribute const& a : c.element->attributes)
        if (a.name != "subCollisionPipelines" && a.name != "name" && a.name != "type" && a.name != "depth" &&
            !dialect::without_effect(className, a.name))
          messages_.addError(c.element->place(a),
                             text('<', composite, "> has no attribute '", a.name, "'; remove it"));
      auto const* list = c.element->attribute("subCollisionPipelines");
      const auto links = list ? linksOf(list->value) : std::vector<std::string>();
      if (links.empty()) {
        messages_.addError(*c.element,
                           "it lists no pipelines; give subCollisionPipelines links to those that there are");
        continue;
      }
      for (std::string const& link : links) {
        const LinkTarget target = follow(self, *list, link);
        if (target.item && isOf(*target.item, className))
          listed.push_back(target.item);
        else if (target.item || target.place)
          wrong(*c.element, *list, text(shown(link), " is no <", className, ">; link to one"));
      }
    }
    std::erase_if(all, [&](SceneItem* item) {
      if (std::find(listed.begin(), listed.end(), item) != listed.end()) return false;
      messages_.warnings.insert(text(item->element->place(),
                                     ": <",
                                     className,
                                     "> '",
                                     item->name,
                                     "' is listed by no <",
                                     composite,
                                     ">: it does nothing, as in SOFA, and is left out"));
      takeOut(*item);
      return true;
    });
  }

  static std::unique_ptr<SceneItem> takeOut(SceneItem& item) {
    auto& from = item.place->items;
    const auto at = std::find_if(from.begin(), from.end(), [&](auto const& i) { return i.get() == &item; });
    auto taken = std::move(*at);
    from.erase(at);
    return taken;
  }

  // the stages to which a pipeline links; none where they stand beside it
  std::vector<SceneItem*> stagesOf(SceneItem& pipeline) {
    XmlElement& element = *pipeline.element;
    std::vector<SceneItem*> linked;
    std::string missing;
    for (auto const& [name, role] : stages) {
      auto const* a = element.attribute(name);
      if (!a || a->value.empty()) {
        missing += text(missing.empty() ? "" : ", ", name);
        continue;
      }
      const LinkTarget target = follow(pipeline, *a, a->value);
      if (target.item && hasRole(*target.item, role))
        linked.push_back(target.item);
      else if (target.item || target.place)
        wrong(element, *a, text(shown(a->value), " is no ", enum_names(role)[std::size_t(role)]));
    }
    if (!linked.empty() && !missing.empty())
      messages_.addError(element, text("it has no link to a stage: ", missing, "; give it"));
    return linked;
  }

  void giveNode(ScenePlace& top, SceneItem& pipeline, std::vector<SceneItem*> const& linked) {
    XmlElement& element = *pipeline.element;
    std::erase_if(element.attributes, [](XmlAttribute const& a) {
      return std::any_of(stages.begin(), stages.end(), [&](auto const& s) { return s.first == a.name; });
    });
    std::string name = pipeline.name;
    for (int n = 2; top.child(name); ++n) name = text(pipeline.name, '_', n);
    XmlElement& node = items_.partOf(element, "Node");
    top.children.push_back(std::make_unique<ScenePlace>(ScenePlace{&node, name, &top}));
    ScenePlace& place = *top.children.back();
    made_.push_back(&place);
    auto move = [&](SceneItem& item) {
      auto taken = takeOut(item);
      taken->place = &place;
      place.items.push_back(std::move(taken));
    };
    move(pipeline);
    for (SceneItem* stage : linked) {
      if (std::find(made_.begin(), made_.end(), stage->place) == made_.end()) {
        move(*stage);
        continue;
      }
      XmlElement& again = items_.partOf(*stage->element, stage->element->tag);
      again.attributes = stage->element->attributes;
      items_.addItem(place, again);
    }
  }

  // the models that are linked, by their paths from the root
  void nameModels(SceneItem& pipeline) {
    auto const* const given = pipeline.element->attribute("collisionModels");
    if (!given || !is_link(given->value)) return;
    const XmlAttribute list = *given;
    std::string paths;
    for (std::string const& link : linksOf(list.value)) {
      const LinkTarget target = follow(pipeline, list, link);
      if (target.item && !hasRole(*target.item, RoleKind::collisionModel)) {
        wrong(*pipeline.element, list, text(shown(link), " is no collision model"));
        continue;
      }
      if (!target.item && !target.place) continue;
      std::string path = from_top(target.item ? *target.item->place : *target.place);
      if (target.item) {
        // typed scenes know classes, not names
        auto const& beside = target.item->place->items;
        const std::string_view of = target.item->candidates[0]->name;
        const auto same =
            std::count_if(beside.begin(), beside.end(), [&](auto const& item) { return isOf(*item, of); });
        path += text(path == "/" ? "" : "/", same == 1 ? of : std::string_view(target.item->name));
      }
      paths += text(paths.empty() ? "" : " ", path);
    }
    pipeline.element->set("collisionModels", paths);
  }
};

}  // namespace detail

}  // namespace sinew
