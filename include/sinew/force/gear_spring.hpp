// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/core/component.hpp>
#include <sinew/core/element_driver.hpp>
#include <sinew/core/ends.hpp>
#include <sinew/force/corotation.hpp>
#include <sinew/force/spring_ends.hpp>

#include <array>
#include <cmath>
#include <numbers>
#include <string_view>
#include <vector>

namespace sinew {

/// A pair of gears of a GearSpringForceField, in words as SOFA has them: BEGIN_SPRING 4 0 6 2 AXIS 1 1 KS_T
/// 2000000 KS_R 2000000 2000000 KD 1 RATIO 2 END_SPRING.
struct GearSpring {
  static constexpr std::array<std::string_view, 2> bracket{"BEGIN_SPRING", "END_SPRING"};
  static constexpr int unnamed = 4;  // values that stand without their names

  int firstParent = 0, first = 0, secondParent = 0, second = 0;
  std::array<int, 2> freeAxis{0, 0};
  double stiffnessTranslation = 10000;
  std::array<double, 2> stiffnessRotation{10000, 10000};
  double damping = 10000, ratio = 1;

  static constexpr auto fields() {
    using G = GearSpring;
    constexpr Range r = range::nonNegative;
    return field_list(
        field("firstParent",
              &G::firstParent,
              "",
              "body that bears the first gear; the gear itself: the world",
              r)
            .numbersOf(Of::points),
        field("first", &G::first, "", "first gear", r).numbersOf(Of::points),
        field("secondParent", &G::secondParent, "", "body that bears the second gear", r)
            .numbersOf(Of::secondPoints),
        field("second", &G::second, "", "second gear", r).numbersOf(Of::secondPoints),
        field("freeAxis",
              &G::freeAxis,
              "",
              "axis about which each gear turns in its bearing: 0, 1 or 2 for x, y or z",
              Range{0, 2})
            .also("AXIS"),
        field("stiffnessTranslation",
              &G::stiffnessTranslation,
              "N/m",
              "force of a bearing per offset of its gear",
              r)
            .also("KS_T"),
        field("stiffnessRotation",
              &G::stiffnessRotation,
              "N m/rad",
              "torque on the first gear per angle between the teeth, and of a bearing per tilt",
              r)
            .also("KS_R"),
        field("damping", &G::damping, "N s/m", "force and torque of a bearing per relative velocity", r)
            .also("KD"),
        field(
            "ratio", &G::ratio, "", "angle of the second gear over that of the first, with the opposite sign")
            .also("RATIO"));
  }
};

namespace detail {
template <class T>
requires std::is_floating_point_v<T>
inline T arc_tangent(T y, T x) {
  return std::atan2(y, x);
}
template <class T, int N>
inline Dual<T, N> arc_tangent(Dual<T, N> const& y, Dual<T, N> const& x) {
  const T inverse = T(1) / (x.value * x.value + y.value * y.value);
  Dual<T, N> r(std::atan2(y.value, x.value));
  for (int i = 0; i < N; ++i) r.slope[i] = (x.value * y.slope[i] - y.value * x.slope[i]) * inverse;
  return r;
}
}  // namespace detail

/// Two gears, each in a bearing of a parent. With d the offset of a gear from its parent, phi the angle
/// between their axes a, and theta the angle by which the gear is turned about a, counted on from turn to
/// turn:
///   E = kt/2 (d1^2 + d2^2) + kr/2 (phi1^2 + phi2^2) + kg/(2 |r|) (r theta1 + theta2)^2              [J]
/// theta is 2 atan2(v.a, w) of the relative orientation w + v. For r > 0, torques about the axes are SOFA's,
/// kg (r theta1 + theta2) on the first gear and 1/r of that on the second; they have their reactions on the
/// parents here. The tangent is the symmetric part of the exact derivative. Bodies of an element may be the
/// same.
template <class D>
struct GearSpringLaw {
  using Real = typename D::Real;
  using Coord = typename D::Coord;
  using Deriv = typename D::Deriv;
  using Vec3 = Vec<Real, 3>;
  static constexpr int arity = 4;  // first parent, first, second parent, second
  static constexpr bool usesVelocity = true, oneByOne = true;

  struct Rest {
    Vec3 axis[2];
    Real translation, tilt, gear, ratio, damping;
    Real fixed[2];                         // 1: the parent is the world
    Real center[2][3], orientation[2][4];  // and then the bearing in it
    Real angle[2];                         // theta at the last force
  };
  struct Tangent {
    FrameState<Real, 4> frames;
    Real angle[2];
  };

