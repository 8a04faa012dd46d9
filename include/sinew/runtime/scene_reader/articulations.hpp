// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/mapping/articulation.hpp>
#include <sinew/runtime/scene_reader/items.hpp>
#include <sinew/runtime/scene_reader/links.hpp>
#include <sinew/runtime/value_text.hpp>

#include <algorithm>
#include <string>
#include <string_view>
#include <vector>

namespace sinew {

namespace detail {

/// Joints of articulated systems, as SOFA has them: an ArticulatedHierarchyContainer beside nodes, in each of
/// which an ArticulationCenter is, and below it its Articulations. They are the lists `centers` and
/// `articulations` of the ArticulatedSystemMapping that finds the container: by a link, or in or below the
/// node of its first input. Nodes that held nothing else are left out.
class Articulations {
 public:
  static constexpr std::string_view className = "ArticulatedSystemMapping";
  static constexpr auto const& tags = dialect::ofArticulations;

  explicit Articulations(SceneMessages& messages) : messages_(messages) {}

  /// An element of one of the tags, in the order of the file.
  void add(ScenePlace& place, XmlElement& element) {
    const std::string tag = tag_of(element);
    if (tag == tags[0])
      containers_.push_back({&place, &element, name_of(element, tag), false});
    else if (tag == tags[1])
      centers_.push_back({&place, &element, {}, {}});
    else
      addArticulation(place, element);
  }

  /// All below a node, after all of it has been collected.
  void giveAll(ScenePlace& top) {
    if (containers_.empty() && centers_.empty()) return;
    for (Container const& c : containers_)
      readAttributes(*c.element, static_cast<ArticulationCenter*>(nullptr));
    for (Center& c : centers_) readAttributes(*c.element, &c.value);
    for_each_item(top, [&](SceneItem& item) {
      if (item.candidates[0]->name == className) give(item);
    });
    for (SceneItem* held : holding_) leaveOut(*held);
    for (Container const& c : containers_)
      if (!c.used)
        messages_.warnings.insert(text(c.element->place(),
                                       ": <",
                                       tags[0],
                                       "> has no effect: no <",
                                       className,
                                       "> finds it; link to it, container=\"@",
                                       c.name,
                                       "\""));
    for (Container const& c : containers_)
      std::erase_if(c.place->children, [](auto const& child) { return onlyJoints(*child); });
  }

 private:
  struct Container {
    ScenePlace* place;
    XmlElement* element;
    std::string name;
    bool used;
  };
  struct Center {
    ScenePlace* place;
    XmlElement* element;
    ArticulationCenter value;
    std::vector<Articulation> articulations;
  };

  SceneMessages& messages_;
  std::vector<Container> containers_{};
  std::vector<Center> centers_{};
  std::vector<SceneItem*> holding_{};  // constraints on bodies that do not move

  // of the nearest center upwards, which stands before it in the file
  void addArticulation(ScenePlace& place, XmlElement& element) {
    Articulation value;
    readAttributes(element, &value);
    for (ScenePlace const* at = &place; at; at = at->parent)
      for (auto center = centers_.rbegin(); center != centers_.rend(); ++center)
        if (center->place == at) return void(center->articulations.push_back(value));
    messages_.addError(element, text("stands below no <", tags[1], ">; put it into a node below one"));
  }

  // values of the fields of a part, or, where it is a container and has none, what else it may have
  template <class T>
  void readAttributes(XmlElement const& element, T* part) {
    for (XmlAttribute const& a : element.attributes) {
      if (a.name == "name" || a.name == "template" || a.name == "globalPosition" ||
          (a.name == "type" && element.tag == "Object") || dialect::without_effect(tag_of(element), a.name))
        continue;
      bool found = false;
      std::vector<std::string_view> known;
      if (part)
        for_each_field(*part, [&](auto const& fd, auto& value) {
          if (fd.name == "center") return;
          known.push_back(fd.name);
          if (fd.name != a.name && !has_name(fd.aliases, a.name)) return;
          found = true;
          try {
            read_value(a.value, value);
          } catch (Error const& error) {
            messages_.addError(element.place(a), text('<', element.tag, ">: ", a.name, ": ", error.what()));
          }
        });
      if (!part && a.name == "filename") {
        if (!a.value.empty())
          messages_.addError(element.place(a),
                             text('<',
                                  element.tag,
                                  ">: filename: centers and motions are not read from BVH files; write the "
                                  "centers as elements, and move the angles by a "
                                  "LinearMovementProjectiveConstraint"));
      } else if (!found) {
        messages_.addError(
            element.place(a),
            text('<', element.tag, "> has no attribute '", a.name, "'", suggestion(a.name, known)));
      }
    }
  }

