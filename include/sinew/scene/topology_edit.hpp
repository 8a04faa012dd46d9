// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/core/follow.hpp>
#include <sinew/scene/collision_models.hpp>
#include <sinew/scene/cut_body.hpp>
#include <sinew/scene/removed_border.hpp>
#include <sinew/scene/scope.hpp>
#include <sinew/scene/states_of.hpp>
#include <sinew/topology/refinement.hpp>
#include <sinew/topology/removal_plan.hpp>

#include <functional>
#include <list>
#include <map>
#include <set>
#include <string>
#include <string_view>
#include <vector>

namespace sinew {

/// A topology whose elements may be removed.
template <class T>
inline constexpr bool editable_topology = requires(T t) { t.edit(); };

/// What is to be refined: elements of a topology; empty: all.
struct RefineOrder {
  ElementNumbers const& elements;
};

/// Takes elements out of one topology of a scene, puts some into it, or cuts them, with all that refers to
/// them; the scene then has to be initialised again where touched() says. Triangles and quads that are the
/// whole border of the volume, of a visual model or of a topology on which no forces act, become that of what
/// is left; others only go. Works on a scene that may be thrown away: an Error leaves it half changed.
template <class RootScope>
class TopologyEdit {
 public:
  /// Throws Error where there is no topology at `path`, or no element of a number in it.
  TopologyEdit(RootScope const& root, std::string_view path, ElementNumbers const& gone) : root_(root) {
    find(path);
    refuseValues();
    check(path, gone);
    plan(gone);
    planMapped();
  }

  /// Throws Error where there is no topology at `path` that can be cut, where something stands on its points
  /// that cannot follow, and where there would be too many of them.
  TopologyEdit(RootScope const& root, std::string_view path, CutOrder const& order) : root_(root) {
    find(path);
    refuseValues();
    planCut(order);
  }

  /// Throws Error where there is no topology at `path` that can get these elements, and where something
  /// stands on its points that cannot follow.
  TopologyEdit(RootScope const& root, std::string_view path, AddedElements const& added) : root_(root) {
    find(path);
    planAddition(added);
  }

  /// Puts parts of elements behind these (plan_refinement), which whole() then names.
  TopologyEdit(RootScope const& root, std::string_view path, RefineOrder const& order) : root_(root) {
    find(path);
    refuseValues();
    TopologyView view;
    std::string where;
    for (Topology const& t : topologiesOver(state_))
      if (t.address == topology_) view = t.view, where = t.path;
    std::vector<Eigen::Vector3d> rest;
    traverse(root_, on<role::State>([&](auto const& s, auto const&) {
               if (static_cast<void const*>(&s) == state_) set_centers(rest, s, s.restPosition);
             }));
    Refinement refinement;
    try {
      refinement = plan_refinement(view, rest, order.elements);
    } catch (Error const& error) {
      throw Error(where, error.what());
    }
    whole_ = std::move(refinement.whole);
    refined_ = true;
    planAddition(refinement.parts);
  }
  ElementNumbers const& whole() const { return whole_; }

  /// What a cut has done; there is nothing to apply where no element is cut.
  CutPlan const& cut() const { return cut_; }
  /// What becomes of the topology and its points.
  TopologyChange const& change() const { return ofTopology_.at(topology_); }

  void apply() {
    traverse(root_, on<AnyRole>([this](auto& c, auto const& scope) { this->follow(c, scope); }));
  }

  InitAgain touched() const {
    InitAgain again{.again = true};
    traverse(root_, on<AnyRole>([&](auto& c, auto const& scope) {
               if (isTouched(c, scope)) again.touched.push_back(&c);
             }));
    std::sort(again.touched.begin(), again.touched.end(), std::less<>{});
    return again;
  }

 private:
  struct Topology {
    void const* address;
    TopologyView view;
    bool editable;
    std::string path;
  };

