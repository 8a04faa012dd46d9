// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/core/error.hpp>
#include <sinew/topology/bcc_lattice.hpp>
#include <sinew/topology/bcc_warp.hpp>
#include <sinew/topology/implicit_surface.hpp>
#include <sinew/topology/mesh.hpp>

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdlib>
#include <string_view>
#include <utility>
#include <vector>

// The third step of isosurface stuffing: what is inside of each lattice tetrahedron, as tetrahedra.

namespace sinew::detail {

/// A lattice tetrahedron seen from its first corner: two long edges, 0-1 and 2-3, joined by four short ones.
struct BccTetrahedron {
  std::array<int, 4> directions{};           // to the corners; unused for corner 0
  std::array<std::array<int, 4>, 4> edge{};  // direction from one corner to another
};

/// The 12 tetrahedra whose long edge 0-1 leads in a positive axis direction from a point; taken at the points
/// of even layers they fill space. All are positively oriented.
constexpr std::array<BccTetrahedron, 12> make_bcc_tetrahedra() {
  std::array<BccTetrahedron, 12> all{};
  constexpr int ring[5][2] = {{1, 1}, {-1, 1}, {-1, -1}, {1, -1}, {1, 1}};  // counterclockwise about the axis
  for (std::size_t axis = 0; axis < 3; ++axis)
    for (std::size_t r = 0; r < 4; ++r) {
      std::array<std::array<int, 3>, 4> x{};
      const std::size_t u = (axis + 1) % 3, v = (axis + 2) % 3;
      x[1][axis] = 2, x[2][axis] = 1, x[3][axis] = 1;
      x[2][u] = ring[r][0], x[2][v] = ring[r][1], x[3][u] = ring[r + 1][0], x[3][v] = ring[r + 1][1];
      BccTetrahedron& t = all[4 * axis + r];
      for (std::size_t i = 0; i < 4; ++i)
        for (std::size_t j = 0; j < 4; ++j)
          t.edge[i][j] = bcc_direction(x[j][0] - x[i][0], x[j][1] - x[i][1], x[j][2] - x[i][2]);
      t.directions = t.edge[0];
    }
  return all;
}

inline constexpr std::array<BccTetrahedron, 12> bccTetrahedra = make_bcc_tetrahedra();

/// Whether an odd number of coordinates fall in this direction.
constexpr bool falls_oddly(int direction) {
  int count = 0;
  for (const int x : bccDirections[std::size_t(direction)]) count += x < 0;
  return count % 2 == 1;
}

/// Appends the inside of one lattice tetrahedron: corners at lattice points p + ..., labels and cut points of
/// the lattice (figure 3 of the paper). Corners are numbered by lattice point, cut points by size() + cut
/// number.
inline void stuff(BccLattice const& lattice, BccTetrahedron const& cell, std::array<int, 4> const& points,
                  std::vector<Tetrahedron>& out) {
  auto label = [&](int corner) { return int(lattice.label[std::size_t(points[std::size_t(corner)])]); };
  int a = 0, b = 1, c = 2, d = 3;
  if (label(0) >= 0 && label(1) >= 0 && label(2) >= 0 && label(3) >= 0) {
    out.push_back({points[0], points[1], points[2], points[3]});
    return;
  }
  // ordered so that a is the most inside, a >= b, c >= d, (a, b) >= (c, d); odd swaps turn the tetrahedra
  // over
  bool odd = false;
  if (label(a) < label(b)) std::swap(a, b), odd = !odd;
  if (label(c) < label(d)) std::swap(c, d), odd = !odd;
  if (std::pair(label(a), label(b)) < std::pair(label(c), label(d))) std::swap(a, c), std::swap(b, d);

  auto at = [&](int i) { return points[std::size_t(i)]; };
  auto cut = [&](int i, int j) {
    return lattice.size() + lattice.cut_number(at(i), cell.edge[std::size_t(i)][std::size_t(j)]);
  };
  auto emit = [&](int i, int j, int k, int l) {
    if (odd) std::swap(k, l);
    out.push_back({i, j, k, l});
  };
  // a quad a, b, cut bd, cut ad over a long edge: its diagonal leaves from a or b, by the parity rule of the
  // paper, which both tetrahedra at the quad decide alike
  auto from_first = [&](int i, int j) { return !falls_oddly(cell.edge[std::size_t(i)][std::size_t(j)]); };
  auto pyramid = [&](int apex) {
    const int ad = cut(a, d), bd = cut(b, d);
    if (from_first(a, d)) {
      emit(at(a), at(b), apex, bd), emit(at(a), bd, apex, ad);
    } else {
      emit(at(a), at(b), apex, ad), emit(at(b), bd, apex, ad);
    }
  };

  if (label(b) > 0) {
    if (label(c) > 0) {  // + + + -
      emit(at(a), at(b), at(c), cut(c, d));
      pyramid(cut(c, d));
    } else if (label(c) == 0) {  // + + 0 -
      pyramid(at(c));
    } else {  // + + - -
      if (!from_first(a, c)) std::swap(c, d), odd = !odd;
      const int ac = cut(a, c), ad = cut(a, d), bc = cut(b, c), bd = cut(b, d);
      emit(at(a), ac, ad, bc), emit(at(a), at(b), bc, ad), emit(at(b), bd, bc, ad);
    }
  } else if (label(b) == 0) {
    if (label(c) > 0) {  // + 0 + -
      const int ad = cut(a, d), cd = cut(c, d);
      emit(at(a), at(b), at(c), cd), emit(at(a), at(b), cd, ad);
    } else if (label(c) == 0) {  // + 0 0 -
      emit(at(a), at(b), at(c), cut(a, d));
    } else {  // + 0 - -
      emit(at(a), at(b), cut(a, c), cut(a, d));
    }
  } else {
    const int ab = cut(a, b);
    if (label(c) > 0) {  // + - + -
      const int ad = cut(a, d), cb = cut(c, b), cd = cut(c, d);
      emit(at(a), ab, cd, ad), emit(at(a), ab, at(c), cd), emit(at(c), cd, ab, cb);
    } else if (label(c) == 0 && label(d) == 0) {  // + - 0 0
      emit(at(a), ab, at(c), at(d));
    } else if (label(c) == 0) {  // + - 0 -
      emit(at(a), ab, at(c), cut(a, d));
    } else {  // + - - -
      emit(at(a), ab, cut(a, c), cut(a, d));
    }
  }
}

/// The inside of all lattice tetrahedra, in the order of the lattice, numbered as above. `skinOnly` leaves
/// out lattice tetrahedra that are inside with all corners, which no boundary face belongs to.
inline std::vector<Tetrahedron> stuff(BccLattice const& lattice, bool skinOnly) {
  std::vector<Tetrahedron> tetrahedra;
  lattice.for_inner_points([&](int p, auto const& steps) {
    if (p / (lattice.sx * lattice.sy) % 2 != 0) return;
    for (BccTetrahedron const& cell : bccTetrahedra) {
      std::array<int, 4> points{p};
      int inside = 0;
      for (std::size_t i = 0; i < 4; ++i) {
        if (i > 0) points[i] = p + steps[std::size_t(cell.edge[0][i])];
        inside += lattice.label[std::size_t(points[i])] > 0;
      }
      if (inside > 0 && !(skinOnly && inside == 4)) stuff(lattice, cell, points, tetrahedra);
    }
  });
  return tetrahedra;
}

/// The points that the elements use; these then refer to them. In the order of the lattice, each lattice
/// point before the cut points of its edges.
template <class Element>
std::vector<Eigen::Vector3d> place_points(BccLattice const& lattice, std::vector<Element>& elements) {
  const int n = lattice.size();
  std::vector<Eigen::Vector3d> positions;
  std::vector<Index> number(std::size_t(n) + lattice.cuts.size(), -1);
  for (Element const& element : elements)
    for (const Index i : element) number[std::size_t(i)] = 0;
  auto used = [&](int i) {
    if (number[std::size_t(i)] < 0) return false;
    number[std::size_t(i)] = Index(positions.size());
    return true;
  };
  lattice.for_inner_points([&](int p, auto const&) {
    const int moved = lattice.snapped[std::size_t(p)];
    if (used(p))
      positions.push_back(moved < 0 ? lattice.lattice_position(p)
                                    : lattice.along(p, moved, lattice.cut_fraction(p, moved)));
    for (int d = 0; d < 7; ++d)
      if ((lattice.cutMask[std::size_t(p)] >> d & 1) != 0 && used(n + lattice.cut_number(p, d))) {
        const double alpha = bcc_alpha(d);
        positions.push_back(lattice.along(p, d, std::clamp(lattice.cut_fraction(p, d), alpha, 1 - alpha)));
      }
  });
  for (Element& element : elements)
    for (Index& i : element) i = number[std::size_t(i)];
  return positions;
}

/// The lattice after its first two steps, with the largest connected part of the body only.
template <ImplicitShape Shape>
BccLattice warped_bcc_lattice(std::string_view where, Shape const& shape, Eigen::Vector3d const& lo,
                              Eigen::Vector3d const& hi, double spacing) {
  BccLattice lattice = sample_bcc_lattice(where, shape, lo, hi, spacing);
  snap(lattice);
  unsnap_pinched(lattice);
  keep_largest_component(lattice);
  return lattice;
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
    throw Error(where, text("nothing of the shape is inside the box at a spacing of ", spacing,
                            "; the shape must be negative inside. Check the box, or reduce the spacing"));
}

}  // namespace sinew::detail