  Real energy(Rest const& rest, Coord const (&x)[4]) const {
    FrameState<Real, 4> state;
    state.take(x);
    const Turned<Real> turned(rest, state.template frames<Real>());
    Real sum = 0;
    for (int i = 0; i < 2; ++i)
      sum += rest.translation * offset(rest, x, i).squaredNorm() + rest.tilt * turned.tilt2[i];
    return Real(0.5) * (sum + rest.gear / std::abs(rest.ratio) * turned.slip * turned.slip);
  }

  void force(Rest const& rest, Coord const (&x)[4], Deriv const (&v)[4], Deriv (&f)[4],
             Tangent& tangent) const {
    tangent.frames.take(x);
    const auto frames = tangent.frames.template frames<Real>();
    const Turned<Real> turned(rest, frames);
    const FrameForces<Real, 4> torques = turned.torques(rest);
    for (int i = 0; i < 2; ++i) {
      tangent.angle[i] = turned.angle[i];
      const int p = 2 * i, m = p + 1;
      Deriv& on = f[m];
      on.template head<3>() = rest.translation * offset(rest, x, i);
      on.template tail<3>().setZero();
      on += rest.damping * relative(rest, v, i);
      f[p] = (rest.fixed[i] - 1) * on;
      f[m].template tail<3>() += torques.torque[m];
      f[p].template tail<3>() += torques.torque[p];
    }
  }

  void dforce(Rest const& rest, Tangent const& tangent, Deriv const (&dx)[4], Deriv (&df)[4], Real k,
              Real b) const {
    frame_dforce(tangent.frames, dx, df, k, torquesAt(rest));
    for (int i = 0; i < 2; ++i) {
      const int p = 2 * i, m = p + 1;
      const Deriv d = relative(rest, dx, i);
      Deriv on = b * rest.damping * d;
      on.template head<3>() += k * rest.translation * d.template head<3>();
      df[m] += on;
      df[p] += (rest.fixed[i] - 1) * on;
    }
  }

  Mat<Real, 6> block(Rest const& rest, Tangent const& tangent, int i, int j, Real k, Real b) const {
    Mat<Real, 6> block = frame_block(tangent.frames, i, j, k, torquesAt(rest));
    if (i / 2 != j / 2) return block;
    const bool world = rest.fixed[i / 2] > 0;
    if (world && (i % 2 == 0 || j % 2 == 0)) return block;
    const Real sign = i == j ? -1 : 1;
    for (int c = 0; c < 6; ++c)
      block(c, c) += sign * ((c < 3 ? k * rest.translation : Real(0)) + b * rest.damping);
    return block;
  }

 private:
  static Vec3 offset(Rest const& rest, Coord const (&x)[4], int i) {
    const Vec3 world(rest.center[i][0], rest.center[i][1], rest.center[i][2]);
    return (rest.fixed[i] > 0 ? world : Vec3(x[2 * i].center)) - x[2 * i + 1].center;
  }
  static Deriv relative(Rest const& rest, Deriv const (&v)[4], int i) {
    return (1 - rest.fixed[i]) * v[2 * i] - v[2 * i + 1];
  }
  static auto torquesAt(Rest const& rest) {
    return [&rest](auto const& frames) {
      using S = std::decay_t<decltype(frames.orientation[0].w)>;
      return Turned<S>(rest, frames).torques(rest);
    };
  }

  /// Angles of both gears in their bearings, and torques on the gears by them.
  template <class S>
  struct Turned {
    S tilt2[2], angle[2], slip;  // phi^2, theta, r theta1 + theta2
    Vec<S, 3> upright[2];        // torque per kr that takes the axis of the gear to that of the parent
    Vec<S, 3> turn[2];           // d theta by the spin of the gear

