// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/constraint/constrained_points.hpp>
#include <sinew/core/point_change.hpp>

#include <vector>

namespace sinew {

/// A sink of particles, as in SOFA's plugin SofaSphFluid: before a step, points behind the plane n.x = d1 are
/// taken out of their state. At the end of a step points behind n.x = d0 have their velocity set to zero, so
/// that between the planes they creep by what the forces of one step make of them. A reset takes the state
/// back to the points that it started with.
template <class D>
struct ParticleSink {
  static_assert(!D::rigid && D::size == D::spatial,
                "Sinew: a ParticleSink takes points away; take Vec3d, Vec3f, Vec2d, Vec2f, Vec1d or Vec1f.");
  using Role = role::ProjectiveConstraint;
  using DataTypes = D;
  using Real = typename D::Real;
  using Coord = typename D::Coord;
  using VecCoord = typename D::VecCoord;
  using VecDeriv = typename D::VecDeriv;
  static constexpr std::string_view className = "ParticleSink";

  Coord normal = Coord::Unit(D::size > 1 ? 1 : 0);
  double d0 = 0, d1 = 0;

  static constexpr auto fields() {
    using S = ParticleSink;
    return field_list(
        field("normal", &S::normal, "", "normal n of the planes, used at the length given"),
        field("d0", &S::d0, "m", "points with n.x below it have no velocity at the end of a step"),
        field("d1", &S::d1, "m", "points with n.x below it are taken away"));
  }

  // for checkpoints
  int removed = 0;  // so far
  static constexpr auto state() {
    return field_list(
        field("removed", &ParticleSink::removed, "", "how many have been taken away", range::nonNegative));
  }

  int going = 0;            // in the step that begins
  std::vector<int> held{};  // points that have no velocity at the end of the step

  void init(InitContext<D> const& context) {
    if (normal.isZero(0))
      throw Error(place_of<ParticleSink>(context), "normal is zero; give the normal of the planes");
    held.clear();
    held.reserve(context.rest.size());
  }

  void changePoints(StepAhead const& ahead, VecCoord const& x, PointChange<D>& change) {
    if (ahead.step == 1) reset();
    going = 0;
    for (std::size_t i = 0; i < x.size(); ++i)
      if (behind(x[i], d1) && change.remove(i)) ++going;
  }
  /// Those that changePoints has marked have gone.
  void acceptPoints() { removed += going; }
  void followPoints(Renumbering const&, std::size_t points) {
    held.clear();
    held.reserve(points);
  }
  void reset() { removed = 0; }

  void projectResponse(VecDeriv&) const {}
  void projectPosition(double, VecCoord& x) {
    held.clear();
    for (std::size_t i = 0; i < x.size(); ++i)
      if (behind(x[i], d0)) held.push_back(int(i));
  }
  void projectVelocity(double, VecDeriv& v) const {
    for (const int i : held) v[std::size_t(i)].setZero();
  }
  template <class Sink>
  void projectMatrix(Sink const&) const {}

 private:
  bool behind(Coord const& x, double d) const { return double(normal.dot(x)) < d; }
};

}  // namespace sinew
