// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/core/component.hpp>
#include <sinew/core/element_driver.hpp>
#include <sinew/core/follow.hpp>
#include <sinew/core/lists.hpp>
#include <sinew/force/elasticity.hpp>
#include <sinew/force/rotations.hpp>
#include <sinew/force/tetrahedron_rest.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
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
/// With `nearest`, f is exactly -dE/dx; with `small`, the tangent is exact too. Of a plastic material, e is
/// without the plastic strain R P R', which forces hold and flow() changes (Mueller, Gross 2004, 4.4).
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
    Real plastic[6];    // P, in the axes of the rest frame: entries 00 11 22 12 02 01
  };
  struct Tangent {
    Mat3 h;  // columns h_1 h_2 h_3; h_0 = -(h_1 + h_2 + h_3)
  };

  RotationMethod method = RotationMethod::large;
  bool plastic = false;  // whether there is a plastic strain

  SINEW_HD Real energy(Rest const& rest, Coord const (&x)[4]) const {
    const Mat3 r = rotation(rest, x), e = strain(rest, r, x, r * rest.gradient);
    const Real trace = e(0, 0) + e(1, 1) + e(2, 2);
    return rest.volumeMu * e.squaredNorm() + Real(0.5) * rest.volumeLambda * trace * trace;
  }

  SINEW_HD void force(Rest const& rest, Coord const (&x)[4], Deriv const (&)[4], Deriv (&f)[4],
                      Tangent& tangent) const {
    const Mat3 r = rotation(rest, x);
    tangent.h = r * rest.gradient;
    internalForce(rest, tangent.h, strain(rest, r, x, tangent.h), Real(-1), f);
  }

  /// Flow at positions x: where the elastic strain e is more than `yield`, P becomes P + creep e, and is then
  /// shrunk to no more than `most`; both by the norm sqrt(e:e), which no frame changes. What would raise the
  /// energy does not take place: shrinking may, as it goes by another norm than the energy.
  void flow(Rest& rest, Coord const (&x)[4], Real yield, Real most, Real creep) const {
    using std::sqrt, sinew::sqrt;
    const Mat3 r = rotation(rest, x);
    Mat3 const& g = rest.gradient;
    const Mat3 f = gradientOf(Vec3(x[1] - x[0]), Vec3(x[2] - x[0]), Vec3(x[3] - x[0]), g);
    const Mat3 turned = r.transpose() * f;
    Real elastic[6], flowed[6], left[6];
    for (int n = 0; n < 6; ++n) {
      const int i = row(n), j = column(n);
      elastic[n] = Real(0.5) * (turned(i, j) + turned(j, i)) - Real(i == j ? 1 : 0) - rest.plastic[n];
      flowed[n] = rest.plastic[n] + creep * elastic[n];
    }
    const Real size = sqrt(square(flowed) + Real(std::numeric_limits<lane_scalar<Real>>::min()));
    const Real shrink = select(size > most, Real(most / size), Real(1));
    for (int n = 0; n < 6; ++n) {
      flowed[n] = shrink * flowed[n];
      left[n] = elastic[n] + rest.plastic[n] - flowed[n];
    }
    auto stored = [&](Real const(&e)[6]) {
      const Real trace = e[0] + e[1] + e[2];
      return Real(rest.volumeMu * square(e) + Real(0.5) * rest.volumeLambda * trace * trace);
    };
    const Real yielding = select(square(elastic) > yield * yield, Real(1), Real(0)),
               dissipates = select(stored(left) < stored(elastic), Real(1), Real(0));
    for (int n = 0; n < 6; ++n)
      rest.plastic[n] = select(yielding * dissipates > Real(0), flowed[n], rest.plastic[n]);
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

  /// s in the axes of the world, of a material with these moduli.
  Mat3 stress(Rest const& rest, Coord const (&x)[4], Real mu, Real lambda) const {
    const Mat3 r = rotation(rest, x), e = strain(rest, r, x, r * rest.gradient);
    return Real(2) * mu * e + lambda * (e(0, 0) + e(1, 1) + e(2, 2)) * Mat3::Identity();
  }

  /// Rest data of the element with rest positions x; throws nothing, the caller has checked the volume.
  static Rest restOf(Coord const (&x)[4], Real mu, Real lambda, RotationMethod method) {
    using std::abs;
    Mat3 edges;
    for (int c = 0; c < 3; ++c) edges.col(c) = x[c + 1] - x[0];
    const Mat3 inverse = edges.inverse();
    Rest rest;
    rest.frame = Mat3::Identity();
    if (method == RotationMethod::large) rest.frame = frame_of(Vec3(edges.col(0)), Vec3(edges.col(1)));
    if (method == RotationMethod::polar) {
      const Real hand = edges.determinant() < 0 ? -1 : 1;
      rest.frame = hand * nearest_rotation(Mat3(hand * edges));
    }
    rest.gradient = rest.frame.transpose() * inverse.transpose();
    const Real volume = abs(edges.determinant()) / 6;
    rest.volumeMu = volume * mu;
    rest.volumeLambda = volume * lambda;
    for (Real& p : rest.plastic) p = 0;
    return rest;
  }

 private:
  static constexpr int row(int entry) { return entry < 3 ? entry : entry == 3 ? 1 : 0; }
  static constexpr int column(int entry) { return entry < 3 ? entry : entry == 5 ? 1 : 2; }
  // e:e
  static Real square(Real const (&e)[6]) {
    return e[0] * e[0] + e[1] * e[1] + e[2] * e[2] + Real(2) * (e[3] * e[3] + e[4] * e[4] + e[5] * e[5]);
  }

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
  // elastic, in world axes
  SINEW_INLINE Mat3 strain(Rest const& rest, Mat3 const& r, Coord const (&x)[4], Mat3 const& h) const {
    Mat3 e = symmetricGradient(x, h);
    for (int i = 0; i < 3; ++i) e(i, i) -= Real(1);
    if (!plastic) return e;
    Mat3 p;
    for (int n = 0; n < 6; ++n) p(row(n), column(n)) = p(column(n), row(n)) = rest.plastic[n];
    return e - r * p * r.transpose();
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
    if (method == RotationMethod::large || method == RotationMethod::gradient) {
      const Mat3 f = gradientOf(a, b, c, rest.gradient);  // columns of F times the rest frame
      return frame_of(Vec3(f.col(0)), Vec3(f.col(1)));
    }
    const bool ofEdges = method == RotationMethod::polar;
    Mat3 m;
    Real hand(1);
    if (ofEdges) {
      // of an element that is left-handed at rest, whose frame is a reflection
      hand = select(
          dot3(cross3(Vec3(rest.frame.col(0)), Vec3(rest.frame.col(1))), Vec3(rest.frame.col(2))) < Real(0),
          Real(-1),
          hand);
      m.col(0) = a * hand, m.col(1) = b * hand, m.col(2) = c * hand;
    } else {
      m = gradientOf(a, b, c, rest.gradient);
    }
    m = nearest_rotation(m);
    if (ofEdges)
      for (int i = 0; i < 9; ++i) m(i) = m(i) * hand;
    return m;
  }
};

