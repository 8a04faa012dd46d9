// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/core/component.hpp>
#include <sinew/core/element_driver.hpp>
#include <sinew/force/hyperelastic_material.hpp>
#include <sinew/force/material_axes.hpp>
#include <sinew/force/singular_values.hpp>
#include <sinew/force/tetrahedron_rest.hpp>

#include <algorithm>
#include <string_view>
#include <vector>

namespace sinew {

/// Linear tetrahedron of a hyperelastic material, total Lagrangian. With F = sum_k x_k g_k', g_k the gradient
/// of shape function k at rest:
///   E = V W(F) [J],   f_k = -V P g_k [N],   P = dW/dF,   df_i/dx_j = -V (d2W/dF2 : . g_j) g_i
/// Three ways lead to P and to the second derivative. By invariants, where P = 2 W1 F + 2 W2 (I1 F - F F'F) +
/// WJ cof F; and by the singular values F = U diag(s) V', in whose axes the second derivative falls into one
/// block of 3 x 3 for stretches and six numbers for rotations (Smith, de Goes, Kim 2019). The latter is taken
/// for materials that are given by stretches, and to make the tangent positive semi-definite: what is
/// negative of the eigenvalues becomes 0 (Teran et al. 2005). Materials with directions go by measures K of
/// F'F, P = 2 WK F T + WJ cof F with T = dK/d(F'F), in the axes of the element: in these its gradients g_k
/// are written, and F with them.
template <class D>
struct TetrahedronHyperelasticity {
  using Real = typename D::Real;
  using Coord = typename D::Coord;
  using Deriv = typename D::Deriv;
  using Vec3 = Vec<Real, 3>;
  using Mat3 = Mat<Real, 3>;
  static constexpr int arity = 4;
  static constexpr bool usesVelocity = false;

  using Rest = TetrahedronRest<Real>;
  struct Tangent {
    Mat3 k[6];  // df_i/dx_j of the points 1 1, 1 2, 1 3, 2 2, 2 3, 3 3 [N/m]
  };

  Hyperelastic<Real> material{};
  bool definite = false;

  SINEW_HD Real energy(Rest const& rest, Coord const (&x)[4]) const {
    const Mat3 f = deformation_gradient(rest, x);
    if (material.byStretches()) return rest.volume * material.at(singular_values(f).sigma).w;
    const Mat3 cof = cofactor(f);
    if (material.byDirections()) {
      const Mat3 c = squared(f);
      const Real j = dot3(Vec3(f.col(0)), Vec3(cof.col(0)));
      Real sum(0);
      for (int m = 0; m < material.directed(); ++m)
        sum += material.byDirection(m, material.strain(m, c).k, j).w;
      return rest.volume * sum;
    }
    return rest.volume *
           material.byInvariants(square(f), square(cof), dot3(Vec3(f.col(0)), Vec3(cof.col(0)))).w;
  }

  SINEW_HD void force(Rest const& rest, Coord const (&x)[4], Deriv const (&)[4], Deriv (&f)[4],
                      Tangent& tangent) const {
    if (material.byDirections())
      forceByDirections(rest, x, f, tangent);
    else if (definite || material.byStretches())
      forceByStretches(rest, x, f, tangent);
    else
      forceByInvariants(rest, x, f, tangent);
    for (int i = 0; i < 3; ++i) f[0][i] = -(f[1][i] + f[2][i] + f[3][i]);
  }

  SINEW_HD void dforce(Rest const&, Tangent const& tangent, Deriv const (&dx)[4], Deriv (&df)[4], Real k,
                       Real /*b*/) const {
    Vec3 d[3];
    for (int j = 0; j < 3; ++j) d[j] = (dx[j + 1] - dx[0]) * k;
    for (int i = 0; i < 3; ++i)
      for (int r = 0; r < 3; ++r) {
        Real sum(0);
        for (int j = 0; j < 3; ++j)
          for (int c = 0; c < 3; ++c) sum += entry(tangent, i, j, r, c) * d[j][c];
        df[i + 1][r] = sum;
      }
    for (int i = 0; i < 3; ++i) df[0][i] = -(df[1][i] + df[2][i] + df[3][i]);
  }

