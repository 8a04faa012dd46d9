// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/core/step_warnings.hpp>
#include <sinew/lagrangian/constrained_motion.hpp>
#include <sinew/scene/collision.hpp>
#include <sinew/scene/constraint_response.hpp>
#include <sinew/scene/contact_rows.hpp>
#include <sinew/scene/fluid_boundaries.hpp>
#include <sinew/scene/mechanical_operations.hpp>
#include <sinew/scene/motion_problem.hpp>
#include <sinew/scene/overlap_warnings.hpp>
#include <sinew/scene/row_names.hpp>
#include <sinew/scene/solvers.hpp>
#include <sinew/scene/states_of.hpp>
#include <sinew/scene/turning_constraints.hpp>
#include <sinew/solver/multi_vec.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <string_view>
#include <utility>

namespace sinew {

/// A step of a scene whose root has an animation loop: bodies move freely, the constraints of the scene are
/// solved together, and bodies are corrected. While constraints are solved `position` is that at the start of
/// the step, at which mappings and masses stand, and `freePosition` that of the free motion, for a mapped
/// state as the way of its parents says.
template <class RootScope>
struct ConstrainedStep {
  RootScope const& root;
  double time, dt;
  StepNotes notes;

  void integrate(ConstrainedMotion& motion, bool velocityFirst, bool keepsForces) const;

 private:
  // The forces of the multipliers of the last step on mapped states, where these are now: mappings that are
  // not linear turn them in this step, which their geometric stiffness tells the system of the free motion.
  void forceMapped(ConstrainedMotion& m, bool ofVelocity) const {
    [[maybe_unused]] const auto span = root.span(Phase::constraint);
    traverse(root, on<role::State>([](auto& s, auto const&) {
               if constexpr (requires { s.multiplierForce; })
                 if (!s.multiplierForce.empty()) s.multiplierForce.clear(), forceOf(s);
             }));
    m.rows.ofVelocity = ofVelocity;
    traverse(root, on<role::LagrangianConstraint>([&](auto& c, auto const& scope) {
               if constexpr (KeepsMultipliers<std::decay_t<decltype(c)>>)
                 if (!c.multipliers.empty()) forceMapped(c, scope, m.rows);
             }));
    traverse_back(root, on<role::Mapping>([&](auto& mapping, auto const& scope) {
                    using M = std::decay_t<decltype(mapping)>;
                    scope.withMapped(mapping, [&](auto& it, auto& child, auto& parent) {
                      if constexpr (requires { child.multiplierForce, parent.multiplierForce; })
                        if (!child.multiplierForce.empty() && goesOn<M>(scope))
                          it.applyJT(forceOf(parent), child.multiplierForce);
                    });
                  }));
  }
  // whether what a mapping brings to its parent is asked for there: no one asks a state that is not mapped;
  // of several parents each may be
  template <class M, class S>
  static bool goesOn(S const& scope) {
    if constexpr (HasParents<M>)
      return true;
    else
      return scope.parentScope().stateScope().mapped();
  }
  template <class C, class S>
  void forceMapped(C& c, S const& scope, ConstraintRows& rows) const {
    using D = typename C::DataTypes;
    auto now = [&](auto const& at) {
      auto& s = at.template state<D>();
      return ConstrainedState<D>{s.position, s.position, s.velocity, s.restPosition, dt};
    };
    auto add = [&](auto const& at, int side) {
      if (!at.stateScope().mapped() || c.multipliers.size() != std::size_t(rows.count())) return;
      auto& f = forceOf(at.template state<D>());
      for (ConstraintRows::Entry const& e : rows.entries)
        for (int i = 0; e.side == side && i < e.size; ++i)
          f[std::size_t(e.point)][i] +=
              typename D::Real(c.multipliers[std::size_t(e.row)] * e.values[std::size_t(i)]);
    };
    rows.clear();
    with_scopes_of(c, scope, [&](auto const&... at) {
      if (!(at.stateScope().mapped() || ...)) return;
      c.addRows(rows, now(at)...);
      int side = 0;
      (add(at, side++), ...);
    });
  }
  template <class State>
  static auto& forceOf(State& s) {
    s.multiplierForce.resize(s.position.size(), State::DataTypes::Deriv::Zero());
    return s.multiplierForce;
  }

