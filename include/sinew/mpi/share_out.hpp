// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/core/follow.hpp>
#include <sinew/mpi/distribution.hpp>
#include <sinew/mpi/same_on_all.hpp>
#include <sinew/scene/scope.hpp>
#include <sinew/scene/solvers.hpp>
#include <sinew/scene/states_of.hpp>
#include <sinew/scene/topology_edit.hpp>
#include <sinew/version.hpp>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

namespace sinew::mpi {

/// Classes of which each rank can have a part. A component of a user's own says that it can by `static
/// constexpr bool distributed = true`: what it has of points and elements follows by its fields
/// (core/follow.hpp), and what it does at a point needs the elements at that point only.
inline constexpr auto distributed_classes =
    std::to_array<std::string_view>({"MechanicalObject",
                                     "MeshTopology",
                                     "TetrahedronTopology",
                                     "UniformMass",
                                     "DiagonalMass",
                                     "EulerImplicitSolver",
                                     "EulerExplicitSolver",
                                     "PetscLinearSolver",
                                     "TetrahedronFEMForceField",
                                     "HexahedronFEMForceField",
                                     "MeshSpringForceField",
                                     "StiffSpringForceField",
                                     "PlaneForceField",
                                     "SphereForceField",
                                     "ConstantForceField",
                                     "RestShapeSpringsForceField",
                                     "UniformVelocityDampingForceField",
                                     "FixedConstraint",
                                     "PartialFixedConstraint",
                                     "FixedPlaneConstraint",
                                     "LinearMovementConstraint",
                                     "LinearVelocityConstraint",
                                     "AffineMovementConstraint",
                                     "OscillatorConstraint",
                                     "ParabolicConstraint",
                                     "HermiteSplineConstraint",
                                     "ProjectDirectionConstraint",
                                     "ProjectToPointConstraint",
                                     "ProjectToLineConstraint",
                                     "ProjectToPlaneConstraint",
                                     "IdentityMapping",
                                     "SubsetMapping",
                                     "BarycentricMapping",
                                     "DefaultPipeline",
                                     "BruteForceBroadPhase",
                                     "BVHNarrowPhase",
                                     "MinProximityIntersection",
                                     "LocalMinDistance",
                                     "DefaultContactManager",
                                     "PointCollisionModel",
                                     "LineCollisionModel",
                                     "TriangleCollisionModel",
                                     "SphereCollisionModel"});

template <class C>
constexpr bool is_distributed() {
  if constexpr (requires { C::distributed; })
    return C::distributed;
  else if constexpr (JoinsTwo<C>)
    return false;
  else if constexpr (HasRole<C, role::Context> || HasRole<C, role::Engine>)
    return true;  // a value for all points, or data that are there before the scene starts
  else if constexpr (HasRole<C, role::VisualModel>)
    return true;  // in the whole scene alone
  else if constexpr (requires { requires C::matrixFree; })
    return C::className == std::string_view("CGLinearSolver");
  else
    return std::find(distributed_classes.begin(), distributed_classes.end(), C::className) !=
           distributed_classes.end();
}

/// Throws Error with all components that are not distributed yet.
template <class RootScope>
void refuse_undistributed(RootScope const& root) {
  std::vector<std::string> all;
  traverse(root, on<AnyRole>([&](auto const& c, auto const& scope) {
             using C = std::decay_t<decltype(c)>;
             if constexpr (!is_distributed<C>()) all.push_back(text(scope.path(), ": ", component_name<C>()));
           }));
  if (all.empty()) return;
  std::string list;
  for (auto const& name : all) list += text("\n  ", name);
  throw Error(root.path(),
              text("not distributed yet ",
                   all.size() == 1 ? "is this component" : "are these components",
                   ", so that the scene runs without --mpi only; leave them out, or run it in one process:",
                   list));
}

/// Shares out a scene that is initialised: each rank keeps its part of each state, of the topologies over it,
/// and of what refers to their points and elements. All has to be initialised again.
///
/// What a mapped state does comes back to the points of its parent. So points of a parent have something in
/// common, as those of an element have, where one element of the child is carried by them; and a rank has
/// all elements of the child that come back to a point of its own. Of a state whose points collide each rank
/// has all points, and those that carry them, so that all ranks find the same contacts. What no solver moves
/// is on each rank as a whole. Visual models are empty: they are looked at in the whole scene.
template <class RootScope>
class ShareOut {
 public:
  ShareOut(RootScope const& root, Distribution& to) : root_(root), to_(to) {}

