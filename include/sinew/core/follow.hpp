// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/core/fields.hpp>
#include <sinew/core/renumbering.hpp>

namespace sinew {

/// What becomes of all that a component may refer to, when points and elements are removed. A component whose
/// values do not follow by Field::numbersOf and Field::oneEach alone offers follow(Followed const&), called
/// before its fields are changed. One for which an empty list of points means all of them has a member
/// `none`, set where the last point of the list goes.
struct Followed {
  Renumbering const& points;
  Renumbering const& secondPoints;
  Renumbering const& parentPoints;
  TopologyChange const& topology;

  Renumbering const& numbered(Of what) const {
    switch (what) {
      case Of::secondPoints:
        return secondPoints;
      case Of::parentPoints:
        return parentPoints;
      case Of::triangles:
        return topology.of(ElementKind::triangle);
      case Of::quads:
        return topology.of(ElementKind::quad);
      default:
        return points;
    }
  }
  int dimensionOf(Of what) const {
    return what == Of::lines ? 1 : what == Of::surfaces ? 2 : what == Of::volumes ? 3 : topology.dimension();
  }
};

namespace detail {

constexpr bool of_points(Of what) { return what == Of::points || what == Of::secondPoints; }

template <class T>
constexpr bool is_number_list = std::is_same_v<T, std::vector<int>>;
template <class T>
constexpr bool is_struct_list = false;
template <HasFields T>
constexpr bool is_struct_list<std::vector<T>> = true;

// f(field, number) for each number of a point or element in a struct with fields
template <class T, class F>
void for_each_number(T& owner, F&& f) {
  for_each_field(owner, [&](auto const& fd, auto& value) {
    if constexpr (std::is_same_v<std::decay_t<decltype(value)>, int>)
      if (fd.numbers) f(fd, value);
  });
}

}  // namespace detail

/// All fields of a component that are declared to follow do so.
template <class C>
void follow_fields(C& component, Followed const& change) {
  if constexpr (requires { component.follow(change); }) component.follow(change);

  // the entries of structs, and of the lists of points, that stay
  std::vector<bool> structs, entries;
  bool emptied = false;
  for_each_field(component, [&](auto const& fd, auto& list) {
    using List = std::decay_t<decltype(list)>;
    if constexpr (detail::is_struct_list<List>) {
      for (auto& item : list) {
        bool stays = true;
        detail::for_each_number(item, [&](auto const& part, int number) {
          stays = stays && change.numbered(part.entries).stays(number);
        });
        structs.push_back(stays);
      }
    } else if constexpr (detail::is_number_list<List>) {
      if (!fd.numbers || !detail::of_points(fd.entries)) return;
      if (entries.size() < list.size()) entries.resize(list.size(), true);
      for (std::size_t i = 0; i < list.size(); ++i)
        if (!change.numbered(fd.entries).stays(list[i])) entries[i] = false;
    }
  });
  const Renumbering ofStructs = Renumbering::of(structs), ofLists = Renumbering::of(entries);
  std::vector<bool> both = structs;
  both.insert(both.end(), entries.begin(), entries.end());
  const Renumbering ofBoth = Renumbering::of(both);

  for_each_field(component, [&](auto const& fd, auto& list) {
    using List = std::decay_t<decltype(list)>;
    if constexpr (detail::is_struct_list<List>) {
      ofStructs.filter(list);
      for (auto& item : list)
        detail::for_each_number(
            item, [&](auto const& part, int& number) { change.numbered(part.entries).renumber(number); });
      return;
    }
    if constexpr (detail::is_number_list<List>)
      if (fd.numbers) {
        const std::size_t before = list.size();
        Renumbering const& numbered = change.numbered(fd.entries);
        if (detail::of_points(fd.entries))
          ofLists.filter(list);
        else if (fd.entries == Of::parentPoints)
          change.points.filter(list);
        else
          std::erase_if(list, [&](int number) { return !numbered.stays(number); });
        for (int& number : list) numbered.renumber(number);
        emptied = emptied || (before > 0 && list.empty());
        return;
      }
    if constexpr (requires { list.resize(0), list[0]; }) {
      if (list.size() < 2) return;
      switch (fd.entries) {
        case Of::nothing:
          return;
        case Of::points:
          return change.points.filter(list);
        case Of::entries:
          // one for each entry of structs and lists, or of the lists only; without lists for each point
          if (both.empty()) return change.points.filter(list);
          return list.size() == both.size() ? ofBoth.filter(list) : ofLists.filter(list);
        case Of::hexahedra:
          return change.topology.of(ElementKind::hexahedron).filter(list);
        default:
          return change.topology.ofDimension(change.dimensionOf(fd.entries), list.size()).filter(list);
      }
    }
  });
  if constexpr (requires { component.none; })
    if (emptied) component.none = true;
}

/// Which of the n points of its child a mapping keeps, where points of its parent go.
template <class M>
std::vector<bool> mapped_points_that_stay(M const& mapping, Renumbering const& parent, std::size_t n) {
  std::vector<bool> stays(n, true);
  if constexpr (requires { M::samePoints; })
    for (std::size_t i = 0; i < n; ++i) stays[i] = parent.stays(Index(i));
  for_each_field(mapping, [&](auto const& fd, auto const& list) {
    if constexpr (detail::is_number_list<std::decay_t<decltype(list)>>)
      if (fd.numbers && fd.entries == Of::parentPoints)
        for (std::size_t i = 0; i < n && !list.empty(); ++i)
          if (!parent.stays(list[list.size() == 1 ? 0 : i])) stays[i] = false;
  });
  return stays;
}

}  // namespace sinew