  template <class Ode, class S>
  void moveFreely(Ode& ode, S const& scope, bool keepsForces) const {
    MechanicalOperations<S> operations(scope, time, dt);
    if constexpr (!stands_beside<Ode>) {
      operations.eq(vec_id::freePosition, vec_id::position);  // the start, for now
      operations.acted.begin(keepsForces);
    }
    ode.solve(operations, dt);
    operations.projectPositionAndVelocity(time + dt, vec_id::position, vec_id::velocity);
    end_acted_forces<Ode>(operations);
    FluidBoundaries<RootScope>{root}.giveForces(scope);
  }
  // states as they were, mappings as they were, and where all would come to be: what a mapping moves goes by
  // its Jacobian as far as its parents do
  template <class S>
  void lookFromStart(S const& scope, bool hostMakesRows) const {
    MechanicalOperations<S> operations(scope, time, dt);
    operations.forEachIndependent([hostMakesRows](auto& s) {
      using D = typename std::decay_t<decltype(s)>::DataTypes;
      s.position.swap(s.freePosition);
      VectorOperations<D>::difference(
          s[vec_id::dx], std::as_const(s.position), std::as_const(s.freePosition));
      if (!hostMakesRows) return;
      VectorOperations<D>::bringToHost(s.position);  // rows look at them
      VectorOperations<D>::bringToHost(s.freePosition);
    });
    operations.propagate(vec_id::position, vec_id::velocity);
    operations.propagate(vec_id::dx);
    operations.forEachMapped([&](auto& s) {
      using D = typename std::decay_t<decltype(s)>::DataTypes;
      s.freePosition = s.position;
      VectorOperations<D>::move(s.freePosition, s[vec_id::dx], typename D::Real(1));
    });
  }

  void collectRows(ConstrainedMotion& m, bool ofVelocity, bool keepsForces, bool mayStand) const {
    [[maybe_unused]] const auto span = root.span(Phase::constraint);
    const bool sameContacts = finishContacts();
    m.stands = sameContacts && mayStand && !keepsForces && m.lastRows.ofVelocity == ofVelocity;
    if (m.stands) {
      std::swap(m.rows, m.lastRows);
      ContactRows<RootScope>{root, dt}.guessAgain(m);
      m.owesViolations = m.mayStand = true;
      return;
    }
    m.owesViolations = false;
    m.rows.clear();
    m.rows.ofVelocity = ofVelocity;
    m.rowsOf.clear();
    for (auto& system : m.systems) system.clear();
    traverse(root,
             on<role::LagrangianConstraint>([&](auto& c, auto const& scope) { addRowsOf(c, scope, m); }));
    m.contactRows = m.rows.count();
    ContactRows<RootScope>{root, dt}.add(m);
    std::size_t number = 0;
    for_each_integrator(root, [&](auto& ode, auto const& scope) {
      ConstrainedSystem& system = m.systems[number++];
      if (keepsForces) system.whole = system.jacobian;
      project(scope, MultiplierResponse::of(ode, dt), m.room, system);
    });
    warnOfFixed(m);
    m.mayStand = m.owesViolations && !keepsForces && !any_below<role::LagrangianConstraint>(root) &&
                 !any_below<role::ProjectiveConstraint>(root);
  }
  // contacts of bodies that are fixed where they touch
  void warnOfFixed(ConstrainedMotion& m) const {
    m.acts.assign(std::size_t(m.rows.count()), 0);
    for (ConstrainedSystem const& system : m.systems)
      for (std::size_t k = 0; k < system.rows.size(); ++k)
        if (system.jacobian.first[k + 1] > system.jacobian.first[k]) m.acts[std::size_t(system.rows[k])] = 1;
    for (ConstraintBlock const& b : m.rows.blocks) {
      auto const* const of = m.acts.data() + std::size_t(b.first);
      if (b.first >= m.contactRows && std::none_of(of, of + b.rows, [](char acts) { return acts; }))
        notes.warn(
            RowNames<RootScope>{root, m}.of(b.first).where, "nothing that touches there can move", [&] {
              return "nothing that touches there can move: points on both sides are fixed, so that it has no "
                     "force "
                     "and they stay in each other where they are; put both models into one group, or set "
                     "simulated=\"false\" for one that never moves";
            });
    }
  }
  // those that are found behind the free motion; whether all are as in the last step
  bool finishContacts() const {
    int searches = 0, same = 0;
    if constexpr (collides<RootScope>)
      Collision<RootScope>{root}.finish(dt, [&](auto const& pipeline, auto const& manager, bool sameRows) {
        warn_of_overlaps(notes, pipeline, manager);
        ++searches;
        same += sameRows;
      });
    return searches == 1 && same == 1;
  }
  template <class D, class State>
  ConstrainedState<D> seen(State const& s) const {
    return {s.position, s.freePosition, s.velocity, s.restPosition, dt};
  }
  template <class C, class S>
  void addRowsOf(C& c, S const& scope, ConstrainedMotion& m) const {
    using D = typename C::DataTypes;
    const int before = m.rows.count();
    m.rows.entries.clear();
    std::array<ConstrainedSystem*, 2> systems{};
    with_states_of(c, scope, [&](auto const&... s) {
      if constexpr (SetsViolations<C>)
        c.addJacobian(m.rows);
      else
        c.addRows(m.rows, seen<D>(s)...);
      systems = {systemOf(s, m)...};
    });
    with_dofs_of(c, scope, [&](auto const& first, auto const& second) {
      for (ConstraintRows::Entry const& e : m.rows.entries)
        e.side == 0 ? expand(e, first, systems[0]) : expand(e, second, systems[1]);
    });
    if constexpr (SetsViolations<C>)
      with_states_of(c, scope, [&](auto const&... s) { c.setViolations(m.rows, before, seen<D>(s)...); });
    const auto count = std::size_t(m.rows.count() - before);
    m.rowsOf.push_back(int(count));
    if constexpr (KeepsMultipliers<C>)
      if (c.multipliers.size() == count)
        std::copy(c.multipliers.begin(), c.multipliers.end(), m.rows.multipliers.begin() + before);
  }

