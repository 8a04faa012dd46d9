// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/core/data_types.hpp>
#include <sinew/force/rotations.hpp>

#include <limits>

namespace sinew {

// Decompositions of 3 x 3 matrices, for scalars and lanes.

namespace detail {

/// Puts the larger of values a and b first; the columns stay a rotation.
template <class Real>
SINEW_INLINE void order_pair(Vec<Real, 3>& values, Mat<Real, 3>& vectors, int a, int b) {
  const Real first = values[a], second = values[b];
  const auto swap = first < second;
  values[a] = select(swap, second, first);
  values[b] = select(swap, first, second);
  for (int i = 0; i < 3; ++i) {
    const Real u = vectors(i, a), w = vectors(i, b);
    vectors(i, a) = select(swap, w, u);
    vectors(i, b) = select(swap, Real(-u), w);
  }
}

}  // namespace detail

/// A = V diag(values) V' of a symmetric A, largest value first, V a rotation: Jacobi's method (Golub, Van
/// Loan 2013, 8.5). Errors are of the order of rounding times the largest |value|.
template <class Real>
SINEW_HD void symmetric_eigen(Mat<Real, 3> a, Vec<Real, 3>& values, Mat<Real, 3>& vectors) {
  using std::abs, std::sqrt, sinew::abs, sinew::sqrt;
  using Scalar = lane_scalar<Real>;
  const Real tiny(std::numeric_limits<Scalar>::min());
  for (int i = 0; i < 9; ++i) vectors(i) = Real(i % 4 == 0 ? 1 : 0);
  for (int sweep = 0; sweep < 10; ++sweep) {
    const Real off = abs(a(0, 1)) + abs(a(0, 2)) + abs(a(1, 2));
    const Real all = abs(a(0, 0)) + abs(a(1, 1)) + abs(a(2, 2));
    if (!any(off > Real(std::numeric_limits<Scalar>::epsilon() / 8) * all + tiny)) break;
    for (int r = 2; r >= 0; --r) {  // rotates p and q; r is the third
      const int p = r == 0 ? 1 : 0, q = r == 2 ? 1 : 2;
      const Real apq = a(p, q), d = a(q, q) - a(p, p), root = sqrt(d * d + Real(4) * apq * apq) + tiny;
      const Real t = Real(2) * apq / (d + select(d < Real(0), Real(-root), root));
      const Real c = Real(1) / sqrt(Real(1) + t * t), s = t * c;
      a(p, p) -= t * apq;
      a(q, q) += t * apq;
      a(p, q) = a(q, p) = Real(0);
      const Real arp = a(r, p), arq = a(r, q);
      a(r, p) = a(p, r) = c * arp - s * arq;
      a(r, q) = a(q, r) = s * arp + c * arq;
      for (int i = 0; i < 3; ++i) {
        const Real vp = vectors(i, p), vq = vectors(i, q);
        vectors(i, p) = c * vp - s * vq;
        vectors(i, q) = s * vp + c * vq;
      }
    }
  }
  for (int i = 0; i < 3; ++i) values[i] = a(i, i);
  detail::order_pair(values, vectors, 0, 1);
  detail::order_pair(values, vectors, 1, 2);
  detail::order_pair(values, vectors, 0, 1);
}

/// F = U diag(sigma) V' with rotations U and V: sigma_0 >= sigma_1 >= |sigma_2|, and sigma_2 has the sign of
/// det F (Irving, Teran, Fedkiw 2004). Defined for every F; errors are of the order of rounding times
/// sigma_0, and of its root where sigma_1 is that small too.
template <class Real>
struct SingularValues {
  Mat<Real, 3> u, v;
  Vec<Real, 3> sigma;
};
template <class Real>
SINEW_HD SingularValues<Real> singular_values(Mat<Real, 3> const& f) {
  using std::abs, std::sqrt, sinew::abs, sinew::sqrt;
  using Scalar = lane_scalar<Real>;
  using Vec3 = Vec<Real, 3>;
  const Real tiny(std::numeric_limits<Scalar>::min()), zero(0), one(1);
  const Real rounding(Scalar(16) * std::numeric_limits<Scalar>::epsilon());
  SingularValues<Real> out;
  Mat<Real, 3> c;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j <= i; ++j) c(i, j) = c(j, i) = dot3(Vec3(f.col(i)), Vec3(f.col(j)));
  symmetric_eigen(c, out.sigma, out.v);
  Vec3 b[3];
  for (int k = 0; k < 3; ++k)
    for (int i = 0; i < 3; ++i)
      b[k][i] = f(i, 0) * out.v(0, k) + f(i, 1) * out.v(1, k) + f(i, 2) * out.v(2, k);

  // where F flattens all to a line or to a point, any axes across will do
  Real length = sqrt(dot3(b[0], b[0]));
  const auto point = !(length > tiny);
  out.sigma[0] = length;
  length = one / select(point, one, length);
  const Vec3 u0(select(point, one, b[0][0] * length), b[0][1] * length, b[0][2] * length);
  Vec3 across = b[1] - u0 * dot3(u0, b[1]);
  const Real width = sqrt(dot3(across, across));
  const auto line = !(width > rounding * out.sigma[0] + tiny);
  const auto upright = abs(u0[0]) < Real(0.6);
  const Vec3 side = cross3(u0, Vec3(select(upright, one, zero), select(upright, zero, one), zero));
  for (int i = 0; i < 3; ++i) across[i] = select(line, side[i], across[i]);
  const Vec3 u1 = across * (one / sqrt(dot3(across, across))), u2 = cross3(u0, u1);
  out.sigma[1] = dot3(u1, b[1]);
  out.sigma[2] = dot3(u2, b[2]);
  out.u.col(0) = u0;
  out.u.col(1) = u1;
  out.u.col(2) = u2;
  return out;
}

}  // namespace sinew
