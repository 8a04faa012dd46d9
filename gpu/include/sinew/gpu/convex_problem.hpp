// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/gpu/convex_entries.hpp>
#include <sinew/gpu/system_rows.hpp>
#include <sinew/gpu/team_gradients.hpp>
#include <sinew/gpu/whole_team.hpp>
#include <sinew/lagrangian/convex_schedule.hpp>
#include <sinew/lagrangian/exact_line_search.hpp>
#include <sinew/linalg/block_inverse.hpp>

#include <cmath>
#include <cstddef>

namespace sinew::gpu {

/// How far the convex problems of a step with constraints (ConvexStep) have come.
struct ConvexProgress {
  enum class Ends {
    done,
    asks,       // for an update that is made by the host
    unbounded,  // the system is not finite
    immovable   // nothing can move what a row is of
  };

  ConvexSchedule schedule{};
  ConvexBest best{};
  ConvexStepResult found{};
  FrictionLag lag = FrictionLag::bound;
  bool begun = false;
  Ends ends = Ends::done;
};

/// The convex problems of a step with constraints, all in memory of the device. A System is a matrix over
/// points, whose rows a team multiplies (SystemOfBodies); Entries are which of these blocks of constraints
/// have (ConvexEntries). Where `System::alone`, no host is asked for an update: what it would accelerate is
/// left as it is.
template <class System, class Entries = ConvexEntries>
struct ConvexProblem {
  System system;

  int blocks;
  ConstraintBlock const* block;
  Entries entries;
  double const* rows;

  // a number each row: the violation at v = 0, and what ConvexUpdates and ConstraintTerms have
  double const* start;
  double *multipliers, *violation, *before, *lagged, *regularisation, *compliance;
  double *rate, *curvature, *goodMultipliers;  // curvature: three
  // three numbers a point
  double *velocity, *momentum, *gradient, *goodVelocity;
  GradientVectors newton;
  double *diagonal, *inverse;  // nine a point, component by component
  double* coupling;            // nine a pair

  ConvexStepSettings settings;
  ConvexProgress progress;        // where to go on from
  ConvexProgress* progressThere;  // and where that comes

  static constexpr std::size_t entryBytes = System::entryBytes;

  using Vector = Eigen::Vector3d;
  using Block = Eigen::Matrix3d;

  SINEW_INLINE Block load(double const* of, int i) const {
    Block b;
    for (int c = 0; c < 9; ++c) b(c / 3, c % 3) = of[c * std::ptrdiff_t(system.all) + i];
    return b;
  }
  SINEW_INLINE void store(double* of, int i, Block const& b) const {
    for (int c = 0; c < 9; ++c) of[c * std::ptrdiff_t(system.all) + i] = b(c / 3, c % 3);
  }
  SINEW_INLINE static void invert(Block const& a, Block& to) {
    if (!invert_definite(a, to)) invert_diagonal(a, to);
  }
  // row r of the block of an entry, in its point
  SINEW_INLINE Vector row(int e, int r) const {
    double const* const from = rows + entries.slotOf(e) + 3 * r;
    return {from[0], from[1], from[2]};
  }

  template <class Team>
  SINEW_HD void operator()(Team& team) const {
    const ConvexProgress end = solve(team);
    if (team.first()) *progressThere = end;
  }
  /// How far they have come, in each thread.
  template <class Team>
  SINEW_INLINE ConvexProgress solve(Team& team) const {
    return Solution<Team>(team, *this).run();
  }

 private:
  template <class Team>
  class Solution {
   public:
    SINEW_INLINE Solution(Team& t, ConvexProblem const& problem)
        : team(t), q(problem), rows(t, problem.system), now(problem.progress) {
      if (team.firstRow() >= 0 && team.firstRow() < all) {
        own_ = team.firstRow();
        firstPair_ = q.entries.firstPair(own_);
        lastPair_ = q.entries.lastPair(own_);
      }
    }

    SINEW_INLINE ConvexProgress run() {
      if (now.begun || begin()) {
        now.begun = true;
        solve();
      }
      return now;
    }

   private:
    using Ends = ConvexProgress::Ends;
    Team& team;
    ConvexProblem const& q;
    const typename System::template Rows<Team> rows;
    ConvexProgress now;
    double rho = 0;
    const int all = q.system.all;
    int own_ = -1, firstPair_ = 0, lastPair_ = 0;  // of the first row of this thread

