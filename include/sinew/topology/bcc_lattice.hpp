// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/core/compiled.hpp>
#include <sinew/core/error.hpp>
#include <sinew/core/small_matrix.hpp>
#include <sinew/topology/implicit_surface.hpp>
#include <sinew/topology/regular_grid.hpp>

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <string_view>
#include <vector>

// The body-centred cubic lattice around an implicit surface: the first step of isosurface stuffing
// (Labelle & Shewchuk 2007, Isosurface stuffing: fast tetrahedral meshes with good dihedral angles).
// Two cubic lattices, one shifted by half a cell. Each point has 14 neighbours: 6 of its own lattice along
// the axes
// ("long" edges, length h) and 8 of the other along the diagonals of the cells ("short" edges, sqrt(3)/2 h).

namespace sinew::detail {

/// Edges from a lattice point in units of h/2. Direction d + 7 is opposite to d; 0 to 6 lead to later points.
// clang-format off
constexpr std::array<std::array<int, 3>, 14> bccDirections = {
    {{2, 0, 0},  {0, 2, 0},  {0, 0, 2},  {1, 1, 1},    {-1, 1, 1},  {1, -1, 1},  {-1, -1, 1},
     {-2, 0, 0}, {0, -2, 0}, {0, 0, -2}, {-1, -1, -1}, {1, -1, -1}, {-1, 1, -1}, {1, 1, -1}}};
// clang-format on

constexpr bool bcc_is_long(int direction) { return direction % 7 < 3; }

/// The direction of a difference of lattice points, in units of h/2; -1 when no edge joins such points.
constexpr int bcc_direction(int x, int y, int z) {
  for (std::size_t d = 0; d < 14; ++d)
    if (bccDirections[d][0] == x && bccDirections[d][1] == y && bccDirections[d][2] == z) return int(d);
  return -1;
}

/// A cut point nearer to an end of its edge than this fraction of the edge moves that end: the paper's values
/// for the best smallest angle. 0.25 on long edges could flatten a lattice tetrahedron altogether.
constexpr double bcc_alpha(int direction) { return bcc_is_long(direction) ? 0.24999 : 0.41189; }

/// Where f vanishes on the edge in a direction < 7 from a lattice point: 0 at the point, 1 at its other end.
struct BccCut {
  double fraction = 0;
  std::int32_t point = 0, direction = 0;
};

/// The field at the points (2i + c, 2j + c, k) h/2, c = k mod 2, and where the edges between them cross the
/// surface. 15 bytes a point and 16 a cut edge.
struct BccLattice {
  /// 2^28: point numbers and those of the cut edges, 7 a point at most, fit an int.
  static constexpr double maxPoints = 268435456;

  Eigen::Vector3d origin{Eigen::Vector3d::Zero()};
  double spacing = 0;                          // h
  int sx = 0, sy = 0, layers = 0;              // number of i, j, k
  std::array<std::array<int, 14>, 2> steps{};  // to the neighbours of points in even and odd layers

  std::vector<double> value{};         // f
  std::vector<signed char> label{};    // 1 inside, -1 outside, 0 on the surface, for it moved there
  std::vector<signed char> snapped{};  // direction of the edge along which it moved to the cut point, else -1
  std::vector<std::uint8_t> cutMask{};   // bit d: f changes sign on the edge in direction d < 7
  std::vector<std::int32_t> cutStart{};  // number of the first such edge of this point
  std::vector<BccCut> cuts{};

  int size() const { return sx * sy * layers; }
  std::array<int, 14> const& steps_of(int p) const { return steps[std::size_t(p / (sx * sy) % 2)]; }

