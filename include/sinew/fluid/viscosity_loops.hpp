// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/fluid/velocity_view.hpp>

namespace sinew::fluid {

/// A term of a dot product.
template <class Real>
struct Product {
  Real const *a, *b;
  SINEW_INLINE double operator()(std::ptrdiff_t i) const { return double(a[i]) * double(b[i]); }
};
struct CopyNumber {
  double* to;
  double const* from;
  SINEW_INLINE void operator()() const { *to = *from; }
};
/// The sum of one number for each axis.
template <int N>
struct SumOfNumbers {
  double *to, *from;
  SINEW_INLINE void operator()() const {
    *to = 0;
    for (int c = 0; c < N; ++c) *to += from[c];
  }
};

/// The equations of the faces across an axis (Viscosity), and bodies of loops over them.
template <class Real, int N>
struct ViscousFaces {
  VelocityView<Real, N> u;
  std::size_t axis;
  Real number;  // nu dt / h^2
  Real *x, *right, *residual, *direction, *product, *inverse;

  SINEW_INLINE bool moves(std::ptrdiff_t i) const { return u.kind[axis][i] == FaceKind::fluid; }
  /// coupled(neighbour) for faces that move, held(velocity, factor) for what holds the face i.
  template <class Coupled, class Held>
  SINEW_INLINE void around(std::ptrdiff_t i, Coupled&& coupled, Held&& held) const {
    const std::ptrdiff_t t = u.grid.stride[axis];
    for (std::size_t d = 0; d < axes<N>; ++d)
      for (int sign = -1; sign <= 1; sign += 2) {
        const std::ptrdiff_t j = i + sign * u.grid.stride[d];
        switch (u.kind[axis][j]) {
          case FaceKind::fluid:
            coupled(j);
            break;
          case FaceKind::wall:
            held(u.solid[axis][j], Real(1));
            break;
          case FaceKind::inside:
            if (u.cell[j] == CellKind::solid && u.cell[j - t] == CellKind::solid && !u.slips)
              held(u.solid[axis][j], Real(2));
            break;
        }
      }
  }
};

template <class Real, int N>
struct ViscousStart {
  ViscousFaces<Real, N> of;
  SINEW_INLINE void operator()(Each<int, N> const&, std::ptrdiff_t i) const {
    of.right[i] = of.residual[i] = of.direction[i] = of.product[i] = 0;
    if (!of.moves(i)) return;
    Real diagonal = 1, right = of.x[i];
    of.around(
        i,
        [&](std::ptrdiff_t) { diagonal += of.number; },
        [&](Real velocity, Real factor) {
          diagonal += factor * of.number;
          right += factor * of.number * velocity;
        });
    of.inverse[i] = 1 / diagonal;
    of.right[i] = right;
  }
};
template <class Real, int N>
struct ViscousMultiply {
  ViscousFaces<Real, N> of;
  Real const* v;
  SINEW_INLINE void operator()(Each<int, N> const&, std::ptrdiff_t i) const {
    if (!of.moves(i)) return;
    Real sum = v[i] / of.inverse[i];
    of.around(
        i, [&](std::ptrdiff_t j) { sum -= of.number * v[j]; }, [](Real, Real) {});
    of.product[i] = sum;
  }
};
template <class Real, int N>
struct ViscousResidual {
  ViscousFaces<Real, N> of;
  SINEW_INLINE void operator()(Each<int, N> const&, std::ptrdiff_t i) const {
    of.residual[i] = of.right[i] - of.product[i];
  }
};
template <class Real, int N>
struct ViscousWeighted {
  ViscousFaces<Real, N> of;
  SINEW_INLINE double operator()(std::ptrdiff_t i) const {
    return of.moves(i) ? double(of.residual[i]) * double(of.residual[i]) * double(of.inverse[i]) : 0.0;
  }
};
/// direction = M^-1 residual + now / before * direction
template <class Real, int N>
struct ViscousDirection {
  struct Known {
    ViscousFaces<Real, N> of;
    Real beta;
    SINEW_INLINE void operator()(Each<int, N> const&, std::ptrdiff_t i) const {
      if (of.moves(i)) of.direction[i] = of.inverse[i] * of.residual[i] + beta * of.direction[i];
    }
  };
  ViscousFaces<Real, N> of;
  double const *now, *before;
  bool goesOn;
  SINEW_INLINE Known ofThread() const { return {of, goesOn ? Real(*now / *before) : Real(0)}; }
};
/// x += alpha direction, residual -= alpha product
template <class Real, int N>
struct ViscousUpdate {
  struct Known {
    ViscousFaces<Real, N> of;
    Real alpha;
    SINEW_INLINE void operator()(Each<int, N> const&, std::ptrdiff_t i) const {
      if (!of.moves(i)) return;
      of.x[i] += alpha * of.direction[i];
      of.residual[i] -= alpha * of.product[i];
    }
  };
  ViscousFaces<Real, N> of;
  double const *rz, *curvature;
  SINEW_INLINE Known ofThread() const { return {of, Real(*rz / *curvature)}; }
};

}  // namespace sinew::fluid
