// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/core/component.hpp>
#include <sinew/core/cross_matrix.hpp>
#include <sinew/core/element_driver.hpp>
#include <sinew/core/ends.hpp>
#include <sinew/force/spring_ends.hpp>

#include <Eigen/Geometry>
#include <array>
#include <cmath>
#include <vector>

namespace sinew {

/// One spring of a FrameSpringForceField, in words as SOFA has them: BEGIN_SPRING 0 1 KS_T 100 KS_R 20 KD 1
/// VEC1 1 0 0 VEC2 -1 0 0 END_SPRING.
struct FrameSpring {
  static constexpr std::array<std::string_view, 2> bracket{"BEGIN_SPRING", "END_SPRING"};
  static constexpr int unnamed = 2;  // values that stand without their names

  int first = 0, second = 0;
  double stiffnessTranslation = 0, stiffnessRotation = 0, damping = 0;
  Eigen::Vector3d firstPoint{0, 0, 0}, secondPoint{0, 0, 0};

  static constexpr auto fields() {
    using S = FrameSpring;
    constexpr Range r = range::nonNegative;
    return field_list(
        field("first", &S::first, "", "body at the first end", r).numbersOf(Of::points),
        field("second", &S::second, "", "body at the second end", r).numbersOf(Of::secondPoints),
        field("stiffnessTranslation",
              &S::stiffnessTranslation,
              "N/m",
              "force per distance of the two points",
              r)
            .also("KS_T"),
        field("stiffnessRotation", &S::stiffnessRotation, "N m/rad", "torque per angle between the bodies", r)
            .also("KS_R"),
        field("damping", &S::damping, "N s/m", "force, and torque [N m s], per relative velocity", r)
            .also("KD"),
        field("firstPoint", &S::firstPoint, "m", "the point at the first end, in axes of its body")
            .also("VEC1"),
        field("secondPoint", &S::secondPoint, "m", "the point at the second end, likewise").also("VEC2"));
  }
};

/// Spring between points of two rigid bodies, r = R p from the centres, and between their orientations.
///   E = k/2 |d|^2 + K/2 |t|^2,   d = c1 + r1 - c0 - r0,   t = rotation vector of q1 q0^-1          [J]
///   f0 = -f1 = F = k d + c d'                                                                     [N]
///   torque0 = r0 x F + T,   torque1 = -r1 x F - T,   T = K t + c (w1 - w0)                      [N m]
/// The tangent has the symmetric part of the derivative, as that of AngularSpring has for t.
template <class D>
struct FrameSpringLaw {
  using Real = typename D::Real;
  using Coord = typename D::Coord;
  using Deriv = typename D::Deriv;
  using Vec3 = Vec<Real, 3>;
  using Mat3 = Mat<Real, 3>;
  static constexpr int arity = 2;
  static constexpr bool usesVelocity = true;

  struct Rest {
    Real stiffness, rotationStiffness, damping;
    Vec3 points[2];
  };
  struct Tangent {
    Vec3 arms[2], force;   // r, and k d
    Mat3 symmetric, skew;  // of the change of t
  };

  Real energy(Rest const& rest, Coord const (&x)[2]) const {
    const Vec3 d = place(rest, x, 1) - place(rest, x, 0);
    return (rest.stiffness * d.squaredNorm() + rest.rotationStiffness * turn(x).squaredNorm()) / 2;
  }

  void force(Rest const& rest, Coord const (&x)[2], Deriv const (&v)[2], Deriv (&f)[2],
             Tangent& tangent) const {
    Vec3 rate = Vec3::Zero();
    for (int i = 0; i < 2; ++i) {
      tangent.arms[i] = x[i].orientation * rest.points[i];
      const Vec3 w = v[i].template tail<3>(), own = v[i].template head<3>() + w.cross(tangent.arms[i]);
      rate += i == 0 ? Vec3(-own) : own;
    }
    tangent.force = rest.stiffness * (place(rest, x, 1) - place(rest, x, 0));
    const Vec3 t = turn(x), force = tangent.force + rest.damping * rate,
               torque = rest.rotationStiffness * t + rest.damping * (v[1] - v[0]).template tail<3>();
    f[0] << force, tangent.arms[0].cross(force) + torque;
    f[1] << -force, -tangent.arms[1].cross(force) - torque;
    const Real square = t.squaredNorm(), half = std::sqrt(square) / 2;
    const Real s = half < Real(1e-3) ? Real(1) / 12 + square / 720 : (1 - half / std::tan(half)) / square;
    tangent.symmetric = (1 - s * square) * Mat3::Identity() + s * t * t.transpose();
    tangent.skew = cross_matrix(Vec3(t / -2));
  }