  Eigen::Vector3d lattice_position(int p) const;
  /// The number of a cut edge, which leads from p in this direction.
  int cut_number(int p, int direction) const;
  /// Where the surface cuts that edge, from 0 at p to 1 at its other end.
  double cut_fraction(int p, int direction) const {
    const double t = cuts[std::size_t(cut_number(p, direction))].fraction;
    return direction < 7 ? t : 1 - t;
  }
  Eigen::Vector3d along(int p, int direction, double fraction) const;
  /// Position of a mesh point: of lattice point `number`, wherever it moved to, or of cut point number -
  /// size(). The latter keeps its distance from the ends of its edge, even where no end moved for it.
  Eigen::Vector3d position(int number) const;
  /// Moves a point back from the surface to the lattice.
  void unsnap(int p) {
    label[std::size_t(p)] = value[std::size_t(p)] < 0 ? 1 : -1;
    snapped[std::size_t(p)] = -1;
  }
  /// Calls body(p, steps) for the points of the box and one cell around it, in order. Two further cells of
  /// padding, all outside and never evaluated, spare the body bounds checks on neighbours of neighbours.
  template <class Body>
  void for_inner_points(Body&& body) const {
    for (int k = 4; k < layers - 4; ++k)
      for (int j = 2; j < sy - 2; ++j)
        for (int i = 2; i < sx - 2; ++i) body((k * sy + j) * sx + i, steps[std::size_t(k % 2)]);
  }
};

/// A lattice with its origin, sizes and steps, that covers the box. Throws Error on a bad box or spacing.
BccLattice empty_bcc_lattice(std::string_view where, Eigen::Vector3d const& lo, Eigen::Vector3d const& hi,
                             double spacing);

template <class Shape>
double finite_value(std::string_view where, Shape const& shape, Eigen::Vector3d const& p) {
  const double f = double(shape(p));
  if (!std::isfinite(f))
    throw Error(where,
                text("the shape gives ",
                     f,
                     " at (",
                     p[0],
                     ", ",
                     p[1],
                     ", ",
                     p[2],
                     "); it must give a finite number everywhere in and near the box"));
  return f;
}

/// The zero of f between a and b as a fraction of the way, where f(a) and f(b) have different signs: regula
/// falsi, Illinois variant (Dowell & Jarratt 1971), to 1e-9 of the edge; 3 or 4 evaluations when f is smooth.
template <class Shape>
double find_cut(std::string_view where, Shape const& shape, Eigen::Vector3d const& a,
                Eigen::Vector3d const& b, double fa, double fb) {
  double begin = 0, end = 1, last = -1;
  int side = 0;
  for (int iteration = 0; iteration < 60; ++iteration) {
    const double t = std::clamp(begin - fa * (end - begin) / (fb - fa), begin, end);
    if (std::abs(t - last) < 1e-9) return t;
    last = t;
    const double f = finite_value(where, shape, a + t * (b - a));
    if ((f < 0) == (fb < 0)) {
      end = t, fb = f;
      if (side == 1) fa /= 2;
      side = 1;
    } else {
      begin = t, fa = f;
      if (side == -1) fb /= 2;
      side = -1;
    }
  }
  return last;
}

/// Evaluates f once at each lattice point of the box, then finds the cut point of every edge that leads from
/// inside to outside. Throws Error on a bad box or spacing, a value that is not finite, a body that leaves
/// the box.
template <ImplicitShape Shape>
BccLattice sample_bcc_lattice(std::string_view where, Shape const& shape, Eigen::Vector3d const& lo,
                              Eigen::Vector3d const& hi, double spacing) {
  BccLattice lattice = empty_bcc_lattice(where, lo, hi, spacing);
  const auto n = std::size_t(lattice.size());
  lattice.value.assign(n, std::numeric_limits<double>::infinity());
  lattice.label.assign(n, -1);
  lattice.snapped.assign(n, -1);
  lattice.cutMask.assign(n, 0);
  lattice.cutStart.assign(n, 0);
  const double tolerance = 1e-9 * spacing;
  lattice.for_inner_points([&](int p, auto const&) {
    const Eigen::Vector3d x = lattice.lattice_position(p);
    const double f = lattice.value[std::size_t(p)] = finite_value(where, shape, x);
    if (!(f < 0)) return;
    lattice.label[std::size_t(p)] = 1;
    if (((lo - x).cwiseMax(x - hi).array() > tolerance).any())
      throw Error(where,
                  text("the body leaves the box: the shape is negative at (",
                       x[0],
                       ", ",
                       x[1],
                       ", ",
                       x[2],
                       "); enlarge the box, or intersect the shape with it"));
  });
  lattice.for_inner_points([&](int p, auto const& steps) {
    lattice.cutStart[std::size_t(p)] = std::int32_t(lattice.cuts.size());
    for (int d = 0; d < 7; ++d) {
      const int q = p + steps[std::size_t(d)];
      if (lattice.label[std::size_t(p)] == lattice.label[std::size_t(q)]) continue;
      lattice.cutMask[std::size_t(p)] = std::uint8_t(lattice.cutMask[std::size_t(p)] | (1u << d));
      const double t = find_cut(where,
                                shape,
                                lattice.lattice_position(p),
                                lattice.lattice_position(q),
                                lattice.value[std::size_t(p)],
                                lattice.value[std::size_t(q)]);
      lattice.cuts.push_back({t, p, d});
    }
  });
  return lattice;
}

}  // namespace sinew::detail

