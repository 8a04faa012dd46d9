// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/fluid/cell_grid.hpp>

#include <Eigen/Core>
#include <algorithm>
#include <cmath>

namespace sinew::fluid {

enum class CellKind : std::uint8_t { fluid, air, solid };
/// Of the faces of cells: pressure drives those beside a fluid cell, a solid on one side holds others, and
/// what is inside air or inside solids follows from those around it.
enum class FaceKind : std::uint8_t { fluid, wall, inside };
SINEW_INLINE FaceKind kind_between(CellKind a, CellKind b) {
  if (a == CellKind::solid || b == CellKind::solid) return a == b ? FaceKind::inside : FaceKind::wall;
  return a == CellKind::fluid || b == CellKind::fluid ? FaceKind::fluid : FaceKind::inside;
}

/// What loops read of a StaggeredVelocity, where they run.
template <class Real, int N>
struct VelocityView {
  using Vector = Eigen::Matrix<Real, N, 1>;

  CellGrid<N> grid;
  bool slips;
  CellKind const* cell;
  Each<FaceKind const*, N> kind;
  Each<Real const*, N> value, solid;

  /// The value of a field at a place, multilinear. Its cells have theirs in their centres, or in the middle
  /// of their lower faces across axis c (-1: none). `low` and `high` take the least and largest of the values
  /// around.
  template <bool Bounds = false>
  SINEW_INLINE Real interpolate(Real const* field, int c, Vector const& x, Real* low = nullptr,
                                Real* high = nullptr) const {
    auto along = [&](int d) { return Along(x[d] + (d == c ? Real(1) : Real(0.5)), grid, d); };
    const Along i = along(0), j = along(1);
    if constexpr (N == 2) {
      return face<Bounds>(field + i.base + j.base, i.fraction, j.fraction, low, high);
    } else {
      const Along k = along(2);
      return between<Bounds>(field + i.base + j.base + k.base, i.fraction, j.fraction, k.fraction, low, high);
    }
  }
  SINEW_INLINE Vector velocity(Vector const& x) const {
    const Along fi(x[0] + 1, grid, 0), i(x[0] + Real(0.5), grid, 0), fj(x[1] + 1, grid, 1),
        j(x[1] + Real(0.5), grid, 1);
    if constexpr (N == 2) {
      return {face(value[0] + fi.base + j.base, fi.fraction, j.fraction),
              face(value[1] + i.base + fj.base, i.fraction, fj.fraction)};
    } else {
      const Along fk(x[2] + 1, grid, 2), k(x[2] + Real(0.5), grid, 2);
      return {between(value[0] + fi.base + j.base + k.base, fi.fraction, j.fraction, k.fraction),
              between(value[1] + i.base + fj.base + k.base, i.fraction, fj.fraction, k.fraction),
              between(value[2] + i.base + j.base + fk.base, i.fraction, j.fraction, fk.fraction)};
    }
  }
  /// A place brought back into the grid: to the other end along periodic axes, onto the walls along others.
  SINEW_INLINE Vector inside(Vector x) const {
    for (int d = 0; d < N; ++d) {
      const Real n = Real(grid.cells[std::size_t(d)]);
      if (grid.periodic[std::size_t(d)]) x[d] -= std::floor(x[d] / n) * n;
      x[d] = std::min(n, std::max(Real(0), x[d]));
    }
    return x;
  }
  /// Where what is at x has come from, a step ago in units of cells per velocity, by the midpoint rule; u is
  /// the velocity at x.
  SINEW_INLINE Vector trace(Vector const& x, Vector const& u, Real step) const {
    return inside(x - step * velocity(inside(x - step / 2 * u)));
  }
  /// The velocity in the middle of a face of axis c, or in the centre of a cell (-1).
  SINEW_INLINE Vector velocityAt(int c, std::ptrdiff_t i) const {
    Vector u;
    for (int d = 0; d < N; ++d) {
      Real const* field = value[std::size_t(d)];
      const std::ptrdiff_t s = grid.stride[std::size_t(d)];
      if (d == c) {
        u[d] = field[i];
      } else if (c < 0) {
        u[d] = (field[i] + field[i + s]) / 2;
      } else {
        const std::ptrdiff_t t = grid.stride[std::size_t(c)];
        u[d] = (field[i] + field[i + s] + field[i - t] + field[i - t + s]) / 4;
      }
    }
    return u;
  }

 private:
  // between which two values along an axis a place is
  struct Along {
    std::ptrdiff_t base;
    Real fraction;
    SINEW_INLINE Along(Real place, CellGrid<N> const& grid, int d) {
      const int first = std::min(int(place), grid.cells[std::size_t(d)]);
      base = first * grid.stride[std::size_t(d)];
      fraction = place - Real(first);
    }
  };
  // linear between the values at an edge, of a square, and of a cube
  template <bool Bounds = false>
  SINEW_INLINE static Real edge(Real const* at, Real x, Real* low = nullptr, Real* high = nullptr) {
    const Real a = at[0], b = at[1];
    if constexpr (Bounds) {
      *low = std::min(*low, std::min(a, b));
      *high = std::max(*high, std::max(a, b));
    }
    return a + x * (b - a);
  }
  template <bool Bounds = false>
  SINEW_INLINE Real face(Real const* at, Real x, Real y, Real* low = nullptr, Real* high = nullptr) const {
    const Real a = edge<Bounds>(at, x, low, high), b = edge<Bounds>(at + grid.stride[1], x, low, high);
    return a + y * (b - a);
  }
  template <bool Bounds = false>
  SINEW_INLINE Real between(Real const* at, Real x, Real y, Real z, Real* low = nullptr,
                            Real* high = nullptr) const {
    const Real a = face<Bounds>(at, x, y, low, high), b = face<Bounds>(at + grid.stride[2], x, y, low, high);
    return a + z * (b - a);
  }
};

}  // namespace sinew::fluid
