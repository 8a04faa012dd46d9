// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/core/step_warnings.hpp>
#include <sinew/lagrangian/constrained_motion.hpp>
#include <sinew/scene/contact_rows.hpp>
#include <sinew/scene/mechanical_operations.hpp>
#include <sinew/scene/row_names.hpp>
#include <sinew/scene/solvers.hpp>
#include <sinew/scene/state_contacts.hpp>
#include <sinew/solver/linear_system.hpp>

#include <algorithm>
#include <cmath>
#include <string_view>
#include <type_traits>
#include <typeinfo>
#include <utility>
#include <vector>

namespace sinew {

/// The constraints of a step as a problem for the motion v = position u that multipliers add to the free one,
/// for constraint solvers that need no compliance W (SolvesMotion):
///   S v = J' f,   d = d_free + J v,   S = A / (impulse position)
/// over the degrees of freedom of all systems that have rows, one after the other; u is left in the vector
/// MultiplierResponse::motion of their states. A row that is soft, C, or
/// of a contact and along which nothing can move, has a degree of freedom of its own behind them, of which S
/// is 1/C.
template <class RootScope>
struct MotionProblem {
  RootScope const& root;
  double time, dt;
  StepNotes const& notes;

  template <class Solver>
  void solve(ConstrainedMotion& m, Solver& solver, std::string_view where) const {
    MotionRows& all = m.motionRows;
    int dofs = 0;
    forEachSystem(m, [&](auto& ode, auto const&, ConstrainedSystem& system) {
      system.begin = dofs;
      const auto factors = MultiplierResponse::of(ode, dt).factors;
      system.scale = 1 / (factors.impulse * (m.rows.ofVelocity ? factors.velocity : factors.position));
      dofs += system.dofs();
    });
    if (!solveByStates(m, solver, dofs, where)) {
      ContactRows<RootScope>{root, dt}.putViolations(m);
      forEachSystem(m, [&](auto& ode, auto const& scope, ConstrainedSystem& system) {
        assemble(scope, MultiplierResponse::of(ode, dt), system);
      });
      joinRows(m, dofs, [&] { return largestDiagonal(m); });
      blocksOf(m, all, solver.preconditioner.system);
      explained(m, solver, [&] {
        solver.solveMotion(
            [&](Eigen::VectorXd const& p, Eigen::VectorXd& q) { multiply(m, p, q); }, all, where);
      });
      forEachSystem(m, [&](auto& ode, auto const& scope, ConstrainedSystem& system) {
        const auto how = MultiplierResponse::of(ode, dt);
        system.motion.head(system.dofs()) = all.motion.segment(system.begin, system.dofs()) / reached(m, how);
        MechanicalOperations<std::decay_t<decltype(scope)>>(scope, time, dt)
            .scatter(how.motion(), system.motion);
      });
    }
    if constexpr (SaysUnsolved<Solver>)
      if (!solver.result.converged)
        notes.warn(
            where, "the constraints are not solved", [&] { return text(solver.unsolved(), unsolved(m)); });
    // rows of constraints stand first, and none of them is left out
    if (has_solved(solver))
      warn_of_dependent(root, m, notes, where, [&](int end) {
        return dependent_equalities(all.blocks, productsOf(all, end), end);
      });
    m.problem.multipliers.setZero(m.rows.count());
    for (std::size_t i = 0; i < all.rows.size(); ++i)
      m.problem.multipliers[all.rows[i]] = all.multipliers[Eigen::Index(i)];
  }

 private:
  // what is reached of u
  static double reached(ConstrainedMotion const& m, MultiplierResponse const& how) {
    return m.rows.ofVelocity ? how.factors.velocity : how.factors.position;
  }
  // f(ODE solver, its scope, its system) for those that have rows
  template <class F>
  void forEachSystem(ConstrainedMotion& m, F&& f) const {
    std::size_t number = 0;
    for_each_integrator(root, [&](auto& ode, auto const& scope) {
      ConstrainedSystem& system = m.systems[number++];
      if (!system.rows.empty()) f(ode, scope, system);
    });
  }
  // An Error of a solver, thrown again with what it is about.
  template <class Solver, class F>
  void explained(ConstrainedMotion& m, Solver& solver, F&& solve) const {
    m.motionRows.motion.setZero(m.motionRows.dofs);
    try {
      solve();
    } catch (Error const& error) {
      if (m.owesViolations)
        for (Eigen::Index i = 0; i < m.motionRows.start.size(); ++i)
          if (!std::isfinite(m.motionRows.start[i]))
            RowNames<RootScope>{root, m}.refuseNotFinite(m.motionRows.rows[std::size_t(i)]);
      if constexpr (SaysUnsolved<Solver>)
        if (!solver.result.converged) throw Error({}, text(error.what(), unsolved(m)));
      throw;
    }
  }

