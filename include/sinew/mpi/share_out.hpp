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
                                     "MeshMatrixMass",
                                     "EulerImplicitSolver",
                                     "EulerExplicitSolver",
                                     "NewmarkImplicitSolver",
                                     "BDFOdeSolver",
                                     "VariationalSymplecticSolver",
                                     "StaticSolver",
                                     "RungeKutta2Solver",
                                     "RungeKutta4Solver",
                                     "CentralDifferenceSolver",
                                     "PetscLinearSolver",
                                     "TetrahedronFEMForceField",
                                     "HexahedronFEMForceField",
                                     "TetrahedronHyperelasticityFEMForceField",
                                     "TetrahedronViscoelasticityFEMForceField",
                                     "PrismFEMForceField",
                                     "PyramidFEMForceField",
                                     "QuadraticTetrahedronFEMForceField",
                                     "TriangleFEMForceField",
                                     "TriangularTensorMassForceField",
                                     "TriangularQuadraticSpringsForceField",
                                     "TriangularBiquadraticSpringsForceField",
                                     "QuadBendingFEMForceField",
                                     "TriangularShellForceField",
                                     "BeamFEMForceField",
                                     "MeshSpringForceField",
                                     "StiffSpringForceField",
                                     "JointSpringForceField",
                                     "PlaneForceField",
                                     "SphereForceField",
                                     "EllipsoidForceField",
                                     "ConicalForceField",
                                     "TrianglePressureForceField",
                                     "QuadPressureForceField",
                                     "ConstantForceField",
                                     "LinearForceField",
                                     "TorsionForceField",
                                     "DiagonalVelocityDampingForceField",
                                     "PolynomialRestShapeSpringsForceField",
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
                                     "RigidMapping",
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

namespace detail {
template <class C>
inline constexpr bool of_multipliers =
    HasRole<C, role::LagrangianConstraint> || HasRole<C, role::ConstraintSolver> ||
    HasRole<C, role::ConstraintCorrection> || HasRole<C, role::AnimationLoop>;
}  // namespace detail

