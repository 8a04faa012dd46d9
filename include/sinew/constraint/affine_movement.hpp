// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/constraint/constrained_points.hpp>

#include <vector>

namespace sinew {

/// Points move at constant speed from their rest positions x to A x + t, from a first time to a last; before
/// and after they are held. Of rigid bodies the rotation is given as a quaternion, in the place of A.
template <class D>
struct AffineMovementConstraint {
  using Role = role::ProjectiveConstraint;
  using DataTypes = D;
  using Real = typename D::Real;
  using Deriv = typename D::Deriv;
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
    return field_list(
        field("indices", &F::indices, "", "points that are moved", range::nonNegative).numbersOf(Of::points),
        field("beginConstraintTime", &F::beginConstraintTime, "s", "time at which the movement starts"),
        field("endConstraintTime", &F::endConstraintTime, "s", "time at which the movement ends"),
        field("rotation", &F::rotation, "", "matrix A, row by row"),
        field("quaternion", &F::quaternion, "", "rotation of rigid bodies in space: x y z w"),
        field("translation", &F::translation, "m", "translation t"));
  }

  VecCoord start{};
  VecDeriv movement{};  // from start to the end

  void init(InitContext<D> const& context) {
    using Movement = AffineMovementConstraint;
    check_points<Movement>(context, indices);
    if (!(endConstraintTime > beginConstraintTime))
      throw Error(place_of<Movement>(context),
                  text("beginConstraintTime is ",
                       beginConstraintTime,
                       " s and endConstraintTime ",
                       endConstraintTime,
                       " s; give an end after the begin"));
    Mat<double, n> a;
    for (int r = 0; r < n; ++r)
      for (int c = 0; c < n; ++c) a(r, c) = rotation[n * r + c];
    start.clear(), movement.clear();
    for (const int i : indices) {
      start.push_back(context.rest[std::size_t(i)]);
      typename D::Coord end = start.back();
      if constexpr (D::rigid && n == 3) {
        const Eigen::Vector4d q = unit<Movement>(context, "quaternion", quaternion);
        const Quat<double> rotate(q[3], q[0], q[1], q[2]);
        a = rotate.toRotationMatrix();
        end.orientation = rotate.template cast<Real>() * end.orientation;
      } else if constexpr (D::rigid) {
        end.orientation += Real(std::atan2(a(1, 0), a(0, 0)));
      }
      const Vec<double, n> to = a * D::center(start.back()).template cast<double>() + translation;
      set_center<D>(end, to.template cast<Real>());
      movement.push_back(D::difference(start.back(), end));
    }
  }

  void projectResponse(VecDeriv& dx) const {
    for (const int i : indices) dx[std::size_t(i)].setZero();
  }
  template <class Sink>
  void projectMatrix(Sink const& sink) const {
    for (const int i : indices) sink.fix(i);
  }

  void projectPosition(double time, VecCoord& x) const {
    if (time < beginConstraintTime) return;
    const double part = std::min((time - beginConstraintTime) / duration(), 1.0);
    for (std::size_t k = 0; k < indices.size(); ++k) {
      typename D::Coord& place = x[std::size_t(indices[k])];
      place = start[k];
      D::increment(place, movement[k] * Real(part));
    }
  }
  void projectVelocity(double time, VecDeriv& v) const {
    const bool moves = time >= beginConstraintTime && time < endConstraintTime;
    for (std::size_t k = 0; k < indices.size(); ++k)
      v[std::size_t(indices[k])] = moves ? Deriv(movement[k] / Real(duration())) : Deriv(Deriv::Zero());
  }

 private:
  double duration() const { return endConstraintTime - beginConstraintTime; }
  static Vec<double, n * n> identity() {
    Vec<double, n* n> rows = Vec<double, n * n>::Zero();
    for (int c = 0; c < n; ++c) rows[(n + 1) * c] = 1;
    return rows;
  }
};

}  // namespace sinew