  void apply() {
    describe();
    if (std::none_of(states_.begin(), states_.end(), [](State const& s) { return s.moves; }))
      throw Error(root_.path(),
                  "the scene has no points that could be shared out among ranks; run it in one process");
    for (State& s : states_)
      if (!s.parent) share(s);
    shareMapped();
    traverse(root_, on<AnyRole>([&](auto& c, auto const& scope) { follow(c, scope); }));
    emptyVisuals();
    for (State& s : states_)
      to_.add(Halo(std::move(s.part), to_.ranks().rank(), s.bytes), s.parent && s.moves);
  }

 private:
  using Points = std::vector<Index>;
  struct State {
    void const* address;
    std::string where;
    std::size_t points, bytes;  // of positions and velocities, of one
    std::vector<TopologyView> views{};
    std::vector<void const*> topologies{};
    std::vector<Points> joined{};       // points that have more than an element in common
    State* parent = nullptr;            // of one that is mapped
    bool samePoints = false;            // of the parent
    std::vector<Points> carriers{};     // of each point, those of the parent
    std::vector<Points> roots{};        // and those of the state above that is not mapped
    bool moves = false, whole = false;  // by a solver; on each rank
    std::vector<bool> kept{};           // points of one that is mapped that come back to this rank
    Part part{};

    State& top() { return parent ? parent->top() : *this; }
    /// f(its points) for each element and all else that joins points.
    template <class F>
    void forEachJoined(F&& f) const {
      detail::for_each_element(views, [&](auto const& e) { f(std::span<Index const>(e.data(), e.size())); });
      for (Points const& p : joined) f(std::span<Index const>(p.data(), p.size()));
    }
  };
  RootScope const& root_;
  Distribution& to_;
  std::deque<State> states_{};  // in their order in the scene

  State* find(void const* address) {
    for (State& s : states_)
      if (s.address == address) return &s;
    return nullptr;
  }
  static TopologyChange const& none() {
    static const TopologyChange nothing{};
    return nothing;
  }
  TopologyChange const& ofTopology(void const* address) const {
    for (State const& s : states_)
      for (std::size_t t = 0; t < s.topologies.size(); ++t)
        if (s.topologies[t] == address) return s.part.topologies[t];
    return none();
  }
  // whether the points of this node are to be looked at only
  template <class S>
  static bool isVisual(S const& scope) {
    return !with_first<role::State>(scope, [](auto&) {}) &&
           with_first<role::VisualModel>(scope, [](auto&) {});
  }
  bool isOwn(State const& s, Index point) const {
    return s.part.parts[std::size_t(point)] == to_.ranks().rank();
  }

  void describe() {
    traverse(root_, on<role::State>([&](auto& s, auto const& scope) {
               states_.push_back(State{.address = &s,
                                       .where = scope.path(),
                                       .points = s.size(),
                                       .bytes = sizeof s.position[0] + sizeof s.velocity[0]});
             }));
    for_each_integrator(root_, [&](auto&, auto const& scope) {
      traverse(scope, on<role::State>([&](auto& s, auto const&) { find(&s)->moves = true; }));
    });
    traverse(root_, on<role::Mapping>([&](auto& mapping, auto const& scope) { link(mapping, scope); }));
    traverse(root_, on<role::Topology>([&](auto const& t, auto const& at) {
               State* const of = isVisual(at) ? nullptr : find(at.pointsAddress());
               if (!of) return;
               if constexpr (!editable_topology<std::decay_t<decltype(t)>>)
                 if (of->moves)
                   throw Error(
                       at.path(),
                       text(component_name<std::decay_t<decltype(t)>>(),
                            " is made from a few numbers, and no rank can have a part of it; give the node a "
                            "MeshTopology with these elements"));
               of->views.push_back(t.view());
               of->topologies.push_back(&t);
             }));
    traverse(root_, on<role::ForceField>([&](auto& c, auto const& scope) {
               if (State* const of = find(scope.stateAddress())) joinEnds(c, *of);
             }));
    traverse(root_, on<role::CollisionModel>([&](auto& c, auto const& scope) {
               State* const of = find(scope.stateAddress());
               if (!of) return;
               if (of->moves && !of->parent)
                 throw Error(
                     text(scope.path(), ": ", component_name<std::decay_t<decltype(c)>>()),
                     "each rank has all points that collide, and of a body its part; put the model into "
                     "a child node with a state of its own that follows the body, such as a surface "
                     "with a SubsetMapping or BarycentricMapping");
               of->whole = true;
             }));
  }
  template <class M, class At>
  void link(M& mapping, At const& scope) {
    scope.withMapped(mapping, [&](auto& m, auto& child, auto& parent) {
      if constexpr (HasRole<std::decay_t<decltype(child)>, role::State>) {
        using Mapping = std::decay_t<decltype(m)>;
        State *const of = find(&child), *const above = find(&parent);
        if (!of || !above || !above->top().moves) return;
        if constexpr (HasParents<M> || !HasJacobianBlocks<Mapping>) {
          throw Error(text(scope.path(), ": ", component_name<M>()),
                      "it does not say which points of one parent carry a point, and no rank can have a part "
                      "of it");
        } else {
          of->parent = above;
          of->samePoints = requires { Mapping::samePoints; };
          for (std::size_t i = 0; i < of->points; ++i) {
            Points &carriers = of->carriers.emplace_back(), &roots = of->roots.emplace_back();
            m.forEachJacobianBlock(int(i), [&](int point, auto const&) { carriers.push_back(Index(point)); });
            for (const Index p : carriers)
              if (above->parent)
                roots.insert(
                    roots.end(), above->roots[std::size_t(p)].begin(), above->roots[std::size_t(p)].end());
              else
                roots.push_back(p);
            once(roots);
          }
        }
      }
    });
  }
  static void once(Points& points) {
    std::sort(points.begin(), points.end());
    points.erase(std::unique(points.begin(), points.end()), points.end());
  }
  // springs and the like, which have their ends in a list
  template <class C>
  static void joinEnds(C& c, State& of) {
    for_each_field(c, [&]<class List>(auto const&, List& list) {
      if constexpr (sinew::detail::is_struct_list<List>)
        for (auto& item : list) {
          Points ends;
          sinew::detail::for_each_number(item, [&](Of what, int& i) {
            if (sinew::detail::ListsThatFollow::isEntry(what)) ends.push_back(Index(i));
          });
          if (ends.size() > 1) of.joined.push_back(std::move(ends));
        }
    });
  }

