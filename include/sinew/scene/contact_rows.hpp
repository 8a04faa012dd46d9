// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/collision/collision_surface.hpp>
#include <sinew/collision/contact_constraint.hpp>
#include <sinew/lagrangian/constrained_motion.hpp>
#include <sinew/scene/collision_models.hpp>

#include <Eigen/Eigenvalues>

#include <algorithm>
#include <type_traits>
#include <utility>

namespace sinew {

/// The contacts of a scene that multipliers answer, as equations of a constrained step over the degrees of
/// freedom of what ODE solvers move. `root` is the scope of the scene.
template <class RootScope>
struct ContactRows {
  RootScope const& root;
  double dt;

  /// Adds the rows of all contacts. States have their positions at the start of the step and the velocities
  /// of the motion without multipliers.
  void add(ConstrainedMotion& m) const {
    forEachManager([&](auto& manager, auto const& scope) {
      bool some = false;
      manager.forEachConstrained([&](auto const&, Contact&) { some = true; });
      if (some) addOf(manager, scope, m);
    });
  }

  /// The guesses of multipliers anew, where rows are those of the step before.
  void guessAgain(ConstrainedMotion& m) const {
    forEachManager([&](auto& manager, auto const&) {
      manager.forEachConstrained([&](auto const&, Contact const& c) { guess(m, c, contact_axes(c.normal)); });
    });
  }

  /// Brings the violations that states were to say, where these cannot.
  void putViolations(ConstrainedMotion& m) const {
    if (!std::exchange(m.owesViolations, false)) return;
    m.mayStand = false;
    forEachManager([&](auto& manager, auto const& scope) {
      with_collision_scope(scope, root, [&](auto const& models) {
        for_each_collision_model(models,
                                 [&]<class D>(auto& model, auto& s, auto const&, std::type_identity<D>) {
                                   if (model.surface.elsewhere) lookAt<D>(model.surface, s);
                                 });
      });
      manager.forEachConstrained([&](auto const& response, Contact& c) {
        if (c.place < 0 || c.row < 0) return;
        c.motion = motionOf(manager, c);
        if constexpr (MeasuresMotion<std::decay_t<decltype(response)>>)
          response.violations(c, c.motion, m.rows.ofVelocity, m.rows.violation.data() + std::size_t(c.row));
      });
    });
  }

  /// Contacts get the forces of their multipliers.
  void giveBack(ConstrainedMotion const& m) const {
    forEachManager([&](auto& manager, auto const&) {
      manager.forEachConstrained([&](auto const&, Contact& c) {
        c.force.setZero();
        if (c.row < 0) return;
        const Eigen::Matrix3d axes = contact_axes(c.normal);
        for (int i = 0; i < c.rows; ++i) c.force += m.problem.multipliers[c.row + i] * axes.col(i);
      });
    });
  }

  /// Contacts in which nothing can move have no force: their equations hold already. Of one that can move in
  /// some directions only the others are left.
  static void leaveOutFixed(ConstrainedMotion& m) {
    ConstraintProblem& p = m.problem;
    double most = 0;
    for (ConstraintBlock const& b : p.blocks) most = std::max(most, p.own(b).diagonal().maxCoeff());
    const double negligible = 1e-24 * most;  // that of rounding, where what moves is the same on both sides
    for (ConstraintBlock const& b : p.blocks) {
      if (b.first < m.contactRows) continue;
      const BlockVector diagonal = p.own(b).diagonal();
      const double largest = diagonal.maxCoeff();
      if (b.kind == ConstraintBlock::Kind::equality && largest > negligible) {
        fillRank(p, b);
        continue;
      }
      for (int i = 0; i < b.rows; ++i) {
        if (diagonal[i] > negligible) continue;
        p.leaveOut(b, b.first + i, largest > negligible ? largest : most > 0 ? most : 1);
        p.freeViolation[b.first + i] = 0;
        p.multipliers[b.first + i] = 0;
      }
    }
  }

 private:
  // an equality in all three directions, of which some cannot move
  static void fillRank(ConstraintProblem& p, ConstraintBlock const& b) {
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solved(Eigen::Matrix3d{p.own(b)});
    const Eigen::Vector3d values = solved.eigenvalues();
    auto d = p.freeViolation.segment<3>(b.first);
    for (int k = 0; k < 3; ++k) {
      if (values[k] > 1e-12 * values[2]) continue;
      const Eigen::Vector3d v = solved.eigenvectors().col(k);
      for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j) p.add(b.first + i, b.first + j, (values[2] - values[k]) * v[i] * v[j]);
      d -= v.dot(d) * v;
    }
  }
  template <class F>
  void forEachManager(F&& f) const {
    traverse(root, on<role::ContactManager>([&](auto& manager, auto const& scope) { f(manager, scope); }));
  }