#if SINEW_DEFINES
#include <bit>

namespace sinew::detail {

SINEW_ONCE Eigen::Vector3d BccLattice::lattice_position(int p) const {
  const int k = p / (sx * sy), j = p / sx % sy, i = p % sx;
  return origin + spacing / 2 * Eigen::Vector3d(2 * i + k % 2, 2 * j + k % 2, k);
}

SINEW_ONCE int BccLattice::cut_number(int p, int direction) const {
  const int first = direction < 7 ? p : p + steps_of(p)[std::size_t(direction)];
  const auto before = std::uint8_t((1u << (direction % 7)) - 1);
  return cutStart[std::size_t(first)] + std::popcount(std::uint8_t(cutMask[std::size_t(first)] & before));
}

SINEW_ONCE Eigen::Vector3d BccLattice::along(int p, int direction, double fraction) const {
  auto const& [x, y, z] = bccDirections[std::size_t(direction)];
  return lattice_position(p) + fraction * spacing / 2 * Eigen::Vector3d(x, y, z);
}

SINEW_ONCE Eigen::Vector3d BccLattice::position(int number) const {
  if (number < size()) {
    const int moved = snapped[std::size_t(number)];
    return moved < 0 ? lattice_position(number) : along(number, moved, cut_fraction(number, moved));
  }
  BccCut const& cut = cuts[std::size_t(number - size())];
  const double alpha = bcc_alpha(cut.direction);
  return along(cut.point, cut.direction, std::clamp(cut.fraction, alpha, 1 - alpha));
}

SINEW_ONCE BccLattice empty_bcc_lattice(std::string_view where, Eigen::Vector3d const& lo,
                                        Eigen::Vector3d const& hi, double spacing) {
  if (!all_finite(lo) || !all_finite(hi) || !(lo.array() < hi.array()).all())
    detail::refuse_box(where, lo, hi);
  if (!(spacing > 0) || !std::isfinite(spacing))
    throw Error(where, text("the spacing is ", spacing, "; it must be a positive length"));
  const Eigen::Array3d cells = ((hi - lo).array() / spacing - 1e-9).ceil().max(1);
  const double points = (cells[0] + 7) * (cells[1] + 7) * (2 * cells[2] + 13);
  if (!(points <= BccLattice::maxPoints))
    throw Error(where,
                text("a spacing of ",
                     spacing,
                     " needs ",
                     points,
                     " lattice points in this box; at most ",
                     BccLattice::maxPoints,
                     " (2^28) are possible. Enlarge the spacing or shrink the box"));
  BccLattice lattice;
  lattice.spacing = spacing;
  lattice.sx = int(cells[0]) + 7;
  lattice.sy = int(cells[1]) + 7;
  lattice.layers = 2 * int(cells[2]) + 13;
  lattice.origin = (lo + hi) / 2 - spacing * (cells / 2 + 3).matrix();
  for (int c = 0; c < 2; ++c)
    for (std::size_t d = 0; d < 14; ++d) {
      auto const& [x, y, z] = bccDirections[d];
      const int i = (x + c + 2) / 2 - 1, j = (y + c + 2) / 2 - 1;  // floor((x + c) / 2)
      lattice.steps[std::size_t(c)][d] = (z * lattice.sy + j) * lattice.sx + i;
    }
  return lattice;
}

}  // namespace sinew::detail
#endif
