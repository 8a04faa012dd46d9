// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/core/platform.hpp>
#include <sinew/linalg/coarse_rows.hpp>

#include <cmath>
#include <cstddef>
#include <limits>
#include <utility>
#include <vector>

namespace sinew {

/// Of a diagonal block d = L L' the factor, `lower`, and w = L^-1. Pivots up to `smallest` are no unknowns:
/// their rows of w are zero. Where that is negative, a block that is not positive definite has its roots of
/// |d_ii| as factor.
template <int R, class Block>
SINEW_HD void unit_block(Block const& d, double smallest, Block& lower, Block& w) {
  constexpr double largest = std::numeric_limits<double>::max();
  bool definite = true;
  lower.setZero();
  for (int c = 0; c < R && definite; ++c) {
    double pivot = d(c, c);
    for (int k = 0; k < c; ++k) pivot -= lower(c, k) * lower(c, k);
    if (smallest >= 0 && !(pivot > smallest)) {
      for (int k = 0; k < c; ++k) lower(c, k) = 0;
      continue;
    }
    // the pivot has no digit left where it is this small against its diagonal entry
    definite = pivot > 1e-14 * d(c, c) && pivot <= largest;
    if (!definite) break;
    lower(c, c) = std::sqrt(pivot);
    for (int r = c + 1; r < R; ++r) {
      double sum = d(r, c);
      for (int k = 0; k < c; ++k) sum -= lower(r, k) * lower(c, k);
      lower(r, c) = sum / lower(c, c);
    }
  }
  if (!definite) {
    lower.setZero();
    for (int r = 0; r < R; ++r) {
      const double size = d(r, r) < 0 ? -d(r, r) : d(r, r);
      lower(r, r) = size > 0 && size <= largest ? std::sqrt(size) : 1;
    }
  }
  w.setZero();
  for (int c = 0; c < R; ++c) {
    if (lower(c, c) == 0) continue;
    w(c, c) = 1 / lower(c, c);
    for (int r = c + 1; r < R; ++r) {
      if (lower(r, r) == 0) continue;
      double sum = 0;
      for (int k = c; k < r; ++k) sum -= lower(r, k) * w(k, c);
      w(r, c) = sum / lower(r, r);
    }
  }
}

/// A symmetric block matrix made one with unit diagonal blocks, W A W', and the modes that A maps to nearly
/// nothing made those of the new one, W'^-1 B: for diagonal blocks L L', W = L^-1. Then smoothers and sizes
/// of connections know no scale.
template <int R>
struct UnitBlocks {
  using Block = Eigen::Matrix<double, R, R, Eigen::RowMajor>;
  using Matrix = CompressedRowSparseMatrix<double, R>;
  using Row = Sixes<double>::Row;

  std::vector<Block> inverse{};  // W
  /// Of unit_block.
  double smallest = -1;

  template <class Run>
  void apply(Run const& workers, Matrix& a, std::vector<Row>& modes) {
    share_rows(workers, a.rows(), [&](int i, int) {
      Block lower;
      Block& w = inverse[std::size_t(i)];
      unit_block<R>(Block(Eigen::Map<Block const>(std::as_const(a).block(a.rowStart[std::size_t(i)]))),
                    smallest,
                    lower,
                    w);
      Row* const b = &modes[std::size_t(i * R)];
      for (int r = 0; r < R; ++r) {
        Row sum{};
        for (int c = r; c < R; ++c) sum += lower(c, r) * b[c];
        b[r] = sum;
      }
    });
    share_rows(workers, a.rows(), [&](int i, int) {
      Block const& w = inverse[std::size_t(i)];
      const int first = a.rowStart[std::size_t(i)], last = a.rowStart[std::size_t(i) + 1];
      for (int k = first; k < last; ++k) {
        Eigen::Map<Block> block(a.values.data() + std::ptrdiff_t(k) * (R * R));
        Block half;
        half.noalias() = w * block;
        block.noalias() = half * inverse[std::size_t(a.columns[std::size_t(k)])].transpose();
      }
      Eigen::Map<Block> diagonal(a.values.data() + std::ptrdiff_t(first) * (R * R));
      for (int r = 0; r < R; ++r)
        if (w(r, r) == 0) diagonal(r, r) = 1;
    });
  }
};

}  // namespace sinew
