// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/collision/collision_surface.hpp>
#include <sinew/collision/contact.hpp>
#include <sinew/core/error.hpp>
#include <sinew/core/registry.hpp>
#include <sinew/scene/collision_models.hpp>
#include <sinew/scene/solvers.hpp>
#include <sinew/scene/state_contacts.hpp>

#include <algorithm>
#include <map>
#include <string_view>
#include <utility>
#include <vector>

namespace sinew {

namespace detail {

template <class C>
constexpr Shapes shapes_of() {
  if constexpr (HasRole<C, role::CollisionModel>)  // (capsules have ends)
    return Shapes::of(skeleton(C::shape)) |
           (C::shape == Shape::capsule ? Shapes::of(Shape::point) : Shapes{});
  else
    return {};
}
/// The shapes of the primitives below a scope, without radii. A runtime tree may have all that its registry
/// has.
template <class S>
constexpr Shapes shapes_below();
template <class S, class... Cs, class... Ns>
constexpr Shapes shapes_below(NodeParts<hana::tuple<Cs...>, hana::tuple<Ns...>> const*) {
  return (Shapes{} | ... | shapes_of<Cs>()) |
         (Shapes{} | ... | shapes_below<typename ScopeOf<Ns, S>::type>());
}
template <class S>
constexpr Shapes shapes_below() {
  if constexpr (requires { S::provedAtInit; }) {
    Shapes shapes;
    for_each_registered<typename S::Classes>([&]<class C>() constexpr { shapes = shapes | shapes_of<C>(); });
    return shapes;
  } else {
    return shapes_below<S>(static_cast<typename S::NodeType const*>(nullptr));
  }
}

}  // namespace detail

/// Collision detection in a scene: what its DefaultPipeline asks of the tree.
template <class RootScope>
struct Collision {
  RootScope const& root;

  /// After all components are initialised; where that is not the first time, contacts go on that have
  /// followed the change. Throws Error where a stage is missing.
  void init(bool again) const {
    std::vector<CollisionSurface*> all;
    traverse(root, on<role::CollisionModel>([&](auto& model, auto const& scope) {
               model.surface.state = scope.stateAddress();
               model.surface.solver = -1;
               model.surface.companions = {};
               model.surface.beside.clear();
               if constexpr (requires { scope.node.entryOf(&model).name; })
                 model.surface.name = scope.node.entryOf(&model).name;
               all.push_back(&model.surface);
             }));
    int solvers = 0;
    numberSolvers(root, solvers);
    for (auto* s : all)
      for (auto const* other : all)
        if (s->isAccompaniedBy(*other)) {
          s->companions = s->companions | Shapes::of(other->shape);
          if (s->shape == Shape::line && other->shape == Shape::triangle) s->findTriangles(*other);
        }
    findListing();
    traverse(root, on<role::CollisionPipeline>([&](auto& pipeline, auto const& scope) {
               collect(pipeline, scope);
               if constexpr (ListsModels<std::decay_t<decltype(pipeline)>>) pipeline.choose(scope.path());
               with_first<role::ContactManager>(scope, [&](auto& manager) {
                 manager.init(scope.path(), pipeline.surfaces, again);
                 checkMultipliers(manager, scope);
               });
               if constexpr (requires { pipeline.afterFreeMotion; })
                 pipeline.afterFreeMotion = looksAtFreeMotion(scope);
               auto lookAround = [&](auto& stage) {
                 if constexpr (LooksAround<std::decay_t<decltype(stage)>>)
                   stage.lookAround(pipeline.surfaces);
               };
               with_first<role::Intersection>(scope, lookAround);
               with_first<role::NarrowPhase>(scope, lookAround);
               pipeline.near.reserve(pipeline.surfaces.size() * (pipeline.surfaces.size() + 1) / 2);
               for (auto* s : pipeline.surfaces) s->enclose(0, 0);  // the trees are built
               traverse(modelsOf(pipeline, scope), on<role::CollisionModel>([](auto& model, auto const& s) {
                          if constexpr (requires { s.warn(&model, std::string_view()); })
                            if (const std::string wrong = model.surface.wrongWinding(s.gravity());
                                !wrong.empty())
                              s.warn(&model, wrong);
                        }));
             }));
    warnOfUnlisted(all);
  }

  /// Finds what moves as one, after all is initialised without an Error.
  void findCarriers() const {
    const auto carriers = carriersOfPoints();
    traverse(root, on<role::CollisionModel>([&](auto& model, auto const&) {
               model.surface.setCarriers(carriers.at(model.surface.state));
             }));
  }