namespace sinew {

/// Tetrahedra that fill the solid shape(p) < 0 in the box, all with dihedral angles between 10.7 and 164.8
/// degrees, positively oriented (det(x1 - x0, x2 - x0, x3 - x0) > 0), with points on the surface where the
/// solid ends: isosurface stuffing (Labelle & Shewchuk 2007) on a body-centred cubic lattice. Of several
/// pieces the largest remains. Details smaller than the spacing are lost; yet the boundary is always a closed
/// manifold. `spacing` is the length of the longer lattice edges; there are about 12 volume / spacing^3
/// tetrahedra. Each lattice point is evaluated once, each cut edge a few times more. Throws Error on an empty
/// box, a spacing that is not positive or needs more than 2^28 lattice points, a shape that is not finite,
/// leaves the box, or has nothing inside that this spacing could see.
template <ImplicitShape Shape>
Mesh tetrahedralize(Shape const& shape, Eigen::Vector3d const& lo, Eigen::Vector3d const& hi,
                    double spacing) {
  Mesh mesh = detail::stuffed_mesh("tetrahedralize", shape, lo, hi, spacing);
  if (mesh.tetrahedra.empty())
    throw Error("tetrahedralize",
                text("nothing of the shape is inside the box at a spacing of ", spacing,
                     "; the shape must be negative inside. Check the box, or reduce the spacing"));
  return mesh;
}

/// tetrahedralize() with the spacing that gives nearly `count` tetrahedra: the first found within 0.5
/// percent, else the nearest of some 100 spacings around. Above 200 tetrahedra that is within 5 percent for
/// smooth shapes; below, the number can change in large steps only. Throws Error as tetrahedralize(), and
/// when count < 1.
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

