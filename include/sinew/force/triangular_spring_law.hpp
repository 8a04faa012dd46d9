// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/core/component.hpp>
#include <sinew/core/lanes.hpp>
#include <sinew/force/elasticity.hpp>

#include <limits>

namespace sinew {

/// A triangle as springs on its sides, and between them: a membrane for large displacements (Delingette 2008,
/// "Triangular Springs for Modeling Nonlinear Membranes"). With s_j how the length of the side opposite of
/// point j has grown, or (`Squared`) its square,
///   E = c (sum_j k_j/2 s_j^2 + sum_j g_j s_k s_l) + K/4 A0 min(0, A/A0 - 1)^4,   c = 1, or 1/2      [J]
///   f = -dE/dx
/// k_j and g_j make it the energy of a linear membrane for small strains, or that of St Venant-Kirchhoff for
/// squares, in the moduli of SOFA (lambda = E nu/(1 - nu^2), mu = E/(1 + nu)). The last term keeps a triangle
/// from being turned over. Damping adds c d(length)/dt to s_j (of squares the same over the length) and is
/// that of the start of a step.
template <class D, bool Squared>
struct TriangularSpringLaw {
  using Real = typename D::Real;
  using Coord = typename D::Coord;
  using Deriv = typename D::Deriv;
  static constexpr int arity = 3;
  static constexpr bool usesVelocity = true;

  struct Rest {
    Real stiffness[3], coupling[3];  // k, g
    Real measure[3];                 // length at rest, or its square
    Real area, areaStiffness;        // A0 [m^2], K [N/m]
    Real damping;
  };
  struct Tangent {
    Deriv side[3], gradient[3];  // d, ds/dd
    Real tension[3];             // dE/ds times what the second derivative of s has in all directions
    Deriv normal;
    Real size, push, slope;  // |N|, dE/dA, d2E/dA2
  };

  SINEW_HD Real energy(Rest const& rest, Coord const (&x)[3]) const {
    Tangent t;
    const Deriv still[3] = {Deriv::Zero(), Deriv::Zero(), Deriv::Zero()};
    Real s[3];
    strains(rest, x, still, t, s);
    Real sum(0);
    for (int j = 0; j < 3; ++j)
      sum += Real(0.5) * rest.stiffness[j] * s[j] * s[j] + rest.coupling[j] * s[next(j)] * s[last(j)];
    const Real less = shrunk(rest, t);
    return Real(partOf) * sum + Real(0.25) * rest.areaStiffness * rest.area * less * less * less * less;
  }

  SINEW_HD void force(Rest const& rest, Coord const (&x)[3], Deriv const (&v)[3], Deriv (&f)[3],
                      Tangent& t) const {
    Real s[3];
    strains(rest, x, v, t, s);
    const Real less = shrunk(rest, t);
    t.push = rest.areaStiffness * less * less * less;
    t.slope = Real(3) * rest.areaStiffness * less * less / rest.area;
    for (int j = 0; j < 3; ++j) f[j] = areaGradient(t, j) * -t.push;
    for (int j = 0; j < 3; ++j) {
      const Real pull = slopeOf(rest, s, j);
      t.tension[j] = pull * stretch(t, j);
      f[next(j)] += t.gradient[j] * pull;
      f[last(j)] -= t.gradient[j] * pull;
    }
  }

  SINEW_HD void dforce(Rest const& rest, Tangent const& t, Deriv const (&dx)[3], Deriv (&df)[3], Real k,
                       Real /*b*/) const {
    Deriv d[3], turned = Deriv::Zero();
    Real s[3], grown(0);
    for (int j = 0; j < 3; ++j) {
      d[j] = dx[last(j)] - dx[next(j)];
      s[j] = t.gradient[j].dot(d[j]);
      turned += cross(t.side[j], dx[j]);
      grown += areaGradient(t, j).dot(dx[j]);
    }
    const Deriv normal = (turned - t.normal * t.normal.dot(turned)) / t.size;  // how it turns
    for (int j = 0; j < 3; ++j)
      df[j] = areaGradient(t, j) * (-k * t.slope * grown) -
              (cross(normal, t.side[j]) + cross(t.normal, d[j])) * (Real(0.5) * k * t.push);
    for (int j = 0; j < 3; ++j) {
      const Deriv pull =
          t.gradient[j] * (k * (slopeOf(rest, s, j) - along(t, j) * s[j])) + d[j] * (k * t.tension[j]);
      df[next(j)] += pull;
      df[last(j)] -= pull;
    }
  }

  SINEW_HD Mat<Real, 3> block(Rest const& rest, Tangent const& t, int i, int j, Real k, Real b) const {
    Mat<Real, 3> block;
    for (int c = 0; c < 3; ++c) {
      Deriv dx[3], df[3];
      for (auto& one : dx) one = Deriv::Zero();
      dx[j][c] = Real(1);
      dforce(rest, t, dx, df, k, b);
      for (int r = 0; r < 3; ++r) block(r, c) = df[i][r];
    }
    return block;
  }

