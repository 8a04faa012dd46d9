// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/core/data_types.hpp>
#include <sinew/core/work_share.hpp>

#include <Eigen/Core>
#include <algorithm>
#include <cstring>
#include <type_traits>
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

/// The same of vectors that have a side on the host and one elsewhere.
template <class V>
requires requires(V& v) { v.host(); }
auto flat(V& v) {
  return flat(v.host());
}

// Eigen's sums over vectors of any length. With AVX-512 g++ 12 takes the undefined register of its own
// intrinsics, which they are made of, for a bug (GCC bug 105593)
#if defined(__GNUC__) && !defined(__clang__)
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wmaybe-uninitialized"
#pragma GCC diagnostic ignored "-Wuninitialized"
#endif
template <class Vector>
auto squared_norm(Vector const& a) {
  return a.squaredNorm();
}
template <class A, class B>
auto product(A const& a, B const& b) {
  return a.dot(b);
}
#if defined(__GNUC__) && !defined(__clang__)
#pragma GCC diagnostic pop
#endif

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

/// Vectors are taken in pieces of so many scalars: the sum of a piece has the same bits wherever it is made,
/// and pieces are added in their order.
inline constexpr Eigen::Index piece = 512;

/// The sum of f(begin, length) over the pieces of a vector; short vectors are left to one thread.
template <class Run, class F>
double sum_pieces(Run const& workers, Eigen::Index size, F&& f) {
  const auto length = [size](Eigen::Index i) { return std::min(piece, size - i); };
  double sum = 0;
  if constexpr (!std::is_same_v<Run, OneThread>)
    if (workers.count() > 1 && size >= 16 * piece) {
      const std::size_t pieces = std::size_t((size + piece - 1) / piece);
      double* const sums = workers.sums();
      workers.run([&](WorkShare share) {
        for (std::size_t k = share.begin(pieces); k < share.end(pieces); ++k)
          sums[k] = f(Eigen::Index(k) * piece, length(Eigen::Index(k) * piece));
      });
      for (std::size_t k = 0; k < pieces; ++k) sum += sums[k];
      return sum;
    }
  for (Eigen::Index i = 0; i < size; i += piece) sum += f(i, length(i));
  return sum;
}
/// f(begin, length) for all of a vector.
template <class Run, class F>
void each_piece(Run const& workers, Eigen::Index size, F&& f) {
  if constexpr (!std::is_same_v<Run, OneThread>)
    if (workers.count() > 1 && size >= 16 * piece) {
      workers.run([&](WorkShare share) {
        const auto begin = Eigen::Index(share.begin(std::size_t(size)));
        f(begin, Eigen::Index(share.end(std::size_t(size))) - begin);
      });
      return;
    }
  f(Eigen::Index(0), size);
}

/// a.b of a piece, in an order of its own that does not depend on where in memory the vectors are
template <class Real>
double dot_piece(Real const* a, Real const* b, Eigen::Index n) {
  typedef Real Eight __attribute__((vector_size(8 * sizeof(Real))));
  Eight sums[2] = {};
  Eigen::Index i = 0;
  for (; i + 16 <= n; i += 16)
    for (int k = 0; k < 2; ++k) {
      Eight u, v;
      std::memcpy(&u, a + i + 8 * k, sizeof u);
      std::memcpy(&v, b + i + 8 * k, sizeof v);
      sums[k] += u * v;
    }
  const Eight both = sums[0] + sums[1];
  Real sum = 0;
  for (int k = 0; k < 8; ++k) sum += both[k];
  for (; i < n; ++i) sum += a[i] * b[i];
  return double(sum);
}

/// The sum of n scalars, in an order of its own.
template <class Real>
Real sum_of(Real const* a, Eigen::Index n) {
  typedef Real Eight __attribute__((vector_size(8 * sizeof(Real))));
  Eight sums[2] = {};
  Eigen::Index i = 0;
  for (; i + 16 <= n; i += 16)
    for (int k = 0; k < 2; ++k) {
      Eight u;
      std::memcpy(&u, a + i + 8 * k, sizeof u);
      sums[k] += u;
    }
  const Eight both = sums[0] + sums[1];
  Real sum = 0;
  for (int k = 0; k < 8; ++k) sum += both[k];
  for (; i < n; ++i) sum += a[i];
  return sum;
}

/// x += f p, r -= f q, and r.r: a step of conjugate gradients.
template <class Run, class X, class P, class Real>
double advance(Run const& workers, X&& x, P const& p, X&& r, P const& q, Real f) {
  return sum_pieces(workers, x.size(), [&](Eigen::Index i, Eigen::Index n) {
    x.segment(i, n) += f * p.segment(i, n);
    r.segment(i, n) -= f * q.segment(i, n);
    return dot_piece(r.data() + i, r.data() + i, n);
  });
}

