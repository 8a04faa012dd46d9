// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/core/data_types.hpp>
#include <sinew/core/error.hpp>

#include <algorithm>
#include <cstddef>
#include <cstring>
#include <string_view>
#include <vector>

namespace sinew {

/// Symmetric sparse matrix of dense B x B blocks in compressed rows, with a pattern that is fixed at init.
/// Between setZero() and mirror() only the blocks on and above the diagonal are added to; mirror() then fills
/// those below. Blocks are row-major. Rows and columns are counted in scalars where a name says `dof`, in
/// blocks otherwise.
template <class R, int B>
struct CompressedRowSparseMatrix {
  using Real = R;
  using Block = Eigen::Matrix<Real, B, B, B == 1 ? Eigen::ColMajor : Eigen::RowMajor>;
  static constexpr int blockSize = B;
  /// By which scene files know it.
  static constexpr std::string_view name =
      B == 3 ? (sizeof(R) == 8 ? "CompressedRowSparseMatrixMat3x3d" : "CompressedRowSparseMatrixMat3x3f")
             : (sizeof(R) == 8 ? "CompressedRowSparseMatrixd" : "CompressedRowSparseMatrixf");

  std::vector<int> rowStart{}, columns{};
  std::vector<Real> values{};               // B*B a block, and one more so that kernels may read past the end
  std::vector<int> diagonal{};              // slot of the diagonal block of each row
  std::vector<int> mirrored{};              // slot of the block across the diagonal, for each slot
  std::vector<std::vector<int>> pattern{};  // block columns of each row, while the pattern is gathered

  int rows() const { return rowStart.empty() ? 0 : int(rowStart.size()) - 1; }
  int dofs() const { return rows() * B; }

  void startPattern(int dofs) {
    pattern.assign(std::size_t((dofs + B - 1) / B), {});
    for (std::size_t i = 0; i < pattern.size(); ++i) pattern[i].push_back(int(i));
  }

  /// Announces a block of h x w scalars at (dof row, dof column), and its mirror image.
  void announce(int row, int column, int h, int w) {
    for (int i = row / B; i <= (row + h - 1) / B; ++i)
      for (int j = column / B; j <= (column + w - 1) / B; ++j) {
        insert(pattern[std::size_t(i)], j);
        insert(pattern[std::size_t(j)], i);
      }
  }

  /// Announces what projectToMean with the same arguments fills. Comes behind all other announcements but
  /// those of its kind.
  template <class Dofs>
  void announceMean(Dofs const& starts, int coordinates) {
    std::vector<int> own, all;
    for (const int dof : starts)
      for (int i = dof / B; i <= (dof + coordinates - 1) / B; ++i) own.push_back(i);
    compact(own);
    all = own;
    for (const int i : own)
      all.insert(all.end(), pattern[std::size_t(i)].begin(), pattern[std::size_t(i)].end());
    compact(all);
    for (const int j : all)
      for (const int i : own) insert(pattern[std::size_t(j)], i);
    for (const int i : own) pattern[std::size_t(i)] = all;
  }

  void finishPattern() {
    rowStart.assign(1, 0);
    columns.clear();
    for (auto& row : pattern) {
      compact(row);
      columns.insert(columns.end(), row.begin(), row.end());
      rowStart.push_back(int(columns.size()));
    }
    pattern = {};
    values.assign(columns.size() * B * B + 1, Real(0));
    diagonal.resize(std::size_t(rows()));
    mirrored.resize(columns.size());
    for (int i = 0; i < rows(); ++i)
      for (int k = rowStart[std::size_t(i)]; k < rowStart[std::size_t(i) + 1]; ++k) {
        mirrored[std::size_t(k)] = slot(columns[std::size_t(k)], i);
        if (columns[std::size_t(k)] == i) diagonal[std::size_t(i)] = k;
      }
  }

  void setZero() {
    for (int i = 0; i < rows(); ++i) {
      Real* const first = block(diagonal[std::size_t(i)]);
      std::memset(first, 0, std::size_t(block(rowStart[std::size_t(i) + 1]) - first) * sizeof(Real));
    }
  }

  void mirror() {
    for (int i = 0; i < rows(); ++i)
      for (int k = diagonal[std::size_t(i)] + 1; k < rowStart[std::size_t(i) + 1]; ++k) {
        Real const* const upper = block(k);
        Real* const lower = block(mirrored[std::size_t(k)]);
        for (int r = 0; r < B; ++r)
          for (int c = 0; c < B; ++c) lower[c * B + r] = upper[r * B + c];
      }
  }

