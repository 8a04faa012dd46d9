// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/collision/collision_surface.hpp>
#include <sinew/core/element_force.hpp>
#include <sinew/scene/collision.hpp>
#include <sinew/scene/collision_models.hpp>
#include <sinew/scene/scope.hpp>
#include <sinew/scene/states_of.hpp>
#include <sinew/state/vector_operations.hpp>

#include <algorithm>
#include <type_traits>

namespace sinew {

/// Interactions, contacts among them, above the solvers of their ends. For each of these such an interaction
/// is a force that stays as it is at the start of the step (as in SOFA): explicit, and stable only at steps
/// small enough for it.
template <class RootScope>
struct LooseInteractions {
  RootScope const& root;

  /// Room for external forces in the states that may have some.
  void init() const {
    traverse(root, on<role::State>([](auto& s, auto const&) { s.externalForce.clear(); }));
    forEach(root, [](auto&, auto& a, auto& b) {
      using VecDeriv = std::decay_t<decltype(a.velocity)>;
      for (auto* end : {&a, &b}) end->externalForce = VecDeriv(end->size(), VecDeriv::value_type::Zero());
    });
    initContacts();
  }

  /// The external forces of the step that begins.
  void compute(MechanicalParams const& p) const {
    [[maybe_unused]] const auto span = root.span(Phase::externalForces);
    traverse(root, on<role::State>([](auto& s, auto const&) {
               VectorOperations<typename std::decay_t<decltype(s)>::DataTypes>::clear(OneThread{},
                                                                                      s.externalForce);
             }));
    forEach(root, [&](auto& c, auto& a, auto& b) {
      add_force(c, p, a.externalForce, b.externalForce, a.position, b.position, a.velocity, b.velocity);
    });
    if constexpr (collides<RootScope>) addContacts();
  }

 private:
  // f(interaction, a, b) with the states of the ends of each interaction that no solver sees
  template <class S, class F>
  static void forEach(S const& scope, F&& f) {
    if constexpr (!S::template always<role::OdeSolver>) {
      if (scope.template has<role::OdeSolver>()) return;
      auto visit = on<role::InteractionForceField>(
          [&](auto& c) { with_states_of(c, scope, [&](auto& a, auto& b) { f(c, a, b); }); });
      scope.forEachComponent(visit);
      scope.template forEachChild<role::InteractionForceField>([&](auto const& child) { forEach(child, f); });
    }
  }

  // contacts may come to be between the bodies of any two solvers
  void initContacts() const {
    int solvers = 0;
    traverse(root, on<role::CollisionModel>([&](auto& model, auto const&) {
               solvers = std::max(solvers, model.surface.solver + 1);
             }));
    if (solvers > 1)
      for_each_collision_model(root, []<class D>(auto& model, auto& s, auto const&, std::type_identity<D>) {
        if (model.surface.solver >= 0) s.externalForce.assign(s.size(), D::Deriv::Zero());
      });
  }
  void addContacts() const {
    auto withModels = [&](auto&& f) {
      for_each_collision_model(root, [&](auto& model, auto& s, auto const&, auto dataTypes) {
        if (!s.externalForce.empty()) f(model, s, dataTypes);
      });
    };
    traverse(root, on<role::ContactManager>([&](auto& manager, auto const&) {
               if (!manager.acts()) return;
               withModels([]<class D>(auto& model, auto& state, std::type_identity<D>) {
                 update_touched_vertices<D>(model.surface, state.position, state.velocity);
               });
               auto loose = [](auto const& contact) { return contact.loose; };
               manager.addForces(loose);
               manager.forEachChosen(loose, [](auto& contact) { contact.force = contact.evaluated; });
               withModels([]<class D>(auto& model, auto& state, std::type_identity<D>) {
                 if (model.simulated) add_forces<D>(state.externalForce, model.surface);
               });
             }));
  }
};

}  // namespace sinew
