// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/core/compiled.hpp>
#include <sinew/core/error.hpp>
#include <sinew/core/mesh.hpp>
#include <sinew/topology/bcc_lattice.hpp>
#include <sinew/topology/bcc_stencils.hpp>
#include <sinew/topology/bcc_warp.hpp>
#include <sinew/topology/implicit_surface.hpp>

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <string_view>
#include <utility>
#include <vector>

namespace sinew::detail {

/// The lattice after all points found their places, with the largest connected part of the body only.
template <ImplicitShape Shape>
BccLattice warped_bcc_lattice(std::string_view where, Shape const& shape, Eigen::Vector3d const& lo,
                              Eigen::Vector3d const& hi, double spacing) {
  BccLattice lattice = sample_bcc_lattice(where, shape, lo, hi, spacing);
  snap(lattice);
  do {
    unsnap_pinched(lattice);
  } while (unsnap_flattened(lattice));
  keep_largest_component(lattice);
  return lattice;
}

/// The inside of all lattice tetrahedra (see for_bcc_tetrahedra()), numbered as stuff() does.
std::vector<Tetrahedron> stuff(BccLattice const& lattice, bool skinOnly);

/// The points that the elements use; these then refer to them. In the order of the lattice, each lattice
/// point before the cut points of its edges.
template <class Element>
std::vector<Eigen::Vector3d> place_points(BccLattice const& lattice, std::vector<Element>& elements) {
  const int n = lattice.size();
  std::vector<Eigen::Vector3d> positions;
  std::vector<Index> number(std::size_t(n) + lattice.cuts.size(), -1);
  for (Element const& element : elements)
    for (const Index i : element) number[std::size_t(i)] = 0;
  auto place = [&](int i) {
    if (number[std::size_t(i)] < 0) return;
    number[std::size_t(i)] = Index(positions.size());
    positions.push_back(lattice.position(i));
  };
  lattice.for_inner_points([&](int p, auto const&) {
    place(p);
    const int first = n + lattice.cutStart[std::size_t(p)],
              count = std::popcount(lattice.cutMask[std::size_t(p)]);
    for (int i = 0; i < count; ++i) place(first + i);
  });
  for (Element& element : elements)
    for (Index& i : element) i = number[std::size_t(i)];
  return positions;
}

/// The body as tetrahedra; none when no lattice point is well inside.
template <ImplicitShape Shape>
Mesh stuffed_mesh(std::string_view where, Shape const& shape, Eigen::Vector3d const& lo,
                  Eigen::Vector3d const& hi, double spacing) {
  const BccLattice lattice = warped_bcc_lattice(where, shape, lo, hi, spacing);
  Mesh mesh;
  mesh.tetrahedra = stuff(lattice, false);
  mesh.positions = place_points(lattice, mesh.tetrahedra);
  return mesh;
}

inline void check_not_empty(std::string_view where, std::size_t elements, double spacing) {
  if (elements == 0)
    throw Error(where,
                text("nothing of the shape is inside the box at a spacing of ",
                     spacing,
                     "; the shape must be negative inside. Check the box, or reduce the spacing"));
}

}  // namespace sinew::detail