  SINEW_INLINE Mat3 block(Rest const&, Tangent const& tangent, int i, int j, Real k, Real /*b*/) const {
    // moving all points does nothing: what belongs to point 0 is minus the sum of the others
    Mat3 block;
    block.setZero();
    for (int p = i == 0 ? 1 : i; p <= (i == 0 ? 3 : i); ++p)
      for (int q = j == 0 ? 1 : j; q <= (j == 0 ? 3 : j); ++q) {
        const bool swapped = p > q;
        Real const* const one =
            tangent.k[swapped ? pairNumber(q - 1, p - 1) : pairNumber(p - 1, q - 1)].data();
        const int down = swapped ? 3 : 1, across = swapped ? 1 : 3;
        for (int c = 0; c < 3; ++c)
          for (int r = 0; r < 3; ++r) block(r, c) += one[down * r + across * c];
      }
    const Real factor = (i == 0) == (j == 0) ? k : -k;
    for (int c = 0; c < 9; ++c) block(c) *= factor;
    return block;
  }

 private:
  static constexpr int pairNumber(int i, int j) { return i * (5 - i) / 2 + j; }
  SINEW_INLINE static Real entry(Tangent const& t, int i, int j, int r, int c) {
    return i <= j ? t.k[pairNumber(i, j)](r, c) : t.k[pairNumber(j, i)](c, r);
  }
  SINEW_INLINE static Real square(Mat3 const& a) {
    Real sum(0);
    for (int i = 0; i < 9; ++i) sum += a(i) * a(i);
    return sum;
  }
  // F'F
  SINEW_INLINE static Mat3 squared(Mat3 const& f) {
    Mat3 c;
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j <= i; ++j) c(i, j) = c(j, i) = dot3(Vec3(f.col(i)), Vec3(f.col(j)));
    return c;
  }
  SINEW_INLINE static Mat3 cofactor(Mat3 const& f) {
    Mat3 cof;
    for (int c = 0; c < 3; ++c) cof.col(c) = cross3(Vec3(f.col((c + 1) % 3)), Vec3(f.col((c + 2) % 3)));
    return cof;
  }

  SINEW_HD void forceByInvariants(Rest const& rest, Coord const (&x)[4], Deriv (&force)[4],
                                  Tangent& tangent) const {
    const Mat3 f = deformation_gradient(rest, x), cof = cofactor(f);
    const Real i1 = square(f), j = dot3(Vec3(f.col(0)), Vec3(cof.col(0)));
    const auto w = material.byInvariants(i1, square(cof), j);
    Mat3 left;  // F F'
    for (int r = 0; r < 3; ++r)
      for (int c = 0; c <= r; ++c)
        left(r, c) = left(c, r) = f(r, 0) * f(c, 0) + f(r, 1) * f(c, 1) + f(r, 2) * f(c, 2);
    // F g_k, and the derivatives of I1, I2, J by x_k
    Vec3 fg[3], d1[3], d2[3], dJ[3];
    for (int k = 0; k < 3; ++k) {
      const Vec3 g = rest.gradient.col(k);
      fg[k] = times(f, g);
      dJ[k] = times(cof, g);
      d1[k] = fg[k] * Real(2);
      d2[k] = fg[k] * (Real(2) * i1) - times(left, fg[k]) * Real(2);
      for (int i = 0; i < 3; ++i)
        force[k + 1][i] = -rest.volume * (w.w1 * d1[k][i] + w.w2 * d2[k][i] + w.wJ * dJ[k][i]);
    }
    for (int p = 0; p < 3; ++p)
      for (int q = p; q < 3; ++q) {
        const Real gg = dot3(Vec3(rest.gradient.col(p)), Vec3(rest.gradient.col(q)));
        const Real diagonal = Real(2) * (w.w1 * gg + w.w2 * (i1 * gg - dot3(fg[p], fg[q])));
        const Vec3 a1 = d1[p] * w.w11 + dJ[p] * w.w1J, aJ = d1[p] * w.w1J + d2[p] * w.w2J + dJ[p] * w.wJJ,
                   a2 = dJ[p] * w.w2J;
        Mat3& k = tangent.k[pairNumber(p, q)];
        for (int c = 0; c < 3; ++c)
          for (int r = 0; r < 3; ++r) {
            Real sum = a1[r] * d1[q][c] + a2[r] * d2[q][c] + aJ[r] * dJ[q][c];
            sum += Real(2) * w.w2 * (Real(2) * fg[p][r] * fg[q][c] - fg[q][r] * fg[p][c] - gg * left(r, c));
            if (r == c) sum += diagonal;
            k(r, c) = -rest.volume * sum;
          }
        if (p != q) addCurvatureOfVolume(tangent, x, p, q, w.wJ);
      }
  }

