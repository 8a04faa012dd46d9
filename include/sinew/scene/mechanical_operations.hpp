// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/core/assembly.hpp>
#include <sinew/core/element_force.hpp>
#include <sinew/scene/acted_forces.hpp>
#include <sinew/scene/scope.hpp>
#include <sinew/scene/solver_contacts.hpp>
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
  ActedForces<MechanicalOperations> acted{*this};

  explicit MechanicalOperations(Root const& r, double t = 0, double h = 0) : root(r), time(t), dt(h) {}
  MechanicalOperations(MechanicalOperations const&) = delete;

  // auxiliary vectors

  CoordId takeCoord() { return {CoordId::reserved + coordsTaken++}; }
  DerivId takeDeriv() { return {DerivId::reserved + derivsTaken++}; }
  void releaseCoord() { --coordsTaken; }
  void releaseDeriv() { --derivsTaken; }
  void reserve(Auxiliary needed) {
    std::size_t scalars = 0;
    forEachState([&](auto& state) {
      state.reserve(needed);
      scalars = std::max(scalars, state.size() * std::size_t(DataTypesOf<decltype(state)>::size));
    });
    reserveSums(scalars);
  }

  /// Prepares what takes part in forces and matrices for the threads of this solver.
  void split() {
    if constexpr (Root::threaded)
      traverse(root, on<role::ForceField>([&](auto& c, auto const&) {
                 if constexpr (shares_work<std::decay_t<decltype(c)>>) c.driver.split(workers().count());
               }));
  }
  /// f(linear solver) of the systems that an ODE solver has solved, if there are some.
  template <class Ode, class F>
  void withLinearSolverOf([[maybe_unused]] F&& f) {
    if constexpr (Ode::implicit)
      root.withLinearSolver(f);
    else if constexpr (requires { Ode::solvesMass; })
      if (!massIsDiagonal()) root.withLinearSolverIfAny(f);
  }
  /// The threads by which this solver works.
  auto workers() const { return root.workers(); }
  /// Room for sums over vectors of so many scalars.
  void reserveSums(std::size_t scalars) { workers().reserveSums(scalars / std::size_t(vec::piece) + 1); }

  // vector mathematics

  void clear(DerivId r) {
    forEachIndependent([&](auto& s) { Vectors<decltype(s)>::clear(workers(), s[r]); });
  }
  template <class Id>
  void eq(Id r, Id a) {
    forEachIndependent([&](auto& s) { Vectors<decltype(s)>::eq(workers(), s[r], s[a]); });
  }
  void eq(DerivId r, DerivId a, double f) {
    forEachIndependent([&](auto& s) { Vectors<decltype(s)>::eq(s[r], s[a], real(s, f)); });
  }
  void peq(DerivId r, DerivId a, double f) {
    forEachIndependent([&](auto& s) { Vectors<decltype(s)>::peq(workers(), s[r], s[a], real(s, f)); });
  }
  void peq(CoordId r, DerivId a, double f) {
    forEachIndependent([&](auto& s) { Vectors<decltype(s)>::move(s[r], s[a], real(s, f)); });
  }
  void teq(DerivId r, double f) {
    forEachIndependent([&](auto& s) { Vectors<decltype(s)>::teq(s[r], real(s, f)); });
  }
  double dot(DerivId a, DerivId b) {
    double sum = 0;
    forEachIndependent([&](auto& s) { sum += Vectors<decltype(s)>::dot(workers(), s[a], s[b]); });
    return sum;
  }
  /// r = a + f r
  void xpay(DerivId r, DerivId a, double f) {
    forEachIndependent([&](auto& s) { Vectors<decltype(s)>::xpay(workers(), s[r], s[a], real(s, f)); });
  }
  /// x += f p, r -= f q; returns r.r.
  double advance(DerivId x, DerivId p, DerivId r, DerivId q, double f) {
    double sum = 0;
    forEachIndependent([&](auto& s) {
      sum += Vectors<decltype(s)>::advance(workers(), s[x], s[p], s[r], s[q], real(s, f));
    });
    return sum;
  }
  /// rate = time derivative of theta, where a position moved by theta has velocity v; v itself but for rigid
  /// bodies.
  void chartRate(DerivId rate, DerivId theta, DerivId v) {
    forEachIndependent([&](auto& s) { Vectors<decltype(s)>::chartRate(s[rate], s[theta], s[v]); });
  }

  // physics

  /// Mapped states follow their parents.
  void propagate(CoordId x, DerivId v);
  void propagate(DerivId v);

  /// f = all forces at (x, v), with those on mapped states brought to the independent ones, and the external
  /// forces as they are. `gyroscopicStep`: see MechanicalParams.
  void computeForce(DerivId f, CoordId x, DerivId v, double gyroscopicStep = 0);

  /// Whether masses give M^-1 f by themselves: each is diagonal, and none is that of a mapped state.
  bool massIsDiagonal() {
    bool diagonal = true;
    traverse(root, on<role::Mass>([&]([[maybe_unused]] auto const& c, auto const& scope) {
               if (scope.stateScope().mapped()) diagonal = false;
               if constexpr (requires { c.exactInverse(); }) diagonal = diagonal && c.exactInverse();
             }));
    return diagonal;
  }
  /// a = P M^-1 f, of the sums of the rows of masses that are not diagonal and without those of mapped states
  void accFromF(DerivId a, DerivId f, CoordId x);

  /// a = acceleration at time t in the state (x, v), mapped states included.
  template <class VecDeriv, class VecCoord>
  void computeAcc(double t, VecDeriv& a, VecCoord const& x, VecDeriv const& v) {
    time = t;
    propagate(x.id, v.id);
    computeForce(vec_id::force, x.id, v.id);
    accFromF(a.id, vec_id::force, x.id);
  }

  /// Removes forbidden displacements.
  void projectResponse(DerivId dx);
  /// Puts constrained points where they have to be at time t, with the velocity they have there.
  void projectPositionAndVelocity(double t, CoordId x, DerivId v);

  /// r += (m M + b B + k K) dx, through all mappings.
  void addMBKdx(DerivId r, DerivId dx, MatrixFactors factors);

  double kineticEnergy();
  /// Energy of the force fields, without gravity [J].
  double potentialEnergy();

  // the assembled system

  /// Numbers the degrees of freedom of the independent states, each from a block of so many on, and returns
  /// how many there are with what fills the last blocks.
  int numberDofs(int block) {
    int dofs = 0;
    forEachIndependent([&](auto& s) {
      s.dofOffset = dofs;
      dofs += int(s.size()) * DataTypesOf<decltype(s)>::size;
      dofs = (dofs + block - 1) / block * block;
    });
    return dofs;
  }
  /// Numbers them from blocks of `matrix` on, and fixes its pattern.
  template <class Matrix>
  void initMatrix(Matrix& matrix) {
    [[maybe_unused]] const auto span = root.span(Phase::pattern);
    const int dofs = numberDofs(Matrix::blockSize);
    matrix.startPattern(dofs);
    auto&& assembled = root.assembled(matrix);
    preallocate(assembled);
    matrix.finishPattern();
    if constexpr (Root::threaded && requires { matrix.split(1); }) {
      matrix.split(workers().count());
      reserveSums(std::size_t(dofs));
    }
    assemblePhase<AssemblyPhase::bind>(assembled, {});
    split();  // by places in the matrix
  }
  /// matrix = P (m M + b B + k K) P + (I - P)
  template <class Matrix>
  void assemble(Matrix& matrix, MatrixFactors factors) {
    [[maybe_unused]] const auto span = root.span(Phase::assembly);
    if constexpr (Root::threaded && requires { matrix.setZero(workers()); })
      matrix.setZero(workers());
    else
      matrix.setZero();
    auto&& assembled = root.assembled(matrix);
    fill(assembled, factors);
    // the padding of the last block of a state belongs to no degree of freedom
    forEachIndependent([&](auto& s) {
      const int end = s.dofOffset + int(s.size()) * DataTypesOf<decltype(s)>::size;
      for (int dof = end; dof % Matrix::blockSize != 0; ++dof) matrix.fix(dof);
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
    traverse(root, on<role::State>([&](auto& c, auto const&) { f(c); }));
  }
  template <class F>
  void forEachIndependent(F&& f) {
    traverse(root, on<role::State>([&](auto& c, auto const& scope) {
               if (!scope.mapped()) f(c);
             }));
  }
  template <class F>
  void forEachMapped(F&& f) {
    traverse(root, on<role::State>([&](auto& c, auto const& scope) {
               if (scope.mapped()) f(c);
             }));
  }

 private:
  friend ActedForces<MechanicalOperations>;

  // f(params) for a component as a whole, or for each share of it, and again for the deferred sums of all
  // shares
  template <class C, class F>
  void inShares([[maybe_unused]] C const& c, MechanicalParams const& p, F&& f) {
    if constexpr (Root::threaded && shares_work<C>)
      if (c.driver.shares > 1) {
        const auto threads = workers();
        for (const bool deferred : {false, true})
          threads.run([&](WorkShare share) {
            MechanicalParams own = p;
            own.share = share;
            own.share.deferred = deferred;
            f(own);
          });
        return;
      }
    f(p);
  }

  template <class State>
  using DataTypesOf = typename std::decay_t<State>::DataTypes;
  template <class State>
  using Vectors = VectorOperations<DataTypesOf<State>>;
  template <class State>
  static auto real(State const&, double f) {
    return typename State::DataTypes::Real(f);
  }
  /// The state on which a component acts.
  template <class C, class S>
  static auto& stateOf(C const&, S const& scope) {
    return scope.template state<typename C::DataTypes>();
  }

  // f(mapping, child state, parent state), parents first, visual models left out
  template <class F>
  void forEachMapping(F&& f) {
    traverse(root, on<role::Mapping>([&](auto& mapping, auto const& scope) {
               withMechanicalChild(mapping, scope, f);
             }));
  }
  template <class M, class S, class F>
  static void withMechanicalChild(M& mapping, S const& scope, F&& f) {
    scope.withMapped(mapping, [&](auto& m, auto& child, auto& parent) {
      if constexpr (HasRole<std::decay_t<decltype(child)>, role::State>) f(m, child, parent);
    });
  }
  // f of mapped states, then complete, is added to that of their parents; with each also(mapping, child,
  // parent)
  template <class F>
  void accumulate(DerivId f, F&& also) {
    [[maybe_unused]] const auto span = root.span(Phase::mappingBack);
    traverse_back(root, on<role::Mapping>([&](auto& mapping, auto const& scope) {
                    withMechanicalChild(mapping, scope, [&](auto& m, auto& child, auto& parent) {
                      m.applyJT(parent[f], child[f]);
                      also(m, child, parent);
                    });
                  }));
  }
  // the force f on a mapped state with that of multipliers; its dx holds the sum
  template <class Child>
  static auto& withMultipliers(Child& child, DerivId f) {
    if constexpr (requires { child.multiplierForce; })
      if (!child.multiplierForce.empty()) {
        auto& sum = child[vec_id::dx];
        Vectors<Child>::eq(OneThread{}, sum, child[f]);
        Vectors<Child>::peq(OneThread{}, sum, child.multiplierForce, real(child, 1));
        return sum;
      }
    return child[f];
  }
  template <class C, class S, class F>
  void forEnds(C const& c, S const& scope, F&& f) {
    using D = typename C::DataTypes;
    scope.withEnds(c, [&](auto const& a, auto const& b) { f(a.template state<D>(), b.template state<D>()); });
  }

  // f(state) of a constraint, or f(state, state) of one that joins two
  template <class C, class S, class F>
  static void withConstrained(C const& c, S const& scope, F&& f) {
    using D = typename C::DataTypes;
    if constexpr (JoinsTwo<C>)
      scope.withEnds(c,
                     [&](auto const& a, auto const& b) { f(a.template state<D>(), b.template state<D>()); });
    else
      f(scope.template state<D>());
  }
  // what only some constraints have (functions, since nvcc looks at such names before it knows the class)
  template <class C, class... V>
  static void placeConstrained(C& c, double t, V&... x) {
    if constexpr (requires { c.projectPosition(t, x...); }) c.projectPosition(t, x...);
  }
  template <class C, class... V>
  static void moveConstrained(C& c, double t, V&... v) {
    if constexpr (requires { c.projectVelocity(t, v...); }) c.projectVelocity(t, v...);
  }
  template <class C, class... V>
  static void accelerateConstrained(C& c, V&... a) {
    if constexpr (requires { c.projectAcceleration(a...); })
      c.projectAcceleration(a...);
    else
      c.projectResponse(a...);
  }
  template <class Matrix>
  void preallocate(Matrix& matrix);
  template <class Matrix>
  void fill(Matrix& matrix, MatrixFactors factors);
  template <AssemblyPhase Phase, class Matrix, class C, class S>
  static auto constraintSink(Matrix& matrix, C const& c, S const& scope) {
    using Dofs = DirectDofs<C::DataTypes::size>;
    Dofs first{0}, second{0};
    withConstrained(c, scope, [&](auto& a, auto&... b) {
      first.offset = second.offset = a.dofOffset;
      ((second.offset = b.dofOffset), ...);
    });
    return MatrixSink<Phase, Matrix, Dofs>{matrix, first, second};
  }

  SolverContacts<Root> contacts() const { return {root}; }
  template <AssemblyPhase Phase, class Matrix>
  void assemblePhase(Matrix& matrix, MatrixFactors factors);
};

// Outside the class, so that a program may have them instantiated in one place: runtime/precompiled.hpp.

template <class Root>
void MechanicalOperations<Root>::propagate(CoordId x, DerivId v) {
  [[maybe_unused]] const auto span = root.span(Phase::mapping);
  forEachMapping([&](auto& mapping, auto& child, auto& parent) {
    mapping.apply(child[x], parent[x]);
    mapping.applyJ(child[v], parent[v]);
  });
}

template <class Root>
void MechanicalOperations<Root>::propagate(DerivId v) {
  [[maybe_unused]] const auto span = root.span(Phase::mapping);
  forEachMapping([&](auto& mapping, auto& child, auto& parent) { mapping.applyJ(child[v], parent[v]); });
}

template <class Root>
void MechanicalOperations<Root>::computeForce(DerivId f, CoordId x, DerivId v, double gyroscopicStep) {
  [[maybe_unused]] const auto span = root.span(Phase::force);
  const MechanicalParams p{.time = time, .dt = dt, .gyroscopicStep = gyroscopicStep};
  forEachState([&](auto& s) {
    if (s[vec_id::externalForce].empty())
      Vectors<decltype(s)>::clear(OneThread{}, s[f]);
    else
      Vectors<decltype(s)>::eq(OneThread{}, s[f], s[vec_id::externalForce]);
  });
  traverse(
      root, on<role::ForceField, role::Mass, role::InteractionForceField>([&](auto& c, auto const& scope) {
        using C = std::decay_t<decltype(c)>;
        if constexpr (HasRole<C, role::InteractionForceField>) {
          forEnds(c, scope, [&](auto& a, auto& b) { add_force(c, p, a[f], b[f], a[x], b[x], a[v], b[v]); });
        } else {
          auto& s = stateOf(c, scope);
          MechanicalParams params = p;
          if constexpr (HasRole<C, role::Mass>) params.gravity = scope.gravity();
          inShares(c, params, [&](MechanicalParams const& part) { add_force(c, part, s[f], s[x], s[v]); });
        }
      }));
  contacts().addForces(f, x, v);
  accumulate(f, [f](auto& mapping, auto& child, auto&) {
    if constexpr (HasGeometricStiffness<std::decay_t<decltype(mapping)>>)
      mapping.updateK(withMultipliers(child, f));
  });
}

template <class Root>
void MechanicalOperations<Root>::accFromF(DerivId a, DerivId f, CoordId x) {
  [[maybe_unused]] const auto span = root.span(Phase::acceleration);
  traverse(root, on<role::Mass>([&](auto& c, auto const& scope) {
             if (scope.stateScope().mapped()) return;
             auto& s = stateOf(c, scope);
             c.accFromF(s[a], s[x], s[f]);
           }));
  traverse(root, on<role::ProjectiveConstraint>([&](auto& c, auto const& scope) {
             withConstrained(c, scope, [&](auto&... s) { accelerateConstrained(c, s[a]...); });
           }));
}

template <class Root>
void MechanicalOperations<Root>::projectResponse(DerivId dx) {
  [[maybe_unused]] const auto span = root.span(Phase::constraint);
  traverse(root, on<role::ProjectiveConstraint>([&](auto& c, auto const& scope) {
             withConstrained(c, scope, [&](auto&... s) { c.projectResponse(s[dx]...); });
           }));
}

template <class Root>
void MechanicalOperations<Root>::projectPositionAndVelocity(double t, CoordId x, DerivId v) {
  [[maybe_unused]] const auto span = root.span(Phase::constraint);
  traverse(root, on<role::ProjectiveConstraint>([&](auto& c, auto const& scope) {
             withConstrained(c, scope, [&](auto&... s) {
               placeConstrained(c, t, s[x]...);
               moveConstrained(c, t, s[v]...);
             });
           }));
}

template <class Root>
void MechanicalOperations<Root>::addMBKdx(DerivId r, DerivId dx, MatrixFactors factors) {
  [[maybe_unused]] const auto span = root.span(Phase::product);
  const MechanicalParams p{.time = time, .dt = dt, .m = factors.m, .b = factors.b, .k = factors.k};
  propagate(dx);
  forEachMapped([&](auto& s) { Vectors<decltype(s)>::clear(OneThread{}, s[r]); });
  traverse(root,
           on<role::ForceField, role::Mass, role::InteractionForceField>([&](auto& c, auto const& scope) {
             using C = std::decay_t<decltype(c)>;
             if constexpr (HasRole<C, role::Mass>) {
               auto& s = stateOf(c, scope);
               if (p.m != 0) c.addMDx(s[r], s[vec_id::position], s[dx], p.m);
             } else if (p.k != 0 || p.b != 0) {
               if constexpr (HasRole<C, role::InteractionForceField>) {
                 forEnds(c, scope, [&](auto& a, auto& b) { add_dforce(c, p, a[r], b[r], a[dx], b[dx]); });
               } else {
                 auto& s = stateOf(c, scope);
                 inShares(c, p, [&](MechanicalParams const& part) { add_dforce(c, part, s[r], s[dx]); });
               }
             }
           }));
  if (p.k != 0 || p.b != 0) contacts().addDForces(r, dx, p);
  accumulate(r, [&](auto& mapping, auto&, auto& parent) {
    if constexpr (HasGeometricStiffness<std::decay_t<decltype(mapping)>>)
      if (p.k != 0) mapping.addKx(parent[r], parent[dx], p.k);
  });
}

template <class Root>
double MechanicalOperations<Root>::kineticEnergy() {
  double sum = 0;
  traverse(root, on<role::Mass>([&](auto& c, auto const& scope) {
             auto& s = stateOf(c, scope);
             sum += c.kineticEnergy(s[vec_id::position], s[vec_id::velocity]);
           }));
  return sum;
}

template <class Root>
double MechanicalOperations<Root>::potentialEnergy() {
  double sum = 0;
  traverse(root, on<role::ForceField, role::InteractionForceField>([&](auto& c, auto const& scope) {
             if constexpr (HasRole<std::decay_t<decltype(c)>, role::ForceField>)
               sum += potential_energy(c, stateOf(c, scope)[vec_id::position]);
             else
               forEnds(c, scope, [&](auto& a, auto& b) {
                 sum += potential_energy(c, a[vec_id::position], b[vec_id::position]);
               });
           }));
  return sum;
}

template <class Root>
template <class Matrix>
void MechanicalOperations<Root>::preallocate(Matrix& matrix) {
  assemblePhase<AssemblyPhase::pattern>(matrix, {});
  traverse(root, on<role::ProjectiveConstraint>([&](auto& c, auto const& scope) {
             const auto sink = constraintSink<AssemblyPhase::pattern>(matrix, c, scope);
             if constexpr (requires { c.preallocate(sink); }) c.preallocate(sink);
           }));
}

template <class Root>
template <class Matrix>
void MechanicalOperations<Root>::fill(Matrix& matrix, MatrixFactors factors) {
  assemblePhase<AssemblyPhase::add>(matrix, factors);
  traverse(root, on<role::ProjectiveConstraint>([&](auto& c, auto const& scope) {
             c.projectMatrix(constraintSink<AssemblyPhase::add>(matrix, c, scope));
           }));
}

template <class Root>
template <AssemblyPhase Phase, class Matrix>
void MechanicalOperations<Root>::assemblePhase(Matrix& matrix, MatrixFactors factors) {
  const MechanicalParams p{.time = time, .dt = dt, .m = factors.m, .b = factors.b, .k = factors.k};
  traverse(root, on<role::Mapping>([&](auto& mapping, auto const& scope) {
             using M = std::decay_t<decltype(mapping)>;
             if constexpr (HasGeometricStiffness<M>)
               withMechanicalChild(mapping, scope, [&](auto& m, auto&, auto&) {
                 scope.parentScope().template withDofs<typename M::In>([&](auto const& dofs) {
                   with_sink<Phase>(matrix, dofs, dofs, [&](auto const& sink) { m.addToMatrix(p, sink); });
                 });
               });
           }));
  traverse(
      root, on<role::ForceField, role::Mass, role::InteractionForceField>([&](auto& c, auto const& scope) {
        using C = std::decay_t<decltype(c)>;
        using D = typename C::DataTypes;
        if constexpr (HasRole<C, role::InteractionForceField>)
          scope.withEnds(c, [&](auto const& a, auto const& b) {
            a.template withDofs<D>([&](auto const& first) {
              b.template withDofs<D>([&](auto const& second) {
                with_sink<Phase>(matrix, first, second, [&](auto const& sink) { add_to_matrix(c, p, sink); });
              });
            });
          });
        else
          scope.template withDofs<D>([&](auto const& dofs) {
            with_sink<Phase>(matrix, dofs, dofs, [&](auto const& sink) {
              if constexpr (HasRole<C, role::Mass>)
                c.addToMatrix(p, stateOf(c, scope)[vec_id::position], sink);
              else if constexpr (Phase == AssemblyPhase::add)
                inShares(c, p, [&](MechanicalParams const& part) { add_to_matrix(c, part, sink); });
              else
                add_to_matrix(c, p, sink);
            });
          });
      }));
  contacts().template assemble<Phase>(matrix, p);
}

}  // namespace sinew