  /// Position of a block in `columns`, or -1 where the pattern has none.
  int slot(int row, int column) const {
    const auto first = columns.begin() + rowStart[std::size_t(row)],
               last = columns.begin() + rowStart[std::size_t(row) + 1];
    const auto found = std::lower_bound(first, last, column);
    return found != last && *found == column ? int(found - columns.begin()) : -1;
  }
  Real* block(int slot) { return values.data() + std::ptrdiff_t(slot) * (B * B); }
  Real const* block(int slot) const { return values.data() + std::ptrdiff_t(slot) * (B * B); }

  /// A(row.., column..) += K, in dofs; K of any size. What falls below the diagonal is left to
  /// mirror().
  template <class K>
  void add(int row, int column, K const& k) {
    const int h = int(k.rows()), w = int(k.cols());
    if constexpr (K::RowsAtCompileTime == B && K::ColsAtCompileTime == B)
      if (row == column && row % B == 0) {
        Eigen::Map<Block>(block(diagonal[std::size_t(row / B)])) += k.template cast<Real>();
        return;
      }
    for (int i = 0; i < h; ++i)
      for (int j = 0; j < w; ++j) {
        const int r = row + i, c = column + j;
        if (r / B > c / B) continue;
        const int s = slot(r / B, c / B);
        if (s < 0)
          throw Error("CompressedRowSparseMatrix",
                      text("nothing was announced at row ", r, ", column ", c, " of the pattern"));
        block(s)[(r % B) * B + c % B] += Real(k(i, j));
      }
  }

  /// Row and column `dof` become those of the identity; to be called after mirror().
  void fix(int dof) {
    const int r = dof / B, s = dof % B;
    for (int k = rowStart[std::size_t(r)]; k < rowStart[std::size_t(r) + 1]; ++k) {
      const int c = columns[std::size_t(k)];
      Real *row = block(k), *column = block(mirrored[std::size_t(k)]);
      for (int j = 0; j < B; ++j) row[s * B + j] = column[j * B + s] = 0;
      if (c == r) row[s * B + s] = 1;
    }
  }

  /// A = P A P + (I - P) on the dofs from `dof` on, with a symmetric projector P of any fixed size; to be
  /// called after mirror(). The dofs are those of one point, and share their pattern.
  template <class P>
  void project(int dof, P const& p) {
    constexpr int n = P::RowsAtCompileTime;
    const Mat<Real, n> projector = p.template cast<Real>();
    Mat<Real, n> own = Mat<Real, n>::Zero();
    const int r = dof / B;
    for (int k = rowStart[std::size_t(r)]; k < rowStart[std::size_t(r) + 1]; ++k)
      for (int j = 0; j < B; ++j) {
        const int c = columns[std::size_t(k)] * B + j;
        Vec<Real, n> a = Vec<Real, n>::Zero();
        for (int i = 0; i < n; ++i)
          if (Real const* const entry = find(dof + i, c)) a[i] = *entry;
        if (c >= dof && c < dof + n) {
          own.col(c - dof) = a;
          continue;
        }
        a = (projector * a).eval();
        for (int i = 0; i < n; ++i) {
          put(dof + i, c, a[i]);
          put(c, dof + i, a[i]);
        }
      }
    // columns of the own dofs that stand in blocks behind that of the first
    for (int c = (r + 1) * B; c < dof + n; ++c)
      for (int i = 0; i < n; ++i)
        if (Real const* const entry = find(dof + i, c)) own(i, c - dof) = *entry;
    own = (projector * own * projector + Mat<Real, n>::Identity() - projector).eval();
    for (int i = 0; i < n; ++i)
      for (int j = 0; j < n; ++j) put(dof + i, dof + j, own(i, j));
  }

  /// A = P A P + (I - P), where P replaces each of the first coordinates of some points, whose dofs begin at
  /// `starts`, by its mean over them; to be called after mirror().
  template <class Dofs>
  void projectToMean(Dofs const& starts, int coordinates) {
    const Real share = Real(1) / Real(starts.size());
    for (int c = 0; c < coordinates; ++c) {
      auto own = [&](int column) {
        for (const int dof : starts)
          if (dof + c == column) return true;
        return false;
      };
      auto sum = [&](int column) {
        Real total = 0;
        for (const int dof : starts)
          if (Real const* const entry = find(dof + c, column)) total += *entry;
        return total;
      };
      const std::size_t r = std::size_t((starts[0] + c) / B);
      for (int k = rowStart[r]; k < rowStart[r + 1]; ++k)
        for (int j = 0; j < B; ++j) {
          const int column = columns[std::size_t(k)] * B + j;
          if (own(column)) continue;
          const Real mean = sum(column) * share;
          for (const int dof : starts) put(dof + c, column, mean), put(column, dof + c, mean);
        }
      Real mean = 0;
      for (const int dof : starts) mean += sum(dof + c);
      mean *= share * share;
      for (const int a : starts)
        for (const int b : starts) put(a + c, b + c, mean + Real(a == b) - share);
    }
  }