  // -V wJ d2J/dx_p dx_q, p < q: 1/(6 V) times the cross product with the edge from point 0 to the third point
  SINEW_INLINE static void addCurvatureOfVolume(Tangent& tangent, Coord const (&x)[4], int p, int q,
                                                Real wJ) {
    Mat3& k = tangent.k[pairNumber(p, q)];
    const int third = 3 - p - q;
    const Vec3 edge = (x[third + 1] - x[0]) * (wJ * Real(q - p == 1 ? 1 : -1) / Real(6));
    for (int i = 0; i < 3; ++i) {
      k((i + 2) % 3, (i + 1) % 3) += edge[i];
      k((i + 1) % 3, (i + 2) % 3) -= edge[i];
    }
  }

  SINEW_HD void forceByDirections(Rest const& rest, Coord const (&x)[4], Deriv (&force)[4],
                                  Tangent& tangent) const {
    const Mat3 f = deformation_gradient(rest, x), cof = cofactor(f), c = squared(f);
    const Real j = dot3(Vec3(f.col(0)), Vec3(cof.col(0)));
    Vec3 g[3], dJ[3];
    for (int k = 0; k < 3; ++k) {
      g[k] = rest.gradient.col(k);
      dJ[k] = times(cof, g[k]);
      for (int i = 0; i < 3; ++i) force[k + 1][i] = Real(0);
    }
    for (Mat3& k : tangent.k) k.setZero();
    Real wJ(0), wJJ(0);
    for (int m = 0; m < material.directed(); ++m) {
      const auto strain = material.strain(m, c);
      const auto w = material.byDirection(m, strain.k, j);
      wJ += w.wJ;
      wJJ += w.wJJ;
      Vec3 tg[3], dK[3];
      for (int k = 0; k < 3; ++k) {
        tg[k] = times(strain.t, g[k]);
        dK[k] = times(f, tg[k]) * Real(2);
        for (int i = 0; i < 3; ++i) force[k + 1][i] -= rest.volume * w.w1 * dK[k][i];
      }
      for (int p = 0; p < 3; ++p)
        for (int q = p; q < 3; ++q) {
          Mat3& k = tangent.k[pairNumber(p, q)];
          const Real diagonal = Real(2) * w.w1 * dot3(g[p], tg[q]);
          const Vec3 right = dK[q] * w.w11 + dJ[q] * w.w1J;
          for (int b = 0; b < 3; ++b)
            for (int a = 0; a < 3; ++a) {
              Real sum = dK[p][a] * right[b] + dJ[p][a] * w.w1J * dK[q][b];
              if (a == b) sum += diagonal;
              k(a, b) -= rest.volume * sum;
            }
          if (strain.curved) addCurvatureOfStrain(k, f, strain.b, g[p], g[q], rest.volume * w.w1);
        }
    }
    for (int k = 0; k < 3; ++k)
      for (int i = 0; i < 3; ++i) force[k + 1][i] -= rest.volume * wJ * dJ[k][i];
    for (int p = 0; p < 3; ++p)
      for (int q = p; q < 3; ++q) {
        Mat3& k = tangent.k[pairNumber(p, q)];
        for (int b = 0; b < 3; ++b)
          for (int a = 0; a < 3; ++a) k(a, b) -= rest.volume * wJJ * dJ[p][a] * dJ[q][b];
        if (p != q) addCurvatureOfVolume(tangent, x, p, q, wJ);
      }
  }

  // -s F M F' where T changes with C: M_ij = b_ij g_pj g_qi, and on the diagonal sum_j b_ij g_pj g_qj beside
  // it
  SINEW_INLINE static void addCurvatureOfStrain(Mat3& k, Mat3 const& f, Mat3 const& b, Vec3 const& gp,
                                                Vec3 const& gq, Real s) {
    Mat3 m, fm;
    for (int i = 0; i < 3; ++i) {
      Real sum(0);
      for (int j = 0; j < 3; ++j) {
        m(i, j) = b(i, j) * gp[j] * gq[i];
        sum += b(i, j) * gp[j] * gq[j];
      }
      m(i, i) += sum;
    }
    for (int i = 0; i < 3; ++i) fm.col(i) = times(f, Vec3(m.col(i)));
    for (int a = 0; a < 3; ++a)
      for (int c = 0; c < 3; ++c)
        k(a, c) -= s * (fm(a, 0) * f(c, 0) + fm(a, 1) * f(c, 1) + fm(a, 2) * f(c, 2));
  }