  // of the solver that moves a state; null where there is none
  template <class State>
  static ConstrainedSystem* systemOf(State const& s, ConstrainedMotion& m) {
    return s.solver < 0 ? nullptr : &m.systems[std::size_t(s.solver)];
  }
  // adds an entry of a row over the points of a state to that system
  template <class Dofs>
  static void expand(ConstraintRows::Entry const& e, Dofs const& dofs, ConstrainedSystem* system) {
    if (!system) return;
    expand_point(dofs, e.point, [&](int dof, int columns, double const* j) {
      for (int i = 0; columns == 0 && i < e.size; ++i) system->add(e.row, dof + i, e.values[std::size_t(i)]);
      for (int c = 0; c < columns; ++c) {
        double value = 0;
        for (int i = 0; i < e.size; ++i) value += e.values[std::size_t(i)] * j[e.size * c + i];
        system->add(e.row, dof + c, value);
      }
    });
  }

  // whether the rows of this step are all of contacts that states find
  bool hostMakesRows() const {
    bool byStates = false;
    traverse(root, on<role::CollisionPipeline>([&](auto& pipeline, auto const&) {
               if constexpr (requires { pipeline.begun; }) byStates = pipeline.begun;
             }));
    return !byStates || any_below<role::LagrangianConstraint>(root);
  }

  // J P, where P is what projective constraints leave of a motion
  template <class S>
  void project(S const& scope, MultiplierResponse const& how, JacobianRows& left,
               ConstrainedSystem& system) const {
    system.joined = false;
    if (system.rows.empty() || !any_below<role::ProjectiveConstraint>(scope)) return;
    MechanicalOperations<S> operations(scope, time, dt);
    auto projected = [&] {
      operations.scatter(how.force(), system.force);
      operations.projectResponse(how.force());
      operations.gather(system.motion, how.force());
    };
    // numbers that no two neighbours share, exact in single precision: what stays as it is is free, what
    // becomes 0 fixed
    for (int i = 0; i < system.dofs(); ++i) system.force[i] = 1 + (i * 619 % 1024) / 1024.0;
    projected();
    bool mixes = false;
    for (int i = 0; i < system.dofs(); ++i)
      mixes = mixes || (system.motion[i] != 0 && system.motion[i] != system.force[i]);
    left.clear();
    if (!mixes) {
      system.force = system.motion;  // 0 where fixed
      for (int k = 0; k < system.jacobian.rows(); ++k) {
        system.jacobian.forEachInRow(k, [&](int dof, double value) {
          if (system.force[dof] != 0) left.add(dof, value);
        });
        left.endRow();
      }
    } else {
      system.joined = true;
      for (int k = 0; k < system.jacobian.rows(); ++k) {
        system.force.setZero();
        system.jacobian.addTransposed(k, 1, system.force);
        projected();
        for (int i = 0; i < system.dofs(); ++i)
          if (system.motion[i] != 0) left.add(i, system.motion[i]);
        left.endRow();
      }
    }
    std::swap(left, system.jacobian);
  }

