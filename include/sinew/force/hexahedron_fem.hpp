// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/core/component.hpp>
#include <sinew/core/element_driver.hpp>
#include <sinew/core/lists.hpp>
#include <sinew/force/elasticity.hpp>
#include <sinew/force/hexahedron_rotation.hpp>

#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <string_view>
#include <vector>

namespace sinew {

/// Trilinear hexahedron of an isotropic material, corotational, with 2 x 2 x 2 Gauss points. With F the
/// deformation gradient in a Gauss point and R the rotation of the element:
///   E = sum_g w_g (mu e:e + lambda/2 tr(e)^2),   e = sym(R'F) - I                                [J]
///   f_i = -R sum_g w_g s grad N_i,   s = 2 mu e + lambda tr(e) I                                 [N]
/// The tangent holds R fixed.
///
/// F = [c_0 c_1 c_2] J^-1, where column c_k is the derivative by the k-th coordinate of the reference cube: a
/// mean of the four edges of that direction, with the weights (1 +- 1/sqrt 3)/2 across. So no product with a
/// matrix of 24 x 24 is made, and 91 scalars of an element are kept in the place of the 300 of its stiffness.
///
/// Where all elements are parallelepipeds at rest, J is one for all Gauss points. With
///   u = h_0 + xi h_xi + eta h_eta + ... + xi eta h_xi_eta + ... + xi eta zeta h_xi_eta_zeta
/// the positions in the coordinates of the reference cube and r_k the rows of J^-1, e is a sum of terms
///   1: sym(h_xi r_0' + h_eta r_1' + h_zeta r_2') - I,   xi: sym(h_xi_eta r_1' + h_xi_zeta r_2'),   ...,
///   eta zeta: sym(h_xi_eta_zeta r_0'),   ...
/// which are orthogonal under the quadrature, so that with q = mu e:e + lambda/2 tr(e)^2
///   E = 8 w (q(1) + (q(xi) + q(eta) + q(zeta))/3 + (q(xi eta) + q(xi zeta) + q(eta zeta))/9)
template <class D>
struct HexahedronFEM {
  using Real = typename D::Real;
  using Coord = typename D::Coord;
  using Deriv = typename D::Deriv;
  using Vec3 = Vec<Real, 3>;
  using Mat3 = Mat<Real, 3>;
  static constexpr int arity = 8;
  static constexpr bool usesVelocity = false;

  struct Rest {
    Mat3 inverse[8];  // J^-1 in each Gauss point, in the axes of the rest frame of the method [1/m]
    Real weight[8];   // det J [m^3]
    Mat3 center;      // J^-1 in the centre, for `nearest`
    IsotropicMaterial<Real> material;
  };
  struct Tangent {
    Mat3 rotation;
  };

  HexahedronMethod method = HexahedronMethod::large;
  bool parallelepipeds = false;  // all elements at rest

  SINEW_HD Real energy(Rest const& rest, Coord const (&x)[8]) const {
    Vec3 y[8], column[3][4];
    rotate_back(rotation(rest, x), x, y);
    Real sum(0);
    if (parallelepipeds) {
      Vec3 h[8];
      expand(y, h);
      for (const int term : {0, 1, 2, 4})
        sum += Real(term == 0 ? 1.0 : 1.0 / 3) * rest.material.energy(strainTerm(rest, h, term, Real(1)));
      for (int i = 0; i < 3; ++i) sum += Real(1.0 / 18) * h[7][i] * twist(rest, h[7])[i];
      return Real(8) * rest.weight[0] * sum;
    }
    columns(y, column);
    for (int g = 0; g < 8; ++g)
      sum += rest.weight[g] * rest.material.energy(strain(rest, column, g, Real(1)));
    return sum;
  }

  SINEW_HD void force(Rest const& rest, Coord const (&x)[8], Deriv const (&)[8], Deriv (&f)[8],
                      Tangent& tangent) const {
    tangent.rotation = rotation(rest, x);
    internalForce(rest, tangent.rotation, x, Real(1), Real(-1), f);
  }

