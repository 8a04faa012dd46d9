// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/core/component.hpp>
#include <sinew/force/rotations.hpp>
#include <sinew/topology/element_checks.hpp>
#include <sinew/topology/hexahedra.hpp>

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

namespace sinew {

/// A linear tetrahedron at rest, of total Lagrangian laws.
template <class Real>
struct TetrahedronRest {
  Mat<Real, 3> gradient;  // columns g_1 g_2 g_3: gradients of the shape functions; det = 1 / (6 V) [1/m]
  Real volume;            // V [m^3]
};

/// F = sum_k x_k g_k'
template <class Real, class Coord>
SINEW_INLINE Mat<Real, 3> deformation_gradient(TetrahedronRest<Real> const& rest, Coord const (&x)[4]) {
  const Vec<Real, 3> a = x[1] - x[0], b = x[2] - x[0], c = x[3] - x[0];
  Mat<Real, 3> f;
  for (int j = 0; j < 3; ++j)
    for (int i = 0; i < 3; ++i)
      f(i, j) = a[i] * rest.gradient(j, 0) + b[i] * rest.gradient(j, 1) + c[i] * rest.gradient(j, 2);
  return f;
}

template <class Real>
SINEW_INLINE Vec<Real, 3> times(Mat<Real, 3> const& a, Vec<Real, 3> const& b) {
  Vec<Real, 3> c;
  for (int i = 0; i < 3; ++i) c[i] = a(i, 0) * b[0] + a(i, 1) * b[1] + a(i, 2) * b[2];
  return c;
}

/// The tetrahedra of the topology, or six in each of its hexahedra where it has none, cut as in SOFA with the
/// cells of a grid mirrored alternately, unless that turns some inside out. Those of mirrored cells have
/// their points `exchanged` and `exchanged` + 1 swapped: with 0, the line from a tetrahedron's first point to
/// the second, and the plane with the third, by which corotation goes, are those of SOFA; with 2 its first
/// point. Throws Error where there are none, at one that refers to a missing point, and at a hexahedron that
/// is flat or inside out.
template <class D>
std::vector<Tetrahedron> tetrahedra_of(std::string const& where, InitContext<D> const& context,
                                       std::size_t exchanged = 0) {
  auto const& given = context.topology.tetrahedra;
  std::vector<Tetrahedron> tetrahedra(given.begin(), given.end());
  if (!tetrahedra.empty()) {
    detail::check_indices(where, "tetrahedron", tetrahedra, context.rest.size());
    return tetrahedra;
  }
  auto const& hexahedra = context.topology.hexahedra;
  detail::check_indices(where, "hexahedron", hexahedra, context.rest.size());
  tetrahedra =
      hexahedra_to_tetrahedra(hexahedra, {.points = context.topology.grid, .swapping = true}, exchanged);
  auto insideOut = [&](Tetrahedron const& t) {
    auto from0 = [&](std::size_t k) -> Eigen::Vector3d {
      return (context.rest[std::size_t(t[k])] - context.rest[std::size_t(t[0])]).template cast<double>();
    };
    return !(from0(1).cross(from0(2)).dot(from0(3)) > 0);
  };
  // as at the rims of round grids
  if (std::any_of(tetrahedra.begin(), tetrahedra.end(), insideOut))
    tetrahedra = hexahedra_to_tetrahedra(hexahedra);
  check_tetrahedra<D>(text(where, ": its hexahedra, six tetrahedra each"), tetrahedra, context.rest);
  if (tetrahedra.empty() && !context.topology.grows)
    throw Error(where,
                "the topology has no tetrahedron; give the node a topology with tetrahedra or hexahedra");
  return tetrahedra;
}

/// Gives them to a driver, and returns them. Throws Error also at one that is flat or inside out. Gradients
/// are written in the axes of each, of which axes(e) gives the unit vectors as columns.
template <class D, class Driver, class Axes>
std::vector<Tetrahedron> init_tetrahedra(std::string const& where, Driver& driver,
                                         InitContext<D> const& context, Axes const& axes) {
  using Real = typename D::Real;
  auto const& points = context.rest;
  std::vector<Tetrahedron> tetrahedra = tetrahedra_of(where, context);
  if (!context.topology.tetrahedra.empty()) check_tetrahedra<D>(where, tetrahedra, points);
  std::vector<TetrahedronRest<Real>> rest;
  rest.reserve(tetrahedra.size());
  for (Tetrahedron const& t : tetrahedra) {
    Mat<double, 3> edges;
    for (int c = 0; c < 3; ++c)
      edges.col(c) =
          (points[std::size_t(t[std::size_t(c) + 1])] - points[std::size_t(t[0])]).template cast<double>();
    const Mat<double, 3> turned = axes(rest.size()).transpose() * edges.inverse().transpose();
    rest.push_back({turned.template cast<Real>(), Real(edges.determinant() / 6)});
  }
  driver.init({tetrahedra.begin(), tetrahedra.end()}, rest);
  return tetrahedra;
}
/// The same in the axes of space.
template <class D, class Driver>
std::vector<Tetrahedron> init_tetrahedra(std::string const& where, Driver& driver,
                                         InitContext<D> const& context) {
  return init_tetrahedra<D>(
      where, driver, context, [](std::size_t) -> Mat<double, 3> { return Mat<double, 3>::Identity(); });
}

}  // namespace sinew