  void give(SceneItem& item) {
    Container* const container = find(item);
    if (!container) return;
    container->used = true;
    std::vector<ArticulationCenter> centers;
    std::vector<Articulation> articulations;
    for (Center const& c : centers_) {
      if (!container->place->above(*c.place)) continue;
      for (Articulation one : c.articulations) {
        one.center = int(centers.size());
        articulations.push_back(one);
      }
      centers.push_back(c.value);
    }
    auto const* const file = container->element->attribute("filename");
    if (centers.empty() && (!file || file->value.empty()))
      messages_.addError(*container->element,
                         text("there is no <", tags[1], "> in its node or below; add one for each joint"));
    auto const* const second = item.element->attribute("input2");
    if (!second || !is_link(second->value)) findHolding(*item.place, centers);
    item.element->set("centers", write_value(centers));
    item.element->set("articulations", write_value(articulations));
  }
  // projective constraints hold bodies that nothing bears, in SOFA's scenes, which stay where they are anyway
  void findHolding(ScenePlace const& place, std::vector<ArticulationCenter> const& centers) {
    for (auto const& other : place.items) {
      const std::string_view name = other->candidates[0]->name;
      auto const* const indices = other->element->attribute("indices");
      if ((name != "FixedConstraint" && name != "PartialFixedConstraint") ||
          other->element->attribute("fixAll"))
        continue;
      std::vector<int> held{0};
      try {
        if (indices) read_value(indices->value, held);
      } catch (Error const&) {
        continue;  // is said where attributes are read
      }
      if (std::none_of(centers.begin(), centers.end(), [&](ArticulationCenter const& c) {
            return std::find(held.begin(), held.end(), c.childIndex) != held.end();
          }))
        holding_.push_back(other.get());
    }
  }
  void leaveOut(SceneItem& item) {
    messages_.warnings.insert(text(item.element->place(),
                                   ": <",
                                   item.tag,
                                   "> is left out: the bodies that it holds are borne by no center, and stay "
                                   "where they are"));
    auto& items = item.place->items;
    items.erase(
        std::find_if(items.begin(), items.end(), [&](auto const& other) { return other.get() == &item; }));
  }
  Container* find(SceneItem& item) {
    auto& attributes = item.element->attributes;
    auto const* const link = item.element->attribute("container");
    Container* found = nullptr;
    if (link && is_link(link->value)) {
      found = named(item, *link);
      if (!found)
        messages_.addError(
            item.element->place(*link),
            text('<', item.tag, ">: container: ", shown(link->value), " leads to no <", tags[0], '>'));
    } else if (ScenePlace const* from = firstInput(item)) {
      for (Container& c : containers_)
        if (!found && from->above(*c.place)) found = &c;
    }
    std::erase_if(attributes, [](XmlAttribute const& a) { return a.name == "container"; });
    return found;
  }
  // containers are no items any more, by whose names links are followed: the link to the node is
  Container* named(SceneItem& item, XmlAttribute const& link) {
    const auto words = read_link(link.value);
    if (!words) return nullptr;
    const std::size_t slash = words->path.rfind('/');
    const std::string_view name =
        std::string_view(words->path).substr(slash == words->path.npos ? 0 : slash + 1);
    auto in = [&](ScenePlace const* place, std::string_view of) -> Container* {
      for (Container& c : containers_)
        if (c.place == place && (c.name == of || tags[0] == of)) return &c;
      return nullptr;
    };
    if (slash == words->path.npos) {  // in this node, or one above
      for (ScenePlace const* at = item.place; at; at = at->parent)
        if (Container* const c = in(at, name)) return c;
      return nullptr;
    }
    LinkTarget target;
    ScenePlace* from = item.place;
    if (words->path.starts_with('/'))
      while (from->parent) from = from->parent;
    for (; from; from = words->based ? nullptr : from->parent)
      if (walk_link(*from, words->path.substr(0, slash), target) && target.place)
        if (Container* const c = in(target.place, name)) return c;
    return nullptr;
  }
  // the node of the state that it follows first
  static ScenePlace const* firstInput(SceneItem& item) {
    for (std::string_view const name : {"input1", "input"}) {
      auto const* const input = item.element->attribute(name);
      if (!input || !is_link(input->value)) continue;
      try {
        const LinkTarget target = follow_link(item, input->value);
        return target.item ? target.item->place : target.place;
      } catch (Error const&) {
        return nullptr;  // is said where parents are decided
      }
    }
    return item.place->parent;
  }

  // whether nothing but centers and articulations was here and below
  static bool onlyJoints(ScenePlace const& place) {
    auto const& children = place.element->children;
    return place.items.empty() && !place.visual && !children.empty() &&
           std::all_of(children.begin(),
                       children.end(),
                       [](XmlElement const& e) {
                         return e.tag == "Node" || tag_of(e) == tags[1] || tag_of(e) == tags[2];
                       }) &&
           std::all_of(place.children.begin(), place.children.end(), [](auto const& child) {
             return onlyJoints(*child);
           });
  }
};

}  // namespace detail

}  // namespace sinew
