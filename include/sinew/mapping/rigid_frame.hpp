// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/core/data_types.hpp>

#include <cmath>

namespace sinew {

/// What mappings need of a rigid body that carries points or frames over Out at c + R p.
template <class In, class Out>
struct RigidFrame {
  using Real = typename Out::Real;
  static constexpr int N = In::spatial, angular = In::size - N;

  /// R of a body.
  SINEW_HD static Mat<Real, N> rotation(typename In::Coord const& body) {
    if constexpr (N == 3) {
      return body.orientation.toRotationMatrix().template cast<Real>();
    } else {
      const Real c = Real(std::cos(body.orientation)), s = Real(std::sin(body.orientation));
      return (Mat<Real, 2>() << c, -s, s, c).finished();
    }
  }
  /// (I, -[r]x), and (0, I) below it for frames, at r = R p.
  SINEW_HD static Mat<Real, Out::size, In::size> jacobian(Vec<Real, N> const& r) {
    Mat<Real, Out::size, In::size> j = Mat<Real, Out::size, In::size>::Identity();
    if constexpr (N == 3) {
      j(0, 4) = r[2], j(0, 5) = -r[1];
      j(1, 3) = -r[2], j(1, 5) = r[0];
      j(2, 3) = r[1], j(2, 4) = -r[0];
    } else {
      j(0, 2) = -r[1], j(1, 2) = r[0];
    }
    return j;
  }
  /// What a force f at r adds to the stiffness of the angular coordinates as r turns with the body, its
  /// symmetric part: 1/2 ([f]x [r]x + [r]x [f]x), in the plane -f.r.
  SINEW_HD static Mat<Real, angular> stiffness(Vec<Real, N> const& r, Vec<Real, N> const& f) {
    if constexpr (N == 3)
      return Real(0.5) * (f * r.transpose() + r * f.transpose()) - f.dot(r) * Mat<Real, 3>::Identity();
    else
      return Mat<Real, angular>::Constant(-f.dot(r));
  }
};

}  // namespace sinew
