// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/core/platform.hpp>

#include <Eigen/Core>
#include <cmath>
#include <type_traits>

#if defined(__CUDACC__)
#pragma nv_diag_suppress 1675  // nvcc unrolls by itself, and does not know the pragma of g++ and clang
#endif

// Sums, multiples and products of Eigen's matrices of fixed size, by value. Eigen's own operators return
// expressions, each a type of its own that costs the compiler 5 to 10 ms: half of the time of a file with
// many laws. For matrices that live in registers the value is what the optimiser makes of the expression
// anyway. Code inside namespace sinew finds these operators before Eigen's; dynamic sizes stay Eigen's.
namespace sinew {

namespace detail {
template <class D>
std::true_type is_matrix(Eigen::MatrixBase<D> const*);
std::false_type is_matrix(void const*);
}  // namespace detail

/// A matrix, or an expression of one, whose size is known to the compiler.
template <class A>
concept FixedMatrix =
    decltype(detail::is_matrix(static_cast<A const*>(nullptr)))::value && (int(A::SizeAtCompileTime) > 0);

template <class A, class B>
concept FixedMatrices =
    FixedMatrix<A> && FixedMatrix<B> && std::is_same_v<typename A::Scalar, typename B::Scalar>;

template <class S, class A>
concept ScalarOf = FixedMatrix<A> && !FixedMatrix<S> && std::is_convertible_v<S const&, typename A::Scalar>;

namespace detail {

template <class A, int R = A::RowsAtCompileTime, int C = A::ColsAtCompileTime>
using Value = Eigen::Matrix<typename A::Scalar, R, C>;

/// The matrix itself where its entries lie in memory, else its value: no entry is computed twice.
template <class A>
SINEW_INLINE decltype(auto) entries(A const& a) {
  if constexpr ((int(A::Flags) & int(Eigen::DirectAccessBit)) != 0)
    return (a);
  else
    return Value<A>(a);
}

/// The matrix M with the entries f(i, j).
template <class M, class F>
SINEW_INLINE M matrix_of(F const& f) {
  M m;
  if constexpr (int(M::SizeAtCompileTime) <= 64) {
#pragma GCC unroll 64
    for (int j = 0; j < M::ColsAtCompileTime; ++j)
#pragma GCC unroll 64
      for (int i = 0; i < M::RowsAtCompileTime; ++i) m.coeffRef(i, j) = f(i, j);
  } else {
    for (int j = 0; j < M::ColsAtCompileTime; ++j)
      for (int i = 0; i < M::RowsAtCompileTime; ++i) m.coeffRef(i, j) = f(i, j);
  }
  return m;
}

template <class A, class B>
constexpr void same_size() {
  static_assert(int(A::RowsAtCompileTime) == int(B::RowsAtCompileTime) &&
                    int(A::ColsAtCompileTime) == int(B::ColsAtCompileTime),
                "SINEW: the matrices of a sum differ in size");
}

}  // namespace detail

template <class A, class B>
requires FixedMatrices<A, B>
SINEW_INLINE detail::Value<A> operator+(A const& left, B const& right) {
  detail::same_size<A, B>();
  auto const& a = detail::entries(left);
  auto const& b = detail::entries(right);
  return detail::matrix_of<detail::Value<A>>([&](int i, int j) { return a.coeff(i, j) + b.coeff(i, j); });
}

template <class A, class B>
requires FixedMatrices<A, B>
SINEW_INLINE detail::Value<A> operator-(A const& left, B const& right) {
  detail::same_size<A, B>();
  auto const& a = detail::entries(left);
  auto const& b = detail::entries(right);
  return detail::matrix_of<detail::Value<A>>([&](int i, int j) { return a.coeff(i, j) - b.coeff(i, j); });
}

template <FixedMatrix A>
SINEW_INLINE detail::Value<A> operator-(A const& matrix) {
  auto const& a = detail::entries(matrix);
  return detail::matrix_of<detail::Value<A>>([&](int i, int j) { return -a.coeff(i, j); });
}

template <class A, class S>
requires ScalarOf<S, A>
SINEW_INLINE detail::Value<A> operator*(A const& matrix, S const& factor) {
  auto const& a = detail::entries(matrix);
  const auto s = static_cast<typename A::Scalar>(factor);
  return detail::matrix_of<detail::Value<A>>([&](int i, int j) { return a.coeff(i, j) * s; });
}
template <class S, class A>
requires ScalarOf<S, A>
SINEW_INLINE detail::Value<A> operator*(S const& factor, A const& matrix) {
  return matrix * factor;
}

template <class A, class S>
requires ScalarOf<S, A>
SINEW_INLINE detail::Value<A> operator/(A const& matrix, S const& divisor) {
  auto const& a = detail::entries(matrix);
  const auto s = static_cast<typename A::Scalar>(divisor);
  return detail::matrix_of<detail::Value<A>>([&](int i, int j) { return a.coeff(i, j) / s; });
}

/// Not of a row and a column, whose product Eigen lets become a scalar.
template <class A, class B>
requires(FixedMatrices<A, B> && (int(A::RowsAtCompileTime) > 1 || int(B::ColsAtCompileTime) > 1))
SINEW_INLINE detail::Value<A, A::RowsAtCompileTime, B::ColsAtCompileTime> operator*(A const& left,
                                                                                    B const& right) {
  static_assert(int(A::ColsAtCompileTime) == int(B::RowsAtCompileTime),
                "SINEW: the sizes of the factors of a product do not fit");
  auto const& a = detail::entries(left);
  auto const& b = detail::entries(right);
  return detail::matrix_of<detail::Value<A, A::RowsAtCompileTime, B::ColsAtCompileTime>>([&](int i, int j) {
    typename A::Scalar sum = a.coeff(i, 0) * b.coeff(0, j);
#pragma GCC unroll 64
    for (int k = 1; k < A::ColsAtCompileTime; ++k) sum += a.coeff(i, k) * b.coeff(k, j);
    return sum;
  });
}

/// The smaller and the larger of each two entries.
template <class A, class B>
requires FixedMatrices<A, B>
SINEW_INLINE detail::Value<A> min_of(A const& a, B const& b) {
  detail::same_size<A, B>();
  return detail::matrix_of<detail::Value<A>>(
      [&](int i, int j) { return b.coeff(i, j) < a.coeff(i, j) ? b.coeff(i, j) : a.coeff(i, j); });
}
template <class A, class B>
requires FixedMatrices<A, B>
SINEW_INLINE detail::Value<A> max_of(A const& a, B const& b) {
  detail::same_size<A, B>();
  return detail::matrix_of<detail::Value<A>>(
      [&](int i, int j) { return a.coeff(i, j) < b.coeff(i, j) ? b.coeff(i, j) : a.coeff(i, j); });
}

/// Whether no entry is infinite or no number.
template <FixedMatrix A>
SINEW_INLINE bool all_finite(A const& a) {
  for (int j = 0; j < A::ColsAtCompileTime; ++j)
    for (int i = 0; i < A::RowsAtCompileTime; ++i)
      if (!std::isfinite(a.coeff(i, j))) return false;
  return true;
}

}  // namespace sinew