  SINEW_HD void dforce(Rest const& rest, Tangent const& tangent, Deriv const (&dx)[8], Deriv (&df)[8], Real k,
                       Real /*b*/) const {
    internalForce(rest, tangent.rotation, dx, Real(0), -k, df);
  }

  /// -k R sum_g w (lambda h_i h_j' + mu h_j h_i' + mu h_i.h_j I) R',  h_i = grad N_i
  SINEW_HD Mat3 block(Rest const& rest, Tangent const& tangent, int i, int j, Real k, Real /*b*/) const {
    Mat3 m;  // sum_g w h_i h_j'
    if (parallelepipeds) {
      m = slopes(rest, i, j);
    } else {
      for (int c = 0; c < 9; ++c) m(c) = Real(0);
      for (int g = 0; g < 8; ++g) {
        const Vec3 hi = gradient(rest, g, i) * rest.weight[g], hj = gradient(rest, g, j);
        for (int c = 0; c < 3; ++c)
          for (int r = 0; r < 3; ++r) m(r, c) += hi[r] * hj[c];
      }
    }
    return rotated(tangent.rotation, rest.material.stiffness(m, -k));
  }

  /// Whether opposite edges of the element are equal, to the rounding of its corners.
  static bool isParallelepiped(Coord const (&x)[8]) {
    Vec3 y[8], h[8];
    Real largest(0), bent(0);
    for (int i = 0; i < 8; ++i) {
      largest = std::max(largest, x[i].cwiseAbs().maxCoeff());
      y[i] = x[i] - x[0];
    }
    expand(y, h);
    for (const int term : {3, 5, 6, 7}) bent = std::max(bent, h[term].cwiseAbs().maxCoeff());
    return bent <= 4 * std::numeric_limits<Real>::epsilon() * largest;
  }

  /// Rest data of the element with rest positions x; a weight that is not positive tells of a bad shape.
  static Rest restOf(Coord const (&x)[8], Real mu, Real lambda, HexahedronMethod method) {
    const Mat3 a = hexahedron_jacobian<Real>(x), frame = hexahedron_rest_frame<Real>(method, a);
    Vec3 y[8], column[3][4];
    rotate_back(frame, x, y);
    columns(y, column);
    Rest rest;
    for (int g = 0; g < 8; ++g) {
      Mat3 j;
      for (int k = 0; k < 3; ++k) j.col(k) = column[k][columnOf(k, g)];
      rest.inverse[g] = j.inverse();
      rest.weight[g] = j.determinant();
    }
    rest.center = a.inverse();
    rest.material = {mu, lambda};
    return rest;
  }

 private:
  static constexpr int corner(int bits) { return detail::hexahedron_corner(bits); }
  static constexpr int across(int k, int which) { return detail::hexahedron_across(k, which); }
  static constexpr int end(int k, int uv, int high) { return detail::hexahedron_end(k, uv, high); }
  static constexpr int columnOf(int k, int g) {
    return (g >> across(k, 0) & 1) | (g >> across(k, 1) & 1) << 1;
  }

  // from values on the four edges of a direction to those in the Gauss points across, or the transpose of it
  SINEW_INLINE static void mix(Vec3 (&d)[4]) {
    const auto a = Real(0.78867513459481288225), b = Real(0.21132486540518711775);  // (1 +- 1/sqrt 3)/2
    for (int i = 0; i < 3; ++i) {
      const Real p = a * d[0][i] + b * d[1][i], q = b * d[0][i] + a * d[1][i];
      const Real r = a * d[2][i] + b * d[3][i], s = b * d[2][i] + a * d[3][i];
      d[0][i] = a * p + b * r, d[1][i] = a * q + b * s, d[2][i] = b * p + a * r, d[3][i] = b * q + a * s;
    }
  }
  SINEW_INLINE static void columns(Vec3 const (&y)[8], Vec3 (&column)[3][4]) {
    for (int k = 0; k < 3; ++k) {
      for (int uv = 0; uv < 4; ++uv) column[k][uv] = (y[end(k, uv, 1)] - y[end(k, uv, 0)]) * Real(0.5);
      mix(column[k]);
    }
  }
  SINEW_INLINE static Mat3 strain(Rest const& rest, Vec3 const (&column)[3][4], int g, Real one) {
    Mat3 const& inverse = rest.inverse[g];
    Vec3 const &c0 = column[0][columnOf(0, g)], &c1 = column[1][columnOf(1, g)],
               &c2 = column[2][columnOf(2, g)];
    Mat3 f;
    for (int j = 0; j < 3; ++j)
      for (int i = 0; i < 3; ++i)
        f(i, j) = c0[i] * inverse(0, j) + c1[i] * inverse(1, j) + c2[i] * inverse(2, j);
    return small_strain(f, one);
  }