  SINEW_HD void forceByStretches(Rest const& rest, Coord const (&x)[4], Deriv (&force)[4],
                                 Tangent& tangent) const {
    const auto svd = singular_values(deformation_gradient(rest, x));
    auto w = material.at(svd.sigma);
    if (definite) clamp(w);
    Vec3 g[3];  // V'g_k
    for (int k = 0; k < 3; ++k) {
      for (int a = 0; a < 3; ++a) g[k][a] = dot3(Vec3(svd.v.col(a)), Vec3(rest.gradient.col(k)));
      const Vec3 pull(w.slope[0] * g[k][0], w.slope[1] * g[k][1], w.slope[2] * g[k][2]);
      const Vec3 column = times(svd.u, pull);
      for (int i = 0; i < 3; ++i) force[k + 1][i] = -rest.volume * column[i];
    }
    Mat3 even, odd;  // of axes a and b: half the sum of shear and spin, half their difference
    for (int c = 0; c < 3; ++c) {
      const int a = (c + 1) % 3, b = (c + 2) % 3;
      even(a, b) = even(b, a) = Real(0.5) * (w.shear[c] + w.spin[c]);
      odd(a, b) = odd(b, a) = Real(0.5) * (w.shear[c] - w.spin[c]);
    }
    for (int p = 0; p < 3; ++p)
      for (int q = p; q < 3; ++q) {
        Mat3 m, um;
        for (int a = 0; a < 3; ++a) {
          for (int b = 0; b < 3; ++b) {
            m(a, b) = w.second(a, b) * g[p][a] * g[q][b];
            if (a != b) m(a, b) += odd(a, b) * g[p][b] * g[q][a];
          }
          const int b = (a + 1) % 3, c = (a + 2) % 3;
          m(a, a) += even(a, b) * g[p][b] * g[q][b] + even(a, c) * g[p][c] * g[q][c];
        }
        for (int c = 0; c < 3; ++c) um.col(c) = times(svd.u, Vec3(m.col(c)));
        Mat3& k = tangent.k[pairNumber(p, q)];
        for (int r = 0; r < 3; ++r)
          for (int c = 0; c < 3; ++c)
            k(r, c) =
                -rest.volume * (um(r, 0) * svd.u(c, 0) + um(r, 1) * svd.u(c, 1) + um(r, 2) * svd.u(c, 2));
      }
  }

  // no negative eigenvalue
  SINEW_HD static void clamp(PrincipalResponse<Real>& w) {
    auto positive = [](Real a) { return select(a < Real(0), Real(0), a); };
    Vec3 values;
    Mat3 axes;
    symmetric_eigen(w.second, values, axes);
    for (int a = 0; a < 3; ++a)
      values[a] = positive(values[a]), w.shear[a] = positive(w.shear[a]), w.spin[a] = positive(w.spin[a]);
    for (int a = 0; a < 3; ++a)
      for (int b = 0; b < 3; ++b)
        w.second(a, b) = axes(a, 0) * values[0] * axes(b, 0) + axes(a, 1) * values[1] * axes(b, 1) +
                         axes(a, 2) * values[2] * axes(b, 2);
  }
};

/// A hyperelastic body, for large strains, of tetrahedra: those of the topology, or six in each of its
/// hexahedra where it has none. Materials with directions take them from the axes f, s and n of each element,
/// at rest: x, y and z, or where `fiberDirections` says so f along the fibres, s in the plane of
/// `sheetDirections` and square to f, n square to both. HolzapfelGasserOgden has a family of fibres along f,
/// or one along each of `AnisotropyDirections`, which are written in these axes: "0.8 0.6 0 0.8 -0.6 0" are
/// two helices around f.
template <class D>
struct TetrahedronHyperelasticityFEMForceField {
  using Role = role::ForceField;
  static constexpr bool sharesWork = true;
  using DataTypes = D;
  using Real = typename D::Real;
  static constexpr std::string_view className = "TetrahedronHyperelasticityFEMForceField";
  static constexpr std::string_view aliases = "StandardTetrahedralFEMForceField";
  static constexpr bool needsTetrahedra = true;

