// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/core/platform.hpp>
#include <sinew/core/work_share.hpp>
#include <sinew/linalg/block_matrix.hpp>

#include <cstddef>
#include <cstring>
#include <vector>

namespace sinew {

/// f(i, thread) for the rows of a matrix, shared among threads where there are enough of them.
template <class Run, class F>
void share_rows(Run const& workers, int rows, F&& f) {
  auto some = [&](WorkShare share) {
    const int end = int(share.end(std::size_t(rows)));
    for (int i = int(share.begin(std::size_t(rows))); i < end; ++i) f(i, share.index);
  };
  if (rows < 128)
    some(WorkShare{});
  else
    workers.run(some);
}

/// A row of six numbers of a 6 x 6 block, and two more that fill a register. nvcc, which knows no registers
/// of the processor, sees eight numbers in the same places.
template <class Real>
struct Sixes {
#if defined(__CUDACC__)
  struct alignas(8 * sizeof(Real)) Row {
    Real of[8];
    SINEW_HD Real& operator[](int i) { return of[i]; }
    SINEW_HD Real operator[](int i) const { return of[i]; }
    SINEW_HD Row& operator+=(Row const& b) {
      for (int i = 0; i < 8; ++i) of[i] += b.of[i];
      return *this;
    }
    SINEW_HD friend Row operator+(Row a, Row const& b) { return a += b; }
    SINEW_HD friend Row operator*(Row a, Row const& b) {
      for (int i = 0; i < 8; ++i) a.of[i] *= b.of[i];
      return a;
    }
    SINEW_HD friend Row operator*(Row a, Real b) {
      for (int i = 0; i < 8; ++i) a.of[i] *= b;
      return a;
    }
    SINEW_HD friend Row operator*(Real a, Row const& b) { return b * a; }
  };
#else
  typedef Real Row __attribute__((vector_size(8 * sizeof(Real))));
#endif
  /// to = row, of other numbers.
  template <class Other>
  SINEW_INLINE static void convert(Other const& row, Row& to) {
#if defined(__CUDACC__)
    for (int i = 0; i < 8; ++i) to[i] = Real(row[i]);
#else
    to = __builtin_convertvector(row, Row);
#endif
  }
};

/// A symmetric matrix of 6 x 6 blocks in float, by whole rows, for products: of a block the columns, each of
/// eight numbers of which the last two are zero, so that a block is six products of a register with one
/// number. Vectors have eight numbers a point. Rows do not depend on each other: the same bits by any number
/// of threads.
struct CoarseRows {
  using Row = Sixes<float>::Row;
  std::vector<int> start{}, columns{};
  std::vector<Row> blocks{};  // six a block

  int rows() const { return start.empty() ? 0 : int(start.size()) - 1; }

  void init(CompressedRowSparseMatrix<double, 6> const& a) {
    start.assign(1, 0);
    columns.clear();
    for (int i = 0; i < a.rows(); ++i) {
      a.forEachInRow(i, [&](int column, int, bool) { columns.push_back(column); });
      start.push_back(int(columns.size()));
    }
    blocks.assign(6 * columns.size(), Row{});
  }

  template <class Run>
  void update(Run const& workers, CompressedRowSparseMatrix<double, 6> const& a) {
    share_rows(workers, rows(), [&](int i, int) {
      Row* to = &blocks[6 * std::size_t(start[std::size_t(i)])];
      a.forEachInRow(i, [&](int, int slot, bool transposed) {
        double const* const from = a.block(slot);
        for (int c = 0; c < 6; ++c, ++to)
          for (int r = 0; r < 6; ++r) (*to)[r] = float(transposed ? from[6 * c + r] : from[6 * r + c]);
      });
    });
  }

  /// y = A x
  template <class Run>
  void multiply(Run const& workers, float const* x, float* y) const {
    share_rows(workers, rows(), [&](int i, int) {
      Row sums[6] = {};
      Row const* a = &blocks[6 * std::size_t(start[std::size_t(i)])];
      for (int k = start[std::size_t(i)]; k < start[std::size_t(i) + 1]; ++k, a += 6) {
        float const* const of = x + 8 * columns[std::size_t(k)];
        for (int c = 0; c < 6; ++c) sums[c] += a[c] * of[c];
      }
      const Row sum = ((sums[0] + sums[1]) + (sums[2] + sums[3])) + (sums[4] + sums[5]);
      std::memcpy(y + 8 * i, &sum, sizeof sum);
    });
  }
};

}  // namespace sinew
