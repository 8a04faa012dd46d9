// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/core/step_warnings.hpp>
#include <sinew/scene/topology_edit.hpp>

#include <algorithm>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace sinew {

/// What the components of a scene change of its topologies before a step.
template <class RootScope>
struct TopologicalChanges {
  RootScope const& root;

  /// Before all else: which topologies may be without elements, since some may come.
  void begin() const {
    traverse(root, on<role::Topology>([](auto& t, auto const&) {
               if constexpr (requires { t.grows; }) t.grows = false;
             }));
    traverse(root, on<role::TopologicalChange>([this](auto& c, auto const& scope) {
               if constexpr (MayAddElements<std::decay_t<decltype(c)>>)
                 if (c.mayAdd(whereOf(c, scope)) && scope.topologyAddress())
                   markGrowing(scope.topologyAddress());
             }));
  }

  /// Throws Error where there is no topology whose elements can be removed.
  void prepare() const {
    traverse(root, on<role::TopologicalChange>([this](auto& c, auto const& scope) {
               const std::string where = whereOf(c, scope);
               if (!scope.topologyAddress())
                 throw Error(
                     where, "neither its node nor one above has a topology; give one of them a MeshTopology");
               if (!this->place(scope).editable)
                 throw Error(
                     where,
                     "the elements of its topology are made from a few numbers, and none of them can be "
                     "removed; give the node a MeshTopology with these elements");
               c.prepare(where, scope.topology());
               if constexpr (TearsElements<std::decay_t<decltype(c)>>) this->prepareTearing(where, scope);
             }));
  }

  /// By edit(path, order), which returns what a cut has done, and after which the scene is another one, at
  /// the same place. Says whether something has changed.
  template <class Edit>
  bool make(double time, StepNotes const& notes, Edit&& edit) const {
    int count = 0;
    traverse(root, on<role::TopologicalChange>([&](auto const&, auto const&) { ++count; }));
    bool any = false;
    for (int number = 0; number < count; ++number)
      for (bool due = true; due;) {
        Place here;
        TopologicalOrder order;
        std::optional<CutOrder> cut;
        bool keepsLast = false;
        at(number, [&](auto& c, auto const& scope) {
          if constexpr (TearsElements<std::decay_t<decltype(c)>>) {
            cut = this->tear(c, scope);
            due = cut.has_value();
            if (due) here = this->place(scope);
          } else {
            here = this->place(scope);
            due = find(c, scope, here.points, time, order);
          }
          if (due && !order.box.empty())
            addThoseIn(order.box, scope.topology(), positionsOf(scope.pointsAddress()), order.gone);
          keepsLast = due && order.removes() && keepOne(scope.topology(), order.gone);
          if (keepsLast)
            notes.warn(scope.path(), "the last element of a body stays", [] {
              return "the last element of a body stays: a body keeps one element; take its node out of the "
                     "scene where it is to go (Simulation::change)";
            });
          if constexpr (NoticesChange<std::decay_t<decltype(c)>>)
            if (const std::string_view what = c.notice(); !what.empty())
              notes.warn(scope.path(), what, [&] { return std::string(what); });
          if (due && !order.incision.empty()) cut = this->incision(c, scope, order.incision);
        });
        if (!due) break;
        const bool some = order.removes() || !order.added.empty() || cut;
        bool changes = true;
        if (cut) {
          const Cut done = edit(here.path, *cut);
          changes = done.change.changes();
          at(number, [&](auto& c, auto const&) {
            if constexpr (requires { c.front; }) c.front = done.front;
          });
        } else if (order.removes()) {
          edit(here.path, order.gone);
        } else if (!order.added.empty()) {
          edit(here.path, order.added);
        }
        any = any || some;
        bool again = !keepsLast;  // else it would be found again
        at(number, [&](auto& c, auto const&) {
          if constexpr (TearsElements<std::decay_t<decltype(c)>>) {
            c.changeMade(changes);
            again = false;
          } else if constexpr (FindsChanges<std::decay_t<decltype(c)>>) {
            c.changeMade();
          } else {
            c.elementsRemoved();
          }
        });
        if (!again) break;
      }
    return any;
  }

