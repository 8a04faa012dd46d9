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
/// of MultigridCycle and of multigrid_gradients with the same bodies, and wait for each other behind each. So
/// nothing is launched within an iteration, which for small bodies takes longer than the work.
template <class D>
struct MultigridTeam {
  using Real = typename D::Real;
  using Deriv = typename D::Deriv;
  static constexpr int mostLevels = 6;
  // of a row of the finest level in the cycle and in the product, and of one of the next level
  static constexpr std::size_t entryBytes = 9 * sizeof(float) + sizeof(int) + 9 * sizeof(Real);
  static constexpr std::size_t threadBytes = 36 * sizeof(float) + sizeof(int);

  multigrid::LevelView<3> fine;
  std::array<multigrid::LevelView<6>, mostLevels> coarse;
  int levels;  // coarse ones
  double const* dense;
  int unknowns;  // of the dense factor; 0: the last level is smoothed
  int degree;
  double const *unit, *diagonalSize;
  typename BlockRows<D>::RowProduct product;
  unsigned char const* held;
  Deriv *x, *r, *p, *q, *z;
  int iterations;
  double tolerance;
  double* residuals;  // how many there are, then each: of the start, and after each iteration

  template <class Team>
  SINEW_HD void operator()(Team& team) const {
    const int n = fine.points;
    const Kept kept = keep(team);
    double sums[2] = {0, 0};
    team.each(n, [&](int i) {
      for (int c = 0; c < 3; ++c) sums[0] += double(r[i][c]) * double(r[i][c]);
    });
    team.template reduce<2>(sums);
    const double whole = sums[0];
    int found = 1;
    if (team.first()) residuals[1] = 1;
    const bool finite = whole - whole == 0;
    if (!finite)
      team.each(n, [&](int i) {
        for (int c = 0; c < 3; ++c) x[i][c] = Real(notSolved);
      });
    if (finite && whole > 0 && tolerance < 1) {
      double size = whole, rho = precondition(team, kept, size, nullptr);
      team.each(n, [&](int i) { p[i] = z[i]; });
      team.sync();
      for (int k = 0; k < iterations; ++k) {
        double curvature[1] = {0};
        sumRows<8, 3, Real>(
            team,
            n,
            [&](int i, int lane, int lanes, Real* sum) { addProduct(team, kept, i, lane, lanes, sum); },
            [&](int i, Real const* sum) {
              const int bits = held ? held[i] : 0;
              for (int c = 0; c < 3; ++c) {
                const Real value = bits >> c & 1 ? Real(0) : sum[c];
                q[i][c] = value;
                curvature[0] += double(value) * double(p[i][c]);
              }
            });
        team.template reduce<1>(curvature);
        const Real alpha = curvature[0] == 0 ? Real(0) : Real(rho / curvature[0]);
        double next[1] = {0};
        team.each(n, [&](int i) {
          for (int c = 0; c < 3; ++c) {
            x[i][c] += alpha * p[i][c];
            const Real left = r[i][c] - alpha * q[i][c];
            r[i][c] = left;
            next[0] += double(left) * double(left);
          }
        });
        team.template reduce<1>(next);
        size = next[0];
        if (team.first()) residuals[1 + found] = std::sqrt(size / whole);
        ++found;
        if (!(size > tolerance * tolerance * whole) || k + 1 == iterations) break;
        double turned = 0;
        rho = precondition(team, kept, size, &turned);
        const Real beta = curvature[0] == 0 ? Real(0) : Real(-turned / curvature[0]);
        team.each(n, [&](int i) {
          for (int c = 0; c < 3; ++c) p[i][c] = z[i][c] + beta * p[i][c];
        });
        team.sync();
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
      for (Number& s : sum) s = Number(0);
      if (i < n) part(i, lane, lanes, sum);
      joined(sum);
      if (i < n && lane == 0) finish(i, static_cast<Number const*>(sum));
    });
  }
  // a body of for_each_row
  template <int Lanes, class Team, class Body>
  SINEW_INLINE static void run(Team& team, int n, Body const& body) {
    sumRows<Lanes, Body::sums, typename Body::Real>(
        team,
        n,
        [&](int i, int lane, int lanes, typename Body::Real* sum) { body.part(i, lane, lanes, sum); },
        [&](int i, typename Body::Real const* sum) { body.finish(i, sum); });
  }
  template <int R>
  static constexpr int lanesOf = R == 3 ? 8 : 32;

