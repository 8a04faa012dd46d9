// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/core/compiled.hpp>
#include <sinew/core/data_types.hpp>
#include <sinew/force/fibrous_material.hpp>
#include <sinew/force/hyperelastic_response.hpp>

#include <array>
#include <cmath>
#include <string_view>
#include <vector>

namespace sinew {

/// Hyperelastic materials, by SOFA's names, with SOFA's order of parameters. W is the energy per
/// volume at rest [Pa] of the deformation gradient F with singular values s_a; I1 = sum s_a^2,
/// I2 = sum_(a<b) s_a^2 s_b^2, J = det F, and bars take the change of volume out: B1 = J^(-2/3) I1, B2 =
/// J^(-4/3) I2.
///   ArrudaBoyce        mu k0        W = mu sum_n c_n (B1^n - 3^n) + k0/2 ln^2 J          (1993; N = 8 links)
///   StVenantKirchhoff  mu lambda    W = mu E:E + lambda/2 (tr E)^2,  E = (F'F - I)/2
///   NeoHookean         mu lambda    W = mu/2 (I1 - 3) - mu ln J + lambda/2 ln^2 J        (Bonet, Wood 2008)
///   MooneyRivlin       c1 c2 k0     W = c1 (B1 - 3) + c2 (B2 - 3) + k0/2 ln^2 J
///   Ogden              mu1 alpha1 [mu2 alpha2 [mu3 alpha3]] k0     W = k0/2 ln^2 J
///                         + sum_i mu_i/alpha_i^2 (sum_a (J^(-1/3) s_a)^alpha_i - 3)      (1972, as SOFA has
///                         it)
///   StableNeoHookean   mu lambda    W = mu/2 (I1 - 3) + (lambda + mu)/2 (J - a)^2 - c,  a = 1 + mu/(lambda +
///   mu)
///                                                                       (Smith, de Goes, Kim 2018; c: W = 0
///                                                                       at rest)
///   VerondaWestman     c1 c2 k0     W = c1 (e^(c2 (B1 - 3)) - 1) - c1 c2/2 (B2 - 3) + k0/2 ln^2 J (1970)
/// and two with directions, those of the axes f, s and n of an element, E = (F'F - I)/2:
///   Costa              a k0 bff bfs bss bfn bsn bnn     W = a/2 (e^(J^(-4/3) Q) - 1) + k0 (J ln J - J + 1)
///                         Q = bff Eff^2 + bss Ess^2 + bnn Enn^2 + 2 (bfs Efs^2 + bfn Efn^2 + bsn Esn^2)
///                                                       (Costa, Holmes, McCulloch 2001, as SOFA has it)
///   HolzapfelGasserOgden    mu k0 k1 k2 kappa     fibres along unit vectors a, dispersed by kappa in [0,
///   1/3]
///                         W = mu/2 (B1 - 3) + k0/2 ln^2 J + sum_a k1/(2 k2) (e^(k2 <E>^2) - 1),
///                         E = J^(-2/3) (kappa I1 + (1 - 3 kappa) a'F'F a) - 1, of which <E> is what is
///                         positive: fibres carry tension only        (Gasser, Ogden, Holzapfel 2006)
/// Of these, StVenantKirchhoff and StableNeoHookean are polynomials in F. In the others the functions of J
/// are continued below a smallest ratio, with two derivatives, by what ends in straight lines: W is defined
/// for crushed and inverted elements too, grows with inversion, and drives them back. StVenantKirchhoff, and
/// Costa but for its term of volume, take an element that is inside out for its mirror image, which they
/// hold. Exponentials are continued above e^50; what they do to elements far from rest takes small steps.
enum class HyperelasticMaterial {
  ArrudaBoyce,
  StVenantKirchhoff,
  NeoHookean,
  MooneyRivlin,
  Ogden,
  StableNeoHookean,
  VerondaWestman,
  Costa,
  HolzapfelGasserOgden
};
inline constexpr std::array<std::string_view, 9> enum_names(HyperelasticMaterial) {
  return {"ArrudaBoyce",
          "StVenantKirchhoff",
          "NeoHookean",
          "MooneyRivlin",
          "Ogden",
          "StableNeoHookean",
          "VerondaWestman",
          "Costa",
          "HolzapfelGasserOgden"};
}
/// Whether the energy depends on directions in the body.
inline constexpr bool has_directions(HyperelasticMaterial material) {
  return material == HyperelasticMaterial::Costa || material == HyperelasticMaterial::HolzapfelGasserOgden;
}
/// Names of the parameters, in their order.
inline constexpr std::string_view parameter_names(HyperelasticMaterial material) {
  switch (material) {
    case HyperelasticMaterial::ArrudaBoyce:
      return "mu k0";
    case HyperelasticMaterial::MooneyRivlin:
    case HyperelasticMaterial::VerondaWestman:
      return "c1 c2 k0";
    case HyperelasticMaterial::Costa:
      return "a k0 bff bfs bss bfn bsn bnn";
    case HyperelasticMaterial::HolzapfelGasserOgden:
      return "mu k0 k1 k2 kappa";
    case HyperelasticMaterial::Ogden:
      return "mu1 alpha1 [mu2 alpha2 [mu3 alpha3]] k0";
    default:
      return "mu lambda";
  }
}
inline constexpr bool takes_parameters(HyperelasticMaterial material, std::size_t count) {
  switch (material) {
    case HyperelasticMaterial::MooneyRivlin:
    case HyperelasticMaterial::VerondaWestman:
      return count == 3;
    case HyperelasticMaterial::Costa:
      return count == 8;
    case HyperelasticMaterial::HolzapfelGasserOgden:
      return count == 5;
    case HyperelasticMaterial::Ogden:
      return count == 3 || count == 5 || count == 7;
    default:
      return count == 2;
  }
}

/// A material of the first kind: a function at(p, I1, I2, J, threshold) of its parameters p.
struct StVenantKirchhoff {
  template <class Real, class P>
  SINEW_INLINE static detail::InvariantResponse<Real> at(P const& p, Real i1, Real i2, Real, Real) {
    // E:E = (tr C^2 - 2 I1 + 3)/4 with tr C^2 = I1^2 - 2 I2
    const Real mu(p[0]), lambda(p[1]), e = Real(0.5) * (i1 - Real(3));
    detail::InvariantResponse<Real> r;
    r.w = Real(0.25) * mu * (i1 * (i1 - Real(2)) - Real(2) * i2 + Real(3)) + Real(0.5) * lambda * e * e;
    r.w1 = Real(0.5) * (mu * (i1 - Real(1)) + lambda * e);
    r.w2 = Real(-0.5) * mu;
    r.w11 = Real(0.5) * mu + Real(0.25) * lambda;
    return r;
  }
};

struct NeoHookean {
  template <class Real, class P>
  SINEW_INLINE static detail::InvariantResponse<Real> at(P const& p, Real i1, Real, Real j, Real threshold) {
    const Real mu(p[0]), lambda(p[1]);
    detail::InvariantResponse<Real> r;
    r.w = Real(0.5) * mu * (i1 - Real(3));
    r.w1 = Real(0.5) * mu;
    r.add(detail::Continued<Real>(j, threshold).barrier(mu, lambda));
    return r;
  }
};

struct StableNeoHookean {
  template <class Real, class P>
  SINEW_INLINE static detail::InvariantResponse<Real> at(P const& p, Real i1, Real, Real j, Real) {
    const Real mu(p[0]), bulk = Real(p[1]) + mu, d = j - Real(1);
    detail::InvariantResponse<Real> r;
    r.w = Real(0.5) * mu * (i1 - Real(3)) + d * (Real(0.5) * bulk * d - mu);
    r.w1 = Real(0.5) * mu;
    r.wJ = bulk * d - mu;
    r.wJJ = bulk;
    return r;
  }
};

struct MooneyRivlin {
  template <class Real, class P>
  SINEW_INLINE static detail::InvariantResponse<Real> at(P const& p, Real i1, Real i2, Real j,
                                                         Real threshold) {
    const Real c1(p[0]), c2(p[1]);
    const detail::Continued<Real> volume(j, threshold);
    const auto q = volume.power(lane_scalar<Real>(-2) / 3), qq = q.square();
    detail::InvariantResponse<Real> r;
    r.add({c1 * (q.f * i1 - Real(3)), c1, Real(0)}, q, i1);
    r.add({c2 * (qq.f * i2 - Real(3)), c2 * qq.d * i2, c2 * qq.dd * i2});
    r.w2 = c2 * qq.f;
    r.w2J = c2 * qq.d;
    r.add(volume.barrier(Real(0), Real(p[2])));
    return r;
  }
};

struct VerondaWestman {
  template <class Real, class P>
  SINEW_INLINE static detail::InvariantResponse<Real> at(P const& p, Real i1, Real i2, Real j,
                                                         Real threshold) {
    const Real c1(p[0]), c2(p[1]), m = Real(-0.5) * c1 * c2;
    const detail::Continued<Real> volume(j, threshold);
    const auto q = volume.power(lane_scalar<Real>(-2) / 3), qq = q.square();
    const auto e = detail::exponential(Real(c2 * (q.f * i1 - Real(3))));
    detail::InvariantResponse<Real> r;
    r.add({c1 * (e.f - Real(1)), c1 * c2 * e.d, c1 * c2 * c2 * e.dd}, q, i1);
    r.add({m * (qq.f * i2 - Real(3)), m * qq.d * i2, m * qq.dd * i2});
    r.w2 = m * qq.f;
    r.w2J = m * qq.d;
    r.add(volume.barrier(Real(0), Real(p[2])));
    return r;
  }
};

struct ArrudaBoyce {
  // c_n of chains of 8 links
  static constexpr std::array<double, 5> series() {
    return {1.0 / 2, 1.0 / (20 * 8), 11.0 / (1050 * 64), 19.0 / (7000 * 512), 519.0 / (673750.0 * 4096)};
  }
  template <class Real, class P>
  SINEW_INLINE static detail::InvariantResponse<Real> at(P const& p, Real i1, Real, Real j, Real threshold) {
    const detail::Continued<Real> volume(j, threshold);
    const auto q = volume.power(lane_scalar<Real>(-2) / 3);
    const Real b1 = q.f * i1;
    constexpr std::array<double, 5> c = series();
    detail::Jet<Real> phi{Real(0), Real(0), Real(0)};
    double three = 0;
    for (int n = 4; n >= 0; --n) {  // Horner
      phi.dd = phi.dd * b1 + Real(2) * phi.d;
      phi.d = phi.d * b1 + phi.f;
      phi.f = phi.f * b1 + Real(c[std::size_t(n)]);
      three = three * 3 + c[std::size_t(n)];
    }
    const Real mu(p[0]);
    phi = {
        mu * (phi.f * b1 - Real(3 * three)), mu * (phi.d * b1 + phi.f), mu * (phi.dd * b1 + Real(2) * phi.d)};
    detail::InvariantResponse<Real> r;
    r.add(phi, q, i1);
    r.add(volume.barrier(Real(0), Real(p[1])));
    return r;
  }
};

/// W as a function of the singular values s_a: its gradient and its second derivatives, and the eigenvalues
/// of its second derivative by F in the axes b and c other than a, of their shear and of their rotation:
///   shear_a = (W_b - W_c)/(s_b - s_c),   spin_a = (W_b + W_c)/(s_b + s_c)
template <class Real>
struct PrincipalResponse {
  Real w{0};
  Vec<Real, 3> slope;
  Mat<Real, 3> second;
  Vec<Real, 3> shear, spin;
};

/// The same response seen from the singular values.
template <class Real>
SINEW_HD PrincipalResponse<Real> principal(detail::InvariantResponse<Real> const& r, Vec<Real, 3> const& s,
                                           Real i1) {
  PrincipalResponse<Real> out;
  out.w = r.w;
  Real p[3], m[3], j[3];  // derivatives of I1, I2 and J
  for (int a = 0; a < 3; ++a) {
    p[a] = Real(2) * s[a];
    m[a] = p[a] * (i1 - s[a] * s[a]);
    j[a] = s[(a + 1) % 3] * s[(a + 2) % 3];
    out.slope[a] = r.w1 * p[a] + r.w2 * m[a] + r.wJ * j[a];
  }
  for (int a = 0; a < 3; ++a)
    for (int b = a; b < 3; ++b) {
      const Real own = a == b ? Real(2) * (r.w1 + r.w2 * (i1 - s[a] * s[a]))
                              : Real(4) * r.w2 * s[a] * s[b] + r.wJ * s[3 - a - b];
      out.second(a, b) = out.second(b, a) = own + r.w11 * p[a] * p[b] + r.w1J * (p[a] * j[b] + j[a] * p[b]) +
                                            r.w2J * (m[a] * j[b] + j[a] * m[b]) + r.wJJ * j[a] * j[b];
    }
  for (int a = 0; a < 3; ++a) {
    const Real b = s[(a + 1) % 3], c = s[(a + 2) % 3], squares = b * b + c * c, product = b * c;
    out.shear[a] = Real(2) * (r.w1 + r.w2 * (i1 - squares - product)) - r.wJ * s[a];
    out.spin[a] = Real(2) * (r.w1 + r.w2 * (i1 - squares + product)) + r.wJ * s[a];
  }
  return out;
}

namespace detail {

/// sum_a h(y_a^2) with h(c) = c^half, half > 0, of three numbers y, and its derivatives by them; h continued
/// below `threshold` by its Taylor polynomial of degree 2, so that it is smooth at 0. shear and spin are
/// those of PrincipalResponse.
template <class Real>
struct PowerSum {
  Real sum{0}, slope[3], second[3], shear[3], spin[3];

