// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/core/component.hpp>
#include <sinew/core/element_driver.hpp>
#include <sinew/force/tetrahedron_rest.hpp>

#include <array>
#include <string_view>
#include <vector>

namespace sinew {

/// How the rotation of a corotational element is found, from its edges A = (x1 - x0, x2 - x0, x3 - x0) or
/// from its deformation gradient F = A A_rest^-1.
///   small    none: linear elasticity
///   large    frame on the edges 01 and 02 (Nesme, Payan, Faure 2005), as SOFA's "large"
///   polar    rotation nearest to A, against the one nearest to A_rest, as SOFA's "polar": what it is depends
///            on the order of the points, as with `large`, and it has no energy
///   gradient Gram-Schmidt on the columns of F: as `large`, with the body's axes in the place of the edges
///   nearest  rotation nearest to F (Etzmuss, Keckeisen, Strasser 2003)
/// Inverted elements stay rotations with all of them.
enum class RotationMethod { small, large, polar, gradient, nearest };
inline constexpr std::array<std::string_view, 5> enum_names(RotationMethod) {
  return {"small", "large", "polar", "gradient", "nearest"};
}
/// SOFA's svd is its polar, in which inverted elements keep a rotation, as in `polar` here.
inline constexpr std::array<std::array<std::string_view, 2>, 1> enum_aliases(RotationMethod) {
  return {{{"svd", "polar"}}};
}

/// Linear tetrahedron of an isotropic material, corotational (Mueller, Gross 2004). With h_k = R g_k, where
/// g_k is the gradient of shape function k at rest, all is said in world axes:
///   E = V (mu e:e + lambda/2 tr(e)^2),   e = sym(F R') - I = sym(sum_k x_k h_k') - I           [J]
///   f_k = -V s h_k,   s = 2 mu e + lambda tr(e) I                                              [N]
///   df_i/dx_j = -V (lambda h_i h_j' + mu h_j h_i' + mu h_i.h_j I)          with R held fixed
/// With `nearest`, f is exactly -dE/dx; with `small`, the tangent is exact too.
template <class D>
struct TetrahedronFEM {
  using Real = typename D::Real;
  using Coord = typename D::Coord;
  using Deriv = typename D::Deriv;
  using Vec3 = Vec<Real, 3>;
  using Mat3 = Mat<Real, 3>;
  static constexpr int arity = 4;
  static constexpr bool usesVelocity = false;

  struct Rest {
    Mat3 gradient;      // columns g_1 g_2 g_3, in the axes of the rest frame [1/m]
    Mat3 frame;         // rest frame of the method: columns in body axes
    Real volumeMu;      // V mu [J]
    Real volumeLambda;  // V lambda [J]
  };
  struct Tangent {
    Mat3 h;  // columns h_1 h_2 h_3; h_0 = -(h_1 + h_2 + h_3)
  };

  RotationMethod method = RotationMethod::large;

  SINEW_HD Real energy(Rest const& rest, Coord const (&x)[4]) const {
    const Mat3 e = strain(x, rotation(rest, x) * rest.gradient);
    const Real trace = e(0, 0) + e(1, 1) + e(2, 2);
    return rest.volumeMu * e.squaredNorm() + Real(0.5) * rest.volumeLambda * trace * trace;
  }

  SINEW_HD void force(Rest const& rest, Coord const (&x)[4], Deriv const (&)[4], Deriv (&f)[4],
                      Tangent& tangent) const {
    tangent.h = rotation(rest, x) * rest.gradient;
    internalForce(rest, tangent.h, strain(x, tangent.h), Real(-1), f);
  }

  SINEW_HD void dforce(Rest const& rest, Tangent const& tangent, Deriv const (&dx)[4], Deriv (&df)[4], Real k,
                       Real /*b*/) const {
    const Mat3 e = symmetricGradient(dx, tangent.h);
    internalForce(rest, tangent.h, e, -k, df);
  }

