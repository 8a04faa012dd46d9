// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/collision/collision_surface.hpp>
#include <sinew/core/assembly.hpp>
#include <sinew/core/vec_id.hpp>
#include <sinew/scene/collision_models.hpp>

#include <type_traits>

namespace sinew {

/// The contacts of one ODE solver, whose scope is `root`, as forces on the states below it.
template <class Root>
struct SolverContacts {
  Root const& root;

  /// f(contact manager, number of this solver), if there are collision models below it.
  template <class F>
  void with(F&& f) const {
    root.withContacts([&](auto& manager) {
      [[maybe_unused]] const auto span = root.span(Phase::contacts);
      int solver = -1;
      traverse(root,
               on<role::CollisionModel>([&](auto& model, auto const&) { solver = model.surface.solver; }));
      if (solver >= 0 && manager.acts()) f(manager, solver);
    });
  }

  /// f += forces at (x, v)
  void addForces(DerivId f, CoordId x, DerivId v) const {
    with([&](auto& manager, int solver) {
      for_each_collision_model(root, [&]<class D>(auto& model, auto& s, auto const&, std::type_identity<D>) {
        update_touched_vertices<D>(model.surface, s[x], s[v]);
      });
      manager.addForces([=](auto const& contact) { return contact.solver == solver; });
      scatter(f);
    });
  }
  /// r += (b B + k K) dx
  void addDForces(DerivId r, DerivId dx, MechanicalParams const& p) const {
    with([&](auto& manager, int solver) {
      for_each_collision_model(root, [&]<class D>(auto& model, auto& s, auto const&, std::type_identity<D>) {
        update_touched_vertices<D>(model.surface, s[dx]);
      });
      manager.addDForces(p.k, p.b, [=](auto const& contact) { return contact.solver == solver; });
      scatter(r);
    });
  }
  /// matrix += b B + k K, or its pattern
  template <AssemblyPhase Phase, class Matrix>
  void assemble(Matrix& matrix, MechanicalParams const& p) const {
    if constexpr (Phase != AssemblyPhase::bind)
      with([&](auto& manager, int solver) {
        manager.assembly.entries.clear();
        for_each_collision_model(
            root, [&]<class D>(auto& model, auto&, auto const& at, std::type_identity<D>) {
              if (model.simulated)
                at.template withDofs<D>(
                    [&](auto const& dofs) { manager.assembly.template addVertices<D>(model.surface, dofs); });
            });
        manager.template assemble<Phase>(
            matrix, p.k, p.b, [=](auto const& contact) { return contact.solver == solver; });
      });
  }

 private:
  void scatter(DerivId f) const {
    for_each_collision_model(root, [&]<class D>(auto& model, auto& s, auto const&, std::type_identity<D>) {
      if (model.simulated) add_forces<D>(s[f], model.surface);
    });
  }
};

}  // namespace sinew