  // Parallelepipeds. A term is numbered by bits of the coordinates in it: 0 is 1, 1 xi, 2 eta, 4 zeta, 3 xi
  // eta, ...
  SINEW_INLINE static void expand(Vec3 const (&y)[8], Vec3 (&h)[8]) {
    for (int bits = 0; bits < 8; ++bits) h[bits] = y[corner(bits)] * Real(0.125);
    butterflies<false>(h);
  }
  // forces on the corners of forces on the terms, the transpose of it; that on the term 1 is zero
  SINEW_INLINE static void collect(Vec3 (&p)[8], Vec3 (&y)[8]) {
    for (int i = 0; i < 3; ++i) p[0][i] = Real(0);
    butterflies<true>(p);
    for (int bits = 0; bits < 8; ++bits) y[corner(bits)] = p[bits] * Real(0.125);
  }
  // along each coordinate, sums and differences of the values that lie opposite
  template <bool transposed>
  SINEW_INLINE static void butterflies(Vec3 (&h)[8]) {
#pragma GCC unroll 3
    for (int k = 1; k < 8; k *= 2)
#pragma GCC unroll 8
      for (int low = 0; low < 8; ++low)
        if (!(low & k)) {
          const Vec3 sum = h[low] + h[low | k];
          if constexpr (transposed) {
            h[low] = h[low] - h[low | k];
            h[low | k] = sum;
          } else {
            h[low | k] = h[low | k] - h[low];
            h[low] = sum;
          }
        }
  }
  // of the terms 1, xi, eta and zeta
  SINEW_INLINE static Mat3 strainTerm(Rest const& rest, Vec3 const (&h)[8], int term, Real one) {
    Mat3 const& inverse = rest.inverse[0];
    Mat3 f;
    for (int i = 0; i < 9; ++i) f(i) = Real(0);
#pragma GCC unroll 3
    for (int k = 0; k < 3; ++k)
      if (!(term >> k & 1)) {
        Vec3 const& c = h[term | 1 << k];
        for (int j = 0; j < 3; ++j)
          for (int i = 0; i < 3; ++i) f(i, j) += c[i] * inverse(k, j);
      }
    return small_strain(f, term == 0 ? one : Real(0));
  }
  // sum_k s_k r_k over e_k = sym(h r_k'), with s_k r_k = mu |r_k|^2 h + (mu + lambda) (r_k.h) r_k; and
  // sum_k q(e_k) = h.twist(h)/2
  SINEW_INLINE static Vec3 twist(Rest const& rest, Vec3 const& h) {
    Mat3 const& inverse = rest.inverse[0];
    Vec3 sum;
    Real square(0);
    for (int i = 0; i < 9; ++i) square += inverse(i) * inverse(i);
    for (int i = 0; i < 3; ++i) sum[i] = rest.material.mu * square * h[i];
    for (int k = 0; k < 3; ++k) {
      const Real along = (rest.material.mu + rest.material.lambda) *
                         (inverse(k, 0) * h[0] + inverse(k, 1) * h[1] + inverse(k, 2) * h[2]);
      for (int i = 0; i < 3; ++i) sum[i] += along * inverse(k, i);
    }
    return sum;
  }
  // w J^-T C J^-1 with C = sum_g of the products of the slopes of two corners' shape functions by the
  // coordinates of the reference cube. Over the two Gauss points of a coordinate the products of (1 +- xi)/2
  // sum to 2/3 for the same sign and 1/3 for opposite ones, the functions themselves to 1.
  SINEW_INLINE static Mat3 slopes(Rest const& rest, int i, int j) {
    const int first = i ^ (i >> 1 & 1), second = j ^ (j >> 1 & 1);
    auto sign = [](int bits, int k) { return (bits >> k & 1) ? 0.5 : -0.5; };
    auto overlap = [&](int k) { return ((first ^ second) >> k & 1) ? 1.0 / 3 : 2.0 / 3; };
    Mat3 const& inverse = rest.inverse[0];
    Mat3 half;  // C J^-1
    for (int k = 0; k < 3; ++k) {
      for (int c = 0; c < 3; ++c) half(k, c) = Real(0);
      for (int l = 0; l < 3; ++l) {
        const double sum = k == l ? 2 * overlap(across(k, 0)) * overlap(across(k, 1)) : overlap(3 - k - l);
        const auto entry = Real(sign(first, k) * sign(second, l) * sum);
        for (int c = 0; c < 3; ++c) half(k, c) += entry * inverse(l, c);
      }
    }
    return rest.weight[0] * (inverse.transpose() * half);
  }