  void dforce(Rest const& rest, Tangent const& tangent, Deriv const (&dx)[2], Deriv (&df)[2], Real k,
              Real b) const {
    const Vec3 w0 = dx[0].template tail<3>(), w1 = dx[1].template tail<3>();
    const Vec3 d = dx[1].template head<3>() + w1.cross(tangent.arms[1]) - dx[0].template head<3>() -
                   w0.cross(tangent.arms[0]);
    const Vec3 force = (k * rest.stiffness + b * rest.damping) * d;
    const Vec3 shared =
        k * rest.rotationStiffness * (tangent.symmetric * (w1 - w0)) + b * rest.damping * (w1 - w0);
    const Real turning = k * rest.rotationStiffness;
    df[0] << force, tangent.arms[0].cross(force) + shared + turning * (tangent.skew * w1) +
                        k * (geometric(tangent, 0) * w0);
    df[1] << -force, -tangent.arms[1].cross(force) - shared - turning * (tangent.skew * w0) +
                         k * (geometric(tangent, 1) * w1);
  }

  Mat<Real, 6> block(Rest const& rest, Tangent const& tangent, int i, int j, Real k, Real b) const {
    const Real sign = i == j ? Real(-1) : Real(1);
    Mat<Real, 6> block = (sign * (k * rest.stiffness + b * rest.damping)) *
                         (jacobian(tangent.arms[i]).transpose() * jacobian(tangent.arms[j]));
    auto rotation = block.template bottomRightCorner<3, 3>();
    rotation += (sign * k * rest.rotationStiffness) * tangent.symmetric;
    rotation.diagonal().array() += sign * b * rest.damping;
    if (i == j)
      rotation += k * geometric(tangent, i);
    else
      rotation += ((i < j ? k : -k) * rest.rotationStiffness) * tangent.skew;
    return block;
  }

 private:
  static Vec3 place(Rest const& rest, Coord const (&x)[2], int i) {
    return x[i].center + x[i].orientation * rest.points[i];
  }
  static Vec3 turn(Coord const (&x)[2]) {
    Coord from;
    from.orientation = x[0].orientation;
    from.center = x[1].center;
    return D::difference(from, x[1]).template tail<3>();
  }
  static Mat<Real, 3, 6> jacobian(Vec3 const& arm) {
    Mat<Real, 3, 6> j;
    j << Mat3::Identity(), -cross_matrix(arm);
    return j;
  }
  // what the force at an arm that turns adds: 1/2 ([f]x [r]x + [r]x [f]x)
  static Mat3 geometric(Tangent const& tangent, int i) {
    const Vec3 f = i == 0 ? tangent.force : Vec3(-tangent.force), r = tangent.arms[i];
    return (f * r.transpose() + r * f.transpose()) / 2 - f.dot(r) * Mat3::Identity();
  }
};

/// Springs that hold points of rigid bodies together and their axes parallel, inside one state (`E` =
/// Within), or between the states at two paths (`E` = Between<"a", "b/c">, at a common ancestor; `E` = Linked
/// in a runtime tree). Unlike JointSpringForceField they are the same along and about all axes, and have an
/// energy.
///
/// In SOFA the torque of the angle is taken in axes of the first body as if it were in those of the world,
/// the damping torque on the second body drives it, and the damping force is that of the centres.
template <class D, class E = Within>
struct FrameSpringForceField {
  static_assert(D::rigid && D::spatial == 3,
                "Sinew: FrameSpringForceField is for rigid bodies in space (Rigid3d).");
  using Ends = E;
  template <class Other>
  using WithEnds = FrameSpringForceField<D, Other>;
  static constexpr bool between = !std::is_same_v<E, Within>;
  using Role = std::conditional_t<between, role::InteractionForceField, role::ForceField>;
  using DataTypes = D;
  using Real = typename D::Real;
  static constexpr std::string_view className = "FrameSpringForceField";

  std::vector<FrameSpring> springs{};
  [[no_unique_address]] E ends{};

  static constexpr auto fields() {
    return field_list(field("spring", &FrameSpringForceField::springs, "", "the springs").also("springs"));
  }

  static constexpr ForceProperties properties() { return {.exactTangent = false}; }

  using Driver = ElementDriver<FrameSpringLaw, D>;
  Driver driver{};

  void init(InitContext<D> const& context) { init(context, context); }
  void init(InitContext<D> const& a, InitContext<D> const& b) {
    const std::string where = text(a.where, ": ", component_name<FrameSpringForceField>());
    auto restOf = [](std::size_t, FrameSpring const& spring) -> typename Driver::Rest {
      return {Real(spring.stiffnessTranslation),
              Real(spring.stiffnessRotation),
              Real(spring.damping),
              {spring.firstPoint.template cast<Real>(), spring.secondPoint.template cast<Real>()}};
    };
    init_springs(*this, where, springs, a, b, {"body", "bodies"}, restOf);
  }
};

}  // namespace sinew
