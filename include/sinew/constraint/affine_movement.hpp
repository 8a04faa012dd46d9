// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/constraint/steady_movement.hpp>

#include <vector>

namespace sinew {

/// Points move at constant speed from their rest positions x to A x + t, from a first time to a last; before
/// and after they are held. Of rigid bodies the rotation is given as a quaternion, in the place of A.
template <class D>
struct AffineMovementConstraint {
  using Role = role::ProjectiveConstraint;
  using DataTypes = D;
  using Real = typename D::Real;
  using VecCoord = typename D::VecCoord;
  using VecDeriv = typename D::VecDeriv;
  static constexpr int n = D::spatial;
  static constexpr std::string_view className = "AffineMovementConstraint";
  static constexpr std::string_view aliases = "AffineMovementProjectiveConstraint";

  std::vector<int> indices{};
  double beginConstraintTime = 0, endConstraintTime = 20;
  Vec<double, n* n> rotation = identity();
  Eigen::Vector4d quaternion{0, 0, 0, 1};
  Vec<double, n> translation = Vec<double, n>::Zero();

  static constexpr auto fields() {
    using F = AffineMovementConstraint;
    return steady_movement_fields<F>(
        field("rotation", &F::rotation, "", "matrix A, row by row"),
        field("quaternion", &F::quaternion, "", "rotation of rigid bodies in space: x y z w"),
        field("translation", &F::translation, "m", "translation t"));
  }

  SteadyMovement<D> steady{};

  void init(InitContext<D> const& context) {
    using Movement = AffineMovementConstraint;
    steady.init(context, *this);
    Mat<double, n> a;
    for (int r = 0; r < n; ++r)
      for (int c = 0; c < n; ++c) a(r, c) = rotation[n * r + c];
    for (auto const& start : steady.start) {
      typename D::Coord end = start;
      if constexpr (D::rigid && n == 3) {
        const Eigen::Vector4d q = unit<Movement>(context, "quaternion", quaternion);
        const Quat<double> rotate(q[3], q[0], q[1], q[2]);
        a = rotate.toRotationMatrix();
        end.orientation = rotate.template cast<Real>() * end.orientation;
      } else if constexpr (D::rigid) {
        end.orientation += Real(std::atan2(a(1, 0), a(0, 0)));
      }
      const Vec<double, n> to = a * D::center(start).template cast<double>() + translation;
      set_center<D>(end, to.template cast<Real>());
      steady.movement.push_back(D::difference(start, end));
    }
  }

  void projectResponse(VecDeriv& dx) const {
    for (const int i : indices) dx[std::size_t(i)].setZero();
  }
  template <class Sink>
  void projectMatrix(Sink const& sink) const {
    for (const int i : indices) sink.fix(i);
  }

  void projectPosition(double time, VecCoord& x) const { steady.projectPosition(*this, time, x); }
  void projectVelocity(double time, VecDeriv& v) const { steady.projectVelocity(*this, time, v); }

 private:
  static Vec<double, n * n> identity() {
    Vec<double, n* n> rows = Vec<double, n * n>::Zero();
    for (int c = 0; c < n; ++c) rows[(n + 1) * c] = 1;
    return rows;
  }
};

}  // namespace sinew