  /// What a thread has in shared memory of the matrices, since what is read from that of the GPU comes from
  /// far behind each wait: the first entries of its first row of the finest level, and one block of that of
  /// the next.
  struct Kept {
    int row = -1, used = 0, from = 0, end = 0;  // of the finest; places of what is not kept
    int coarseRow = -1;
    bool hasBlock = false;
  };
  template <class Team>
  SINEW_INLINE Kept keep(Team& team) const {
    using Rows = multigrid::Rows<3>;
    Kept k;
    if (const int row = team.template firstOf<8>(); row >= 0 && row < fine.points) {
      const int lane = int(unsigned(team.lane()) % 8u), slice = row / Rows::slice;
      k.row = row;
      k.from = fine.rows.sliceFirst[slice] + row % Rows::slice + lane * Rows::slice;
      k.end = fine.rows.sliceFirst[slice + 1];
      for (; k.used < team.kept() && k.from < k.end; ++k.used, k.from += 8 * Rows::slice) {
        for (int c = 0; c < 9; ++c) {
          smoothed(team, 9 * k.used + c) = fine.product[Rows::at(k.from, c)];
          multiplied(team, 9 * k.used + c) = BlockRows<D>::at(product.values, k.from, c);
        }
        column(team, k.used) = product.column[k.from];
      }
    }
    if (levels == 0) return k;
    auto const& next = coarse[0];
    if (const int row = team.template firstOf<32>(); row >= 0 && row < next.points) {
      k.coarseRow = row;
      const int block = next.rows.start[row] + team.laneOfWarp();
      k.hasBlock = block < next.rows.start[row + 1];
      if (k.hasBlock) {
        for (int c = 0; c < 36; ++c) coarseBlock(team, c) = next.product[multigrid::Rows<6>::at(block, c)];
        coarseColumn(team) = next.rows.columns[block];
      }
    }
    return k;
  }
  template <class Team>
  SINEW_INLINE static float& smoothed(Team& team, int k) {
    return team.template keeps<float>(0, k);
  }
  template <class Team>
  SINEW_INLINE static Real& multiplied(Team& team, int k) {
    return team.template keeps<Real>(std::size_t(team.kept()) * 9 * sizeof(float), k);
  }
  template <class Team>
  SINEW_INLINE static int& column(Team& team, int k) {
    return team.template keeps<int>(std::size_t(team.kept()) * 9 * (sizeof(float) + sizeof(Real)), k);
  }
  template <class Team>
  SINEW_INLINE static float& coarseBlock(Team& team, int k) {
    return team.template keeps<float>(std::size_t(team.kept()) * entryBytes, k);
  }
  template <class Team>
  SINEW_INLINE static int& coarseColumn(Team& team) {
    return team.template keeps<int>(std::size_t(team.kept()) * entryBytes + 36 * sizeof(float), 0);
  }

  // sum += A p of a row, in the part of a lane
  template <class Team>
  SINEW_INLINE void addProduct(Team& team, Kept const& kept, int row, int lane, int lanes, Real* sum) const {
    using Rows = BlockRows<D>;
    int place = kept.from, end = kept.end;
    if (row == kept.row) {
      for (int k = 0; k < kept.used; ++k) {
        Deriv const& from = p[column(team, k)];
        for (int a = 0; a < 3; ++a)
          for (int c = 0; c < 3; ++c) sum[a] += multiplied(team, 9 * k + 3 * a + c) * from[c];
      }
    } else {
      const int slice = row / Rows::slice;
      place = product.sliceFirst[slice] + row % Rows::slice + lane * Rows::slice;
      end = product.sliceFirst[slice + 1];
    }
    for (; place < end; place += lanes * Rows::slice) {
      Deriv const& from = p[product.column[place]];
      for (int a = 0; a < 3; ++a)
        for (int c = 0; c < 3; ++c) sum[a] += Rows::at(product.values, place, 3 * a + c) * from[c];
    }
  }
  // the same of a level, with its direction d; `next`: it is the first of the coarse ones
  template <int R, class Team>
  SINEW_INLINE void addLevel(Team& team, Kept const& kept, multigrid::LevelView<R> const& level,
                             [[maybe_unused]] bool next, float const* d, int row, int lane, int lanes,
                             float* sum) const {
    if constexpr (R == 3) {
      using Rows = multigrid::Rows<3>;
      if (row == kept.row) {
        for (int k = 0; k < kept.used; ++k) {
          float const* const v = d + 3 * std::ptrdiff_t(column(team, k));
          for (int a = 0; a < 3; ++a)
            for (int c = 0; c < 3; ++c) sum[a] += smoothed(team, 9 * k + 3 * a + c) * v[c];
        }
        for (int place = kept.from; place < kept.end; place += lanes * Rows::slice) {
          float const* const v = d + 3 * std::ptrdiff_t(level.rows.columns[place]);
          for (int a = 0; a < 3; ++a)
            for (int c = 0; c < 3; ++c) sum[a] += level.product[Rows::at(place, 3 * a + c)] * v[c];
        }
        return;
      }
    } else if (next && row == kept.coarseRow) {
      if (kept.hasBlock) {
        float const* const v = d + 8 * std::ptrdiff_t(coarseColumn(team));
        for (int a = 0; a < 6; ++a)
          for (int c = 0; c < 6; ++c) sum[a] += coarseBlock(team, 6 * a + c) * v[c];
      }
      lane += lanes;
    }
    multigrid::add_row<R>(level.rows, level.product, d, row, lane, lanes, sum);
  }

