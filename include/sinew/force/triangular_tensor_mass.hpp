// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/core/component.hpp>
#include <sinew/core/element_driver.hpp>
#include <sinew/force/elasticity.hpp>
#include <sinew/force/rotations.hpp>

#include <vector>

namespace sinew {

/// Linear membrane triangle in space, without rotation (tensor mass: Cotin, Delingette, Ayache 2000). With
/// r_1, r_2 the axes of its plane at rest, n its normal, g_k the gradients of the shape functions, and h_i =
/// sum_k (r_i'u_k) g_k of displacements u:
///   E = A (mu/2 e:e + lambda/2 tr(e)^2 + (lambda + mu)/2 |h_n|^2),   e = sym(h_1, h_2)               [J]
/// with SOFA's moduli, lambda = E nu/(1 - nu^2) and mu = E/(1 + nu). The last term, which out of the plane
/// acts as a tension would, is what SOFA's has, too. The stiffness is constant.
template <class D>
struct TensorMassTriangle {
  using Real = typename D::Real;
  using Coord = typename D::Coord;
  using Deriv = typename D::Deriv;
  static constexpr int arity = 3;
  static constexpr bool usesVelocity = false;

  struct Rest {
    Real axes[3][3];        // r_1, r_2, n
    Real gradient[2][2];    // of points 1 and 2 [1/m]
    Real sides[2][2];       // from point 0 to 1 and 2, in the axes [m]
    Real mu, lambda, bend;  // A mu, A lambda, A (lambda + mu) [J]
  };
  struct Tangent {};

  SINEW_HD Real energy(Rest const& rest, Coord const (&x)[3]) const {
    Real h[3][2];
    slopes(rest, x, Real(1), h);
    const Real trace = h[0][0] + h[1][1], shear = Real(0.5) * (h[0][1] + h[1][0]);
    return Real(0.5) * (rest.mu * (h[0][0] * h[0][0] + h[1][1] * h[1][1] + Real(2) * shear * shear) +
                        rest.lambda * trace * trace + rest.bend * (h[2][0] * h[2][0] + h[2][1] * h[2][1]));
  }
  SINEW_HD void force(Rest const& rest, Coord const (&x)[3], Deriv const (&)[3], Deriv (&f)[3],
                      Tangent&) const {
    load(rest, x, Real(1), Real(-1), f);
  }
  SINEW_HD void dforce(Rest const& rest, Tangent const&, Deriv const (&dx)[3], Deriv (&df)[3], Real k,
                       Real /*b*/) const {
    load(rest, dx, Real(0), -k, df);
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

  /// Rest data of the element with rest positions x; its `mu` is not above 0 where it has no area.
  static Rest restOf(Coord const (&x)[3], double youngModulus, double poissonRatio) {
    const Vec<Real, 3> a = x[1] - x[0], b = x[2] - x[0];
    const Mat<Real, 3> frame = frame_of(a, b);
    const double lambda = plane_stress_moduli(youngModulus, poissonRatio).lambda,
                 mu = 2 * shear_modulus(youngModulus, poissonRatio);
    Rest rest;
    for (int i = 0; i < 3; ++i)
      for (int c = 0; c < 3; ++c) rest.axes[i][c] = frame(c, i);
    for (int i = 0; i < 2; ++i) {
      rest.sides[0][i] = frame.col(i).dot(a);
      rest.sides[1][i] = frame.col(i).dot(b);
    }
    const Real twice = rest.sides[0][0] * rest.sides[1][1];
    rest.gradient[0][0] = rest.sides[1][1] / twice, rest.gradient[0][1] = -rest.sides[1][0] / twice;
    rest.gradient[1][0] = Real(0), rest.gradient[1][1] = rest.sides[0][0] / twice;
    rest.mu = twice / 2 * Real(mu);
    rest.lambda = twice / 2 * Real(lambda);
    rest.bend = rest.mu + rest.lambda;
    return rest;
  }

 private:
  // of displacements, which positions (one = 1) are beyond the sides at rest
  SINEW_INLINE static void slopes(Rest const& rest, Coord const (&x)[3], Real one, Real (&h)[3][2]) {
    const Deriv a = x[1] - x[0], b = x[2] - x[0];
    for (int i = 0; i < 3; ++i) {
      Real const(&r)[3] = rest.axes[i];
      Real u = r[0] * a[0] + r[1] * a[1] + r[2] * a[2], v = r[0] * b[0] + r[1] * b[1] + r[2] * b[2];
      if (i < 2) u -= one * rest.sides[0][i], v -= one * rest.sides[1][i];
      for (int j = 0; j < 2; ++j) h[i][j] = u * rest.gradient[0][j] + v * rest.gradient[1][j];
    }
  }
  SINEW_INLINE static void load(Rest const& rest, Coord const (&x)[3], Real one, Real factor, Deriv (&f)[3]) {
    Real h[3][2];
    slopes(rest, x, one, h);
    const Real pressure = rest.lambda * (h[0][0] + h[1][1]),
               shear = rest.mu * Real(0.5) * (h[0][1] + h[1][0]);
    const Real s[3][2] = {{rest.mu * h[0][0] + pressure, shear},
                          {shear, rest.mu * h[1][1] + pressure},
                          {rest.bend * h[2][0], rest.bend * h[2][1]}};
    for (int k = 0; k < 2; ++k)
      for (int c = 0; c < 3; ++c) {
        f[k + 1][c] = Real(0);
        for (int i = 0; i < 3; ++i)
          f[k + 1][c] +=
              factor * rest.axes[i][c] * (s[i][0] * rest.gradient[k][0] + s[i][1] * rest.gradient[k][1]);
      }
    f[0] = -(f[1] + f[2]);
  }
};

/// A membrane of triangles of linear elasticity, for small displacements: no triangle rotates.
template <class D>
struct TriangularTensorMassForceField {
  using Role = role::ForceField;
  static constexpr bool sharesWork = true;
  using DataTypes = D;
  using Real = typename D::Real;
  static constexpr std::string_view className = "TriangularTensorMassForceField",
                                    aliases = "TriangularTensorMass";

