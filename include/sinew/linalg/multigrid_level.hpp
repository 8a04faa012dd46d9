// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/linalg/chebyshev.hpp>
#include <sinew/linalg/prolongation.hpp>
#include <sinew/linalg/unit_blocks.hpp>
#include <sinew/state/vector_operations.hpp>

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <type_traits>
#include <utility>
#include <vector>

namespace sinew {

/// One level of multigrid: its matrix with unit diagonal blocks, in double for the matrix of the level below
/// and in float for the cycle, its near null space, and its smoother.
template <int R>
struct MultigridLevel {
  using Row = Sixes<double>::Row;
  static constexpr int stride = R == 3 ? 3 : 8;  // numbers of a point in vectors

  CompressedRowSparseMatrix<double, R> matrix{};
  std::conditional_t<R == 3, CompressedRowSparseMatrix<float, 3>, CoarseRows> product{};
  UnitBlocks<R> unit{};
  std::vector<Row> modes{};
  Prolongation<R> down{};  // to the level below, where there is one
  std::vector<float> x{}, r{}, d{}, q{};
  std::vector<float> b{};  // r of x = 0, of coarse levels
  double bound = 1;        // of the eigenvalues

  /// Room, once the pattern of the matrix is there.
  template <class Run>
  void init(Run const& workers) {
    const std::size_t n = std::size_t(matrix.rows());
    if constexpr (R == 3) {
      product.startPattern(matrix.dofs());
      for (int i = 0; i < matrix.rows(); ++i) {
        product.pattern[std::size_t(i)].clear();
        matrix.forEachInRow(i, [&](int j, int, bool) { product.pattern[std::size_t(i)].push_back(j); });
      }
      product.finishPattern();
      product.split(workers.count());
    } else {
      product.init(matrix);
      unit.smallest = 1e-13;
    }
    unit.inverse.resize(n);
    modes.assign(n * R, Row{});
    for (auto* v : {&x, &r, &d, &q}) v->assign(n * stride + 1, 0);
    if (R != 3) b = r;
    workers.reserveSums(n * stride / std::size_t(vec::piece) + 1);
  }

  /// Once the values of the matrix and the modes are there.
  template <class Run>
  void update(Run const& workers) {
    unit.apply(workers, matrix, modes);
    if constexpr (R == 3) {
      product.setZero(workers);
      const std::size_t n = matrix.columns.size() * 9;
      workers.run([&](WorkShare share) {
        for (std::size_t k = share.begin(n); k < share.end(n); ++k)
          product.values[k] = float(matrix.values[k]);
      });
    } else {
      product.update(workers, matrix);
    }
    bound = 1.05 * largestEigenvalue(workers);
  }

  /// q = A d
  template <class Run>
  void multiply(Run const& workers) {
    product.multiply(workers, d.data(), q.data());
  }

  /// Smoothing of A x = b: x += what `degree` steps find from the residual r, which is then that of x; where
  /// x is `fresh` it is 0, where r is `behind` it is b - A (x - d) and q is A d. In the end the residual is
  /// not made new if it is not `wanted`.
  template <class Run>
  void smooth(Run const& workers, int degree, bool fresh, bool behind, bool wanted) {
    for (int k = 1; k <= degree; ++k) {
      const float turn = k == 1 ? 0.f : ChebyshevSmoother::turn(k),
                  gain = ChebyshevSmoother::gain(k) / float(bound);
      const bool subtract = behind || k > 1, set = fresh && k == 1, none = k == 1;
      each(workers, [&](auto&& part) {
        auto px = part(x), pr = part(r), pd = part(d), pq = part(q);
        if (subtract) pr -= pq;
        if (none)
          pd = gain * pr;
        else
          pd = turn * pd + gain * pr;
        if (set)
          px = pd;
        else
          px += pd;
      });
      if (k < degree || wanted) multiply(workers);
    }
    if (wanted) each(workers, [&](auto&& part) { part(r) -= part(q); });
  }

  /// r = b - A x, with A in double: motions that cost next to nothing are large in x, and the rounding of A x
  /// would ask for more of them.
  template <class Run>
  void residual(Run const& workers) {
    share_rows(workers, matrix.rows(), [&](int i, int) {
      double sums[std::size_t(R)] = {};
      matrix.forEachInRow(i, [&](int j, int slot, bool transposed) {
        double const* const a = std::as_const(matrix).block(slot);
        for (int row = 0; row < R; ++row)
          for (int c = 0; c < R; ++c)
            sums[row] += a[transposed ? R * c + row : R * row + c] * double(x[std::size_t(stride * j + c)]);
      });
      for (int row = 0; row < R; ++row) {
        const std::size_t k = std::size_t(stride * i + row);
        r[k] = float(double(b[k]) - sums[row]);
      }
    });
  }

  /// x += d
  template <class Run>
  void add(Run const& workers) {
    each(workers, [&](auto&& part) { part(x) += part(d); });
  }

 private:
  // f(part), part(v) the same piece of each vector v
  template <class Run, class F>
  void each(Run const& workers, F&& f) {
    vec::each_piece(workers, Eigen::Index(x.size()) - 1, [&](Eigen::Index begin, Eigen::Index length) {
      for (Eigen::Index i = 0; i < length; i += 2 * vec::piece)
        f([&](std::vector<float>& v) {
          return Eigen::Map<Eigen::ArrayXf>(v.data() + begin + i, std::min(2 * vec::piece, length - i));
        });
    });
  }
  template <class Run>
  static double dot(Run const& workers, std::vector<float> const& a, std::vector<float> const& b) {
    return vec::sum_pieces(workers, Eigen::Index(a.size()) - 1, [&](Eigen::Index i, Eigen::Index n) {
      return vec::dot_piece(a.data() + i, b.data() + i, n);
    });
  }
  // By steps of Lanczos from a vector of numbers of both signs, of which each power of A has a part: what
  // they find is a few per cent below (Kuczynski, Wozniakowski 1992).
  template <class Run>
  double largestEigenvalue(Run const& workers) {
    // a number, since nvcc takes a local name in a type with it to where the type is met again
    std::array<double, 8> diagonal{}, beside{};
    std::uint32_t seed = 1;
    for (std::size_t i = 0; i + 1 < d.size(); ++i) {
      seed = seed * 1664525u + 1013904223u;
      d[i] = stride == 8 && i % 8 > 5 ? 0.f : float(seed >> 8) * 0x1p-23f - 1.f;
    }
    std::fill(x.begin(), x.end(), 0.f);
    double norm = std::sqrt(dot(workers, d, d));
    std::size_t done = 0;
    for (std::size_t k = 0; k < diagonal.size(); ++k) {
      const float scale = float(1 / norm), last = k == 0 ? 0.f : float(beside[k - 1]);
      each(workers, [&](auto&& part) { part(d) *= scale; });
      multiply(workers);
      const double own = dot(workers, d, q);
      each(workers, [&](auto&& part) {
        auto pq = part(q), pd = part(d), px = part(x);
        pq -= float(own) * pd + last * px;  // x is the vector before
        px = pd;
        pd = pq;
      });
      diagonal[k] = own;
      norm = beside[k] = std::sqrt(dot(workers, d, d));
      done = k + 1;
      if (!(norm > 1e-5 * std::abs(own)) || !std::isfinite(norm)) break;
    }
    const double found =
        largest_eigenvalue(std::span(diagonal).first(done), std::span(beside).first(done - 1));
    return found > 0 && std::isfinite(found) ? found : 1;
  }
};

}  // namespace sinew