    // The first problem, from the multipliers before and the motion of the last step, scaled to what these
    // would do; false where nothing can move a row.
    SINEW_INLINE bool begin() {
      now.schedule.begin(q.settings);
      team.each(all, [&](int i) { q.store(q.diagonal, i, rows.diagonal(i)); });
      team.sync();
      double local[3] = {0, 0, 0};  // energy, work, whether a row cannot move
      team.each(q.blocks, [&](int k) {
        ConstraintBlock const& b = q.block[k];
        double* const w = q.compliance + b.first;
        for (int r = 0; r < b.rows; ++r) w[r] = 0;
        for (int e = q.entries.first(k); e < q.entries.last(k); ++e) {
          Block mobility;
          invert(q.load(q.diagonal, q.entries.pointOf(e)), mobility);
          for (int r = 0; r < b.rows; ++r) {
            const Vector j = q.row(e, r), moved = mobility * j;
            w[r] += j[0] * moved[0] + j[1] * moved[1] + j[2] * moved[2];
          }
        }
        if constexpr (System::alone) {
          // a tangent along which nothing moves has no force, and the regularisation of the normal
          for (int r = 1; r < b.rows; ++r) w[r] = w[r] == 0 ? w[0] : w[r];
        }
        for (int r = 0; r < b.rows; ++r)
          if (!(w[r] > 0)) local[2] = 1;
        contact_potential::take_before(
            b, now.lag, q.multipliers + b.first, q.before + b.first, q.lagged[b.first]);
        contact_potential::regularise(b, now.schedule.relative, w, q.regularisation + b.first);
      });
      multiplyVelocity();
      team.sync();
      team.each(all, [&](int i) {
        const Vector v = vector_at(q.velocity, i), product = vector_at(q.newton.product, i);
        Vector impulse = q.system.restOf(i);
        eachEntry(i, [&](int e, ConstraintBlock const& b) { addForce(e, b, q.multipliers, impulse); });
        for (int c = 0; c < 3; ++c) {
          local[0] += v[c] * product[c];
          local[1] += v[c] * impulse[c];
        }
      });
      team.template reduce<2>(local);
      if (local[2] > 0) {
        now.ends = Ends::immovable;
        return false;
      }
      const double part = local[0] > 0 && local[1] > 0 ? local[1] / local[0] : 0;
      team.each(all, [&](int i) { put_vector(q.velocity, i, Vector(part * vector_at(q.velocity, i))); });
      team.sync();
      team.each(q.blocks, [&](int k) {
        ConstraintBlock const& b = q.block[k];
        rates(
            k, [&](int j) { return vector_at(q.velocity, j); }, q.violation + b.first);
        for (int r = b.first; r < b.first + b.rows; ++r) q.violation[r] += q.start[r];
      });
      return true;
    }

    // One problem after the other, until one is the last, or the host is asked.
    SINEW_INLINE void solve() {
      ConvexStepResult& found = now.found;
      ConvexStepSettings const& s = q.settings;
      while (true) {
        const bool stuck = solveProblem();
        if (now.ends == Ends::unbounded) return;
        found.converged = found.residual <= s.tolerance && found.momentum <= s.momentumTolerance;
        if (found.converged) return;
        const ConvexBest::Found good = now.best.look(found.residual, found.momentum);
        if (good == ConvexBest::Found::good) exchangeBest(false);
        if (good == ConvexBest::Found::farWorse || stuck || found.updates == s.maxUpdates) {
          exchangeBest(true);
          found.residual = now.best.residual;
          found.momentum = now.best.momentum;
          return;
        }
        if (!update()) return;
      }
    }
    SINEW_INLINE void exchangeBest(bool back) {
      double *const v = back ? q.velocity : q.goodVelocity, *const f =
                                                                back ? q.multipliers : q.goodMultipliers;
      double const *const fromV = back ? q.goodVelocity : q.velocity, *const fromF = back ? q.goodMultipliers
                                                                                          : q.multipliers;
      team.each(all, [&](int i) { put_vector(v, i, vector_at(fromV, i)); });
      team.each(q.blocks, [&](int k) {
        ConstraintBlock const& b = q.block[k];
        for (int r = b.first; r < b.first + b.rows; ++r) f[r] = fromF[r];
      });
    }
    // What ConvexUpdates does, where multipliers are taken as they are; false where the host is to do it.
    SINEW_INLINE bool update() {
      const ConvexSchedule last = now.schedule;
      bool forgets = false;
      const auto next = now.schedule.next(
          q.settings,
          now.lag,
          now.found.residual,
          [&] {
            double local[2] = {0, 0};
            team.each(q.blocks, [&](int k) {
              ConstraintBlock const& b = q.block[k];
              const auto one = contact_potential::rest(b,
                                                       now.lag,
                                                       rowsOf(b),
                                                       q.compliance[b.first],
                                                       q.lagged[b.first],
                                                       q.violation + b.first,
                                                       q.multipliers + b.first);
              local[0] = one.regularisation > local[0] ? one.regularisation : local[0];
              local[1] = one.lag > local[1] ? one.lag : local[1];
            });
            team.template reduce<0>(local);
            return contact_potential::Rest{local[0], local[1]};
          },
          forgets);
      if (!System::alone && next != ConvexSchedule::Next::move) {
        now.schedule = last;
        now.ends = Ends::asks;
        return false;
      }
      ++now.found.updates;
      if (next == ConvexSchedule::Next::change) {
        change();
        return true;
      }
      team.each(q.blocks, [&](int k) {
        ConstraintBlock const& b = q.block[k];
        double* const f = q.multipliers + b.first;
        if (b.kind == ConstraintBlock::Kind::friction && now.lag == FrictionLag::gap)
          q.lagged[b.first] = contact_potential::next_gap(b, q.violation + b.first, f, q.lagged[b.first]);
        contact_potential::take_before(b, now.lag, f, q.before + b.first, q.lagged[b.first]);
        contact_potential::regularise(
            b, now.schedule.relative, q.compliance + b.first, q.regularisation + b.first);
      });
      return true;
    }

