// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/core/compiled.hpp>
#include <sinew/core/mesh.hpp>
#include <sinew/topology/bcc_lattice.hpp>

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <vector>

// The third step of isosurface stuffing: what is inside of each lattice tetrahedron, as tetrahedra.

namespace sinew::detail {

/// A lattice tetrahedron seen from its first corner: two long edges, 0-1 and 2-3, joined by four short ones.
struct BccTetrahedron {
  std::array<std::array<int, 4>, 4> edge{};  // direction from one corner to another; -1 to itself
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
    }
  return all;
}

inline constexpr std::array<BccTetrahedron, 12> bccTetrahedra = make_bcc_tetrahedra();

/// Appends the inside of one lattice tetrahedron, whose corners are these lattice points. Where it is cut,
/// prisms and pyramids become tetrahedra; neighbours split a common quad alike, for its diagonal follows from
/// the quad alone: it ends at the cut point of the long edge, or else obeys the paper's parity rule. Lattice
/// points keep their numbers, cut points have size() + cut number.
void stuff(BccLattice const& lattice, BccTetrahedron const& cell, std::array<int, 4> const& points,
           std::vector<Tetrahedron>& out);

/// Calls body(cell, points) for each lattice tetrahedron with a corner inside, in the order of the lattice.
/// `skinOnly` leaves out those with all corners inside, which are whole and have no boundary face.
template <class Body>
void for_bcc_tetrahedra(BccLattice const& lattice, bool skinOnly, Body&& body) {
  lattice.for_inner_points([&](int p, auto const& steps) {
    if (p / (lattice.sx * lattice.sy) % 2 != 0) return;
    for (BccTetrahedron const& cell : bccTetrahedra) {
      std::array<int, 4> points{p};
      int inside = 0;
      for (std::size_t i = 0; i < 4; ++i) {
        if (i > 0) points[i] = p + steps[std::size_t(cell.edge[0][i])];
        inside += lattice.label[std::size_t(points[i])] > 0;
      }
      if (inside > 0 && !(skinOnly && inside == 4)) body(cell, points);
    }
  });
}

/// Smallest dihedral angle to accept, in degrees. The paper proves it for its stencils; for these, a search
/// over all positions of cut and moved points finds 9.2 to 161.7.
constexpr double bccSmallestAngle = 10.7;

/// Moves points back to the lattice where tetrahedra with corners on the surface have an angle below the
/// smallest: first the corner that moved the farthest. Without such corners all angles exceed 12.7 degrees,
/// so this ends well. True when a point moved.
bool unsnap_flattened(BccLattice& lattice);

}  // namespace sinew::detail

#if SINEW_DEFINES
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

namespace sinew::detail {

/// Whether an odd number of coordinates fall in this direction.
constexpr bool has_odd_sign(int direction) {
  int count = 0;
  for (const int x : bccDirections[std::size_t(direction)]) count += x < 0;
  return count % 2 == 1;
}

SINEW_ONCE void stuff(BccLattice const& lattice, BccTetrahedron const& cell, std::array<int, 4> const& points,
                      std::vector<Tetrahedron>& out) {
  auto label = [&](int corner) { return int(lattice.label[std::size_t(points[std::size_t(corner)])]); };
  int a = 0, b = 1, c = 2, d = 3;
  if (label(0) >= 0 && label(1) >= 0 && label(2) >= 0 && label(3) >= 0) {
    out.push_back({points[0], points[1], points[2], points[3]});
    return;
  }
  // order the corners by label: a >= b, c >= d, (a, b) >= (c, d); an odd number of swaps turns the results
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
  // parity rule, for the quad a, b, cut bd, cut ad whose cut edges are short: the diagonal leaves from the
  // one of a and b that exceeds d in an even number of coordinates
  auto from_first = [&](int i, int j) { return !has_odd_sign(cell.edge[std::size_t(i)][std::size_t(j)]); };
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

SINEW_ONCE bool unsnap_flattened(BccLattice& lattice) {
  bool any = false;
  std::vector<Tetrahedron> pieces;
  const double largest = std::cos(bccSmallestAngle * std::numbers::pi / 180);
  auto too_flat = [&](Tetrahedron const& t) {
    Eigen::Vector3d x[4], n[4];
    for (std::size_t i = 0; i < 4; ++i) x[i] = lattice.position(t[i]);
    for (std::size_t i = 0; i < 4; ++i) {  // inwards, opposite to point i, or all outwards
      const Eigen::Vector3d& o = x[(i + 1) % 4];
      n[i] = (i % 2 == 0 ? 1 : -1) * (x[(i + 2) % 4] - o).cross(x[(i + 3) % 4] - o).normalized();
    }
    for (std::size_t i = 0; i < 4; ++i)
      for (std::size_t j = i + 1; j < 4; ++j)
        if (-n[i].dot(n[j]) > largest) return true;
    return false;
  };
  for_bcc_tetrahedra(lattice, true, [&](BccTetrahedron const& cell, std::array<int, 4> const& points) {
    int farthest = -1;
    double distance = -1;
    for (const int p : points) {
      const int d = lattice.snapped[std::size_t(p)];
      if (lattice.label[std::size_t(p)] != 0) continue;
      const double moved = lattice.cut_fraction(p, d) / bcc_alpha(d);
      if (moved > distance) distance = moved, farthest = p;
    }
    if (farthest < 0) return;
    pieces.clear();
    stuff(lattice, cell, points, pieces);
    if (std::none_of(pieces.begin(), pieces.end(), too_flat)) return;
    lattice.unsnap(farthest);
    any = true;
  });
  return any;
}

}  // namespace sinew::detail
#endif
