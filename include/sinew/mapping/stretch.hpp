// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/core/data_types.hpp>
#include <sinew/core/error.hpp>
#include <sinew/mapping/geometric_stiffness.hpp>

#include <cstddef>
#include <limits>
#include <string>

namespace sinew {

/// By how much the distance of two points is more than a length L, with f the force on it:
///   c = l - L,  l = |d|,  u = d/l      K_g = f/l (I - u u')
/// Two points in one place have no direction: u and K_g are zero there.
template <class Real, int N>
struct Stretch {
  Real length;                                    // L
  Vec<Real, N> direction = Vec<Real, N>::Zero();  // u, or zero
  Real inverse{0};                                // 1/l, or zero
  Real tension{0};                                // f/l, at the last updateK

  Real of(Vec<Real, N> const& d) {
    const Real l = d.norm();
    inverse = l > length * Real(1e-9) + std::numeric_limits<Real>::min() ? Real(1) / l : Real(0);
    direction = d * inverse;
    return l - length;
  }
  void updateK(Real force, GeometricStiffness which) {
    tension = adds_stiffness(which, force) ? force * inverse : Real(0);
  }
  /// k K_g d
  Vec<Real, N> pull(Vec<Real, N> const& d, Real k) const {
    return (k * tension) * (d - direction * direction.dot(d));
  }
  /// k K_g
  Mat<Real, N> stiffness(Real k) const {
    return (k * tension) * (Mat<Real, N>::Identity() - direction * direction.transpose());
  }
};

/// Of a mapping with restLengths and computeDistance: throws Error where it has not one length for each of
/// its edges, or none.
template <class M>
void check_rest_lengths(std::string const& where, M const& of, std::size_t edges) {
  if (!of.restLengths.empty() && of.restLengths.size() != edges)
    throw Error(where,
                text("restLengths has ",
                     of.restLengths.size(),
                     " entries for ",
                     edges,
                     " edges; give one for each edge, or none"));
}
/// L of an edge whose ends are this far apart at rest.
template <class M, class Real>
Real rest_length(M const& of, std::size_t edge, Real apart) {
  if (!of.restLengths.empty()) return Real(of.restLengths[edge]);
  return of.computeDistance ? Real(0) : apart;
}

}  // namespace sinew