  // d_free, and W = J A^-1 J' as a matrix or as its factors
  void findCompliance(ConstrainedMotion& m, bool built) const;
  // joins the rows of all systems, and what they do to these
  void joinAnswers(ConstrainedMotion& m) const {
    UnbuiltCompliance& W = m.problem.unbuilt;
    W.clear();
    int dofs = 0;
    for (ConstrainedSystem& system : m.systems) {
      system.begin = dofs;
      dofs += system.dofs();
    }
    m.motionRows.next.assign(m.systems.size(), 0);
    for (int row = 0; row < m.rows.count(); ++row) {
      for (std::size_t number = 0; number < m.systems.size(); ++number) {
        ConstrainedSystem const& system = m.systems[number];
        std::size_t& next = m.motionRows.next[number];
        if (next == system.rows.size() || system.rows[next] != row) continue;
        system.jacobian.forEachInRow(
            int(next), [&](int dof, double value) { W.jacobian.add(system.begin + dof, value); });
        system.answers.forEachInRow(int(next),
                                    [&](int dof, double value) { W.answers.add(system.begin + dof, value); });
        ++next;
      }
      W.jacobian.endRow();
      W.answers.endRow();
    }
    W.begin(m.problem.blocks, dofs);
  }
  void checkFinite(ConstrainedMotion const& m) const {
    ConstraintProblem const& p = m.problem;
    for (ConstraintBlock const& b : p.blocks)
      for (int i = 0; i < b.rows; ++i)
        if (!std::isfinite(p.own(b)(i, i)) || !std::isfinite(p.freeViolation[b.first + i]))
          RowNames<RootScope>{root, m}.refuseNotFinite(b.first + i);
  }
  void checkCompliance(ConstrainedMotion const& m) const {
    for (ConstraintBlock const& b : m.problem.blocks)
      for (int i = 0; i < b.rows && b.first + i < m.contactRows; ++i)
        if (!(m.problem.own(b)(i, i) > 0)) RowNames<RootScope>{root, m}.refuseFixed(b.first + i);
  }

