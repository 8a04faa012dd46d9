// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/core/data_types.hpp>
#include <sinew/core/error.hpp>
#include <sinew/core/work_share.hpp>
#include <sinew/linalg/sliced_rows.hpp>

#include <algorithm>
#include <cstddef>
#include <cstring>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

namespace sinew {

/// Symmetric sparse matrix of dense B x B blocks, with a pattern that is fixed at init. Of it the blocks on
/// and above the diagonal are stored, in compressed rows that begin with their diagonal block. Blocks are
/// row-major. Rows and columns are counted in scalars where a name says `dof`, in blocks otherwise. Products
/// may take W lanes: files for other registers, or for nvcc, which has none, see another type.
template <class R, int B, int W = native_width<R>>
struct CompressedRowSparseMatrix {
  using Real = R;
  using Block = Eigen::Matrix<Real, B, B, B == 1 ? Eigen::ColMajor : Eigen::RowMajor>;
  static constexpr int blockSize = B;
  /// By which scene files know it.
  static constexpr std::string_view name =
      B == 3 ? (sizeof(R) == 8 ? "CompressedRowSparseMatrixMat3x3d" : "CompressedRowSparseMatrixMat3x3f")
             : (sizeof(R) == 8 ? "CompressedRowSparseMatrixd" : "CompressedRowSparseMatrixf");

  std::vector<int> rowStart{}, columns{};
  std::vector<int> leftStart{}, leftColumns{};  // of the blocks left of the diagonal, which are not stored,
  std::vector<int> leftSlots{};                 // and the slots of those across the diagonal
  // B*B a block; then a block of zeros, and one more so that kernels may read past the end
  std::vector<Real> values{};
  std::vector<std::vector<int>> pattern{};  // block columns of each row, while the pattern is gathered
  /// Stored blocks from which on rows are sliced, where the pattern suits: in double what a solve gains is
  /// not more than what filling the slices costs as long as a matrix stays in the caches.
  std::size_t slicedFrom = sizeof(Real) == 4 ? 0 : 80000;

  int rows() const { return rowStart.empty() ? 0 : int(rowStart.size()) - 1; }
  int dofs() const { return rows() * B; }
  /// That its arrays take, with what products need.
  std::size_t bytes() const {
    const std::size_t numbers = rowStart.size() + columns.size() + leftStart.size() + 2 * leftColumns.size();
    std::size_t all = values.size() * sizeof(Real) + numbers * sizeof(int) + ends.size() * sizeof(End);
    if constexpr (sliceable) all += sliced.bytes();
    return all;
  }

  /// Of them what a product reads, as it is made since the matrix changed last.
  std::size_t productBytes() const {
    if constexpr (sliceable)
      if (sliced.suits()) return sliced.productBytes();
    return values.size() * sizeof(Real) + (rowStart.size() + columns.size()) * sizeof(int);
  }

  void startPattern(int dofs) {
    pattern.assign(std::size_t((dofs + B - 1) / B), {});
    for (std::size_t i = 0; i < pattern.size(); ++i) pattern[i].push_back(int(i));
  }

  /// Adds a block of h x w scalars at (dof row, dof column), and its mirror image, to the pattern.
  void preallocate(int row, int column, int h, int w) {
    for (int i = row / B; i <= (row + h - 1) / B; ++i)
      for (int j = column / B; j <= (column + w - 1) / B; ++j) {
        insert(pattern[std::size_t(i)], j);
        insert(pattern[std::size_t(j)], i);
      }
  }