 private:
  struct Place {
    std::string path{};  // from the root
    bool editable = false;
    std::size_t points = 0;  // of the state
  };
  template <class C, class S>
  static std::string whereOf(C const&, S const& scope) {
    return text(scope.path(), ": ", component_name<C>());
  }
  template <class S>
  Place place(S const& scope) const {
    Place found;
    void const *const address = scope.topologyAddress(), *state = nullptr;
    traverse(root, on<role::Topology>([&](auto& t, auto const& at) {
               if (static_cast<void const*>(&t) != address) return;
               const std::string path = at.path();
               found = {path.substr(std::min(path.size(), root.path().size() + 1)),
                        editable_topology<std::decay_t<decltype(t)>>};
               state = at.pointsAddress();
             }));
    traverse(root, on<role::State>([&](auto& s, auto const&) {
               if (static_cast<void const*>(&s) == state) found.points = s.size();
             }));
    return found;
  }
  // a topology, and those over its points that are made from others
  void markGrowing(void const* address) const {
    void const* points = nullptr;
    traverse(root, on<role::Topology>([&](auto& t, auto const& scope) {
               if (static_cast<void const*>(&t) == address) points = scope.pointsAddress();
             }));
    const auto states = same_points(root, points);
    traverse(root, on<role::Topology>([&](auto& t, auto const& scope) {
               if constexpr (requires { t.grows; })
                 if (static_cast<void const*>(&t) == address ||
                     (states.contains(scope.pointsAddress()) && !t.conversion.empty()))
                   t.grows = true;
             }));
  }
  std::vector<Eigen::Vector3d> positionsOf(void const* state) const {
    std::vector<Eigen::Vector3d> x;
    traverse(root, on<role::State>([&](auto const& s, auto const&) {
               if (static_cast<void const*>(&s) == state) x = centers_of(s, s.position);
             }));
    return x;
  }
  // elements of the highest dimension all of whose points are in a box
  static void addThoseIn(std::vector<Vec<double, 6>> const& box, TopologyView const& t,
                         std::vector<Eigen::Vector3d> const& x, ElementNumbers& gone) {
    auto isIn = [&](Index i) {
      return std::any_of(box.begin(), box.end(), [&](auto const& b) {
        Eigen::Array3d const p = x[std::size_t(i)].array(), a = b.template head<3>().array(),
                             c = b.template tail<3>().array();
        return (p >= a.min(c)).all() && (p <= a.max(c)).all();
      });
    };
    auto add = [&](auto const& list, std::vector<Index>& numbers) {
      for (std::size_t e = 0; e < list.size(); ++e)
        if (std::all_of(list[e].begin(), list[e].end(), isIn)) numbers.push_back(Index(e));
    };
    for_each_highest(t, [&](int kind, auto const& list) { add(list, gone.of(kind)); });
  }
  template <class C, class S>
  std::optional<CutOrder> incision(C& c, S const& scope, std::vector<Eigen::Vector3d> const& path) const {
    std::optional<CutOrder> cut;
    if constexpr (requires { c.incise(path, path, path, TopologyView{}); }) {
      std::vector<Eigen::Vector3d> x, rest;
      traverse(root, on<role::State>([&](auto const& s, auto const&) {
                 if (static_cast<void const*>(&s) != scope.pointsAddress()) return;
                 x = centers_of(s, s.position), rest = centers_of(s, s.restPosition);
               }));
      try {
        cut = CutOrder{c.incise(path, x, rest, scope.topology()), c.rules(), c.front, {}};
      } catch (Error const& error) {
        throw Error(whereOf(c, scope), error.what());
      }
    }
    return cut;
  }
  template <class S>
  void prepareTearing(std::string const& where, S const& scope) const {
    bool any = false;
    traverse(root, on<role::ForceField>([&](auto const& force, auto const& at) {
               any = any || (GivesStress<std::decay_t<decltype(force)>> && actsThere(at, scope));
             }));
    if (!any)
      throw Error(where,
                  "no force field of its node says what stresses the elements are under, and so none would "
                  "tear; give the node a TriangleFEMForceField or a TetrahedronFEMForceField");
    CutBody<RootScope>(root, scope.topologyAddress(), scope.pointsAddress());
  }
  template <class F, class S>
  static bool actsThere(F const& at, S const& scope) {
    return at.topologyAddress() == scope.topologyAddress() && at.stateAddress() == scope.pointsAddress();
  }
  template <class C, class S>
  std::optional<CutOrder> tear(C& c, S const& scope) const {
    using D = typename C::DataTypes;
    if (!c.looks(scope.topology())) return {};
    traverse(root, on<role::ForceField>([&](auto const& force, auto const& at) {
               using F = std::decay_t<decltype(force)>;
               if constexpr (GivesStress<F>)
                 if (actsThere(at, scope)) {
                   auto const& state = at.template state<typename F::DataTypes>();
                   force.addStress({{}, state.restPosition, at.topology()}, state.position, c.stress);
                 }
             }));
    if (!c.overloaded()) return {};
    auto const& state = scope.template state<D>();
    std::vector<bool> held(state.size(), false);
    traverse(root, on<role::ProjectiveConstraint>([&](auto const& constraint, auto const& at) {
               using P = std::decay_t<decltype(constraint)>;
               if constexpr (!JoinsTwo<P>)
                 if constexpr (std::is_same_v<typename P::DataTypes, D>)
                   if (at.stateAddress() == scope.pointsAddress()) {
                     typename D::VecDeriv moves(state.size(), D::Deriv::Ones());
                     constraint.projectResponse(moves);
                     for (std::size_t i = 0; i < held.size(); ++i)
                       held[i] = held[i] || moves[i].squaredNorm() == 0;
                   }
             }));
    const auto stroke = c.tear(scope.topology(), centers_of(state, state.position), held);
    if (!stroke) return {};
    return CutOrder{*stroke, c.rules(), c.front, {}};
  }
  // Leaves the first element out where all of the highest dimension would go.
  static bool keepOne(TopologyView const& topology, ElementNumbers& elements) {
    bool all = true;
    std::vector<Index>* some = nullptr;
    for_each_highest(topology, [&](int kind, auto const& list) {
      std::vector<Index>& numbers = elements.of(kind);
      std::sort(numbers.begin(), numbers.end());
      numbers.erase(std::unique(numbers.begin(), numbers.end()), numbers.end());
      all = all && numbers.size() == list.size();
      if (!some && !numbers.empty()) some = &numbers;
    });
    if (!all || !some) return false;
    some->erase(some->begin());
    return true;
  }
  template <class F>
  void at(int number, F&& f) const {
    int here = 0;
    traverse(root, on<role::TopologicalChange>([&](auto& c, auto const& scope) {
               if (here++ == number) f(c, scope);
             }));
  }
  template <class C, class S>
  static bool find(C& c, S const& scope, std::size_t points, double time, TopologicalOrder& order) {
    if constexpr (FindsChanges<C>) {
      try {
        return c.findChange(scope.topology(), points, time, order);
      } catch (Error const& error) {
        throw Error(whereOf(c, scope), error.what());
      }
    } else if constexpr (HasDataTypes<C>) {
      return c.findRemoved(
          scope.topology(), scope.template state<typename C::DataTypes>().position, time, order.gone);
    } else {
      return c.findRemoved(scope.topology(), time, order.gone);
    }
  }
};

}  // namespace sinew