  RootScope const& root_;
  void const *topology_ = nullptr, *state_ = nullptr;
  std::size_t points_ = 0;
  std::map<void const*, Renumbering> ofState_{};  // and of visual models
  std::map<void const*, TopologyChange> ofTopology_{};
  std::set<void const*> touchedStates_{};  // states and visual models around which something changes
  std::set<void const*> samePoints_{};     // those whose points are the points of the topology, one by one
  std::set<void const*> mechanical_{};     // topologies on which forces and masses act
  RemovedBorder border_{};
  std::map<void const*, BorderLists> borders_{};  // of the topologies and visual models that are the border
  std::map<void const*, void const*> copies_{};   // of visual models with the faces of a topology: that
  CutPlan cut_{};
  ElementNumbers whole_{};
  bool refined_ = false;
  std::list<CutPlan> carried_{};                  // of the surfaces that the body carries
  std::function<bool(Index&, Index&)> joined_{};  // of what joins points of the body that is cut
  std::vector<AddPlan::Lists> added_{};           // of topologies and visual models to which elements come
  // what topologies and visual models have that are cut, or to which elements come
  std::map<void const*, AddPlan::Lists const*> lists_{};

  void find(std::string_view path) {
    const std::string wanted = text(root_.path(), path.empty() ? "" : "/", path);
    std::string known;
    traverse(root_, on<role::Topology>([&](auto& t, auto const& scope) {
               const std::string here = scope.path();
               known += text(known.empty() ? "" : ", ",
                             here.substr(std::min(here.size(), root_.path().size() + 1)));
               if (here != wanted || topology_) return;
               topology_ = &t;
               state_ = scope.pointsAddress();
             }));
    if (!topology_)
      throw Error(wanted,
                  text("there is no topology at this path, from which elements could be removed; there is ",
                       known.empty() ? "none in the scene" : text("one at: ", known)));
    if (!state_)
      throw Error(wanted, "the topology has no state whose points it refers to; give its node one");
    traverse(root_, on<role::State>([&](auto& s, auto const&) {
               if (static_cast<void const*>(&s) == state_) points_ = s.size();
             }));
  }

  // values on the body, such as temperatures, have no law for points that go and come
  void refuseValues() const {
    traverse(
        root_, on<role::ForceField, role::Mass>([this](auto& c, auto const& scope) {
          if constexpr (over_body<std::decay_t<decltype(c)>>)
            if (scope.body().state == state_)
              throw Error(
                  text(scope.path(), ": ", component_name<std::decay_t<decltype(c)>>()),
                  "it is over values on the points of a body, and elements cannot go from that body, nor "
                  "be cut; take the body or the values out of the scene");
        }));
  }

  std::vector<Topology> topologiesOver(void const* state) const {
    std::vector<Topology> all;
    traverse(root_, on<role::Topology>([&](auto& t, auto const& scope) {
               if (scope.pointsAddress() == state)
                 all.push_back({&t, t.view(), editable_topology<std::decay_t<decltype(t)>>, scope.path()});
             }));
    return all;
  }

  void check(std::string_view path, ElementNumbers const& gone) const {
    const auto lists = gone.lists();
    for (Topology const& t : topologiesOver(state_)) {
      if (t.address != topology_) continue;
      for (const Index i : gone.points)
        if (i < 0 || std::size_t(i) >= points_)
          throw Error(t.path,
                      text("point ",
                           i,
                           " cannot be removed: '",
                           path,
                           "' has ",
                           points_,
                           ", numbered from 0; correct the number"));
      if (!t.editable)
        throw Error(t.path,
                    "the elements of this topology are made from a few numbers, and none of them "
                    "can be removed; give "
                    "the node a MeshTopology with these elements");
      for_each_kind(t.view, [&](int kind, auto const& list) {
        for (const Index e : *lists[std::size_t(kind)])
          if (e < 0 || std::size_t(e) >= list.size())
            throw Error(t.path,
                        text(element_kind_name(kind),
                             ' ',
                             e,
                             " cannot be removed: the topology of '",
                             path,
                             "' has ",
                             list.size(),
                             ", numbered from 0; correct the number"));
      });
    }
  }

  // what becomes of the state of the topology
  void plan(ElementNumbers const& gone) {
    const auto all = topologiesOver(state_);
    std::vector<TopologyView> views;
    std::size_t first = 0;
    for (std::size_t t = 0; t < all.size(); ++t) {
      if (all[t].address == topology_) first = t;
      views.push_back(all[t].view);
    }
    RemovalPlan whole = plan_element_removal(points_, views, first, gone);
    border_ = {views[first], whole.elements[first]};
    samePoints_.insert(state_);
    traverse(root_, on<role::ForceField, role::Mass>([this](auto&, auto const& scope) {
               mechanical_.insert(scope.topologyAddress());
             }));
    record(state_, std::move(whole), all);
    auto const& kinds = change().elements;
    const bool some = std::any_of(kinds.begin(), kinds.end(), [](auto const& k) { return !k.now.empty(); });
    const bool left = std::any_of(kinds.begin(), kinds.end(), [](auto const& k) { return !k.kept.empty(); });
    if (some ? !left : change().points.kept.empty())
      throw Error(all[first].path,
                  "no element would be left; take the node out of the scene instead (Simulation::change)");
  }