  /// Adds to the pattern what projectToMean with the same arguments fills. To be called after all other
  /// additions but those of its kind.
  template <class Dofs>
  void preallocateMean(Dofs const& starts, int coordinates) {
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
    leftStart.assign(pattern.size() + 1, 0);
    for (std::size_t i = 0; i < pattern.size(); ++i) {
      compact(pattern[i]);
      const auto diagonal = std::lower_bound(pattern[i].begin(), pattern[i].end(), int(i));
      leftStart[i + 1] = leftStart[i] + int(diagonal - pattern[i].begin());
      columns.insert(columns.end(), diagonal, pattern[i].end());
      rowStart.push_back(int(columns.size()));
    }
    pattern = {};
    values.assign((columns.size() + 1) * B * B + 1, Real(0));
    leftColumns.resize(std::size_t(leftStart.back()));
    leftSlots.resize(leftColumns.size());
    std::vector<int> next(leftStart.begin(), leftStart.end() - 1);
    for (int i = 0; i < rows(); ++i)
      for (int k = rowStart[std::size_t(i)] + 1; k < rowStart[std::size_t(i) + 1]; ++k) {
        const std::size_t left = std::size_t(next[std::size_t(columns[std::size_t(k)])]++);
        leftColumns[left] = i;
        leftSlots[left] = k;
      }
    ends.assign(B == 3 ? std::size_t(rows()) : 0, End{});
    if constexpr (sliceable) {
      sliced = {};
      if (columns.size() >= slicedFrom) sliced.init(rowStart, columns, int(columns.size()));
    }
    dots.assign(std::size_t(rows()) / strip + 1, 0);
    chunks.clear();
  }

  /// Prepares products by so many threads, with at least so many rows each. Where the rows are too few, there
  /// are fewer chunks, or none.
  void split(int threads, int minimum = 128) {
    const int n = B == 3 ? std::min(threads, rows() / minimum) : 1;
    chunks.clear();
    std::size_t endCount = 0;
    for (int k = 0, from = 0; n > 1 && k < n; ++k) {
      const std::size_t blocks = columns.size() * std::size_t(k + 1) / std::size_t(n);
      int to = int(std::lower_bound(rowStart.begin(), rowStart.end(), int(blocks)) - rowStart.begin());
      to = k + 1 == n ? rows() : std::max(from, to / strip * strip);
      int last = to;
      for (int i = from; i < to; ++i)
        last = std::max(last, columns[std::size_t(rowStart[std::size_t(i) + 1]) - 1] + 1);
      chunks.push_back({from, to, last, endCount});
      endCount += std::size_t(last - from);
      from = to;
    }
    ends.resize(std::max(endCount, B == 3 ? std::size_t(rows()) : 0));
    if constexpr (sliceable) sliced.split(std::max(n, 1));
  }

  void setZero() { setZero(OneThread{}); }
  template <class Run>
  void setZero(Run const& workers) {
    auto zero = [&](WorkShare share) {
      const std::size_t begin = share.begin(values.size());
      std::memset(values.data() + begin, 0, (share.end(values.size()) - begin) * sizeof(Real));
    };
    if (chunks.empty())
      zero(WorkShare{});
    else
      workers.run(zero);
    changed();
  }

  /// Position of a block, or of the one across the diagonal, in `columns`; -1 where the pattern has none.
  int slot(int row, int column) const {
    if (row > column) std::swap(row, column);
    const auto first = columns.begin() + rowStart[std::size_t(row)],
               last = columns.begin() + rowStart[std::size_t(row) + 1];
    const auto found = std::lower_bound(first, last, column);
    return found != last && *found == column ? int(found - columns.begin()) : -1;
  }
  /// f(column, slot, transposed) for each block of a row, from left to right; transposed: the slot has its
  /// transpose.
  template <class F>
  void forEachInRow(int row, F&& f) const {
    const std::size_t i = std::size_t(row);
    for (int k = leftStart[i]; k < leftStart[i + 1]; ++k)
      f(leftColumns[std::size_t(k)], leftSlots[std::size_t(k)], true);
    for (int k = rowStart[i]; k < rowStart[i + 1]; ++k) f(columns[std::size_t(k)], k, false);
  }
  Real* block(int slot) {
    changed();
    return values.data() + std::ptrdiff_t(slot) * (B * B);
  }
  Real const* block(int slot) const { return values.data() + std::ptrdiff_t(slot) * (B * B); }

