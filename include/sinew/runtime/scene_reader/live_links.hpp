// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/runtime/live_graph.hpp>
#include <sinew/runtime/scene_reader/attributes.hpp>
#include <sinew/runtime/scene_reader/field_links.hpp>
#include <sinew/runtime/scene_reader/links.hpp>

#include <algorithm>
#include <array>
#include <map>
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace sinew {

namespace detail {

/// Which engines are evaluated again while the scene runs, and what follows what they make: found from the
/// links, when all components are read. An engine lives where a link into it leads to positions or velocities
/// of a state that moves, or to a living engine; it takes elements of a topology again when that is edited.
/// What takes no value while the scene runs is said to keep that of the start.
template <class R>
class LiveLinks {
 public:
  explicit LiveLinks(SceneMessages& messages) : messages_(messages) {}

  /// In and below a node; throws Error where what follows leads in a circle.
  LiveGraph<R> find(ScenePlace& top) {
    for_each_item(top, [&](SceneItem& item) { addLinks(item); });
    while (spread()) {
    }
    leaveUnheard();
    LiveGraph<R> graph;
    for (const bool states : {false, true})
      for_each_item(top, [&](SceneItem& item) {
        if (states ? placed_.count(&item) : running_.count(&item)) order(item);
      });
    for (SceneItem* item : order_) addTarget(*item, graph);
    for_each_item(top, [&](SceneItem& item) {
      if (!live_.count(&item) && !placed_.count(&item)) addTarget(item, graph);
    });
    for (Link const& link : moved_)
      if (is(*link.from, RoleKind::engine) && changes(link))
        say(link, "is moved where it is read, at the start only");
    return graph;
  }

 private:
  struct Link {
    SceneItem* from;
    FieldInfo const* fromField;
    int fromList;
    SceneItem* to;
    FieldInfo const* toField;
    int toList;
    std::string fromName, toName;  // as links have them
  };
  SceneMessages& messages_;
  std::map<SceneItem*, std::vector<Link>> into_{};
  std::vector<Link> moved_{};       // to positions that are moved once more, at the start
  std::set<SceneItem*> live_{};     // engines that follow what moves,
  std::set<SceneItem*> running_{};  // and of these what is evaluated again
  std::set<SceneItem*> placed_{};   // states that follow engines, or states
  std::vector<SceneItem*> order_{};
  std::set<SceneItem*> ordered_{}, busy_{};

  static bool is(SceneItem const& item, RoleKind role) { return item.info && item.info->role == role; }

  // a field, or a list of one that is a list of lists
  static FieldInfo const* fieldOf(ClassInfo const& info, std::string_view name, bool input, int& list) {
    for (auto const& f : info.fields)
      if (f.isInput == input && (list = f.numberOf(name)) >= 0) return &f;
    list = -1;
    if (!input) return offered(info, name);
    for (auto const& f : info.fields)
      if (f.isInput && f.known(name)) return &f;
    return nullptr;
  }
  void addLinks(SceneItem& item) {
    if (!item.info || item.failed || !item.address) return;
    for (auto const& [name, words] : item.links) addLink(item, name, words, into_[&item]);
    if (!item.moved.empty()) addLink(item, "position", item.moved, moved_);
  }
  static void addLink(SceneItem& item, std::string const& name, std::string const& words,
                      std::vector<Link>& to) {
    LinkTarget target;
    try {
      target = follow_link(item, words);
    } catch (Error const&) {  // is said where the attribute is read
      return;
    }
    SceneItem* const from = target.item ? target.item : target.place->ofRole(RoleKind::state);
    if (!from || !from->info || from->failed || !from->address) return;
    if (!is(*from, RoleKind::engine) && !is(*from, RoleKind::state) && !is(*from, RoleKind::topology)) return;
    Link link{from, nullptr, -1, &item, nullptr, -1, target.data, name};
    link.fromField = fieldOf(*from->info, target.data, false, link.fromList);
    link.toField = fieldOf(*item.info, name, true, link.toList);
    if (link.fromField && link.toField) to.push_back(std::move(link));
  }

  // whether what a link leads to changes while the scene runs
  bool changes(Link const& link) const {
    if (live_.count(link.from)) {
      if (!link.fromField->isInput) return true;
      // what it is given itself
      auto const& given = into_.at(link.from);
      return std::any_of(given.begin(), given.end(), [&](Link const& above) {
        return above.toField == link.fromField && changes(above);
      });
    }
    if (!is(*link.from, RoleKind::state)) return false;
    if (link.fromField->name != "position" && link.fromField->name != "velocity") return false;
    return placed_.count(link.from) || moves(*link.from->place) || movesWithoutSolver(*link.from->place);
  }
  static bool movesWithoutSolver(ScenePlace const& place) {
    return std::any_of(place.items.begin(), place.items.end(), [](auto const& item) {
      return item->info && item->info->traits.movesWithoutSolver;
    });
  }
  // whether an engine keeps what it has made at the start
  static bool keeps(SceneItem const& item) {
    auto const* update = item.element->attribute("doUpdate");
    return update && (update->value == "0" || update->value == "false");
  }
  // a state is where it follows to, unless a mapping moves it. Positions of another body, without an engine
  // between, are where one starts that moves by itself.
  static bool places(Link const& link) {
    ScenePlace const& place = *link.to->place;
    return is(*link.to, RoleKind::state) && link.toField->live && !place.ofRole(RoleKind::mapping) &&
           (is(*link.from, RoleKind::engine) || !moves(place));
  }
  bool spread() {
    bool more = false;
    for (auto const& [item, links] : into_)
      for (Link const& link : links) {
        if (!changes(link) || !hasNumbers(link)) continue;
        if (is(*item, RoleKind::engine) && !keeps(*item)) more = live_.insert(item).second || more;
        if (places(link)) more = placed_.insert(item).second || more;
      }
    return more;
  }
  // an engine that leads to what is read at the start only does not have to be evaluated again
  void leaveUnheard() {
    std::set<SceneItem*> heard, leads;
    for (auto const& [item, links] : into_)
      for (Link const& link : links) {
        leads.insert(link.from);
        if (!is(*item, RoleKind::engine) && follows(link)) heard.insert(link.from);
      }
    for (std::size_t before = heard.size() + 1; before != heard.size();) {
      before = heard.size();
      for (auto const& [item, links] : into_)
        if (live_.count(item) && (heard.count(item) || !leads.count(item)))
          for (Link const& link : links) heard.insert(link.from);
    }
    for (SceneItem* engine : live_)
      if (heard.count(engine) || !leads.count(engine)) running_.insert(engine);
  }
  // whether an attribute of a component that is no engine takes values while the scene runs
  static bool follows(Link const& link) {
    if (is(*link.to, RoleKind::state)) return places(link);
    if (is(*link.to, RoleKind::visualModel) && link.to->place->ofRole(RoleKind::mapping)) return false;
    return link.toField->live && hasNumbers(link);
  }
  static bool hasNumbers(Link const& link) {
    return link.fromField->type->numbers.get && link.toField->type->numbers.set;
  }

  // each behind what it follows, engines or the states from which a mapping moves what they follow
  void order(SceneItem& item) {
    if (ordered_.count(&item)) return;
    if (!busy_.insert(&item).second)
      throw Error(item.element->place(),
                  text('<', item.tag, ">: leads in a circle back to '", item.name, "'; break it"));
    if (const auto links = into_.find(&item); links != into_.end())
      for (Link const& link : links->second)
        if (changes(link)) orderBefore(*link.from);
    busy_.erase(&item);
    ordered_.insert(&item);
    if (running_.count(&item) || placed_.count(&item)) order_.push_back(&item);
  }
  void orderBefore(SceneItem& from) {
    order(from);
    if (!is(from, RoleKind::state)) return;
    for (ScenePlace* at = from.place; at && at->ofRole(RoleKind::mapping);) {
      at = at->parent;
      while (at && at->state.empty()) at = at->parent;
      if (SceneItem* const above = at ? at->ofRole(RoleKind::state) : nullptr) order(*above);
    }
  }

  void addTarget(SceneItem& item, LiveGraph<R>& graph) {
    const auto links = into_.find(&item);
    if (links == into_.end()) return;
    typename LiveGraph<R>::Target target{placeOf(item), item.name};
    for (Link const& link : links->second) {
      static constexpr auto elements =
          std::to_array<std::string_view>({"edges", "triangles", "quads", "tetrahedra", "hexahedra"});
      const bool ofEdits = running_.count(&item) && is(*link.from, RoleKind::topology) && hasNumbers(link) &&
                           dialect::has(elements, link.fromField->name);
      if (!changes(link) && !ofEdits) continue;
      if (is(item, RoleKind::engine)) {
        if (!running_.count(&item)) continue;
        if (!hasNumbers(link)) {
          say(link, "cannot take it while the scene runs");
          continue;
        }
      } else if (!follows(link)) {
        // what a mapping moves is where that puts it
        const bool mapped = (is(item, RoleKind::state) || is(item, RoleKind::visualModel)) &&
                            link.toField->live && item.place->ofRole(RoleKind::mapping);
        if (is(*link.from, RoleKind::engine) && !mapped) say(link, "is read at the start only");
        continue;
      }
      nameApart(item, target.component), nameApart(*link.from);
      target.links.push_back({.from = value(*link.from, *link.fromField, link.fromName, link.fromList),
                              .to = value(item, *link.toField, link.toName, link.toList),
                              .pointsTo = framesOf(link),
                              .keepsCount = is(item, RoleKind::state) || is(item, RoleKind::visualModel),
                              .ofEdits = ofEdits});
    }
    if (!target.links.empty()) graph.targets.push_back(std::move(target));
  }
  static std::string placeOf(SceneItem const& item) {
    return from_top(item.home ? *item.home : *item.place).substr(1);
  }
  static LiveValue value(SceneItem const& item, FieldInfo const& field, std::string name, int list) {
    return {placeOf(item), item.name, std::move(name), field.offset, field.type->numbers, list};
  }
  // points of a body in space become frames that are not rotated, as where they are read
  static int framesOf(Link const& link) {
    std::string const& types = link.from->info->dataTypes;
    const bool frames = link.fromField->kind.find("quaternion") != std::string::npos;
    const bool inSpace = !frames && (types.empty() || types.find("Vec3") != types.npos);
    if (!inSpace || !is(*link.to, RoleKind::state) || !dialect::has(fields_of_points, link.toField->name))
      return 0;
    std::string const& to = link.to->info->dataTypes;
    return to.find("Rigid3") != to.npos ? 7 : to.find("Rigid2") != to.npos ? 3 : 0;
  }
  // the first of its name in its node, by which it is found
  static void nameApart(SceneItem& item) {
    ScenePlace const& place = item.home ? *item.home : *item.place;
    while (place.find(item.name) && place.find(item.name) != &item) item.name += '_';
  }
  static void nameApart(SceneItem& item, std::string& name) {
    nameApart(item);
    name = item.name;
  }

  void say(Link const& link, std::string_view what) {
    XmlAttribute const* const written = link.to->element->attribute(link.toName);
    messages_.warnings.insert(
        text(written ? link.to->element->place(*written) : link.to->element->place(),
             ": <",
             link.to->tag,
             ">: ",
             link.toName,
             " ",
             what,
             ", while ",
             link.fromName,
             " of '",
             link.from->name,
             "' (",
             link.from->tag,
             ") follows what moves; '",
             link.to->name,
             "' keeps the value of the start. Link the engine to rest_position, if that is "
             "meant"));
  }
};

}  // namespace detail

}  // namespace sinew
