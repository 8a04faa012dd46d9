// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/core/data_types.hpp>
#include <sinew/force/spring_law.hpp>

namespace sinew {

/// The spring of SpringLaw between the centres of two rigid bodies, which feel no torque of it.
template <class D>
struct RigidSpringLaw {
  using Real = typename D::Real;
  using Coord = typename D::Coord;
  using Deriv = typename D::Deriv;
  using Centers = SpringLaw<VecTypes<D::spatial, Real>>;
  using Place = Vec<Real, D::spatial>;
  static constexpr int arity = 2;
  static constexpr bool usesVelocity = true, oneByOne = true, symmetricBlocks = true;

  using Rest = typename Centers::Rest;
  using Tangent = typename Centers::Tangent;

  Real energy(Rest const& rest, Coord const (&x)[2]) const {
    const Place centers[2] = {D::center(x[0]), D::center(x[1])};
    return Centers{}.energy(rest, centers);
  }
  void force(Rest const& rest, Coord const (&x)[2], Deriv const (&v)[2], Deriv (&f)[2],
             Tangent& tangent) const {
    const Place centers[2] = {D::center(x[0]), D::center(x[1])}, rates[2] = {linear(v[0]), linear(v[1])};
    Place forces[2];
    Centers{}.force(rest, centers, rates, forces, tangent);
    spread(forces, f);
  }
  void dforce(Rest const& rest, Tangent const& tangent, Deriv const (&dx)[2], Deriv (&df)[2], Real k,
              Real b) const {
    const Place moves[2] = {linear(dx[0]), linear(dx[1])};
    Place forces[2];
    Centers{}.dforce(rest, tangent, moves, forces, k, b);
    spread(forces, df);
  }
  Mat<Real, D::size> block(Rest const& rest, Tangent const& tangent, int i, int j, Real k, Real b) const {
    Mat<Real, D::size> block = Mat<Real, D::size>::Zero();
    block.template topLeftCorner<D::spatial, D::spatial>() = Centers{}.block(rest, tangent, i, j, k, b);
    return block;
  }

 private:
  static Place linear(Deriv const& v) { return v.template head<D::spatial>(); }
  static void spread(Place const (&forces)[2], Deriv (&f)[2]) {
    for (int i = 0; i < 2; ++i) {
      f[i].setZero();
      f[i].template head<D::spatial>() = forces[i];
    }
  }
};

}  // namespace sinew
