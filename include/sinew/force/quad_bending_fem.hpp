// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/core/component.hpp>
#include <sinew/core/element_driver.hpp>
#include <sinew/core/lists.hpp>
#include <sinew/force/elasticity.hpp>
#include <sinew/force/rotations.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <string_view>
#include <vector>

namespace sinew {

/// How the frame of a plate's quad is found: it is that at rest, with all that SOFA has.
enum class QuadMethod { small };
inline constexpr std::array<std::string_view, 1> enum_names(QuadMethod) { return {"small"}; }

/// Bilinear quad of a plate of Reissner and Mindlin in plane stress whose sections do not rotate, for small
/// displacements. With r_1, r_2 the axes of its plane at rest, n its normal, q the four points of Gauss with
/// their areas A_q, o the centre, and g_k the gradients of the shape functions at one of them:
///   E = h sum_q A_q (mu e:e + lambda/2 tr(e)^2) + S/2 |c|^2                                           [J]
///   e = sym(sum_k (r'x_k) g_k') - I at q,   c = sum_k (n.x_k) g_k at o,   S = 5/6 mu h A
/// Membrane strains are integrated with 2x2 points, shear across the plate with one, as in SOFA.
template <class D>
struct QuadPlate {
  using Real = typename D::Real;
  using Coord = typename D::Coord;
  using Deriv = typename D::Deriv;
  static constexpr int arity = 4;
  static constexpr bool usesVelocity = false;

  struct Rest {
    Real axes[3][3];         // r_1, r_2, n
    Real gradient[4][4][2];  // at q, of k [1/m]
    Real center[4][2];       // at o
    Real volume[4];          // h A_q [m^3]
    Real mu, lambda, shear;  // [Pa], and S [N]
  };
  struct Tangent {};

  SINEW_HD Real energy(Rest const& rest, Coord const (&x)[4]) const {
    Real local[4][3];
    inAxes(rest, x, local);
    Real sum(0);
    for (int q = 0; q < 4; ++q) {
      Real e[2][2];
      strain(rest, q, local, Real(1), e);
      const Real trace = e[0][0] + e[1][1];
      sum +=
          rest.volume[q] * (rest.mu * (e[0][0] * e[0][0] + e[1][1] * e[1][1] + Real(2) * e[0][1] * e[0][1]) +
                            Real(0.5) * rest.lambda * trace * trace);
    }
    Real c[2];
    across(rest, local, c);
    return sum + Real(0.5) * rest.shear * (c[0] * c[0] + c[1] * c[1]);
  }

  SINEW_HD void force(Rest const& rest, Coord const (&x)[4], Deriv const (&)[4], Deriv (&f)[4],
                      Tangent&) const {
    internalForce(rest, x, Real(1), Real(-1), f);
  }
  SINEW_HD void dforce(Rest const& rest, Tangent const&, Deriv const (&dx)[4], Deriv (&df)[4], Real k,
                       Real /*b*/) const {
    internalForce(rest, dx, Real(0), -k, df);
  }

  /// -k (sum_q h A_q r (lambda g_i g_j' + mu g_j g_i' + mu g_i.g_j I) r' + S g_i.g_j n n')
  SINEW_INLINE Mat<Real, 3> block(Rest const& rest, Tangent const&, int i, int j, Real k, Real /*b*/) const {
    Real m[3][3];
    for (auto& row : m)
      for (Real& entry : row) entry = Real(0);
    for (int q = 0; q < 4; ++q) {
      Real const(&gi)[2] = rest.gradient[q][i];
      Real const(&gj)[2] = rest.gradient[q][j];
      const Real lambda = rest.volume[q] * rest.lambda, mu = rest.volume[q] * rest.mu;
      for (int r = 0; r < 2; ++r)
        for (int c = 0; c < 2; ++c) {
          m[r][c] += lambda * gi[r] * gj[c] + mu * gj[r] * gi[c];
          if (r == c) m[r][c] += mu * (gi[0] * gj[0] + gi[1] * gj[1]);
        }
    }
    m[2][2] = rest.shear * (rest.center[i][0] * rest.center[j][0] + rest.center[i][1] * rest.center[j][1]);
    Mat<Real, 3> block;
    for (int r = 0; r < 3; ++r)
      for (int c = 0; c < 3; ++c) {
        Real sum(0);
        for (int a = 0; a < 3; ++a)
          for (int b = 0; b < 3; ++b) sum += rest.axes[a][r] * m[a][b] * rest.axes[b][c];
        block(r, c) = -k * sum;
      }
    return block;
  }

