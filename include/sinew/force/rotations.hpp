// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/core/data_types.hpp>

#include <limits>

namespace sinew {

// Rotations of corotational elements from their deformation, for scalars and lanes.

template <class Real>
SINEW_INLINE Vec<Real, 3> cross3(Vec<Real, 3> const& a, Vec<Real, 3> const& b) {
  return Vec<Real, 3>(a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]);
}
template <class Real>
SINEW_INLINE Real dot3(Vec<Real, 3> const& a, Vec<Real, 3> const& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

/// R S R'
template <class Real>
SINEW_INLINE Mat<Real, 3> rotated(Mat<Real, 3> const& r, Mat<Real, 3> const& s) {
  return r * (s * r.transpose());
}
/// y_i = R'(x_i - x_0)
template <class Real, std::size_t N>
SINEW_INLINE void rotate_back(Mat<Real, 3> const& r, Vec<Real, 3> const (&x)[N], Vec<Real, 3> (&y)[N]) {
  for (std::size_t i = 0; i < N; ++i) y[i] = r.transpose() * (x[i] - x[0]);
}

/// Right-handed frame: first axis along a, third normal to a and b.
template <class Real>
SINEW_INLINE Mat<Real, 3> frame_of(Vec<Real, 3> const& a, Vec<Real, 3> const& b) {
  using std::sqrt, sinew::sqrt;
  const Real tiny(std::numeric_limits<lane_scalar<Real>>::min());
  const Vec<Real, 3> n = cross3(a, b);
  const Real ia = Real(1) / sqrt(dot3(a, a) + tiny), in = Real(1) / sqrt(dot3(n, n) + tiny);
  const Vec<Real, 3> x = a * ia, z = n * in;
  Mat<Real, 3> frame;
  frame.col(0) = x;
  frame.col(1) = cross3(z, x);
  frame.col(2) = z;
  return frame;
}

/// The rotation nearest to f, argmax over rotations of tr(R' f), of inverted elements too. Newton's steps
/// w = (tr(M) I - M)^-1 a, M = sym(f R'), a = sum r_i x f_i, from the frame of two columns; where M is far
/// from definite, the safe step a / |tr M| of Mueller et al. 2016.
template <class Real>
SINEW_HD Mat<Real, 3> nearest_rotation(Mat<Real, 3> const& f) {
  using std::abs, sinew::abs;
  using Vec3 = Vec<Real, 3>;
  using Scalar = lane_scalar<Real>;
  Mat<Real, 3> r = frame_of(Vec3(f.col(0)), Vec3(f.col(1)));
  Real scale(std::numeric_limits<Scalar>::min());
  for (int i = 0; i < 9; ++i) scale += Real(1e-9) * f(i) * f(i);
  const Scalar epsilon = 16 * std::numeric_limits<Scalar>::epsilon();
  for (int iteration = 0; iteration < 40; ++iteration) {
    Vec3 a(Real(0), Real(0), Real(0));
    for (int c = 0; c < 3; ++c) a += cross3(Vec3(r.col(c)), Vec3(f.col(c)));
    const Mat<Real, 3> m = f * r.transpose();
    // adjugate of tr(M) I - M
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
    const Real safe = Real(1) / (abs(trace) + scale);
    Vec3 w;
    w[0] = select(definite, dot3(c0, a) * inverse, a[0] * safe);
    w[1] = select(definite, dot3(c1, a) * inverse, a[1] * safe);
    w[2] = select(definite, dot3(c2, a) * inverse, a[2] * safe);
    // Cayley's rotation by w: an exact rotation, its angle |w| to second order
    const Vec3 q = Real(0.5) * w;
    const Real n = Real(2) / (Real(1) + dot3(q, q));
    for (int c = 0; c < 3; ++c) {
      const Vec3 v = r.col(c), t = cross3(q, v) + v, change = cross3(q, t);
      for (int i = 0; i < 3; ++i) r(i, c) = v[i] + n * change[i];
    }
    if (!any(dot3(w, w) > Real(epsilon * epsilon))) break;
  }
  return r;
}

}  // namespace sinew