    Turned(Rest const& rest, Frames<S, 4> const& frames) {
      using std::sqrt, sinew::sqrt;
      const S tiny(std::numeric_limits<lane_scalar<Real>>::min());
      for (int i = 0; i < 2; ++i) {
        const auto parent =
            rest.fixed[i] > 0 ? unit_quaternion<S>(rest.orientation[i]) : frames.orientation[2 * i];
        auto const& gear = frames.orientation[2 * i + 1];
        const Vec<S, 3> a(S(rest.axis[i][0]), S(rest.axis[i][1]), S(rest.axis[i][2]));
        const Vec<S, 3> from = gear(a), to = parent(a), sum = from + to, apart = to - from;
        const S sine2 = S(0.25) * dot3(apart, apart), cosine = sqrt(S(0.25) * dot3(sum, sum) + tiny),
                ratio = arc_ratio(sine2, cosine);  // phi over the sine of phi/2
        tilt2[i] = ratio * ratio * sine2;
        upright[i] = (S(0.5) * ratio / cosine) * cross3(from, to);

        const UnitQuaternion<S> q = parent.inverse() * gear;
        const S along = dot3(q.v, a), square = q.w * q.w + along * along + tiny;
        turn[i] = parent(Vec<S, 3>(S(1) / square * (q.w * q.w * a + q.w * cross3(q.v, a) + along * q.v)));
        angle[i] = S(2) * detail::arc_tangent(along, q.w);
        const Real circle = 2 * std::numbers::pi_v<Real>, beyond = value_of(angle[i]) - rest.angle[i];
        angle[i] = angle[i] - S(circle * std::round(beyond / circle));
      }
      slip = S(rest.ratio) * angle[0] + angle[1];
    }

    FrameForces<S, 4> torques(Rest const& rest) const {
      FrameForces<S, 4> f;
      const S push = S(-rest.gear / std::abs(rest.ratio)) * slip;
      const S about[2] = {S(rest.ratio) * push, push};
      for (int i = 0; i < 2; ++i) {
        const Vec<S, 3> torque = S(rest.tilt) * upright[i] + about[i] * turn[i];
        f.torque[2 * i + 1] = torque;
        f.torque[2 * i] = S(rest.fixed[i] - 1) * torque;
        for (int c = 0; c < 3; ++c) f.force[2 * i][c] = f.force[2 * i + 1][c] = S(0);
      }
      return f;
    }
  };
};

/// Pairs of gears that turn each other, inside one state of rigid bodies (`E` = Within), or each in one of
/// the states at two paths (`E` = Between<"a", "b/c">, at a common ancestor; `E` = Linked in a runtime tree).
/// Each gear is held in a bearing at the place of its parent, in which it turns about the axis that is free:
/// put bodies there with a RigidMapping. A gear that is its own parent has a bearing in the world, where it
/// is at rest. The second gear turns by -ratio times the angle of the first: with ratios above 0 as gears
/// whose teeth are outside, below 0 as by a chain. An angle may be of many turns, where it changes by less
/// than half a turn between two forces.
template <class D, class E = Within>
struct GearSpringForceField {
  static_assert(D::rigid && D::spatial == 3,
                "Sinew: GearSpringForceField is for rigid bodies in space (Rigid3d).");
  using Ends = E;
  template <class Other>
  using WithEnds = GearSpringForceField<D, Other>;
  static constexpr bool between = !std::is_same_v<E, Within>;
  using Role = std::conditional_t<between, role::InteractionForceField, role::ForceField>;
  using DataTypes = D;
  using Real = typename D::Real;
  using VecCoord = typename D::VecCoord;
  using VecDeriv = typename D::VecDeriv;
  static constexpr std::string_view className = "GearSpringForceField";

  std::vector<GearSpring> springs{};
  [[no_unique_address]] E ends{};

  static constexpr auto fields() {
    return field_list(
        field("springs", &GearSpringForceField::springs, "", "the pairs of gears").also("spring"));
  }

  ForceProperties properties() const {
    bool world = false;
    for (GearSpring const& s : springs)
      world = world || (!between && (s.first == s.firstParent || s.second == s.secondParent));
    return {.internal = !world, .objective = !world, .exactTangent = false};
  }

  using Driver = ElementDriver<GearSpringLaw, D>;
  Driver driver{};
  std::vector<double> angles{};  // of both gears of each pair, at the last force

  /// What the next step depends on, besides positions and velocities.
  static constexpr auto state() {
    return field_list(
        field("angles", &GearSpringForceField::angles, "rad", "of both gears of each pair, turns counted"));
  }

