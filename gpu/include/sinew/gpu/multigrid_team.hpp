// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/gpu/multigrid_loops.hpp>
#include <sinew/gpu/system_rows.hpp>
#include <sinew/gpu/whole_team.hpp>
#include <sinew/solver/linear_system.hpp>

#include <array>
#include <cmath>
#include <cstddef>

namespace sinew::gpu {

namespace multigrid {

/// One level as the threads of a team see it.
template <int R>
struct LevelView {
  int points;
  Rows<R> rows;
  float const* product;
  float *x, *r, *d[2];
  double const* bound;
  // the way down
  int const *start, *columns;                         // rows of P
  int const *turnedStart, *turnedRows, *turnedSlots;  // columns of P
  float const* p;
};

}  // namespace multigrid

/// Conjugate gradients with a multigrid cycle, all of a solve in one kernel: its threads go through the loops
/// of MultigridCycle with the same bodies, and wait for each other behind each. So nothing is launched within
/// an iteration, which for small bodies takes longer than the work. The product is of the answer z of the
/// cycle, so that its sums come together, and that of the direction p follows: A p = A z + beta (A p before)
/// (Chronopoulos, Gear 1989).
template <class D>
struct MultigridTeam {
  using Real = typename D::Real;
  using Deriv = typename D::Deriv;
  static constexpr int mostLevels = 6;
  static constexpr std::size_t entryBytes = 0;

  multigrid::LevelView<3> fine;
  std::array<multigrid::LevelView<6>, mostLevels> coarse;
  int levels;  // coarse ones
  double const* dense;
  int unknowns;  // of the dense factor; 0: the last level is smoothed
  int degree;
  double const *unit, *diagonalSize;
  typename BlockRows<D>::RowProduct product;
  unsigned char const* held;
  Deriv *x, *r, *p, *q, *z, *s;  // q = A p, s = A z
  int iterations;
  double tolerance;
  double* residuals;  // how many there are, then each: of the start, and after each iteration

  template <class Team>
  SINEW_HD void operator()(Team& team) const {
    const int n = fine.points;
    double first[1] = {0};
    team.each(n, [&](int i) {
      for (int c = 0; c < 3; ++c) first[0] += double(r[i][c]) * double(r[i][c]);
    });
    team.template reduce<1>(first);
    const double whole = first[0];
    const bool finite = whole - whole == 0;
    int found = 1;
    if (team.first()) residuals[1] = 1;
    if (!finite)
      team.each(n, [&](int i) {
        for (int c = 0; c < 3; ++c) x[i][c] = Real(notSolved);
      });
    if (finite && whole > 0 && tolerance < 1) {
      double scaledBy = whole, size = whole, curvature = 0;
      team.each(n, [&](int i) { enter(i, &scaledBy); });
      team.barrier();
      for (int k = 0; k < iterations; ++k) {
        // r.z, q.z and z.s
        double sums[3] = {0, 0, 0};
        cycle(team, [&](int i) {
          const multigrid::Leave<D> leave{unit, fine.x, diagonalSize, &scaledBy, n, r, z};
          sums[0] += leave(i);
        });
        sumRows<8, 3, Real>(
            team,
            n,
            [&](int i, int lane, int lanes, Real* sum) { addRow(i, lane, lanes, sum); },
            [&](int i, Real const* sum) {
              const int bits = held ? held[i] : 0;
              for (int c = 0; c < 3; ++c) {
                const Real value = bits >> c & 1 ? Real(0) : sum[c];
                s[i][c] = value;
                const double along = double(z[i][c]);
                if (k > 0) sums[1] += double(q[i][c]) * along;
                sums[2] += double(value) * along;
              }
            });
        team.template reduce<3>(sums);
        // in the form of Polak and Ribiere: (r - r before).z / (r.z before) = -q.z / p.q
        const double beta = k == 0 || curvature == 0 ? 0 : -sums[1] / curvature;
        curvature = sums[2] + beta * (2 * sums[1] + beta * curvature);
        const Real alpha = curvature == 0 ? Real(0) : Real(sums[0] / curvature), b = Real(beta);
        // scaled by the size that the residual had, which the sum of this loop says too late
        scaledBy = size;
        double next[1] = {0};
        team.each(n, [&](int i) {
          for (int c = 0; c < 3; ++c) {
            const Real along = k == 0 ? z[i][c] : z[i][c] + b * p[i][c];
            const Real pushed = k == 0 ? s[i][c] : s[i][c] + b * q[i][c];
            p[i][c] = along;
            q[i][c] = pushed;
            x[i][c] += alpha * along;
            const Real left = r[i][c] - alpha * pushed;
            r[i][c] = left;
            next[0] += double(left) * double(left);
          }
          enter(i, &scaledBy);
        });
        team.template reduce<1>(next);
        size = next[0];
        if (team.first()) residuals[1 + found] = std::sqrt(size / whole);
        ++found;
        if (!(size > tolerance * tolerance * whole)) break;
      }
    }
    if (team.first()) residuals[0] = found;
    team.sync();
  }