  // Where all states are over the same DataTypes that can do it, they solve it; says whether.
  template <class Solver>
  bool solveByStates(ConstrainedMotion& m, Solver& solver, int dofs, std::string_view where) const {
    bool done = false;
    if constexpr (LetsMotionBeSolved<Solver>) {
      if (!canBeSolvedByStates(m)) return false;
      withFirstMotion(m, [&](auto& motion) {
        motion.begin(dofs / 3);
        forEachSystem(m, [&](auto& ode, auto const& scope, ConstrainedSystem& system) {
          MechanicalOperations<std::decay_t<decltype(scope)>> operations(scope, time, dt);
          refuseCorrections(scope);
          const auto how = MultiplierResponse::of(ode, dt);
          operations.derivsTaken = how.derivs;
          operations.reserve({.derivs = how.derivs + 2});
          motion.addSystem(operations, how.factors, system.scale, system.begin / 3);
        });
        joinRows(m, dofs, [&] { return motion.largestDiagonal(); });
        explained(m, solver, [&] {
          solver.solveMotionBy(
              [&](auto const& settings, std::vector<double>& lastMotion) {
                const auto found = motion.solve(
                    m.motionRows, settings, lastMotion, where, m.owesViolations, [&](double* to) {
                      violationsByStates(m, to);
                    });
                if (!found.converged)  // for the message
                  m.motionRows.motion =
                      Eigen::Map<Eigen::VectorXd const>(lastMotion.data(), Eigen::Index(lastMotion.size()));
                return found;
              },
              where);
        });
        forEachSystem(m, [&](auto& ode, auto const& scope, ConstrainedSystem& system) {
          const auto how = MultiplierResponse::of(ode, dt);
          MechanicalOperations<std::decay_t<decltype(scope)>>(scope).forEachIndependent([&](auto& s) {
            if constexpr (SolvesMotions<typename std::decay_t<decltype(s)>::DataTypes>)
              motion.give(s[how.motion()], (system.begin + s.dofOffset) / 3, 1 / reached(m, how));
          });
        });
      });
      done = true;
    }
    return done;
  }
  // the violations of contacts that states have found, a number each of the joined rows
  void violationsByStates(ConstrainedMotion const& m, double* to) const {
    traverse(root, on<role::ContactManager>([&](auto& manager, auto const& scope) {
               StateContacts<std::decay_t<decltype(scope)>>{scope}.eachSearch(
                   [&](CollisionSurface& surface, auto& state, auto& search) {
                     if (!m.stands) listRows(m, manager, surface.number, search);
                     search.putViolations(manager.responses,
                                          std::as_const(state.position),
                                          std::as_const(state.freePosition),
                                          std::as_const(state.velocity),
                                          dt,
                                          m.rows.ofVelocity,
                                          to);
                   });
             }));
  }
  // tells a search which of the joined rows its contacts have
  template <class Manager, class Search>
  static void listRows(ConstrainedMotion const& m, Manager const& manager, int surface, Search& search) {
    search.clearRows();
    std::vector<int> const& all = m.motionRows.rows;
    auto joined = all.begin();
    for (Contact const& c : manager.contacts) {
      if (c.place < 0 || c.row < 0 || (c.a.surface != surface && c.b.surface != surface)) continue;
      joined = std::lower_bound(joined, all.end(), c.row);
      if (joined == all.end()) return;
      if (*joined == c.row) search.addRow({c.place, int(joined - all.begin()), c.response, c.friction});
    }
  }
  bool canBeSolvedByStates(ConstrainedMotion& m) const {
    bool can = true;
    std::type_info const* types = nullptr;
    forEachSystem(m, [&](auto&, auto const& scope, ConstrainedSystem& system) {
      MechanicalOperations<std::decay_t<decltype(scope)>> operations(scope);
      can = can && !system.joined;
      operations.forEachIndependent([&](auto& s) {
        using D = typename std::decay_t<decltype(s)>::DataTypes;
        if constexpr (SolvesMotions<D>)
          can = can && (!types || *types == typeid(D)) && VectorOperations<D>::assemblesMotion(operations);
        else
          can = false;
        types = &typeid(D);
      });
    });
    return can && types;
  }
  // f(what the workspace of the first state has for it)
  template <class F>
  void withFirstMotion(ConstrainedMotion& m, F&& f) const {
    bool found = false;
    forEachSystem(m, [&](auto&, auto const& scope, ConstrainedSystem&) {
      MechanicalOperations<std::decay_t<decltype(scope)>>(scope).forEachIndependent([&](auto& s) {
        if constexpr (SolvesMotions<typename std::decay_t<decltype(s)>::DataTypes>)
          if (!std::exchange(found, true)) f(s.solverWorkspace.motion);
      });
    });
  }

