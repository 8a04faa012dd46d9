// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/collision/collision_surface.hpp>
#include <sinew/core/assembly.hpp>
#include <sinew/core/component.hpp>
#include <sinew/core/vec_id.hpp>
#include <sinew/scene/collision_models.hpp>
#include <sinew/scene/scope.hpp>
#include <sinew/scene/solver_contacts.hpp>

namespace sinew {

/// Which forces acted over a step of an ODE solver, as impulse over dt: a solver says it while it steps
/// (`operations.acted`), contacts always keep theirs (Contact::force), and states do with
/// Simulation::keepForces: `applied`, and then `reaction`, what constraints did,
///   reaction = (1 - P) (M g - applied),   g = (v1 - v0) / dt,
/// with P for the motions that constraints allow, so that a point that is free has none. A solver whose
/// forces are in balance with another rate at the end of its step gives that as g.
template <class Operations>
class ActedForces {
 public:
  explicit ActedForces(Operations& o) : operations_(o) {}
  ActedForces(ActedForces const&) = delete;

  /// Before a step. `kept`: the states keep theirs.
  void begin(bool kept) {
    kept_ = kept;
    hasRate_ = false;
    now_ = before_ = 1 / operations_.dt;
    if (kept_) {
      operations_.forEachState([](auto& s) {
        using Deriv = typename std::decay_t<decltype(s)>::DataTypes::Deriv;
        for (auto* v : {&s.applied, &s.reaction, &s.startVelocity, &s.marked})
          if (v->size() != s.size()) v->assign(s.size(), Deriv(Deriv::Zero()));
      });
      operations_.eq(vec_id::startVelocity, vec_id::velocity);
    }
    clear();
  }

  /// Whether the states keep theirs.
  bool kept() const { return kept_; }
  /// Whether forces are asked for.
  bool asked() {
    bool any = kept_;
    withContacts([&](auto&, auto&&) { any = true; });
    return any;
  }

  /// Nothing has acted so far: an iteration begins anew.
  void clear() {
    reported_ = false;
    if (kept_) operations_.clear(vec_id::applied);
    eachContact([](auto& c) { c.force.setZero(); });
  }
  /// The forces f of the last evaluation, as computeForce has left them, act over `part` of the step.
  void add(DerivId f, double part = 1) {
    reported_ = true;
    if (kept_) operations_.peq(vec_id::applied, f, part);
    eachContact([part](auto& c) { c.force += part * c.evaluated; });
  }
  /// So does (m M + b B + k K) dx. `follows`: mapped states have their dx already.
  void add(DerivId dx, MatrixFactors factors, bool follows = false) {
    if (kept_) operations_.addMBKdx(vec_id::applied, dx, factors);
    if (factors.k == 0 && factors.b == 0) return;
    withContacts([&](auto& manager, auto&& mine) {
      if (!kept_ && !follows) operations_.propagate(dx);
      for_each_collision_model(operations_.root,
                               [&]<class D>(auto& model, auto& s, auto const&, std::type_identity<D>) {
                                 update_touched_vertices<D>(model.surface, s[dx]);
                               });
      manager.addActed(factors.k, factors.b, mine);
    });
  }

  /// A substep that may be refused: what has acted until here is what acted when it is taken back.
  void mark() {
    if (kept_) operations_.eq(vec_id::marked, vec_id::applied);
    eachContact([](auto& c) { c.marked = c.force; });
  }
  void takeBack() {
    if (kept_) operations_.eq(vec_id::applied, vec_id::marked);
    eachContact([](auto& c) { c.force = c.marked; });
  }

  /// M g balances the forces, g = a where points are free; where they are not, g = now v1 - before v0.
  void balance(DerivId a, double now, double before) {
    if (kept_) operations_.eq(vec_id::marked, a);
    hasRate_ = true;
    now_ = now;
    before_ = before;
  }
  /// The forces balance each other without masses.
  void balanceWithoutInertia() { now_ = before_ = 0; }

  /// After the step, when all is where constraints want it. False where forces were to be kept and the solver
  /// did not say which acted.
  bool end(DerivId lastForce) {
    if (!reported_) {
      if (kept_) return false;
      add(lastForce);
    }
    if (!kept_) return true;
    auto& o = operations_;
    constexpr DerivId g = vec_id::marked, r = vec_id::reaction, change = vec_id::startVelocity;
    o.teq(change, -before_);
    o.peq(change, vec_id::velocity, now_);
    if (hasRate_) {
      o.eq(r, change);
      o.projectResponse(r);
      o.peq(g, change, 1);
      o.peq(g, r, -1);
    } else {
      o.eq(g, change);
    }
    o.eq(r, vec_id::applied, -1);
    o.addMBKdx(r, g, {.m = 1});
    o.eq(g, r);
    o.projectResponse(g);
    o.peq(r, g, -1);
    return true;
  }

 private:
  Operations& operations_;
  bool kept_ = false, reported_ = false, hasRate_ = false;
  double now_ = 0, before_ = 0;

  // f(contact manager, which of its contacts this solver sees)
  template <class F>
  void withContacts(F&& f) {
    using Root = std::decay_t<decltype(operations_.root)>;
    SolverContacts<Root>{operations_.root}.with([&](auto& manager, int solver) {
      f(manager, [solver](auto const& contact) { return contact.solver == solver; });
    });
  }
  template <class F>
  void eachContact(F&& f) {
    withContacts([&](auto& manager, auto&& mine) { manager.forEachChosen(mine, f); });
  }
};

/// Ends those of a step of an ODE solver. Throws Error where they were to be kept and it did not say which
/// acted.
template <class Ode, class Operations>
void end_acted_forces(Operations& operations) {
  if constexpr (!stands_beside<Ode>)
    if (!operations.acted.end(vec_id::force))
      throw Error(
          operations.root.path(),
          text(component_name<Ode>(),
               ": forces cannot be kept, since this solver does not say which acted over its step; let it "
               "call operations.acted.add(), or leave out Simulation::keepForces"));
}

}  // namespace sinew