  /// The contacts of a step of dt that begins, and what they change at once. `newPattern(scope)` is called
  /// for the nodes with a solver in whose matrix other vertices meet now. `byStates`: states that can find
  /// contacts begin to, until finish(); where they cannot in this scene, byHost(path, why) is told.
  template <class F, class G>
  void detect(double dt, bool byStates, F&& newPattern, G&& byHost) const {
    traverse(root, on<role::CollisionPipeline>([&](auto& pipeline, auto const& scope) {
               if (!begin(pipeline, scope, byStates, byHost)) clearTouched(modelsOf(pipeline, scope));
             }));
    traverse(root, on<role::CollisionPipeline>([&](auto& pipeline, auto const& scope) {
               if constexpr (requires { pipeline.begun; })
                 if (pipeline.begun) return;
               lookAtModels(pipeline, scope);
               if (!comesAfterFreeMotion(pipeline)) return find(pipeline, scope, dt, newPattern);
               with_first<role::ContactManager>(scope, [&](auto& manager) {
                 manager.await();
                 if (manager.couplingChanged) forEachSolver(root, newPattern);
               });
             }));
  }
  /// Whether contacts of a pipeline are found by finish(), behind the free motion of a step.
  template <class Pipeline>
  static bool isToCome(Pipeline const& pipeline) {
    bool toCome = comesAfterFreeMotion(pipeline);
    if constexpr (requires { pipeline.begun; }) toCome = toCome || pipeline.begun;
    return toCome;
  }
  /// The contacts for which states have begun to look, and those on the way of the free motion: states are at
  /// the start of the step, and freePosition behind it. f(pipeline, manager, whether rows are those of the
  /// step before but for violations) where there are some to come.
  template <class F>
  void finish(double dt, F&& f) const {
    traverse(root, on<role::CollisionPipeline>([&](auto& pipeline, auto const& scope) {
               using S = std::decay_t<decltype(scope)>;
               if (comesAfterFreeMotion(pipeline)) {
                 takeFreeMotion(modelsOf(pipeline, scope), dt);
                 // multipliers join no vertices in the matrix of a solver
                 find(pipeline, scope, dt, [](auto const&, bool) {});
                 with_first<role::ContactManager>(scope, [&](auto& manager) { f(pipeline, manager, false); });
                 return;
               }
               if constexpr (StateContacts<S>::possible && !ListsModels<std::decay_t<decltype(pipeline)>>) {
                 using Found = typename StateContacts<S>::Found;
                 auto found = Found::others;
                 if (!std::exchange(pipeline.begun, false)) return;
                 with_first<role::ContactManager>(scope, [&](auto& manager) {
                   withIntersection(scope, [&](auto const& method) {
                     [[maybe_unused]] const auto span = root.span(Phase::narrowPhase);
                     found = StateContacts<S>{scope}.finish(manager, method);
                   });
                   [[maybe_unused]] const auto span = root.span(Phase::response);
                   if (found == Found::others) {
                     clearTouched(modelsOf(pipeline, scope));
                     manager.manage(dt);
                   } else {
                     manager.goOn(dt);
                   }
                   f(pipeline, manager, found == Found::sameRows);
                 });
               }
             }));
  }

