// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/core/data_types.hpp>

#include <Eigen/Core>
#include <algorithm>
#include <vector>

namespace sinew::vec {

/// The scalars of a vector of derivatives, one after the other, as one Eigen vector.
template <class Deriv>
auto flat(std::vector<Deriv>& v) {
  using Real = typename Deriv::Scalar;
  return Eigen::Map<Eigen::Matrix<Real, Eigen::Dynamic, 1>>(
      v.empty() ? nullptr : v.data()->data(), Eigen::Index(v.size()) * Deriv::SizeAtCompileTime);
}
template <class Deriv>
auto flat(std::vector<Deriv> const& v) {
  using Real = typename Deriv::Scalar;
  return Eigen::Map<Eigen::Matrix<Real, Eigen::Dynamic, 1> const>(
      v.empty() ? nullptr : v.data()->data(), Eigen::Index(v.size()) * Deriv::SizeAtCompileTime);
}

/// r = 0
template <class V>
void clear(V& r) {
  flat(r).setZero();
}

/// r = a
template <class V>
void eq(V& r, V const& a) {
  std::copy(a.begin(), a.end(), r.begin());
}

/// r += f a
template <class V, class Real>
void peq(V& r, V const& a, Real f) {
  flat(r) += f * flat(a);
}

/// r = a + f r
template <class R, class A, class Real>
void turn(R&& r, A const& a, Real f) {
  r = a + f * r;
}

/// x += f p, r -= f q, and r.r: a step of conjugate gradients. Part by part, so that each stays in the
/// nearest cache.
template <class X, class P, class Real>
double advance(X&& x, P const& p, X&& r, P const& q, Real f) {
  double sum = 0;
  for (Eigen::Index i = 0; i < x.size(); i += 512) {
    const Eigen::Index n = std::min<Eigen::Index>(512, x.size() - i);
    x.segment(i, n) += f * p.segment(i, n);
    r.segment(i, n) -= f * q.segment(i, n);
    sum += double(r.segment(i, n).squaredNorm());
  }
  return sum;
}

/// x <- x moved along a for the time f, for positions whose derivative is of another type
template <class D>
void increment(typename D::VecCoord& x, typename D::VecDeriv const& a, typename D::Real f) {
  if constexpr (D::rigid)
    for (std::size_t i = 0; i < x.size(); ++i) D::increment(x[i], f * a[i]);
  else
    flat(x) += f * flat(a);
}

template <class V>
double dot(V const& a, V const& b) {
  return double(flat(a).dot(flat(b)));
}

/// First entry that is not finite, or -1. A finite sum has finite terms; a sum that overflows is looked at
/// term by term.
template <class D>
int find_not_finite(typename D::VecCoord const& x) {
  if constexpr (!D::rigid)
    if (std::isfinite(flat(x).sum())) return -1;
  for (std::size_t i = 0; i < x.size(); ++i)
    if (!D::finite(x[i])) return int(i);
  return -1;
}

}  // namespace sinew::vec