namespace sinew {

/// Tetrahedra that fill the solid shape(p) < 0 in the box, positively oriented (det(x1 - x0, x2 - x0, x3 -
/// x0) > 0): isosurface stuffing (Labelle & Shewchuk 2007) on a body-centred cubic lattice whose longer edges
/// have the length `spacing`; about 12 volume / spacing^3 tetrahedra. Of several pieces the largest remains.
/// For any shape whatever the dihedral angles are between 10.7 and 161.7 degrees, and the boundary is a
/// closed manifold. Its points are on the surface, to 1e-9 spacing for a smooth shape; details smaller than
/// the spacing, and now and then a point that would spoil an angle, are off by a fraction of it. f is
/// evaluated once a lattice point and a few times a cut edge; numbering follows the lattice. Throws Error on
/// an empty box, a spacing that is not positive or needs more than 2^28 lattice points, a shape that is not
/// finite, leaves the box, or has nothing inside that this spacing could see.
template <ImplicitShape Shape>
Mesh tetrahedralize(Shape const& shape, Eigen::Vector3d const& lo, Eigen::Vector3d const& hi,
                    double spacing) {
  Mesh mesh = detail::stuffed_mesh("tetrahedralize", shape, lo, hi, spacing);
  detail::check_not_empty("tetrahedralize", mesh.tetrahedra.size(), spacing);
  return mesh;
}

/// tetrahedralize() with the spacing that gives nearly `count` tetrahedra: the first found within 0.5
/// percent, else the nearest of some 70 spacings around. For a smooth compact shape that is within 5 percent
/// from 200 tetrahedra on; the smallest body has 24. Throws Error as tetrahedralize(), and when count < 1.
template <ImplicitShape Shape>
Mesh tetrahedralize_count(Shape const& shape, Eigen::Vector3d const& lo, Eigen::Vector3d const& hi,
                          int count) {
  constexpr std::string_view where = "tetrahedralize_count";
  if (count < 1) throw Error(where, text(count, " tetrahedra were asked for; at least 1 is needed"));
  // volume of the body from samples: 12 tetrahedra fill spacing^3
  detail::empty_bcc_lattice(where, lo, hi, (hi - lo).maxCoeff());
  double inside = 0, samples = 0;
  for (int n = 32; n <= 128 && inside == 0; n *= 2) {
    samples = double(n) * n * n;
    for (int i = 0; i < n * n * n; ++i) {
      const Eigen::Array3d unit(i % n + 0.5, i / n % n + 0.5, i / n / n + 0.5);
      inside += detail::finite_value(where, shape, lo + ((hi - lo).array() * unit / n).matrix()) < 0;
    }
  }
  if (inside == 0)
    throw Error(where,
                "nothing of the shape is inside the box; the shape must be negative inside. Check the box");
  const double volume = inside / samples * (hi - lo).prod();
  double spacing = std::cbrt(12 * volume / count);
  if (2 * (hi - lo).prod() > detail::BccLattice::maxPoints * spacing * spacing * spacing)
    throw Error(where,
                text(count,
                     " tetrahedra need more than 2^28 lattice points in this box, of which the shape fills ",
                     100 * inside / samples,
                     " percent; ask for fewer, or shrink the box"));

  Mesh best;
  auto error = [&](std::size_t n) { return std::abs(double(n) - count); };
  auto attempt = [&](double h) {
    Mesh mesh = detail::stuffed_mesh(where, shape, lo, hi, h);
    const std::size_t n = mesh.tetrahedra.size();
    if (n > 0 && (best.tetrahedra.empty() || error(n) < error(best.tetrahedra.size())))
      best = std::move(mesh);
    return n;
  };
  const double tolerance = 0.005 * count;
  auto done = [&] { return !best.tetrahedra.empty() && error(best.tetrahedra.size()) <= tolerance; };
  // the number goes with spacing^-3
  double nearest = spacing, nearestError = count;
  for (int i = 0; i < 10 && !done(); ++i) {
    const std::size_t n = attempt(spacing);
    if (error(n) < nearestError) nearestError = error(n), nearest = spacing;
    spacing *= n > 0 ? std::clamp(std::cbrt(double(n) / count), 0.5, 2.0) : 0.7;
  }
  // it jumps where points of the lattice enter the body: try around the nearest, up to 18 percent away
  for (int i = 1; i <= 30 && !done(); ++i) {
    attempt(nearest * (1 + 0.0002 * i * i));
    if (!done()) attempt(nearest / (1 + 0.0002 * i * i));
  }
  if (best.tetrahedra.empty())
    throw Error(where, text("the shape is too thin for ", count, " tetrahedra; ask for more"));
  return best;
}

}  // namespace sinew

#if SINEW_DEFINES
#include <array>
#include <bit>

namespace sinew::detail {

SINEW_ONCE std::vector<Tetrahedron> stuff(BccLattice const& lattice, bool skinOnly) {
  std::vector<Tetrahedron> tetrahedra;
  for_bcc_tetrahedra(lattice, skinOnly, [&](BccTetrahedron const& cell, std::array<int, 4> const& points) {
    stuff(lattice, cell, points, tetrahedra);
  });
  return tetrahedra;
}

}  // namespace sinew::detail
#endif
