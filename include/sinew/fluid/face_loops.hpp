// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/fluid/velocity_view.hpp>

namespace sinew::fluid {

// Bodies of loops over the faces of cells across an axis (StaggeredVelocity); arguments are the place and
// index of a cell, or what CellGrid::forSides gives.

/// Of the lower faces of cells, and of the last ones.
template <int N>
struct ClassifyFaces {
  CellKind const* cell;
  FaceKind* kind;
  std::ptrdiff_t stride;

  SINEW_INLINE void operator()(Each<int, N> const&, std::ptrdiff_t i) const {
    kind[i] = kind_between(cell[i - stride], cell[i]);
  }
  SINEW_INLINE void operator()(std::ptrdiff_t outer, std::ptrdiff_t inner, std::ptrdiff_t, int side) const {
    if (side == 1) kind[outer] = kind_between(cell[inner], cell[outer]);
  }
};

template <class Real, int N>
struct HoldWalls {
  FaceKind const* kind;
  Real const* solid;
  Real* value;

  SINEW_INLINE void operator()(Each<int, N> const&, std::ptrdiff_t i) const {
    if (kind[i] == FaceKind::wall) value[i] = solid[i];
  }
  SINEW_INLINE void operator()(std::ptrdiff_t outer, std::ptrdiff_t, std::ptrdiff_t, int side) const {
    if (side == 1) (*this)(Each<int, N>{}, outer);
  }
};

/// Of a component in the layer around.
template <class Real>
struct FillFaces {
  Real* field;
  Real const* solid;
  bool periodic, across, slips;  // along this axis; it is that of the component

  SINEW_INLINE void operator()(std::ptrdiff_t outer, std::ptrdiff_t inner, std::ptrdiff_t other,
                               int side) const {
    if (periodic) {
      field[outer] = field[other];
    } else if (across) {
      const std::ptrdiff_t face = side == 0 ? inner : outer;
      field[face] = solid[face];
    } else {
      field[outer] = slips ? field[inner] : 2 * solid[outer] - field[inner];
    }
  }
};

template <class Real>
struct Speed {
  Real const* value;
  SINEW_INLINE double operator()(std::ptrdiff_t i) const { return std::abs(double(value[i])); }
};

/// Faces of an unknown velocity become those of layer `number` and get the mean of their neighbours in layers
/// below it, if there are some. What another thread makes of a neighbour meanwhile is no layer below.
template <class Real, int N>
struct OutwardMeans {
  static constexpr std::uint8_t unknown = 255;
  CellGrid<N> grid;
  Real* field;
  std::uint8_t* layer;
  int number;

  SINEW_INLINE void operator()(Each<int, N> const& at, std::ptrdiff_t i) const {
    if (layer[i] != unknown) return;
    if (take(at, i, number)) layer[i] = std::uint8_t(number);
  }
  SINEW_INLINE bool take(Each<int, N> const& at, std::ptrdiff_t i, int l) const {
    Real sum = 0;
    int count = 0;
    grid.forNeighbours(at, i, [&](std::ptrdiff_t j) {
      if (layer[j] < l) sum += field[j], ++count;
    });
    if (count > 0) field[i] = sum / Real(count);
    return count > 0;
  }
};
template <class Real, int N>
struct KnownFaces {
  OutwardMeans<Real, N> to;
  FaceKind const* kind;

  SINEW_INLINE void operator()(Each<int, N> const&, std::ptrdiff_t i) const {
    const bool known = kind[i] != FaceKind::inside;
    to.layer[i] = known ? 0 : OutwardMeans<Real, N>::unknown;
    if (!known) to.field[i] = 0;
  }
};
/// Where fluid sticks to solids, what is inside one mirrors what is outside.
template <class Real, int N>
struct MirrorInSolids {
  OutwardMeans<Real, N> of;
  CellKind const* cell;
  Real const* solid;
  std::ptrdiff_t stride;

  SINEW_INLINE void operator()(Each<int, N> const&, std::ptrdiff_t i) const {
    if (of.layer[i] == 1 && cell[i] == CellKind::solid && cell[i - stride] == CellKind::solid)
      of.field[i] = 2 * solid[i] - of.field[i];
  }
};

}  // namespace sinew::fluid
