// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/core/component.hpp>
#include <sinew/core/element_driver.hpp>
#include <sinew/core/lists.hpp>
#include <sinew/force/elasticity.hpp>
#include <sinew/force/rotations.hpp>

#include <array>
#include <string_view>
#include <vector>

namespace sinew {

/// How the frame of a corotational triangle is found.
///   large  first axis along the edge 01, third normal to the triangle, as SOFA's "large"
///   small  that at rest: linear elasticity in the plane of the triangle at rest
///   polar  that of `large`, rotated in the plane to where the deformation is symmetric
enum class TriangleMethod { large, small, polar };
inline constexpr std::array<std::string_view, 3> enum_names(TriangleMethod) {
  return {"large", "small", "polar"};
}

/// Linear membrane triangle of an isotropic material, corotational, in space. With r_1, r_2 the axes of its
/// plane and g_k the gradients of the shape functions in them:
///   E = V (mu e:e + lambda/2 tr(e)^2),   e = sym(F) - I,   F = sum_k (r'x_k) g_k'                [J]
///   f_k = -V r s g_k,   s = 2 mu e + lambda tr(e) I                                              [N]
/// V is area times thickness; lambda is E nu/(1 - nu^2) in plane stress, E nu/((1 + nu)(1 - 2 nu)) in plane
/// strain. The tangent holds r fixed. It does not bend.
template <class D>
struct TriangleFEM {
  using Real = typename D::Real;
  using Coord = typename D::Coord;
  using Deriv = typename D::Deriv;
  using Vec3 = Vec<Real, 3>;
  static constexpr int arity = 3;
  static constexpr bool usesVelocity = false;

  struct Rest {
    Real gradient[2][2];          // g_1, g_2 [1/m]
    Real axes[2][3];              // r_1, r_2 at rest
    Real volumeMu, volumeLambda;  // V mu, V lambda [J]
  };
  struct Tangent {
    Real axes[2][3];
  };

  TriangleMethod method = TriangleMethod::large;

  SINEW_HD Real energy(Rest const& rest, Coord const (&x)[3]) const {
    Tangent frame;
    axes(rest, x, frame);
    Real e[2][2];
    strain(rest, frame, x, Real(1), e);
    const Real trace = e[0][0] + e[1][1];
    return rest.volumeMu * (e[0][0] * e[0][0] + e[1][1] * e[1][1] + Real(2) * e[0][1] * e[0][1]) +
           Real(0.5) * rest.volumeLambda * trace * trace;
  }

  SINEW_HD void force(Rest const& rest, Coord const (&x)[3], Deriv const (&)[3], Deriv (&f)[3],
                      Tangent& tangent) const {
    axes(rest, x, tangent);
    internalForce(rest, tangent, x, Real(1), Real(-1), f);
  }

  SINEW_HD void dforce(Rest const& rest, Tangent const& tangent, Deriv const (&dx)[3], Deriv (&df)[3], Real k,
                       Real /*b*/) const {
    internalForce(rest, tangent, dx, Real(0), -k, df);
  }

  /// -k V r (lambda g_i g_j' + mu g_j g_i' + mu g_i.g_j I) r'
  SINEW_INLINE Mat<Real, 3> block(Rest const& rest, Tangent const& tangent, int i, int j, Real k,
                                  Real /*b*/) const {
    Real gi[2], gj[2], m[2][2];
    for (int c = 0; c < 2; ++c) {
      gi[c] = i == 0 ? -(rest.gradient[0][c] + rest.gradient[1][c]) : rest.gradient[i - 1][c];
      gj[c] = j == 0 ? -(rest.gradient[0][c] + rest.gradient[1][c]) : rest.gradient[j - 1][c];
    }
    const Real lambda = -k * rest.volumeLambda, mu = -k * rest.volumeMu;
    for (int r = 0; r < 2; ++r)
      for (int c = 0; c < 2; ++c) {
        m[r][c] = lambda * gi[r] * gj[c] + mu * gj[r] * gi[c];
        if (r == c) m[r][c] += mu * (gi[0] * gj[0] + gi[1] * gj[1]);
      }
    auto const& a = tangent.axes;
    Mat<Real, 3> block;
    for (int r = 0; r < 3; ++r)
      for (int c = 0; c < 3; ++c)
        block(r, c) = a[0][r] * (m[0][0] * a[0][c] + m[0][1] * a[1][c]) +
                      a[1][r] * (m[1][0] * a[0][c] + m[1][1] * a[1][c]);
    return block;
  }

  /// V s in the axes of the world.
  Mat<Real, 3> volumeStress(Rest const& rest, Coord const (&x)[3]) const {
    Tangent frame;
    axes(rest, x, frame);
    Real e[2][2];
    strain(rest, frame, x, Real(1), e);
    const Real pressure = rest.volumeLambda * (e[0][0] + e[1][1]);
    Mat<Real, 3> s = Mat<Real, 3>::Zero();
    for (int i = 0; i < 2; ++i)
      for (int j = 0; j < 2; ++j) {
        const Real sij = Real(2) * rest.volumeMu * e[i][j] + (i == j ? pressure : Real(0));
        for (int r = 0; r < 3; ++r)
          for (int c = 0; c < 3; ++c) s(r, c) += sij * frame.axes[i][r] * frame.axes[j][c];
      }
    return s;
  }