    // ConstraintTerms::change
    SINEW_INLINE void change() {
      now.lag = now.lag == FrictionLag::gap ? FrictionLag::bound : FrictionLag::gap;
      constexpr double none[3] = {0, 0, 0};  // the whole gap, as without a force
      team.each(q.blocks, [&](int k) {
        ConstraintBlock const& b = q.block[k];
        for (int r = b.first; r < b.first + b.rows; ++r) q.lagged[r] = 0;
        if (now.lag == FrictionLag::gap && b.kind == ConstraintBlock::Kind::friction)
          q.lagged[b.first] = contact_potential::next_gap(b, q.violation + b.first, none, 0);
        contact_potential::take_before(
            b, now.lag, q.multipliers + b.first, q.before + b.first, q.lagged[b.first]);
        contact_potential::regularise(
            b, now.schedule.relative, q.compliance + b.first, q.regularisation + b.first);
      });
    }

    // whether no direction was found, or no iteration is left
    SINEW_INLINE bool solveProblem() {
      ConvexStepResult& found = now.found;
      team.sync();  // velocities of others
      multiplyVelocity();
      team.sync();
      team.each(all, [&](int i) {
        put_vector(q.momentum, i, vector_at(q.newton.product, i) - q.system.restOf(i));
      });
      double size = evaluate();
      const double first = size;
      bool stuck = false;
      for (int i = 0; i < q.settings.maxNewtonIterations && !stuck; ++i) {
        if (!(size <= largest)) {
          now.ends = Ends::unbounded;
          return true;
        }
        if (found.momentum <= q.settings.momentumTolerance) break;
        // the last problem is solved to the end
        if (size <= q.settings.reduction * first && found.residual > q.settings.tolerance) break;
        stuck = found.conjugateGradients >= q.settings.maxConjugateGradients || !newton();
        size = evaluate();
      }
      return stuck;
    }

    static constexpr double largest = 1.7e308;

