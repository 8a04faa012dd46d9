// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/core/platform.hpp>
#include <sinew/lagrangian/constraint_problem.hpp>

#include <Eigen/Core>

#include <algorithm>
#include <cmath>

namespace sinew {

/// What of Coulomb's law with friction is kept from the solution before, so that the rest derives from a
/// convex potential:
///   bound  the limit mu f_n of the friction (Haslinger 1983): friction as Tresca has it, no gap opens
///   gap    the distance mu |d_t| by which the cone of friction lifts what slides (De Saxce 1992)
///   none   nothing: what slides is lifted by mu |d_t| (Anitescu 2006)
enum class FrictionLag { bound, gap, none };

/// The regularised potential l(d) of a block of constraints, its multipliers f = -dl/dd and its curvature
/// G = d2l/dd2 = -df/dd. g are the multipliers found before (augmented Lagrangian), r > 0 the regularisation
/// of each row, which both tangents of a contact share. With y = g - d / r,
///   equality   l = 1/2 sum r y^2                                                            f = y
///   interval   l = 1/2 r y^2, -r y the signed distance of d - r g from [lower, upper]       f = y
///   contact    l = 1/2 f' r f                                                               f = P(y)
/// where P is the projection on the cone |f_t| <= mu f_n, nearest in the metric r (Castro, Permenter, Han
/// 2022), with a = mu r_t / r_n and t = y_t / |y_t|:
///   sticking   |y_t| <= mu y_n               f = y
///   sliding    -a |y_t| < y_n < |y_t| / mu   f_n = (y_n + a |y_t|) / (1 + mu a),  f_t = mu f_n t
///   open       else                          f = 0
/// or, where a bound c >= 0 of the friction is given (Tresca), with m = min(|y_t|, c),
///              l = 1/2 r_n max(0, y_n)^2 + r_t (m |y_t| - 1/2 m^2)     f_n = max(0, y_n),  f_t = m t
/// All are convex with continuous gradients. A GPU evaluates them by the same functions.
namespace contact_potential {

inline constexpr double cone = -1;  // for a bound, where there is none

using Vector3 = Eigen::Vector3d;
using Curvature = Eigen::Matrix3d;

/// Larger coefficients of friction act as this one: its square and that of ratios of r stay finite.
inline constexpr double largestFriction = 1e8;
/// The friction above which the residual of a contact is another (natural_map).
inline constexpr double steepCone = 10;

struct Projection {
  enum class Region { sticking, sliding, open };

  Vector3 f{0, 0, 0};
  Region region = Region::open;
  double tangential = 0, a = 0, mu = 0;  // |y_t|
};
/// |y_t|
SINEW_HD inline double tangential(Vector3 const& y) { return std::sqrt(y[1] * y[1] + y[2] * y[2]); }

SINEW_HD inline Projection project(double friction, Vector3 const& r, Vector3 const& y) {
  Projection p;
  p.mu = friction < largestFriction ? friction : largestFriction;
  p.tangential = tangential(y);
  p.a = p.mu * r[1] / r[0];
  if (p.tangential <= p.mu * y[0]) {
    p.region = Projection::Region::sticking;
    p.f = y;
  } else if (const double n = (y[0] + p.a * p.tangential) / (1 + p.mu * p.a); n > 0) {
    p.region = Projection::Region::sliding;
    const double t = p.mu * n / p.tangential;
    p.f = {n, t * y[1], t * y[2]};
  }
  return p;
}

SINEW_HD inline Curvature curvature_of(Projection const& p, Vector3 const& r, Vector3 const& y) {
  Curvature G = Curvature::Zero();
  if (p.region == Projection::Region::sticking) {
    G.diagonal() = r.cwiseInverse();
  } else if (p.region == Projection::Region::sliding) {
    const Eigen::Vector2d t(y[1] / p.tangential, y[2] / p.tangential);
    const double share = 1 / (1 + p.mu * p.a);
    const double along = p.mu * p.a * share / r[1], across = p.mu * p.f[0] / (p.tangential * r[1]);
    G(0, 0) = share / r[0];
    G.block<1, 2>(0, 1) = (p.mu * share / r[0]) * t.transpose();
    G.block<2, 1>(1, 0) = G.block<1, 2>(0, 1).transpose();
    G.block<2, 2>(1, 1) = (along - across) * (t * t.transpose()).eval();  // symmetric to the last bit
    G(1, 1) += across;
    G(2, 2) += across;
  }
  return G;
}

SINEW_HD inline Vector3 bounded(double bound, Vector3 const& y) {
  const double t = tangential(y), scale = t <= bound ? 1 : bound / t;
  return {std::max(0., y[0]), scale * y[1], scale * y[2]};
}

SINEW_HD inline Curvature bounded_curvature(double bound, Vector3 const& r, Vector3 const& y) {
  Curvature G = Curvature::Zero();
  if (y[0] >= 0) G(0, 0) = 1 / r[0];
  const double t = tangential(y);
  if (t > bound) {
    const Eigen::Vector2d across(-y[2] / t, y[1] / t);
    G.block<2, 2>(1, 1) = (bound / (t * r[1])) * (across * across.transpose()).eval();
  } else if (bound > 0) {
    G(1, 1) = G(2, 2) = 1 / r[1];
  }
  return G;
}

/// What a block has: pointers to its rows, and the bound of its friction.
struct Rows {
  double const *r, *g;
  double bound;