  /// Rest data of the element with rest positions x and V mu = volume * mu.
  static Rest restOf(Coord const (&x)[3], Real thickness, Real mu, Real lambda) {
    const Vec3 a = x[1] - x[0], b = x[2] - x[0];
    const Mat<Real, 3> frame = frame_of(a, b);
    Rest rest;
    for (int i = 0; i < 2; ++i)
      for (int c = 0; c < 3; ++c) rest.axes[i][c] = frame(c, i);
    const Real ax = frame.col(0).dot(a), bx = frame.col(0).dot(b), by = frame.col(1).dot(b), twice = ax * by;
    rest.gradient[0][0] = by / twice, rest.gradient[0][1] = -bx / twice;
    rest.gradient[1][0] = Real(0), rest.gradient[1][1] = ax / twice;
    rest.volumeMu = thickness * twice / 2 * mu;
    rest.volumeLambda = thickness * twice / 2 * lambda;
    return rest;
  }

 private:
  // F in the axes, which sees differences of points only
  SINEW_INLINE static void gradientOf(Rest const& rest, Tangent const& frame, Coord const (&x)[3],
                                      Real (&f)[2][2]) {
    const Vec3 a = x[1] - x[0], b = x[2] - x[0];
    for (int i = 0; i < 2; ++i) {
      Real const(&r)[3] = frame.axes[i];
      const Real ra = r[0] * a[0] + r[1] * a[1] + r[2] * a[2], rb = r[0] * b[0] + r[1] * b[1] + r[2] * b[2];
      for (int j = 0; j < 2; ++j) f[i][j] = ra * rest.gradient[0][j] + rb * rest.gradient[1][j];
    }
  }
  SINEW_INLINE static void strain(Rest const& rest, Tangent const& frame, Coord const (&x)[3], Real one,
                                  Real (&e)[2][2]) {
    gradientOf(rest, frame, x, e);
    e[0][0] -= one;
    e[1][1] -= one;
    e[0][1] = e[1][0] = Real(0.5) * (e[0][1] + e[1][0]);
  }
  // at the strain of positions (one = 1) or of displacements (one = 0)
  SINEW_INLINE static void internalForce(Rest const& rest, Tangent const& frame, Coord const (&x)[3],
                                         Real one, Real factor, Deriv (&f)[3]) {
    Real s[2][2];
    strain(rest, frame, x, one, s);
    const Real mu2 = factor * Real(2) * rest.volumeMu,
               pressure = factor * rest.volumeLambda * (s[0][0] + s[1][1]);
    for (int i = 0; i < 2; ++i)
      for (int j = 0; j < 2; ++j) s[i][j] = i == j ? mu2 * s[i][j] + pressure : mu2 * s[i][j];
    for (int k = 0; k < 2; ++k) {
      Real const(&g)[2] = rest.gradient[k];
      const Real p = s[0][0] * g[0] + s[0][1] * g[1], q = s[1][0] * g[0] + s[1][1] * g[1];
      for (int c = 0; c < 3; ++c) f[k + 1][c] = frame.axes[0][c] * p + frame.axes[1][c] * q;
    }
    for (int c = 0; c < 3; ++c) f[0][c] = -(f[1][c] + f[2][c]);
  }

  SINEW_INLINE void axes(Rest const& rest, Coord const (&x)[3], Tangent& frame) const {
    using std::sqrt, sinew::sqrt;
    for (int i = 0; i < 2; ++i)
      for (int c = 0; c < 3; ++c) frame.axes[i][c] = rest.axes[i][c];
    if (method == TriangleMethod::small) return;
    const Mat<Real, 3> edges = frame_of(Vec3(x[1] - x[0]), Vec3(x[2] - x[0]));
    for (int i = 0; i < 2; ++i)
      for (int c = 0; c < 3; ++c) frame.axes[i][c] = edges(c, i);
    if (method == TriangleMethod::large) return;
    Real f[2][2];
    gradientOf(rest, frame, x, f);
    const Real c = f[0][0] + f[1][1], s = f[1][0] - f[0][1];
    const Real inverse = Real(1) / sqrt(c * c + s * s + Real(std::numeric_limits<lane_scalar<Real>>::min()));
    for (int k = 0; k < 3; ++k) {
      const Real u = frame.axes[0][k], v = frame.axes[1][k];
      frame.axes[0][k] = (c * u + s * v) * inverse;
      frame.axes[1][k] = (c * v - s * u) * inverse;
    }
  }
};

/// An elastic membrane of corotational triangles: those of the topology, or two in each of its quads where it
/// has none. `restScale` shrinks the triangles at rest, each in its plane: a membrane that is held at the
/// size of its state then has the tension E (1/s - 1)/(1 - nu) h per length in plane stress.
template <class D>
struct TriangleFEMForceField {
  using Role = role::ForceField;
  static constexpr bool sharesWork = true;
  using DataTypes = D;
  using Real = typename D::Real;
  static constexpr std::string_view className = "TriangleFEMForceField";
  static constexpr std::string_view aliases = "TriangularFEMForceField TriangularFEMForceFieldOptim";

