// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/core/assembly.hpp>
#include <sinew/scene/scope.hpp>
#include <sinew/state/vector_operations.hpp>

#include <cmath>

namespace sinew {

/// The few physical procedures of which integration schemes consist (Faure et al. 2007, section 2.1), over
/// the subtree of `Root`, a scope. Vector operations act on independent states; mapped ones follow by
/// propagation.
template <class Root>
struct MechanicalOperations {
  Root const& root;
  double time, dt;
  int coordsTaken = 0, derivsTaken = 0;

  explicit MechanicalOperations(Root const& r, double t = 0, double h = 0) : root(r), time(t), dt(h) {}
  MechanicalOperations(MechanicalOperations const&) = delete;

  // auxiliary vectors

  CoordId takeCoord() { return {CoordId::reserved + coordsTaken++}; }
  DerivId takeDeriv() { return {DerivId::reserved + derivsTaken++}; }
  void giveBackCoord() { --coordsTaken; }
  void giveBackDeriv() { --derivsTaken; }
  void reserve(Auxiliary needed) {
    forEachState([&](auto& state) { state.reserve(needed); });
  }

  // vector mathematics

  void clear(DerivId r) {
    forEachIndependent([&](auto& s) { vec::clear(s[r]); });
  }
  template <class Id>
  void eq(Id r, Id a) {
    forEachIndependent([&](auto& s) { vec::eq(s[r], s[a]); });
  }
  void eq(DerivId r, DerivId a, double f) {
    forEachIndependent([&](auto& s) { vec::flat(s[r]) = real(s, f) * vec::flat(s[a]); });
  }
  void peq(DerivId r, DerivId a, double f) {
    forEachIndependent([&](auto& s) { vec::peq(s[r], s[a], real(s, f)); });
  }
  void peq(CoordId r, DerivId a, double f) {
    forEachIndependent([&](auto& s) { vec::increment<DataTypesOf<decltype(s)>>(s[r], s[a], real(s, f)); });
  }
  void teq(DerivId r, double f) {
    forEachIndependent([&](auto& s) { vec::flat(s[r]) *= real(s, f); });
  }
  double dot(DerivId a, DerivId b) {
    double sum = 0;
    forEachIndependent([&](auto& s) { sum += vec::dot(s[a], s[b]); });
    return sum;
  }
  /// rate = time derivative of theta, where a position moved by theta has velocity v; v itself but for rigid
  /// bodies.
  void chartRate(DerivId rate, DerivId theta, DerivId v) {
    forEachIndependent([&](auto& s) {
      using D = DataTypesOf<decltype(s)>;
      for (std::size_t i = 0; i < s[rate].size(); ++i) s[rate][i] = D::chart_rate(s[theta][i], s[v][i]);
    });
  }

  // physics

  /// Mapped states follow their parents.
  void propagate(CoordId x, DerivId v) {
    forEachMapping([&](auto& mapping, auto& child, auto& parent) {
      mapping.apply(child[x], parent[x]);
      mapping.applyJ(child[v], parent[v]);
    });
  }
  void propagate(DerivId v) {
    forEachMapping([&](auto& mapping, auto& child, auto& parent) { mapping.applyJ(child[v], parent[v]); });
  }

  /// f = all forces at (x, v), with those on mapped states brought to the independent ones.
  void computeForce(DerivId f, CoordId x, DerivId v) {
    const MechanicalParams p{.time = time, .dt = dt};
    forEachState([&](auto& s) { vec::clear(s[f]); });
    traverse(
        root,
        [&](auto& c, auto const& scope) {
          using C = std::decay_t<decltype(c)>;
          if constexpr (HasRole<C, role::ForceField>) {
            auto& s = scope.template state<typename C::DataTypes>();
            c.addForce(p, s[f], s[x], s[v]);
          } else if constexpr (HasRole<C, role::Mass>) {
            auto& s = scope.template state<typename C::DataTypes>();
            MechanicalParams weight = p;
            weight.gravity = scope.gravity();
            c.addForce(weight, s[f], s[x], s[v]);
          } else if constexpr (HasRole<C, role::InteractionForceField>) {
            forEnds(c, scope, [&](auto& a, auto& b) { c.addForce(p, a[f], b[f], a[x], b[x], a[v], b[v]); });
          }
        },
        [&](auto& c, auto const& scope) { accumulate(c, scope, f); });
  }

  /// a = P M^-1 f
  void accFromF(DerivId a, DerivId f, CoordId x) {
    traverse(root, [&](auto& c, auto const& scope) {
      using C = std::decay_t<decltype(c)>;
      if constexpr (HasRole<C, role::Mass>)
        if (!scope.stateScope().mapped()) {
          auto& s = scope.template state<typename C::DataTypes>();
          c.accFromF(s[a], s[x], s[f]);
        }
    });
    projectResponse(a);
  }

