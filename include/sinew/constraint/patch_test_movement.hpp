// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/constraint/steady_movement.hpp>

#include <vector>

namespace sinew {

/// Points move at constant speed from their rest positions by what the corners of a box move, bilinear or
/// trilinear between them, from a first time to a last; before and after they are held. With it on the border
/// of a mesh, the inside of an element that passes the patch test follows exactly (Irons, Razzaque 1972).
///   u(x) = sum_c w_c(x) u_c,   w = products of r or 1 - r,   r = (x - low)/(high - low) along each axis
/// The corners are those of the box around cornerPoints, or else around constrainedPoints, or the points that
/// move: four counter-clockwise from the lowest, and four above them where the box is not flat along z.
template <class D>
struct PatchTestMovementProjectiveConstraint {
  static_assert(
      D::spatial == 3,
      "Sinew: PatchTestMovementProjectiveConstraint is for points and bodies in space; take Vec3d or "
      "Rigid3d.");
  using Role = role::ProjectiveConstraint;
  using DataTypes = D;
  using Real = typename D::Real;
  using Deriv = typename D::Deriv;
  using VecCoord = typename D::VecCoord;
  using VecDeriv = typename D::VecDeriv;
  static constexpr std::string_view className = "PatchTestMovementProjectiveConstraint",
                                    aliases = "PatchTestMovementConstraint BilinearMovementConstraint";

  std::vector<int> indices{};
  double beginConstraintTime = 0, endConstraintTime = 20;
  VecCoord constrainedPoints{};
  VecDeriv cornerMovements{};
  VecCoord cornerPoints{};

  static constexpr auto fields() {
    using F = PatchTestMovementProjectiveConstraint;
    return steady_movement_fields<F>(
        field("constrainedPoints", &F::constrainedPoints, "m", "points whose box has the corners"),
        field("cornerMovements",
              &F::cornerMovements,
              "m",
              "movement of each corner: (-,-), (+,-), (+,+), (-,+) along x and y, then the same above"),
        field("cornerPoints", &F::cornerPoints, "m", "points whose box has the corners, before all others"));
  }

  SteadyMovement<D> steady{};

  void init(InitContext<D> const& context) {
    using Movement = PatchTestMovementProjectiveConstraint;
    const std::string where = place_of<Movement>(context);
    steady.init(context, *this);
    auto const& boxed = !cornerPoints.empty()        ? cornerPoints
                        : !constrainedPoints.empty() ? constrainedPoints
                                                     : steady.start;
    if (boxed.empty()) return;
    using Place = Vec<double, 3>;
    Place low = D::center(boxed[0]).template cast<double>(), high = low;
    for (auto const& x : boxed) {
      low = min_of(low, Place(D::center(x).template cast<double>()));
      high = max_of(high, Place(D::center(x).template cast<double>()));
    }
    const Place extent = high - low;
    const std::size_t corners = extent[2] > 0 ? 8 : 4;
    if (!(extent[0] > 0) || !(extent[1] > 0))
      throw Error(where, "the box around the points is flat along x or y; give cornerPoints");
    if (cornerMovements.size() != corners)
      throw Error(where,
                  text("cornerMovements has ",
                       cornerMovements.size(),
                       " entries for a box of ",
                       corners,
                       " corners; give one for each"));
    for (auto const& x : steady.start) {
      const Place at = D::center(x).template cast<double>();
      double r[3];
      for (int c = 0; c < 3; ++c) r[c] = extent[c] > 0 ? (at[c] - low[c]) / extent[c] : 0;
      Deriv u = Deriv::Zero();
      for (std::size_t k = 0; k < corners; ++k) {
        const bool right = k % 4 == 1 || k % 4 == 2, far = k % 4 >= 2, above = k >= 4;
        u += cornerMovements[k] *
             Real((right ? r[0] : 1 - r[0]) * (far ? r[1] : 1 - r[1]) * (above ? r[2] : 1 - r[2]));
      }
      steady.movement.push_back(u);
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
};

}  // namespace sinew