  // f = factor R sum_g w s grad N at the strain of positions (one = 1) or displacements (one = 0)
  SINEW_HD void internalForce(Rest const& rest, Mat3 const& r, Coord const (&x)[8], Real one, Real factor,
                              Deriv (&f)[8]) const {
    Vec3 y[8];
    rotate_back(r, x, y);
    if (parallelepipeds)
      forceOfTerms(rest, one, factor * rest.weight[0], y);
    else
      forceOfPoints(rest, one, factor, y);
    for (int i = 0; i < 8; ++i) f[i] = r * y[i];
  }

  // from positions in the frame of the element to forces
  SINEW_INLINE static void forceOfPoints(Rest const& rest, Real one, Real factor, Vec3 (&y)[8]) {
    Vec3 column[3][4], pull[3][4];
    columns(y, column);
    for (int k = 0; k < 3; ++k)
      for (int uv = 0; uv < 4; ++uv)
        for (int i = 0; i < 3; ++i) pull[k][uv][i] = Real(0);
    for (int g = 0; g < 8; ++g) {
      const Mat3 s = rest.material.stress(strain(rest, column, g, one), factor * rest.weight[g]);
      for (int k = 0; k < 3; ++k) addColumn(s, rest.inverse[g], k, pull[k][columnOf(k, g)]);
    }
    for (int i = 0; i < 8; ++i)
      for (int c = 0; c < 3; ++c) y[i][c] = Real(0);
    for (int k = 0; k < 3; ++k) {
      mix(pull[k]);
      for (int uv = 0; uv < 4; ++uv) {
        const Vec3 half = pull[k][uv] * Real(0.5);
        y[end(k, uv, 1)] += half;
        y[end(k, uv, 0)] -= half;
      }
    }
  }
  SINEW_INLINE static void forceOfTerms(Rest const& rest, Real one, Real weight, Vec3 (&y)[8]) {
    Vec3 h[8], p[8];
    expand(y, h);
    p[7] = twist(rest, h[7]) * (Real(8.0 / 9) * weight);
    for (int term = 1; term < 7; ++term)
      for (int i = 0; i < 3; ++i) p[term][i] = Real(0);
#pragma GCC unroll 5
    for (int term = 0; term < 5; ++term)
      if (term != 3) {
        const Mat3 s =
            rest.material.stress(strainTerm(rest, h, term, one), Real(term == 0 ? 8.0 : 8.0 / 3) * weight);
#pragma GCC unroll 3
        for (int k = 0; k < 3; ++k)
          if (!(term >> k & 1)) addColumn(s, rest.inverse[0], k, p[term | 1 << k]);
      }
    collect(p, y);
  }
  // sum += s r_k
  SINEW_INLINE static void addColumn(Mat3 const& s, Mat3 const& inverse, int k, Vec3& sum) {
    sum += s * inverse.row(k).transpose();
  }

  // gradient of shape function i in Gauss point g
  SINEW_INLINE static Vec3 gradient(Rest const& rest, int g, int i) {
    Vec3 slope;                         // by the coordinates of the reference cube
    const int bits = i ^ (i >> 1 & 1);  // of VTK's corner i
    const int differ = g ^ bits;        // directions in which corner and Gauss point are on different sides
    for (int k = 0; k < 3; ++k) {
      const double a = 0.78867513459481288225, b = 0.21132486540518711775;
      slope[k] = Real(((bits >> k & 1) ? 0.5 : -0.5) * ((differ >> across(k, 0) & 1) ? b : a) *
                      ((differ >> across(k, 1) & 1) ? b : a));
    }
    return rest.inverse[g].transpose() * slope;
  }

