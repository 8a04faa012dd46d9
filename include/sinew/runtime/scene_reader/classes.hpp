// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/runtime/scene_reader/links.hpp>

namespace sinew {

namespace detail {

/// Which class of a registry each component is: states say it themselves, all else follows from the states
/// that they act on.
class SceneClasses {
 public:
  SceneClasses(std::vector<ClassInfo> const& table, SceneMessages& messages)
      : table_(table), messages_(messages) {}

  /// All in and below a node.
  void decideAll(ScenePlace& top) {
    decideStates(top);
    decideClasses(top);
    for_each_item(top, [&](SceneItem& item) { connect(item); });
  }

 private:
  std::vector<ClassInfo> const& table_;
  SceneMessages& messages_;

  static std::string templateOf(SceneItem const& item) {
    auto const* given = item.element->attribute("template");
    return given ? canonical_template(given->value) : "";
  }

  void decideStates(ScenePlace& place) {
    for (auto& item : place.items) {
      const RoleKind role = item->candidates[0]->role;
      if (role == RoleKind::state) {
        const std::string wanted = templateOf(*item).empty() ? "Vec3d" : templateOf(*item);
        item->info = withTypes(*item, wanted);
        if (item->info && place.state.empty()) place.state = wanted;
      } else if (role == RoleKind::visualModel) {
        item->info = item->candidates[0];
        place.visual = true;
      }
    }
    for (auto& child : place.children) decideStates(*child);
  }

  ClassInfo const* withTypes(SceneItem& item, std::string_view types, std::string_view why = "") {
    std::string known;
    for (auto const* info : item.candidates) {
      if (info->dataTypes == types) return info;
      if (text(", ", known, ", ").find(text(", ", info->dataTypes, ", ")) == std::string::npos)
        known += text(known.empty() ? "" : ", ", info->dataTypes);
    }
    item.failed = true;
    auto const* given = item.element->attribute("template");
    std::string advice;
    if (types.starts_with("Cuda") && !onDevice())
      advice = text("; this program has none of the CUDA DataTypes: take ",
                    types.substr(4),
                    ", or run the scene with the program sinew_cuda, which `cmake --build build --target "
                    "sinew_cuda` makes where nvcc is installed");
    else if (types.starts_with("Cuda") && item.candidates[0]->role == RoleKind::collisionModel)
      advice = "; map the state to one over Vec3d, and put the collision model there";
    messages_.addError(
        given ? item.element->place(*given) : item.element->place(),
        text('<', item.tag, "> is not there over ", types, why, "; it is over ", known, advice));
    return nullptr;
  }
  // some class is over the DataTypes of a device
  bool onDevice() const {
    return std::any_of(
        table_.begin(), table_.end(), [](auto const& info) { return info.dataTypes.starts_with("Cuda"); });
  }

  // a node that has a picture only, which is left out
  static bool onlyShown(ScenePlace const& place) {
    return std::any_of(place.element->children.begin(), place.element->children.end(), [](auto const& child) {
      return tag_of(child) == dialect::shownByColours;
    });
  }

  void decideClasses(ScenePlace& place) {
    for (auto& item : place.items)
      if (!item->info && !item->failed) item->info = decide(*item);
    for (auto& child : place.children) decideClasses(*child);
  }