  // a state that no other moves
  void share(State& s) {
    const int rank = to_.ranks().rank(), ranks = to_.ranks().size();
    compare(s);
    if (!s.moves) return keepWhole(s);
    Points everywhere;
    std::vector<Points> together = s.joined;
    for (State& child : states_) {
      if (!child.parent || &child.top() != &s) continue;
      if (child.whole)
        for (Points const& roots : child.roots)
          everywhere.insert(everywhere.end(), roots.begin(), roots.end());
      for (Points const& roots : child.roots)
        if (roots.size() > 1) together.push_back(roots);
      child.forEachJoined([&](std::span<Index const> points) {
        Points all;
        for (const Index i : points)
          all.insert(all.end(), child.roots[std::size_t(i)].begin(), child.roots[std::size_t(i)].end());
        once(all);
        if (all.size() > 1) together.push_back(std::move(all));
      });
    }
    once(everywhere);
    std::vector<int> parts;
    if (rank == 0) parts = parts_of_points(s.where, s.points, s.views, ranks, together);
    to_.ranks().broadcast(parts, "the parts of the scene, from rank 0");
    s.part = part_of(s.where, std::move(parts), s.views, rank, ranks, together, everywhere);
  }
  void keepWhole(State& s) {
    s.part.parts.assign(s.points, 0);
    s.part.ownedBy.assign(std::size_t(to_.ranks().size()), 0);
    s.part.ownedBy[0] = s.points;
    s.part.points = Renumbering::of(std::vector<bool>(s.points, true));
    for (std::size_t t = 0; t < s.views.size(); ++t)
      s.part.topologies.push_back({.points = s.part.points, .elements = {}});
  }

  // Children last to first, since a point asks for those that carry it; then first to last, since some have
  // the points of their parent.
  void shareMapped() {
    for (State& s : states_) {
      if (!s.parent) continue;
      compare(s);
      s.part.ownedBy.assign(std::size_t(to_.ranks().size()), 0);
      for (Points const& roots : s.roots) {
        // a point that nothing carries does not move
        s.part.parts.push_back(roots.empty() ? 0 : s.top().part.parts[std::size_t(roots[0])]);
        ++s.part.ownedBy[std::size_t(s.part.parts.back())];
      }
      s.kept.assign(s.points, s.whole);
    }
    auto comesBack = [&](State& s, std::span<Index const> points) {
      return s.whole || std::any_of(points.begin(), points.end(), [&](Index i) {
               auto const& roots = s.roots[std::size_t(i)];
               return std::any_of(roots.begin(), roots.end(), [&](Index r) { return isOwn(s.top(), r); });
             });
    };
    for (auto s = states_.rbegin(); s != states_.rend(); ++s) {
      if (!s->parent) continue;
      std::vector<bool>& mine = s->kept;
      for (std::size_t i = 0; i < s->points; ++i) {
        const Index point = Index(i);
        if (comesBack(*s, {&point, 1})) mine[i] = true;
      }
      s->forEachJoined([&](std::span<Index const> points) {
        if (comesBack(*s, points))
          for (const Index i : points) mine[std::size_t(i)] = true;
      });
      if (s->parent->parent)
        for (std::size_t i = 0; i < s->points; ++i)
          if (mine[i])
            for (const Index c : s->carriers[i]) s->parent->kept[std::size_t(c)] = true;
    }
    for (State& s : states_) {
      if (!s.parent) continue;
      s.part.points = s.samePoints ? s.parent->part.points : Renumbering::of(s.kept);
      for (TopologyView const& view : s.views) {
        TopologyChange& change = s.part.topologies.emplace_back();
        change.points = s.part.points;
        for_each_kind(view, [&](int kind, auto const& list) {
          std::vector<bool> stays;
          for (auto const& e : list) stays.push_back(comesBack(s, {e.data(), e.size()}));
          change.elements[std::size_t(kind)] = Renumbering::of(stays);
        });
      }
    }
  }