  std::vector<double> youngModulus{5000}, poissonRatio{0.45};  // one for all triangles, or one for each
  double thickness = 1;
  bool planeStrain = false;
  TriangleMethod method = TriangleMethod::large;
  double restScale = 1;

  static constexpr auto fields() {
    using F = TriangleFEMForceField;
    return field_list(
        field("youngModulus",
              &F::youngModulus,
              "Pa",
              "stiffness of the material: one value, or one a triangle",
              range::positive)
            .oneEach(Of::surfaces),
        field("poissonRatio",
              &F::poissonRatio,
              "",
              "lateral contraction over extension, 0.5 is incompressible: one value, or one a triangle",
              Range{-1, 0.5, true, false})
            .oneEach(Of::surfaces),
        field("thickness", &F::thickness, "m", "thickness of the membrane", range::positive),
        field("planeStrain", &F::planeStrain, "", "thickness is held, in the place of stress free"),
        field("method", &F::method, "", "how the frame of an element is found"),
        field("restScale",
              &F::restScale,
              "",
              "lengths of a triangle without force over those at rest: below 1 the membrane is in tension",
              range::positive));
  }

  ForceProperties properties() const {
    const bool small = method == TriangleMethod::small;
    return {.objective = !small, .conservative = method != TriangleMethod::large, .exactTangent = small};
  }

  bool hadElements = false;  // a surface may have lost all its triangles

  using Driver = ElementDriver<TriangleFEM, D>;
  using Law = typename Driver::Law;
  Driver driver{};

  Law law() const { return Law{method}; }

  void init(InitContext<D> const& context) {
    const std::string where = text(context.where, ": ", component_name<TriangleFEMForceField>());
    TopologyView const& t = context.topology;
    std::vector<Triangle> triangles(t.triangles.begin(), t.triangles.end());
    if (triangles.empty())
      for (Quad const& q : t.quads) {
        triangles.push_back({q[0], q[1], q[2]});
        triangles.push_back({q[0], q[2], q[3]});
      }
    if (triangles.empty() && !hadElements && !t.grows)
      throw Error(where, "the topology has no triangle; give the node a topology with triangles or quads");
    hadElements = true;
    detail::check_indices(where, "triangle", triangles, context.rest.size());
    check_one_or_each(where, "youngModulus", youngModulus.size(), triangles.size(), "triangles");
    check_one_or_each(where, "poissonRatio", poissonRatio.size(), triangles.size(), "triangles");
    if (planeStrain)
      for (const double nu : poissonRatio)
        if (!(nu < 0.5))
          throw Error(where,
                      text("poissonRatio is ", nu, ", but must be less than 0.5 in plane strain; lower it"));
    std::vector<typename Driver::Rest> rest;
    for (std::size_t e = 0; e < triangles.size(); ++e) {
      typename D::Coord x[3];
      rest.push_back(restOf(context.rest, triangles[e], e, x));
      const Real longest = std::max({(x[1] - x[0]).norm(), (x[2] - x[0]).norm(), (x[2] - x[1]).norm()});
      if (!((x[1] - x[0]).cross(x[2] - x[0]).norm() > Real(1e-6) * longest * longest))
        throw Error(where, text("triangle ", e, " has no area; move or merge its points"));
    }
    driver.init(triangles, rest);
  }

  void addStress(InitContext<D> const& context, typename D::VecCoord const& x,
                 std::vector<Eigen::Matrix3d>& stress) const
  requires std::same_as<typename D::VecCoord, std::vector<typename D::Coord>>
  {
    auto const& triangles = context.topology.triangles;
    for (std::size_t e = 0; e < std::min(triangles.size(), stress.size()); ++e) {
      typename D::Coord atRest[3], now[3];
      const auto rest = restOf(context.rest, triangles[e], e, atRest);
      for (std::size_t k = 0; k < 3; ++k) now[k] = x[std::size_t(triangles[e][k])];
      // V = V mu / mu
      stress[e] += TriangleFEM<D>{method}.volumeStress(rest, now).template cast<double>() *
                   (moduliOf(e).mu / double(rest.volumeMu));
    }
  }

 private:
  LameModuli moduliOf(std::size_t e) const {
    const double E = one_or_each(youngModulus, e), nu = one_or_each(poissonRatio, e);
    return planeStrain ? lame_moduli(E, nu) : plane_stress_moduli(E, nu);
  }
  // with the corners of the triangle without force
  typename Driver::Rest restOf(typename D::VecCoord const& rest, Triangle const& triangle, std::size_t e,
                               typename D::Coord (&x)[3]) const {
    for (std::size_t k = 0; k < 3; ++k) x[k] = rest[std::size_t(triangle[k])] * Real(restScale);
    const LameModuli moduli = moduliOf(e);
    return TriangleFEM<D>::restOf(x, Real(thickness), Real(moduli.mu), Real(moduli.lambda));
  }
};

}  // namespace sinew
