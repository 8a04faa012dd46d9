// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/gpu/block_rows.hpp>
#include <sinew/gpu/whole_team.hpp>
#include <sinew/lagrangian/exact_line_search.hpp>
#include <sinew/linalg/block_inverse.hpp>

#include <cmath>

namespace sinew::gpu {

/// The matrix of one body among those of a step with constraints.
template <class D>
struct MotionBody {
  typename BlockRows<D>::RowProduct product;  // x and r are not read
  int const* diagonal;                        // place of each row's
  int begin, points;                          // among the points of all bodies
  double scale;                               // S = scale A
};

/// What one of the convex problems of a step with constraints (ConvexStep) has found.
struct ConvexProblemResult {
  double momentum, residual;
  double newtonIterations, conjugateGradients, lineSearches;
  double stuck, finite;  // 0 or 1
  static constexpr int size = 7;
};

/// One of the convex problems of a step with constraints, all in memory of the device: `points` of bodies,
/// each with its row of S, then those that rows have for themselves, `slack`.
template <class D>
struct ConvexProblem {
  MotionBody<D> const* body;
  int bodies, points, all;  // all: with slack
  double const* slack;

  // blocks of constraints; of each its entries, one for each point that it has, with the rows there: three
  // numbers a row. Of each point the entries that it has.
  int blocks;
  ConstraintBlock const* block;
  int const *ends, *point, *slot, *blockOf;
  double const* rows;
  int const *ofPoint, *entry;

  FrictionLag lag;
  double const *regularisation, *before, *lagged;  // a number each row, as ConstraintTerms has them
  double* compliance;                              // estimate of the diagonal of W

  // of each point of a body the directions, as bits, in which projective constraints hold it
  unsigned char* held;
  // three numbers a point
  double *velocity, *momentum, *gradient, *step, *residual, *scaled, *direction[2], *product;
  double *system, *inverse;                            // nine a point, component by component
  double *violation, *multipliers, *rate, *curvature;  // a number each row; curvature three

  double momentumTolerance, tolerance, reduction, forcing;
  int maxNewtonIterations, maxConjugateGradients;
  ConvexProblemResult* result;

  using Vector = Eigen::Vector3d;
  using Block = Eigen::Matrix3d;

  SINEW_INLINE Vector at(double const* of, int i) const { return {of[3 * i], of[3 * i + 1], of[3 * i + 2]}; }
  SINEW_INLINE void put(double* of, int i, Vector const& v) const {
    for (int c = 0; c < 3; ++c) of[3 * i + c] = v[c];
  }
  SINEW_INLINE Block load(double const* of, int i) const {
    Block b;
    for (int c = 0; c < 9; ++c) b(c / 3, c % 3) = of[c * std::ptrdiff_t(all) + i];
    return b;
  }
  SINEW_INLINE void store(double* of, int i, Block const& b) const {
    for (int c = 0; c < 9; ++c) of[c * std::ptrdiff_t(all) + i] = b(c / 3, c % 3);
  }
  SINEW_INLINE static void invert(Block const& a, Block& to) {
    if (!invert_definite(a, to)) invert_diagonal(a, to);
  }
  // row r of the block of an entry, in its point
  SINEW_INLINE Vector row(int e, int r) const {
    double const* const from = rows + slot[e] + 3 * r;
    return {from[0], from[1], from[2]};
  }

  // what threads do before the first problem

