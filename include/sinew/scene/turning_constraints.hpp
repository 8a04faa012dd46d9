// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/core/step_warnings.hpp>
#include <sinew/lagrangian/constrained_motion.hpp>
#include <sinew/scene/constraint_response.hpp>
#include <sinew/scene/mechanical_operations.hpp>
#include <sinew/scene/solvers.hpp>
#include <sinew/scene/states_of.hpp>

#include <algorithm>
#include <cmath>
#include <type_traits>

namespace sinew {

/// Constraints whose Jacobian turns within a step, such as those of a point on a rigid body away from its
/// centre. With d = d_free + J u, J at the start of the step, they hold to the square of the turn. They hold
/// where the bodies end, d(x_free + u) = 0 or in its bounds, by a fixed point for what the tangent leaves
/// out,
///   r = d(x_free + u) - (d_free + J u),    d = d_free + r + J u,
/// in which forces keep the directions of the start, as on both sides of a joint (SHAKE: Ryckaert, Ciccotti,
/// Berendsen 1977). Each iteration leaves of the error about its product with the turn, and Anderson's
/// acceleration less. Contacts of a contact manager, which are found anew each step, what is soft, and
/// friction keep their tangents.
template <class RootScope>
struct TurningConstraints {
  RootScope const& root;
  double time, dt;
  StepNotes const& notes;

  /// After the first solution: again(m) solves the rows of m anew.
  template <class Again>
  void hold(ConstrainedMotion& m, Again&& again) const {
    TurningRows& t = m.turning;
    if (m.rows.ofVelocity || !listRows(m)) return;
    double change = 0;
    for (int i = 0;; ++i) {
      measure(m);
      change = (t.found - t.shift).template lpNorm<Eigen::Infinity>();
      if (change <= m.newtonTolerance) return;
      if (i == m.newtonIterations || !std::isfinite(change)) break;
      t.acceleration.next(t.found, t.weights, t.shift);
      solveShifted(m, again);
    }
    if (!std::isfinite(change)) {
      t.shift.setZero();
      solveShifted(m, again);
    }
    notes.warn(root.path(), "constraints do not hold at the end of the step", [&] {
      return text("constraints that turn within the step are off by ",
                  change,
                  " m after ",
                  m.newtonIterations,
                  " iterations, the tolerance is ",
                  m.newtonTolerance,
                  "; allow more (newtonIterations), or make dt smaller");
    });
  }

 private:
  // the rows of constraints whose end is asked for in whole
  static bool isOfEnd(ConstrainedMotion const& m, ConstraintBlock const& block, int row) {
    return m.rows.compliance[std::size_t(row)] == 0 &&
           (block.kind != ConstraintBlock::Kind::friction || row == block.first);
  }
  bool listRows(ConstrainedMotion& m) const {
    TurningRows& t = m.turning;
    t.rows.clear();
    int first = 0;
    std::size_t number = 0;
    traverse(root, on<role::LagrangianConstraint>([&](auto& c, auto const&) {
               const int begin = first;
               first += m.rowsOf[number++];
               if constexpr (requires { c.load; })
                 if (c.load != 1) return;
               for (ConstraintBlock const& b : m.rows.blocks)
                 for (int row = b.first; b.first >= begin && b.first < first && row < b.first + b.rows; ++row)
                   if (isOfEnd(m, b, row)) t.rows.push_back(row);
             }));
    const auto n = Eigen::Index(t.rows.size());
    t.acceleration.reset(n);
    t.shift.setZero(n);
    t.found.setZero(n);
    t.weights.setOnes(n);
    t.free.resize(n);
    for (Eigen::Index i = 0; i < n; ++i) t.free[i] = m.rows.violation[std::size_t(t.rows[std::size_t(i)])];
    return n > 0;
  }
  template <class Again>
  static void solveShifted(ConstrainedMotion& m, Again& again) {
    TurningRows const& t = m.turning;
    for (std::size_t i = 0; i < t.rows.size(); ++i)
      m.rows.setViolation(t.rows[i], t.free[Eigen::Index(i)] + t.shift[Eigen::Index(i)]);
    std::copy_n(m.problem.multipliers.data(), m.rows.count(), m.rows.multipliers.data());
    again();
  }