  /// A(row.., column..) += K, in dofs; K of any size. What falls below the diagonal is what the transpose of
  /// K adds above it.
  template <class K>
  void add(int row, int column, K const& k) {
    const int h = int(k.rows()), w = int(k.cols());
    if constexpr (K::RowsAtCompileTime == B && K::ColsAtCompileTime == B)
      if (row == column && row % B == 0) {
        Eigen::Map<Block>(block(rowStart[std::size_t(row / B)])) += k.template cast<Real>();
        return;
      }
    for (int i = 0; i < h; ++i)
      for (int j = 0; j < w; ++j) {
        const int r = row + i, c = column + j;
        if (r / B > c / B) continue;
        const int s = slot(r / B, c / B);
        if (s < 0)
          throw Error("CompressedRowSparseMatrix",
                      text("there is no block at row ", r, ", column ", c, " of the pattern"));
        block(s)[(r % B) * B + c % B] += Real(k(i, j));
      }
  }

  /// Row and column `dof` become those of the identity; to be called when all has been added.
  void fix(int dof) {
    const int r = dof / B, s = dof % B;
    forEachInRow(r, [&](int column, int slot, bool transposed) {
      Real* const entries = block(slot);
      for (int j = 0; j < B; ++j) {
        if (transposed || column == r) entries[j * B + s] = 0;
        if (!transposed) entries[s * B + j] = 0;
      }
    });
    block(rowStart[std::size_t(r)])[s * (B + 1)] = 1;
  }

  /// A = P A P + (I - P) on the dofs from `dof` on, with a symmetric projector P of any fixed size; to be
  /// called when all has been added. The dofs are those of one point, and share their pattern.
  template <class P>
  void project(int dof, P const& p) {
    constexpr int n = P::RowsAtCompileTime;
    const Mat<Real, n> projector = p.template cast<Real>();
    Mat<Real, n> own = Mat<Real, n>::Zero();
    const int r = dof / B;
    forEachInRow(r, [&](int column, int, bool) {
      for (int j = 0; j < B; ++j) {
        const int c = column * B + j;
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
    });
    // columns of the own dofs that stand in blocks behind that of the first
    for (int c = (r + 1) * B; c < dof + n; ++c)
      for (int i = 0; i < n; ++i)
        if (Real const* const entry = find(dof + i, c)) own(i, c - dof) = *entry;
    own = (projector * own * projector + Mat<Real, n>::Identity() - projector).eval();
    for (int i = 0; i < n; ++i)
      for (int j = 0; j < n; ++j) put(dof + i, dof + j, own(i, j));
  }

  /// A = P A P + (I - P), where P replaces each of the first coordinates of some points, whose dofs begin at
  /// `starts`, by its mean over them; to be called when all has been added.
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
      forEachInRow((starts[0] + c) / B, [&](int blockColumn, int, bool) {
        for (int j = 0; j < B; ++j) {
          const int column = blockColumn * B + j;
          if (own(column)) continue;
          const Real mean = sum(column) * share;
          for (const int dof : starts) put(dof + c, column, mean), put(column, dof + c, mean);
        }
      });
      Real mean = 0;
      for (const int dof : starts) mean += sum(dof + c);
      mean *= share * share;
      for (const int a : starts)
        for (const int b : starts) put(a + c, b + c, mean + Real(a == b) - share);
    }
  }

  /// y = A x, both of dofs() scalars, with one more scalar of any value readable behind x. Returns x.y.
  double multiply(Real const* x, Real* y) { return multiply(OneThread{}, x, y); }
  /// The same by several threads, for which split() has prepared: the same bits.
  template <class Run>
  double multiply([[maybe_unused]] Run const& workers, Real const* x, Real* y) {
    if constexpr (sliceable) {
      if (sliced.suits()) {
        if (sliced.products == 3) sliced.pack(workers, values.data()), ++sliced.products;
        return sliced.multiply(workers, x, y);
      }
      ++sliced.products;
    }
    if constexpr (B == 3) {
      bool done = false;
      if constexpr (!std::is_same_v<Run, OneThread>)
        if (!chunks.empty()) {
          workers.run([&](WorkShare share) {
            for (std::size_t k = share.begin(chunks.size()); k < share.end(chunks.size()); ++k)
              multiplyChunk(chunks[k], x, y);
          });
          done = true;
        }
      if (!done) multiplyChunk({0, rows(), rows(), 0}, x, y);
      double sum = 0;
      for (const double dot : dots) sum += dot;
      return sum;
    } else {
      return multiplyAny(x, y);
    }
  }