  void solve(ConstrainedMotion& m) const {
    [[maybe_unused]] const auto span = root.span(Phase::constraint);
    bool solved = false;
    traverse(root, on<role::ConstraintSolver>([&](auto& solver, auto const& scope) {
               if (std::exchange(solved, true)) return;
               if constexpr (SolvesMotion<std::decay_t<decltype(solver)>>) {
                 MotionProblem<RootScope>{root, time, dt, notes}.solve(m, solver, scope.path());
                 m.hasMotion = true;
               } else {
                 ContactRows<RootScope>{root, dt}.putViolations(m);
                 findCompliance(m, !takes_unbuilt(solver));
                 solveProblem(m, solver, scope.path());
               }
             }));
  }
  static constexpr int mostProducts = 3000;  // rows of which equalities are compared for a message
  template <class Solver>
  void solveProblem(ConstrainedMotion& m, Solver& solver, std::string_view where) const {
    try {
      solver.solve(m.problem, where);
    } catch (Error const& error) {
      const RowNames<RootScope> names{root, m};
      ConstraintProblem const& p = m.problem;
      if constexpr (SaysUnsolved<Solver>)
        if (!solver.result.converged) throw Error({}, text(error.what(), unsolved(m)));
      if constexpr (requires { solver.refusedRow; })
        if (solver.refusedRow >= 0) names.explain(error, "the first", solver.refusedRow);
      names.explain(error,
                    "the first that depends on others",
                    p.rows() > mostProducts
                        ? -1
                        : dependent_equalities(p.blocks, p.products(p.rows()), p.rows()).first);
    }
    if (has_solved(solver))
      warn_of_dependent(root, m, notes, where, [&](int end) {
        return dependent_equalities(m.problem.blocks, m.problem.products(end), end);
      });
    else if constexpr (SaysUnsolved<Solver>)
      notes.warn(
          where, "the constraints are not solved", [&] { return text(solver.unsolved(), unsolved(m)); });
  }
  std::string unsolved(ConstrainedMotion const& m) const {
    ConstraintProblem const& p = m.problem;
    return text("; the residual is ",
                p.residual(),
                " m",
                RowNames<RootScope>{root, m}.unsolved(
                    furthest_row(p.blocks, p.violation()),
                    p.rows() > mostProducts
                        ? Contradiction{}
                        : contradicting_equality(p.blocks, p.products(p.rows()), p.freeViolation)));
  }
  // constraints keep their multipliers
  void giveBack(ConstrainedMotion& m) const {
    std::size_t number = 0;
    double const* f = m.problem.multipliers.data();
    traverse(root, on<role::LagrangianConstraint>([&](auto& c, auto const&) {
               double const* const end = f + m.rowsOf[number++];
               if constexpr (KeepsMultipliers<std::decay_t<decltype(c)>>) c.multipliers.assign(f, end);
               f = end;
             }));
    traverse(root, on<role::ConstraintSolver>([&](auto& solver, auto const&) {
               if constexpr (requires { solver.constraintForces; })
                 if (solver.computeConstraintForces)
                   solver.constraintForces.assign(m.problem.multipliers.data(),
                                                  m.problem.multipliers.data() + m.rows.count());
             }));
  }