  SINEW_INLINE Mat3 block(Rest const& rest, Tangent const& tangent, int i, int j, Real k, Real /*b*/) const {
    const Vec3 hi = shape(tangent.h, i), hj = shape(tangent.h, j);
    const Real lambda = -k * rest.volumeLambda, mu = -k * rest.volumeMu, diagonal = mu * hi.dot(hj);
    Mat3 block;
    for (int c = 0; c < 3; ++c)
      for (int r = 0; r < 3; ++r) {
        block(r, c) = lambda * hi[r] * hj[c] + mu * hj[r] * hi[c];
        if (r == c) block(r, c) += diagonal;
      }
    return block;
  }

  /// Rest data of the element with rest positions x; throws nothing, the caller has checked the volume.
  static Rest restOf(Coord const (&x)[4], Real mu, Real lambda, RotationMethod method) {
    using std::abs;
    Mat3 edges;
    for (int c = 0; c < 3; ++c) edges.col(c) = x[c + 1] - x[0];
    const Mat3 inverse = edges.inverse();
    Rest rest;
    rest.frame = Mat3::Identity();
    if (method == RotationMethod::large) rest.frame = gramSchmidt(edges);
    if (method == RotationMethod::polar) {
      const Real hand = edges.determinant() < 0 ? -1 : 1;
      rest.frame = hand * nearest(hand * edges);
    }
    rest.gradient = rest.frame.transpose() * inverse.transpose();
    const Real volume = abs(edges.determinant()) / 6;
    rest.volumeMu = volume * mu;
    rest.volumeLambda = volume * lambda;
    return rest;
  }

 private:
  SINEW_INLINE static Vec3 shape(Mat3 const& h, int k) {
    return k == 0 ? Vec3(-(h.col(0) + h.col(1) + h.col(2))) : Vec3(h.col(k - 1));
  }

  // sym(sum_k d_k h_k')
  SINEW_INLINE static Mat3 symmetricGradient(Coord const (&d)[4], Mat3 const& h) {
    const Vec3 a = d[1] - d[0], b = d[2] - d[0], c = d[3] - d[0];
    const Mat3 g = gradientOf(a, b, c, h);
    Mat3 e;
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j <= i; ++j) e(i, j) = e(j, i) = i == j ? g(i, i) : Real(0.5) * (g(i, j) + g(j, i));
    return e;
  }
  SINEW_INLINE static Mat3 gradientOf(Vec3 const& a, Vec3 const& b, Vec3 const& c, Mat3 const& h) {
    Mat3 g;
    for (int j = 0; j < 3; ++j)
      for (int i = 0; i < 3; ++i) g(i, j) = a[i] * h(j, 0) + b[i] * h(j, 1) + c[i] * h(j, 2);
    return g;
  }
  SINEW_INLINE static Mat3 strain(Coord const (&x)[4], Mat3 const& h) {
    Mat3 e = symmetricGradient(x, h);
    for (int i = 0; i < 3; ++i) e(i, i) -= Real(1);
    return e;
  }