  SINEW_HD PowerSum(Real const (&y)[3], Real threshold, lane_scalar<Real> half) {
    const Continued<Real> c[3]{{y[0] * y[0], threshold}, {y[1] * y[1], threshold}, {y[2] * y[2], threshold}};
    Jet<Real> start[3], h[3];  // where the continuation starts, and here
    for (int a = 0; a < 3; ++a) {
      const Real f = exp_of(Real(Real(half) * c[a].log)), d = Real(half) * f * c[a].inverse;
      start[a] = {f, d, Real(half - 1) * d * c[a].inverse};
      h[a] = start[a].taylor(c[a].by);
      sum += h[a].f;
      slope[a] = Real(2) * y[a] * h[a].d;
      second[a] = Real(2) * h[a].d + Real(4) * y[a] * y[a] * h[a].dd;
    }
    for (int a = 0; a < 3; ++a) {
      const int b = (a + 1) % 3, e = (a + 2) % 3;
      const Real rate = slopeRate(c[b], c[e], start[b], start[e], half), mean = h[b].d + h[e].d;
      const Real plus = y[b] + y[e], minus = y[b] - y[e];
      shear[a] = mean + plus * plus * rate;
      spin[a] = mean + minus * minus * rate;
    }
  }

 private:
  /// (h'(b) - h'(c))/(b - c). For near b and c it is h''-like times sinh(n x)/sinh(x), with x = ln(b/c)/2 and
  /// n = half - 1, by its series, so that nothing cancels; x is that of the arguments held at `threshold`,
  /// and the continued part of h' is a straight line.
  SINEW_INLINE static Real slopeRate(Continued<Real> const& b, Continued<Real> const& c, Jet<Real> const& hb,
                                     Jet<Real> const& hc, lane_scalar<Real> half) {
    using std::abs, std::sqrt, sinew::abs, sinew::sqrt;
    const Real n(half - 1), x = Real(0.5) * (b.log - c.log), nx = n * x;
    const auto near = both(abs(x) < Real(0.1), abs(nx) < Real(0.1));
    auto series = [](Real y) {  // sinh(y)/y to y^6/7!
      const Real y2 = y * y;
      return Real(1) + y2 / Real(6) * (Real(1) + y2 / Real(20) * (Real(1) + y2 / Real(42)));
    };
    const Real difference = b.ratio - c.ratio;
    // h'' = half n c^(half - 2) has one sign
    const Real mean = sqrt(abs(hb.dd * hc.dd)), sign(half < 1 ? -1 : 1);
    const Real held = select(near,
                             Real(sign * mean * series(nx) / series(x)),
                             Real((hb.d - hc.d) / select(near, Real(1), difference)));
    // of the interval from c to b, the part that is not on the straight line, whose slope is h'' at its start
    const Real span = difference + b.by - c.by;
    const auto apart = abs(span) > Real(0);
    const Real part = select(apart, Real(difference / select(apart, span, Real(1))), Real(1));
    const Real line = select(b.by < Real(0), hb.dd, hc.dd);
    return select(part < Real(1), Real(line + (held - line) * part), held);
  }
};

}  // namespace detail

/// A material of the second kind: at(p, terms, s, threshold) of its singular values.
struct Ogden {
  /// Positive powers of s_a. What a negative one makes of J^(-1/3) s_a is J^(2 alpha/3) (s_b s_c)^(-alpha)
  /// with the singular values s_b s_c of the cofactor matrix: it is continued through s_a = 0 in this form,
  /// in which nothing but J becomes singular.
  template <class Real, class P>
  SINEW_HD static PrincipalResponse<Real> at(P const& p, int terms, Vec<Real, 3> const& s, Real threshold) {
    using Scalar = lane_scalar<Real>;
    using detail::Jet;
    PrincipalResponse<Real> out;
    const detail::Continued<Real> volume(s[0] * s[1] * s[2], threshold);
    const Real low = threshold * threshold * threshold * threshold;
    Jet<Real> u = volume.barrier(Real(0), Real(p[std::size_t(2 * terms)]));  // all that depends on J
    const Real stretches[3]{s[0], s[1], s[2]}, j[3]{s[1] * s[2], s[2] * s[0], s[0] * s[1]};
    for (int a = 0; a < 3; ++a) {
      out.slope[a] = out.shear[a] = out.spin[a] = Real(0);
      for (int b = 0; b < 3; ++b) out.second(a, b) = Real(0);
    }
    for (int i = 0; i < terms; ++i) {
      const Scalar alpha = p[std::size_t(2 * i + 1)];
      const bool negative = alpha < 0;
      const Real m(p[std::size_t(2 * i)] / (alpha * alpha));
      const Jet<Real> q = volume.power(negative ? 2 * alpha / 3 : -alpha / 3);
      const detail::PowerSum<Real> h(negative ? j : stretches, low, (negative ? -alpha : alpha) / 2);
      u.f += m * (q.f * h.sum - Real(3)), u.d += m * q.d * h.sum, u.dd += m * q.dd * h.sum;
      const Real mq = m * q.f, mqd = m * q.d;
      Real slope[3];  // of the sum, by s
      for (int a = 0; a < 3; ++a) {
        const int b = (a + 1) % 3, c = (a + 2) % 3;
        const Real square = s[a] * s[a];
        slope[a] = negative ? Real(h.slope[b] * s[c] + h.slope[c] * s[b]) : h.slope[a];
        out.second(a, a) +=
            mq * (negative ? Real(h.second[b] * s[c] * s[c] + h.second[c] * s[b] * s[b]) : h.second[a]);
        out.shear[a] += mq * (negative ? Real(square * h.shear[a] - h.slope[a]) : h.shear[a]);
        out.spin[a] += mq * (negative ? Real(square * h.spin[a] + h.slope[a]) : h.spin[a]);
        if (!negative) continue;
        const Real across = mq * (h.slope[a] + h.second[a] * j[a]);
        out.second(b, c) += across;
        out.second(c, b) += across;
      }
      for (int a = 0; a < 3; ++a) {
        out.slope[a] += mq * slope[a];
        for (int b = 0; b < 3; ++b) out.second(a, b) += mqd * (slope[a] * j[b] + slope[b] * j[a]);
      }
    }
    out.w = u.f;
    for (int a = 0; a < 3; ++a) {
      out.slope[a] += u.d * j[a];
      out.shear[a] -= u.d * s[a];
      out.spin[a] += u.d * s[a];
      for (int b = 0; b < 3; ++b)
        out.second(a, b) += u.dd * j[a] * j[b] + (a == b ? Real(0) : Real(u.d * s[3 - a - b]));
    }
    return out;
  }
};

/// Moduli of shape and of volume in the rest shape [Pa], of what has no directions: all of a material without
/// directions, what is around the fibres of HolzapfelGasserOgden, and of Costa what its smallest coefficient
/// has in all directions.
struct RestModuli {
  double shear, bulk;
};
RestModuli rest_moduli(HyperelasticMaterial material, std::vector<double> const& p);

/// Throws Error unless the parameters are those of a material that is stable at rest.
void check_hyperelastic(std::string const& where, HyperelasticMaterial material,
                        std::vector<double> const& p);

/// A material with its parameters, for the elements of one law.
template <class Real>
struct Hyperelastic {
  using Scalar = lane_scalar<Real>;
  HyperelasticMaterial material = HyperelasticMaterial::ArrudaBoyce;
  std::array<Scalar, 8> p{};
  int terms = 1;  // of Ogden
  std::array<Scalar, 6>
      along{};       // HolzapfelGasserOgden's: unit vectors of the fibres, in axes of the element
  int families = 0;  // of fibres
  Scalar threshold = Scalar(0.3);

