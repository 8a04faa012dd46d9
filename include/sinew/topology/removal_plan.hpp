// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/core/compiled.hpp>
#include <sinew/core/component.hpp>

#include <span>
#include <vector>

namespace sinew {

/// What stays, of the points of a body and of the elements of all topologies over them.
struct RemovalPlan {
  using OfTopology = std::array<std::vector<bool>, element_kinds>;
  std::vector<bool> points;
  std::vector<OfTopology> elements;

  TopologyChange change(std::size_t topology) const;
};

namespace detail {

bool contains(std::span<Index const> outer, std::span<Index const> inner);

}  // namespace detail

/// What goes with elements of topologies[first]:
///   - an element that lies in a larger one that goes, and in none that stays: faces and edges of what is
///     removed, and the simplices into which a quad or a hexahedron is split
///   - a point that has no element left of the highest dimension of those that it had: one of a volume does
///     not hang on by a wire
///   - an element over such a point, or over one that is to go itself
/// All topologies are over the same points, and their indices are in range.
RemovalPlan plan_element_removal(std::size_t points, std::vector<TopologyView> const& topologies,
                                 std::size_t first, ElementNumbers const& gone);

/// What goes with points: the elements over them.
RemovalPlan plan_point_removal(std::vector<bool> const& stays, std::vector<TopologyView> const& topologies);

}  // namespace sinew

#if SINEW_DEFINES
#include <algorithm>

namespace sinew::detail {

inline RemovalPlan whole_plan(std::size_t points, std::vector<TopologyView> const& topologies) {
  RemovalPlan plan{.points = std::vector<bool>(points, true), .elements = {}};
  for (TopologyView const& t : topologies) {
    plan.elements.emplace_back();
    for_each_kind(t, [&](int kind, auto const& list) {
      plan.elements.back()[std::size_t(kind)].assign(list.size(), true);
    });
  }
  return plan;
}

// an element of one of several topologies
struct ElementOfBody {
  std::size_t topology;
  int kind;
  std::size_t number;
  std::span<Index const> points;
};

SINEW_ONCE bool contains(std::span<Index const> outer, std::span<Index const> inner) {
  return std::all_of(inner.begin(), inner.end(), [&](Index i) {
    return std::find(outer.begin(), outer.end(), i) != outer.end();
  });
}

}  // namespace sinew::detail

namespace sinew {

SINEW_ONCE TopologyChange RemovalPlan::change(std::size_t topology) const {
  TopologyChange c{.points = Renumbering::of(points)};
  for (std::size_t k = 0; k < element_kinds; ++k) c.elements[k] = Renumbering::of(elements[topology][k]);
  return c;
}

SINEW_ONCE RemovalPlan plan_element_removal(std::size_t points, std::vector<TopologyView> const& topologies,
                                            std::size_t first, ElementNumbers const& gone) {
  using detail::ElementOfBody;
  RemovalPlan plan = detail::whole_plan(points, topologies);
  auto forEachElement = [&](auto&& f) {
    for (std::size_t t = 0; t < topologies.size(); ++t)
      for_each_kind(topologies[t], [&](int kind, auto const& list) {
        for (std::size_t e = 0; e < list.size(); ++e) f(ElementOfBody{t, kind, e, list[e]});
      });
  };
  auto stays = [&](ElementOfBody const& e) {
    return plan.elements[e.topology][std::size_t(e.kind)][e.number];
  };

  // of the elements at each point the highest dimension
  auto dimensions = [&] {
    std::vector<int> highest(points, 0);
    forEachElement([&](ElementOfBody const& e) {
      if (stays(e))
        for (const Index i : e.points)
          highest[std::size_t(i)] = std::max(highest[std::size_t(i)], dimension_of_kind(e.kind));
    });
    return highest;
  };
  const std::vector<int> before = dimensions();
  const auto lists = gone.lists();
  for (std::size_t k = 0; k < element_kinds; ++k)
    for (const Index e : *lists[k]) plan.elements[first][k][std::size_t(e)] = false;

  for (const Index i : gone.points) plan.points[std::size_t(i)] = false;
  auto staysAt = [&](Index i) { return bool(plan.points[std::size_t(i)]); };
  if (!gone.points.empty())
    forEachElement([&](ElementOfBody const& e) {
      if (!std::all_of(e.points.begin(), e.points.end(), staysAt))
        plan.elements[e.topology][std::size_t(e.kind)][e.number] = false;
    });

  // points of elements that go, and the elements around them
  std::vector<bool> touched(points, false);
  forEachElement([&](ElementOfBody const& e) {
    if (!stays(e))
      for (const Index i : e.points) touched[std::size_t(i)] = true;
  });
  std::vector<Index> place(points, -1);
  std::vector<std::vector<ElementOfBody>> around;
  forEachElement([&](ElementOfBody const& e) {
    for (const Index i : e.points)
      if (touched[std::size_t(i)]) {
        Index& at = place[std::size_t(i)];
        if (at < 0) at = Index(around.size()), around.emplace_back();
        around[std::size_t(at)].push_back(e);
      }
  });

  auto isLarger = [](ElementOfBody const& a, ElementOfBody const& b) {
    return a.points.size() > b.points.size() ||
           (a.points.size() == b.points.size() && a.kind > b.kind);  // a quad in a tetrahedron
  };
  // larger ones first; in those of 27 points lie all others
  for (const int kind : {8, 7, 4, 6, 5, 3, 2, 1, 0})
    forEachElement([&](ElementOfBody const& e) {
      if (e.kind != kind || !touched[std::size_t(e.points[0])]) return;
      bool inGone = false, inKept = false;
      for (ElementOfBody const& other : around[std::size_t(place[std::size_t(e.points[0])])])
        if (isLarger(other, e) && detail::contains(other.points, e.points))
          (stays(other) ? inKept : inGone) = true;
      if (inGone && !inKept) plan.elements[e.topology][std::size_t(e.kind)][e.number] = false;
    });

  for (bool changed = true; changed;) {
    const std::vector<int> now = dimensions();
    changed = false;
    for (std::size_t i = 0; i < points; ++i)
      if (now[i] < before[i]) plan.points[i] = false;
    forEachElement([&](ElementOfBody const& e) {
      if (!stays(e) || std::all_of(e.points.begin(), e.points.end(), staysAt)) return;
      plan.elements[e.topology][std::size_t(e.kind)][e.number] = false;
      changed = true;
    });
  }
  return plan;
}

SINEW_ONCE RemovalPlan plan_point_removal(std::vector<bool> const& stays,
                                          std::vector<TopologyView> const& topologies) {
  RemovalPlan plan = detail::whole_plan(stays.size(), topologies);
  plan.points = stays;
  for (std::size_t t = 0; t < topologies.size(); ++t)
    for_each_kind(topologies[t], [&](int kind, auto const& list) {
      for (std::size_t e = 0; e < list.size(); ++e)
        plan.elements[t][std::size_t(kind)][e] =
            std::all_of(list[e].begin(), list[e].end(), [&](Index i) { return stays[std::size_t(i)]; });
    });
  return plan;
}

}  // namespace sinew
#endif
