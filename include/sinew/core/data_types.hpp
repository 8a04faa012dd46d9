// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/core/lanes.hpp>
#include <sinew/core/platform.hpp>
#include <sinew/core/small_matrix.hpp>

#include <Eigen/Geometry>
#include <string_view>
#include <vector>

namespace sinew {

template <class Real, int N>
using Vec = Eigen::Matrix<Real, N, 1>;
template <class Real, int R, int C = R>
using Mat = Eigen::Matrix<Real, R, C>;
/// Not over-aligned, so that a rigid position is seven scalars without a gap.
template <class Real>
using Quat = Eigen::Quaternion<Real, Eigen::DontAlign>;

/// Position of a rigid body: centre [m] and unit quaternion from body to world axes. In the plane the
/// quaternion is replaced by the angle [rad].
template <class Real>
struct RigidCoord3 {
  Vec<Real, 3> center{Real(0), Real(0), Real(0)};
  Quat<Real> orientation{Real(1), Real(0), Real(0), Real(0)};
  bool operator==(RigidCoord3 const& o) const {
    return center == o.center && orientation.coeffs() == o.orientation.coeffs();
  }
};
template <class Real>
struct RigidCoord2 {
  Vec<Real, 2> center{Real(0), Real(0)};
  Real orientation{0};
  bool operator==(RigidCoord2 const&) const = default;
};

/// Mass of a rigid body: mass [kg], and inertia about the centre in body axes [kg m^2] (a scalar in the
/// plane).
template <class Real, int Dim>
struct RigidMass {
  using Inertia = Mat<Real, Dim == 3 ? 3 : 1>;
  Real mass{1};
  Inertia inertia = Inertia::Identity();
};

/// Points of N coordinates: position and velocity are N-vectors.
template <int N, class R>
struct VecTypes {
  using Real = R;
  using Coord = Vec<R, N>;
  using Deriv = Vec<R, N>;
  template <class T>
  using Array = std::vector<T>;  // of data over which loops run
  using VecCoord = Array<Coord>;
  using VecDeriv = Array<Deriv>;
  using MassType = R;
  static constexpr int spatial = N < 3 ? N : 3;  // coordinates of `Coord` that are a place
  static constexpr int size = N;                 // degrees of freedom of a point
  static constexpr bool rigid = false;
  template <class S>
  using rebind = VecTypes<N, S>;

  SINEW_INLINE static Coord zero() { return Coord::Zero(); }
  SINEW_INLINE static Vec<R, spatial> center(Coord const& x) { return x.template head<spatial>(); }
  SINEW_INLINE static void setCenter(Coord& x, Vec<R, spatial> const& c) { x.template head<spatial>() = c; }
  SINEW_INLINE static void increment(Coord& x, Deriv const& dx) { x += dx; }
  /// dx with increment(from, dx) = to.
  SINEW_INLINE static Deriv difference(Coord const& from, Coord const& to) { return to - from; }
  /// Time derivative of theta, where x = increment(x0, theta) moves with velocity v.
  SINEW_INLINE static Deriv chart_rate(Deriv const& /*theta*/, Deriv const& v) { return v; }
  static bool finite(Coord const& x) { return all_finite(x); }
};

/// Rigid bodies in space: Deriv is (linear velocity, angular velocity), both in world axes.
template <int Dim, class R>
struct RigidTypes;

template <class R>
struct RigidTypes<3, R> {
  using Real = R;
  using Coord = RigidCoord3<R>;
  using Deriv = Vec<R, 6>;
  template <class T>
  using Array = std::vector<T>;  // of data over which loops run
  using VecCoord = Array<Coord>;
  using VecDeriv = Array<Deriv>;
  using MassType = RigidMass<R, 3>;
  static constexpr int spatial = 3, size = 6;
  static constexpr bool rigid = true;
  template <class S>
  using rebind = RigidTypes<3, S>;

  SINEW_HD static Coord zero() { return {}; }
  SINEW_INLINE static Vec<R, 3> center(Coord const& x) { return x.center; }
  SINEW_INLINE static void setCenter(Coord& x, Vec<R, 3> const& c) { x.center = c; }
  /// q <- exp(w) q, with the rotation vector w in world axes; the unit length is restored.
  SINEW_HD static void increment(Coord& x, Deriv const& dx) {
    using std::sqrt, std::cos, std::sin;
    x.center += dx.template head<3>();
    const Vec<R, 3> w = dx.template tail<3>();
    const R angle2 = w.squaredNorm(), half = sqrt(angle2) / 2;
    const R s = half < R(1e-4) ? R(0.5) * (1 - half * half / 6) : R(0.5) * sin(half) / half;
    Quat<R> rotation;
    rotation.w() = cos(half);
    rotation.vec() = s * w;
    x.orientation = (rotation * x.orientation).normalized();
  }
  SINEW_HD static Deriv difference(Coord const& from, Coord const& to) {
    Deriv d;
    d.template head<3>() = to.center - from.center;
    Quat<R> rotation = to.orientation * from.orientation.conjugate();
    if (rotation.w() < 0) rotation.coeffs() = -rotation.coeffs();
    const R sine = rotation.vec().norm();
    const R scale = sine < R(1e-6) ? R(2) : 2 * std::atan2(sine, rotation.w()) / sine;
    d.template tail<3>() = scale * rotation.vec();
    return d;
  }
  /// dexp^-1 of the rotation group to third order, what a fourth-order method needs (Munthe-Kaas 1999).
  SINEW_HD static Deriv chart_rate(Deriv const& theta, Deriv const& v) {
    Deriv rate = v;
    const Vec<R, 3> t = theta.template tail<3>(), w = v.template tail<3>(), tw = t.cross(w);
    rate.template tail<3>() += R(-0.5) * tw + R(1) / 12 * t.cross(tw);
    return rate;
  }
  static bool finite(Coord const& x) { return all_finite(x.center) && all_finite(x.orientation.coeffs()); }
};

template <class R>
struct RigidTypes<2, R> {
  using Real = R;
  using Coord = RigidCoord2<R>;
  using Deriv = Vec<R, 3>;
  template <class T>
  using Array = std::vector<T>;  // of data over which loops run
  using VecCoord = Array<Coord>;
  using VecDeriv = Array<Deriv>;
  using MassType = RigidMass<R, 2>;
  static constexpr int spatial = 2, size = 3;
  static constexpr bool rigid = true;
  template <class S>
  using rebind = RigidTypes<2, S>;

