// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/lagrangian/constrained_motion.hpp>
#include <sinew/scene/mechanical_operations.hpp>
#include <sinew/solver/multi_vec.hpp>

#include <algorithm>
#include <cstddef>
#include <type_traits>
#include <utility>

namespace sinew {

/// A linear solver that may have a factor of the matrix of its last solve, by which rows have their
/// compliance (linalg/factored_rows.hpp): blockFactor() is that, or null.
template <class Linear>
concept HasBlockFactor = requires(Linear const& linear) {
  linear.blockFactor()->lower;
  linear.blockFactor()->newIndex;
};

/// What the bodies of one ODE solver, at and below a scope, do when multipliers act on them: the system of
/// the solver, or the masses where it is explicit, answers for each state that has no correction of its own.
template <class S>
struct ConstraintResponse {
  using Operations = MechanicalOperations<S>;
  S const& scope;
  double time, dt;
  MultiplierResponse how;
  ConstrainedSystem& system;

  template <class Ode>
  ConstraintResponse(S const& s, Ode const& ode, double t, double h, ConstrainedSystem& of)
      : scope(s), time(t), dt(h), how(MultiplierResponse::of(ode, h)), system(of) {
    forEachCorrection([&](auto& c, auto const&) {
      if constexpr (ScalesCompliance<std::decay_t<decltype(c)>>) {
        how.factors.position *= c.complianceFactor;
        how.factors.velocity *= c.complianceFactor;
      }
    });
  }

  /// What corrections have to know of the system at rest, before the step.
  void prepare() const;

  /// Has the system of an ODE solver that has not solved it in this step made ready for answers.
  template <class Ode>
  void prepareSystem([[maybe_unused]] Ode& ode) const {
    if constexpr (requires(Operations operations) { ode.prepareCorrection(operations); }) {
      if (allCorrected()) return;
      Operations operations(scope, time, dt);
      operations.derivsTaken = how.derivs;
      ode.prepareCorrection(operations);
    }
  }

  /// Adds J A^-1 J' times what a multiplier is and what of it is reached.
  void addCompliance(FactoredRows& factored, JacobianRows& room, bool ofVelocity, SystemCompliance to) const {
    beginCorrections();
    const SystemCompliance reached = to.times(reachedBy(ofVelocity));
    if (!addByFactor(factored, reached)) {
      if (answersByPoint())
        addByPoints(room, reached);
      else
        forEachResponse([&](int k) {
          for (int l = k; l < system.jacobian.rows(); ++l)
            reached(k, l, system.jacobian.times(l, system.motion));
        });
    }
    regularize(to);
  }

  /// The rows of (A^-1 J')' times the same, for a W that is not built: system.answers.
  void findAnswers(bool ofVelocity) const {
    beginCorrections();
    if (answersByPoint()) {
      answerByPoints(system.answers);
    } else {
      system.answers.clear();
      forEachResponse([&](int) {
        for (int i = 0; i < system.dofs(); ++i)
          if (system.motion[i] != 0) system.answers.add(i, system.motion[i]);
        system.answers.endRow();
      });
    }
    for (double& value : system.answers.values) value *= reachedBy(ofVelocity);
  }
  /// What corrections add to the compliance of each of the rows, as their fields say.
  void regularize(SystemCompliance to) const {
    forEachCorrection([&](auto& c, auto const& at) {
      using C = std::decay_t<decltype(c)>;
      if constexpr (Regularizes<C>) {
        if (!(c.regularizationTerm > 0)) return;
        for (int k = 0; k < system.jacobian.rows(); ++k) {
          bool acts = false;
          auto look = [&](auto& s) {
            const int end = s.dofOffset + int(s.size()) * std::decay_t<decltype(s)>::DataTypes::size;
            system.jacobian.forEachInRow(k, [&](int dof, double value) {
              acts = acts || (value != 0 && dof >= s.dofOffset && dof < end);
            });
          };
          if constexpr (CorrectsState<C>)
            look(at.template state<typename C::DataTypes>());
          else
            MechanicalOperations<std::decay_t<decltype(at)>>(at).forEachIndependent(look);
          if (acts) to(k, k, how.factors.impulse * c.regularizationTerm);
        }
      }
    });
  }