  // z = M^-1 r; returns r.z, *turned = q.z where it is wanted
  template <class Team>
  SINEW_INLINE double precondition(Team& team, Kept const& kept, double square, double* turned) const {
    using namespace multigrid;
    const int n = fine.points;
    const Enter<D> enter{
        unit, r, diagonalSize, &square, fine.bound, n, ChebyshevSmoother::gain(1), fine.r, fine.d[0], fine.x};
    team.each(n, [&](int i) { enter(i); });
    team.sync();
    cycle(team, kept);
    const Leave<D> leave{unit, fine.x, diagonalSize, &square, n, r, z};
    double sums[2] = {0, 0};
    team.each(n, [&](int i) {
      sums[0] += leave(i);
      if (turned)
        for (int c = 0; c < 3; ++c) sums[1] += double(q[i][c]) * double(z[i][c]);
    });
    team.template reduce<2>(sums);
    if (turned) *turned = sums[1];
    return sums[0];
  }

  template <class Team>
  SINEW_INLINE void cycle(Team& team, Kept const& kept) const {
    if (levels == 0) {
      solveLast(team, kept, fine, false);
      return;
    }
    int current[mostLevels + 1];
    current[0] = down(team, kept, fine, false, coarse[0]);
    for (int k = 0; k + 1 < levels; ++k)
      current[k + 1] = down(team, kept, coarse[std::size_t(k)], k == 0, coarse[std::size_t(k) + 1]);
    solveLast(team, kept, coarse[std::size_t(levels) - 1], levels == 1);
    for (int k = levels - 2; k >= 0; --k)
      up(team, kept, coarse[std::size_t(k)], k == 0, coarse[std::size_t(k) + 1], current[k + 1]);
    up(team, kept, fine, false, coarse[0], current[0]);
  }
  template <int R, class Team>
  SINEW_INLINE int down(Team& team, Kept const& kept, multigrid::LevelView<R> const& level, bool next,
                        multigrid::LevelView<6> const& below) const {
    const int current = smooth(team, kept, level, next, 2, degree, true, 0);
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
                                   below.x});
    team.sync();
    return current;
  }
  template <int R, class Team>
  SINEW_INLINE void up(Team& team, Kept const& kept, multigrid::LevelView<R> const& level, bool next,
                       multigrid::LevelView<6> const& below, int current) const {
    const multigrid::Prolong<R> prolong{
        level.start, level.columns, level.p, below.x, level.d[current], level.x};
    team.each(level.points * R, [&](int i) { prolong(i); });
    team.sync();
    smooth(team, kept, level, next, 1, degree, false, current);
  }
  // steps of the smoother, as Level::smooth has them; returns which of d is the last direction
  template <int R, class Team>
  SINEW_INLINE int smooth(Team& team, Kept const& kept, multigrid::LevelView<R> const& level, bool next,
                          int from, int to, bool wanted, int current) const {
    for (int k = from; k <= to + int(wanted); ++k) {
      const bool last = k > to;
      float const* const d = level.d[current];
      const multigrid::Smooth<R> step{level.rows,
                                      level.product,
                                      d,
                                      level.d[1 - current],
                                      level.x,
                                      level.r,
                                      level.bound,
                                      k == 1 || last ? 0.f : ChebyshevSmoother::turn(k),
                                      last ? 0.f : ChebyshevSmoother::gain(k),
                                      last};
      sumRows<lanesOf<R>, R, float>(
          team,
          level.points,
          [&](int i, int lane, int lanes, float* sum) {
            addLevel<R>(team, kept, level, next, d, i, lane, lanes, sum);
          },
          [&](int i, float const* sum) { step.finish(i, sum); });
      team.sync();
      if (!last) current = 1 - current;
    }
    return current;
  }
  template <int R, class Team>
  SINEW_INLINE void solveLast(Team& team, Kept const& kept, multigrid::LevelView<R> const& level,
                              bool next) const {
    if (unknowns == 0) {
      smooth(team, kept, level, next, 2, 2 * degree, false, 0);
      return;
    }
    run<32>(team, unknowns, multigrid::Solve<R>{dense, unknowns, level.r, level.x});
    team.sync();
  }
};

/// Points of the largest bodies whose solves are one kernel; larger ones are as fast by a launch for each
/// loop. Tests ask for others.
inline std::size_t& most_points_of_whole_multigrid() {
  static thread_local std::size_t most = 40000;
  return most;
}

}  // namespace sinew::gpu