  SINEW_HD bool byStretches() const { return material == HyperelasticMaterial::Ogden; }
  SINEW_HD bool byDirections() const { return has_directions(material); }

  /// How many terms the energy of a material with directions has.
  SINEW_HD int directed() const { return material == HyperelasticMaterial::Costa ? 1 : 1 + families; }
  /// The mth measure K of the strain C = F'F that they depend on.
  SINEW_HD DirectedStrain<Real> strain(int m, Mat<Real, 3> const& c) const {
    if (material == HyperelasticMaterial::Costa) return Costa::strain(p, c);
    return HolzapfelGasserOgden::strain(p, along, m, c);
  }
  /// Their energy of it and of J, the first with what depends on J alone.
  SINEW_HD detail::InvariantResponse<Real> byDirection(int m, Real k, Real j) const {
    if (material == HyperelasticMaterial::Costa) return Costa::at(p, k, j, Real(threshold));
    return HolzapfelGasserOgden::at(p, m, k, j, Real(threshold));
  }

  /// Not for those by stretches or directions.
  SINEW_HD detail::InvariantResponse<Real> byInvariants(Real i1, Real i2, Real j) const {
    const Real low(threshold);
    switch (material) {
      case HyperelasticMaterial::StVenantKirchhoff:
        return StVenantKirchhoff::at(p, i1, i2, j, low);
      case HyperelasticMaterial::NeoHookean:
        return NeoHookean::at(p, i1, i2, j, low);
      case HyperelasticMaterial::MooneyRivlin:
        return MooneyRivlin::at(p, i1, i2, j, low);
      case HyperelasticMaterial::StableNeoHookean:
        return StableNeoHookean::at(p, i1, i2, j, low);
      case HyperelasticMaterial::VerondaWestman:
        return VerondaWestman::at(p, i1, i2, j, low);
      default:
        return ArrudaBoyce::at(p, i1, i2, j, low);
    }
  }
  SINEW_HD PrincipalResponse<Real> at(Vec<Real, 3> const& s) const {
    if (byStretches()) return Ogden::at(p, terms, s, Real(threshold));
    const Real a = s[0] * s[0], b = s[1] * s[1], c = s[2] * s[2], i1 = a + b + c;
    return principal(byInvariants(i1, a * b + b * c + c * a, s[0] * s[1] * s[2]), s, i1);
  }
};

}  // namespace sinew