  double youngModulus = 1000, poissonRatio = 0.3;

  static constexpr auto fields() {
    using F = TriangularTensorMassForceField;
    return field_list(
        field("youngModulus", &F::youngModulus, "N/m", "stiffness times thickness", range::positive),
        field(
            "poissonRatio", &F::poissonRatio, "", "lateral contraction over extension", range::open(-1, 1)));
  }

  static constexpr ForceProperties properties() { return {.objective = false}; }

  bool hadElements = false;  // a surface may have lost all its triangles

  using Driver = ElementDriver<TensorMassTriangle, D>;
  Driver driver{};

  void init(InitContext<D> const& context) {
    const std::string where = text(context.where, ": ", component_name<TriangularTensorMassForceField>());
    auto const& triangles = context.topology.triangles;
    if (triangles.empty() && !hadElements && !context.topology.grows)
      throw Error(where, "the topology has no triangle; give the node a topology with triangles or quads");
    detail::check_indices(where, "triangle", triangles, context.rest.size());
    hadElements = true;
    std::vector<typename Driver::Rest> rest;
    for (std::size_t e = 0; e < triangles.size(); ++e) {
      typename D::Coord x[3];
      for (std::size_t k = 0; k < 3; ++k) x[k] = context.rest[std::size_t(triangles[e][k])];
      rest.push_back(TensorMassTriangle<D>::restOf(x, youngModulus, poissonRatio));
      if (!(rest.back().mu > 0))
        throw Error(where, text("triangle ", e, " has no area at rest; move or merge its points"));
    }
    driver.init({triangles.begin(), triangles.end()}, rest);
  }
};

}  // namespace sinew