  // what becomes of the states over the same points, of all topologies over these, and of what is mapped from
  // there
  void planCut(CutOrder const& order) {
    CutBody<RootScope> body(root_, topology_, state_);
    cut_ = body.plan(order);
    samePoints_ = body.states;
    planCarried(order);
    if (cut_.elements == 0) {
      ofTopology_[topology_].points = cut_.points;
      return;
    }
    joined_ = [this, blade = order.stroke.blade, x = body.positions()](Index& i, Index& j) {
      const Edge edge{std::min(i, j), std::max(i, j)};
      if (std::binary_search(cut_.split.begin(), cut_.split.end(), edge)) return false;
      const auto moved = std::lower_bound(
          cut_.moved.begin(), cut_.moved.end(), edge, [](auto const& m, Edge const& e) { return m[0] < e; });
      if (moved != cut_.moved.end() && (*moved)[0] == edge) {
        const Edge now = (*moved)[1];
        const bool rising = i < j;
        i = now[rising ? 0 : 1], j = now[rising ? 1 : 0];
        return true;
      }
      return !blade.crossing(x[std::size_t(i)], x[std::size_t(j)], Eigen::Vector3d::Zero());
    };
    touchedStates_ = samePoints_;
    for (void const* state : samePoints_) ofState_[state] = cut_.points;
    for (std::size_t t = 0; t < body.bodies.size(); ++t) {
      ofTopology_[body.bodies[t].address] = cut_.ofTopology[t];
      lists_[body.bodies[t].address] = &cut_.lists[t];
      if (cut_.ofTopology[t].changes() && !body.bodies[t].editable)
        throw Error(body.bodies[t].path,
                    "this topology is made from a few numbers, and cannot be cut; take a MeshTopology");
    }
    touchMapped();
  }
  // surfaces that the body carries are cut by the same blade, where it is
  void planCarried(CutOrder const& order) {
    std::size_t number = 0;
    traverse(
        root_, on<role::Mapping>([&](auto& mapping, auto const& scope) {
          using M = std::decay_t<decltype(mapping)>;
          if constexpr (carries_points<M>)
            scope.withMapped(mapping, [&](auto&, auto& child, auto& parent) {
              if (!samePoints_.contains(&parent)) return;
              CutOrder ofChild{order.stroke, order.rules, {}, {}};
              ofChild.rules.capacity = CutRules{}.capacity;
              if (number < order.front.carried.size() &&
                  order.front.carried[number].size == child.position.size())
                ofChild.front = order.front.carried[number];
              ++number;
              typename M::In::VecCoord before;
              for (auto const& x : order.before) before.push_back(x.template cast<typename M::In::Real>());
              if (!before.empty()) ofChild.before = this->carried(mapping, child, before);
              this->planCarried(
                  child, this->carried(mapping, child, parent.position), mapping.useRestPosition, ofChild);
              cut_.front.carried.push_back(std::move(ofChild.front));
            });
        }));
  }
  template <class M, class Child, class VecCoord>
  static std::vector<Eigen::Vector3d> carried(M const& mapping, Child const& child, VecCoord const& parent) {
    typename M::Out::VecCoord x(child.position.size());
    mapping.apply(x, parent);
    std::vector<Eigen::Vector3d> all;
    for (auto const& p : x) all.push_back(p.template cast<double>());
    return all;
  }
  template <class Child>
  void planCarried(Child const& child, std::vector<Eigen::Vector3d> const& x, bool atRest, CutOrder& order) {
    BodyOfPoints<RootScope> family(root_, &child);
    std::vector<TopologyView> views;
    std::vector<bool> grows;
    std::size_t first = family.bodies.size();
    auto dimension = [&](std::size_t t) {
      return !views[t].tetrahedra.empty() ? 3 : !views[t].triangles.empty() ? 2 : 0;
    };
    for (std::size_t t = 0; t < family.bodies.size(); ++t) {
      auto const& body = family.bodies[t];
      views.push_back(body.view);
      grows.push_back(!family.mechanical.contains(body.address));
      if (!body.view.quads.empty() || !body.view.hexahedra.empty()) return;
      if (dimension(t) > (first < t ? dimension(first) : 0)) first = t;
    }
    if (first == family.bodies.size()) return;
    if (dimension(first) == 3)
      add_crossings(views[first].tetrahedra, x, order.before, order.stroke, order.front);
    else
      add_crossings(views[first].triangles, x, order.before, order.stroke, order.front);
    order.front.size = x.size();
    if (!cut_.changes()) return;
    CutPlan plan = plan_cut(placesOf(child, atRest), views, first, grows, order.front, order.rules);
    order.front = plan.front;
    order.front.size = plan.points.size();
    if (!plan.changes()) return;
    family.checkValues("the body that carries it is cut");
    CutPlan const& kept = carried_.emplace_back(std::move(plan));
    for (void const* state : family.states) ofState_[state] = kept.points;
    for (std::size_t t = 0; t < family.bodies.size(); ++t) {
      ofTopology_[family.bodies[t].address] = kept.ofTopology[t];
      if (!kept.ofTopology[t].changes()) continue;
      lists_[family.bodies[t].address] = &kept.lists[t];
      if (!family.bodies[t].editable)
        throw Error(family.bodies[t].path,
                    "this topology is made from a few numbers, and cannot be cut with the body that carries "
                    "it; take a MeshTopology");
    }
  }
  // where its mapping looks for the points of a state or a visual model
  template <class Child>
  static std::vector<Eigen::Vector3d> placesOf(Child const& child, bool atRest) {
    if constexpr (HasRole<Child, role::VisualModel>) {
      return child.mesh.positions;
    } else {
      auto const& given = child.given ? *child.given : child.position;
      return centers_of(child, atRest && child.givenRest ? *child.givenRest : given);
    }
  }
  void touchMapped() {
    traverse(root_, on<role::Mapping>([this](auto& mapping, auto const& scope) {
               scope.withMapped(mapping, [&](auto&, auto& child, auto& parent) {
                 if (touchedStates_.contains(&parent)) touchedStates_.insert(&child);
               });
             }));
  }