template <class C>
constexpr bool is_distributed() {
  if constexpr (requires { C::distributed; })
    return C::distributed;
  else if constexpr (JoinsTwo<C> && !HasRole<C, role::InteractionForceField>)
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
             if constexpr (!is_distributed<C>())
               all.push_back(text(scope.path(),
                                  ": ",
                                  component_name<C>(),
                                  detail::of_multipliers<C> ? ", whose multipliers one process has; take "
                                                              "springs, or contacts that answer by forces "
                                                              "(PenalityContactForceField)"
                                                            : ""));
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
/// is on each rank as a whole. A rigid body is a point whose carried points come back to it. Where something
/// joins points of two states, a rank that owns one of its ends has what it needs of the other. Each rank has
/// one point of each state at least, so that no list of a component loses its last entry. Visual models are
/// empty: they are looked at in the whole scene.
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
      if (!s.parent) divide(s);
    listNeeded();
    for (State& s : states_)
      if (!s.parent && s.moves)
        s.part = part_of(s.where,
                         std::move(s.part.parts),
                         s.views,
                         ranks().rank(),
                         ranks().size(),
                         s.together,
                         s.needed,
                         s.rigid);
    shareMapped();
    traverse(root_, on<AnyRole>([&](auto& c, auto const& scope) { follow(c, scope); }));
    emptyVisuals();
    for (State& s : states_)
      to_.add(Halo(std::move(s.part), ranks().rank(), s.bytes), (s.parent && s.moves) || !joints_.empty());
  }

 private:
  using Points = std::vector<Index>;
  struct State {
    void const* address;
    std::string where;
    std::size_t points, bytes;  // of positions and velocities, of one
    bool rigid;
    std::vector<TopologyView> views{};
    std::vector<void const*> topologies{};
    std::vector<Points> joined{};       // points that have more than an element in common
    State* parent = nullptr;            // of one that is mapped
    bool samePoints = false;            // of the parent
    std::vector<Points> carriers{};     // of each point, those of the parent
    std::vector<Points> roots{};        // and those of the state above that is not mapped
    bool moves = false, whole = false;  // by a solver; on each rank
    std::size_t spare = 0;              // point of one that is mapped that a rank without others has
    JoinedPoints together{};            // of one that is not mapped, all that joins its points
    std::vector<NeededPoint> needed{};  // and those that ranks have beside these
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
  // points of two states that something joins
  struct Joint {
    State *first, *second;
    Points ofFirst, ofSecond;
  };
  RootScope const& root_;
  Distribution& to_;
  std::deque<State> states_{};  // in their order in the scene
  std::vector<Joint> joints_{};
  std::vector<std::size_t> load_{};  // of each rank: its points, and those that rigid bodies carry

  Communicator& ranks() const { return to_.ranks(); }

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
                                       .bytes = sizeof s.position[0] + sizeof s.velocity[0],
                                       .rigid = std::decay_t<decltype(s)>::DataTypes::rigid});
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
               if (State* const of = find(scope.stateAddress()))
                 forEachJoint(c, [&](Points ends, Points const& others) {
                   ends.insert(ends.end(), others.begin(), others.end());
                   if (ends.size() > 1) of->joined.push_back(std::move(ends));
                 });
             }));
    traverse(root_, on<role::InteractionForceField>([&](auto& c, auto const& scope) {
               scope.withEnds(c, [&](auto const& a, auto const& b) {
                 State *const first = find(a.stateAddress()), *const second = find(b.stateAddress());
                 forEachJoint(c, [&](Points ends, Points others) {
                   joints_.push_back({first, second, std::move(ends), std::move(others)});
                 });
               });
             }));
    traverse(root_, on<role::CollisionModel>([&](auto& c, auto const& scope) {
               State* const of = find(scope.stateAddress());
               if (!of) return;
               if (of->moves && !of->parent)
                 throw Error(
                     text(scope.path(), ": ", component_name<std::decay_t<decltype(c)>>()),
                     "each rank has all points that collide, and of a body its part; put the model into "
                     "a child node with a state of its own that follows the body, such as a surface "
                     "with a SubsetMapping or BarycentricMapping, or points that rigid bodies carry by a "
                     "RigidMapping");
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
  static void once(std::vector<int>& points) {
    std::sort(points.begin(), points.end());
    points.erase(std::unique(points.begin(), points.end()), points.end());
  }
  // f(points, points of the second end) of springs and the like, which have their ends in lists
  template <class C, class F>
  static void forEachJoint(C& c, F&& f) {
    using sinew::detail::ListsThatFollow;
    std::vector<int> const* lists[2]{};
    for_each_field(c, [&]<class List>(auto const& fd, List& list) {
      if constexpr (sinew::detail::is_struct_list<List>) {
        for (auto& item : list) {
          Points ends[2];
          sinew::detail::for_each_number(item, [&](Of what, int& i) {
            if (ListsThatFollow::isEntry(what)) ends[what == Of::secondPoints].push_back(Index(i));
          });
          f(std::move(ends[0]), std::move(ends[1]));
        }
      } else if constexpr (std::is_same_v<List, std::vector<int>>) {
        if (fd.numbers && ListsThatFollow::isEntry(fd.entries)) lists[fd.entries == Of::secondPoints] = &list;
      }
    });
    if (lists[0] && lists[1])
      for (std::size_t i = 0; i < std::min(lists[0]->size(), lists[1]->size()); ++i)
        f(Points{Index((*lists[0])[i])}, Points{Index((*lists[1])[i])});
  }

  // which rank has which point of a state that no other moves
  void divide(State& s) {
    compare(s);
    if (!s.moves) return keepWhole(s);
    s.together = s.joined;
    std::vector<std::size_t> weights(s.points, 1);
    for (State& child : states_) {
      if (!child.parent || &child.top() != &s) continue;
      for (Points const& roots : child.roots) {
        for (const Index r : roots) {
          ++weights[std::size_t(r)];
          if (child.whole) s.needed.push_back({r});
        }
        if (roots.size() > 1) s.together.push_back(roots);
      }
      child.forEachJoined([&](std::span<Index const> points) {
        Points all;
        for (const Index i : points)
          all.insert(all.end(), child.roots[std::size_t(i)].begin(), child.roots[std::size_t(i)].end());
        once(all);
        if (all.size() > 1) s.together.push_back(std::move(all));
      });
    }
    std::vector<int>& parts = s.part.parts;
    if (ranks().rank() == 0) {
      if (s.rigid && s.points < std::size_t(4 * ranks().size()))
        parts = partsOfFew(weights);
      else
        parts = parts_of_points(s.where, s.points, s.views, ranks().size(), s.together, s.rigid);
    }
    ranks().broadcast(parts, "the parts of the scene, from rank 0");
    load_.resize(std::size_t(ranks().size()), 0);
    for (std::size_t i = 0; i < s.points; ++i) load_[std::size_t(parts[i])] += weights[i];
  }
  // rigid bodies each to the rank that has least
  std::vector<int> partsOfFew(std::vector<std::size_t> const& weights) const {
    std::vector<std::size_t> load = load_;
    load.resize(std::size_t(ranks().size()), 0);
    std::vector<int> parts;
    for (const std::size_t weight : weights) {
      const auto least = std::min_element(load.begin(), load.end());
      *least += weight;
      parts.push_back(int(least - load.begin()));
    }
    return parts;
  }

  // those of the state above that is not mapped; none of what no solver moves, which all ranks have
  Points rootsOf(State& s, Index point) {
    if (s.parent) return s.roots[std::size_t(point)];
    return s.moves ? Points{point} : Points{};
  }
  // f(rank, point of the state above) for those that own what carries a joint, and all that does
  template <class F>
  void forEachNeed(Joint const& joint, F&& f) {
    std::vector<int> owners;
    auto each = [&](auto&& g) {
      for (const Index i : joint.ofFirst)
        for (const Index r : rootsOf(*joint.first, i)) g(joint.first->top(), r);
      for (const Index i : joint.ofSecond)
        for (const Index r : rootsOf(*joint.second, i)) g(joint.second->top(), r);
    };
    each([&](State& top, Index r) { owners.push_back(top.part.parts[std::size_t(r)]); });
    once(owners);
    each([&](State& top, Index r) {
      for (const int owner : owners) f(owner, top, r);
    });
  }
  // the points of states that are not mapped that ranks need beside those of their elements
  void listNeeded() {
    for (Joint const& joint : joints_)
      forEachNeed(joint, [](int owner, State& top, Index r) { top.needed.push_back({r, owner}); });
    for (State& s : states_) {
      if (!s.top().moves || s.whole) continue;
      if (!s.parent && !s.rigid) continue;  // (of which each rank has elements)
      std::vector<bool> has(std::size_t(ranks().size()), false);
      std::size_t first = s.points;  // that something carries
      for (std::size_t i = s.points; i-- > 0;)
        for (const Index r : rootsOf(s, Index(i))) {
          has[std::size_t(s.top().part.parts[std::size_t(r)])] = true;
          first = i;
        }
      if (first == s.points) continue;
      for (std::size_t rank = 0; rank < has.size(); ++rank)
        if (!has[rank])
          for (const Index r : rootsOf(s, Index(first))) s.top().needed.push_back({r, int(rank)});
      s.spare = first;
    }
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
      for (Joint const& joint : joints_)
        if (joint.first == &*s || joint.second == &*s) keepEnds(joint, *s);
      if (!mine.empty() && std::find(mine.begin(), mine.end(), true) == mine.end()) mine[s->spare] = true;
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

  // the ends of a joint that comes back to this rank
  void keepEnds(Joint const& joint, State& s) {
    bool here = false;
    forEachNeed(joint, [&](int owner, State&, Index) { here = here || owner == ranks().rank(); });
    if (!here) return;
    if (joint.first == &s)
      for (const Index i : joint.ofFirst) s.kept[std::size_t(i)] = true;
    if (joint.second == &s)
      for (const Index i : joint.ofSecond) s.kept[std::size_t(i)] = true;
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

  // A point is as heavy as in the whole scene, also where its elements are on other ranks alone.
  template <class C>
  static void keepMasses(C& c) {
    if constexpr (requires { c.vertexMass = c.lumped.mass, c.massDensity.reset(), c.totalMass.reset(); })
      if (c.lumped.massless.empty()) {
        c.vertexMass = c.lumped.mass;
        c.massDensity.reset(), c.totalMass.reset();
      }
  }
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
    } else if constexpr (HasRole<C, role::InteractionForceField>) {
      scope.withEnds(c, [&](auto const& a, auto const& b) {
        follow_fields(c,
                      {find(a.stateAddress())->part.points, find(b.stateAddress())->part.points, {}, none()});
      });
    } else if constexpr (ActsOnState<C> && !JoinsTwo<C>) {
      if constexpr (requires { c.shareOut(); }) c.shareOut();
      keepMasses(c);
      if (State const* const state = find(scope.stateAddress()))
        follow_fields(c, {state->part.points, state->part.points, {}, ofTopology(scope.topologyAddress())});
    }
  }
};

}  // namespace sinew::mpi
