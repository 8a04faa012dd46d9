// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/linalg/block_matrix.hpp>
#include <sinew/linalg/minimum_degree.hpp>

#include <cmath>
#include <vector>

namespace sinew {

/// A pivot this small against its diagonal entry has no digit left. What the rounding of the entries leaves
/// of a pivot that is 0 was seen up to 1e-14 (doubles) and 1.4e-6 (floats) on free bodies; a slender beam, 40
/// times as long as wide, comes to 4e-6.
template <class Real>
inline constexpr double noPivot = sizeof(Real) == 8 ? 1e-12 : 2e-6;

/// P A P' = L D L' of a symmetric block matrix, with unit lower L and block-diagonal D, both of B x B blocks
/// of doubles: an order of small fill (approximate minimum degree: Amestoy, Davis, Duff 1996) and the pattern
/// of L once, at init; then, row by row of L (Davis 2005, "LDL"), the values as often as wanted, without
/// allocating. There is no pivoting: positive definite matrices always factorise, indefinite ones do as long
/// as no leading minor in the chosen order vanishes.
template <class Matrix>
struct BlockLdl {
  static constexpr int B = Matrix::blockSize;
  using Block = Eigen::Matrix<double, B, B>;
  using Column = Eigen::Matrix<double, B, 1>;

  int dofs = 0;  // scalars of the system; those behind, up to a whole block, are padding
  std::vector<int> newIndex{}, oldIndex{};  // of block rows
  std::vector<int> parent{};                // elimination tree, -1 at its roots
  std::vector<int> start{}, filled{},
      row{};  // columns of L: first slot, slots used so far, block row of each slot
  std::vector<Block> lower{}, inverse{};  // L, D^-1
  int negativePivots = 0;                 // scalar ones of the last factorisation: its negative eigenvalues

  void init(Matrix const& a, int systemDofs) {
    dofs = systemDofs;
    const int n = a.rows();
    std::vector<int> first{0}, columns;
    for (int i = 0; i < n; ++i) {
      a.forEachInRow(i, [&](int column, int, bool) { columns.push_back(column); });
      first.push_back(int(columns.size()));
    }
    setOrder(minimum_degree_order(first, columns));
    analyse(a);
    std::vector<int> order;
    for (const int k : postorder(parent)) order.push_back(oldIndex[std::size_t(k)]);
    setOrder(std::move(order));
    analyse(a);
    start.assign(1, 0);
    for (const int count : filled) start.push_back(start.back() + count);
    row.assign(std::size_t(start.back()), 0);
    lower.assign(std::size_t(start.back()), Block::Zero());
    inverse.assign(std::size_t(n), Block::Zero());
    work.assign(std::size_t(n), Block::Zero());
    path.assign(std::size_t(n), 0);
    reach.assign(std::size_t(n), 0);
    x.assign(std::size_t(n), Column::Zero());
  }

  /// Of A + shift diag(A). The first dof whose pivot is not finite, or zero to rounding against its diagonal
  /// entry; -1 if all are sound.
  int factorise(Matrix const& a, double shift = 0) {
    const int n = a.rows();
    negativePivots = 0;
    std::fill(mark.begin(), mark.end(), -1);
    std::fill(filled.begin(), filled.end(), 0);
    for (int k = 0; k < n; ++k) {
      // the column above the diagonal, and the rows of L that it reaches, in the order of elimination
      int top = n;
      forEachBlock(a, k, [&](int i, int slot, bool transposed) {
        const Eigen::Map<typename Matrix::Block const> stored(a.block(slot));
        if (transposed)
          work[std::size_t(i)] = stored.template cast<double>();
        else
          work[std::size_t(i)] = stored.transpose().template cast<double>();
        int length = 0;
        for (; mark[std::size_t(i)] != k && i != k; i = parent[std::size_t(i)]) {
          path[std::size_t(length++)] = i;
          mark[std::size_t(i)] = k;
        }
        while (length > 0) reach[std::size_t(--top)] = path[std::size_t(--length)];
      });
      Block pivot = work[std::size_t(k)];
      for (int r = 0; r < B; ++r)
        if (oldIndex[std::size_t(k)] * B + r >= dofs) pivot(r, r) = 1;
      pivot.diagonal() *= 1 + shift;
      const Column diagonal = pivot.diagonal();
      work[std::size_t(k)].setZero();

      for (; top < n; ++top) {
        const std::size_t i = std::size_t(reach[std::size_t(top)]);
        const Block z = work[i];
        work[i].setZero();
        const int end = start[i] + filled[i];
        for (int p = start[i]; p < end; ++p)
          work[std::size_t(row[std::size_t(p)])].noalias() -= lower[std::size_t(p)] * z;
        const Block l = z.transpose() * inverse[i];
        pivot.noalias() -= l * z;
        row[std::size_t(end)] = k;
        lower[std::size_t(end)] = l;
        ++filled[i];
      }
      if (const int bad = invert(pivot, diagonal, inverse[std::size_t(k)]); bad >= 0)
        return oldIndex[std::size_t(k)] * B + bad;
    }
    return -1;
  }