  // what bodies answer is their system here, as it is
  template <class S>
  static void refuseCorrections(S const& scope) {
    traverse(
        scope, on<role::ConstraintCorrection>([](auto& c, auto const& at) {
          using C = std::decay_t<decltype(c)>;
          bool changes = CorrectsState<C>;
          if constexpr (Regularizes<C>) changes = changes || c.regularizationTerm > 0;
          if constexpr (ScalesCompliance<C>) changes = changes || c.complianceFactor != 1;
          if (changes)
            throw Error(
                text(at.path(), ": ", at.node.labelOf(c)),
                "a constraint solver without a compliance matrix moves bodies by the systems of their ODE "
                "solvers, and would leave this correction out; remove it, or take "
                "BlockGaussSeidelConstraintSolver");
        }));
  }

  template <class S>
  void assemble(S const& scope, MultiplierResponse const& how, ConstrainedSystem& system) const {
    MechanicalOperations<S> operations(scope, time, dt);
    if (!system.hasPattern) {
      refuseCorrections(scope);
      operations.forEachIndependent([&](auto& s) {
        using D = typename std::decay_t<decltype(s)>::DataTypes;
        if (D::size % 3 != 0)
          throw Error(
              scope.path(),
              text(component_name<std::decay_t<decltype(s)>>(),
                   ": a constraint solver without a compliance matrix moves points and rigid bodies in space "
                   "only; take BlockGaussSeidelConstraintSolver"));
      });
      operations.initMatrix(system.matrix);
      system.hasPattern = true;
    }
    operations.assemble(system.matrix, how.factors.matrix);
  }