  /// Rest data of the quad with rest positions x. Says by a volume that is not positive that the quad is not
  /// convex, or has no area.
  static Rest restOf(Coord const (&x)[4], Real thickness, Real mu, Real lambda) {
    using Vec3 = Vec<Real, 3>;
    // normal to both diagonals: points of a warped quad are as far above its plane as below
    const Vec3 along = x[2] - x[0], other = x[3] - x[1];
    const Mat<Real, 3> frame = frame_of(along, other);
    Rest rest;
    for (int i = 0; i < 3; ++i)
      for (int c = 0; c < 3; ++c) rest.axes[i][c] = frame(c, i);
    Real at[4][2];
    for (int k = 0; k < 4; ++k)
      for (int c = 0; c < 2; ++c) at[k][c] = frame.col(c).dot(Vec3(x[k] - x[0]));
    const Real place = 1 / std::sqrt(Real(3));
    for (int q = 0; q < 4; ++q) {
      const Real area = gradientsAt(at, (q % 2 ? 1 : -1) * place, (q / 2 ? 1 : -1) * place, rest.gradient[q]);
      rest.volume[q] = thickness * area;
    }
    const Real area = 4 * gradientsAt(at, 0, 0, rest.center);
    rest.mu = mu, rest.lambda = lambda;
    rest.shear = Real(5) / 6 * mu * thickness * area;
    return rest;
  }

 private:
  // of the shape functions at a place of the unit square; the area there
  static Real gradientsAt(Real const (&at)[4][2], Real u, Real v, Real (&g)[4][2]) {
    const Real du[4] = {-(1 - v) / 4, (1 - v) / 4, (1 + v) / 4, -(1 + v) / 4},
               dv[4] = {-(1 - u) / 4, -(1 + u) / 4, (1 + u) / 4, (1 - u) / 4};
    Real j[2][2] = {{0, 0}, {0, 0}};
    for (int k = 0; k < 4; ++k)
      for (int c = 0; c < 2; ++c) j[0][c] += du[k] * at[k][c], j[1][c] += dv[k] * at[k][c];
    const Real area = j[0][0] * j[1][1] - j[0][1] * j[1][0];
    for (int k = 0; k < 4; ++k) {
      g[k][0] = (j[1][1] * du[k] - j[0][1] * dv[k]) / area;
      g[k][1] = (j[0][0] * dv[k] - j[1][0] * du[k]) / area;
    }
    return area;
  }