  void init(InitContext<D> const& context) { init(context, context); }
  void init(InitContext<D> const& a, InitContext<D> const& b) {
    const std::string where = text(a.where, ": ", component_name<GearSpringForceField>());
    std::vector<typename Driver::Indices> bodies;
    std::vector<typename Driver::Rest> rest;
    if (angles.size() != 2 * springs.size()) angles.assign(2 * springs.size(), 0);
    for (std::size_t s = 0; s < springs.size(); ++s) {
      GearSpring const& spring = springs[s];
      for (const int end : {spring.firstParent, spring.first}) check_spring_end(where, s, a, end);
      for (const int end : {spring.secondParent, spring.second}) check_spring_end(where, s, b, end);
      if (!between) check_two_ends(where, s, spring.first, spring.second, {"gear", "bodies"});
      if (!(std::abs(spring.ratio) > 0) || !std::isfinite(spring.ratio))
        throw Error(where, text("springs[", s, "] has a ratio of ", spring.ratio, "; give one other than 0"));
      bodies.push_back({spring.firstParent, spring.first, spring.secondParent, spring.second});
      rest.push_back(restOf(a, b, s));
    }
    driver.init(bodies, rest);
  }
  void reset() {
    for (auto& angle : angles) angle = 0;
    for (auto& pack : driver.packs) pack.rest.angle[0] = pack.rest.angle[1] = 0;
  }

  void addForce(MechanicalParams const&, VecDeriv& f, VecCoord const& x, VecDeriv const& v) {
    driver.addForce({}, f, x, v);
    keepAngles();
  }
  void addForce(MechanicalParams const&, VecDeriv& f0, VecDeriv& f1, VecCoord const& x0, VecCoord const& x1,
                VecDeriv const& v0, VecDeriv const& v1) {
    driver.addForce({}, ofBoth(f0, f1), ofBoth(x0, x1), ofBoth(v0, v1));
    keepAngles();
  }
  void addDForce(MechanicalParams const& p, VecDeriv& df, VecDeriv const& dx) const {
    driver.addDForce({}, df, dx, Real(p.k), Real(p.b));
  }
  void addDForce(MechanicalParams const& p, VecDeriv& df0, VecDeriv& df1, VecDeriv const& dx0,
                 VecDeriv const& dx1) const {
    driver.addDForce({}, ofBoth(df0, df1), ofBoth(dx0, dx1), Real(p.k), Real(p.b));
  }
  double potentialEnergy(VecCoord const& x) const { return driver.energy({}, x); }
  double potentialEnergy(VecCoord const& x0, VecCoord const& x1) const {
    return driver.energy({}, ofBoth(x0, x1));
  }
  // bodies of an element may be the same, and then both of a block and its transpose belong to one place
  template <class Sink>
  void addToMatrix(MechanicalParams const& p, Sink const& sink) {
    constexpr int n = D::size, side = between ? 1 : 0;
    if constexpr (Sink::phase != AssemblyPhase::bind)
      for (auto const& pack : driver.packs)
        detail::add_between<std::integer_sequence<int, 0, 0, side, side>, n>(
            typename Driver::Law{}, sink, pack, Real(p.k), Real(p.b));
  }

 private:
  template <class V>
  static auto ofBoth(V& a, V& b) {
    using T = std::remove_pointer_t<decltype(a.data())>;
    return std::array<T*, 4>{a.data(), a.data(), b.data(), b.data()};
  }
  void keepAngles() {
    std::size_t at = 0;
    for (auto& pack : driver.packs)
      for (int i = 0; i < 2; ++i) angles[at++] = double(pack.rest.angle[i] = pack.tangent.angle[i]);
  }
  typename Driver::Rest restOf(InitContext<D> const& a, InitContext<D> const& b, std::size_t s) const {
    GearSpring const& spring = springs[s];
    typename Driver::Rest rest;
    rest.translation = Real(spring.stiffnessTranslation);
    rest.gear = Real(spring.stiffnessRotation[0]), rest.tilt = Real(spring.stiffnessRotation[1]);
    rest.ratio = Real(spring.ratio), rest.damping = Real(spring.damping);
    for (std::size_t i = 0; i < 2; ++i) {
      const int parent = i == 0 ? spring.firstParent : spring.secondParent,
                gear = i == 0 ? spring.first : spring.second;
      auto const& body = (i == 0 ? a : b).rest[std::size_t(gear)];
      rest.axis[i] = Vec<Real, 3>::Unit(spring.freeAxis[i]);
      rest.fixed[i] = Real(parent == gear ? 1 : 0);
      for (int c = 0; c < 3; ++c) rest.center[i][c] = body.center[c];
      store(body.orientation.template cast<double>(), rest.orientation[i]);
      rest.angle[i] = Real(angles[2 * s + i]);
    }
    return rest;
  }
};

}  // namespace sinew