  // the rows of all systems together, without contacts that nothing can part; stiffest() is the largest
  // number on the diagonal of S
  template <class Stiffest>
  void joinRows(ConstrainedMotion& m, int dofs, Stiffest&& stiffest) const {
    MotionRows& all = m.motionRows;
    if (!asBefore(m, dofs)) joinAnew(m, dofs, stiffest);
    all.step = m.step;
    const auto n = Eigen::Index(all.rows.size());
    all.start.resize(n);
    all.multipliers.resize(n);
    for (Eigen::Index i = 0; i < n; ++i) {
      all.start[i] = m.rows.violation[std::size_t(all.rows[std::size_t(i)])];
      if (!std::isfinite(all.start[i]))
        RowNames<RootScope>{root, m}.refuseNotFinite(all.rows[std::size_t(i)]);
      all.multipliers[i] = m.rows.multipliers[std::size_t(all.rows[std::size_t(i)])];
    }
  }
  // whether all but violations and multipliers is that of the step before
  static bool asBefore(ConstrainedMotion const& m, int dofs) {
    MotionRows const& all = m.motionRows;
    return all.step == m.step - 1 && !all.byMatrix && all.dofs == dofs + 3 * int(all.slack.size()) &&
           (m.stands ||
            (m.rows.blocks == m.lastRows.blocks && m.rows.compliance == m.lastRows.compliance &&
             m.rows.ofVelocity == m.lastRows.ofVelocity &&
             std::all_of(m.systems.begin(), m.systems.end(), [](auto& s) { return s.rowsAsBefore(); })));
  }
  template <class Stiffest>
  void joinAnew(ConstrainedMotion& m, int dofs, Stiffest&& stiffest) const {
    MotionRows& all = m.motionRows;
    all.clear();
    if (all.motion.size() < dofs) all.motion.resize(dofs);
    all.motion.setZero();
    all.next.assign(m.systems.size(), 0);
    all.slack.clear();
    for (ConstraintBlock const& block : m.rows.blocks) {
      const int first = int(all.rows.size());
      const std::size_t slack = all.slack.size();
      bool free = true;
      for (int row = block.first; row < block.first + block.rows; ++row) {
        const std::size_t before = all.jacobian.dofs.size();
        for (std::size_t s = 0; s < m.systems.size(); ++s) {
          ConstrainedSystem const& system = m.systems[s];
          std::size_t& k = all.next[s];
          if (k == system.rows.size() || system.rows[k] != row) continue;
          system.jacobian.forEachInRow(
              int(k), [&](int dof, double value) { all.jacobian.add(system.begin + dof, value); });
          ++k;
        }
        const bool held = cancels(all, before);
        const double softness = m.rows.compliance[std::size_t(row)];
        if (held && softness == 0 && block.first < m.contactRows)
          RowNames<RootScope>{root, m}.refuseFixed(row);
        if (held && row == block.first && block.first >= m.contactRows) free = false;
        if (softness > 0 || (held && block.first >= m.contactRows)) {
          all.jacobian.add(dofs + 3 * int(all.slack.size()), 1);
          all.slack.push_back(softness > 0 ? 1 / softness : 0);
        }
        all.jacobian.endRow();
        all.rows.push_back(row);
      }
      if (!free) {
        all.dropFrom(first);
        all.slack.resize(slack);
        continue;
      }
      all.blocks.push_back(block);
      all.blocks.back().first = first;
    }
    all.byMatrix = std::find(all.slack.begin(), all.slack.end(), 0) != all.slack.end();
    if (all.byMatrix) std::replace(all.slack.begin(), all.slack.end(), 0., double(stiffest()));
    all.dofs = dofs + 3 * int(all.slack.size());
  }
  // Whether the entries from one on, which are left out then, move nothing: there are none, or both sides are
  // of one rigid body. The motion is zero before and after.
  static bool cancels(MotionRows& all, std::size_t begin) {
    double largest = 0, left = 0;
    for (auto k = begin; k < all.jacobian.dofs.size(); ++k) {
      all.motion[all.jacobian.dofs[k]] += all.jacobian.values[k];
      largest = std::max(largest, std::abs(all.jacobian.values[k]));
    }
    for (auto k = begin; k < all.jacobian.dofs.size(); ++k) {
      left = std::max(left, std::abs(all.motion[all.jacobian.dofs[k]]));
      all.motion[all.jacobian.dofs[k]] = 0;
    }
    if (left > 1e-12 * largest) return false;
    all.jacobian.dofs.resize(begin);
    all.jacobian.values.resize(begin);
    return true;
  }
  // J J' of the first n rows, in which equalities depend on each other as they do in W
  static ConstraintProblem::Matrix productsOf(MotionRows const& all, int n) {
    Eigen::VectorXd motion = Eigen::VectorXd::Zero(all.dofs);
    ConstraintProblem::Matrix products = ConstraintProblem::Matrix::Zero(n, n);
    for (int i = 0; i < n; ++i) {
      all.jacobian.addTransposed(i, 1, motion);
      for (int k = 0; k < n; ++k) products(k, i) = all.jacobian.times(k, motion);
      all.jacobian.forEachInRow(i, [&](int dof, double) { motion[dof] = 0; });
    }
    return products;
  }
  std::string unsolved(ConstrainedMotion const& m) const {
    MotionRows const& all = m.motionRows;
    Eigen::VectorXd d = all.start;
    for (int i = 0; i < all.jacobian.rows(); ++i) d[i] += all.jacobian.times(i, all.motion);
    int end = 0;  // behind the last equality
    for (ConstraintBlock const& b : all.blocks)
      if (b.kind == ConstraintBlock::Kind::equality) end = b.first + b.rows;
    auto ofAll = [&](int row) { return row < 0 ? row : all.rows[std::size_t(row)]; };
    Contradiction contradiction = contradicting_equality(all.blocks, productsOf(all, end), all.start);
    contradiction.row = ofAll(contradiction.row);
    return RowNames<RootScope>{root, m}.unsolved(ofAll(furthest_row(all.blocks, d)), contradiction);
  }
  static double largestDiagonal(ConstrainedMotion const& m) {
    double largest = 0;
    for (ConstrainedSystem const& system : m.systems)
      if (!system.rows.empty())
        for (int i = 0; i < system.matrix.rows(); ++i)
          largest = std::max(largest, system.scale * system.block(i).diagonal().maxCoeff());
    return largest > 0 ? largest : 1;
  }
  template <class Block>
  static void blocksOf(ConstrainedMotion const& m, MotionRows const& all, std::vector<Block>& blocks) {
    blocks.clear();
    for (ConstrainedSystem const& system : m.systems)
      if (!system.rows.empty())
        for (int i = 0; i < system.matrix.rows(); ++i) blocks.push_back(system.scale * system.block(i));
    for (const double s : all.slack) blocks.push_back(Eigen::Vector3d(s, 1, 1).asDiagonal());
  }
  static void multiply(ConstrainedMotion& m, Eigen::VectorXd const& p, Eigen::VectorXd& q) {
    q.resize(p.size());
    Eigen::Index behind = 0;
    for (ConstrainedSystem& system : m.systems) {
      if (system.rows.empty()) continue;
      const int n = system.dofs();
      system.force.head(n) = p.segment(system.begin, n);
      system.force[n] = 0;  // products read it
      system.matrix.multiply(system.force.data(), system.motion.data());
      q.segment(system.begin, n) = system.scale * system.motion.head(n);
      behind = system.begin + n;
    }
    for (const double s : m.motionRows.slack) {
      q[behind] = s * p[behind];
      q.segment<2>(behind + 1) = p.segment<2>(behind + 1);
      behind += 3;
    }
  }
};

}  // namespace sinew