  // Visual models have no vertices, and their mappings and links nothing to move.
  void emptyVisuals() {
    traverse(root_, on<role::Mapping>([&](auto& mapping, auto const& scope) {
               using M = std::decay_t<decltype(mapping)>;
               if (!isVisual(scope)) return;
               mapping = M{};
               if constexpr (requires(Renumbering const& points) { mapping.shareOut(points, points); })
                 mapping.shareOut({}, {});
             }));
    traverse(root_, on<role::VisualModel>([](auto& visual, auto const&) {
               visual = std::decay_t<decltype(visual)>{};
             }));
    if constexpr (requires { root_.node.live.targets; })
      std::erase_if(root_.node.live.targets, [](auto const& target) {
        return target.entry && target.entry->component.template is<role::VisualModel>();
      });
  }

  // All ranks have the same scene, and the same version of Sinew.
  void compare(State const& s) {
    Mark elements, places, version;
    version.add(versionText().data(), versionText().size());
    traverse(root_, on<role::State>([&](auto const& state, auto const&) {
               if (static_cast<void const*>(&state) == s.address)
                 places.add(state.position.data(), state.position.size() * sizeof state.position[0]);
             }));
    s.forEachJoined([&](std::span<Index const> e) { elements.add(e.data(), e.size() * sizeof e[0]); });
    for (Points const& p : s.carriers) elements.add(p.data(), p.size() * sizeof p[0]);
    const std::vector<std::uint64_t> own{
        version.value, std::uint64_t(s.points), places.value, elements.value};
    std::vector<std::uint64_t> first = own;
    to_.ranks().broadcast(first, "what rank 0 has of the scene");
    if (first.size() != own.size() || first[0] != own[0])
      throw Error(
          s.where,
          text("this is Sinew ", versionText(), ", and rank 0 runs another version; start the same on all"));
    if (first[1] != own[1])
      throw Error(
          s.where,
          text("there are ", own[1], " points, and on rank 0 ", first[1], "; give all ranks the same files"));
    if (first != own)
      throw Error(s.where, "points or elements are not those of rank 0; give all ranks the same files");
  }
  static std::string_view versionText() { return SINEW_VERSION; }

  template <class C, class S>
  void follow(C& c, S const& scope) {
    if constexpr (HasRole<C, role::State>) {
      for (std::size_t k = 0; k < states_.size(); ++k) {
        if (states_[k].address != static_cast<void const*>(&c)) continue;
        Part const& part = states_[k].part;
        c.follow(part.points);
        c.ghosts = part.ghostOwner.size();
        c.halo = int(k);
      }
    } else if constexpr (HasRole<C, role::Topology>) {
      if constexpr (editable_topology<C>) {
        TopologyChange const& change = ofTopology(&c);
        const ElementLists lists = c.edit();
        if (lists.positions) change.points.filter(*lists.positions);
        lists.forEach([&](int kind, auto& list) {
          change.elements[std::size_t(kind)].filter(list);
          for (auto& element : list)
            for (Index& i : element) change.points.renumber(i);
        });
      }
    } else if constexpr (HasRole<C, role::Mapping> && !HasParents<C>) {
      constexpr bool keeps = requires(Renumbering const& points) { c.shareOut(points, points); };
      scope.withMapped(c, [&](auto&, auto& child, auto& parent) {
        State const *const of = find(&child), *const above = find(&parent);
        if (!of || !above || !of->parent) return;
        if constexpr (keeps)
          c.shareOut(of->part.points, above->part.points);
        else
          follow_fields(c, {of->part.points, {}, above->part.points, ofTopology(scope.topologyAddress())});
      });
    } else if constexpr (ActsOnState<C> && !JoinsTwo<C>) {
      if constexpr (requires { c.shareOut(); }) c.shareOut();
      if (State const* const state = find(scope.stateAddress()))
        follow_fields(c, {state->part.points, state->part.points, {}, ofTopology(scope.topologyAddress())});
    }
  }
};

}  // namespace sinew::mpi