 private:
  // the scope whose models a pipeline collides
  template <class Pipeline, class S>
  decltype(auto) modelsOf(Pipeline const&, [[maybe_unused]] S const& scope) const {
    if constexpr (ListsModels<Pipeline>)
      return (root);
    else
      return (scope);
  }
  // pipelines that list their models, which other nodes have to find; a model has one number for all of them
  void findListing() const {
    if constexpr (requires { root.findListing(); }) root.findListing();
    bool listing = false;
    traverse(root, on<role::CollisionPipeline>([&](auto const& pipeline, auto const& scope) {
               using Pipeline = std::decay_t<decltype(pipeline)>;
               if (!ListsModels<Pipeline>) return;
               listing = true;
               const std::string path = scope.path();
               if (std::count(path.begin() + 1, path.end(), '/') > 1)
                 throw Error(text(path, ": ", component_name<Pipeline>()),
                             "it stands too deep in the scene; put it and its stages into a node right below "
                             "the root");
             }));
    if (listing)
      traverse(root, on<role::CollisionPipeline>([&](auto const& pipeline, auto const& scope) {
                 using Pipeline = std::decay_t<decltype(pipeline)>;
                 if (!ListsModels<Pipeline> && scope.path() != root.path())
                   throw Error(text(scope.path(), ": ", component_name<Pipeline>()),
                               "another pipeline of the scene lists its models; put this one and its stages "
                               "into the root, or make it one that does");
               }));
  }
  // models that collide with nothing, since no pipeline has them
  void warnOfUnlisted([[maybe_unused]] std::vector<CollisionSurface*> all) const {
    bool everything = false, listing = false;
    traverse(root, on<role::CollisionPipeline>([&](auto const& pipeline, auto const&) {
               if constexpr (ListsModels<std::decay_t<decltype(pipeline)>>) {
                 listing = true;
                 std::erase_if(all, [&](auto const* s) { return pipeline.takes(*s); });
               } else {
                 everything = true;
               }
             }));
    if (everything || !listing) return;
    traverse(root, on<role::CollisionModel>([&](auto& model, auto const& s) {
               if constexpr (requires { s.warn(&model, std::string_view()); })
                 if (std::find(all.begin(), all.end(), &model.surface) != all.end())
                   s.warn(&model, "it collides with nothing, since no SubCollisionPipeline lists it");
             }));
  }
  // (several pipelines may have one model)
  template <class S>
  static void clearTouched(S const& models) {
    traverse(models,
             on<role::CollisionModel>([](auto& model, auto const&) { model.surface.clearTouched(); }));
  }
  // f(intersection method) where it is one that a device has
  template <class S, class F>
  static void withIntersection(S const& scope, F&& f) {
    with_first<role::Intersection>(scope, [&](auto const& method) {
      if constexpr (detail::MeetsAnySurface<std::decay_t<decltype(method)>>) f(method);
    });
  }
  // whether states look for all contacts of this step
  template <class Pipeline, class S, class G>
  bool begin(Pipeline& pipeline, S const& scope, bool byStates, G&& byHost) const {
    if constexpr (!StateContacts<S>::possible || ListsModels<Pipeline>) {
      return false;
    } else {
      [[maybe_unused]] const auto span = root.span(Phase::narrowPhase);
      pipeline.begun = false;
      auto mark = [&](bool away) {
        bool any = false;
        traverse(scope, on<role::CollisionModel>([&](auto& model, auto const&) {
                   CollisionSurface& surface = model.surface;
                   surface.elsewhere = away && detail::is_found_by_states<std::decay_t<decltype(model)>>() &&
                                       surface.solver >= 0 && surface.settings.simulated;
                   any = any || surface.elsewhere;
                 }));
        return any;
      };
      list(pipeline, scope);
      if (!mark(byStates)) return false;
      const bool loop = with_first<role::AnimationLoop>(root, [](auto const&) {});
      std::string_view why = loop ? "" : "nothing solves for multipliers";
      with_first<role::ContactManager>(scope, [&](auto const& manager) {
        with_first<role::Intersection>(scope, [&](auto const& method) {
          if (why.empty()) why = StateContacts<S>{scope}.reason(pipeline.surfaces, pipeline, manager, method);
        });
      });
      if (any_below<role::Carving>(root)) why = "tools carve in this scene";
      if (any_below<role::Cutting>(root)) why = "blades cut in this scene";
      if (hasSeveralModels(scope)) why = "a state has several models of points or spheres";
      if (!why.empty()) {
        mark(false);
        byHost(scope.path(), why);
        return false;
      }
      for_each_collision_model(scope,
                               []<class D>(auto& model, auto const& s, auto const&, std::type_identity<D>) {
                                 if (!model.surface.elsewhere)
                                   update_vertices<D>(model.surface, s.position, s.velocity);
                               });
      pipeline.near.clear();
      pipeline.boxTests = 0;
      with_first<role::ContactManager>(scope, [&](auto& manager) {
        withIntersection(
            scope, [&](auto const& method) { StateContacts<S>{scope}.begin(pipeline, manager, method); });
      });
      return pipeline.begun = true;
    }
  }
  template <class S>
  static bool hasSeveralModels(S const& scope) {
    bool several = false;
    std::vector<void const*> states;
    for_each_collision_model(scope, [&](auto& model, auto const& s, auto const&, auto) {
      if (!model.surface.elsewhere) return;
      several = several || std::find(states.begin(), states.end(), &s) != states.end();
      states.push_back(&s);
    });
    return several;
  }
  template <class Pipeline>
  static bool comesAfterFreeMotion(Pipeline const& pipeline) {
    if constexpr (requires { pipeline.afterFreeMotion; })
      return pipeline.afterFreeMotion;
    else
      return false;
  }
  // Whether the intersection method of a pipeline does; throws Error where nothing moves freely, or what
  // contacts do is to be known before.
  template <class S>
  bool looksAtFreeMotion(S const& scope) const {
    bool looks = false;
    with_first<role::Intersection>(scope, [&](auto const& method) {
      looks = motion_seen_by(method) == StepMotion::freeMotion;
      if (!looks) return;
      auto refuse = [&](std::string_view why) {
        throw Error(text(scope.path(), ": ", component_name<std::decay_t<decltype(method)>>()),
                    text("contacts are looked for on the way of the free motion (freeMotion), but ",
                         why,
                         ", or say inertia, which looks where velocities lead"));
      };
      if (!with_first<role::AnimationLoop>(root, [](auto const&) {}))
        refuse(
            "nothing moves freely here: put a FreeMotionAnimationLoop and a constraint solver, such as "
            "BlockGaussSeidelConstraintSolver, into the root");
      with_first<role::ContactManager>(scope, [&](auto const& manager) {
        if (!manager.asksForMultipliersOnly())
          refuse(
              "a response to contacts is a force, with which bodies would have moved: take a response by "
              "multipliers, such as FrictionContactConstraint");
      });
      if (any_below<role::Carving>(root))
        refuse("tools carve by the contacts at the start of a step: leave these out");
    });
    return looks;
  }
  // where models are, and what responses remember of the step before
  template <class Pipeline, class S>
  void lookAtModels(Pipeline& pipeline, S const& scope) const {
    [[maybe_unused]] const auto span = root.span(Phase::positions);
    collect(pipeline, scope);
    with_first<role::ContactManager>(scope, [](auto& manager) { manager.settle(); });
  }
  // models below a scope whose velocities are those of the free motion
  template <class S>
  static void takeFreeMotion(S const& models, double dt) {
    for_each_collision_model(
        models, [dt]<class D>(auto& model, auto const& s, auto const&, std::type_identity<D>) {
          CollisionSurface& surface = model.surface;
          if (surface.solver < 0) return;  // it is where it will be, and has come there
          for (std::size_t i = 0; i < s.position.size(); ++i) {
            const typename D::Deriv moved = D::difference(s.position[i], s.freePosition[i]);
            update_vertices<D>(surface, i, s.position[i], moved / typename D::Real(dt));
          }
        });
  }
  template <class Pipeline, class S, class F>
  void find(Pipeline& pipeline, S const& scope, double dt, F&& newPattern) const {
    double ahead = dt;
    with_first<role::Intersection>(scope, [&](auto const& intersection) {
      [[maybe_unused]] const auto span = root.span(Phase::boundingTrees);
      if (motion_seen_by(intersection) == StepMotion::none) ahead = 0;
      for (auto* s : pipeline.surfaces) {
        if constexpr (ListsModels<Pipeline>)
          if (!pipeline.takes(*s)) continue;
        s->enclose(intersection.reach() / 2, ahead);
      }
    });
    with_first<role::BroadPhase>(scope, [&](auto& broad) {
      [[maybe_unused]] const auto span = root.span(Phase::broadPhase);
      pipeline.findNear(broad);
    });
    with_first<role::ContactManager>(scope, [&](auto& manager) {
      with_first<role::NarrowPhase>(scope, [&](auto& narrow) {
        [[maybe_unused]] const auto span = root.span(Phase::narrowPhase);
        with_first<role::Intersection>(scope, [&](auto const& intersection) {
          using Models = std::decay_t<decltype(modelsOf(pipeline, scope))>;
          pipeline.findContacts(
              detail::list_of_shapes<detail::shapes_below<Models>()>(), narrow, intersection, manager, ahead);
        });
      });
      [[maybe_unused]] const auto span = root.span(Phase::response);
      manager.manage(dt);
      touch(manager);
      if (manager.couplingChanged) forEachSolver(root, newPattern);
    });
  }