  /// motion = A^-1 (impulse J' f) of the system for its force; the vector of states how.motion() has it too.
  void respond() const {
    Operations operations(scope, time, dt);
    operations.derivsTaken = how.derivs;  // what a solver keeps from step to step is in these
    MultiVecDeriv<Operations> b(operations), u(operations);
    operations.scatter(b.id, system.force);
    operations.projectResponse(b.id);
    u.clear();
    if (!allCorrected()) respondBySystem(operations, u, b);
    respondByCorrections(u.id, b.id);
    operations.projectResponse(u.id);
    operations.gather(system.motion, u.id);
  }

  /// Velocities take the motion, and positions unless these move by velocities.
  void move(bool ofVelocity) const {
    Operations operations(scope, time, dt);
    operations.peq(vec_id::velocity, how.motion(), how.factors.velocity);
    if (!ofVelocity) operations.peq(vec_id::position, how.motion(), how.factors.position);
    forEachCorrection([&](auto& c, auto const& at) {
      using C = std::decay_t<decltype(c)>;
      if constexpr (CorrectsState<C> && MovesByOwnFactors<C>) {
        using D = typename C::DataTypes;
        using V = VectorOperations<D>;
        auto& s = at.template state<D>();
        const ConstraintFactors own = c.moved(how.factors, dt, ofVelocity);
        if (const double more = own.velocity - how.factors.velocity; more != 0)
          V::peq(OneThread{}, s.velocity, s[how.motion()], typename D::Real(more));
        if (const double more = own.position - how.factors.position; more != 0 && !ofVelocity)
          V::move(s.position, s[how.motion()], typename D::Real(more));
      }
    });
  }

 private:
  double reachedBy(bool ofVelocity) const { return ofVelocity ? how.factors.velocity : how.factors.position; }
  void beginCorrections() const {
    forEachCorrection([&](auto& c, auto const& at) {
      using C = std::decay_t<decltype(c)>;
      if constexpr (CorrectsState<C> && BeginsCorrections<C>)
        c.beginCorrections(at.template state<typename C::DataTypes>().position);
    });
  }
  template <class F>
  void forEachCorrection(F&& f) const {
    traverse(scope, on<role::ConstraintCorrection>([&f](auto& c, auto const& at) { f(c, at); }));
  }
  // whether a state has a correction of its own, of a kind
  template <class State, class Kind>
  bool isCorrected(State const& state, Kind&& kind) const {
    bool found = false;
    forEachCorrection([&](auto& c, auto const& at) {
      using C = std::decay_t<decltype(c)>;
      if constexpr (CorrectsState<C>)
        // states of one system have their own degrees of freedom each
        found = found || (kind(c) && at.template state<typename C::DataTypes>().dofOffset == state.dofOffset);
    });
    return found;
  }
  template <class State>
  bool isCorrected(State const& state) const {
    return isCorrected(state, [](auto&) { return true; });
  }
  template <bool Wanted, class F>
  bool each(F&& f) const {
    bool all = true;
    Operations(scope).forEachIndependent([&](auto& s) { all = all && f(s) == Wanted; });
    return all;
  }
  bool allCorrected() const {
    return each<true>([&](auto& s) { return isCorrected(s); });
  }
  bool noneCorrected() const {
    return each<false>([&](auto& s) { return isCorrected(s); });
  }
  // the masses answer for states without a correction
  bool byMasses(Operations& operations) const {
    const bool ofForces = how.factors.matrix.b != 0 || how.factors.matrix.k != 0;
    return !(how.bySystem && (ofForces || !operations.massIsDiagonal()));
  }

  bool addByFactor(FactoredRows& factored, SystemCompliance const& add) const {
    bool found = false;
    Operations operations(scope, time, dt);
    if (!byMasses(operations) && noneCorrected())
      scope.withLinearSolverIfAny([&](auto& linear) {
        if constexpr (HasBlockFactor<std::decay_t<decltype(linear)>>) {
          auto const* factor = linear.blockFactor();
          if (!factor) return;
          factored.compliance(*factor, system.jacobian, add.times(how.factors.impulse));
          found = true;
        }
      });
    return found;
  }
  // f(row) for each, with what it does as a force in system.motion
  template <class F>
  void forEachResponse(F&& f) const {
    for (int k = 0; k < system.jacobian.rows(); ++k) {
      system.force.setZero();
      system.jacobian.addTransposed(k, 1, system.force);
      respond();
      f(k);
    }
  }