  ClassInfo const* decide(SceneItem& item) {
    ClassInfo const& first = *item.candidates[0];
    ScenePlace const* const owner = item.place->owner();
    const std::string given = templateOf(item);
    switch (first.role) {
      case RoleKind::mapping: {
        ScenePlace const* parent = item.place->parent ? item.place->parent->owner() : nullptr;
        std::vector<ScenePlace const*> parents;
        // of a mapping from one parent or two, the element says from how many
        const bool several = followsSeveral(item);
        if (several) {
          parents = parentsOf(item);
          if (parents.empty()) return nullptr;
          parent = parents[0];
        }
        if (!parent)
          return messages_.addError(
                     *item.element,
                     "has no parent: no node above has a MechanicalObject; add one, or remove the mapping"),
                 nullptr;
        if (item.place->state.empty() && !item.place->visual && onlyShown(*item.place)) {
          messages_.ignored.insert(text(item.tag, " onto ", dialect::shownByColours));
          return nullptr;
        }
        if (item.place->state.empty() && !item.place->visual)
          return messages_.addError(
                     *item.element,
                     "has no child: its node has neither a MechanicalObject nor an OglModel; add one"),
                 nullptr;
        const std::string out = item.place->state.empty() ? "Vec3f" : item.place->state;
        const bool ofTwo = std::any_of(item.candidates.begin(), item.candidates.end(), [&](auto const* c) {
          return several && !c->in2.empty();
        });
        if (ofTwo && parents.size() == 2)
          return withTypes(item,
                           text(parent->state, ',', parents[1]->state, ',', out),
                           text(", from the states of '",
                                parent->name,
                                "' and '",
                                parents[1]->name,
                                "' to that of '",
                                item.place->name,
                                "'"));
        if (ofTwo)
          return messages_.addError(*item.element,
                                    text("follows two parents, and names ",
                                         parents.size(),
                                         "; name both: input1=\"@../points\" input2=\"@../frame\"")),
                 nullptr;
        return withTypes(
            item,
            text(parent->state, ',', out),
            text(", from the state of '", parent->name, "' to that of '", item.place->name, "'"));
      }
      case RoleKind::linearSolver: {
        // blocks of three are twice as fast where all points are in space
        const std::string_view assembled = allStatesAre(*item.place, "Vec3")
                                               ? "CompressedRowSparseMatrixMat3x3d"
                                               : "CompressedRowSparseMatrixd";
        // numbers one by one and in blocks have the same solution, but preconditioners differ
        if (auto const* named = item.element->attribute("template");
            named && named->value == "CompressedRowSparseMatrix" && !first.field("precondition"))
          return withTypes(item, assembled);
        if (!given.empty()) return withTypes(item, given);
        for (std::string_view wanted : {std::string_view("GraphScattered"), assembled})
          for (auto const* info : item.candidates)
            if (info->dataTypes == wanted) return info;
        return &first;
      }
      case RoleKind::constraintCorrection:
        if (first.dataTypes.empty()) return &first;
        [[fallthrough]];
      case RoleKind::mass:
      case RoleKind::forceField:
      case RoleKind::interactionForceField:
      case RoleKind::stepCallback:
      case RoleKind::collisionModel:
      case RoleKind::lagrangianConstraint:
      case RoleKind::projectiveConstraint: {
        ScenePlace const* acted = owner;
        const bool joins = endsDiffer(item);
        if (joins && item.ends[0].empty() && item.ends[1].empty()) return nullptr;
        if (joins) acted = follow_to_node(item, *item.element->attribute("object1"), messages_);
        std::erase_if(item.candidates, [&](ClassInfo const* info) { return info->joins != joins; });
        if (item.candidates.empty())
          return messages_.addError(*item.element,
                                    joins ? "does not join two objects; remove object1 and object2"
                                          : "joins two objects; give object1 and object2"),
                 nullptr;
        if (!acted)
          return messages_.addError(
                     *item.element,
                     "has no state to act on; put it into a node with a MechanicalObject, or below one"),
                 nullptr;
        if (!given.empty() && given.find(',') == given.npos && given != acted->state && joins == false &&
            first.role != RoleKind::mass && !sameKind(given, acted->state))
          return messages_.addError(item.element->place(*item.element->attribute("template")),
                                    text('<',
                                         item.tag,
                                         "> has the template ",
                                         given,
                                         ", but the state it acts on, in '",
                                         acted->name,
                                         "', is over ",
                                         acted->state,
                                         "; give both the same")),
                 nullptr;
        if (!first.traits.followsObject2.empty() && !followsObject2(item, *acted)) return nullptr;
        return withTypes(item, acted->state, text(", as the state it acts on, in '", acted->name, "'"));
      }
      case RoleKind::engine:
        if (first.dataTypes.empty()) return &first;
        return withTypes(item, onHost(item, !given.empty() ? given : owner ? owner->state : "Vec3d"));
      case RoleKind::behaviorModel:  // with a state of its own
        return given.empty() || first.dataTypes.empty() ? &first : withTypes(item, given);
      default:
        return &first;
    }
  }
  // loaders and selections work on the host: over "Vec3f" for "CudaVec3f", or where they are not, "Vec3d"
  static std::string onHost(SceneItem const& item, std::string const& types) {
    if (!types.starts_with("Cuda")) return types;
    const std::string host = types.substr(4);
    const bool known = std::any_of(item.candidates.begin(), item.candidates.end(), [&](auto const* info) {
      return info->dataTypes == host;
    });
    return known ? host : text(std::string_view(host).substr(0, host.size() - 1), 'd');
  }
  // whether a mapping has several parents: always, or where an input2 leads to one
  static bool followsSeveral(SceneItem const& item) {
    auto several = [](auto const* c) { return c->severalParents; };
    auto const* const second = item.element->attribute("input2");
    return std::all_of(item.candidates.begin(), item.candidates.end(), several) ||
           (second && is_link(second->value) && Words(second->value).rest() != "@" &&
            std::any_of(item.candidates.begin(), item.candidates.end(), several));
  }
  // the nodes of the parents that `input` names, or input1 and input2: "@left @../right/corner"
  std::vector<ScenePlace const*> parentsOf(SceneItem& item) {
    std::vector<ScenePlace const*> parents;
    for (std::string_view const name : {"input", "input1", "input2"}) {
      auto const* const input = item.element->attribute(name);
      if (!input || !is_link(input->value)) continue;
      XmlAttribute one = *input;
      std::string_view const rest = input->value;
      for (std::size_t at = rest.find('@'); at != rest.npos;) {
        const std::size_t next = rest.find('@', at + 1);
        one.value = std::string(rest.substr(at, next == rest.npos ? next : next - at));
        at = next;
        one.value.erase(one.value.find_last_not_of(" \t\r\n") + 1);
        parents.push_back(follow_to_node(item, one, messages_));
        if (!parents.back()) return {};
        item.parents.push_back(from_top(*parents.back()));
      }
    }
    if (parents.empty())
      messages_.addError(*item.element, "names no parents; name them: input=\"@../left @../right\"");
    return parents;
  }
  static bool allStatesAre(ScenePlace const& place, std::string_view kind) {
    return (place.state.empty() || place.state.starts_with(kind) || place.ofRole(RoleKind::mapping)) &&
           std::all_of(place.children.begin(), place.children.end(), [&](auto const& child) {
             return allStatesAre(*child, kind);
           });
  }
  // "Vec3d" for a state over Vec3f is taken for SOFA's default precision
  static bool sameKind(std::string_view a, std::string_view b) {
    return a.substr(0, a.size() - 1) == b.substr(0, b.size() - 1);
  }

