// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/core/assembly.hpp>
#include <sinew/core/element_force.hpp>
#include <sinew/core/vec_id.hpp>
#include <sinew/scene/mapped_states.hpp>
#include <sinew/scene/scope.hpp>
#include <sinew/scene/state_vectors.hpp>
#include <sinew/scene/states_of.hpp>

#include <functional>
#include <type_traits>
#include <utility>
#include <vector>

namespace sinew {

/// The force fields, interactions and masses at and below a scope, `root`, on the states on which they act.
template <class Root>
struct MechanicalForces {
  Root const& root;

  /// Prepares what takes part in forces and matrices for the threads of the solver.
  void split() const {
    if constexpr (Root::threaded)
      traverse(root, on<role::ForceField>([&](auto& c, auto const&) {
                 if constexpr (shares_work<std::decay_t<decltype(c)>>) split_work(c, root.workers().count());
               }));
    if constexpr (Root::distributed)
      traverse(root, on<role::ForceField>([&](auto& c, auto const& scope) {
                 if constexpr (takes_elements<std::decay_t<decltype(c)>>)
                   with_states_of(c, scope, [&](auto& s) {
                     c.driver.setGhosts(scope.stateScope().mapped() ? 0 : s.owned());
                   });
               }));
  }

  /// f += forces at (x, v)
  void add(DerivId f, CoordId x, DerivId v, MechanicalParams const& p) const {
    forEachWithGhosts(
        [&](auto& c, auto const& scope, Elements elements) {
          MechanicalParams own = p;
          own.share.elements = elements;
          if constexpr (HasRole<std::decay_t<decltype(c)>, role::Mass>) own.gravity = scope.gravity();
          with_states_of(c, scope, [&](auto&... s) {
            inShares(
                c, own, [&](MechanicalParams const& part) { add_force(c, part, s[f]..., s[x]..., s[v]...); });
          });
        },
        x,
        v);
  }
  /// r += (m M + b B + k K) dx
  void addProducts(DerivId r, DerivId dx, MechanicalParams const& p) const {
    forEachWithGhosts(
        [&](auto& c, auto const& scope, Elements elements) {
          constexpr bool isMass = HasRole<std::decay_t<decltype(c)>, role::Mass>;
          if (isMass ? p.m == 0 : p.k == 0 && p.b == 0) return;
          auto&& own = partOf(p, elements);
          with_states_of(c, scope, [&](auto&... s) {
            if constexpr (isMass)
              c.addMDx(s[r]..., s[vec_id::position]..., s[dx]..., p.m);
            else
              inShares(c, own, [&](MechanicalParams const& part) { add_dforce(c, part, s[r]..., s[dx]...); });
          });
        },
        dx);
  }
  /// matrix += m M + b B + k K, or its pattern
  template <AssemblyPhase Phase, class Matrix>
  void assemble(Matrix& matrix, MechanicalParams const& p) const {
    forEach([&](auto& c, auto const& scope) {
      using C = std::decay_t<decltype(c)>;
      with_dofs_of(c, scope, [&](auto const& first, auto const& second) {
        with_sink<Phase>(matrix, first, second, [&](auto const& sink) {
          if constexpr (HasRole<C, role::Mass>)
            c.addToMatrix(p, scope.template state<typename C::DataTypes>()[vec_id::position], sink);
          else if constexpr (Phase == AssemblyPhase::add)
            inShares(c, p, [&](MechanicalParams const& part) { add_to_matrix(c, part, sink); });
          else
            add_to_matrix(c, p, sink);
        });
      });
    });
  }

  /// Calls that make each what it is now.
  std::vector<std::function<void()>> kept() const {
    std::vector<std::function<void()>> back;
    forEach([&](auto& c, auto const&) {
      back.push_back([of = &c, was = c]() mutable { *of = std::move(was); });
    });
    return back;
  }

  /// Whether masses give M^-1 f by themselves: each is diagonal, and none is that of a mapped state.
  bool massIsDiagonal() const {
    bool diagonal = true;
    traverse(root, on<role::Mass>([&]([[maybe_unused]] auto const& c, auto const& scope) {
               if (scope.stateScope().mapped()) diagonal = false;
               if constexpr (requires { c.exactInverse(); }) diagonal = diagonal && c.exactInverse();
             }));
    return diagonal;
  }
  /// a = M^-1 f, of the sums of the rows of masses that are not diagonal and without those of mapped states
  void accelerate(DerivId a, DerivId f, CoordId x) const {
    traverse(root, on<role::Mass>([&](auto& c, auto const& scope) {
               if (scope.stateScope().mapped()) return;
               with_states_of(c, scope, [&](auto& s) { c.accFromF(s[a], s[x], s[f]); });
             }));
  }

  double kineticEnergy() const {
    double sum = 0;
    traverse(root, on<role::Mass>([&](auto& c, auto const& scope) {
               with_states_of(c, scope, [&](auto& s) {
                 sum += c.kineticEnergy(s[vec_id::position], s[vec_id::velocity]);
               });
             }));
    return sum;
  }
  /// Of the force fields and interactions, without gravity [J].
  double potentialEnergy() const {
    double sum = 0;
    traverse(root, on<role::ForceField, role::InteractionForceField>([&](auto& c, auto const& scope) {
               with_states_of(
                   c, scope, [&](auto&... s) { sum += potential_energy(c, s[vec_id::position]...); });
             }));
    return sum;
  }

 private:
  template <class F>
  void forEach(F&& f) const {
    traverse(root,
             on<role::ForceField, role::Mass, role::InteractionForceField>(
                 [&](auto& c, auto const& scope) { f(c, scope); }));
  }
  // the parameters for some of the elements; themselves where the scene is not distributed
  static decltype(auto) partOf(MechanicalParams const& p, [[maybe_unused]] Elements elements) {
    if constexpr (Root::distributed) {
      MechanicalParams own = p;
      own.share.elements = elements;
      return own;
    } else {
      return static_cast<MechanicalParams const&>(p);
    }
  }
  // f(component, scope, elements): in a distributed scene ghost points of these vectors come meanwhile,
  // elements that need none of them go first, and mapped states follow when they have come
  template <class F, class... Ids>
  void forEachWithGhosts(F&& f, [[maybe_unused]] Ids... ids) const {
    if constexpr (Root::distributed) {
      const StateVectors<Root> vectors{root};
      root.distribution().begin(vectors, ids...);
      forEach([&](auto& c, auto const& scope) {
        if constexpr (takes_elements<std::decay_t<decltype(c)>>) f(c, scope, Elements::inner);
      });
      root.distribution().end(vectors, ids...);
      if (root.distribution().hasMapped()) MappedStates<Root>{root}.propagate(ids...);
      forEach([&](auto& c, auto const& scope) {
        f(c, scope, takes_elements<std::decay_t<decltype(c)>> ? Elements::outer : Elements::all);
      });
    } else {
      forEach([&](auto& c, auto const& scope) { f(c, scope, Elements::all); });
    }
  }
  // f(params) for a component as a whole, or for each share of it, pass by pass
  template <class C, class F>
  void inShares([[maybe_unused]] C const& c, MechanicalParams const& p, F&& f) const {
    if constexpr (Root::threaded && shares_work<C>)
      if (work_shares(c) > 1) {
        const auto threads = root.workers();
        for (int pass = 0; pass < work_passes<C>(); ++pass)
          threads.run([&](WorkShare share) {
            MechanicalParams own = p;
            own.share = share;
            own.share.pass = pass;
            f(own);
          });
        return;
      }
    f(p);
  }
};

}  // namespace sinew