  Mesh best;
  auto error = [&](std::size_t n) { return std::abs(double(n) - count); };
  auto attempt = [&](double spacing) {
    Mesh mesh = detail::stuffed_mesh(where, shape, lo, hi, spacing);
    const std::size_t n = mesh.tetrahedra.size();
    if (n > 0 && (best.tetrahedra.empty() || error(n) < error(best.tetrahedra.size())))
      best = std::move(mesh);
    return n;
  };
  const double tolerance = 0.005 * count;
  auto done = [&] { return !best.tetrahedra.empty() && error(best.tetrahedra.size()) <= tolerance; };
  // the number goes with spacing^-3
  double spacing = std::cbrt(12 * volume / count), nearest = spacing, nearestError = count;
  for (int i = 0; i < 10 && !done(); ++i) {
    const std::size_t n = attempt(spacing);
    if (error(n) < nearestError) nearestError = error(n), nearest = spacing;
    spacing *= n > 0 ? std::clamp(std::cbrt(double(n) / count), 0.5, 2.0) : 0.7;
  }
  // it jumps where layers of the lattice enter the body: try around the nearest
  for (int i = 1; i <= 45 && !done(); ++i) {
    attempt(nearest * (1 + 0.004 * i));
    if (!done()) attempt(nearest / (1 + 0.004 * i));
  }
  if (best.tetrahedra.empty())
    throw Error(where, text("the shape is too thin for ", count, " tetrahedra; ask for more"));
  return best;
}

}  // namespace sinew
