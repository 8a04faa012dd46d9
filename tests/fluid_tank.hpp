// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/force/sph_kernels.hpp>

#include <Eigen/Core>

#include <algorithm>
#include <cmath>
#include <vector>

// Fluids of particles at a distance d, and what is measured of them.
namespace tank {

using Points = std::vector<Eigen::Vector3d>;

/// A block of nx x ny x nz particles whose lowest corner is at `corner`.
inline Points block(double d, int nx, int ny, int nz, Eigen::Vector3d const& corner = {0, 0, 0}) {
  Points x;
  for (int k = 0; k < nz; ++k)
    for (int j = 0; j < ny; ++j)
      for (int i = 0; i < nx; ++i) x.push_back(corner + d * Eigen::Vector3d(i + 0.5, j + 0.5, k + 0.5));
  return x;
}
/// Boundary particles around such a block, at a distance d from it, open above, `height` of them high.
inline Points walls(double d, int nx, int height, int nz) {
  Points x;
  for (auto const& p : block(d, nx + 2, height, nz + 2, {-d, -d, -d})) {
    auto outside = [d](double at, int n) { return at < 0 || at > n * d; };
    if (p[1] < 0 || outside(p[0], nx) || outside(p[2], nz)) x.push_back(p);
  }
  return x;
}

/// With the radius 2 d, a cubic lattice has the density 1 by the kernel times this: q = 0, 1/2, sqrt(1/2),
/// sqrt(3/4) with 1, 6, 12 and 8 neighbours.
inline const double wendland_factor = [] {
  const sinew::WendlandKernel<double> kernel(2);
  return 1 / (kernel.density(0.) + 6 * kernel.density(0.5) + 12 * kernel.density(std::sqrt(0.5)) +
              8 * kernel.density(std::sqrt(0.75)));
}();

/// The density of each particle over that at rest, by a sum over all pairs.
inline std::vector<double> densities(Points const& x, double volume, double radius,
                                     Points const& boundary = {}, double boundaryVolume = 0) {
  const sinew::WendlandKernel<double> kernel(radius, wendland_factor);
  std::vector<double> all;
  for (auto const& a : x) {
    double sum = 0;
    for (auto const& b : x) sum += volume * kernel.density(std::min(1.0, (a - b).norm() / radius));
    for (auto const& b : boundary)
      sum += boundaryVolume * kernel.density(std::min(1.0, (a - b).norm() / radius));
    all.push_back(sum);
  }
  return all;
}
/// The mean of what densities are too high.
inline double compression(std::vector<double> const& densities) {
  double sum = 0;
  for (const double d : densities) sum += std::max(0.0, d - 1);
  return sum / double(densities.size());
}
inline Eigen::Vector3d sum(Points const& values) {
  Eigen::Vector3d all(0, 0, 0);
  for (auto const& v : values) all += v;
  return all;
}

}  // namespace tank