  // Of each state which point of a state without a mapping its points move as one with, these being counted
  // through the scene; negative where there is none.
  std::map<void const*, std::vector<int>> carriersOfPoints() const {
    constexpr int none = -1, several = -2;
    std::map<void const*, std::vector<int>> all;
    int next = 0;
    traverse(root, on<role::State>([&](auto& s, auto const& scope) {
               auto& mine = all[&s];
               mine.assign(s.position.size(), none);
               if (!scope.mapped())
                 for (int& carrier : mine) carrier = next++;
             }));
    traverse(root, on<role::Mapping>([&](auto& mapping, auto const& scope) {
               scope.withMapped(mapping, [&](auto& m, auto& child, auto& parent) {
                 if constexpr (HasRole<std::decay_t<decltype(child)>, role::State> &&
                               HasJacobianBlocks<std::decay_t<decltype(m)>>) {
                   auto& mine = all[&child];
                   auto const& above = all[&parent];
                   for (std::size_t i = 0; i < mine.size(); ++i)
                     m.forEachJacobianBlock(int(i), [&](int point, auto const& block) {
                       const int carrier = above[std::size_t(point)];
                       mine[i] = mine[i] == none && carrier >= 0 && carries(block) ? carrier : several;
                     });
                 }
               });
             }));
    return all;
  }
  // whether what has this Jacobian moves with its parent as if it were of one piece with it
  template <class Block>
  static bool carries([[maybe_unused]] Block const& block) {
    constexpr int rows = Block::RowsAtCompileTime, columns = Block::ColsAtCompileTime;
    if constexpr ((rows == 3 && columns >= 3) || (rows == 6 && columns == 6))
      return block.template topLeftCorner<3, 3>().isIdentity(0) &&
             (rows == 3 || block.template bottomRightCorner<3, 3>().isIdentity(0));
    else
      return false;
  }

