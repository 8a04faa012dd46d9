// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/gpu/system_rows.hpp>
#include <sinew/gpu/whole_team.hpp>

#include <Eigen/Core>

#include <cstddef>

namespace sinew::gpu {

/// The vectors of conjugate gradients by a team, three numbers a point.
struct GradientVectors {
  double *solution, *residual, *scaled, *direction[2], *product;
};

struct GradientsFound {
  int iterations = 0;
  bool any = false;  // the solution has changed
};

/// Conjugate gradients by all threads of a team, for so many points. At first the solution is 0, and `scaled`
/// is the residual after preconditioning, which may be the same vector; rho is their product, at the end that
/// of the last ones. Ends where rho <= end, after `most` iterations, and where usable(curvature) is false.
/// add(i, lane, lanes, p, sum) adds the part of a lane of the product with p in a point, hold(i, sum) takes
/// away what is held, apply(i, r) is the preconditioner.
template <class Team, class Add, class Hold, class Apply, class Usable>
SINEW_INLINE GradientsFound team_gradients(Team& team, int points, GradientVectors const& v, double& rho,
                                           double end, int most, Add&& add, Hold&& hold, Apply&& apply,
                                           Usable&& usable) {
  using Vector = Eigen::Vector3d;
  GradientsFound found;
  double beta = 0;
  int which = 0;
  while (rho > end && found.iterations < most) {
    ++found.iterations;
    // p = z + beta p on the way; what others still read is in the other vector
    double const* const last = v.direction[which];
    double* const next = v.direction[1 - which];
    auto p = [&](int j) {
      Vector z = vector_at(v.scaled, j);
      if (beta != 0)
        for (int c = 0; c < 3; ++c) z[c] += beta * last[3 * j + c];
      return z;
    };
    double curvature[1] = {0};
    team.eachRow(points, [&](int i, int lane) {
      double sum[3] = {0, 0, 0};
      add(i, lane, p, sum);
      team.sumOfRow(sum);
      if (lane != 0) return;
      hold(i, sum);
      const Vector own = p(i);
      put_vector(next, i, own);
      for (int c = 0; c < 3; ++c) {
        v.product[3 * i + c] = sum[c];
        curvature[0] += own[c] * sum[c];
      }
    });
    team.template reduce<1>(curvature);
    if (!usable(curvature[0])) break;
    found.any = true;
    const double alpha = rho / curvature[0];
    double now[1] = {0};
    team.each(points, [&](int i) {
      Vector left;
      for (int c = 0; c < 3; ++c) {
        v.solution[3 * i + c] += alpha * next[3 * i + c];
        left[c] = v.residual[3 * i + c] - alpha * v.product[3 * i + c];
      }
      const Vector z = apply(i, left);
      put_vector(v.residual, i, left);
      put_vector(v.scaled, i, z);
      for (int c = 0; c < 3; ++c) now[0] += left[c] * z[c];
    });
    team.template reduce<1>(now);
    beta = now[0] / rho;
    rho = now[0];
    which = 1 - which;
  }
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
        vectors.residual[3 * i + c] = b;
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
        [](int, Vector const& r) { return r; },
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