 private:
  typedef Real Four __attribute__((vector_size(4 * sizeof(Real))));
  // of the product: what a row multiplies with, and what blocks above have added to it
  struct End {
    Four x, y;
  };
  std::vector<End> ends{};
  static constexpr bool sliceable = B == 3 && SlicedRows<Real, W>::possible;
  struct Nothing {};
  [[no_unique_address]] std::conditional_t<sliceable, SlicedRows<Real, W>, Nothing> sliced{};

  // written once after a product, by setZero(): threads that then add to blocks of their own only read it
  void changed() {
    if constexpr (sliceable)
      if (sliced.products != 0) sliced.products = 0;
  }
  // rows of one thread, the last column of them, and where its ends begin
  struct Chunk {
    int from, to, last;
    std::size_t ends;
  };
  std::vector<Chunk> chunks{};
  // x.y of so many rows each, which are added in their order
  static constexpr int strip = 64;
  std::vector<double> dots{};

  Real* find(int row, int column) {
    if (row / B > column / B) std::swap(row, column);
    const int s = slot(row / B, column / B);
    return s < 0 ? nullptr : block(s) + (row % B) * B + column % B;
  }
  // what the pattern has no place for is zero, but for what two points in one block would mix
  void put(int row, int column, Real value) {
    if (Real* const entry = find(row, column))
      *entry = value;
    else if (value != Real(0))
      throw Error("CompressedRowSparseMatrix",
                  text("there is no block at row ", row, ", column ", column, " of the pattern"));
  }

  // the rows are short, and the same block is added by every element around an edge: compact before growing
  static void insert(std::vector<int>& row, int column) {
    if (row.size() == row.capacity() && row.size() >= 32) compact(row);
    row.push_back(column);
  }
  static void compact(std::vector<int>& row) {
    std::sort(row.begin(), row.end());
    row.erase(std::unique(row.begin(), row.end()), row.end());
  }

  double multiplyAny(Real const* x, Real* y) const {
    using Column = Vec<Real, B>;
    std::memset(y, 0, std::size_t(dofs()) * sizeof(Real));
    double dot = 0;
    for (int i = 0; i < rows(); ++i) {
      const Column own = Eigen::Map<Column const>(x + i * B);
      int k = rowStart[std::size_t(i)];
      Column sum = Eigen::Map<Block const>(block(k)) * own;
      for (++k; k < rowStart[std::size_t(i) + 1]; ++k) {
        const Eigen::Map<Block const> a(block(k));
        const int j = columns[std::size_t(k)] * B;
        sum.noalias() += a * Eigen::Map<Column const>(x + j);
        Eigen::Map<Column>(y + j).noalias() += a.transpose() * own;
      }
      Eigen::Map<Column>(y + i * B) += sum;
      for (int c = 0; c < B; ++c) dot += double(own[c]) * double(y[i * B + c]);
    }
    return dot;
  }