    // S v into newton.product
    SINEW_INLINE void multiplyVelocity() {
      team.eachRow(all, [&](int i, int lane) {
        double sum[3] = {0, 0, 0};
        rows.add(
            i, lane, [&](int j) { return vector_at(q.velocity, j); }, sum);
        team.sumOfRow(sum);
        if (lane != 0) return;
        rows.hold(i, sum);
        for (int c = 0; c < 3; ++c) q.newton.product[3 * i + c] = sum[c];
      });
    }
    // the part of a lane of J' G J p in a point
    template <class P>
    SINEW_INLINE void addTerms(int i, int lane, int lanes, P&& p, double (&sum)[3]) const {
      const bool own = i == own_;
      const int end = own ? lastPair_ : q.entries.lastPair(i);
      for (int k = (own ? firstPair_ : q.entries.firstPair(i)) + lane; k < end; k += lanes) {
        const Vector v = p(q.entries.pointOfPair(k));
        double const* const pair = q.coupling + 9 * std::ptrdiff_t(k);
        for (int r = 0; r < 3; ++r)
          for (int c = 0; c < 3; ++c) sum[r] += pair[3 * r + c] * v[c];
      }
    }
    // J p of a block
    template <class P>
    SINEW_INLINE void rates(int k, P&& p, double* w) const {
      const int n = q.block[k].rows;
      for (int r = 0; r < n; ++r) w[r] = 0;
      for (int e = q.entries.first(k); e < q.entries.last(k); ++e) {
        const Vector v = p(q.entries.pointOf(e));
        for (int r = 0; r < n; ++r) {
          const Vector j = q.row(e, r);
          w[r] += j[0] * v[0] + j[1] * v[1] + j[2] * v[2];
        }
      }
    }
    // f(entry, its block) of a point
    template <class F>
    SINEW_INLINE void eachEntry(int i, F&& f) const {
      q.entries.eachOf(i, [&](int e) { f(e, q.block[q.entries.blockOfEntry(e)]); });
    }
    // J' f of an entry
    SINEW_INLINE void addForce(int e, ConstraintBlock const& b, double const* f, Vector& to) const {
      for (int r = 0; r < b.rows; ++r) {
        const Vector j = q.row(e, r);
        for (int c = 0; c < 3; ++c) to[c] += f[b.first + r] * j[c];
      }
    }
    // J' G J of two entries of a block
    SINEW_INLINE Block couplingOf(ConstraintBlock const& b, int own, int other) const {
      double const* const G = q.curvature + 3 * b.first;
      const bool friction = b.kind == ConstraintBlock::Kind::friction;
      Block sum = Block::Zero();
      for (int r = 0; r < b.rows; ++r) {
        const Vector j = q.row(own, r);
        Vector curved = G[r] * q.row(other, r);
        if (friction) {
          curved.setZero();
          for (int s = 0; s < 3; ++s) {
            const Vector of = q.row(other, s);
            for (int c = 0; c < 3; ++c) curved[c] += G[3 * s + r] * of[c];
          }
        }
        for (int c = 0; c < 3; ++c)
          for (int a = 0; a < 3; ++a) sum(a, c) += j[a] * curved[c];
      }
      return sum;
    }
    SINEW_INLINE contact_potential::Rows rowsOf(ConstraintBlock const& b) const {
      return {q.regularisation + b.first,
              q.before + b.first,
              now.lag == FrictionLag::bound ? q.lagged[b.first] : contact_potential::cone};
    }
    // d + t w + s
    SINEW_INLINE void violationAt(ConstraintBlock const& b, double t, double* d) const {
      for (int r = 0; r < b.rows; ++r) {
        d[r] = q.violation[b.first + r];
        if (t != 0) d[r] += t * q.rate[b.first + r];
      }
      if (now.lag == FrictionLag::gap) d[0] += q.lagged[b.first];
    }

    // Multipliers, their curvature, the gradient, the preconditioner and the direction of steepest descent;
    // returns the size of the gradient. Each block and each point stay with their threads.
    SINEW_INLINE double evaluate() {
      double local[4] = {0, 0, 0, 0};
      team.each(q.blocks, [&](int k) {
        ConstraintBlock const& b = q.block[k];
        double d[ConstraintBlock::maxRows], mean = 0;
        violationAt(b, 0, d);
        contact_potential::multipliers(b, rowsOf(b), d, q.multipliers + b.first);
        contact_potential::curvature(b, rowsOf(b), d, q.curvature + 3 * b.first);
        for (int r = 0; r < b.rows; ++r) mean += q.compliance[b.first + r];
        const double away = contact_potential::natural_map(
            b, now.lag, mean / b.rows, q.violation + b.first, q.multipliers + b.first);
        local[3] = away > local[3] ? away : local[3];
      });
      team.sync();
      team.each(all, [&](int i) {
        Vector reaction = Vector::Zero();
        Block sum = q.load(q.diagonal, i), mobility;
        eachEntry(i, [&](int e, ConstraintBlock const& b) { addForce(e, b, q.multipliers, reaction); });
        for (int k = q.entries.firstPair(i); k < q.entries.lastPair(i); ++k) {
          const int own = q.entries.ownOf(k), other = q.entries.otherOf(k);
          const Block coupled = couplingOf(q.block[q.entries.blockOfEntry(own)], own, other);
          for (int c = 0; c < 9; ++c) q.coupling[9 * std::ptrdiff_t(k) + c] = coupled(c / 3, c % 3);
          if (own == other) sum += coupled;
        }
        invert(sum, mobility);
        const Vector p = vector_at(q.momentum, i), slope = p - reaction;
        const Vector steepest = -(mobility * slope), v = vector_at(q.velocity, i),
                     answer = mobility * reaction, rest = q.system.restOf(i);
        q.store(q.inverse, i, mobility);
        put_vector(q.gradient, i, slope);
        put_vector(q.newton.residual, i, -slope);
        put_vector(q.newton.scaled, i, steepest);
        put_vector(q.newton.solution, i, Vector(Vector::Zero()));
        for (int c = 0; c < 3; ++c) {
          local[0] += v[c] * (p[c] + rest[c]);
          local[1] += reaction[c] * answer[c];
          local[2] -= slope[c] * steepest[c];
        }
      });
      team.template reduce<3>(local);
      const double energy = local[0] > local[1] ? local[0] : local[1];
      const double size = local[2] > 0 ? std::sqrt(local[2]) : local[2] <= 0 ? 0 : local[2];
      now.found.momentum = energy > 0 ? size / std::sqrt(energy) : size;
      now.found.residual = local[3];
      rho = local[2];
      return size;
    }