  template <class S>
  void correct(ConstraintResponse<S> const& response, ConstrainedMotion const& m, bool keepsForces) const {
    MultiplierResponse const& how = response.how;
    ConstrainedSystem& system = response.system;
    MechanicalOperations<S> operations(response.scope, time, dt);
    auto takeFree = [&] { operations.forEachIndependent([](auto& s) { s.position.swap(s.freePosition); }); };
    if (system.rows.empty()) return takeFree();
    if (!m.hasMotion) {
      system.force.setZero();
      for (int k = 0; k < system.jacobian.rows(); ++k)
        system.jacobian.addTransposed(k, m.problem.multipliers[system.rows[std::size_t(k)]], system.force);
      response.respond();
    }
    if (keepsForces) keep(operations, how, m, system);
    if (!m.rows.ofVelocity) takeFree();
    response.move(m.rows.ofVelocity);
    if (m.rows.ofVelocity) operations.peq(vec_id::position, vec_id::velocity, dt);
  }
  // What multipliers and what they move have done over the step. With A u = impulse J' f the forces of the
  // system change by -(A - M) u / impulse, and those of contacts are forces too; the reaction of points is
  // that of the multipliers of constraints, and what holds points that do not follow, (1 - P) (A u / impulse
  // - J' f).
  template <class Operations>
  static void keep(Operations& operations, MultiplierResponse const& how, ConstrainedMotion const& m,
                   ConstrainedSystem& system) {
    constexpr DerivId held = vec_id::marked, follows = vec_id::startVelocity;
    const double s = 1 / how.factors.impulse;
    const MatrixFactors a = how.factors.matrix;
    operations.addMBKdx(
        vec_id::applied, how.motion(), {.m = a.m == 0 ? 0 : (1 - a.m) * s, .b = -a.b * s, .k = -a.k * s});
    operations.clear(held);
    operations.addMBKdx(held, how.motion(), {.m = a.m * s, .b = a.b * s, .k = a.k * s});
    for (const bool ofContacts : {false, true}) {
      system.force.setZero();
      for (int k = 0; k < system.whole.rows(); ++k)
        if (const int row = system.rows[std::size_t(k)]; (row >= m.contactRows) == ofContacts)
          system.whole.addTransposed(k, m.problem.multipliers[row], system.force);
      operations.scatter(how.force(), system.force);
      operations.peq(held, how.force(), -1);
      operations.peq(ofContacts ? vec_id::applied : vec_id::reaction, how.force(), 1);
    }
    operations.eq(follows, held);
    operations.projectResponse(follows);
    operations.peq(vec_id::reaction, held, 1);
    operations.peq(vec_id::reaction, follows, -1);
  }
};

// Outside the class, so that a program may have them instantiated in one place: runtime/precompiled.hpp.

template <class RootScope>
void ConstrainedStep<RootScope>::integrate(ConstrainedMotion& m, bool velocityFirst, bool keepsForces) const {
  std::size_t system = 0;
  for_each_integrator(root, [&](auto& ode, auto const& scope) {
    ConstraintResponse<std::decay_t<decltype(scope)>>{scope, ode, time, dt, m.systems[system++]}.prepare();
  });
  ++m.step;
  std::swap(m.rows, m.lastRows);
  const bool mayStand = std::exchange(m.mayStand, false);  // not behind an Error
  forceMapped(m, velocityFirst);
  for_each_solver(root, [&](auto& ode, auto const& scope) { moveFreely(ode, scope, keepsForces); });
  const bool ofHost = hostMakesRows();
  for_each_integrator(root, [&](auto&, auto const& scope) { lookFromStart(scope, ofHost); });
  collectRows(m, velocityFirst, keepsForces, mayStand);
  m.hasMotion = false;
  if (m.rows.count() > 0) solve(m);
  if (m.newtonIterations > 0 && m.rows.count() > 0)
    TurningConstraints<RootScope>{root, time, dt, notes}.hold(m, [&] { solve(m); });
  giveBack(m);
  std::size_t number = 0;
  for_each_integrator(root, [&](auto& ode, auto const& scope) {
    using S = std::decay_t<decltype(scope)>;
    const ConstraintResponse<S> response(scope, ode, time, dt, m.systems[number++]);
    correct(response, m, keepsForces);
    MechanicalOperations<S> operations(scope, time, dt);
    if constexpr (requires { ode.corrected(operations, response.how.motion(), m.rows.ofVelocity); })
      if (!response.system.rows.empty()) ode.corrected(operations, response.how.motion(), m.rows.ofVelocity);
    operations.projectPositionAndVelocity(time + dt, vec_id::position, vec_id::velocity);
    operations.propagate(vec_id::position, vec_id::velocity);
  });
  ContactRows<RootScope>{root, dt}.giveBack(m);  // a device goes on meanwhile
}

template <class RootScope>
void ConstrainedStep<RootScope>::findCompliance(ConstrainedMotion& m, bool built) const {
  [[maybe_unused]] const auto span = root.span(Phase::constraint);
  ConstraintProblem& problem = m.problem;
  const int n = m.rows.count();
  problem.blocks = m.rows.blocks;
  problem.timeStep = dt;
  problem.freeViolation = Eigen::Map<Eigen::VectorXd const>(m.rows.violation.data(), n);
  problem.multipliers = Eigen::Map<Eigen::VectorXd const>(m.rows.multipliers.data(), n);
  problem.built = built;
  if (built) problem.compliance.setZero(n, n);
  auto forEachResponse = [&](auto&& f) {
    std::size_t number = 0;
    for_each_integrator(root, [&](auto& ode, auto const& scope) {
      ConstrainedSystem& system = m.systems[number++];
      if (system.rows.empty()) return;
      using Response = ConstraintResponse<std::decay_t<decltype(scope)>>;
      f(ode, Response(scope, ode, time, dt, system), SystemCompliance{system.rows, problem});
    });
  };
  forEachResponse([&](auto& ode, auto const& response, SystemCompliance const& to) {
    response.prepareSystem(ode);
    if (built)
      response.addCompliance(m.factored, m.motionRows.jacobian, m.rows.ofVelocity, to);
    else
      response.findAnswers(m.rows.ofVelocity);
  });
  if (!built) {
    joinAnswers(m);
    forEachResponse([](auto&, auto const& response, SystemCompliance const& to) { response.regularize(to); });
  }
  checkFinite(m);
  ContactRows<RootScope>::leaveOutFixed(m);
  checkCompliance(m);
  for (int i = 0; i < n; ++i) problem.add(i, i, m.rows.compliance[std::size_t(i)]);
}

}  // namespace sinew