  /// Rest data of the element with rest positions x; its area is not above 0 where it has none.
  static Rest restOf(Coord const (&x)[3], double youngModulus, double poissonRatio, double damping,
                     bool coupled, bool compressible) {
    const double lambda = plane_stress_moduli(youngModulus, poissonRatio).lambda,
                 mu = 2 * shear_modulus(youngModulus, poissonRatio);
    double square[3], cotangent[3];
    for (int j = 0; j < 3; ++j) square[j] = double((x[last(j)] - x[next(j)]).squaredNorm());
    const double area = double(cross(x[1] - x[0], x[2] - x[0]).norm()) / 2;
    for (int j = 0; j < 3; ++j) cotangent[j] = (square[next(j)] + square[last(j)] - square[j]) / (4 * area);
    Rest rest;
    for (int j = 0; j < 3; ++j) {
      const int k = next(j), l = last(j);
      const double own = (2 * cotangent[j] * cotangent[j] * (lambda + mu) + mu) / (8 * area),
                   both = (2 * cotangent[k] * cotangent[l] * (lambda + mu) - mu) / (8 * area);
      rest.stiffness[j] = Real(Squared ? own / 2 : own * square[j]);
      rest.coupling[j] = Real(!coupled ? 0 : Squared ? both / 2 : both * std::sqrt(square[k] * square[l]));
      rest.measure[j] = Real(Squared ? square[j] : std::sqrt(square[j]));
    }
    rest.area = Real(area);
    rest.areaStiffness = Real(compressible && coupled ? 3 * (lambda + mu) : 0);
    rest.damping = Real(damping);
    return rest;
  }

 private:
  static constexpr double partOf = Squared ? 0.5 : 1;
  static constexpr int next(int j) { return (j + 1) % 3; }
  static constexpr int last(int j) { return (j + 2) % 3; }

  SINEW_INLINE static Deriv cross(Deriv const& a, Deriv const& b) {
    Deriv c;
    for (int i = 0; i < 3; ++i) c[i] = a[next(i)] * b[last(i)] - a[last(i)] * b[next(i)];
    return c;
  }
  // s, and what the tangent knows of the shape
  SINEW_INLINE static void strains(Rest const& rest, Coord const (&x)[3], Deriv const (&v)[3], Tangent& t,
                                   Real (&s)[3]) {
    using std::sqrt, sinew::sqrt;
    const Real least(std::numeric_limits<lane_scalar<Real>>::min());
    for (int j = 0; j < 3; ++j) {
      Deriv const& d = t.side[j] = x[last(j)] - x[next(j)];
      const Real square = d.squaredNorm() + least, rate = (v[last(j)] - v[next(j)]).dot(d);
      if constexpr (Squared) {
        t.gradient[j] = d * Real(2);
        s[j] = square - rest.measure[j] + rest.damping * rate / square;
      } else {
        const Real inverse = Real(1) / sqrt(square);
        t.gradient[j] = d * inverse;
        s[j] = square * inverse - rest.measure[j] + rest.damping * rate * inverse;
      }
    }
    const Deriv n = cross(t.side[2], t.side[0]);
    t.size = sqrt(n.squaredNorm()) + least;
    t.normal = n / t.size;
  }
  SINEW_INLINE static Real shrunk(Rest const& rest, Tangent const& t) {
    const Real less = Real(0.5) * t.size / rest.area - Real(1);
    return select(less < Real(0), less, Real(0));
  }
  // dE/ds_j
  SINEW_INLINE static Real slopeOf(Rest const& rest, Real const (&s)[3], int j) {
    return Real(partOf) * (rest.stiffness[j] * s[j] + rest.coupling[next(j)] * s[last(j)] +
                           rest.coupling[last(j)] * s[next(j)]);
  }
  // the second derivative of s_j is stretch (I - u u') of lengths, stretch I of squares
  SINEW_INLINE static Real stretch(Tangent const& t, int j) {
    if constexpr (Squared)
      return Real(2);
    else
      return t.gradient[j].dot(t.gradient[j]) / t.gradient[j].dot(t.side[j]);
  }
  SINEW_INLINE static Real along(Tangent const& t, int j) { return Squared ? Real(0) : t.tension[j]; }
  SINEW_INLINE static Deriv areaGradient(Tangent const& t, int j) {
    return cross(t.normal, t.side[j]) * Real(0.5);
  }
};

/// The triangles of a topology as such elements, for a component with these fields. Throws Error where there
/// are none, or one has no area.
template <class C>
void init_triangular_springs(C& c, InitContext<typename C::DataTypes> const& context, bool compressible) {
  using D = typename C::DataTypes;
  const std::string where = text(context.where, ": ", component_name<C>());
  auto const& triangles = context.topology.triangles;
  if (triangles.empty() && !c.hadElements && !context.topology.grows)
    throw Error(where, "the topology has no triangle; give the node a topology with triangles or quads");
  detail::check_indices(where, "triangle", triangles, context.rest.size());
  c.hadElements = true;
  std::vector<typename C::Driver::Rest> rest;
  for (std::size_t e = 0; e < triangles.size(); ++e) {
    typename D::Coord x[3];
    for (std::size_t k = 0; k < 3; ++k) x[k] = context.rest[std::size_t(triangles[e][k])];
    rest.push_back(C::RestLaw::restOf(
        x, c.youngModulus, c.poissonRatio, c.dampingRatio, c.useAngularSprings, compressible));
    if (!(rest.back().area > 0))
      throw Error(where, text("triangle ", e, " has no area at rest; move or merge its points"));
  }
  c.driver.init({triangles.begin(), triangles.end()}, rest);
}

}  // namespace sinew