  /// a = acceleration at time t in the state (x, v), mapped states included.
  template <class VecDeriv, class VecCoord>
  void computeAcc(double t, VecDeriv& a, VecCoord const& x, VecDeriv const& v) {
    time = t;
    propagate(x.id, v.id);
    computeForce(vec_id::force, x.id, v.id);
    accFromF(a.id, vec_id::force, x.id);
  }

  /// Removes forbidden displacements.
  void projectResponse(DerivId dx) {
    traverse(root, [&](auto& c, auto const& scope) {
      using C = std::decay_t<decltype(c)>;
      if constexpr (HasRole<C, role::ProjectiveConstraint>)
        c.projectResponse(scope.template state<typename C::DataTypes>()[dx]);
    });
  }

  /// r += (m M + b B + k K) dx, through all mappings.
  void addMBKdx(DerivId r, DerivId dx, MatrixFactors factors) {
    const MechanicalParams p{.time = time, .dt = dt, .m = factors.m, .b = factors.b, .k = factors.k};
    propagate(dx);
    forEachMapped([&](auto& s) { vec::clear(s[r]); });
    traverse(
        root,
        [&](auto& c, auto const& scope) {
          using C = std::decay_t<decltype(c)>;
          if constexpr (HasRole<C, role::ForceField>) {
            auto& s = scope.template state<typename C::DataTypes>();
            if (p.k != 0 || p.b != 0) c.addDForce(p, s[r], s[dx]);
          } else if constexpr (HasRole<C, role::Mass>) {
            auto& s = scope.template state<typename C::DataTypes>();
            if (p.m != 0) c.addMDx(s[r], s[vec_id::position], s[dx], p.m);
          } else if constexpr (HasRole<C, role::InteractionForceField>) {
            if (p.k != 0 || p.b != 0)
              forEnds(c, scope, [&](auto& a, auto& b) { c.addDForce(p, a[r], b[r], a[dx], b[dx]); });
          }
        },
        [&](auto& c, auto const& scope) { accumulate(c, scope, r); });
  }

  double kineticEnergy() {
    double sum = 0;
    traverse(root, [&](auto& c, auto const& scope) {
      using C = std::decay_t<decltype(c)>;
      if constexpr (HasRole<C, role::Mass>) {
        auto& s = scope.template state<typename C::DataTypes>();
        sum += c.kineticEnergy(s[vec_id::position], s[vec_id::velocity]);
      }
    });
    return sum;
  }
  /// Energy of the force fields, without gravity [J].
  double potentialEnergy() {
    double sum = 0;
    traverse(root, [&](auto& c, auto const& scope) {
      using C = std::decay_t<decltype(c)>;
      if constexpr (HasRole<C, role::ForceField>)
        sum += c.potentialEnergy(scope.template state<typename C::DataTypes>()[vec_id::position]);
      else if constexpr (HasRole<C, role::InteractionForceField>)
        forEnds(c, scope, [&](auto& a, auto& b) {
          sum += c.potentialEnergy(a[vec_id::position], b[vec_id::position]);
        });
    });
    return sum;
  }

  // the assembled system

  /// Numbers the degrees of freedom of the independent states, and fixes the pattern of `matrix`.
  template <class Matrix>
  void initMatrix(Matrix& matrix) {
    int dofs = 0;
    forEachIndependent([&](auto& s) {
      s.dofOffset = dofs;
      dofs += int(s.size()) * DataTypesOf<decltype(s)>::size;
    });
    matrix.startPattern(dofs);
    assemblePhase<AssemblyPhase::pattern>(matrix, {});
    matrix.finishPattern();
    assemblePhase<AssemblyPhase::bind>(matrix, {});
  }
  /// matrix = P (m M + b B + k K) P + (I - P)
  template <class Matrix>
  void assemble(Matrix& matrix, MatrixFactors factors) {
    matrix.setZero();
    assemblePhase<AssemblyPhase::add>(matrix, factors);
    matrix.mirror();
    traverse(root, [&](auto& c, auto const& scope) {
      using C = std::decay_t<decltype(c)>;
      if constexpr (HasRole<C, role::ProjectiveConstraint>)
        if (!scope.stateScope().mapped())
          withSink<AssemblyPhase::add>(matrix, scope.stateScope(), scope.stateScope(), [&](auto const& sink) {
            c.projectMatrix(sink);
          });
    });
  }
  /// Copies between state vectors and one vector of all independent degrees of freedom.
  template <class Vector>
  void gather(Vector& to, DerivId from) {
    forEachIndependent([&](auto& s) {
      to.segment(s.dofOffset, vec::flat(s[from]).size()) =
          vec::flat(s[from]).template cast<typename Vector::Scalar>();
    });
  }
  template <class Vector>
  void scatter(DerivId to, Vector const& from) {
    forEachIndependent([&](auto& s) {
      auto flat = vec::flat(s[to]);
      flat = from.segment(s.dofOffset, flat.size()).template cast<typename DataTypesOf<decltype(s)>::Real>();
    });
  }

