// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/core/compiled.hpp>
#include <sinew/core/fields.hpp>
#include <sinew/core/renumbering.hpp>
#include <sinew/core/role.hpp>
#include <sinew/core/value_numbers.hpp>

#include <functional>

namespace sinew {

/// What becomes of all that a component may refer to, when points and elements go or come. Parts of an
/// element are in a list where it was. Points that come are in that of a constraint or a collision model,
/// where all those were between which they are; a force stays on the points on which it was. A component
/// whose values do not follow by Field::numbersOf and Field::oneEach alone offers follow(Followed const&),
/// called before its fields are changed. One for which an empty list of points means all of them, or that has
/// the number of a single point, has a member `none`, set where the last of its points goes.
struct Followed {
  Renumbering const& points;
  Renumbering const& secondPoints;
  Renumbering const& parentPoints;
  TopologyChange const& topology;
  /// Of a body that is cut: whether what joins two of its points still does, and between which then.
  std::function<bool(Index&, Index&)> joined{};
  bool refined = false;  // whether all that comes is parts of what there was

  Renumbering const& numbered(Of what) const;
  int dimensionOf(Of what) const {
    return what == Of::lines ? 1 : what == Of::surfaces ? 2 : what == Of::volumes ? 3 : topology.dimension();
  }
};

namespace detail {

template <class T>
inline constexpr bool is_struct_list = false;
template <HasFields T>
inline constexpr bool is_struct_list<std::vector<T>> = true;

// f(what it numbers, number) for each number of a point or element in a struct with fields
template <class T, class F>
void for_each_number(T& owner, F&& f) {
  for_each_field(owner, [&](auto const& fd, auto& value) {
    if constexpr (std::is_same_v<std::decay_t<decltype(value)>, int>)
      if (fd.numbers) f(fd.entries, value);
  });
}

/// How the lists of one component follow: first all are marked, then changed.
struct ListsThatFollow {
  Followed const& change;
  bool grows;                              // points between its own are its own
  std::vector<bool> structs{}, entries{};  // which stay, of lists of structs and of lists of points
  Renumbering ofStructs{}, ofEntries{}, ofBoth{};
  std::vector<Index> come{};      // points that come into the lists of points
  std::size_t entriesBefore = 0;  // behind which these are numbered
  bool emptied = false;

  static bool isEntry(Of what) { return what == Of::points || what == Of::secondPoints; }

  template <class T>
  void markStructs(std::vector<T>& list) {
    for (auto& item : list) {
      bool stays = true;
      int* ends[2]{};
      for_each_number(item, [&](Of what, int& i) {
        stays = stays && change.numbered(what).stays(i);
        if (isEntry(what)) ends[what == Of::secondPoints] = &i;
      });
      if (change.joined && ends[0] && ends[1]) stays = stays && change.joined(*ends[0], *ends[1]);
      structs.push_back(stays);
    }
  }
  std::vector<int>* endLists[2]{};  // of the points that others join
  void markNumbers(std::vector<int>& list, Of what);
  void markJoined();
  void marked() {
    markJoined();
    const auto before = Index(structs.size());
    const auto more = Index(entries.size() - entriesBefore);  // of a longer list
    for (Origin& o : comeOfEntries)
      for (Index* i : {&o.a, &o.b, &o.c})
        if (*i >= Index(entriesBefore)) *i += more;
    std::vector<Origin> comeBehind = comeOfEntries;
    for (Origin& o : comeBehind) {
      o.a += before, o.b += before;
      if (o.c >= 0) o.c += before;
    }
    ofStructs = Renumbering::of(structs), ofEntries = Renumbering::of(entries);
    structs.insert(structs.end(), entries.begin(), entries.end());
    ofBoth = Renumbering::of(structs);
    ofEntries.come = comeOfEntries, ofBoth.come = comeBehind;
  }

  template <class T>
  void changeStructs(std::vector<T>& list) const {
    ofStructs.filter(list);
    for (auto& item : list)
      for_each_number(item, [&](Of what, int& i) { change.numbered(what).renumber(i); });
  }
  std::vector<Origin> comeOfEntries{};
  void changeNumbers(std::vector<int>& list, Of what);
  void changeNumber(int& number, Of what);
  template <class T>
  void changeValues(std::vector<T>& list, Of what) const {
    if (list.size() > 1) ofValues(what, list.size()).filter(list);
  }
  Renumbering ofValues(Of what, std::size_t size) const;
};

}  // namespace detail

/// All fields of a component that are declared to follow do so.
template <class C>
void follow_fields(C& component, Followed const& change) {
  if constexpr (requires { component.follow(change); }) component.follow(change);
  detail::ListsThatFollow lists{change,
                                HasRole<C, role::ProjectiveConstraint> || HasRole<C, role::CollisionModel>};
  for_each_field(component, [&]<class List>(auto const& fd, List& list) {
    if constexpr (detail::is_struct_list<List>)
      lists.markStructs(list);
    else if constexpr (std::is_same_v<List, std::vector<int>>)
      if (fd.numbers) lists.markNumbers(list, fd.entries);
  });
  lists.marked();
  for_each_field(component, [&]<class List>(auto const& fd, List& list) {
    if constexpr (detail::is_struct_list<List>) {
      lists.changeStructs(list);
    } else if constexpr (detail::is_list<List>) {
      if constexpr (std::is_same_v<List, std::vector<int>>)
        if (fd.numbers) return lists.changeNumbers(list, fd.entries);
      lists.changeValues(list, fd.entries);
    } else if constexpr (std::is_same_v<List, int> && requires { component.none; }) {
      if (fd.numbers) lists.changeNumber(list, fd.entries);
    }
  });
  if constexpr (requires { component.none; })
    if (lists.emptied) component.none = true;
}

/// Which of the n points of its child a mapping keeps, where points of its parent go.
template <class M>
std::vector<bool> mapped_points_that_stay(M const& mapping, Renumbering const& parent, std::size_t n) {
  if constexpr (requires { mapping.pointsThatStay(parent); }) {
    return mapping.pointsThatStay(parent);
  } else {
    std::vector<bool> stays(n, true);
    if constexpr (requires { M::samePoints; })
      for (std::size_t i = 0; i < n; ++i) stays[i] = parent.stays(Index(i));
    for_each_field(mapping, [&](auto const& fd, auto const& list) {
      if constexpr (std::is_same_v<std::decay_t<decltype(list)>, std::vector<int>>)
        if (fd.numbers && fd.entries == Of::parentPoints)
          for (std::size_t i = 0; i < n && !list.empty(); ++i)
            if (!parent.stays(list[list.size() == 1 ? 0 : i])) stays[i] = false;
    });
    return stays;
  }
}

}  // namespace sinew

