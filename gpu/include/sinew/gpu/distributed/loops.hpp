// SPDX-License-Identifier: BSL-1.0
#pragma once

// What the threads of a part of a body do. Loops over its own points go first over those that others have in
// their halos, which send what they have found, then over the inner ones while that is on its way.

#include <sinew/gpu/block_rows.hpp>
#include <sinew/gpu/distributed/devices.hpp>
#include <sinew/gpu/distributed/partition.hpp>

namespace sinew::gpu::distributed {

/// body(first + i)
template <class Body>
struct From {
  Body body;
  int first;
  SINEW_HD void operator()(int i) const { body(first + i); }
};

/// A vector in the halos of others: point `inner` + k of the part is there at places[first[k] ..].
template <class T>
struct InHalos {
  int const* first;
  BodyPart::Place const* places;
  int inner;
  std::array<T*, most_devices> of;  // of each part, its memory
  SINEW_INLINE void send(int i, T const& value) const {
    if (i < inner) return;
    for (int k = first[i - inner]; k < first[i - inner + 1]; ++k)
      of[std::size_t(places[k].part)][places[k].point] = value;
  }
};

/// The numbers of one solve by conjugate gradients, as CgScalars has them.
struct Scalars {
  double const *size, *curvature;  // of all parts, number after number
  int parts;
  double tolerance2, threshold;

  SINEW_INLINE double sizeOf(int i) const { return SharedSum{size + i * parts, parts}(); }
  SINEW_INLINE double curvatureOf(int i) const { return SharedSum{curvature + i * parts, parts}(); }
  /// Whether iteration i changes anything; one that has nothing left to do does not.
  SINEW_INLINE bool goesOn(int i) const {
    const double c = curvatureOf(i);
    return sizeOf(i) > tolerance2 * sizeOf(0) && (c > threshold || c < -threshold);
  }
  SINEW_INLINE double alpha(int i) const { return goesOn(i) ? sizeOf(i) / curvatureOf(i) : 0; }
  SINEW_INLINE double beta(int i) const { return sizeOf(i + 1) / sizeOf(i); }
};

/// f = m g
template <class D>
struct Weigh {
  typename D::Deriv* f;
  typename D::Real const* mass;
  typename D::Deriv gravity;
  SINEW_HD void operator()(int i) const { f[i] = mass[i] * gravity; }
};

/// The right-hand side h (f - rM M v), with K v in f, without what is held: r = p = b, x = 0; b.b.
template <class D>
struct Begin {
  using Real = typename D::Real;
  typename D::Deriv const *f, *v;
  Real const* mass;
  unsigned char const* held;
  Real h, rayleighMass;
  typename D::Deriv *x, *r, *p;
  SINEW_HD double operator()(int i) const {
    double size = 0;
    const Real m = rayleighMass * mass[i];
    for (int c = 0; c < 3; ++c) {
      const Real b = held[i] >> c & 1 ? Real(0) : h * (f[i][c] - m * v[i][c]);
      r[i][c] = p[i][c] = b;
      x[i][c] = Real(0);
      size += double(b) * double(b);
    }
    return size;
  }
};
template <class T>
struct Send {
  T const* from;
  InHalos<T> halos;
  SINEW_HD void operator()(int i) const { halos.send(i, from[i]); }
};
/// q = A p of a row, without what is held; p.q.
template <class D>
struct Product {
  typename BlockRows<D>::RowProduct product;
  unsigned char const* held;
  SINEW_HD double operator()(int row) const {
    typename D::Real sum[3];
    product.rowOf(row, sum);
    double total = 0;
    for (int c = 0; c < 3; ++c) {
      const auto value = held[row] >> c & 1 ? typename D::Real(0) : sum[c];
      product.r[row][c] = value;
      total += double(value) * double(product.x[row][c]);
    }
    return total;
  }
};
/// x += alpha p, r -= alpha q of iteration i, for each scalar; r.r.
template <class Real>
struct Advance {
  Real *x, *r;
  Real const *p, *q;
  Scalars s;
  int iteration;
  struct OfThread {
    Real *x, *r;
    Real const *p, *q;
    Real alpha;
    SINEW_HD double operator()(int k) const {
      x[k] += alpha * p[k];
      const Real left = r[k] - alpha * q[k];
      r[k] = left;
      return double(left) * double(left);
    }
  };
  SINEW_HD OfThread ofThread() const { return {x, r, p, q, Real(s.alpha(iteration))}; }
};
/// p = r + beta p behind iteration i, of a point; a solve that has ended keeps its p.
template <class D>
struct Direction {
  using Real = typename D::Real;
  typename D::Deriv* p;
  typename D::Deriv const* r;
  Scalars s;
  int iteration;
  InHalos<typename D::Deriv> halos;
  SINEW_HD void operator()(int i) const {
    if (!s.goesOn(iteration)) return;
    p[i] = r[i] + Real(s.beta(iteration)) * p[i];
    halos.send(i, p[i]);
  }
};
/// v += dv, x += h v, v *= kept
template <class D>
struct MoveImplicitly {
  using Real = typename D::Real;
  typename D::Coord* x;
  typename D::Deriv* v;
  typename D::Deriv const* dv;
  Real h, kept;
  InHalos<typename D::Coord> halosOfX;
  InHalos<typename D::Deriv> halosOfV;
  SINEW_HD void operator()(int i) const {
    const typename D::Deriv speed = v[i] + dv[i];
    x[i] += h * speed;
    v[i] = kept * speed;
    halosOfX.send(i, x[i]);
    halosOfV.send(i, v[i]);
  }
};
/// a = M^-1 f without what is held; v += h a, x += h v with the new v where that is symplectic.
template <class D>
struct MoveExplicitly {
  using Real = typename D::Real;
  typename D::Coord* x;
  typename D::Deriv* v;
  typename D::Deriv const* f;
  Real const* mass;
  unsigned char const* held;
  Real h;
  bool symplectic, sendsVelocity;
  InHalos<typename D::Coord> halosOfX;
  InHalos<typename D::Deriv> halosOfV;
  SINEW_HD void operator()(int i) const {
    const typename D::Deriv before = v[i];
    typename D::Deriv speed = before;
    for (int c = 0; c < 3; ++c)
      if (!(held[i] >> c & 1)) speed[c] += h * (f[i][c] / mass[i]);
    v[i] = speed;
    x[i] += h * (symplectic ? speed : before);
    halosOfX.send(i, x[i]);
    if (sendsVelocity) halosOfV.send(i, speed);
  }
};

}  // namespace sinew::gpu::distributed
