// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/core/assembly.hpp>
#include <sinew/core/roles/mapping.hpp>
#include <sinew/core/vec_id.hpp>
#include <sinew/scene/scope.hpp>
#include <sinew/state/vector_operations.hpp>

#include <type_traits>

namespace sinew {

namespace detail {
template <class M>
constexpr bool has_velocity_products() {
  if constexpr (HasParents<M>)
    return HasVelocityProducts<PartOf<M>>;
  else
    return HasVelocityProducts<M>;
}
}  // namespace detail

/// The mechanical states at and below a scope, `root`, that mappings move: motions go down to them, forces
/// back up.
template <class Root>
struct MappedStates {
  Root const& root;

  void propagate(CoordId x, DerivId v) const {
    [[maybe_unused]] const auto span = root.span(Phase::mapping);
    forEach([&](auto& mapping, auto& child, auto& parent) { mapping.apply(child[x], parent[x]); },
            [&](auto& mapping, auto& child, auto& parent) { mapping.applyJ(child[v], parent[v]); });
  }
  void propagate(DerivId v) const {
    [[maybe_unused]] const auto span = root.span(Phase::mapping);
    forEach([&](auto& mapping, auto& child, auto& parent) { mapping.applyJ(child[v], parent[v]); });
  }

  /// f of mapped states gets the inertial forces of masses in their nodes that are not those of M times the
  /// acceleration of their parents.
  void addInertialForces(DerivId f, CoordId x, DerivId v) const {
    traverse(root, on<role::Mapping>([&](auto& mapping, [[maybe_unused]] auto const& scope) {
               if constexpr (detail::has_velocity_products<std::decay_t<decltype(mapping)>>())
                 withMechanicalChild(mapping, scope, [&](auto& m, auto& child, auto& parent) {
                   if constexpr (HasVelocityProducts<std::decay_t<decltype(m)>>)
                     scope.withMass([&](auto& mass) {
                       if constexpr (std::is_same_v<typename std::decay_t<decltype(mass)>::DataTypes,
                                                    typename std::decay_t<decltype(child)>::DataTypes>)
                         mass.addMDx(child[f], child[x], m.velocityProducts(parent[v], child[v]), -1);
                     });
                 });
             }));
  }

  /// f of mapped states, then complete, is added to that of their parents; mappings keep it for their
  /// geometric stiffness.
  void accumulate(DerivId f) const {
    forEachBack([&](auto& mapping, auto& child, auto& parent) {
      mapping.applyJT(parent[f], child[f]);
      if constexpr (HasGeometricStiffness<std::decay_t<decltype(mapping)>>)
        mapping.updateK(withMultipliers(child, f));
    });
  }
  /// The same with the product r of a matrix of k K and dx, to which the geometric stiffness belongs.
  void accumulate(DerivId r, DerivId dx, double k) const {
    forEachBack(
        [&](auto& mapping, auto& child, auto& parent) {
          mapping.applyJT(parent[r], child[r]);
          if constexpr (GathersParents<std::decay_t<decltype(mapping)>>)
            if (k != 0) mapping.gather(parent[dx]);
        },
        [&](auto& mapping, auto&, auto& parent) {
          if constexpr (HasGeometricStiffness<std::decay_t<decltype(mapping)>>)
            if (k != 0) mapping.addKx(parent[r], parent[dx], k);
        });
  }
  /// matrix += the geometric stiffness, or its pattern
  template <AssemblyPhase Phase, class Matrix>
  void assemble(Matrix& matrix, MechanicalParams const& p) const {
    traverse(root, on<role::Mapping>([&](auto& mapping, auto const& scope) {
               using M = std::decay_t<decltype(mapping)>;
               if constexpr (HasParents<M>)
                 assembleOfParents<Phase>(matrix, p, mapping, scope);
               else if constexpr (HasGeometricStiffness<M>)
                 withMechanicalChild(mapping, scope, [&](auto& m, auto&, auto&) {
                   scope.parentScope().template withDofs<typename M::In>([&](auto const& dofs) {
                     with_sink<Phase>(matrix, dofs, dofs, [&](auto const& sink) { m.addToMatrix(p, sink); });
                   });
                 });
             }));
  }

 private:
  // f(mapping, child state, parent state), parents first, visual models left out; of several f each goes
  // through all parts of a mapping before the next one does
  template <class... F>
  void forEach(F const&... f) const {
    traverse(root, on<role::Mapping>([&](auto& mapping, auto const& scope) {
               withMechanicalChild(mapping, scope, f...);
             }));
  }
  // the same on the way back
  template <class... F>
  void forEachBack(F const&... f) const {
    [[maybe_unused]] const auto span = root.span(Phase::mappingBack);
    traverse_back(root, on<role::Mapping>([&](auto& mapping, auto const& scope) {
                    withMechanicalChild(mapping, scope, f...);
                  }));
  }
  template <class M, class S, class... F>
  static void withMechanicalChild(M& mapping, S const& scope, F const&... f) {
    auto one = [&](auto const&... g) {
      scope.withMapped(mapping, [&](auto& m, auto& child, auto& parent) {
        if constexpr (HasRole<std::decay_t<decltype(child)>, role::State>) (g(m, child, parent), ...);
      });
    };
    if constexpr (HasParents<M>)
      (one(f), ...);
    else
      one(f...);
  }
  // the blocks of the geometric stiffness of all pairs of parents
  template <AssemblyPhase Phase, class Matrix, class M, class S>
  static void assembleOfParents([[maybe_unused]] Matrix& matrix, [[maybe_unused]] MechanicalParams const& p,
                                [[maybe_unused]] M& mapping, [[maybe_unused]] S const& scope) {
    if constexpr (GathersParents<PartOf<M>>)
      scope.forEachParent(mapping, [&](auto a, auto const& rows) {
        scope.forEachParent(mapping, [&](auto b, auto const& columns) {
          rows.template withDofs<InOfParent<M, decltype(a)>>([&](auto const& first) {
            columns.template withDofs<InOfParent<M, decltype(b)>>([&](auto const& second) {
              with_sink<Phase>(
                  matrix, first, second, [&](auto const& sink) { mapping.addToMatrix(p, a, b, sink); });
            });
          });
        });
      });
  }
  // the force f on a mapped state with that of multipliers; its dx holds the sum
  template <class Child>
  static auto& withMultipliers(Child& child, DerivId f) {
    if constexpr (requires { child.multiplierForce; })
      if (!child.multiplierForce.empty()) {
        using D = typename Child::DataTypes;
        auto& sum = child[vec_id::dx];
        VectorOperations<D>::eq(OneThread{}, sum, child[f]);
        VectorOperations<D>::peq(OneThread{}, sum, child.multiplierForce, typename D::Real(1));
        return sum;
      }
    return child[f];
  }
};

}  // namespace sinew