  template <class Manager, class S>
  void addOf(Manager& manager, S const& scope, ConstrainedMotion& m) const {
    manager.assembly.entries.clear();
    with_collision_scope(scope, root, [&](auto const& models) {
      for_each_collision_model(
          models, [&]<class D>(auto& model, auto& s, auto const& at, std::type_identity<D>) {
            if (model.surface.elsewhere)
              keepStill(model.surface);
            else
              lookAt<D>(model.surface, s);
            if (model.simulated && model.surface.solver >= 0)
              at.template withDofs<D>(
                  [&](auto const& dofs) { manager.assembly.template addVertices<D>(model.surface, dofs); });
          });
    });
    manager.assembly.sort();
    manager.forEachConstrained([&](auto const& response, Contact& c) {
      const int row = m.rows.count();
      c.motion = motionOf(manager, c);
      c.start = c.motion.start;
      m.owesViolations = m.owesViolations || c.place >= 0;
      response.addRows(m.rows, c, c.motion);
      c.rows = m.rows.count() - row;
      c.row = c.rows > 0 ? row : -1;
      if (c.rows > 0) addJacobian(manager, c, m);
    });
  }
  // (the start of touched vertices that are elsewhere is known)
  static void keepStill(CollisionSurface& surface) {
    for (const int t : surface.touched) {
      surface.dx[std::size_t(t)].setZero();
      surface.velocity[std::size_t(t)].setZero();
      surface.force[std::size_t(t)].setZero();
    }
  }
  template <class D, class State>
  void lookAt(CollisionSurface& surface, State& s) const {
    update_touched_vertices<D>(surface, s.position, s.velocity);
    setMotion<D>(surface, s);
  }
  // how far touched vertices go without multipliers; what no solver moves is where it will be, and has come
  // there
  template <class D, class State>
  void setMotion(CollisionSurface& surface, State const& s) const {
    for (const int t : surface.touched) {
      const auto i = std::size_t(t);
      if (surface.solver < 0) {
        surface.dx[i] = dt * surface.velocity[i];
        if constexpr (D::rigid) surface.angularDx[i] = dt * surface.spin[i];
      } else {
        const typename D::Deriv moved = D::difference(s.position[i], s.freePosition[i]);
        surface.dx[i] = moved.template head<3>().template cast<double>();
        if constexpr (D::rigid) surface.angularDx[i] = moved.template tail<3>().template cast<double>();
      }
    }
  }
  // to first order, as the Jacobian is: the skin of a ball that rolls does not rise where it touches
  template <class Manager>
  ContactMotion motionOf(Manager const& manager, Contact const& c) const {
    auto const &a = *manager.surfaces[std::size_t(c.a.surface)],
               &b = *manager.surfaces[std::size_t(c.b.surface)];
    const Eigen::Vector3d ofA = rate_of(c.a, a, a.dx, a.angularDx), ofB = rate_of(c.b, b, b.dx, b.angularDx);
    ContactMotion motion{c.start, {}, {}, dt};
    if (a.solver < 0) motion.start += ofA;
    if (b.solver < 0) motion.start -= ofB;
    motion.free = motion.start + ofB - ofA;
    motion.rate = rate_of(c.b, b, b.velocity, b.spin) - rate_of(c.a, a, a.velocity, a.spin);
    return motion;
  }
  static void guess(ConstrainedMotion& m, Contact const& c, Eigen::Matrix3d const& axes) {
    for (int i = 0; i < c.rows; ++i) m.rows.setMultiplier(c.row + i, axes.col(i).dot(c.force));
  }
  template <class Manager>
  static void addJacobian(Manager& manager, Contact const& c, ConstrainedMotion& m) {
    const Eigen::Matrix3d axes = contact_axes(c.normal);
    auto const& blocks = manager.assembly.blocksOf(c, manager.surfaces);
    guess(m, c, axes);
    for (int i = 0; i < c.rows; ++i)
      for (auto const& block : blocks)
        for (int k = 0; k < block.columns; ++k)
          m.systems[std::size_t(block.solver)].add(
              c.row + i, block.dof + k, axes.col(i).dot(block.rows.col(k)));
  }
};

}  // namespace sinew
