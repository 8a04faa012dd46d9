// SPDX-License-Identifier: BSL-1.0
#pragma once

// Two points, of which constraints prescribe the second.

#include "one_component.hpp"

#include <utility>

namespace moving {

using namespace sinew;
using Eigen::Vector3d;

inline const Vec3d::VecCoord two{{0, 0, 0}, {1, 2, 3}};
inline const Vector3d elsewhere(-7, -8, -9);

inline bool near(Vector3d const& a, Vector3d const& b) { return (a - b).norm() < 1e-14 * (1 + b.norm()); }

/// Position and velocity of point 1 at a time, of a point that was elsewhere.
template <class C>
std::pair<Vector3d, Vector3d> at(C& c, double time) {
  Vec3d::VecCoord x(2, elsewhere);
  Vec3d::VecDeriv v(2, elsewhere);
  c.projectPosition(time, x);
  c.projectVelocity(time, v);
  CHECK(x[0] == elsewhere);
  CHECK(v[0] == elsewhere);
  return {x[1], v[1]};
}

/// Whether displacements of point 1 are taken away in the step after the last end of a step.
template <class C>
bool holds(C const& c) {
  Vec3d::VecDeriv dx(2, Vector3d(1, 1, 1));
  c.projectResponse(dx);
  CHECK(dx[0] == Vector3d(1, 1, 1));
  return dx[1].norm() == 0;
}

}  // namespace moving