  // r of the rows, at the end of the step that the multipliers make
  void measure(ConstrainedMotion& m) const {
    TurningRows& t = m.turning;
    t.linear = t.free;
    std::size_t number = 0;
    for_each_integrator(root, [&](auto& ode, auto const& scope) {
      using S = std::decay_t<decltype(scope)>;
      ConstrainedSystem& system = m.systems[number++];
      const ConstraintResponse<S> response(scope, ode, time, dt, system);
      if (!system.rows.empty()) {
        respond(response, m);
        addLinear(m, system, response.how.factors.position);
      }
      MechanicalOperations<S> operations(scope, time, dt);
      operations.eq(kept(ode), vec_id::position);
      operations.eq(vec_id::position, vec_id::freePosition);
      if (!system.rows.empty())
        operations.peq(vec_id::position, response.how.motion(), response.how.factors.position);
      operations.propagate(vec_id::position, vec_id::velocity);
    });
    lookAtEnd(m);
    for_each_integrator(root, [&](auto& ode, auto const& scope) {
      MechanicalOperations<std::decay_t<decltype(scope)>> operations(scope, time, dt);
      operations.eq(vec_id::position, kept(ode));
      operations.propagate(vec_id::position, vec_id::velocity);
    });
  }
  // where the start of the step is meanwhile
  template <class Ode>
  static CoordId kept(Ode const&) {
    return CoordId{CoordId::reserved + Ode::auxiliary.coords};
  }
  template <class S>
  void respond(ConstraintResponse<S> const& response, ConstrainedMotion const& m) const {
    ConstrainedSystem& system = response.system;
    if (m.hasMotion)
      return MechanicalOperations<S>(response.scope, time, dt).gather(system.motion, response.how.motion());
    system.force.setZero();
    for (int k = 0; k < system.jacobian.rows(); ++k)
      system.jacobian.addTransposed(k, m.problem.multipliers[system.rows[std::size_t(k)]], system.force);
    response.respond();
  }
  static void addLinear(ConstrainedMotion& m, ConstrainedSystem const& system, double reached) {
    TurningRows& t = m.turning;
    auto k = system.rows.begin();
    for (std::size_t i = 0; i < t.rows.size(); ++i) {
      k = std::lower_bound(k, system.rows.end(), t.rows[i]);
      if (k == system.rows.end()) return;
      if (*k == t.rows[i])
        t.linear[Eigen::Index(i)] +=
            reached * system.jacobian.times(int(k - system.rows.begin()), system.motion);
    }
  }
  // states are at the end of the step
  void lookAtEnd(ConstrainedMotion& m) const {
    TurningRows& t = m.turning;
    t.seen.ofVelocity = false;
    int first = 0;
    std::size_t number = 0, i = 0;
    traverse(root, on<role::LagrangianConstraint>([&](auto& c, auto const& scope) {
               const int begin = first;
               first += m.rowsOf[number++];
               if (i == t.rows.size() || t.rows[i] >= first) return;
               t.seen.clear();
               addRowsOf(c, scope, t.seen);
               const bool same = t.seen.count() == first - begin;
               for (; i < t.rows.size() && t.rows[i] < first; ++i) {
                 const auto e = Eigen::Index(i);
                 if (same) t.found[e] = t.seen.violation[std::size_t(t.rows[i] - begin)] - t.linear[e];
               }
             }));
  }
  template <class C, class S>
  void addRowsOf(C& c, S const& scope, ConstraintRows& rows) const {
    using D = typename C::DataTypes;
    auto seen = [this](auto& s) {
      VectorOperations<D>::bringToHost(s.position);
      return ConstrainedState<D>{s.position, s.position, s.velocity, s.restPosition, dt};
    };
    with_states_of(c, scope, [&](auto&... s) {
      if constexpr (SetsViolations<C>) {
        c.addJacobian(rows);
        c.setViolations(rows, 0, seen(s)...);
      } else
        c.addRows(rows, seen(s)...);
    });
  }
};

}  // namespace sinew
