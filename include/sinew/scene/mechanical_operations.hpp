// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/scene/acted_forces.hpp>
#include <sinew/scene/mapped_states.hpp>
#include <sinew/scene/mechanical_forces.hpp>
#include <sinew/scene/projections.hpp>
#include <sinew/scene/solver_contacts.hpp>
#include <sinew/scene/state_vectors.hpp>
#include <sinew/scene/system_matrix.hpp>
#include <sinew/solver/multi_vec.hpp>

namespace sinew {

/// The few physical procedures of which integration schemes consist (Faure et al. 2007, section 2.1), over
/// the subtree of `Root`, a scope, beside the mathematics of its vectors.
template <class Root>
struct MechanicalOperations : StateVectors<Root> {
  using StateVectors<Root>::root;
  double time, dt;
  int coordsTaken = 0, derivsTaken = 0;
  ActedForces<MechanicalOperations> acted{*this};

  explicit MechanicalOperations(Root const& r, double t = 0, double h = 0)
      : StateVectors<Root>{r}, time(t), dt(h) {}
  MechanicalOperations(MechanicalOperations const&) = delete;

  // auxiliary vectors

  CoordId takeCoord() { return {CoordId::reserved + coordsTaken++}; }
  DerivId takeDeriv() { return {DerivId::reserved + derivsTaken++}; }
  void releaseCoord() { --coordsTaken; }
  void releaseDeriv() { --derivsTaken; }

  // physics

  /// Mapped states follow their parents.
  void propagate(CoordId x, DerivId v);
  void propagate(DerivId v);

  /// f = all forces at (x, v), with those on mapped states brought to the independent ones, and the external
  /// forces as they are. `gyroscopicStep`: see MechanicalParams.
  void computeForce(DerivId f, CoordId x, DerivId v, double gyroscopicStep = 0);

  /// Whether masses give M^-1 f by themselves: each is diagonal, and none is that of a mapped state.
  bool massIsDiagonal() { return forces().massIsDiagonal(); }
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

  // linear solvers

  using MultiVecDeriv = sinew::MultiVecDeriv<MechanicalOperations>;
  /// x = (m M + b B + k K)^-1 b by the linear solver of this scope, with the matrix projected. What is in x
  /// is a first guess.
  void solveSystem(MatrixFactors factors, MultiVecDeriv& x, MultiVecDeriv& b);
  /// The same where a scope may have no linear solver; says whether there is one.
  bool solveSystemIfAny(MatrixFactors factors, MultiVecDeriv& x, MultiVecDeriv& b);
  /// The same with the matrix of the last solve, which had these factors, and without a first guess.
  bool solveSystemAgain(MatrixFactors factors, MultiVecDeriv& x, MultiVecDeriv& b);
  /// Prepares what takes part in forces and matrices for the threads of this solver.
  void split();
  /// Whether an ODE solver has systems to be solved here: one that is explicit has the masses.
  template <class Ode>
  bool hasSystem() {
    if constexpr (requires { Ode::solvesMass; })
      return Ode::implicit || !massIsDiagonal();
    else
      return Ode::implicit;
  }
  /// f(linear solver) of the systems that an ODE solver has solved, if there are some.
  template <class Ode, class F>
  void withLinearSolverOf([[maybe_unused]] F&& f) {
    if constexpr (Ode::implicit)
      root.withLinearSolver(f);
    else if constexpr (requires { Ode::solvesMass; })
      if (hasSystem<Ode>()) root.withLinearSolverIfAny(f);
  }
  /// The linear solver of this scope forms the pattern of its matrix, where it has one, anew.
  void formPattern();
  /// Numbers degrees of freedom from blocks of `matrix` on, and fixes its pattern.
  template <class Matrix>
  void initMatrix(Matrix& matrix) {
    SystemMatrix<Root>{root}.init(matrix, paramsOf({}));
    split();  // by places in the matrix
  }
  /// matrix = P (m M + b B + k K) P + (I - P)
  template <class Matrix>
  void assemble(Matrix& matrix, MatrixFactors factors) {
    SystemMatrix<Root>{root}.assemble(matrix, paramsOf(factors));
  }
  /// At init, outside of steps: f() with the matrix m M + k K of the state as it is now, without contacts.
  /// What force fields remember from step to step stays what it was.
  template <class Matrix, class F>
  void withMatrixAtInit(Matrix& matrix, MatrixFactors factors, F&& f) {
    const auto back = forces().kept();
    auto clearForces = [&] {
      this->forEachState([](auto& s) {
        VectorOperations<typename std::decay_t<decltype(s)>::DataTypes>::clear(OneThread{}, s[vec_id::force]);
      });
    };
    clearForces();
    forces().add(vec_id::force, vec_id::position, vec_id::velocity, {.time = time});
    assemble(matrix, factors);
    f();
    for (auto const& call : back) call();
    clearForces();
  }