  /// Which degrees of freedom of a body projective constraints leave.
  struct TakeHeld {
    ConvexProblem q;
    typename D::Deriv const* projected;  // of ones
    int begin;
    SINEW_HD void operator()(int i) const {
      int bits = 0;
      for (int c = 0; c < 3; ++c) bits |= projected[i][c] == 0 ? 1 << c : 0;
      q.held[begin + i] = static_cast<unsigned char>(bits);
    }
  };
  struct SetOnes {
    typename D::Deriv* to;
    SINEW_HD void operator()(int i) const { to[i] = D::Deriv::Ones(); }
  };
  /// The diagonal blocks of S, and no motion.
  struct TakeSystem {
    ConvexProblem q;
    SINEW_HD void operator()(int i) const {
      Block d = Block::Identity();
      if (i >= q.points) {
        d(0, 0) = q.slack[i - q.points];
      } else {
        MotionBody<D> const& b = q.bodyOf(i);
        const int place = b.diagonal[i - b.begin];
        for (int r = 0; r < 3; ++r)
          for (int c = 0; c < 3; ++c)
            if (!q.holds(i, r) && !q.holds(i, c))
              d(r, c) = b.scale * double(BlockRows<D>::at(b.product.values, place, 3 * r + c));
      }
      q.store(q.system, i, d);
      q.put(q.velocity, i, Vector(Vector::Zero()));
    }
  };
  /// W of each row, with the diagonal blocks of S alone.
  struct EstimateCompliance {
    ConvexProblem q;
    SINEW_HD void operator()(int k) const {
      ConstraintBlock const& b = q.block[k];
      for (int r = 0; r < b.rows; ++r) q.compliance[b.first + r] = 0;
      for (int e = q.ends[k]; e < q.ends[k + 1]; ++e) {
        Block inverse;
        invert(q.load(q.system, q.point[e]), inverse);
        for (int r = 0; r < b.rows; ++r) {
          const Vector j = q.row(e, r), moved = inverse * j;
          q.compliance[b.first + r] += j[0] * moved[0] + j[1] * moved[1] + j[2] * moved[2];
        }
      }
    }
  };

  SINEW_INLINE bool holds(int i, int c) const { return i < points && (held[i] >> c & 1); }
  SINEW_INLINE MotionBody<D> const& bodyOf(int i) const {
    MotionBody<D> const* b = body;
    while (i >= b->begin + b->points) ++b;
    return *b;
  }

  // what a team does

  template <class Team>
  SINEW_HD void operator()(Team& team) const {
    Solution<Team>{team, *this}.run();
  }

 private:
  template <class Team>
  struct Solution {
    Team& team;
    ConvexProblem const& q;
    ConvexProblemResult found{0, 0, 0, 0, 0, 0, 1};
    double rho = 0;

    SINEW_INLINE void run() {
      // A v
      team.eachRow(q.all, [&](int i, int lane) {
        double sum[3] = {0, 0, 0};
        addRow(
            i, lane, [&](int j) { return q.at(q.velocity, j); }, sum);
        team.sumOfRow(sum);
        if (lane == 0) put(q.momentum, i, sum);
      });
      double size = evaluate();
      const double first = size;
      bool stuck = false;
      for (int i = 0; i < q.maxNewtonIterations && !stuck; ++i) {
        if (!(size <= largest)) {
          found.finite = 0;
          break;
        }
        if (found.momentum <= q.momentumTolerance) break;
        // the last problem is solved to the end
        if (size <= q.reduction * first && found.residual > q.tolerance) break;
        stuck = found.conjugateGradients >= q.maxConjugateGradients || !newton();
        size = evaluate();
      }
      found.stuck = stuck;
      if (team.first()) *q.result = found;
    }

   private:
    static constexpr double largest = 1.7e308;