  SINEW_HD Vector3 regularisation() const { return {r[0], r[1], r[2]}; }
  SINEW_HD Vector3 y(double const* d) const {
    return {g[0] - d[0] / r[0], g[1] - d[1] / r[1], g[2] - d[2] / r[2]};
  }
};

SINEW_HD inline void multipliers(ConstraintBlock const& b, Rows const& rows, double const* d, double* f) {
  switch (b.kind) {
    case ConstraintBlock::Kind::equality:
      for (int i = 0; i < b.rows; ++i) f[i] = rows.g[i] - d[i] / rows.r[i];
      break;
    case ConstraintBlock::Kind::interval: {
      const double shifted = d[0] - rows.r[0] * rows.g[0];
      f[0] = (std::clamp(shifted, b.lower, b.upper) - shifted) / rows.r[0];
      break;
    }
    case ConstraintBlock::Kind::friction: {
      const Vector3 y = rows.y(d);
      Eigen::Map<Vector3>(f, 3) =
          rows.bound >= 0 ? bounded(rows.bound, y) : project(b.friction, rows.regularisation(), y).f;
      break;
    }
  }
}

double value(ConstraintBlock const& b, Rows const& rows, double const* d);

/// G of a block into 3 times its rows numbers: by columns for a contact, else its diagonal comes first. On
/// the border of two regions, that of the one with more forces.
SINEW_HD inline void curvature(ConstraintBlock const& b, Rows const& rows, double const* d, double* G) {
  switch (b.kind) {
    case ConstraintBlock::Kind::equality:
      for (int i = 0; i < b.rows; ++i) G[i] = 1 / rows.r[i];
      break;
    case ConstraintBlock::Kind::interval: {
      const double shifted = d[0] - rows.r[0] * rows.g[0];
      G[0] = shifted <= b.lower || shifted >= b.upper ? 1 / rows.r[0] : 0;
      break;
    }
    case ConstraintBlock::Kind::friction: {
      const Vector3 y = rows.y(d), r = rows.regularisation();
      Eigen::Map<Curvature>(G, 3, 3) = rows.bound >= 0 ? bounded_curvature(rows.bound, r, y)
                                                       : curvature_of(project(b.friction, r, y), r, y);
      break;
    }
  }
}

/// w <- G w
SINEW_HD inline void multiply(ConstraintBlock const& b, double const* G, double* w) {
  if (b.kind == ConstraintBlock::Kind::friction)
    Eigen::Map<Vector3>(w, 3) = (Eigen::Map<Curvature const>(G, 3, 3) * Eigen::Map<Vector3>(w, 3)).eval();
  else
    for (int i = 0; i < b.rows; ++i) w[i] *= G[i];
}

/// The derivatives of t -> l(d + t w) at t = 0.
struct Slope {
  double first = 0, second = 0;
};
SINEW_HD inline Slope slope(ConstraintBlock const& b, Rows const& rows, double const* d, double const* w) {
  double f[ConstraintBlock::maxRows], change[ConstraintBlock::maxRows], G[3 * ConstraintBlock::maxRows];
  multipliers(b, rows, d, f);
  curvature(b, rows, d, G);
  for (int i = 0; i < b.rows; ++i) change[i] = w[i];
  multiply(b, G, change);
  Slope sum;
  for (int i = 0; i < b.rows; ++i) {
    sum.first -= f[i] * w[i];
    sum.second += change[i] * w[i];
  }
  return sum;
}

/// ConstraintProblem::residual of a block with the mean w of its estimated W; where nothing is lagged,
/// without the term of De Saxce. Above the friction steepCone, that term is mostly mu times the error of what
/// sticks; the map is then that of Alart and Curnier (1991), the projection on the normal and on the disk of
/// mu f_n.
SINEW_HD inline double natural_map(ConstraintBlock const& b, FrictionLag lag, double w, double const* d,
                                   double const* f) {
  switch (b.kind) {
    case ConstraintBlock::Kind::equality: {
      double squared = 0;
      for (int i = 0; i < b.rows; ++i) squared += d[i] * d[i];
      return std::sqrt(squared);
    }
    case ConstraintBlock::Kind::interval:
      return std::abs(d[0] - std::clamp(d[0] - f[0] * w, b.lower, b.upper));
    case ConstraintBlock::Kind::friction:
      break;
  }
  const Vector3 force(f[0], f[1], f[2]);
  Vector3 away(d[0], d[1], d[2]);
  if (lag != FrictionLag::none && b.friction > steepCone)
    return (force - bounded(b.friction * f[0], force - away / w)).norm() * w;
  if (lag != FrictionLag::none) away[0] += b.friction * away.tail<2>().norm();
  return (force - project_on_cone(force - away / w, b.friction)).norm() * w;
}

// What is changed between two convex problems.

/// The regularisation of the rows of a block: `relative` to the estimate of the diagonal of W.
SINEW_HD inline void regularise(ConstraintBlock const& b, double relative, double const* compliance,
                                double* r) {
  const bool friction = b.kind == ConstraintBlock::Kind::friction;
  for (int i = 0; i < b.rows; ++i)
    r[i] = relative * (friction ? (compliance[0] + compliance[1] + compliance[2]) / 3 : compliance[i]);
}

/// The multipliers f become those found before, inside the cone, and with them the lagged bound.
SINEW_HD inline void take_before(ConstraintBlock const& b, FrictionLag lag, double const* f, double* g,
                                 double& lagged) {
  if (b.kind != ConstraintBlock::Kind::friction) {
    for (int i = 0; i < b.rows; ++i) g[i] = f[i];
    return;
  }
  const Vector3 inside = project_on_cone({f[0], f[1], f[2]}, b.friction);
  for (int i = 0; i < 3; ++i) g[i] = inside[i];
  if (lag == FrictionLag::bound) lagged = b.friction * inside[0];
}

/// The next lagged gap of a contact with friction, from d and f: of one that slides or is open. In a contact
/// alone s changes mu |d_t| by k / (1 + k) of its own change, k = mu^2 W_tt / W_nn ~ mu^2, so that 1 + k
/// times the difference is Newton's step.
SINEW_HD inline double next_gap(ConstraintBlock const& b, double const* d, double const* f, double gap) {
  const double mu = b.friction < largestFriction ? b.friction : largestFriction, bound = mu * f[0],
               sliding = mu * std::sqrt(d[1] * d[1] + d[2] * d[2]);
  if (!(bound > 0)) return sliding;
  if (std::sqrt(f[1] * f[1] + f[2] * f[2]) < bound * (1 - 1e-9)) return 0;
  const double next = gap + (1 + mu * mu) * (sliding - gap);
  return next > 0 ? next : 0;
}

/// How far the potentials are from the conditions, in the unit of d: by the regularisation, r |f - g|, and
/// by what is lagged.
struct Rest {
  double regularisation = 0, lag = 0;
};
/// Of a block with the estimate w of its first row of W, and what is lagged of it.
SINEW_HD inline Rest rest(ConstraintBlock const& b, FrictionLag lag, Rows const& rows, double w,
                          double lagged, double const* d, double const* f) {
  Rest rest;
  for (int i = 0; i < b.rows; ++i) {
    const double one = rows.r[i] * std::abs(f[i] - rows.g[i]);
    if (one > rest.regularisation) rest.regularisation = one;
  }
  if (b.kind != ConstraintBlock::Kind::friction) return rest;
  if (lag == FrictionLag::bound)
    rest.lag = w * std::abs(b.friction * f[0] - lagged);
  else if (lag == FrictionLag::gap && f[0] > 0)
    rest.lag = std::abs(b.friction * std::sqrt(d[1] * d[1] + d[2] * d[2]) - lagged);
  return rest;
}

}  // namespace contact_potential
}  // namespace sinew

#if SINEW_DEFINES

namespace sinew {
namespace contact_potential {

SINEW_ONCE double value(ConstraintBlock const& b, Rows const& rows, double const* d) {
  double f[ConstraintBlock::maxRows];
  multipliers(b, rows, d, f);
  double sum = 0;
  for (int i = 0; i < b.rows; ++i) sum += rows.r[i] * f[i] * f[i] / 2;
  if (b.kind == ConstraintBlock::Kind::friction && rows.bound >= 0) {
    const Vector3 y = rows.y(d);
    if (const double t = tangential(y); t > rows.bound) sum += rows.r[1] * rows.bound * (t - rows.bound);
  }
  return sum;
}

}  // namespace contact_potential
}  // namespace sinew
#endif