    // A Newton step by conjugate gradients and an exact line search; false where no direction was found.
    SINEW_INLINE bool newton() {
      ConvexStepResult& found = now.found;
      found.newtonIterations += 1;
      const GradientsFound gradients = team_gradients(
          team,
          all,
          q.newton,
          rho,
          q.settings.forcing * q.settings.forcing * rho,
          q.settings.maxConjugateGradients - found.conjugateGradients,
          [&](int i, int lane, auto const& p, double(&sum)[3]) {
            rows.add(i, lane, p, sum);
            addTerms(i, lane, Team::lanes, p, sum);
          },
          [&](int i, double(&sum)[3]) { rows.hold(i, sum); },
          [&](int i, int c, Vector const& r) {
            double sum = 0;
            for (int k = 0; k < 3; ++k) sum += q.inverse[(3 * c + k) * std::ptrdiff_t(all) + i] * r[k];
            return sum;
          },
          [](double c) { return c > 0; });
      found.conjugateGradients += gradients.iterations;
      if (!gradients.any) return false;
      // A dv = -grad - residual - J' G J dv
      double line[2] = {0, 0};
      auto step = [&](int j) { return vector_at(q.newton.solution, j); };
      team.each(all, [&](int i) {
        double terms[3] = {0, 0, 0};
        const Vector move = step(i), p = vector_at(q.momentum, i),
                     left = vector_at(q.gradient, i) + vector_at(q.newton.residual, i);
        addTerms(i, 0, 1, step, terms);
        Vector product;
        for (int c = 0; c < 3; ++c) {
          product[c] = -(terms[c] + left[c]);
          line[0] += move[c] * p[c];
          line[1] += move[c] * product[c];
        }
        put_vector(q.newton.product, i, product);
      });
      team.each(q.blocks, [&](int k) { rates(k, step, q.rate + q.block[k].first); });
      team.template reduce<2>(line);
      const double t = exact_line_search(
          line[0],
          line[1],
          [&](double at) {
            double slope[2] = {0, 0};
            team.each(q.blocks, [&](int k) {
              ConstraintBlock const& b = q.block[k];
              double d[ConstraintBlock::maxRows];
              violationAt(b, at, d);
              const auto one = contact_potential::slope(b, rowsOf(b), d, q.rate + b.first);
              slope[0] += one.first;
              slope[1] += one.second;
            });
            team.template reduce<2>(slope);
            return contact_potential::Slope{slope[0], slope[1]};
          },
          found.lineSearches);
      team.each(all, [&](int i) {
        const Vector v = vector_at(q.velocity, i) + t * vector_at(q.newton.solution, i),
                     p = vector_at(q.momentum, i) + t * vector_at(q.newton.product, i);
        put_vector(q.velocity, i, v);
        put_vector(q.momentum, i, p);
      });
      team.each(q.blocks, [&](int k) {
        ConstraintBlock const& b = q.block[k];
        for (int r = b.first; r < b.first + b.rows; ++r) q.violation[r] += t * q.rate[r];
      });
      return true;
    }
  };
};

}  // namespace sinew::gpu
