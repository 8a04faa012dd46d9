// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/core/compiled.hpp>
#include <sinew/topology/regular_grid.hpp>

namespace sinew {

/// The fields of a grid that is round about an axis, among them its own.
template <class T, class... Own>
constexpr auto round_grid_fields(Own... own) {
  return grid_fields<T>(
      field("n", &T::n, "", "points across, twice, and along the axis", range::atLeast(1)),
      field("nx", &T::nx, "", "points across, in place of the first of n", range::atLeast(1)),
      field("ny", &T::ny, "", "points across, in place of the second of n", range::atLeast(1)),
      field("nz", &T::nz, "", "points along the axis, in place of the third of n", range::atLeast(1)),
      own...);
}

template <class T>
constexpr auto round_grid_outputs() {
  return field_list(
      field("position", &T::position, "m", "the points, the first direction across fastest").also("points"),
      field("grid", &T::points, "", "points along x, y and z"),
      field("edges", &T::edges, "", "lines between neighbours").also("lines"),
      field("triangles", &T::triangles, "", "each quad as two"),
      field("quads", &T::quads, "", "squares of each layer, then those between layers"),
      field("hexahedra", &T::hexahedra, "", "the cells").also("hexas"));
}

namespace detail {

/// Points of a grid over a square (or cube) of half width `radius` around the origin, rounded in two (or
/// three) dimensions, about `axis`; in two, along it from 0 to `length`.
Mesh round_grid_points(std::string_view where, std::array<int, 3> const& n, Eigen::Vector3d const& axis,
                       int dimensions, double radius, double length);

}  // namespace detail

}  // namespace sinew

#if SINEW_DEFINES
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

namespace sinew::detail {

/// The first `dimensions` coordinates moved along the ray from the origin so that squares of half width r (or
/// cubes) become circles (or spheres) of radius r: p max|p_i| / |p|.
inline void round_square(Eigen::Vector3d& p, int dimensions) {
  double square = 0, maximum = 0;
  for (int c = 0; c < dimensions; ++c) square += p[c] * p[c], maximum = std::max(maximum, std::abs(p[c]));
  if (square > 0)
    for (int c = 0; c < dimensions; ++c) p[c] *= maximum / std::sqrt(square);
}

/// Right-handed axes, the third along `axis`, the first as near to x as can be; as near to y where `axis` is
/// x.
inline Eigen::Matrix3d axes_around(std::string_view where, Eigen::Vector3d const& axis) {
  if (!(axis.norm() > 0)) throw Error(where, "axis is zero; give it a direction");
  Eigen::Matrix3d axes;
  const Eigen::Vector3d third = axis.normalized();
  const bool isX = std::hypot(std::abs(third[0]) - 1, third[1], third[2]) < 1e-6;
  const Eigen::Vector3d second = third.cross(Eigen::Vector3d(isX ? 0 : 1, isX ? 1 : 0, 0)).normalized();
  axes.col(0) = second.cross(third), axes.col(1) = second, axes.col(2) = third;
  return axes;
}

SINEW_ONCE Mesh round_grid_points(std::string_view where, std::array<int, 3> const& n,
                                  Eigen::Vector3d const& axis, int dimensions, double radius, double length) {
  const Eigen::Matrix3d axes = axes_around(where, axis);
  for (std::size_t c = 0; c < std::size_t(dimensions); ++c)
    if (n[c] < 2)
      throw Error(where,
                  text("a grid of ",
                       n[0],
                       " x ",
                       n[1],
                       " x ",
                       n[2],
                       " points cannot be round; give at least 2 ",
                       dimensions == 2 ? "across, twice" : "each way"));
  const Eigen::Vector3d half = Eigen::Vector3d::Constant(radius);
  Eigen::Vector3d lo = -half, hi = half;
  if (dimensions == 2) lo[2] = 0, hi[2] = length;
  Mesh mesh = grid_points(where, n, lo, hi, 1, 24);
  for (auto& p : mesh.positions) {
    round_square(p, dimensions);
    p = axes * p;
  }
  return mesh;
}

}  // namespace sinew::detail
#endif