 private:
  /// For i = 0 .. n - 1 finish(i, sum) by one thread, of what the lanes that share it have added by part(i,
  /// lane, lanes, sum); warps of all blocks take turns.
  template <int Lanes, int Sums, class Number, class Team, class Part, class Finish>
  SINEW_INLINE static void sumRows(Team& team, int n, Part&& part, Finish&& finish) {
    team.template eachTeamOf<Lanes>(n, [&](int i, int lane, int lanes, auto&& joined) {
      Number sum[Sums];
      for (Number& of : sum) of = Number(0);
      if (i < n) part(i, lane, lanes, sum);
      joined(sum);
      if (i < n && lane == 0) finish(i, static_cast<Number const*>(sum));
    });
  }
  // a body of for_each_row, and then(i) behind its finish
  template <int Lanes, class Team, class Body, class Then>
  SINEW_INLINE static void run(Team& team, int n, Body const& body, Then&& then) {
    sumRows<Lanes, Body::sums, typename Body::Real>(
        team,
        n,
        [&](int i, int lane, int lanes, typename Body::Real* sum) { body.part(i, lane, lanes, sum); },
        [&](int i, typename Body::Real const* sum) {
          body.finish(i, sum);
          then(i);
        });
  }
  struct Nothing {
    SINEW_INLINE void operator()(int) const {}
  };
  template <int R>
  static constexpr int lanesOf = R == 3 ? 8 : 32;

  // the residual of a point as the cycle has it, scaled by |r| of before
  SINEW_INLINE void enter(int i, double const* square) const {
    multigrid::Enter<D>{unit,
                        r,
                        diagonalSize,
                        square,
                        fine.bound,
                        fine.points,
                        ChebyshevSmoother::gain(1),
                        fine.r,
                        fine.d[0],
                        fine.x}(i);
  }
  // sum += A z of a row, in the part of a lane
  SINEW_INLINE void addRow(int row, int lane, int lanes, Real* sum) const {
    using Rows = BlockRows<D>;
    const int slice = row / Rows::slice, end = product.sliceFirst[slice + 1];
#if defined(__CUDA_ARCH__)
#pragma unroll 4
#endif
    for (int place = product.sliceFirst[slice] + row % Rows::slice + lane * Rows::slice; place < end;
         place += lanes * Rows::slice) {
      Deriv const& from = z[product.column[place]];
      for (int a = 0; a < 3; ++a)
        for (int c = 0; c < 3; ++c) sum[a] += Rows::at(product.values, place, 3 * a + c) * from[c];
    }
  }

  // x of the finest level from its r, whose first step has been made; leave(i) behind the last change of a
  // point, by one thread for each
  template <class Team, class Leave>
  SINEW_INLINE void cycle(Team& team, Leave&& leave) const {
    if (levels == 0) {
      solveLast(team, fine);
      team.each(fine.points, leave);
      team.barrier();
      return;
    }
    int current[mostLevels + 1];
    current[0] = down(team, fine, coarse[0]);
    for (int k = 0; k + 1 < levels; ++k)
      current[k + 1] = down(team, coarse[std::size_t(k)], coarse[std::size_t(k) + 1]);
    solveLast(team, coarse[std::size_t(levels) - 1]);
    for (int k = levels - 2; k >= 0; --k)
      up(team, coarse[std::size_t(k)], coarse[std::size_t(k) + 1], current[k + 1], Nothing{});
    up(team, fine, coarse[0], current[0], leave);
  }
  template <int R, class Team>
  SINEW_INLINE int down(Team& team, multigrid::LevelView<R> const& level,
                        multigrid::LevelView<6> const& below) const {
    const int current = smooth(team, level, 2, degree, true, 0, Nothing{});
    run<32>(team,
            below.points,
            multigrid::Restrict<R>{level.turnedStart,
                                   level.turnedRows,
                                   level.turnedSlots,
                                   level.p,
                                   level.r,
                                   below.bound,
                                   ChebyshevSmoother::gain(1),
                                   below.r,
                                   below.d[0],
                                   below.x},
            Nothing{});
    team.barrier();
    return current;
  }
  template <int R, class Team, class Leave>
  SINEW_INLINE void up(Team& team, multigrid::LevelView<R> const& level, multigrid::LevelView<6> const& below,
                       int current, Leave&& leave) const {
    const multigrid::Prolong<R> prolong{
        level.start, level.columns, level.p, below.x, level.d[current], level.x};
    team.each(level.points * R, [&](int i) { prolong(i); });
    team.barrier();
    smooth(team, level, 1, degree, false, current, leave);
  }
  // steps of the smoother, as Level::smooth has them, and leave(i) behind the last of a point; returns which
  // of d is the last direction
  template <int R, class Team, class Leave>
  SINEW_INLINE int smooth(Team& team, multigrid::LevelView<R> const& level, int from, int to, bool wanted,
                          int current, Leave&& leave) const {
    for (int k = from; k <= to + int(wanted); ++k) {
      const bool last = k > to;
      run<lanesOf<R>>(team,
                      level.points,
                      multigrid::Smooth<R>{level.rows,
                                           level.product,
                                           level.d[current],
                                           level.d[1 - current],
                                           level.x,
                                           level.r,
                                           level.bound,
                                           k == 1 || last ? 0.f : ChebyshevSmoother::turn(k),
                                           last ? 0.f : ChebyshevSmoother::gain(k),
                                           last},
                      [&](int i) {
                        if (k == to) leave(i);
                      });
      team.barrier();
      if (!last) current = 1 - current;
    }
    return current;
  }
  template <int R, class Team>
  SINEW_INLINE void solveLast(Team& team, multigrid::LevelView<R> const& level) const {
    if (unknowns == 0) {
      smooth(team, level, 2, 2 * degree, false, 0, Nothing{});
      return;
    }
    run<32>(team, unknowns, multigrid::Solve<R>{dense, unknowns, level.r, level.x}, Nothing{});
    team.barrier();
  }
};

/// Points of the largest bodies whose solves are one kernel; larger ones are as fast by a launch for each
/// loop. Tests ask for others.
inline std::size_t& most_points_of_whole_multigrid() {
  static thread_local std::size_t most = 36000;
  return most;
}

}  // namespace sinew::gpu