  // the same where elements come
  void planAddition(AddedElements const& added) {
    BodyOfPoints<RootScope> body(root_, state_);
    std::vector<TopologyOfBody> topologies;
    std::size_t first = 0;
    auto numberOf = [&](void const* address) {
      const auto found = std::find_if(
          body.bodies.begin(), body.bodies.end(), [&](auto const& b) { return b.address == address; });
      return found == body.bodies.end() ? -1 : int(found - body.bodies.begin());
    };
    for (auto const& b : body.bodies) {
      if (b.address == topology_) first = topologies.size();
      topologies.push_back({b.view, b.conversion, b.copies ? numberOf(b.copies) : -1});
    }
    const std::string& path = body.bodies[first].path;
    AddPlan plan;
    try {
      plan = plan_addition(points_, topologies, first, added);
    } catch (Error const& error) {
      throw Error(path, error.what());
    }
    added_ = std::move(plan.lists);
    samePoints_ = body.states;
    touchedStates_ = samePoints_;
    for (void const* state : samePoints_) ofState_[state] = plan.points;
    for (std::size_t t = 0; t < body.bodies.size(); ++t) {
      ofTopology_[body.bodies[t].address] = plan.ofTopology[t];
      if (!plan.ofTopology[t].changes()) continue;
      if (!body.bodies[t].editable)
        throw Error(
            body.bodies[t].path,
            "this topology is made from a few numbers, and nothing can come to it; take a MeshTopology");
      lists_[body.bodies[t].address] = &added_[t];
    }
    if (plan.points.changes()) {
      body.checkValues("points are to come to its body");
      traverse(root_, on<role::State>([&](auto& s, auto const& scope) {
                 if constexpr (std::decay_t<decltype(s)>::DataTypes::rigid)
                   if (static_cast<void const*>(&s) == state_)
                     throw Error(scope.path(), "its points are frames, and none can come between them");
               }));
    }
    traverse(root_, on<AnyRole>([this](auto& c, auto const& scope) { this->checkElementValues(c, scope); }));
    touchMapped();
  }
  // what has a value for each element, where one comes that has none
  template <class C, class S>
  void checkElementValues(C const& c, S const& scope) const {
    if constexpr (HasRole<C, role::Mapping>) {
      if constexpr (over_parent<C>) {
        bool maps = false;
        scope.withMapped(c, [&](auto&, auto&, auto& parent) { maps = samePoints_.contains(&parent); });
        void const* const own = scope.topologyAddress();
        if (maps && comesOfNone(ofTopology(own ? own : scope.parentScope().topologyAddress()),
                                [](int) { return true; }))
          throw Error(text(scope.path(), ": ", component_name<C>()),
                      "it maps a value from each element, and some are to come; take it away");
      }
    } else if constexpr (ActsOnState<C> && !JoinsTwo<C>) {
      TopologyChange const& here = ofTopology(scope.topologyAddress());
      for_each_field(c, [&](auto const& fd, auto const& value) {
        if constexpr (detail::is_list<std::decay_t<decltype(value)>>)
          if (!fd.numbers && value.size() > 1 && comes(here, fd.entries))
            throw Error(
                text(scope.path(), ": ", component_name<C>()),
                text(fd.name,
                     " has a value for each element, and one is to come without an ancestor whose value "
                     "it could have; give one value for all, or ancestors"));
      });
    }
  }
  // whether elements of a kind come that are parts of none
  template <class OfKind>
  static bool comesOfNone(TopologyChange const& change, OfKind&& ofKind) {
    for (int kind = 0; kind < element_kinds; ++kind) {
      auto const& come = change.elements[std::size_t(kind)].come;
      if (ofKind(kind) && std::any_of(come.begin(), come.end(), [](Origin const& o) { return o.isNone(); }))
        return true;
    }
    return false;
  }
  static bool comes(TopologyChange const& change, Of what) {
    auto kinds = [&](std::initializer_list<int> all) {
      return comesOfNone(change,
                         [&](int kind) { return std::find(all.begin(), all.end(), kind) != all.end(); });
    };
    switch (what) {
      case Of::edges:
      case Of::lines:
        return kinds({0});
      case Of::triangles:
        return kinds({1});
      case Of::quads:
        return kinds({2});
      case Of::surfaces:
        return kinds({1, 2});
      case Of::hexahedra:
        return kinds({4});
      case Of::volumes:
        return kinds({3, 4});
      case Of::elements:  // those of the highest dimension
        return comesOfNone(change, [&](int kind) {
          return change.dimension() == 0 || dimension_of_kind(kind) == change.dimension();
        });
      default:
        return false;
    }
  }