  // a force on the state of its node, which object1 may name, follows the state that object2 names
  bool followsObject2(SceneItem& item, ScenePlace const& acted) {
    auto const *a = item.element->attribute("object1"), *b = item.element->attribute("object2");
    if (a && follow_to_node(item, *a, messages_) != &acted)
      return messages_.addError(item.element->place(*a),
                                text('<',
                                     item.tag,
                                     ">: object1 leads to another state than that of its node, '",
                                     acted.name,
                                     "', on which it acts; put it into the node of object1")),
             false;
    if (!b) return true;
    ScenePlace const* const followed = follow_to_node(item, *b, messages_);
    SceneItem const* const state = followed ? followed->ofRole(RoleKind::state) : nullptr;
    if (state) item.element->set(item.candidates[0]->traits.followsObject2, link_to(*state) + ".position");
    return state != nullptr;
  }
  // an interaction joins two bodies, unless both its ends are the state of its own node
  bool endsDiffer(SceneItem& item) {
    auto const *a = item.element->attribute("object1"), *b = item.element->attribute("object2");
    if (!a || !b ||
        std::none_of(item.candidates.begin(), item.candidates.end(), [](auto const* c) { return c->joins; }))
      return false;
    ScenePlace const *first = follow_to_node(item, *a, messages_),
                     *second = follow_to_node(item, *b, messages_);
    if (!first || !second) return true;
    if (first == second && first == item.place->owner()) return false;
    // forces are gathered from the leaves to the root, so that an interaction has to be above its ends
    item.home = item.place;
    while (!item.home->above(*first) || !item.home->above(*second)) item.home = item.home->parent;
    item.ends = {from_top(*first), from_top(*second)};
    return true;
  }

  // a topological mapping takes elements from its input, the topology above where none is named, and its
  // output, or the topology of its node, takes what it makes of them
  void connect(SceneItem& item) {
    if (!item.info || !item.info->traits.joinsTopologies) return;
    auto topologyOf = [&](std::initializer_list<std::string_view> names,
                          ScenePlace* otherwise) -> SceneItem* {
      for (const std::string_view name : names)
        if (auto const* given = item.element->attribute(name)) {
          const std::string link = is_link(given->value) ? given->value : text('@', given->value);
          const LinkTarget target = follow_link(item, link);
          SceneItem* to = target.item ? target.item : target.place->ofRole(RoleKind::topology);
          if (to && to->info && to->info->role == RoleKind::topology) return to;
          throw Error("", text(name, " leads to no topology; link to one"));
        }
      for (ScenePlace* at = otherwise; at; at = at->parent)
        if (SceneItem* found = at->ofRole(RoleKind::topology)) return found;
      throw Error("", text("there is no topology for its ", *names.begin(), "; name one"));
    };
    messages_.locate(item, [&] {
      SceneItem* const input = topologyOf({"input", "object1"}, item.place->parent);
      SceneItem* const output = topologyOf({"output", "object2"}, item.place);
      if (input == output) throw Error("", "has the same topology as input and output; name two");
      item.element->set("src", link_to(*input));
      for (auto const& made : item.info->fields)
        if (!made.isInput && output->info->field(made.name) && !output->element->attribute(made.name))
          output->element->set(made.name, text(link_to(item), '.', made.name));
      if (output->info->field("conversion")) {
        auto const* flips = item.element->attribute("flipNormals");
        const bool flipped = flips && flips->value != "0" && flips->value != "false";
        output->element->set("conversion", text(item.info->name, flipped ? " flipNormals" : ""));
      }
    });
  }
};

}  // namespace detail

}  // namespace sinew
