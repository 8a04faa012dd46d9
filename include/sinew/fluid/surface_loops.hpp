// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/fluid/velocity_view.hpp>

namespace sinew::fluid {

// Bodies of loops over the signed distances of cells from a free surface (LevelSet).

SINEW_INLINE bool in_fluid(auto distance) { return distance < 0; }

/// Values in the layer around are those next to it, or at the other end of a periodic axis.
template <class Real>
struct FillFromInside {
  Real* field;
  bool periodic;
  SINEW_INLINE void operator()(std::ptrdiff_t outer, std::ptrdiff_t inner, std::ptrdiff_t other, int) const {
    field[outer] = field[periodic ? other : inner];
  }
};

/// Whether a distance is kept and carried along.
template <class Real>
struct InBand {
  Real const* value;
  CellKind const* cell;
  Real band;
  SINEW_INLINE bool operator()(std::ptrdiff_t i) const {
    return std::abs(value[i]) < band && cell[i] != CellKind::solid;
  }
};

/// next = value, in solids the mean of what is beside them.
template <class Real, int N>
struct FillSolids {
  CellGrid<N> grid;
  CellKind const* cell;
  Real const* value;
  Real* next;

  SINEW_INLINE void operator()(Each<int, N> const&, std::ptrdiff_t i) const {
    next[i] = value[i];
    if (cell[i] != CellKind::solid) return;
    Real sum = 0;
    int count = 0;
    for (std::size_t c = 0; c < axes<N>; ++c)
      for (int side = -1; side <= 1; side += 2) {
        const std::ptrdiff_t j = i + side * grid.stride[c];
        if (cell[j] != CellKind::solid) sum += value[j], ++count;
      }
    if (count > 0) next[i] = sum / Real(count);
  }
};

/// Distances next to the surface by the slope there; they are fixed. Others are far.
template <class Real, int N>
struct FixNearSurface {
  CellGrid<N> grid;
  Real const* value;
  Real* next;
  std::uint8_t* fixed;
  Real band;

  SINEW_INLINE void operator()(Each<int, N> const&, std::ptrdiff_t i) const {
    const Real here = value[i];
    bool beside = false;
    Real slope = 0;
    for (std::size_t c = 0; c < axes<N>; ++c) {
      const Real below = value[i - grid.stride[c]], above = value[i + grid.stride[c]];
      beside = beside || in_fluid(below) != in_fluid(here) || in_fluid(above) != in_fluid(here);
      const Real most =
          std::max(std::max(std::abs(here - below), std::abs(above - here)), std::abs(above - below) / 2);
      slope += most * most;
    }
    fixed[i] = beside;
    // a slope of about 1 is let be, since each correction roughens the surface a little
    const Real correction =
        slope > Real(0.25) && slope < 4 ? Real(1) : 1 / std::sqrt(std::max(slope, Real(1e-12)));
    next[i] = beside ? here * correction : (in_fluid(here) ? -band : band);
  }
};

/// Distances of a cell further away from those of its neighbours, |grad d| = 1.
template <class Real, int N>
struct ExtendDistance {
  CellGrid<N> grid;
  Real const* value;
  Real* next;
  std::uint8_t const* fixed;
  Real band;

  SINEW_INLINE void operator()(Each<int, N> const&, std::ptrdiff_t i) const {
    const Real here = value[i];
    if (fixed[i]) {
      next[i] = here;
      return;
    }
    Each<Real, N> nearest;
    Real least = band;
    for (std::size_t c = 0; c < axes<N>; ++c) {
      nearest[c] = std::min(std::abs(value[i - grid.stride[c]]), std::abs(value[i + grid.stride[c]]));
      least = std::min(least, nearest[c]);
    }
    const Real far = std::abs(here);
    const Real distance = least < band - 1 || far < band ? std::min(far, upwind(nearest)) : far;
    next[i] = std::copysign(std::min(distance, band), here);
  }

 private:
  SINEW_INLINE static void order(Real& a, Real& b) {
    const Real low = b < a ? b : a;
    b = b < a ? a : b;
    a = low;
  }
  // d of sum over axes of max(d - nearest, 0)^2 = 1
  SINEW_INLINE static Real upwind(Each<Real, N> a) {
    order(a[0], a[1]);
    if constexpr (N == 3) order(a[1], a[2]), order(a[0], a[1]);
    Real d = a[0] + 1;
    if (d <= a[1]) return d;
    Real sum = a[0] + a[1], product = a[0] - a[1];
    d = (sum + std::sqrt(std::max(Real(0), 2 - product * product))) / 2;
    if constexpr (N == 3) {
      if (d <= a[2]) return d;
      sum += a[2];
      const Real squares = a[0] * a[0] + a[1] * a[1] + a[2] * a[2];
      d = (sum + std::sqrt(std::max(Real(0), sum * sum - 3 * (squares - 1)))) / 3;
    }
    return d;
  }
};

/// What of a cell is fluid when the surface is moved outwards by an offset [cells], as of a plane across an
/// axis; or whether it crosses the cell.
template <class Real>
struct PartOfCell {
  CellKind const* cell;
  Real const* value;
  Real const* room;  // outside solids; none: they leave it all
  double offset;
  bool crosses;

  SINEW_INLINE double operator()(std::ptrdiff_t i) const {
    if (cell[i] == CellKind::solid) return 0.0;
    const double part = 0.5 - double(value[i]) + offset;
    return (room ? double(room[i]) : 1.0) * (crosses      ? (part > 0 && part < 1 ? 1.0 : 0.0)
                                             : part < 0.0 ? 0.0
                                             : 1.0 < part ? 1.0
                                                          : part);
  }
};

template <class Real, int N>
struct MoveSurface {
  Real* value;
  Real offset, band;
  SINEW_INLINE void operator()(Each<int, N> const&, std::ptrdiff_t i) const {
    const Real moved = value[i] - offset;
    value[i] = moved < -band ? -band : (band < moved ? band : moved);
  }
};

}  // namespace sinew::fluid