/// An elastic body of corotational linear tetrahedra: those of the topology, or six in each of its hexahedra
/// where it has none.
///
/// With a `plasticMaxThreshold` the material is plastic. Each tetrahedron has a plastic strain P beside its
/// elastic one e, and P is the strain that it would keep without load. Before each step, where |e| is more
/// than `plasticYieldThreshold`, the part `plasticCreep` of e becomes plastic, until |P| is
/// `plasticMaxThreshold`; |e| is sqrt(e:e). What flows does so once a step, so that how fast it does depends
/// on the step. Flow never raises the elastic energy.
template <class D>
struct TetrahedronFEMForceField {
  using Role = role::ForceField;
  static constexpr bool sharesWork = true;
  using Driver = ElementDriver<TetrahedronFEM, D>;
  // its elements are on this side, where flow is computed
  static constexpr bool actsBeforeStep = requires(Driver d) { d.packs; };
  using DataTypes = D;
  using Real = typename D::Real;
  static constexpr std::string_view className = "TetrahedronFEMForceField";
  static constexpr std::string_view aliases = "TetrahedralCorotationalFEMForceField";
  static constexpr bool needsTetrahedra = true;

  std::vector<double> youngModulus{5000};  // one for all tetrahedra, or one for each
  double poissonRatio = 0.45;
  RotationMethod method = RotationMethod::large;
  double plasticMaxThreshold = 0, plasticYieldThreshold = 1e-4, plasticCreep = 0.9;

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
              "deformation, keeps angular momentum, and inverted elements recover"),
        field("plasticMaxThreshold",
              &F::plasticMaxThreshold,
              "",
              "greatest norm of the plastic strain; 0: the material is elastic",
              range::nonNegative),
        field("plasticYieldThreshold",
              &F::plasticYieldThreshold,
              "",
              "norm of the elastic strain above which it flows",
              range::nonNegative),
        field("plasticCreep",
              &F::plasticCreep,
              "",
              "part of the elastic strain that becomes plastic in a step",
              Range{0, 1}));
  }

  ForceProperties properties() const {
    // the rotation is the nearest one for the strain as a whole
    const bool small = method == RotationMethod::small, plastic = plasticMaxThreshold > 0;
    return {.objective = !small,
            .conservative = small || (method == RotationMethod::nearest && !plastic),
            .exactTangent = small};
  }

  using Law = typename Driver::Law;
  Driver driver{};
  std::vector<double> plasticStrain{};  // P of all elements, in their order: entries 00 11 22 12 02 01

  /// What the next step depends on, besides positions and velocities.
  static constexpr auto state() {
    return field_list(field("plasticStrain",
                            &TetrahedronFEMForceField::plasticStrain,
                            "",
                            "of all elements, in the axes of their rest frames"));
  }

  Law law() const { return Law{method, plasticMaxThreshold > 0}; }

  template <class State>
  void beforeStep(StepAhead const&, State const& state) {
    if constexpr (actsBeforeStep) {
      if (!(plasticMaxThreshold > 0)) return;
      using L = typename Driver::L;
      const auto ends = Driver::oneBody(state.position.data());
      for (auto& pack : driver.packs) {
        typename Driver::template OfPoints<typename Driver::DL::Coord> x;
        pack.gather(ends, x);
        law().flow(pack.rest,
                   x,
                   L(Real(plasticYieldThreshold)),
                   L(Real(plasticMaxThreshold)),
                   L(Real(plasticCreep)));
      }
      forEachPlastic([](auto const& ofElement, double& kept) { kept = double(ofElement); });
    }
  }

  void reset() {
    std::fill(plasticStrain.begin(), plasticStrain.end(), 0);
    takePlasticStrain();
  }

  /// Tetrahedra that stay keep their plastic strain, and parts have that of what they are of.
  void follow(Followed const& change) {
    if (!plasticStrain.empty())
      change.topology.ofDimension(3, plasticStrain.size() / 6).filterRows(plasticStrain, 6);
  }

  void init(InitContext<D> const& context) {
    const std::string where = text(context.where, ": ", component_name<TetrahedronFEMForceField>());
    // the edges of `polar` are those from the first point
    const auto tetrahedra = tetrahedra_of(where, context, method == RotationMethod::polar ? 2 : 0);
    check_one_or_each(where, "youngModulus", youngModulus.size(), tetrahedra.size(), "tetrahedra");
    std::vector<typename Driver::Rest> rest;
    rest.reserve(tetrahedra.size());
    for (std::size_t e = 0; e < tetrahedra.size(); ++e) {
      typename D::Coord x[4];
      for (std::size_t k = 0; k < 4; ++k) x[k] = context.rest[std::size_t(tetrahedra[e][k])];
      const LameModuli moduli = lame_moduli(one_or_each(youngModulus, e), poissonRatio);
      rest.push_back(TetrahedronFEM<D>::restOf(x, Real(moduli.mu), Real(moduli.lambda), method));
    }
    driver.init({tetrahedra.begin(), tetrahedra.end()}, rest);
    if (!(plasticMaxThreshold > 0)) return plasticStrain.clear();
    if (!actsBeforeStep)
      throw Error(where,
                  "plastic flow is not computed on a device; leave out plasticMaxThreshold, or take Vec3d");
    if (plasticStrain.size() != 6 * tetrahedra.size()) plasticStrain.assign(6 * tetrahedra.size(), 0);
    takePlasticStrain();
  }

  void addStress(InitContext<D> const& context, typename D::VecCoord const& x,
                 std::vector<Eigen::Matrix3d>& stress) const
  requires std::same_as<typename D::VecCoord, std::vector<typename D::Coord>>
  {
    auto const& tetrahedra = context.topology.tetrahedra;
    const TetrahedronFEM<D> ofOne{method, plasticMaxThreshold > 0};
    for (std::size_t e = 0; e < std::min(tetrahedra.size(), stress.size()); ++e) {
      typename D::Coord atRest[4], now[4];
      for (std::size_t k = 0; k < 4; ++k) {
        atRest[k] = context.rest[std::size_t(tetrahedra[e][k])];
        now[k] = x[std::size_t(tetrahedra[e][k])];
      }
      const LameModuli moduli = lame_moduli(one_or_each(youngModulus, e), poissonRatio);
      auto rest = TetrahedronFEM<D>::restOf(atRest, Real(moduli.mu), Real(moduli.lambda), method);
      if (6 * e + 6 <= plasticStrain.size())
        for (std::size_t n = 0; n < 6; ++n) rest.plastic[n] = Real(plasticStrain[6 * e + n]);
      stress[e] += ofOne.stress(rest, now, Real(moduli.mu), Real(moduli.lambda)).template cast<double>();
    }
  }

 private:
  void takePlasticStrain() {
    forEachPlastic([](auto& ofElement, double kept) { ofElement = Real(kept); });
  }
  // f(entry of the plastic strain of an element, its place in plasticStrain)
  template <class F>
  void forEachPlastic(F&& f) {
    if constexpr (actsBeforeStep) {
      if (plasticStrain.empty()) return;
      constexpr std::size_t lanes = sizeof(typename Driver::L) / sizeof(Real);
      std::size_t at = 0;
      for (auto& pack : driver.packs) {
        Real* const first = reinterpret_cast<Real*>(&pack.rest.plastic);
        for (std::size_t l = 0; l < std::size_t(pack.active); ++l)
          for (std::size_t n = 0; n < 6; ++n) f(first[n * lanes + l], plasticStrain[at++]);
      }
    }
  }
};

}  // namespace sinew