  bool answersByPoint() const {
    Operations operations(scope, time, dt);
    return !system.joined && each<true>([&](auto& s) {
      if (isCorrected(s, [](auto& c) { return !AnswersByPoint<std::decay_t<decltype(c)>>; })) return false;
      return isCorrected(s) || byMasses(operations);
    });
  }
  // each row moves its own points only
  void answerByPoints(JacobianRows& room) const {
    findPointAnswers();
    room.clear();
    room.reserve(system.jacobian.rows(), 6 * int(system.jacobian.values.size()));
    for (int k = 0; k < system.jacobian.rows(); ++k) {
      system.jacobian.forEachInRow(k, [&](int dof, double value) {
        const int begin = system.pointBegin[std::size_t(dof)], size = system.pointSize[std::size_t(dof)];
        for (int i = 0; i < size; ++i)
          if (const double u = system.pointAnswers(begin + i, dof - begin); u != 0)
            room.add(begin + i, value * u);
      });
      room.endRow();
    }
  }
  // J C of all rows, then its products with J
  void addByPoints(JacobianRows& room, SystemCompliance const& add) const {
    answerByPoints(room);
    system.motion.setZero();
    for (int k = 0; k < room.rows(); ++k) {
      room.addTransposed(k, 1, system.motion);
      for (int l = k; l < room.rows(); ++l)
        if (const double w = system.jacobian.times(l, system.motion); w != 0) add(k, l, w);
      room.forEachInRow(k, [&](int dof, double) { system.motion[dof] = 0; });
    }
  }
  // what unit forces do that act on all points at the same time, one direction after the other
  void findPointAnswers() const {
    Operations operations(scope, time, dt);
    operations.derivsTaken = how.derivs;
    MultiVecDeriv<Operations> b(operations), u(operations);
    int directions = 0;
    if (system.pointBegin.empty()) system.pointBegin.resize(std::size_t(system.dofs()));
    system.pointSize.resize(system.pointBegin.size());
    operations.forEachIndependent([&](auto& s) {
      constexpr int size = std::decay_t<decltype(s)>::DataTypes::size;
      directions = std::max(directions, size);
      for (int dof = s.dofOffset; dof < s.dofOffset + int(s.size()) * size; ++dof) {
        system.pointBegin[std::size_t(dof)] = dof - (dof - s.dofOffset) % size;
        system.pointSize[std::size_t(dof)] = size;
      }
    });
    system.pointAnswers.resize(system.motion.size(), directions);
    for (int c = 0; c < directions; ++c) {
      operations.forEachIndependent([&](auto& s) {
        using D = typename std::decay_t<decltype(s)>::DataTypes;
        const typename D::Deriv unit = c < D::size ? D::Deriv::Unit(c) : typename D::Deriv(D::Deriv::Zero());
        for (auto& f : s[b.id]) f = unit;
      });
      u.clear();
      traverse(scope, on<role::Mass>([&](auto& mass, auto const& at) {
                 if (at.stateScope().mapped()) return;
                 auto& s = at.template state<typename std::decay_t<decltype(mass)>::DataTypes>();
                 mass.accFromF(s[u.id], s.position, s[b.id]);
               }));
      u.teq(how.factors.impulse);
      respondByCorrections(u.id, b.id);
      operations.gather(system.motion, u.id);
      system.pointAnswers.col(c) = system.motion;
    }
  }

