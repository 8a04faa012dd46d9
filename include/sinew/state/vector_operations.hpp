// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/core/data_types.hpp>

#include <Eigen/Core>
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