  /// to = A^-1 from, vectors of at least dofs scalars.
  template <class Vector>
  void solve(Vector const& from, Vector& to) {
    using Scalar = typename Vector::Scalar;
    const int n = int(inverse.size());
    for (int k = 0; k < n; ++k)
      for (int r = 0; r < B; ++r) {
        const int dof = oldIndex[std::size_t(k)] * B + r;
        x[std::size_t(k)][r] = dof < dofs ? double(from[dof]) : 0.0;
      }
    for (std::size_t i = 0; i < std::size_t(n); ++i) {
      const Column xi = x[i];
      for (int p = start[i]; p < start[i + 1]; ++p)
        x[std::size_t(row[std::size_t(p)])].noalias() -= lower[std::size_t(p)] * xi;
    }
    for (std::size_t i = std::size_t(n); i-- > 0;) {
      Column xi = inverse[i] * x[i];
      for (int p = start[i]; p < start[i + 1]; ++p)
        xi.noalias() -= lower[std::size_t(p)].transpose() * x[std::size_t(row[std::size_t(p)])];
      x[i] = xi;
    }
    for (int k = 0; k < n; ++k)
      for (int r = 0; r < B; ++r) {
        const int dof = oldIndex[std::size_t(k)] * B + r;
        if (dof < dofs) to[dof] = Scalar(x[std::size_t(k)][r]);
      }
  }

 private:
  std::vector<int> mark{}, path{}, reach{};
  std::vector<Block> work{};
  std::vector<Column> x{};

  void setOrder(std::vector<int> order) {
    oldIndex = std::move(order);
    newIndex.resize(oldIndex.size());
    for (std::size_t k = 0; k < oldIndex.size(); ++k) newIndex[std::size_t(oldIndex[k])] = int(k);
  }
  // the elimination tree, and the number of blocks in each column of L
  void analyse(Matrix const& a) {
    const std::size_t n = std::size_t(a.rows());
    parent.assign(n, -1);
    mark.assign(n, -1);
    filled.assign(n, 0);
    for (int k = 0; k < int(n); ++k) {
      mark[std::size_t(k)] = k;
      forEachBlock(a, k, [&](int i, int, bool) {
        for (; mark[std::size_t(i)] != k; i = parent[std::size_t(i)]) {
          if (parent[std::size_t(i)] < 0) parent[std::size_t(i)] = k;
          ++filled[std::size_t(i)];
          mark[std::size_t(i)] = k;
        }
      });
    }
  }
  // f(new row, slot, transposed) for the blocks of column k on and above the diagonal; with `transposed` the
  // slot has the block itself, else its transpose
  template <class F>
  void forEachBlock(Matrix const& a, int k, F&& f) const {
    a.forEachInRow(oldIndex[std::size_t(k)], [&](int column, int slot, bool transposed) {
      if (const int i = newIndex[std::size_t(column)]; i <= k) f(i, slot, transposed);
    });
  }
  // to = pivot^-1 by its own L D L'; returns the row of a pivot that vanishes, or -1
  int invert(Block pivot, Column const& diagonal, Block& to) {
    for (int c = 0; c < B; ++c) {
      const double d = pivot(c, c);
      if (!(std::abs(d) > noPivot<typename Matrix::Real> * std::abs(diagonal[c])) || !std::isfinite(d))
        return c;
      if (d < 0) ++negativePivots;
      for (int r = c + 1; r < B; ++r) {
        const double l = pivot(r, c) / d;
        for (int s = c + 1; s <= r; ++s) pivot(r, s) -= l * pivot(s, c);
      }
      for (int r = c + 1; r < B; ++r) pivot(r, c) /= d;
    }
    for (int k = 0; k < B; ++k) {
      Column e = Column::Unit(k);
      for (int r = k + 1; r < B; ++r)
        for (int c = k; c < r; ++c) e[r] -= pivot(r, c) * e[c];
      for (int r = B; r-- > 0;) {
        e[r] /= pivot(r, r);
        for (int c = r + 1; c < B; ++c) e[r] -= pivot(c, r) * e[c];
      }
      to.col(k) = e;
    }
    return -1;
  }
};

}  // namespace sinew
