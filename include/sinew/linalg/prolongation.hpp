// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/linalg/aggregation.hpp>
#include <sinew/linalg/coarse_rows.hpp>
#include <sinew/linalg/galerkin_product.hpp>
#include <sinew/linalg/lattice.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>
#include <vector>

namespace sinew {

/// What interpolates from six unknowns of each aggregate to the R unknowns of each of its points, by smoothed
/// aggregation (Vanek, Mandel, Brezina 1996): P = (I - w A) T, where T has, within each aggregate, an
/// orthonormal basis of the modes that A maps to nearly nothing. A has unit diagonal blocks. The coarse
/// matrix is P' A P. Modes are six numbers a row, in registers of eight.
template <int R>
struct Prolongation {
  using Fine = CompressedRowSparseMatrix<double, R>;
  using Row = Sixes<double>::Row;
  using FloatRow = Sixes<float>::Row;

  std::vector<int> memberStart{}, members{};                    // points of each aggregate
  std::vector<int> aggregate{};                                 // of each point
  std::vector<int> start{}, columns{};                          // rows of P
  std::vector<FloatRow> values{};                               // R rows a block
  std::vector<int> turnedStart{}, turnedRows{}, turnedSlots{};  // columns of P
  std::vector<Row> tentative{};                                 // T, R rows a point
  GalerkinProduct<R> galerkin{};

  int coarseRows() const { return int(memberStart.size()) - 1; }

  /// Aggregates and patterns, that of the coarse matrix too. Connections count where the Frobenius norm of
  /// their block is above `threshold`; rows that are `alone` take nothing from the coarse side. Aggregates
  /// are the cells of a lattice where points stand on one that suits the connections, and it becomes that of
  /// the aggregates; those that are `known` are not looked for. False where there is nothing to aggregate, or
  /// no row would be saved.
  bool init(Fine const& a, std::vector<char> const& alone, double threshold, int threads,
            CompressedRowSparseMatrix<double, 6>& coarse, Lattice& lattice,
            Aggregates const* known = nullptr) {
    const int n = a.rows();
    Aggregates found = known ? *known : find(a, threshold, lattice);
    if (found.count == 0 || 6 * found.count >= R * n) return false;
    aggregate = std::move(found.of);
    collect(found.count);
    std::vector<int> row;
    start.assign(1, 0);
    columns.clear();
    for (int i = 0; i < n; ++i) {
      row.clear();
      a.forEachInRow(i, [&](int j, int, bool) {
        if (aggregate[std::size_t(j)] >= 0) row.push_back(aggregate[std::size_t(j)]);
      });
      std::sort(row.begin(), row.end());
      row.erase(std::unique(row.begin(), row.end()), row.end());
      if (alone.empty() || !alone[std::size_t(i)]) columns.insert(columns.end(), row.begin(), row.end());
      start.push_back(int(columns.size()));
    }
    transpose();
    values.assign(columns.size() * R, FloatRow{});
    tentative.assign(std::size_t(n) * R, Row{});
    galerkin.init(a, *this, threads, coarse);
    return true;
  }

  /// T and the modes of the coarse side, T' modes, so that modes = T (T' modes): in each aggregate by the
  /// process of Gram and Schmidt, twice. Modes that depend on those before leave a column of zeros.
  template <class Run>
  void orthogonalise(Run const& workers, std::vector<Row> const& modes, std::vector<Row>& coarse) {
    share_rows(workers, coarseRows(), [&](int k, int) {
      Row* const own = &coarse[6 * std::size_t(k)];
      for (int c = 0; c < 6; ++c) own[c] = Row{};
      const int first = memberStart[std::size_t(k)], last = memberStart[std::size_t(k) + 1];
      auto each = [&](auto&& f) {
        for (int m = first; m < last; ++m)
          for (int r = 0; r < R; ++r) f(std::size_t(members[std::size_t(m)] * R + r));
      };
      each([&](std::size_t i) { tentative[i] = modes[i]; });
      auto dot = [&](int c, int d) {
        double sum = 0;
        each([&](std::size_t i) { sum += tentative[i][c] * tentative[i][d]; });
        return sum;
      };
      for (int c = 0; c < 6; ++c) {
        const double before = std::sqrt(dot(c, c));
        for (int twice = 0; twice < 2; ++twice)
          for (int d = 0; d < c; ++d) {
            const double f = dot(c, d);
            own[d][c] += f;
            each([&](std::size_t i) { tentative[i][c] -= f * tentative[i][d]; });
          }
        const double norm = std::sqrt(dot(c, c));
        const bool free = norm > 1e-8 * before && norm > 0;
        own[c][c] = free ? norm : 0;
        each([&](std::size_t i) { tentative[i][c] = free ? tentative[i][c] / norm : 0; });
      }
    });
  }

  /// P = (I - w A) T
  template <class Run>
  void smooth(Run const& workers, Fine const& a, double w) {
    share_rows(workers, a.rows(), [&](int i, int thread) {
      const int first = start[std::size_t(i)], count = start[std::size_t(i) + 1] - first;
      if (count == 0) return;
      auto const own = galerkin.row(thread, columns.data() + first, count, R);
      a.forEachInRow(i, [&](int j, int slot, bool transposed) {
        if (const int k = aggregate[std::size_t(j)]; k >= 0)
          add_block_product<R>(
              a.block(slot), transposed, &tentative[std::size_t(j * R)], own.sums + R * own.place[k]);
      });
      for (int k = 0; k < count; ++k)
        for (int r = 0; r < R; ++r) {
          Row p = -w * own.sums[R * k + r];
          if (columns[std::size_t(first + k)] == aggregate[std::size_t(i)])
            p += tentative[std::size_t(i * R + r)];
          Sixes<float>::convert(p, values[std::size_t((first + k) * R + r)]);
        }
    });
  }