  void respondBySystem(Operations& operations, MultiVecDeriv<Operations>& u,
                       MultiVecDeriv<Operations>& b) const {
    const bool mixed = !noneCorrected();
    if (mixed)
      operations.forEachIndependent([&](auto& s) {
        if (isCorrected(s))
          VectorOperations<typename std::decay_t<decltype(s)>::DataTypes>::clear(OneThread{}, s[b.id]);
      });
    b.teq(how.factors.impulse);
    if (byMasses(operations))
      operations.accFromF(u.id, b.id, vec_id::position);
    else
      operations.solveSystemAgain(how.factors.matrix, u, b);
    if (mixed) {
      operations.scatter(b.id, system.force);
      operations.projectResponse(b.id);
    }
  }
  // the first time with a matrix formed anew; an iterative solver goes on to rounding
  void solveToRounding(Operations& operations, MultiVecDeriv<Operations>& u, MultiVecDeriv<Operations>& b,
                       bool first) const {
    int iterations = 5000;
    double tolerance = 1e-14;
    auto withIterations = [&](auto&& f) {
      scope.withLinearSolverIfAny([&](auto& linear) {
        if constexpr (requires { linear.iterations, linear.tolerance; }) f(linear);
      });
    };
    withIterations([&](auto& linear) {
      iterations = std::exchange(linear.iterations, std::max(linear.iterations, iterations));
      tolerance = std::exchange(linear.tolerance, tolerance);
    });
    if (first)
      operations.solveSystemIfAny(how.factors.matrix, u, b);
    else
      operations.solveSystemAgain(how.factors.matrix, u, b);
    withIterations([&](auto& linear) {
      linear.iterations = iterations;
      linear.tolerance = tolerance;
    });
  }
  // by components that say what forces do to their states, in the place of what the system says
  void respondByCorrections(DerivId u, DerivId f) const {
    forEachCorrection([&](auto& c, auto const& at) {
      using C = std::decay_t<decltype(c)>;
      if constexpr (CorrectsState<C>) {
        using D = typename C::DataTypes;
        auto& s = at.template state<D>();
        VectorOperations<D>::clear(OneThread{}, s[u]);
        if constexpr (MayAnswerByMasses<C>)
          if (c.answersByMasses()) {
            at.stateScope().withMass([&](auto& mass) {
              if constexpr (std::is_same_v<typename std::decay_t<decltype(mass)>::DataTypes, D>)
                mass.accFromF(s[u], s.position, s[f]);
            });
            return VectorOperations<D>::teq(s[u], typename D::Real(how.factors.impulse));
          }
        c.addCorrection(s[u], s[f], s.position, how.factors);
      }
    });
  }

  template <class C, class At>
  void keepCompliance(C& c, At const& at) const;
};

template <class S>
void ConstraintResponse<S>::prepare() const {
  forEachCorrection([&](auto& c, auto const& at) {
    using C = std::decay_t<decltype(c)>;
    if constexpr (CorrectsState<C> && KeepsCompliance<C>)
      if (c.needsCompliance(dt)) keepCompliance(c, at);
  });
}

// The bodies are put at rest, where forces and their derivatives are asked for, and back again. An iterative
// solver goes on to rounding meanwhile.
template <class S>
template <class C, class At>
void ConstraintResponse<S>::keepCompliance(C& c, At const& at) const {
  auto& state = at.template state<typename C::DataTypes>();
  Operations operations(scope, time, dt);
  operations.derivsTaken = how.derivs;
  MultiVecDeriv<Operations> b(operations), u(operations);
  operations.eq(vec_id::freePosition, vec_id::position);
  operations.forEachIndependent([](auto& s) { s.position = s.restPosition; });
  operations.eq(vec_id::dx, vec_id::velocity);
  operations.clear(vec_id::velocity);
  operations.propagate(vec_id::position, vec_id::velocity);
  operations.computeForce(vec_id::force, vec_id::position, vec_id::velocity);
  const bool masses = byMasses(operations);
  for (int dof = 0; dof < int(state.size()) * C::DataTypes::size; ++dof) {
    system.force.setZero();
    system.force[state.dofOffset + dof] = 1;
    operations.scatter(b.id, system.force);
    operations.projectResponse(b.id);
    u.clear();
    if (masses)
      operations.accFromF(u.id, b.id, vec_id::position);
    else
      solveToRounding(operations, u, b, dof == 0);
    operations.projectResponse(u.id);
    c.setColumn(dof, state[u.id]);
  }
  c.keepCompliance(dt);
  if (!masses)
    scope.withLinearSolverIfAny([](auto& linear) {
      if constexpr (requires { linear.reset(); }) linear.reset();
    });
  operations.eq(vec_id::position, vec_id::freePosition);
  operations.eq(vec_id::velocity, vec_id::dx);
  operations.clear(vec_id::dx);  // where some solvers begin
  operations.propagate(vec_id::position, vec_id::velocity);
}

}  // namespace sinew