  template <class Manager, class S>
  void checkMultipliers(Manager const& manager, S const& scope) const {
    if (manager.asksForMultipliers() && !with_first<role::AnimationLoop>(root, [](auto const&) {}))
      throw Error(
          text(scope.path(), ": ", component_name<Manager>()),
          "a response to contacts is by multipliers, for which nothing solves: put a FreeMotionAnimationLoop "
          "and a constraint solver, such as BlockGaussSeidelConstraintSolver, into the root, or take a "
          "response by forces, such as PenalityContactForceField");
  }
  // The models of this scene, of which a copy has its own, in the order by which contacts name them.
  template <class Pipeline, class S>
  void list(Pipeline& pipeline, S const& scope) const {
    pipeline.surfaces.clear();
    for_each_collision_model(modelsOf(pipeline, scope),
                             [&](auto& model, auto const& s, auto const& at, auto) {
                               model.surface.state = &s;
                               if (model.surface.solver >= 0) model.surface.gravity = at.gravity();
                               model.surface.number = int(pipeline.surfaces.size());
                               pipeline.surfaces.push_back(&model.surface);
                             });
    with_first<role::ContactManager>(scope, [&](auto& manager) { manager.takeModels(pipeline.surfaces); });
  }
  // the same, where they are now
  template <class Pipeline, class S>
  void collect(Pipeline& pipeline, S const& scope) const {
    list(pipeline, scope);
    for_each_collision_model(modelsOf(pipeline, scope),
                             []<class D>(auto& model, auto const& s, auto const&, std::type_identity<D>) {
                               update_vertices<D>(model.surface, s.position, s.velocity);
                             });
  }

  template <class S>
  static void numberSolvers(S const& scope, int& solvers) {
    forEachSolver(scope, [&](auto const& solved, bool implicit) {
      traverse(solved, on<role::CollisionModel>([&](auto& model, auto const&) {
                 model.surface.solver = solvers;
                 model.surface.implicit = implicit;
               }));
      ++solvers;
    });
  }
  // f(scope, implicit) for the nodes whose subtrees the solvers integrate
  template <class S, class F>
  static void forEachSolver(S const& scope, F&& f) {
    for_each_integrator(
        scope, [&](auto& ode, auto const& solved) { f(solved, std::decay_t<decltype(ode)>::implicit); });
  }

  template <class R, class C>
  static void touchOne(R const& response, C& component, std::span<int const> points) {
    if constexpr (TouchResponse<R, C>) response.touch(component, points);
  }
  // responses that change what stands on the touched states
  template <class Manager>
  void touch(Manager& manager) const {
    manager.forEachTouchResponse([&](auto const& response, void const* state, std::span<int const> points) {
      traverse(root, on<role::ForceField>([&](auto& c, auto const& scope) {
                 if (scope.stateAddress() == state) touchOne(response, c, points);
               }));
    });
  }
};

/// Whether there may be collision models below a scope.
template <class S>
inline constexpr bool collides = !detail::shapes_below<S>().empty();

}  // namespace sinew
