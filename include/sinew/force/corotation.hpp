// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/core/dual.hpp>
#include <sinew/force/rotations.hpp>

#include <cmath>

namespace sinew {

// What corotational elements between frames share: rotations as unit quaternions over scalars, lanes and dual
// numbers, and the rotation vectors that are their deformation. What is long is not inlined: compilers would
// do so in each of many places.

/// Rotation by a unit quaternion w + v.
template <class S>
struct UnitQuaternion {
  S w;
  Vec<S, 3> v;

  SINEW_INLINE friend UnitQuaternion operator*(UnitQuaternion const& a, UnitQuaternion const& b) {
    return {a.w * b.w - dot3(a.v, b.v), Vec<S, 3>(a.w * b.v + b.w * a.v + cross3(a.v, b.v))};
  }
  SINEW_INLINE UnitQuaternion inverse() const { return {w, Vec<S, 3>(-v)}; }
  SINEW_INLINE Vec<S, 3> operator()(Vec<S, 3> const& a) const {
    const Vec<S, 3> c = S(2) * cross3(v, a);
    return a + w * c + cross3(v, c);
  }
};

template <class S, class Real>
SINEW_INLINE UnitQuaternion<S> unit_quaternion(Real const (&q)[4]) {
  return {S(q[0]), Vec<S, 3>(S(q[1]), S(q[2]), S(q[3]))};
}
template <class Real>
SINEW_INLINE void store(Eigen::Quaterniond const& from, Real (&q)[4]) {
  q[0] = Real(from.w()), q[1] = Real(from.x()), q[2] = Real(from.y()), q[3] = Real(from.z());
}

/// Angle over sine of a half turn with w >= 0: 2 atan2(s, w) / s, s2 = s^2 = 1 - w^2.
template <class T>
requires std::is_floating_point_v<T>
SINEW_INLINE T arc_ratio(T s2, T w) {
  if (s2 < T(1e-3)) return 2 + s2 * (T(1) / 3 + s2 * (T(3) / 20 + s2 * (T(5) / 56 + s2 * (T(35) / 576))));
  const T s = std::sqrt(s2);
  return 2 * std::atan2(s, w) / s;
}
#if !defined(__CUDACC__)
template <class T, int W>
SINEW_INLINE Lanes<T, W> arc_ratio(Lanes<T, W> s2, Lanes<T, W> w) {
  Lanes<T, W> r;
  for (int l = 0; l < W; ++l) r.set(l, arc_ratio(s2[l], w[l]));
  return r;
}
#endif
template <class T, int N>
SINEW_INLINE Dual<T, N> arc_ratio(Dual<T, N> const& s2, Dual<T, N> const& w) {
  const T ratio = arc_ratio(s2.value, w.value);
  const auto small = s2.value < T(1e-3);
  const T x = s2.value, near = T(-2.0 / 3) - x * (T(1.0 / 5) + x * (T(3.0 / 28) + x * T(5.0 / 72)));
  const T slope = select(small, near, (w.value - T(0.5) * ratio) / select(small, T(1), x));
  Dual<T, N> r = s2.through(ratio, slope);
  for (int i = 0; i < N; ++i) r.slope[i] += T(-2) * w.slope[i];
  return r;
}

/// The rotation vector t of the rotation between an element and its node, in the axes of the element, and how
/// it changes with the spin of the node against them: dt = H w, H = I - [t]x/2 + s [t]x^2,
/// s = (1 - |t|/2 cot(|t|/2)) / |t|^2.
template <class S>
struct LocalRotation {
  UnitQuaternion<S> orientation;
  Vec<S, 3> vector;
  S s;

  LocalRotation() = default;
  /// Of rotations by less than 180 degrees.
  SINEW_HD explicit LocalRotation(UnitQuaternion<S> const& of) : orientation(of) {
    using T = std::decay_t<decltype(value_of(of.w))>;
    const auto flip = value_of(of.w) < T(0);
    orientation.w = select(flip, S(-orientation.w), orientation.w);
    for (int c = 0; c < 3; ++c) orientation.v[c] = select(flip, S(-orientation.v[c]), orientation.v[c]);
    const S sine2 = dot3(orientation.v, orientation.v), ratio = arc_ratio(sine2, orientation.w);
    vector = ratio * orientation.v;
    const S square = ratio * ratio * sine2;
    const auto small = value_of(sine2) < T(0.01);
    const S near =
        S(1.0 / 12) +
        square * (S(1.0 / 720) +
                  square * (S(1.0 / 30240) + square * (S(1.0 / 1209600) + square * S(1.0 / 47900160))));
    s = select(small, near, (S(1) - S(0.5) * ratio * orientation.w) / select(small, S(1), square));
  }
  /// H' m: the torque of which m is the part in the directions of the rotation vector.
  SINEW_INLINE Vec<S, 3> torque(Vec<S, 3> const& m) const {
    const Vec<S, 3> c = cross3(vector, m);
    return m + S(0.5) * c + s * cross3(vector, c);
  }
};

/// N frames as an element sees them: orientations, and places from that of the first.
template <class S, int N>
struct Frames {
  UnitQuaternion<S> orientation[std::size_t(N)];
  Vec<S, 3> place[std::size_t(N)];
};

/// What the tangent of an element of N frames is found from.
template <class Real, int N>
struct FrameState {
  Real orientation[std::size_t(N)][4], place[std::size_t(N)][3];