/// r = a + f r
template <class Run, class R, class A, class Real>
void xpay(Run const& workers, R&& r, A const& a, Real f) {
  each_piece(workers, r.size(), [&](Eigen::Index i, Eigen::Index n) {
    r.segment(i, n) = a.segment(i, n) + f * r.segment(i, n);
  });
}

/// x <- x moved along a for the time f, for positions whose derivative is of another type
template <class D>
void increment(typename D::VecCoord& x, typename D::VecDeriv const& a, typename D::Real f) {
  if constexpr (D::rigid)
    for (std::size_t i = 0; i < x.size(); ++i) D::increment(x[i], f * a[i]);
  else
    flat(x) += f * flat(a);
}

template <class Run, class V>
double dot(Run const& workers, V const& a, V const& b) {
  return sum_pieces(
      workers, flat(a).size(), [x = flat(a).data(), y = flat(b).data()](Eigen::Index i, Eigen::Index n) {
        return dot_piece(x + i, y + i, n);
      });
}

template <class V>
double dot(V const& a, V const& b) {
  return dot(OneThread{}, a, b);
}

/// First entry that is not finite, or -1. A finite sum has finite terms; a sum that overflows is looked at
/// term by term.
template <class D>
int find_not_finite(typename D::VecCoord const& x) {
  if constexpr (!D::rigid)
    if (std::isfinite(sum_of(flat(x).data(), flat(x).size()))) return -1;
  for (std::size_t i = 0; i < x.size(); ++i)
    if (!D::finite(x[i])) return int(i);
  return -1;
}

}  // namespace sinew::vec

namespace sinew {

/// What solvers do with the vectors of one state, through MechanicalOperations. DataTypes whose vectors live
/// elsewhere than in the memory of the processor specialise it.
template <class D>
struct VectorOperations {
  using Real = typename D::Real;
  using VecCoord = typename D::VecCoord;
  using VecDeriv = typename D::VecDeriv;

  /// r = 0
  template <class Run>
  static void clear(Run const& workers, VecDeriv& r) {
    auto all = vec::flat(r);
    vec::each_piece(workers, all.size(), [&](auto i, auto n) { all.segment(i, n).setZero(); });
  }
  /// r = a
  template <class Run, class V>
  static void eq(Run const& workers, V& r, V const& a) {
    vec::each_piece(workers, Eigen::Index(r.size()), [&](auto i, auto n) {
      std::copy(a.begin() + i, a.begin() + i + n, r.begin() + i);
    });
  }
  /// r = f a
  static void eq(VecDeriv& r, VecDeriv const& a, Real f) { vec::flat(r) = f * vec::flat(a); }
  /// r += f a
  template <class Run>
  static void peq(Run const& workers, VecDeriv& r, VecDeriv const& a, Real f) {
    auto to = vec::flat(r);
    const auto from = vec::flat(a);
    vec::each_piece(workers, to.size(), [&](auto i, auto n) { to.segment(i, n) += f * from.segment(i, n); });
  }
  /// x <- x moved along a for the time f
  static void move(VecCoord& x, VecDeriv const& a, Real f) { vec::increment<D>(x, a, f); }
  /// r = the way from a to b
  static void difference(VecDeriv& r, VecCoord const& a, VecCoord const& b) {
    for (std::size_t i = 0; i < r.size(); ++i) r[i] = D::difference(a[i], b[i]);
  }
  /// The host is going to look at it.
  template <class V>
  static void bringToHost(V const&) {}
  /// r *= f
  static void teq(VecDeriv& r, Real f) { vec::flat(r) *= f; }
  template <class Run>
  static double dot(Run const& workers, VecDeriv const& a, VecDeriv const& b) {
    return vec::dot(workers, a, b);
  }
  /// r = a + f r
  template <class Run>
  static void xpay(Run const& workers, VecDeriv& r, VecDeriv const& a, Real f) {
    vec::xpay(workers, vec::flat(r), vec::flat(a), f);
  }
  /// x += f p, r -= f q; returns r.r.
  template <class Run>
  static double advance(Run const& workers, VecDeriv& x, VecDeriv const& p, VecDeriv& r, VecDeriv const& q,
                        Real f) {
    return vec::advance(workers, vec::flat(x), vec::flat(p), vec::flat(r), vec::flat(q), f);
  }
  /// Time derivative of theta, where a position moved by theta has velocity v.
  static void chartRate(VecDeriv& rate, VecDeriv const& theta, VecDeriv const& v) {
    for (std::size_t i = 0; i < rate.size(); ++i) rate[i] = D::chart_rate(theta[i], v[i]);
  }
  /// First position that is not finite, or -1.
  static int findNotFinite(VecCoord const& x) { return vec::find_not_finite<D>(x); }
};

/// What a solver that works on a device keeps with a state: nothing where there is none.
template <class D>
struct SolverWorkspace {};

}  // namespace sinew