  /// y = A x, both of dofs() scalars, with one more scalar of any value readable behind x.
  void multiply(Real const* x, Real* y) const {
    if constexpr (B == 3) {
      multiply3(x, y);
    } else {
      for (int i = 0; i < rows(); ++i) {
        Vec<Real, B> sum = Vec<Real, B>::Zero();
        for (int k = rowStart[std::size_t(i)]; k < rowStart[std::size_t(i) + 1]; ++k)
          sum.noalias() += Eigen::Map<Block const>(block(k)) *
                           Eigen::Map<Vec<Real, B> const>(x + columns[std::size_t(k)] * B);
        Eigen::Map<Vec<Real, B>>(y + i * B) = sum;
      }
    }
  }

 private:
  Real* find(int row, int column) {
    const int s = slot(row / B, column / B);
    return s < 0 ? nullptr : block(s) + (row % B) * B + column % B;
  }
  // what the pattern has no place for is zero, but for what two points in one block would mix
  void put(int row, int column, Real value) {
    if (Real* const entry = find(row, column))
      *entry = value;
    else if (value != Real(0))
      throw Error("CompressedRowSparseMatrix",
                  text("nothing was announced at row ", row, ", column ", column, " of the pattern"));
  }

  // the rows are short, and the same block is announced by every element around an edge: compact before
  // growing
  static void insert(std::vector<int>& row, int column) {
    if (row.size() == row.capacity() && row.size() >= 32) compact(row);
    row.push_back(column);
  }
  static void compact(std::vector<int>& row) {
    std::sort(row.begin(), row.end());
    row.erase(std::unique(row.begin(), row.end()), row.end());
  }

  // Each row of a block is loaded as four scalars and multiplied with four of x; the fourth products, of what
  // stands behind, gather in a lane that is never read. Two blocks at a time keep six independent sums in
  // flight.
  void multiply3(Real const* x, Real* y) const {
    typedef Real Four __attribute__((vector_size(4 * sizeof(Real))));
    auto addProduct = [](Four& sum, Real const* row, Four const& p) {
      Four a;
      std::memcpy(&a, row, sizeof a);
      sum += a * p;
    };
    auto sum = [](Four const& a) { return a[0] + a[1] + a[2]; };
    const int n = rows();
    int const* const column = columns.data();
    for (int i = 0; i < n; ++i) {
      Four a0{}, a1{}, a2{}, b0{}, b1{}, b2{};
      int k = rowStart[std::size_t(i)];
      const int end = rowStart[std::size_t(i) + 1];
      Real const* v = block(k);
      for (; k + 1 < end; k += 2, v += 18) {
        Four p, q;
        std::memcpy(&p, x + 3 * column[k], sizeof p);
        std::memcpy(&q, x + 3 * column[k + 1], sizeof q);
        addProduct(a0, v, p);
        addProduct(a1, v + 3, p);
        addProduct(a2, v + 6, p);
        addProduct(b0, v + 9, q);
        addProduct(b1, v + 12, q);
        addProduct(b2, v + 15, q);
      }
      if (k < end) {
        Four p;
        std::memcpy(&p, x + 3 * column[k], sizeof p);
        addProduct(a0, v, p);
        addProduct(a1, v + 3, p);
        addProduct(a2, v + 6, p);
      }
      y[3 * i] = sum(a0 + b0), y[3 * i + 1] = sum(a1 + b1), y[3 * i + 2] = sum(a2 + b2);
    }
  }
};

using CompressedRowSparseMatrixMat3x3d = CompressedRowSparseMatrix<double, 3>;
using CompressedRowSparseMatrixMat3x3f = CompressedRowSparseMatrix<float, 3>;
using CompressedRowSparseMatrixd = CompressedRowSparseMatrix<double, 1>;
using CompressedRowSparseMatrixf = CompressedRowSparseMatrix<float, 1>;

}  // namespace sinew
