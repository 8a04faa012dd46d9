// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/core/component.hpp>
#include <sinew/core/element_driver.hpp>
#include <sinew/core/ends.hpp>
#include <sinew/force/spring_ends.hpp>

#include <Eigen/Geometry>
#include <array>
#include <cmath>
#include <numbers>
#include <optional>
#include <vector>

namespace sinew {

/// One joint of a JointSpringForceField, in words as SOFA has them: BEGIN_SPRING 0 1 FREE_AXIS 0 0 0 0 1 0
/// KS_T 0 30000 END_SPRING.
struct JointSpring {
  static constexpr std::array<std::string_view, 2> bracket{"BEGIN_SPRING", "END_SPRING"};
  static constexpr int unnamed = 2;  // values that stand without their names

  int first = 0, second = 0;
  std::array<bool, 6> freeAxis{false, false, false, true, true, true};
  std::array<double, 2> stiffnessTranslation{0, 10000}, stiffnessRotation{0, 10000};
  double stiffnessLimit = 0, damping = 0;
  std::array<double, 2> limitX{-100000, 100000}, limitY{-100000, 100000}, limitZ{-100000, 100000};
  Eigen::Vector3d restTranslation{0, 0, 0};
  Eigen::Vector4d restRotation{0, 0, 0, 1};

  static constexpr auto fields() {
    using J = JointSpring;
    constexpr Range r = range::nonNegative;
    return field_list(
        field("first", &J::first, "", "body at the first end, whose axes the joint has", r)
            .numbersOf(Of::points),
        field("second", &J::second, "", "body at the second end", r).numbersOf(Of::secondPoints),
        field("freeAxis", &J::freeAxis, "", "whether it moves along x, y and z, and turns about them")
            .also("FREE_AXIS"),
        field("stiffnessTranslation",
              &J::stiffnessTranslation,
              "N/m",
              "force per offset along free axes, and along the others",
              r)
            .also("KS_T"),
        field("stiffnessRotation",
              &J::stiffnessRotation,
              "N m/rad",
              "torque per angle about free axes, and about the others",
              r)
            .also("KS_R"),
        field("stiffnessLimit",
              &J::stiffnessLimit,
              "N m/rad",
              "torque per angle beyond the limits of a free axis; 0: a hundredth of that of the others",
              r)
            .also("KS_B"),
        field("damping", &J::damping, "N s/m", "force and torque per relative velocity", r).also("KD"),
        field("limitX", &J::limitX, "rad", "least and greatest angle about x").also("R_LIM_X"),
        field("limitY", &J::limitY, "rad", "the same about y").also("R_LIM_Y"),
        field("limitZ", &J::limitZ, "rad", "the same about z").also("R_LIM_Z"),
        field("restTranslation",
              &J::restTranslation,
              "m",
              "offset of the second body from the first without force, in world axes")
            .also("REST_T"),
        field("restRotation",
              &J::restRotation,
              "",
              "quaternion x y z w that takes the relative orientation to that without torque")
            .also("REST_R"));
  }
};

/// A joint between two bodies as a spring. With d the offset of the second from the first beyond the rest
/// translation, t the rotation vector of q0^-1 q1 r, and R that of the first body:
///   f0 = -f1 = R K R'd + c (v1 - v0)                                                             [N]
///   torque0 = -torque1 = R k(t) + c (w1 - w0)                                                 [N m]
/// K and k have the soft stiffness along free axes and the hard one along others. Where just one axis a turns
/// freely, the others hold it straight: with e that axis of the second body and theta the angle to it, their
/// torques are those of K theta a x e. Else a component of t beyond a limit pulls back to the nearer one. The
/// tangent holds R and the pieces of k fixed and leaves damping to the start of the step, as in SOFA.
template <class D>
struct JointSpringLaw {
  using Real = typename D::Real;
  using Coord = typename D::Coord;
  using Deriv = typename D::Deriv;
  using Vec3 = Vec<Real, 3>;
  using Mat3 = Mat<Real, 3>;
  static constexpr int arity = 2;
  static constexpr bool usesVelocity = true;

