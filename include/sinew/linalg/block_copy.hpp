// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/core/work_share.hpp>
#include <sinew/linalg/block_matrix.hpp>

#include <cstddef>
#include <vector>

namespace sinew {

/// A copy of a symmetric matrix of numbers, or of blocks of 3 x 3, as one of such blocks in double. Where
/// there are no more unknowns, the last block has ones on its diagonal.
struct BlockCopy {
  using Copy = CompressedRowSparseMatrix<double, 3>;

  template <class Matrix>
  void init(Matrix const& a, Copy& to) {
    constexpr int B = Matrix::blockSize;
    static_assert(B == 3 || B == 1, "Sinew: multigrid takes matrices of numbers, or of blocks of 3 x 3");
    to.slicedFrom = std::size_t(-1);
    to.startPattern(a.dofs());
    for (int i = 0; i < a.rows(); ++i)
      a.forEachInRow(i, [&](int j, int, bool) { to.preallocate(i * B, j * B, B, B); });
    to.finishPattern();
    places_.clear();
    if constexpr (B == 1)
      for (int i = 0; i < a.rows(); ++i)
        for (int k = a.rowStart[std::size_t(i)]; k < a.rowStart[std::size_t(i) + 1]; ++k) {
          const int j = a.columns[std::size_t(k)];
          places_.push_back(9 * to.slot(i / 3, j / 3) + i % 3 * 3 + j % 3);
        }
  }

  template <class Run, class Matrix>
  void load(Run const& workers, Matrix const& a, Copy& to) const {
    const std::size_t n = a.columns.size() * Matrix::blockSize * Matrix::blockSize;
    if constexpr (Matrix::blockSize == 3) {
      workers.run([&](WorkShare share) {
        for (std::size_t k = share.begin(n); k < share.end(n); ++k) to.values[k] = double(a.values[k]);
      });
    } else {
      to.setZero();
      for (std::size_t k = 0; k < n; ++k) to.values[std::size_t(places_[k])] = double(a.values[k]);
      for (int i = 0; i < to.rows(); ++i) {
        double* const d = to.block(to.rowStart[std::size_t(i)]);
        d[3] = d[1], d[6] = d[2], d[7] = d[5];
        for (int c = 0; c < 3; ++c)
          if (3 * i + c >= a.dofs()) d[4 * c] = 1;
      }
    }
  }

 private:
  std::vector<int> places_{};  // of each number of a matrix of numbers, in the blocks
};

}  // namespace sinew