  /// P = P W', W = of[k] in the columns of aggregate k.
  template <class Run, class Block>
  void scale(Run const& workers, std::vector<Block> const& of) {
    share_rows(workers, int(start.size()) - 1, [&](int i, int) {
      for (int s = start[std::size_t(i)]; s < start[std::size_t(i) + 1]; ++s) {
        Block const& w = of[std::size_t(columns[std::size_t(s)])];
        for (int r = 0; r < R; ++r) {
          FloatRow& p = values[std::size_t(s * R + r)];
          Row sum{};
          for (int c = 0; c < 6; ++c)
            for (int d = 0; d <= c; ++d) sum[c] += w(c, d) * double(p[d]);
          Sixes<float>::convert(sum, p);
        }
      }
    });
  }

  /// coarse = P' fine, in vectors of eight numbers an aggregate, and of `stride` a point.
  template <class Run>
  void restrictTo(Run const& workers, float const* fine, int stride, float* coarse) const {
    share_rows(workers, coarseRows(), [&](int k, int) {
      FloatRow sum{};
      for (int t = turnedStart[std::size_t(k)]; t < turnedStart[std::size_t(k) + 1]; ++t) {
        float const* const x = fine + stride * turnedRows[std::size_t(t)];
        FloatRow const* const p = &values[std::size_t(turnedSlots[std::size_t(t)] * R)];
        for (int r = 0; r < R; ++r) sum += p[r] * x[r];
      }
      std::memcpy(coarse + 8 * k, &sum, sizeof sum);
    });
  }
  /// fine = P coarse
  template <class Run>
  void prolong(Run const& workers, float const* coarse, float* fine, int stride) const {
    share_rows(workers, int(start.size()) - 1, [&](int i, int) {
      FloatRow sums[std::size_t(R)] = {};
      for (int s = start[std::size_t(i)]; s < start[std::size_t(i) + 1]; ++s) {
        FloatRow x;
        std::memcpy(&x, coarse + 8 * columns[std::size_t(s)], sizeof x);
        for (int r = 0; r < R; ++r) sums[r] += values[std::size_t(s * R + r)] * x;
      }
      for (int r = 0; r < R; ++r) {
        FloatRow const& s = sums[r];
        fine[stride * i + r] = ((s[0] + s[1]) + (s[2] + s[3])) + (s[4] + s[5]);
      }
    });
  }

 private:
  static Aggregates find(Fine const& a, double threshold, Lattice& lattice) {
    std::vector<int> start{0}, strong;
    std::vector<float> strength;
    for (int i = 0; i < a.rows(); ++i) {
      a.forEachInRow(i, [&](int j, int slot, bool) {
        const double norm = std::sqrt(squared_norm(a.block(slot)));
        if (j == i || !(norm > threshold)) return;
        strong.push_back(j);
        strength.push_back(float(norm));
      });
      start.push_back(int(strong.size()));
    }
    LatticeCells cells = aggregate_cells(lattice, start, strong);
    const int count = cells.aggregates.count;
    Aggregates found = aggregate_points(start, strong, strength, std::move(cells.aggregates));
    lattice = found.count == count ? std::move(cells.lattice) : Lattice{};
    return found;
  }
  static double squared_norm(double const* block) {
    double sum = 0;
    for (int k = 0; k < R * R; ++k) sum += block[k] * block[k];
    return sum;
  }
  void collect(int count) {
    memberStart.assign(std::size_t(count) + 1, 0);
    for (const int k : aggregate)
      if (k >= 0) ++memberStart[std::size_t(k) + 1];
    for (std::size_t k = 0; k < std::size_t(count); ++k) memberStart[k + 1] += memberStart[k];
    members.assign(std::size_t(memberStart.back()), 0);
    std::vector<int> next(memberStart.begin(), memberStart.end() - 1);
    for (std::size_t i = 0; i < aggregate.size(); ++i)
      if (aggregate[i] >= 0) members[std::size_t(next[std::size_t(aggregate[i])]++)] = int(i);
  }
  void transpose() {
    turnedStart.assign(memberStart.size(), 0);
    for (const int k : columns) ++turnedStart[std::size_t(k) + 1];
    for (std::size_t k = 0; k + 1 < turnedStart.size(); ++k) turnedStart[k + 1] += turnedStart[k];
    turnedRows.assign(columns.size(), 0);
    turnedSlots.assign(columns.size(), 0);
    std::vector<int> next(turnedStart.begin(), turnedStart.end() - 1);
    for (std::size_t i = 0; i + 1 < start.size(); ++i)
      for (int s = start[i]; s < start[i + 1]; ++s) {
        const std::size_t t = std::size_t(next[std::size_t(columns[std::size_t(s)])]++);
        turnedRows[t] = int(i);
        turnedSlots[t] = s;
      }
  }
};

}  // namespace sinew