#if SINEW_DEFINES
#include <sinew/core/error.hpp>

#include <algorithm>

namespace sinew {

SINEW_ONCE RestModuli rest_moduli(HyperelasticMaterial material, std::vector<double> const& p) {
  switch (material) {
    case HyperelasticMaterial::ArrudaBoyce: {
      double slope = 0;
      for (int n = 5; n > 0; --n) slope = 3 * slope + n * ArrudaBoyce::series()[std::size_t(n - 1)];
      return {2 * p[0] * slope, p[1]};
    }
    case HyperelasticMaterial::MooneyRivlin:
      return {2 * (p[0] + p[1]), p[2]};
    case HyperelasticMaterial::VerondaWestman:
      return {p[0] * p[1], p[2]};
    case HyperelasticMaterial::Costa: {
      // d2W/dE2 = a diag(b) + k0 of the trace: with one b for all, a b = 2 G and a b + 3 k0 = 3 K
      const double least = p[0] * *std::min_element(p.begin() + 2, p.end());
      return {least / 2, p[1] + least / 3};
    }
    case HyperelasticMaterial::HolzapfelGasserOgden:
      return {p[0], p[1]};
    case HyperelasticMaterial::Ogden: {
      double shear = 0;
      for (std::size_t i = 0; i + 1 < p.size(); i += 2) shear += p[i] / 2;
      return {shear, p.back()};
    }
    default:
      return {p[0], p[1] + 2 * p[0] / 3};
  }
}

SINEW_ONCE void check_hyperelastic(std::string const& where, HyperelasticMaterial material,
                                   std::vector<double> const& p) {
  const std::string_view name = enum_names(material)[std::size_t(material)];
  if (!takes_parameters(material, p.size()))
    throw Error(
        where,
        text("ParameterSet has ", p.size(), " values, but ", name, " takes ", parameter_names(material)));
  if (material == HyperelasticMaterial::Ogden)
    for (std::size_t i = 1; i < p.size(); i += 2)
      if (p[i] == 0)
        throw Error(
            where, text("ParameterSet[", i, "] is 0, but an exponent alpha of Ogden must be another number"));
  auto mustBePositive = [&](std::size_t i, std::string_view parameter) {
    if (!(p[i] > 0))
      throw Error(where,
                  text("ParameterSet[",
                       i,
                       "] is ",
                       p[i],
                       ", but ",
                       parameter,
                       " of ",
                       name,
                       " must be greater than 0"));
  };
  if (material == HyperelasticMaterial::VerondaWestman) mustBePositive(0, "c1"), mustBePositive(1, "c2");
  if (material == HyperelasticMaterial::Costa) {
    constexpr std::array<std::string_view, 8> parameters{"a", "k0", "bff", "bfs", "bss", "bfn", "bsn", "bnn"};
    for (std::size_t i = 0; i < p.size(); ++i) mustBePositive(i, parameters[i]);
  }
  if (material == HyperelasticMaterial::HolzapfelGasserOgden) {
    mustBePositive(3, "k2");
    if (!(p[2] >= 0))
      throw Error(where, text("ParameterSet[2] is ", p[2], ", but k1 of ", name, " must not be less than 0"));
    if (!(p[4] >= 0 && p[4] <= 1. / 3))
      throw Error(where,
                  text("ParameterSet[4] is ",
                       p[4],
                       ", but kappa of ",
                       name,
                       " must be from 0, all fibres in one direction, to 1/3, as many in all directions"));
  }
  const auto [shear, bulk] = rest_moduli(material, p);
  if (!(shear > 0) || !(bulk > 0))
    throw Error(where,
                text("ParameterSet makes a material with a shear modulus of ",
                     shear,
                     " Pa and a bulk modulus of ",
                     bulk,
                     " Pa at rest, but both must be greater than 0; give ",
                     name,
                     " other values of ",
                     parameter_names(material)));
}

}  // namespace sinew
#endif
