// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/linalg/coarse_rows.hpp>

#include <cstddef>
#include <vector>

namespace sinew {

/// Takes what is held out of the modes of a matrix: of each point the part that all blocks beside its
/// diagonal one map to nothing, as fixed points and projectors leave it. `alone`: rows with nothing beside
/// their diagonal block.
template <class Run, class Row>
void hold_modes(Run const& workers, CompressedRowSparseMatrix<double, 3> const& a, std::vector<Row>& modes,
                std::vector<char>& alone) {
  share_rows(workers, a.rows(), [&](int i, int) {
    Eigen::Matrix3d s = Eigen::Matrix3d::Zero();  // sum_j A_ij A_ij'
    a.forEachInRow(i, [&](int j, int slot, bool transposed) {
      if (j == i) return;
      const Eigen::Map<Eigen::Matrix<double, 3, 3, Eigen::RowMajor> const> block(a.block(slot));
      if (transposed)
        s.noalias() += block.transpose() * block;
      else
        s.noalias() += block * block.transpose();
    });
    const double trace = s.trace();
    alone[std::size_t(i)] = !(trace > 0);
    if (s.determinant() > 1e-18 * trace * trace * trace) return;
    // onto the range of s: its longest column, then that of what is left
    Eigen::Matrix3d p = Eigen::Matrix3d::Zero();
    for (int rank = 0; rank < 3 && trace > 0; ++rank) {
      Eigen::Index longest = 0;
      const double length = s.colwise().norm().maxCoeff(&longest);
      if (!(length > 1e-12 * trace)) break;
      const Eigen::Vector3d u = s.col(longest) / length;
      p += u * u.transpose();
      s -= (u * (u.transpose() * s)).eval();
    }
    Row* const m = &modes[std::size_t(3 * i)];
    const Row before[3] = {m[0], m[1], m[2]};
    for (int r = 0; r < 3; ++r) m[r] = p(r, 0) * before[0] + p(r, 1) * before[1] + p(r, 2) * before[2];
  });
}

}  // namespace sinew