#if SINEW_DEFINES
#include <algorithm>
#include <map>
#include <set>

namespace sinew::detail {

SINEW_ONCE void ListsThatFollow::markJoined() {
  if (!change.joined || !endLists[0] || !endLists[1]) return;
  for (std::size_t i = 0; i < std::min(endLists[0]->size(), endLists[1]->size()); ++i)
    if (!change.joined((*endLists[0])[i], (*endLists[1])[i])) entries[i] = false;
}

SINEW_ONCE void ListsThatFollow::markNumbers(std::vector<int>& list, Of what) {
  if (!isEntry(what)) return;
  endLists[what == Of::secondPoints] = &list;
  if (entries.size() < list.size()) entries.resize(list.size(), true);
  for (std::size_t i = 0; i < list.size(); ++i)
    if (!change.numbered(what).stays(list[i])) entries[i] = false;
  if (!grows || what != Of::points || change.points.come.empty() || !come.empty()) return;
  entriesBefore = entries.size();
  std::map<Index, Index> entryOf;
  for (std::size_t i = 0; i < list.size(); ++i) entryOf.emplace(list[i], Index(i));
  for (std::size_t k = 0; k < change.points.come.size(); ++k) {
    Origin const& o = change.points.come[k];
    const auto a = entryOf.find(o.a), b = entryOf.find(o.b), c = entryOf.find(o.c);
    if (a == entryOf.end() || b == entryOf.end() || (o.c >= 0 && c == entryOf.end())) continue;
    // others may come of it
    entryOf.emplace(Index(change.points.now.size() + k), Index(entriesBefore + come.size()));
    comeOfEntries.push_back({a->second, b->second, o.weight, o.c < 0 ? -1 : c->second, o.weightOfC});
    come.push_back(Index(change.points.kept.size() + k));
  }
}

SINEW_ONCE void ListsThatFollow::changeNumbers(std::vector<int>& list, Of what) {
  const bool before = !list.empty();
  Renumbering const& numbered = change.numbered(what);
  std::vector<Index> more;
  if (isEntry(what)) {
    Renumbering::of(entries).filter(list);
    if (what == Of::points) more = come;
  } else if (what == Of::parentPoints) {
    change.points.filter(list);
  } else {
    const std::set<Index> had(list.begin(), list.end());
    for (std::size_t k = 0; k < numbered.come.size(); ++k)
      if (had.contains(numbered.come[k].a)) more.push_back(Index(numbered.kept.size() + k));
    std::erase_if(list, [&](int i) { return !numbered.stays(i); });
  }
  for (int& i : list) numbered.renumber(i);
  list.insert(list.end(), more.begin(), more.end());
  emptied = emptied || (before && list.empty());
}

SINEW_ONCE void ListsThatFollow::changeNumber(int& number, Of what) {
  if (change.numbered(what).stays(number))
    change.numbered(what).renumber(number);
  else
    emptied = true;
}

SINEW_ONCE Renumbering ListsThatFollow::ofValues(Of what, std::size_t size) const {
  switch (what) {
    case Of::nothing:
      return {};
    case Of::points:
      return change.points;
    case Of::entries:
      // of structs and lists together, or of the lists only; where there are none, of all points
      return ofBoth.now.empty() ? change.points : size == ofBoth.now.size() ? ofBoth : ofEntries;
    case Of::edges:
      return change.topology.of(ElementKind::edge);
    case Of::triangles:
      return change.topology.of(ElementKind::triangle);
    case Of::quads:
      return change.topology.of(ElementKind::quad);
    case Of::hexahedra:
      return change.topology.of(ElementKind::hexahedron);
    case Of::pyramids:
      return change.topology.of(ElementKind::pyramid);
    case Of::prisms:
      return change.topology.of(ElementKind::prism);
    case Of::quadraticTetrahedra:
      return change.topology.of(ElementKind::quadraticTetrahedron);
    case Of::quadraticHexahedra:
      return change.topology.of(ElementKind::quadraticHexahedron);
    case Of::triquadraticHexahedra:
      return change.topology.of(ElementKind::triquadraticHexahedron);
    default:
      return change.topology.ofDimension(change.dimensionOf(what), size);
  }
}

}  // namespace sinew::detail

namespace sinew {

SINEW_ONCE Renumbering const& Followed::numbered(Of what) const {
  switch (what) {
    case Of::secondPoints:
      return secondPoints;
    case Of::parentPoints:
      return parentPoints;
    case Of::edges:
      return topology.of(ElementKind::edge);
    case Of::triangles:
      return topology.of(ElementKind::triangle);
    case Of::quads:
      return topology.of(ElementKind::quad);
    default:
      return points;
  }
}

}  // namespace sinew
#endif
