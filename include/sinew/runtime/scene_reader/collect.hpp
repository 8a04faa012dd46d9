// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/runtime/scene_reader/articulations.hpp>
#include <sinew/runtime/scene_reader/composed_elements.hpp>
#include <sinew/runtime/scene_reader/element_settings.hpp>
#include <sinew/runtime/scene_reader/split_visuals.hpp>
#include <sinew/runtime/scene_reader/sub_pipelines.hpp>

#include <map>
#include <memory>

namespace sinew {

namespace detail {

/// The nodes and components of a scene file, of whatever class: what stands for several components, or for a
/// setting of another one, is taken apart here.
class SceneCollector {
 public:
  SceneCollector(SceneItems& items, SceneMessages& messages)
      : items_(items),
        messages_(messages),
        composed_(items, messages),
        pipelines_(items, messages),
        articulations_(messages) {}

  /// All in and below a node.
  void collectAll(ScenePlace& top) {
    collect(top);
    pipelines_.giveNodes(top);
    articulations_.giveAll(top);
    ElementSettings(messages_).giveAll(top);
    split_visuals(top, items_);
  }

 private:
  SceneItems& items_;
  SceneMessages& messages_;
  ComposedElements composed_;
  SubPipelines pipelines_;
  Articulations articulations_;

  void collect(ScenePlace& place) {
    std::map<std::string, int> names;
    for (auto& child : place.element->children) switch (items_.names().kindOf(child)) {
        case ElementKind::node:
          collectNode(place, child, names);
          break;
        case ElementKind::newton:
          items_.hasNoChildren(child);
          place.newton.push_back(&child);
          break;
        case ElementKind::density:
          items_.hasNoChildren(child);
          place.densities.push_back(&child);
          break;
        case ElementKind::preconditioner:
          items_.hasNoChildren(child);
          items_.warnOfMethod(child, tag_of(child));
          place.preconditioners.push_back(&child);
          break;
        case ElementKind::boxConstraint:
          composed_.boxConstraint(place, child);
          break;
        case ElementKind::implicitWithCG:
          composed_.cgImplicit(place, child);
          break;
        case ElementKind::forceAndMass:
          composed_.forceAndMass(place, child, *dialect::force_and_mass(tag_of(child)));
          break;
        case ElementKind::compositePipeline:
          pipelines_.addComposite(place, child);
          break;
        case ElementKind::articulation:
          items_.hasNoChildren(child);
          articulations_.add(place, child);
          break;
        default:
          if (auto item = items_.makeItem(place, child)) {
            const bool isState = item->candidates[0]->role == RoleKind::state;
            place.items.push_back(std::move(item));
            if (isState) composed_.externalForce(place, child);
          }
      }
  }
  // `names`: of the nodes before it, and how many have each
  void collectNode(ScenePlace& place, XmlElement& child, std::map<std::string, int>& names) {
    auto const* active = child.attribute("activated");
    if (active && (active->value == "0" || active->value == "false"))
      return void(messages_.ignored.insert(text("Node ", name_of(child, "Node"), " (activated is 0)")));
    std::string name = name_of(child, "Node");
    if (const int n = names[name]++) {
      const std::string renamed = text(name, '_', n + 1);
      if (child.attribute("name"))
        messages_.warnings.insert(
            text(child.place(), ": a second node is named '", name, "'; it is called '", renamed, "' here"));
      name = renamed;
    }
    place.children.push_back(std::make_unique<ScenePlace>(ScenePlace{&child, name, &place}));
    collect(*place.children.back());
  }
};

}  // namespace detail

}  // namespace sinew