  // iteration over states

  template <class F>
  void forEachState(F&& f) {
    traverse(root, [&](auto& c, auto const&) {
      if constexpr (HasRole<std::decay_t<decltype(c)>, role::State>) f(c);
    });
  }
  template <class F>
  void forEachIndependent(F&& f) {
    traverse(root, [&](auto& c, auto const& scope) {
      if constexpr (HasRole<std::decay_t<decltype(c)>, role::State>)
        if (!scope.mapped()) f(c);
    });
  }

 private:
  template <class State>
  using DataTypesOf = typename std::decay_t<State>::DataTypes;
  template <class State>
  static auto real(State const&, double f) {
    return typename State::DataTypes::Real(f);
  }

  template <class F>
  void forEachMapped(F&& f) {
    traverse(root, [&](auto& c, auto const& scope) {
      if constexpr (HasRole<std::decay_t<decltype(c)>, role::State>)
        if (scope.mapped()) f(c);
    });
  }
  // f(mapping, child state, parent state), parents first, visual models left out
  template <class F>
  void forEachMapping(F&& f) {
    traverse(root, [&](auto& c, auto const& scope) {
      using C = std::decay_t<decltype(c)>;
      if constexpr (HasRole<C, role::Mapping>)
        scope.forMechanicalMapping(c, [&](auto& child, auto& parent) { f(c, child, parent); });
    });
  }
  template <class C, class S>
  void accumulate(C& c, S const& scope, DerivId f) {
    if constexpr (HasRole<C, role::Mapping>)
      scope.forMechanicalMapping(c, [&](auto& child, auto& parent) { c.applyJT(parent[f], child[f]); });
  }
  template <class C, class S, class F>
  void forEnds(C const& c, S const& scope, F&& f) {
    using D = typename C::DataTypes;
    scope.withEnds(c, [&](auto const& a, auto const& b) { f(a.template state<D>(), b.template state<D>()); });
  }

  // f(degrees of freedom of the state of this scope in the system)
  template <class S, class F>
  static void withDofs(S const& owner, F&& f) {
    owner.withMappingOrState(
        [&](auto& mapping, auto const& parent) {
          withDofs(parent, [&](auto const& above) {
            f(MappedDofs<std::decay_t<decltype(mapping)>, std::decay_t<decltype(above)>>{mapping, above});
          });
        },
        [&](auto& state) { f(DirectDofs<DataTypesOf<decltype(state)>::size>{state.dofOffset}); });
  }
  template <AssemblyPhase Phase, class Matrix, class S0, class S1, class F>
  static void withSink(Matrix& matrix, S0 const& a, S1 const& b, F&& f) {
    withDofs(a, [&](auto const& first) {
      withDofs(b, [&](auto const& second) {
        f(MatrixSink<Phase, Matrix, std::decay_t<decltype(first)>, std::decay_t<decltype(second)>>{
            matrix, first, second});
      });
    });
  }

  template <AssemblyPhase Phase, class Matrix>
  void assemblePhase(Matrix& matrix, MatrixFactors factors) {
    const MechanicalParams p{.time = time, .dt = dt, .m = factors.m, .b = factors.b, .k = factors.k};
    traverse(root, [&](auto& c, auto const& scope) {
      using C = std::decay_t<decltype(c)>;
      if constexpr (HasRole<C, role::ForceField>) {
        withSink<Phase>(matrix, scope.stateScope(), scope.stateScope(), [&](auto const& sink) {
          c.addToMatrix(p, sink);
        });
      } else if constexpr (HasRole<C, role::Mass>) {
        auto& x = scope.template state<typename C::DataTypes>()[vec_id::position];
        withSink<Phase>(matrix, scope.stateScope(), scope.stateScope(), [&](auto const& sink) {
          c.addToMatrix(p, x, sink);
        });
      } else if constexpr (HasRole<C, role::InteractionForceField>) {
        scope.withEnds(c, [&](auto const& a, auto const& b) {
          withSink<Phase>(
              matrix, a.stateScope(), b.stateScope(), [&](auto const& sink) { c.addToMatrix(p, sink); });
        });
      }
    });
  }
};

}  // namespace sinew