    SINEW_INLINE void put(double* of, int i, double const (&v)[3]) const {
      for (int c = 0; c < 3; ++c) of[3 * i + c] = q.holds(i, c) ? 0 : v[c];
    }
    // the part of a lane of S p in a point
    template <class P>
    SINEW_INLINE void addRow(int i, int lane, P&& p, double (&sum)[3]) const {
      if (i >= q.points) {
        if (lane != 0) return;
        const Vector v = p(i);
        sum[0] += q.slack[i - q.points] * v[0];
        sum[1] += v[1];
        sum[2] += v[2];
        return;
      }
      using Rows = BlockRows<D>;
      MotionBody<D> const& b = q.bodyOf(i);
      const int row = i - b.begin, slice = row / Rows::slice, end = b.product.sliceFirst[slice + 1];
      double own[3] = {0, 0, 0};
      for (int place = b.product.sliceFirst[slice] + row % Rows::slice + lane * Rows::slice; place < end;
           place += Team::lanes * Rows::slice) {
        const Vector v = p(b.begin + b.product.column[place]);
        for (int r = 0; r < 3; ++r)
          for (int c = 0; c < 3; ++c) own[r] += double(Rows::at(b.product.values, place, 3 * r + c)) * v[c];
      }
      for (int c = 0; c < 3; ++c) sum[c] += b.scale * own[c];
    }
    // the same of J' G J p
    template <class P>
    SINEW_INLINE void addTerms(int i, int lane, int lanes, P&& p, double (&sum)[3]) const {
      for (int k = q.ofPoint[i] + lane; k < q.ofPoint[i + 1]; k += lanes) {
        const int e = q.entry[k], of = q.blockOf[e];
        ConstraintBlock const& b = q.block[of];
        double w[ConstraintBlock::maxRows];
        rates(of, p, w);
        contact_potential::multiply(b, q.curvature + 3 * b.first, w);
        for (int r = 0; r < b.rows; ++r) {
          const Vector j = q.row(e, r);
          for (int c = 0; c < 3; ++c) sum[c] += j[c] * w[r];
        }
      }
    }
    // J p of a block
    template <class P>
    SINEW_INLINE void rates(int k, P&& p, double* w) const {
      const int n = q.block[k].rows;
      for (int r = 0; r < n; ++r) w[r] = 0;
      for (int e = q.ends[k]; e < q.ends[k + 1]; ++e) {
        const Vector v = p(q.point[e]);
        for (int r = 0; r < n; ++r) {
          const Vector j = q.row(e, r);
          w[r] += j[0] * v[0] + j[1] * v[1] + j[2] * v[2];
        }
      }
    }
    SINEW_INLINE contact_potential::Rows rowsOf(ConstraintBlock const& b) const {
      return {q.regularisation + b.first,
              q.before + b.first,
              q.lag == FrictionLag::bound ? q.lagged[b.first] : contact_potential::cone};
    }
    // d + t w + s
    SINEW_INLINE void violationAt(ConstraintBlock const& b, double t, double* d) const {
      for (int r = 0; r < b.rows; ++r) {
        d[r] = q.violation[b.first + r];
        if (t != 0) d[r] += t * q.rate[b.first + r];
      }
      if (q.lag == FrictionLag::gap) d[0] += q.lagged[b.first];
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
            b, q.lag, mean / b.rows, q.violation + b.first, q.multipliers + b.first);
        local[3] = away > local[3] ? away : local[3];
      });
      team.sync();
      team.each(q.all, [&](int i) {
        Vector reaction = Vector::Zero();
        Block sum = q.load(q.system, i), inverse;
        for (int k = q.ofPoint[i]; k < q.ofPoint[i + 1]; ++k) addEntry(q.entry[k], reaction, sum);
        invert(sum, inverse);
        const Vector momentum = q.at(q.momentum, i), gradient = momentum - reaction;
        const Vector steepest = -(inverse * gradient), v = q.at(q.velocity, i), answer = inverse * reaction;
        q.store(q.inverse, i, inverse);
        q.put(q.gradient, i, gradient);
        q.put(q.residual, i, -gradient);
        q.put(q.scaled, i, steepest);
        q.put(q.step, i, Vector(Vector::Zero()));
        for (int c = 0; c < 3; ++c) {
          local[0] += v[c] * momentum[c];
          local[1] += reaction[c] * answer[c];
          local[2] -= gradient[c] * steepest[c];
        }
      });
      team.template reduce<3>(local);
      const double energy = local[0] > local[1] ? local[0] : local[1];
      const double size = local[2] > 0 ? std::sqrt(local[2]) : local[2] <= 0 ? 0 : local[2];
      found.momentum = energy > 0 ? size / std::sqrt(energy) : size;
      found.residual = local[3];
      rho = local[2];
      return size;
    }
    // J' f and J' G J of an entry
    SINEW_INLINE void addEntry(int e, Vector& reaction, Block& sum) const {
      ConstraintBlock const& b = q.block[q.blockOf[e]];
      double const *const f = q.multipliers + b.first, *const G = q.curvature + 3 * b.first;
      const bool friction = b.kind == ConstraintBlock::Kind::friction;
      for (int r = 0; r < b.rows; ++r) {
        const Vector j = q.row(e, r);
        for (int c = 0; c < 3; ++c) reaction[c] += f[r] * j[c];
        Vector curved = G[r] * j;
        if (friction) {
          curved.setZero();
          for (int s = 0; s < 3; ++s) {
            const Vector other = q.row(e, s);
            for (int c = 0; c < 3; ++c) curved[c] += G[3 * s + r] * other[c];
          }
        }
        for (int c = 0; c < 3; ++c)
          for (int a = 0; a < 3; ++a) sum(a, c) += j[a] * curved[c];
      }
    }

    // A Newton step by conjugate gradients and an exact line search; false where no direction was found.
    SINEW_INLINE bool newton() {
      found.newtonIterations += 1;
      const double end = q.forcing * q.forcing * rho;
      double beta = 0;
      int which = 0;
      bool any = false;
      while (rho > end && found.conjugateGradients < q.maxConjugateGradients) {
        found.conjugateGradients += 1;
        // p = z + beta p on the way; what others still read is in the other vector
        double const* const last = q.direction[which];
        double* const next = q.direction[1 - which];
        auto p = [&](int j) {
          Vector v = q.at(q.scaled, j);
          if (beta != 0)
            for (int c = 0; c < 3; ++c) v[c] += beta * last[3 * j + c];
          return v;
        };
        double curvature[1] = {0};
        team.eachRow(q.all, [&](int i, int lane) {
          double sum[3] = {0, 0, 0};
          addRow(i, lane, p, sum);
          addTerms(i, lane, Team::lanes, p, sum);
          team.sumOfRow(sum);
          if (lane != 0) return;
          const Vector own = p(i);
          q.put(next, i, own);
          put(q.product, i, sum);
          for (int c = 0; c < 3; ++c) curvature[0] += own[c] * sum[c];
        });
        team.template reduce<1>(curvature);
        if (!(curvature[0] > 0)) break;
        any = true;
        const double alpha = rho / curvature[0];
        double now[1] = {0};
        team.each(q.all, [&](int i) {
          Vector left;
          for (int c = 0; c < 3; ++c) {
            q.step[3 * i + c] += alpha * next[3 * i + c];
            left[c] = q.residual[3 * i + c] - alpha * q.product[3 * i + c];
          }
          const Vector z = q.load(q.inverse, i) * left;
          q.put(q.residual, i, left);
          q.put(q.scaled, i, z);
          for (int c = 0; c < 3; ++c) now[0] += left[c] * z[c];
        });
        team.template reduce<1>(now);
        beta = now[0] / rho;
        rho = now[0];
        which = 1 - which;
      }
      if (!any) return false;
      // A dv = -grad - residual - J' G J dv
      double line[2] = {0, 0};
      auto step = [&](int j) { return q.at(q.step, j); };
      team.each(q.all, [&](int i) {
        double terms[3] = {0, 0, 0};
        addTerms(i, 0, 1, step, terms);
        for (int c = 0; c < 3; ++c) {
          const int k = 3 * i + c;
          q.product[k] = -(terms[c] + q.gradient[k] + q.residual[k]);
          line[0] += q.step[k] * q.momentum[k];
          line[1] += q.step[k] * q.product[k];
        }
      });
      team.each(q.blocks, [&](int k) { rates(k, step, q.rate + q.block[k].first); });
      team.template reduce<2>(line);
      int looks = 0;
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
          looks);
      found.lineSearches += looks;
      team.each(q.all, [&](int i) {
        for (int c = 3 * i; c < 3 * i + 3; ++c) {
          q.velocity[c] += t * q.step[c];
          q.momentum[c] += t * q.product[c];
        }
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
