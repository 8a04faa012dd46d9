// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/linalg/coarse_rows.hpp>

#include <algorithm>
#include <cstddef>
#include <cstring>
#include <vector>

namespace sinew {

/// to += A from, where A is an R x R block, row-major, or its transpose, and `from` and `to` are R rows.
template <int R, class Row>
void add_block_product(double const* a, bool transposed, Row const* from, Row* to) {
  if (transposed)
    for (int r = 0; r < R; ++r)
      for (int c = 0; c < R; ++c) to[r] += a[R * c + r] * from[c];
  else
    for (int r = 0; r < R; ++r)
      for (int c = 0; c < R; ++c) to[r] += a[R * r + c] * from[c];
}

/// P' A P into a fixed pattern, in double: first A P, row by row, then each row of the result from the rows
/// of its column of P, in their order. Rows are shared among threads, and have the same bits by any number of
/// them.
template <int R>
class GalerkinProduct {
 public:
  using Fine = CompressedRowSparseMatrix<double, R>;
  using Coarse = CompressedRowSparseMatrix<double, 6>;
  using Row = Sixes<double>::Row;

  /// The patterns of A P and of the coarse matrix.
  template <class P>
  void init(Fine const& a, P const& p, int threads, Coarse& coarse) {
    start_.assign(1, 0);
    columns_.clear();
    std::vector<int> seen(std::size_t(p.coarseRows()), -1);
    std::size_t longest = 0;
    for (int i = 0; i < a.rows(); ++i) {
      a.forEachInRow(i, [&](int j, int, bool) {
        for (int s = p.start[std::size_t(j)]; s < p.start[std::size_t(j) + 1]; ++s)
          if (int& last = seen[std::size_t(p.columns[std::size_t(s)])]; last != i)
            last = i, columns_.push_back(p.columns[std::size_t(s)]);
      });
      std::sort(columns_.begin() + start_.back(), columns_.end());
      longest = std::max(longest, columns_.size() - std::size_t(start_.back()));
      start_.push_back(int(columns_.size()));
    }
    product_.assign(columns_.size() * R, Row{});
    coarse.startPattern(6 * p.coarseRows());
    std::fill(seen.begin(), seen.end(), -1);
    for (int k = 0; k < p.coarseRows(); ++k) {
      auto& row = coarse.pattern[std::size_t(k)];
      for (int t = p.turnedStart[std::size_t(k)]; t < p.turnedStart[std::size_t(k) + 1]; ++t) {
        const std::size_t i = std::size_t(p.turnedRows[std::size_t(t)]);
        for (int s = start_[i]; s < start_[i + 1]; ++s)
          if (int& last = seen[std::size_t(columns_[std::size_t(s)])]; last != k)
            last = k, row.push_back(columns_[std::size_t(s)]);
      }
      longest = std::max(longest, row.size() + 1);
    }
    coarse.finishPattern();
    threads_.assign(std::size_t(threads), Thread{});
    for (Thread& t : threads_) {
      t.place.assign(std::size_t(p.coarseRows()), 0);
      t.sums.assign(longest * 6, Row{});
    }
  }

  template <class Run, class P>
  void update(Run const& workers, Fine const& a, P const& p, Coarse& coarse) {
    share_rows(workers, a.rows(), [&](int i, int thread) {
      const int first = start_[std::size_t(i)], count = start_[std::size_t(i) + 1] - first;
      int const* const place = places(thread, columns_.data() + first, count);
      Row* const sums = &product_[std::size_t(first) * R];
      std::fill(sums, sums + count * R, Row{});
      a.forEachInRow(i, [&](int j, int slot, bool transposed) {
        double const* const block = a.block(slot);
        for (int s = p.start[std::size_t(j)]; s < p.start[std::size_t(j) + 1]; ++s) {
          Row from[std::size_t(R)];
          for (int r = 0; r < R; ++r) Sixes<double>::convert(p.values[std::size_t(s * R + r)], from[r]);
          add_block_product<R>(block, transposed, from, sums + R * place[p.columns[std::size_t(s)]]);
        }
      });
    });
    share_rows(workers, coarse.rows(), [&](int k, int thread) {
      const int first = coarse.rowStart[std::size_t(k)], count = coarse.rowStart[std::size_t(k) + 1] - first;
      const Scratch own = row(thread, coarse.columns.data() + first, count, 6);
      for (int t = p.turnedStart[std::size_t(k)]; t < p.turnedStart[std::size_t(k) + 1]; ++t) {
        const std::size_t i = std::size_t(p.turnedRows[std::size_t(t)]);
        addRows(&p.values[std::size_t(p.turnedSlots[std::size_t(t)] * R)], i, k, own.place, own.sums);
      }
      for (int s = 0; s < count; ++s)
        for (int r = 0; r < 6; ++r)
          for (int c = 0; c < 6; ++c)
            coarse.values[std::size_t(36 * (first + s) + 6 * r + c)] =
                s == 0 ? 0.5 * (own.sums[r][c] + own.sums[c][r]) : own.sums[6 * s + r][c];
    });
  }

  struct Scratch {
    int const* place;
    Row* sums;
  };
  /// For a thread: where each of some columns has its place among them, and zeros for `height` rows of each.
  Scratch row(int thread, int const* columns, int count, int height) {
    auto& sums = threads_[std::size_t(thread)].sums;
    std::fill_n(sums.begin(), count * height, Row{});
    return {places(thread, columns, count), sums.data()};
  }

 private:
  struct Thread {
    std::vector<int> place{};
    std::vector<Row> sums{};
  };
  std::vector<Thread> threads_{};
  std::vector<int> start_{}, columns_{};  // rows of A P
  std::vector<Row> product_{};            // R rows a block

  int const* places(int thread, int const* columns, int count) {
    auto& place = threads_[std::size_t(thread)].place;
    for (int k = 0; k < count; ++k) place[std::size_t(columns[k])] = k;
    return place.data();
  }
  // sums += P_ik' (A P)_i, of the columns from k on
  template <class FloatRow>
  void addRows(FloatRow const* block, std::size_t i, int k, int const* place, Row* sums) const {
    double p[std::size_t(R)][6];
    for (int r = 0; r < R; ++r)
      for (int c = 0; c < 6; ++c) p[r][c] = double(block[r][c]);
    for (int s = start_[i]; s < start_[i + 1]; ++s) {
      if (columns_[std::size_t(s)] < k) continue;
      Row const* const of = &product_[std::size_t(s) * R];
      Row* const to = sums + 6 * place[columns_[std::size_t(s)]];
      for (int c = 0; c < 6; ++c) {
        Row sum = to[c];
        for (int r = 0; r < R; ++r) sum += p[r][c] * of[r];
        to[c] = sum;
      }
    }
  }
};

}  // namespace sinew