  SINEW_HD static Coord zero() { return {}; }
  SINEW_INLINE static Vec<R, 2> center(Coord const& x) { return x.center; }
  SINEW_INLINE static void setCenter(Coord& x, Vec<R, 2> const& c) { x.center = c; }
  SINEW_HD static void increment(Coord& x, Deriv const& dx) {
    x.center += dx.template head<2>();
    x.orientation += dx[2];
  }
  SINEW_HD static Deriv difference(Coord const& from, Coord const& to) {
    return Deriv(
        to.center[0] - from.center[0], to.center[1] - from.center[1], to.orientation - from.orientation);
  }
  SINEW_HD static Deriv chart_rate(Deriv const&, Deriv const& v) { return v; }
  static bool finite(Coord const& x) { return all_finite(x.center) && std::isfinite(x.orientation); }
};

/// D, whose element laws run on W elements at a time: WithLanes<Vec3d, 1> takes them one by one. W is a power
/// of two, at most native_width<Real>. All that one node holds is over the same DataTypes; mappings join it
/// to others.
template <class D, int W>
struct WithLanes : D {
  static_assert(!D::rigid && W >= 1 && (W & (W - 1)) == 0 && W <= native_width<typename D::Real>,
                "Sinew: lanes are for points, and their number is a power of two, at most native_width.");
  static constexpr int lanes = W;
};

/// How many elements a law over D takes at a time: as many as fill a register, unless D says otherwise. Rigid
/// bodies are taken one by one: their positions do not interleave, and rotations take trigonometry.
template <class D>
constexpr int lane_width() {
  if constexpr (requires { D::lanes; })
    return D::lanes;
  else
    return D::rigid ? 1 : native_width<typename D::Real>;
}

/// How many elements of `Law` over D a driver takes at a time. A law whose arithmetic is little beside
/// fetching points and bringing back forces says `static constexpr bool oneByOne = true`: lanes cost it more
/// than they gain.
template <template <class> class LawOf, class D>
constexpr int element_lanes() {
  if constexpr (
      !requires { D::lanes; } && requires { LawOf<D>::oneByOne; })
    return 1;
  else
    return lane_width<D>();
}

using Vec1d = VecTypes<1, double>;
using Vec2d = VecTypes<2, double>;
using Vec3d = VecTypes<3, double>;
using Vec6d = VecTypes<6, double>;
using Rigid2d = RigidTypes<2, double>;
using Rigid3d = RigidTypes<3, double>;
using Vec1f = VecTypes<1, float>;
using Vec2f = VecTypes<2, float>;
using Vec3f = VecTypes<3, float>;
using Vec6f = VecTypes<6, float>;
using Rigid2f = RigidTypes<2, float>;
using Rigid3f = RigidTypes<3, float>;

/// "Vec3d", "Rigid3f", "Vec3dx1"...: the name by which messages and scene files know a DataTypes.
template <class D>
struct data_types_name;
template <int N, class R>
struct data_types_name<VecTypes<N, R>> {
  static constexpr char text[] = {'V', 'e', 'c', char('0' + N), sizeof(R) == 8 ? 'd' : 'f', 0};
  static constexpr std::string_view value{text, 5};
};
template <int N, class R>
struct data_types_name<RigidTypes<N, R>> {
  static constexpr char text[] = {'R', 'i', 'g', 'i', 'd', char('0' + N), sizeof(R) == 8 ? 'd' : 'f', 0};
  static constexpr std::string_view value{text, 7};
};
template <class D, int W>
struct data_types_name<WithLanes<D, W>> {
  static_assert(W < 100);
  static constexpr auto base = data_types_name<D>::value;
  static constexpr char text[] = {base[0],
                                  base[1],
                                  base[2],
                                  base[3],
                                  base[4],
                                  'x',
                                  W > 9 ? char('0' + W / 10) : char('0' + W),
                                  W > 9 ? char('0' + W % 10) : char(0),
                                  0};
  static constexpr std::string_view value{text, W > 9 ? 8 : 7};
};

}  // namespace sinew