  HyperelasticMaterial materialName = HyperelasticMaterial::ArrudaBoyce;
  std::vector<double> parameterSet{};
  std::vector<Eigen::Vector3d> anisotropyDirections{};
  std::vector<Eigen::Vector3d> fiberDirections{};
  std::vector<Eigen::Vector3d> sheetDirections{};
  bool matrixRegularization = false;
  double continuedBelow = 0.3;

  static constexpr auto fields() {
    using F = TetrahedronHyperelasticityFEMForceField;
    return field_list(
        field("materialName", &F::materialName, "", "energy of the material"),
        field("ParameterSet",
              &F::parameterSet,
              "Pa, alpha, c2, b, k2 and kappa without unit",
              "its parameters: mu k0 of ArrudaBoyce; mu lambda of StVenantKirchhoff, NeoHookean and "
              "StableNeoHookean; c1 c2 k0 of MooneyRivlin (c2 in Pa) and VerondaWestman; mu1 alpha1 [mu2 "
              "alpha2 "
              "[mu3 alpha3]] k0 of Ogden; a k0 bff bfs bss bfn bsn bnn of Costa; mu k0 k1 k2 kappa of "
              "HolzapfelGasserOgden"),
        field("AnisotropyDirections",
              &F::anisotropyDirections,
              "",
              "direction of each family of fibres of HolzapfelGasserOgden, one or two, in the axes of the "
              "elements; none: f"),
        field("fiberDirections",
              &F::fiberDirections,
              "",
              "direction of axis f at rest, one for all elements or one for each, or for each hexahedron; "
              "none: x")
            .oneEach(Of::volumes),
        field("sheetDirections",
              &F::sheetDirections,
              "",
              "direction in the plane of axes f and s, as many; none: some direction square to f")
            .oneEach(Of::volumes),
        field("matrixRegularization",
              &F::matrixRegularization,
              "",
              "keep the tangent of each element positive semi-definite: Newton's steps go downhill, and "
              "converge slower where it is not; not for materials with directions"),
        field("continuedBelow",
              &F::continuedBelow,
              "",
              "ratio of volumes below which the energy is continued gently, so that crushed and inverted "
              "elements "
              "come back; unused where it is a polynomial",
              range::open(0, 1)));
  }

  ForceProperties properties() const { return {.exactTangent = !matrixRegularization}; }

  using Driver = ElementDriver<TetrahedronHyperelasticity, D>;
  Driver driver{};

  void init(InitContext<D> const& context) {
    const std::string where =
        text(context.where, ": ", component_name<TetrahedronHyperelasticityFEMForceField>());
    check_hyperelastic(where, materialName, parameterSet);
    auto const& topology = context.topology;
    const bool cut = topology.tetrahedra.empty();
    check_directions(
        where,
        {materialName, matrixRegularization, anisotropyDirections, fiberDirections, sheetDirections},
        cut ? topology.hexahedra.size() : topology.tetrahedra.size(),
        cut ? "hexahedra" : "tetrahedra");
    init_tetrahedra<D>(where, driver, context, [&](std::size_t e) {
      return axes_of(where, fiberDirections, sheetDirections, cut ? e / 6 : e);
    });
  }

  template <class Law = typename Driver::Law>
  Law law() const {
    Law law;
    law.definite = matrixRegularization;
    law.material.material = materialName;
    law.material.terms = int(parameterSet.size() - 1) / 2;
    law.material.threshold = Real(continuedBelow);
    std::copy(parameterSet.begin(), parameterSet.end(), law.material.p.begin());
    law.material.families = std::max(1, int(anisotropyDirections.size()));
    for (std::size_t a = 0; a < std::size_t(law.material.families); ++a) {
      const Eigen::Vector3d along = anisotropyDirections.empty()
                                        ? Eigen::Vector3d::UnitX()
                                        : Eigen::Vector3d(anisotropyDirections[a].normalized());
      for (std::size_t i = 0; i < 3; ++i) law.material.along[3 * a + i] = Real(along[long(i)]);
    }
    return law;
  }
};

}  // namespace sinew
