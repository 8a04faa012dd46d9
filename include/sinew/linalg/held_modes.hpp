// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/core/platform.hpp>
#include <sinew/linalg/coarse_rows.hpp>

#include <Eigen/Core>

#include <cmath>
#include <cstddef>
#include <vector>

namespace sinew {

/// The projector p onto the range of a symmetric positive semidefinite s: its longest column, then that of
/// what is left. False where that is all of space.
SINEW_HD inline bool range_projector(Eigen::Matrix3d s, Eigen::Matrix3d& p) {
  const double trace = s(0, 0) + s(1, 1) + s(2, 2);
  const double determinant = s(0, 0) * (s(1, 1) * s(2, 2) - s(1, 2) * s(2, 1)) -
                             s(0, 1) * (s(1, 0) * s(2, 2) - s(1, 2) * s(2, 0)) +
                             s(0, 2) * (s(1, 0) * s(2, 1) - s(1, 1) * s(2, 0));
  if (determinant > 1e-18 * trace * trace * trace) return false;
  p.setZero();
  for (int rank = 0; rank < 3 && trace > 0; ++rank) {
    int longest = 0;
    double most = -1;
    for (int c = 0; c < 3; ++c) {
      const double size = s(0, c) * s(0, c) + s(1, c) * s(1, c) + s(2, c) * s(2, c);
      if (size > most) most = size, longest = c;
    }
    const double length = std::sqrt(most);
    if (!(length > 1e-12 * trace)) break;
    const Eigen::Vector3d u = s.col(longest) / length;
    Eigen::Vector3d along;
    for (int c = 0; c < 3; ++c) along[c] = u[0] * s(0, c) + u[1] * s(1, c) + u[2] * s(2, c);
    for (int r = 0; r < 3; ++r)
      for (int c = 0; c < 3; ++c) p(r, c) += u[r] * u[c], s(r, c) -= u[r] * along[c];
  }
  return true;
}

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
    Eigen::Matrix3d p;
    alone[std::size_t(i)] = !(s.trace() > 0);
    if (!range_projector(s, p)) return;
    Row* const m = &modes[std::size_t(3 * i)];
    const Row before[3] = {m[0], m[1], m[2]};
    for (int r = 0; r < 3; ++r) m[r] = p(r, 0) * before[0] + p(r, 1) * before[1] + p(r, 2) * before[2];
  });
}

}  // namespace sinew