  struct Rest {
    Vec3 stiffness, soft, hard;  // of translations; of rotations about free axes, and about others
    Vec3 turns;                  // 1 for a free axis
    Real limitStiffness, damping;
    Vec3 low, high;  // limits
    Vec3 offset;
    Quat<Real> rotation;  // r
  };
  struct Tangent {
    Mat3 translation, rotation;
  };

  Real energy(Rest const& rest, Coord const (&x)[2]) const {
    const Mat3 axes = x[0].orientation.toRotationMatrix();
    const Vec3 d = axes.transpose() * (x[1].center - x[0].center - rest.offset);
    Vec3 stiffness;
    const Vec3 torque = torques(rest, x, stiffness);
    Real sum = d.dot(rest.stiffness.cwiseProduct(d));
    for (int i = 0; i < 3; ++i)
      if (stiffness[i] > 0) sum += torque[i] * torque[i] / stiffness[i];
    return sum / 2;
  }

  void force(Rest const& rest, Coord const (&x)[2], Deriv const (&v)[2], Deriv (&f)[2],
             Tangent& tangent) const {
    const Mat3 axes = x[0].orientation.toRotationMatrix();
    const Vec3 d = axes.transpose() * (x[1].center - x[0].center - rest.offset);
    Vec3 stiffness;
    f[0].template tail<3>() = axes * torques(rest, x, stiffness);
    f[0].template head<3>() = axes * rest.stiffness.cwiseProduct(d);
    f[0] += rest.damping * (v[1] - v[0]);
    f[1] = -f[0];
    tangent.translation = axes * rest.stiffness.asDiagonal() * axes.transpose();
    tangent.rotation = axes * stiffness.asDiagonal() * axes.transpose();
  }

  void dforce(Rest const&, Tangent const& tangent, Deriv const (&dx)[2], Deriv (&df)[2], Real k,
              Real /*b*/) const {
    const Deriv d = dx[1] - dx[0];
    df[0].template head<3>() = k * (tangent.translation * d.template head<3>());
    df[0].template tail<3>() = k * (tangent.rotation * d.template tail<3>());
    df[1] = -df[0];
  }

  Mat<Real, 6> block(Rest const&, Tangent const& tangent, int i, int j, Real k, Real /*b*/) const {
    Mat<Real, 6> block = Mat<Real, 6>::Zero();
    const Real sign = i == j ? -k : k;
    block.template topLeftCorner<3, 3>() = sign * tangent.translation;
    block.template bottomRightCorner<3, 3>() = sign * tangent.rotation;
    return block;
  }

 private:
  static constexpr double pi = std::numbers::pi;