  SINEW_INLINE static void internalForce(Rest const& rest, Mat3 const& h, Mat3 const& e, Real factor,
                                         Deriv (&f)[4]) {
    const Real mu2 = factor * Real(2) * rest.volumeMu;
    const Real pressure = factor * rest.volumeLambda * (e(0, 0) + e(1, 1) + e(2, 2));
    Mat3 s;
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j <= i; ++j) s(i, j) = s(j, i) = i == j ? mu2 * e(i, i) + pressure : mu2 * e(i, j);
    for (int k = 0; k < 3; ++k)
      for (int i = 0; i < 3; ++i) f[k + 1][i] = s(i, 0) * h(0, k) + s(i, 1) * h(1, k) + s(i, 2) * h(2, k);
    for (int i = 0; i < 3; ++i) f[0][i] = -(f[1][i] + f[2][i] + f[3][i]);
  }

  // rotation from the rest frame to the world
  SINEW_INLINE Mat3 rotation(Rest const& rest, Coord const (&x)[4]) const {
    if (method == RotationMethod::small) return rest.frame;
    const Vec3 a = x[1] - x[0], b = x[2] - x[0], c = x[3] - x[0];
    if (method == RotationMethod::large || method == RotationMethod::gradient)
      // columns of F times the rest frame
      return gramSchmidt(gradientOf(a, b, c, rest.gradient));
    const bool ofEdges = method == RotationMethod::polar;
    Mat3 m;
    Real hand(1);
    if (ofEdges) {
      // of an element that is left-handed at rest, whose frame is a reflection
      hand = select(
          dot(cross(rest.frame.col(0), rest.frame.col(1)), rest.frame.col(2)) < Real(0), Real(-1), hand);
      m.col(0) = a * hand, m.col(1) = b * hand, m.col(2) = c * hand;
    } else {
      m = gradientOf(a, b, c, rest.gradient);
    }
    m = nearest(m);
    if (ofEdges)
      for (int i = 0; i < 9; ++i) m(i) = m(i) * hand;
    return m;
  }

  SINEW_INLINE static Vec3 cross(Vec3 const& a, Vec3 const& b) {
    return Vec3(a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]);
  }
  SINEW_INLINE static Real dot(Vec3 const& a, Vec3 const& b) {
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
  }

  // right-handed frame: first axis along column 0, third normal to columns 0 and 1
  SINEW_INLINE static Mat3 gramSchmidt(Mat3 const& f) {
    using std::sqrt;
    const Vec3 x = f.col(0), z = cross(x, f.col(1));
    const Real tiny(std::numeric_limits<lane_scalar<Real>>::min());
    const Real ix = Real(1) / sqrt(dot(x, x) + tiny), iz = Real(1) / sqrt(dot(z, z) + tiny);
    Mat3 r;
    const Vec3 ux = x * ix, uz = z * iz;
    r.col(0) = ux;
    r.col(1) = cross(uz, ux);
    r.col(2) = uz;
    return r;
  }

  /// argmax over rotations of tr(R' F): Newton steps w = (tr(M) I - M)^-1 a, M = sym(F R'), a = sum r_i x
  /// f_i, from the Gram-Schmidt frame; where M is far from definite, the safe step a / |tr M| of Mueller et
  /// al. 2016.
  SINEW_HD static Mat3 nearest(Mat3 const& f) {
    using std::abs, sinew::abs;
    Mat3 r = gramSchmidt(f);
    const Real scale = f.squaredNorm() + Real(std::numeric_limits<lane_scalar<Real>>::min());
    const lane_scalar<Real> epsilon = 16 * std::numeric_limits<lane_scalar<Real>>::epsilon();
    for (int iteration = 0; iteration < 40; ++iteration) {
      const Vec3 a = cross(r.col(0), f.col(0)) + cross(r.col(1), f.col(1)) + cross(r.col(2), f.col(2));
      Mat3 m;
      for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j) m(i, j) = f(i, 0) * r(j, 0) + f(i, 1) * r(j, 1) + f(i, 2) * r(j, 2);
      const Real trace = m(0, 0) + m(1, 1) + m(2, 2);
      const Real xx = trace - m(0, 0), yy = trace - m(1, 1), zz = trace - m(2, 2);
      const Real xy = Real(-0.5) * (m(0, 1) + m(1, 0)), xz = Real(-0.5) * (m(0, 2) + m(2, 0)),
                 yz = Real(-0.5) * (m(1, 2) + m(2, 1));
      const Vec3 c0(yy * zz - yz * yz, xz * yz - xy * zz, xy * yz - xz * yy);
      const Vec3 c1(c0[1], xx * zz - xz * xz, xy * xz - xx * yz);
      const Vec3 c2(c0[2], c1[2], xx * yy - xy * xy);
      const Real det = xx * c0[0] + xy * c0[1] + xz * c0[2];
      const auto definite =
          both(det > Real(1e-3) * abs(trace * trace * trace), both(trace > Real(0), c2[2] > Real(0)));
      const Real inverse = Real(1) / select(definite, det, Real(1));
      const Real safe =
          Real(1) / (abs(trace) + Real(1e-9) * scale + Real(std::numeric_limits<lane_scalar<Real>>::min()));
      Vec3 w;
      w[0] = select(definite, dot(c0, a) * inverse, a[0] * safe);
      w[1] = select(definite, dot(c1, a) * inverse, a[1] * safe);
      w[2] = select(definite, dot(c2, a) * inverse, a[2] * safe);
      // Cayley turn by w: exact rotation, angle |w| to second order
      const Vec3 q = Real(0.5) * w;
      const Real n = Real(2) / (Real(1) + dot(q, q));
      for (int c = 0; c < 3; ++c) {
        const Vec3 v = r.col(c), t = cross(q, v) + v;
        const Vec3 turn = cross(q, t);
        for (int i = 0; i < 3; ++i) r(i, c) = v[i] + n * turn[i];
      }
      if (!any(dot(w, w) > Real(epsilon * epsilon))) break;
    }
    return r;
  }
};