  // what becomes of the states that are mapped from it, parents first
  void planMapped() {
    touchedStates_.insert(state_);
    traverse(root_, on<role::Mapping>([this](auto& mapping, auto const& scope) {
               void const* mapped = nullptr;
               std::vector<bool> stays;
               scope.withMapped(mapping, [&](auto& part, auto& child, auto& parent) {
                 if (!touchedStates_.contains(&parent)) return;
                 mapped = &child;
                 if constexpr (requires { std::decay_t<decltype(part)>::samePoints; })
                   if (samePoints_.contains(&parent)) copyOfBody(child, scope.topologyAddress());
                 stays.resize(sizeOf(child), true);
                 const std::vector<bool> here = pointsThatStay(part, scope, child, parent);
                 for (std::size_t i = 0; i < stays.size(); ++i) stays[i] = stays[i] && here[i];
               });
               if (!mapped) return;
               touchedStates_.insert(mapped);
               const auto over = topologiesOver(mapped);
               if (!(samePoints_.contains(mapped) && !over.empty()) &&
                   std::find(stays.begin(), stays.end(), false) == stays.end())
                 return;
               std::vector<TopologyView> views;
               for (Topology const& t : over) views.push_back(t.view);
               record(mapped, plan_point_removal(stays, views), over);
             }));
  }
  template <class Child>
  void copyOfBody(Child const& child, void const* above) {
    samePoints_.insert(&child);
    if constexpr (HasRole<Child, role::VisualModel>) {
      if (const BorderLists lists = border_.listed(child.mesh.triangles, child.mesh.quads); lists.any()) {
        borders_[&child] = lists;
        return;
      }
      traverse(root_, on<role::Topology>([&](auto& t, auto const&) {
                 if (static_cast<void const*>(&t) != above) return;
                 const TopologyView view = t.view();
                 auto same = [](auto const& a, auto const& b) {
                   return std::equal(a.begin(), a.end(), b.begin(), b.end());
                 };
                 if (same(child.mesh.triangles, view.triangles) && same(child.mesh.quads, view.quads))
                   copies_[&child] = above;
               }));
    }
  }
  template <class M, class S, class Child, class Parent>
  std::vector<bool> pointsThatStay(M const& mapping, S const& scope, Child const& child,
                                   Parent const& parent) const {
    if constexpr (over_parent<M>) {
      void const* const own = scope.topologyAddress();
      void const* const topology = own ? own : scope.parentScope().topologyAddress();
      for (Topology const& t : topologiesOver(&parent))
        if (t.address == topology && ofTopology_.contains(topology))
          return mapping.pointsThatStay(t.view, ofTopology(topology));
    }
    return mapped_points_that_stay(mapping, ofState(&parent), sizeOf(child));
  }
  template <class Child>
  static std::size_t sizeOf(Child const& child) {
    if constexpr (HasRole<Child, role::VisualModel>)
      return child.mesh.positions.size();
    else
      return child.size();
  }