  // from the first point, in the axes
  SINEW_INLINE static void inAxes(Rest const& rest, Coord const (&x)[4], Real (&local)[4][3]) {
    for (int k = 0; k < 4; ++k)
      for (int a = 0; a < 3; ++a) {
        local[k][a] = Real(0);
        for (int c = 0; c < 3; ++c) local[k][a] += rest.axes[a][c] * (x[k][c] - x[0][c]);
      }
  }
  SINEW_INLINE static void strain(Rest const& rest, int q, Real const (&local)[4][3], Real one,
                                  Real (&e)[2][2]) {
    for (int i = 0; i < 2; ++i)
      for (int j = 0; j < 2; ++j) {
        e[i][j] = Real(0);
        for (int k = 1; k < 4; ++k) e[i][j] += local[k][i] * rest.gradient[q][k][j];
      }
    e[0][0] -= one;
    e[1][1] -= one;
    e[0][1] = e[1][0] = Real(0.5) * (e[0][1] + e[1][0]);
  }
  SINEW_INLINE static void across(Rest const& rest, Real const (&local)[4][3], Real (&c)[2]) {
    for (int j = 0; j < 2; ++j) {
      c[j] = Real(0);
      for (int k = 1; k < 4; ++k) c[j] += local[k][2] * rest.center[k][j];
    }
  }
  // at the strain of positions (one = 1) or of displacements (one = 0)
  SINEW_INLINE static void internalForce(Rest const& rest, Coord const (&x)[4], Real one, Real factor,
                                         Deriv (&f)[4]) {
    Real local[4][3], on[4][3], c[2];
    inAxes(rest, x, local);
    across(rest, local, c);
    for (int k = 1; k < 4; ++k) {
      on[k][0] = on[k][1] = Real(0);
      on[k][2] = factor * rest.shear * (c[0] * rest.center[k][0] + c[1] * rest.center[k][1]);
    }
    for (int q = 0; q < 4; ++q) {
      Real s[2][2];
      strain(rest, q, local, one, s);
      const Real volume = factor * rest.volume[q], mu2 = Real(2) * volume * rest.mu,
                 pressure = volume * rest.lambda * (s[0][0] + s[1][1]);
      for (int i = 0; i < 2; ++i)
        for (int j = 0; j < 2; ++j) s[i][j] = i == j ? mu2 * s[i][j] + pressure : mu2 * s[i][j];
      for (int k = 1; k < 4; ++k)
        for (int i = 0; i < 2; ++i)
          on[k][i] += s[i][0] * rest.gradient[q][k][0] + s[i][1] * rest.gradient[q][k][1];
    }
    for (int r = 0; r < 3; ++r) {
      for (int k = 1; k < 4; ++k)
        f[k][r] = rest.axes[0][r] * on[k][0] + rest.axes[1][r] * on[k][1] + rest.axes[2][r] * on[k][2];
      f[0][r] = -(f[1][r] + f[2][r] + f[3][r]);
    }
  }
};

/// An elastic plate of the quads of the topology, for small displacements: a membrane in the plane of each
/// quad at rest, which shear across it keeps there. Its sections do not rotate, as in SOFA, so that a load
/// across the plate bends it as one bends a membrane with the tension 5/6 mu h per length.
template <class D>
struct QuadBendingFEMForceField {
  using Role = role::ForceField;
  static constexpr bool sharesWork = true;
  using DataTypes = D;
  using Real = typename D::Real;
  static constexpr std::string_view className = "QuadBendingFEMForceField";

  std::vector<double> youngModulus{1000}, poissonRatio{0.45};  // one for all quads, or one for each
  double thickness = 1;
  QuadMethod method = QuadMethod::small;

  static constexpr auto fields() {
    using F = QuadBendingFEMForceField;
    return field_list(field("youngModulus",
                            &F::youngModulus,
                            "Pa",
                            "stiffness of the material: one value, or one a quad",
                            range::positive)
                          .oneEach(Of::quads),
                      field("poissonRatio",
                            &F::poissonRatio,
                            "",
                            "lateral contraction over extension: one value, or one a quad",
                            Range{-1, 0.5, true, false})
                          .oneEach(Of::quads),
                      field("thickness", &F::thickness, "m", "thickness of the plate", range::positive),
                      field("method", &F::method, "", "how the frame of an element is found: that at rest"));
  }

  static constexpr ForceProperties properties() { return {.objective = false}; }

  using Driver = ElementDriver<QuadPlate, D>;
  Driver driver{};

  void init(InitContext<D> const& context) {
    const std::string where = text(context.where, ": ", component_name<QuadBendingFEMForceField>());
    std::vector<Quad> quads(context.topology.quads.begin(), context.topology.quads.end());
    if (quads.empty()) throw Error(where, "the topology has no quad; give the node a topology with quads");
    detail::check_indices(where, "quad", quads, context.rest.size());
    check_one_or_each(where, "youngModulus", youngModulus.size(), quads.size(), "quads");
    check_one_or_each(where, "poissonRatio", poissonRatio.size(), quads.size(), "quads");
    std::vector<typename Driver::Rest> rest;
    for (std::size_t e = 0; e < quads.size(); ++e) {
      typename D::Coord x[4];
      for (std::size_t k = 0; k < 4; ++k) x[k] = context.rest[std::size_t(quads[e][k])];
      const LameModuli moduli =
          plane_stress_moduli(one_or_each(youngModulus, e), one_or_each(poissonRatio, e));
      rest.push_back(QuadPlate<D>::restOf(x, Real(thickness), Real(moduli.mu), Real(moduli.lambda)));
      const Real longest = std::max((x[2] - x[0]).squaredNorm(), (x[3] - x[1]).squaredNorm());
      for (const Real volume : rest.back().volume)
        if (!(volume > Real(1e-6 * thickness) * longest))
          throw Error(
              where,
              text("quad ", e, " has no area, or is not convex; move its points, or change their order"));
    }
    driver.init(quads, rest);
  }
};

}  // namespace sinew