  // k(t), and the stiffness of each axis
  static Vec3 torques(Rest const& rest, Coord const (&x)[2], Vec3& stiffness) {
    Coord from, to;
    from = to = x[0];
    from.orientation = Quat<Real>::Identity();
    to.orientation = (x[0].orientation.conjugate() * x[1].orientation * rest.rotation).normalized();
    const Vec3 t = D::difference(from, to).template tail<3>();
    int axis = -1, free = 0;
    for (int i = 0; i < 3; ++i) {
      stiffness[i] = rest.turns[i] > 0 ? rest.soft[i] : rest.hard[i];
      if (rest.turns[i] > 0) axis = i, ++free;
    }
    auto within = [&](int i) { return t[i] > rest.low[i] && t[i] < rest.high[i]; };
    Vec3 torque = stiffness.cwiseProduct(t);
    if (free == 0) return torque;
    if (free == 1 && within(axis)) {
      const Vec3 e = to.orientation.toRotationMatrix().col(axis), a = Vec3::Unit(axis), across = a.cross(e);
      const Real theta = std::atan2(across.norm(), e[axis]);
      for (int i = 0; i < 3; ++i)
        if (i != axis) torque[i] = stiffness[i] * theta * across[i];
      return torque;
    }
    Vec3 beyond;  // t but for what is allowed
    for (int i = 0; i < 3; ++i) {
      beyond[i] = t[i];
      if (rest.turns[i] == 0) continue;
      // the limit that is nearer on the circle
      const Real above = t[i] - rest.high[i] + (t[i] > 0 ? 0 : Real(2 * pi)),
                 below = rest.low[i] - t[i] + (t[i] > 0 ? Real(2 * pi) : 0);
      beyond[i] = within(i) ? 0 : t[i] - (above < below ? rest.high[i] : rest.low[i]);
    }
    const Real angle = beyond.norm();
    const Real turns = std::ceil((angle - Real(pi)) / Real(2 * pi));  // as an angle up to pi
    if (angle > Real(pi)) beyond *= (angle - turns * Real(2 * pi)) / angle;
    for (int i = 0; i < 3; ++i)
      if (rest.turns[i] > 0 && !within(i)) {
        stiffness[i] = rest.limitStiffness;
        torque[i] = stiffness[i] * beyond[i];
      }
    return torque;
  }
};

/// Joints between rigid bodies inside one state (`E` = Within), or between the states at two paths (`E` =
/// Between<"a", "b/c">, at a common ancestor; `E` = Linked in a runtime tree), as springs that are stiff
/// along and about the axes that are not free. The two bodies are at the place of the joint: put them there
/// with a RigidMapping.
template <class D, class E = Within>
struct JointSpringForceField {
  static_assert(D::rigid && D::spatial == 3,
                "Sinew: JointSpringForceField is for rigid bodies in space (Rigid3d).");
  using Ends = E;
  template <class Other>
  using WithEnds = JointSpringForceField<D, Other>;
  static constexpr bool between = !std::is_same_v<E, Within>;
  using Role = std::conditional_t<between, role::InteractionForceField, role::ForceField>;
  using DataTypes = D;
  using Real = typename D::Real;
  static constexpr std::string_view className = "JointSpringForceField";
  static constexpr bool implicit = false;  // damping is that at the start of a step

  std::vector<JointSpring> springs{};
  [[no_unique_address]] E ends{};

  static constexpr auto fields() {
    return field_list(field("springs", &JointSpringForceField::springs, "", "the joints").also("spring"));
  }

  static constexpr ForceProperties properties() {
    return {.objective = false, .conservative = false, .exactTangent = false};
  }

  using Driver = ElementDriver<JointSpringLaw, D>;
  Driver driver{};

  void init(InitContext<D> const& context) { init(context, context); }
  void init(InitContext<D> const& a, InitContext<D> const& b) {
    const std::string where = text(a.where, ": ", component_name<JointSpringForceField>());
    init_springs(
        *this, where, springs, a, b, {"body", "bodies"}, [&](std::size_t s, JointSpring const& spring) {
          return restOf(where, s, spring);
        });
  }

 private:
  static typename Driver::Rest restOf(std::string const& where, std::size_t s, JointSpring const& spring) {
    typename Driver::Rest rest;
    const std::array<std::array<double, 2>, 3> limits{spring.limitX, spring.limitY, spring.limitZ};
    for (int i = 0; i < 3; ++i) {
      const auto [low, high] = limits[std::size_t(i)];
      if (!(low <= high))
        throw Error(where,
                    text("springs[", s, "] turns from ", low, " to ", high, " about an axis; swap them"));
      auto const& [soft, hard] = spring.stiffnessTranslation;
      rest.stiffness[i] = Real(spring.freeAxis[std::size_t(i)] ? soft : hard);
      rest.soft[i] = Real(spring.stiffnessRotation[0]);
      rest.hard[i] = Real(spring.stiffnessRotation[1]);
      rest.turns[i] = Real(spring.freeAxis[std::size_t(i) + 3] && low != high ? 1 : 0);
      rest.low[i] = Real(low), rest.high[i] = Real(high);
    }
    rest.limitStiffness =
        Real(spring.stiffnessLimit > 0 ? spring.stiffnessLimit : spring.stiffnessRotation[1] / 100);
    rest.damping = Real(spring.damping);
    rest.offset = spring.restTranslation.cast<Real>();
    const double length = spring.restRotation.norm();
    if (!(length > 0))
      throw Error(where, text("restRotation of springs[", s, "] is no rotation; give a quaternion x y z w"));
    rest.rotation.coeffs() = (spring.restRotation / length).cast<Real>();
    return rest;
  }
};

}  // namespace sinew
