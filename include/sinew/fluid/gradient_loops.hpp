// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/fluid/multigrid_loops.hpp>

namespace sinew::fluid {

// Bodies of the loops of conjugate gradients (PoissonMultigrid). Terms of sums may change what is of their
// cell.

template <class Real>
struct SquareOf {
  Real const* a;
  SINEW_INLINE double operator()(std::ptrdiff_t i) const { return double(a[i]) * double(a[i]); }
};
template <class Real>
struct DotOf {
  Real const *a, *b;
  SINEW_INLINE double operator()(std::ptrdiff_t i) const { return double(a[i]) * double(b[i]); }
};

/// y = A x
template <class Real, int N>
struct Multiply {
  LevelView<Real, N> level;
  Real const* x;
  Real* y;
  SINEW_INLINE void operator()(Each<int, N> const&, std::ptrdiff_t i) const {
    const Real inverse = level.inverse[i];
    y[i] = inverse > 0 ? x[i] / inverse - level.around(x, i) : Real(0);
  }
};
/// x.y, y = A x
template <class Real, int N>
struct MultiplyAndDot {
  Multiply<Real, N> multiply;
  SINEW_INLINE double operator()(std::ptrdiff_t i) const {
    multiply({}, i);
    return double(multiply.x[i]) * double(multiply.y[i]);
  }
};
/// |b - y|^2, and b is that.
template <class Real>
struct TakeProduct {
  Real* b;
  Real const* y;
  SINEW_INLINE double operator()(std::ptrdiff_t i) const {
    b[i] -= y[i];
    return double(b[i]) * double(b[i]);
  }
};
/// b as before, x = 0.
template <class Real, int N>
struct ForgetGuess {
  Real* b;
  Real const* y;
  Real* x;
  SINEW_INLINE void operator()(Each<int, N> const&, std::ptrdiff_t i) const {
    b[i] += y[i];
    x[i] = Real(0);
  }
};

/// beta = - alpha z.y / r.z of the step before
struct Turn {
  double* beta;
  double const *mixed, *alpha, *rz;
  bool goesOn;
  SINEW_INLINE void operator()() const { *beta = goesOn && *rz != 0 ? -*alpha * *mixed / *rz : 0; }
};
/// alpha = r.z / d.y
struct Step {
  double* alpha;
  double const *rz, *curvature;
  SINEW_INLINE void operator()() const { *alpha = *rz / *curvature; }
};

/// d = z + beta d, z at first
template <class Real, int N>
struct TakeDirection {
  struct Known {
    Real const* z;
    Real* d;
    Real beta;
    bool goesOn;
    SINEW_INLINE void operator()(Each<int, N> const&, std::ptrdiff_t i) const {
      d[i] = goesOn ? z[i] + beta * d[i] : z[i];
    }
  };
  Real const* z;
  Real* d;
  double const* beta;
  bool goesOn;
  SINEW_INLINE Known ofThread() const { return {z, d, Real(*beta), goesOn}; }
};
/// |b|^2, x += alpha d, b -= alpha y; nothing changes where the curvature is not positive.
template <class Real>
struct Advance {
  struct Known {
    Real* x;
    Real const* d;
    Real* b;
    Real const* y;
    Real alpha;
    bool goes;
    SINEW_INLINE double operator()(std::ptrdiff_t i) const {
      if (goes) {
        x[i] += alpha * d[i];
        b[i] -= alpha * y[i];
      }
      return double(b[i]) * double(b[i]);
    }
  };
  Real* x;
  Real const* d;
  Real* b;
  Real const* y;
  double const *alpha, *curvature;
  SINEW_INLINE Known ofThread() const { return {x, d, b, y, Real(*alpha), *curvature > 0}; }
};

}  // namespace sinew::fluid