  SINEW_INLINE Mat3 rotation(Rest const& rest, Coord const (&x)[8]) const {
    return hexahedron_rotation<Real>(method, rest.center, x);
  }
};

/// An elastic body of corotational linear hexahedra. Those of a SparseGridTopology that touch its surface are
/// half as stiff, as in SOFA, unless its fillWeighted is off.
template <class D>
struct HexahedronFEMForceField {
  using Role = role::ForceField;
  static constexpr bool sharesWork = true;
  using DataTypes = D;
  using Real = typename D::Real;
  static constexpr std::string_view className = "HexahedronFEMForceField",
                                    aliases = "HexahedralFEMForceField";

  std::vector<double> youngModulus{5000};  // one for all hexahedra, or one for each
  double poissonRatio = 0.45;
  HexahedronMethod method = HexahedronMethod::large;

  static constexpr auto fields() {
    using F = HexahedronFEMForceField;
    return field_list(
        field("youngModulus",
              &F::youngModulus,
              "Pa",
              "stiffness of the material: one value, or one a hexahedron",
              range::positive)
            .oneEach(Of::hexahedra),
        field("poissonRatio",
              &F::poissonRatio,
              "",
              "lateral contraction over extension; 0.5 is incompressible",
              range::open(-1, 0.5)),
        field("method",
              &F::method,
              "",
              "rotation of an element: large: of a frame on two of its mean edges; polar: the "
              "nearest to these, as in SOFA; small: none, linear elasticity; nearest: the nearest "
              "to its deformation"));
  }

  ForceProperties properties() const {
    const bool small = method == HexahedronMethod::small;
    return {.objective = !small, .conservative = small, .exactTangent = small};
  }

  using Driver = ElementDriver<HexahedronFEM, D>;
  using Law = typename Driver::Law;
  Driver driver{};
  bool parallelepipeds = false;  // all of them, at rest; set by init

  Law law() const { return Law{method, parallelepipeds}; }

  void init(InitContext<D> const& context) {
    auto const& hexahedra = context.topology.hexahedra;
    auto const& fill = context.topology.fill;
    const std::string where = text(context.where, ": ", component_name<HexahedronFEMForceField>());
    if (hexahedra.empty() && !context.topology.grows)
      throw Error(where, "the topology has no hexahedron; give the node a topology with hexahedra");
    detail::check_indices(where, "hexahedron", hexahedra, context.rest.size());
    check_one_or_each(where, "youngModulus", youngModulus.size(), hexahedra.size(), "hexahedra");
    std::vector<typename Driver::Rest> rest;
    rest.reserve(hexahedra.size());
    parallelepipeds = true;
    for (std::size_t e = 0; e < hexahedra.size(); ++e) {
      typename D::Coord x[8];
      for (std::size_t k = 0; k < 8; ++k) x[k] = context.rest[std::size_t(hexahedra[e][k])];
      const double E = one_or_each(youngModulus, e) * (fill.size() == hexahedra.size() ? fill[e] : 1.0);
      const LameModuli moduli = lame_moduli(E, poissonRatio);
      rest.push_back(HexahedronFEM<D>::restOf(x, Real(moduli.mu), Real(moduli.lambda), method));
      parallelepipeds = parallelepipeds && HexahedronFEM<D>::isParallelepiped(x);
      const Real longest = (x[6] - x[0]).norm();
      for (const Real w : rest.back().weight)
        if (!(w > Real(1e-12) * longest * longest * longest))
          throw Error(
              where,
              text("hexahedron ",
                   e,
                   " is flat, inside out or twisted; its corners are the four of one face in a circle, "
                   "then those opposite of them, each face counter-clockwise as seen from inside"));
    }
    driver.init({hexahedra.begin(), hexahedra.end()}, rest);
  }
};

}  // namespace sinew
