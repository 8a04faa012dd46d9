// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/gpu/system_rows.hpp>
#include <sinew/gpu/whole_team.hpp>

#include <Eigen/Core>

#include <cstddef>
#include <utility>

namespace sinew::gpu {

/// The vectors of conjugate gradients by a team, three numbers a point: x, the residual r, u = P^-1 r with
/// the preconditioner P, w = A u, and those by which they change.
struct GradientVectors {
  double *solution, *residual, *scaled, *product;
  double *p, *s, *q, *z, *m[2];

  static constexpr std::size_t count = 10;
  SINEW_HD static GradientVectors in(double* memory, std::size_t points) {
    auto next = [&] { return std::exchange(memory, memory + 3 * points); };
    GradientVectors v{};
    for (double** of :
         {&v.solution, &v.residual, &v.scaled, &v.product, &v.p, &v.s, &v.q, &v.z, &v.m[0], &v.m[1]})
      *of = next();
    return v;
  }
};

/// How many components of a point a lane has at most.
template <class Team>
inline constexpr int components = Team::lanes < 3 ? 3 : 1;

struct GradientsFound {
  int iterations = 0;
  bool any = false;  // the solution has changed
};

/// Pipelined conjugate gradients (Ghysels, Vanroose 2014) by all threads of a team, for so many points: what
/// others need of an iteration and its sums are exchanged together, so that blocks wait for each other once
/// an iteration. At first `solution` is 0, and `residual` and `scaled` are there; rho is their product, at
/// the end that of the last ones. Ends where rho <= end, after `most` iterations, and where usable(curvature)
/// is false. add(i, lane, p, sum) adds the part of a lane of the product with p in a point, hold(i, sum)
/// takes away what is held, apply(i, c, r) is component c of the preconditioner's answer.
template <class Team, class Add, class Hold, class Apply, class Usable>
SINEW_INLINE GradientsFound team_gradients(Team& team, int points, GradientVectors const& v, double& rho,
                                           double end, int most, Add&& add, Hold&& hold, Apply&& apply,
                                           Usable&& usable) {
  GradientsFound found;
  // read(k), then write(k, number k of the product with p, what was read); a lane has one component of a
  // point. What a lane reads is read at once: behind a write it would wait for each.
  auto multiply = [&](double const* p, auto&& read, auto&& write) {
    team.eachRow(points, [&](int i, int lane) {
      decltype(read(0)) was[components<Team>]{};
      for (int c = lane; c < 3; c += Team::lanes) was[c / Team::lanes] = read(3 * i + c);
      double sum[3] = {0, 0, 0};
      add(
          i, lane, [&](int j) { return vector_at(p, j); }, sum);
      team.sumOfRow(sum);
      hold(i, sum);
      for (int c = 0; c < 3; ++c)
        if (c % Team::lanes == lane) write(3 * i + c, sum[c], was[c / Team::lanes]);
    });
  };
  struct Nothing {};
  if (rho > end && most > 0)
    multiply(
        v.scaled, [](int) { return Nothing{}; }, [&](int k, double value, Nothing) { v.product[k] = value; });
  double last = 0, lastAlpha = 0;
  while (rho > end && found.iterations < most) {
    double* const m = v.m[found.iterations % 2];  // what others still read is in the other one
    double local[2] = {0, 0};
    team.syncRows();
    team.eachRow(points, [&](int i, int lane) {
      for (int c = lane; c < 3; c += Team::lanes) {
        const int k = 3 * i + c;
        const double r = v.residual[k], u = v.scaled[k], w = v.product[k];
        m[k] = apply(i, c, vector_at(v.product, i));
        local[0] += r * u;
        local[1] += w * u;
      }
    });
    team.template reduce<2>(local);
    rho = local[0];
    if (!(rho > end)) break;
    const double beta = found.iterations == 0 ? 0 : rho / last;
    const double curvature = found.iterations == 0 ? local[1] : local[1] - beta * rho / lastAlpha;
    ++found.iterations;
    if (!usable(curvature)) break;
    const double alpha = rho / curvature;
    last = rho;
    lastAlpha = alpha;
    const bool first = !std::exchange(found.any, true);
    struct Own {
      double x, r, u, w, p, s, q, z, m;
    };
    auto goOn = [&](double change, double before) { return first ? change : change + beta * before; };
    multiply(
        m,
        [&](int k) {
          return Own{
              v.solution[k], v.residual[k], v.scaled[k], v.product[k], v.p[k], v.s[k], v.q[k], v.z[k], m[k]};
        },
        [&](int k, double product, Own const& own) {
          const double p = goOn(own.u, own.p), s = goOn(own.w, own.s), q = goOn(own.m, own.q),
                       z = goOn(product, own.z);
          v.p[k] = p;
          v.s[k] = s;
          v.q[k] = q;
          v.z[k] = z;
          v.solution[k] = own.x + alpha * p;
          v.residual[k] = own.r - alpha * s;
          v.scaled[k] = own.u - alpha * q;
          v.product[k] = own.w - alpha * z;
        });
  }
  if (found.iterations == most) team.sync();  // what others are to read
  return found;
}

/// Conjugate gradients without a preconditioner for a system of assembled bodies, as one kernel: x = S^-1 b,
/// and the residual stays in its vector.
template <class D>
struct SystemGradients {
  struct Sides {
    typename D::Deriv const* b;
    typename D::Deriv* x;
  };
  SystemOfBodies<D> system;
  Sides const* sides;  // of each body
  GradientVectors vectors;
  double tolerance2, threshold;
  int iterations;

  static constexpr std::size_t entryBytes = TeamRows<D, WholeTeam>::entryBytes;

  template <class Team>
  SINEW_HD void operator()(Team& team) const {
    using Vector = Eigen::Vector3d;
    using Real = typename D::Real;
    const TeamRows<D, Team> rows(team, system);
    double size[1] = {0};
    eachOf(team, [&](int i, Sides const& of, int own) {
      for (int c = 0; c < 3; ++c) {
        const double b = double(of.b[own][c]);
        vectors.residual[3 * i + c] = vectors.scaled[3 * i + c] = b;
        vectors.solution[3 * i + c] = 0;
        size[0] += b * b;
      }
    });
    team.template reduce<1>(size);
    double rho = size[0];
    team_gradients(
        team,
        system.all,
        vectors,
        rho,
        tolerance2 * rho,
        iterations,
        [&](int i, int lane, auto const& p, double(&sum)[3]) { rows.add(i, lane, p, sum); },
        [&](int i, double(&sum)[3]) { rows.hold(i, sum); },
        [](int, int c, Vector const& r) { return r[c]; },
        [&](double curvature) { return curvature > threshold || curvature < -threshold; });
    eachOf(team, [&](int i, Sides const& of, int own) {
      for (int c = 0; c < 3; ++c) of.x[own][c] = Real(vectors.solution[3 * i + c]);
    });
  }

 private:
  template <class Team, class F>
  SINEW_INLINE void eachOf(Team& team, F&& f) const {
    team.each(system.points, [&](int i) {
      SystemBody<D> const& b = system.bodyOf(i);
      f(i, sides[&b - system.body], i - b.begin);
    });
  }
};

}  // namespace sinew::gpu
