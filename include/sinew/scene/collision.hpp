// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/collision/collision_surface.hpp>
#include <sinew/collision/contact.hpp>
#include <sinew/core/error.hpp>
#include <sinew/core/registry.hpp>
#include <sinew/scene/collision_models.hpp>
#include <sinew/scene/solvers.hpp>

#include <utility>
#include <vector>

namespace sinew {

namespace detail {

template <class C>
constexpr Shapes shapes_of() {
  if constexpr (HasRole<C, role::CollisionModel>)
    return Shapes::of(skeleton(C::shape));
  else
    return {};
}
/// The shapes of the primitives below a scope, without radii. A runtime tree may have all that its registry
/// has.
template <class S>
constexpr Shapes shapes_below();
template <class S, class Name, class... Cs, class... Ns>
constexpr Shapes shapes_below(std::type_identity<Node<Name, hana::tuple<Cs...>, hana::tuple<Ns...>>>) {
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
    return shapes_below<S>(std::type_identity<typename S::NodeType>{});
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
    traverse(root, on<role::CollisionPipeline>([&](auto& pipeline, auto const& scope) {
               collect(pipeline, scope);
               with_first<role::ContactManager>(scope, [&](auto& manager) {
                 manager.init(scope.path(), pipeline.surfaces, again);
                 checkMultipliers(manager, scope);
               });
               with_first<role::Intersection>(scope, [&](auto& intersection) {
                 if constexpr (LooksAround<std::decay_t<decltype(intersection)>>)
                   intersection.lookAround(pipeline.surfaces);
               });
               pipeline.near.reserve(pipeline.surfaces.size() * (pipeline.surfaces.size() + 1) / 2);
               for (auto* s : pipeline.surfaces) s->enclose(0, 0);  // the trees are built
               traverse(scope, on<role::CollisionModel>([](auto& model, auto const& s) {
                          if constexpr (requires { s.warn(&model, std::string_view()); })
                            if (const std::string wrong = model.surface.wrongWinding(s.gravity());
                                !wrong.empty())
                              s.warn(&model, wrong);
                        }));
             }));
  }

  /// The contacts of a step of dt that begins, and what they change at once. `newPattern(scope)` is called
  /// for the nodes with a solver in whose matrix other vertices meet now.
  template <class F>
  void detect(double dt, F&& newPattern) const {
    traverse(
        root, on<role::CollisionPipeline>([&](auto& pipeline, auto const& scope) {
          {
            [[maybe_unused]] const auto span = root.span(Phase::positions);
            collect(pipeline, scope);
            with_first<role::ContactManager>(scope,
                                             [&](auto& manager) { manager.settle(pipeline.surfaces); });
          }
          with_first<role::Intersection>(scope, [&](auto const& intersection) {
            [[maybe_unused]] const auto span = root.span(Phase::boundingTrees);
            for (auto* s : pipeline.surfaces)
              s->enclose(intersection.reach() / 2, intersection.continuous ? dt : 0);
          });
          with_first<role::BroadPhase>(scope, [&](auto& broad) {
            [[maybe_unused]] const auto span = root.span(Phase::broadPhase);
            pipeline.findNear(broad);
          });
          with_first<role::ContactManager>(scope, [&](auto& manager) {
            with_first<role::NarrowPhase>(scope, [&](auto& narrow) {
              [[maybe_unused]] const auto span = root.span(Phase::narrowPhase);
              with_first<role::Intersection>(scope, [&](auto const& intersection) {
                using S = std::decay_t<decltype(scope)>;
                pipeline.findContacts(
                    detail::list_of_shapes<detail::shapes_below<S>()>(), narrow, intersection, manager, dt);
              });
            });
            [[maybe_unused]] const auto span = root.span(Phase::response);
            manager.manage(dt);
            touch(manager);
            if (manager.couplingChanged) forEachSolver(root, newPattern);
          });
        }));
  }

 private:
  template <class Manager, class S>
  void checkMultipliers(Manager const& manager, S const& scope) const {
    if (manager.asksForMultipliers() && !with_first<role::AnimationLoop>(root, [](auto const&) {}))
      throw Error(
          text(scope.path(), ": ", component_name<Manager>()),
          "a response to contacts is by multipliers, for which nothing solves: put a FreeMotionAnimationLoop "
          "and a constraint solver, such as BlockGaussSeidelConstraintSolver, into the root, or take a "
          "response by forces, such as PenalityContactForceField");
  }
  // where the models are now
  template <class Pipeline, class S>
  static void collect(Pipeline& pipeline, S const& scope) {
    pipeline.surfaces.clear();
    for_each_collision_model(scope,
                             [&]<class D>(auto& model, auto const& s, auto const& at, std::type_identity<D>) {
                               update_vertices<D>(model.surface, s.position, s.velocity);
                               model.surface.state = &s;
                               if (model.surface.solver >= 0) model.surface.gravity = at.gravity();
                               model.surface.number = int(pipeline.surfaces.size());
                               pipeline.surfaces.push_back(&model.surface);
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