  template <class Coord>
  SINEW_INLINE void take(Coord const (&x)[std::size_t(N)]) {
    for (int i = 0; i < N; ++i) {
      auto const& q = x[i].orientation;
      orientation[i][0] = q.w(), orientation[i][1] = q.x(), orientation[i][2] = q.y(),
      orientation[i][3] = q.z();
      for (int c = 0; c < 3; ++c) place[i][c] = x[i].center[c] - x[0].center[c];
    }
  }
  template <class S>
  SINEW_INLINE Frames<S, N> frames() const {
    Frames<S, N> f;
    for (int i = 0; i < N; ++i) {
      f.orientation[i] = unit_quaternion<S>(orientation[i]);
      f.place[i] = Vec<S, 3>(S(place[i][0]), S(place[i][1]), S(place[i][2]));
    }
    return f;
  }
};

/// Forces and torques about the centres of N frames.
template <class S, int N>
struct FrameForces {
  Vec<S, 3> force[std::size_t(N)], torque[std::size_t(N)];
};

/// Slope number `slope` of frame i when it moves by dx: q' = w q / 2. Places count from the first.
template <class T, int M, int N, class Deriv>
SINEW_INLINE void seed(Frames<Dual<T, M>, N>& frames, int i, Deriv const& dx, int slope) {
  auto& [w, v] = frames.orientation[i];
  const T h(0.5), qw = w.value, x = v[0].value, y = v[1].value, z = v[2].value;
  w.slope[slope] = -h * (dx[3] * x + dx[4] * y + dx[5] * z);
  v[0].slope[slope] = h * (dx[3] * qw + dx[4] * z - dx[5] * y);
  v[1].slope[slope] = h * (dx[4] * qw + dx[5] * x - dx[3] * z);
  v[2].slope[slope] = h * (dx[5] * qw + dx[3] * y - dx[4] * x);
  for (int c = 0; c < 3; ++c) {
    if (i > 0) frames.place[i][c].slope[slope] += dx[c];
    for (int j = 1; j < N && i == 0; ++j) frames.place[j][c].slope[slope] -= dx[c];
  }
}

// The derivative of torques t = -dE/dw after rotations by w is not symmetric: it exceeds its symmetric part
// by -t x w / 2, as rotations do not commute. What forces that derive from an energy need is that part.

/// df = k K dx of an element whose forces<S>(frames) are exact for dual numbers too.
template <int N, class Real, class Deriv, class Forces>
SINEW_HD void frame_dforce(FrameState<Real, N> const& state, Deriv const (&dx)[std::size_t(N)],
                           Deriv (&df)[std::size_t(N)], Real k, Forces const& forces) {
  using S = Dual<Real, 1>;
  Frames<S, N> frames = state.template frames<S>();
  for (int i = 0; i < N; ++i) seed(frames, i, dx[i], 0);
  const FrameForces<S, N> f = forces(frames);
  for (int i = 0; i < N; ++i) {
    auto const& t = f.torque[i];
    const Vec<Real, 3> torque(t[0].value, t[1].value, t[2].value), w(dx[i][3], dx[i][4], dx[i][5]);
    const Vec<Real, 3> half = Real(0.5) * cross3(torque, w);
    for (int c = 0; c < 3; ++c) {
      df[i][c] = k * f.force[i][c].slope[0];
      df[i][c + 3] = k * (t[c].slope[0] + half[c]);
    }
  }
}

/// Block (i, j) of k K, two columns at a time: more slopes do not fit into registers.
template <int N, class Real, class Forces>
SINEW_HD Mat<Real, 6> frame_block(FrameState<Real, N> const& state, int i, int j, Real k,
                                  Forces const& forces) {
  constexpr int together = 2;
  using S = Dual<Real, together>;
  Mat<Real, 6> block;
  Vec<Real, 3> torque;
  for (int first = 0; first < 6; first += together) {
    Frames<S, N> frames = state.template frames<S>();
    for (int c = 0; c < together; ++c) {
      Vec<Real, 6> unit;
      for (int r = 0; r < 6; ++r) unit[r] = Real(r == first + c ? 1 : 0);
      seed(frames, j, unit, c);
    }
    const FrameForces<S, N> f = forces(frames);
    for (int c = 0; c < together; ++c)
      for (int r = 0; r < 3; ++r) {
        block(r, first + c) = k * f.force[i][r].slope[c];
        block(r + 3, first + c) = k * f.torque[i][r].slope[c];
      }
    if (i == j && first == 0)
      for (int r = 0; r < 3; ++r) torque[r] = f.torque[i][r].value;
  }
  for (int r = 0; r < 3 && i == j; ++r) {
    const Real half = Real(0.5) * k * torque[r];
    const int a = (r + 1) % 3, b = (r + 2) % 3;
    block(a + 3, b + 3) -= half;
    block(b + 3, a + 3) += half;
  }
  return block;
}

}  // namespace sinew