  void record(void const* state, RemovalPlan plan, std::vector<Topology> const& topologies) {
    ofState_[state] = Renumbering::of(plan.points);
    for (std::size_t t = 0; t < topologies.size(); ++t) {
      Topology const& here = topologies[t];
      if (samePoints_.contains(state) && here.editable && dimension_of(here.view) < 3 &&
          !mechanical_.contains(here.address)) {
        const BorderLists lists = border_.listed(here.view.triangles, here.view.quads);
        if (lists.any()) borders_[here.address] = lists;
        border_.mark(lists, here.view, plan.elements[t]);
      }
      ofTopology_[topologies[t].address] = plan.change(t);
      if (!topologies[t].editable && plan.change(t).changes())
        throw Error(topologies[t].path,
                    "this topology is made from a few numbers, and cannot lose the points that it "
                    "would have to; "
                    "take a MeshTopology");
    }
  }

  Renumbering const& ofState(void const* state) const {
    static const Renumbering none{};
    const auto found = ofState_.find(state);
    return found == ofState_.end() ? none : found->second;
  }
  TopologyChange const& ofTopology(void const* topology) const {
    static const TopologyChange none{};
    const auto found = ofTopology_.find(topology);
    return found == ofTopology_.end() ? none : found->second;
  }

  template <class C, class S>
  void follow(C& c, S const& scope) const {
    if constexpr (HasRole<C, role::VisualModel>)
      if (const auto found = lists_.find(&c); found != lists_.end())
        return c.follow(ofState(&c), found->second->triangles, found->second->quads, found->second->edges);
    if constexpr (HasRole<C, role::Topology> && editable_topology<C>)
      if (const auto found = lists_.find(&c); found != lists_.end())
        return give(c.edit(), *found->second, ofTopology(&c).points);
    if constexpr (HasRole<C, role::State> || HasRole<C, role::VisualModel>) {
      const auto border = borders_.find(&c);
      [[maybe_unused]] auto changeFaces = [&](auto&& edit) {
        if constexpr (HasRole<C, role::VisualModel>) {
          if (border == borders_.end()) return;
          const auto triangles = c.mesh.triangles;
          const auto quads = c.mesh.quads;
          edit(border->second, c.mesh.triangles, c.mesh.quads);
          if constexpr (requires { c.facesWere(triangles, quads); }) c.facesWere(triangles, quads);
        }
      };
      changeFaces(
          [&](auto const& of, auto& triangles, auto& quads) { border_.takeAway(of, triangles, quads); });
      if constexpr (HasRole<C, role::VisualModel>)
        if (const auto copy = copies_.find(&c); copy != copies_.end()) {
          const auto triangles = c.mesh.triangles;
          const auto quads = c.mesh.quads;
          ofTopology(copy->second).of(ElementKind::triangle).filter(c.mesh.triangles);
          ofTopology(copy->second).of(ElementKind::quad).filter(c.mesh.quads);
          if constexpr (requires { c.facesWere(triangles, quads); }) c.facesWere(triangles, quads);
        }
      if (ofState(&c).changes()) c.follow(ofState(&c));
      changeFaces([&](auto const& of, auto& triangles, auto& quads) {
        border_.exposeFaces(of, change().points, &triangles, &quads);
      });
    } else if constexpr (HasRole<C, role::Topology>) {
      if constexpr (editable_topology<C>) {
        if (ofTopology(&c).changes()) follow(c.edit(), ofTopology(&c));
        if (const auto border = borders_.find(&c); border != borders_.end())
          border_.exposeFaces(border->second, change().points, c.edit().triangles, c.edit().quads);
      }
    } else if constexpr (HasRole<C, role::CollisionModel>) {
      follow_fields(c,
                    {ofState(scope.stateAddress()),
                     ofState(scope.stateAddress()),
                     {},
                     ofTopology(scope.topologyAddress())});
    } else if constexpr (HasRole<C, role::TopologicalChange>) {
      if constexpr (FollowsElements<C>)
        if (TopologyChange const& change = ofTopology(scope.topologyAddress()); change.changes())
          c.followElements(change);
    } else if constexpr (HasRole<C, role::ContactManager>) {
      std::vector<Renumbering const*> surfaces;
      with_collision_scope(scope, root_, [&](auto const& models) {
        traverse(models, on<role::CollisionModel>([&](auto&, auto const& s) {
                   surfaces.push_back(&ofState(s.stateAddress()));
                 }));
      });
      c.follow([&](int s) -> Renumbering const& { return *surfaces[std::size_t(s)]; });
    } else if constexpr (HasRole<C, role::Mapping>) {
      void const* mapped = nullptr;
      bool any = false;
      std::vector<Renumbering const*> parents;
      scope.withMapped(c, [&](auto&, auto& child, auto& parent) {
        mapped = &child;
        any = any || touchedStates_.contains(&parent);
        parents.push_back(&ofState(&parent));
      });
      if (!any) return;
      if constexpr (HasParents<C>)
        c.follow(ofState(mapped), parents);
      else
        follow_fields(c, {ofState(mapped), {}, *parents[0], ofTopology(scope.topologyAddress())});
    } else if constexpr (JoinsTwo<C>) {
      scope.withEnds(c, [&](auto const& a, auto const& b) {
        if (ofState(a.stateAddress()).changes() || ofState(b.stateAddress()).changes())
          follow_fields(c, {ofState(a.stateAddress()), ofState(b.stateAddress()), {}, ofTopology(nullptr)});
      });
    } else if constexpr (ActsOnState<C>) {
      if (touchedStates_.contains(scope.stateAddress()))
        follow_fields(c,
                      {ofState(scope.stateAddress()),
                       ofState(scope.stateAddress()),
                       {},
                       ofTopology(scope.topologyAddress()),
                       samePoints_.contains(scope.stateAddress()) ? joined_ : nullptr,
                       refined_ && samePoints_.contains(scope.stateAddress())});
    }
  }
  static void give(ElementLists const& lists, AddPlan::Lists const& now, Renumbering const& points) {
    if (lists.positions) points.filter(*lists.positions);
    if (lists.edges) *lists.edges = now.edges;
    if (lists.triangles) *lists.triangles = now.triangles;
    if (lists.quads) *lists.quads = now.quads;
    if (lists.tetrahedra) *lists.tetrahedra = now.tetrahedra;
    if (lists.hexahedra) *lists.hexahedra = now.hexahedra;
    if (lists.pyramids) *lists.pyramids = now.pyramids;
    if (lists.prisms) *lists.prisms = now.prisms;
    if (lists.quadraticTetrahedra) *lists.quadraticTetrahedra = now.quadraticTetrahedra;
    if (lists.quadraticHexahedra) *lists.quadraticHexahedra = now.quadraticHexahedra;
    if (lists.triquadraticHexahedra) *lists.triquadraticHexahedra = now.triquadraticHexahedra;
  }
  static void follow(ElementLists const& lists, TopologyChange const& change) {
    if (lists.positions) change.points.filter(*lists.positions);
    lists.forEach([&](int kind, auto& list) {
      change.elements[std::size_t(kind)].filter(list);
      for (auto& element : list)
        for (Index& i : element) change.points.renumber(i);
    });
  }

  // what stands on a state around which something changes has to be initialised again
  template <class C, class S>
  bool isTouched(C const& c, S const& scope) const {
    if constexpr (HasRole<C, role::VisualModel>) {
      return touchedStates_.contains(&c);
    } else if constexpr (HasRole<C, role::Mapping>) {
      bool any = false;
      scope.withMapped(c, [&](auto&, auto& child, auto&) { any = touchedStates_.contains(&child); });
      return any;
    } else if constexpr (HasRole<C, role::Topology> || HasRole<C, role::State> || ActsOnState<C>) {
      bool any = false;
      with_scopes_of(
          c, scope, [&](auto const&... at) { any = (touchedStates_.contains(at.stateAddress()) || ...); });
      return any;
    } else {
      return false;
    }
  }
};

}  // namespace sinew