/// Corotational linear tetrahedra: those of the topology, or six in each of its hexahedra where it has none.
template <class D>
struct TetrahedronFEMForceField {
  using Role = role::ForceField;
  static constexpr bool takesParts = true;
  using DataTypes = D;
  using Real = typename D::Real;
  static constexpr std::string_view className = "TetrahedronFEMForceField";
  static constexpr std::string_view aliases = "TetrahedralCorotationalFEMForceField";
  static constexpr bool needsTetrahedra = true;

  std::vector<double> youngModulus{5000};  // one for all tetrahedra, or one for each
  double poissonRatio = 0.45;
  RotationMethod method = RotationMethod::large;

  static constexpr auto fields() {
    using F = TetrahedronFEMForceField;
    return field_list(
        field("youngModulus",
              &F::youngModulus,
              "Pa",
              "stiffness of the material: one value, or one a tetrahedron",
              range::positive)
            .oneEach(Of::volumes),
        field("poissonRatio",
              &F::poissonRatio,
              "",
              "lateral contraction over extension; 0.5 is incompressible",
              range::open(-1, 0.5)),
        field("method",
              &F::method,
              "",
              "rotation of an element: small: none, linear elasticity; large: of a frame on two "
              "edges, cheap, exerts a small torque on itself; polar: the nearest to its edges, as in SOFA, "
              "with such a torque too; gradient: as large, on the body's axes; nearest: the nearest to its "
              "deformation, keeps angular momentum, and inverted elements recover"));
  }

  ForceProperties properties() const {
    const bool small = method == RotationMethod::small;
    return {.objective = !small,
            .conservative = small || method == RotationMethod::nearest,
            .exactTangent = small};
  }

  using Driver = ElementDriver<TetrahedronFEM, D>;
  using Law = typename Driver::Law;
  Driver driver{};

  Law law() const { return Law{method}; }

  void init(InitContext<D> const& context) {
    const std::string where = text(context.where, ": ", component_name<TetrahedronFEMForceField>());
    // the edges of `polar` are those from the first point
    const auto tetrahedra = tetrahedra_of(where, context, method == RotationMethod::polar ? 2 : 0);
    if (youngModulus.size() != 1 && youngModulus.size() != tetrahedra.size())
      throw Error(where,
                  text("youngModulus has ",
                       youngModulus.size(),
                       " values for ",
                       tetrahedra.size(),
                       " tetrahedra; give one value, or one for each"));
    std::vector<typename Driver::Rest> rest;
    rest.reserve(tetrahedra.size());
    for (std::size_t e = 0; e < tetrahedra.size(); ++e) {
      typename D::Coord x[4];
      for (std::size_t k = 0; k < 4; ++k) x[k] = context.rest[std::size_t(tetrahedra[e][k])];
      const double E = youngModulus.size() == 1 ? youngModulus[0] : youngModulus[e];
      const double lambda = E * poissonRatio / ((1 + poissonRatio) * (1 - 2 * poissonRatio)),
                   mu = E / (2 * (1 + poissonRatio));
      rest.push_back(TetrahedronFEM<D>::restOf(x, Real(mu), Real(lambda), method));
    }
    driver.init({tetrahedra.begin(), tetrahedra.end()}, rest);
  }
};

}  // namespace sinew