 private:
  MechanicalForces<Root> forces() const { return {root}; }
  MappedStates<Root> mapped() const { return {root}; }
  Projections<Root> projections() const { return {root}; }
  SolverContacts<Root> contacts() const { return {root}; }
  MechanicalParams paramsOf(MatrixFactors f) const {
    return {.time = time, .dt = dt, .m = f.m, .b = f.b, .k = f.k};
  }
};

// Outside the class, so that a program may have them instantiated in one place: runtime/precompiled.hpp.

template <class Root>
void MechanicalOperations<Root>::propagate(CoordId x, DerivId v) {
  if constexpr (Root::distributed)
    if (root.distribution().hasMapped()) this->bringGhosts(x, v);
  mapped().propagate(x, v);
}

template <class Root>
void MechanicalOperations<Root>::propagate(DerivId v) {
  if constexpr (Root::distributed)
    if (root.distribution().hasMapped()) this->bringGhosts(v);
  mapped().propagate(v);
}

template <class Root>
void MechanicalOperations<Root>::computeForce(DerivId f, CoordId x, DerivId v, double gyroscopicStep) {
  [[maybe_unused]] const auto span = root.span(Phase::force);
  this->forEachState([&](auto& s) {
    using V = VectorOperations<typename std::decay_t<decltype(s)>::DataTypes>;
    if (s[vec_id::externalForce].empty())
      V::clear(OneThread{}, s[f]);
    else
      V::eq(OneThread{}, s[f], s[vec_id::externalForce]);
  });
  forces().add(f, x, v, {.time = time, .dt = dt, .gyroscopicStep = gyroscopicStep});
  contacts().addForces(f, x, v);
  mapped().addInertialForces(f, x, v);
  mapped().accumulate(f);
}

template <class Root>
void MechanicalOperations<Root>::accFromF(DerivId a, DerivId f, CoordId x) {
  [[maybe_unused]] const auto span = root.span(Phase::acceleration);
  forces().accelerate(a, f, x);
  projections().projectAcceleration(a);
}

template <class Root>
void MechanicalOperations<Root>::projectResponse(DerivId dx) {
  projections().projectResponse(dx);
}

template <class Root>
void MechanicalOperations<Root>::projectPositionAndVelocity(double t, CoordId x, DerivId v) {
  projections().projectPositionAndVelocity(t, x, v);
}

template <class Root>
void MechanicalOperations<Root>::addMBKdx(DerivId r, DerivId dx, MatrixFactors factors) {
  [[maybe_unused]] const auto span = root.span(Phase::product);
  const MechanicalParams p = paramsOf(factors);
  if constexpr (!Root::distributed) propagate(dx);  // there with the ghost points that come
  this->forEachMapped([&](auto& s) {
    VectorOperations<typename std::decay_t<decltype(s)>::DataTypes>::clear(OneThread{}, s[r]);
  });
  forces().addProducts(r, dx, p);
  if (p.k != 0 || p.b != 0) contacts().addDForces(r, dx, p);
  mapped().accumulate(r, dx, p.k);
}

template <class Root>
void MechanicalOperations<Root>::split() {
  forces().split();
}

template <class Root>
void MechanicalOperations<Root>::formPattern() {
  root.withLinearSolverIfAny([&](auto& linear) {
    if constexpr (needs_pattern<std::decay_t<decltype(linear)>>) linear.init(*this);
  });
}

template <class Root>
void MechanicalOperations<Root>::solveSystem(MatrixFactors factors, MultiVecDeriv& x, MultiVecDeriv& b) {
  root.withLinearSolver([&](auto& linear) { linear.solve(*this, factors, x, b); });
}

template <class Root>
bool MechanicalOperations<Root>::solveSystemIfAny(MatrixFactors factors, MultiVecDeriv& x, MultiVecDeriv& b) {
  bool found = false;
  root.withLinearSolverIfAny([&](auto& linear) {
    linear.solve(*this, factors, x, b);
    found = true;
  });
  return found;
}

template <class Root>
bool MechanicalOperations<Root>::solveSystemAgain(MatrixFactors factors, MultiVecDeriv& x, MultiVecDeriv& b) {
  bool found = false;
  root.withLinearSolverIfAny([&](auto& linear) {
    if constexpr (HasSolveAgain<std::decay_t<decltype(linear)>>)
      linear.solveAgain(*this, x, b);
    else
      linear.solve(*this, factors, x, b);
    found = true;
  });
  return found;
}

template <class Root>
double MechanicalOperations<Root>::kineticEnergy() {
  static_assert(!Root::distributed, "Sinew: the energies of a distributed scene are not added up yet.");
  return forces().kineticEnergy();
}

template <class Root>
double MechanicalOperations<Root>::potentialEnergy() {
  static_assert(!Root::distributed, "Sinew: the energies of a distributed scene are not added up yet.");
  return forces().potentialEnergy();
}

}  // namespace sinew
