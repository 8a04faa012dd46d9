// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/constraint/constrained_points.hpp>

#include <vector>

namespace sinew {

/// Rigid bodies do not rotate about some of the world's axes. With q the rotation from rest, as a quaternion
/// in world axes:
///   three axes  q = 1
///   two axes    q is a rotation about the third
///   one axis n  q has no twist about it, q.n = 0 (it is a rotation about some axis across n); the angular
///   velocity
///               then has no part along q_w n + q x n, as d/dt (q.n) = w.(q_w n + q x n)/2 says
/// (SOFA removes the twists about the axes one after the other, which for two axes and more depends on the
/// order, and leaves velocities as they are.)
template <class D>
struct FixedRotationConstraint {
  static_assert(D::rigid && D::spatial == 3,
                "Sinew: FixedRotationConstraint is for rigid bodies in space (Rigid3d).");
  using Role = role::ProjectiveConstraint;
  using DataTypes = D;
  using Real = typename D::Real;
  using VecCoord = typename D::VecCoord;
  using VecDeriv = typename D::VecDeriv;
  using Vec3 = Vec<Real, 3>;
  static constexpr std::string_view className = "FixedRotationConstraint";
  static constexpr std::string_view aliases = "FixedRotationProjectiveConstraint";

  bool fixedXRotation = false, fixedYRotation = false, fixedZRotation = false;

  static constexpr auto fields() {
    using F = FixedRotationConstraint;
    return field_list(
        field("FixedXRotation", &F::fixedXRotation, "", "no rotation about the x axis of the world"),
        field("FixedYRotation", &F::fixedYRotation, "", "no rotation about the y axis of the world"),
        field("FixedZRotation", &F::fixedZRotation, "", "no rotation about the z axis of the world"));
  }

  std::vector<Quat<Real>> rest{};
  std::vector<Mat<Real, 3>> free{};  // projectors of the angular velocities

  void init(InitContext<D> const& context) {
    rest.clear();
    for (auto const& x : context.rest) rest.push_back(x.orientation);
    free.assign(rest.size(), projector(Quat<Real>(1, 0, 0, 0)));
  }

  void projectResponse(VecDeriv& dx) const {
    for (std::size_t i = 0; i < free.size(); ++i) {
      auto angular = dx[i].template tail<3>();
      angular = (free[i] * angular).eval();
    }
  }
  template <class Sink>
  void projectMatrix(Sink const& sink) const {
    for (std::size_t i = 0; i < free.size(); ++i) {
      Mat<Real, 6> all = Mat<Real, 6>::Identity();
      all.template bottomRightCorner<3, 3>() = free[i];
      sink.project(int(i), all);
    }
  }

  void projectPosition(double /*time*/, VecCoord& x) {
    const Vec3 n = axis();
    for (std::size_t i = 0; i < rest.size(); ++i) {
      Quat<Real> q = x[i].orientation * rest[i].conjugate();
      switch (count()) {
        case 3:
          q.setIdentity();
          break;
        case 2:
          q = twist(q, n);
          break;
        case 1:
          q = q * twist(q, n).conjugate();
          break;
        default:
          continue;
      }
      q.normalize();
      free[i] = projector(q);
      x[i].orientation = (q * rest[i]).normalized();
    }
  }
  void projectVelocity(double /*time*/, VecDeriv& v) const { projectResponse(v); }

 private:
  int count() const { return int(fixedXRotation) + int(fixedYRotation) + int(fixedZRotation); }
  /// The axis that is fixed alone, or free alone.
  Vec3 axis() const {
    const bool one = count() == 1;
    return fixedXRotation == one ? Vec3::UnitX() : fixedYRotation == one ? Vec3::UnitY() : Vec3::UnitZ();
  }
  /// The rotation about n in q; the identity where q is half a turn about an axis across n, and any would do.
  static Quat<Real> twist(Quat<Real> const& q, Vec3 const& n) {
    Quat<Real> t(q.w(), 0, 0, 0);
    t.vec() = n * n.dot(q.vec());
    if (!(t.norm() > 0)) return Quat<Real>(1, 0, 0, 0);
    return t.normalized();
  }
  Mat<Real, 3> projector(Quat<Real> const& q) const {
    const Mat<Real, 3> all = Mat<Real, 3>::Identity();
    const Vec3 n = axis();
    switch (count()) {
      case 3:
        return Mat<Real, 3>::Zero();
      case 2:
        return n * n.transpose();
      case 1: {
        const Vec3 held = q.w() * n + q.vec().cross(n);
        if (!(held.norm() > 0)) return all - n * n.transpose();
        const Vec3 unitHeld = held.normalized();
        return all - unitHeld * unitHeld.transpose();
      }
      default:
        return all;
    }
  }
};

}  // namespace sinew