  // Each block is read once, for its own row and, transposed, for the row of its column: y_i += A x_j and y_j
  // += A' x_i. Its rows are loaded as four scalars; the fourth products, of what stands behind, gather in
  // lanes that are never read. Two blocks at a time keep six independent sums in flight. Row i is complete
  // when its turn has come: those above have left their parts in its End. A chunk of rows does by itself what
  // chunks above would add to it, before all else and in the same order, and what it adds to those below is
  // lost.
  void multiplyChunk(Chunk const& chunk, Real const* x, Real* y) {
    typedef double Doubles __attribute__((vector_size(4 * sizeof(double))));
    auto load = [](Four& to, Real const* from) { std::memcpy(&to, from, sizeof to); };
    const std::size_t from = std::size_t(chunk.from), to = std::size_t(chunk.to),
                      last = std::size_t(chunk.last);
    End* const own_ends = ends.data() + chunk.ends;
    auto end = [own_ends, from](std::size_t i) -> End& { return own_ends[i - from]; };
    for (std::size_t i = from; i < last; ++i) load(end(i).x, x + 3 * i), end(i).y = Four{};
    if (from > 0)
      for (std::size_t i = from; i < to; ++i)
        for (int k = leftStart[i]; k < leftStart[i + 1] && leftColumns[std::size_t(k)] < chunk.from; ++k) {
          Real const* const above = x + 3 * std::size_t(leftColumns[std::size_t(k)]);
          Real const* const v = values.data() + 9 * std::ptrdiff_t(leftSlots[std::size_t(k)]);
          Four r0, r1, r2;
          load(r0, v), load(r1, v + 3), load(r2, v + 6);
          end(i).y += r0 * above[0] + r1 * above[1] + r2 * above[2];
        }
    int const *start = rowStart.data() + from, *column = columns.data() + *start;
    Real const* v = values.data() + 9 * std::ptrdiff_t(*start);
    for (std::size_t i = from; i < to;) {
      Doubles dot{};
      double& sum = dots[i / strip];
      for (const std::size_t stop = std::min(to, i + strip); i < stop; ++i) {
        const Four own = end(i).x;
        const Real x0 = own[0], x1 = own[1], x2 = own[2];
        Four r0, r1, r2, s0, s1, s2;
        load(r0, v), load(r1, v + 3), load(r2, v + 6);
        Four a0 = r0 * own, a1 = r1 * own, a2 = r2 * own, b0{}, b1{}, b2{};
        int const* const next = columns.data() + *++start;
        for (++column, v += 9; column + 1 < next; column += 2, v += 18) {
          End &a = end(std::size_t(column[0])), &b = end(std::size_t(column[1]));
          load(r0, v), load(r1, v + 3), load(r2, v + 6);
          load(s0, v + 9), load(s1, v + 12), load(s2, v + 15);
          a0 += r0 * a.x, a1 += r1 * a.x, a2 += r2 * a.x;
          b0 += s0 * b.x, b1 += s1 * b.x, b2 += s2 * b.x;
          a.y += r0 * x0 + r1 * x1 + r2 * x2;
          b.y += s0 * x0 + s1 * x1 + s2 * x2;
        }
        if (column < next) {
          End& a = end(std::size_t(*column++));
          load(r0, v), load(r1, v + 3), load(r2, v + 6), v += 9;
          a0 += r0 * a.x, a1 += r1 * a.x, a2 += r2 * a.x;
          a.y += r0 * x0 + r1 * x1 + r2 * x2;
        }
        a0 += b0, a1 += b1, a2 += b2;
        const Four even = __builtin_shufflevector(a0, a1, 0, 4, 2, 6),
                   odd = __builtin_shufflevector(a0, a1, 1, 5, 3, 7);
        const Four row =
            (end(i).y + __builtin_shufflevector(even, a2, 0, 1, 4, 5)) +
            (__builtin_shufflevector(odd, a2, 0, 1, 5, 5) + __builtin_shufflevector(even, a2, 2, 3, 6, 7));
        dot += __builtin_convertvector(own, Doubles) * __builtin_convertvector(row, Doubles);
        for (std::size_t c = 0; c < 3; ++c) y[3 * i + c] = row[c];
      }
      sum = dot[0] + dot[1] + dot[2];
    }
  }
};

using CompressedRowSparseMatrixMat3x3d = CompressedRowSparseMatrix<double, 3>;
using CompressedRowSparseMatrixMat3x3f = CompressedRowSparseMatrix<float, 3>;
using CompressedRowSparseMatrixd = CompressedRowSparseMatrix<double, 1>;
using CompressedRowSparseMatrixf = CompressedRowSparseMatrix<float, 1>;

}  // namespace sinew
