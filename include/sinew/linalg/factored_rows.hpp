// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/core/lanes.hpp>

#include <Eigen/Core>

#include <algorithm>
#include <cstddef>
#include <numeric>
#include <vector>

namespace sinew {

/// J A^-1 J' of sparse rows J with the kept factor P A P' = L D L' (BlockLdl), eight rows at a time as the
/// lanes of one substitution, which visits only the columns of L that lie above the entries of its rows in
/// the elimination tree (Gilbert, Peierls 1988). Of few rows it is Y' D^-1 Y with Y = L^-1 P J', half a solve
/// for each; of so many that these products cost more than the second half, J times the whole solution. Only
/// what lies on and below the diagonal is computed. Between uses nothing is kept but room.
class FactoredRows {
 public:
  /// add(k, l, w) for each pair of rows once. `Rows`: as JacobianRows, over the scalars of the system.
  template <class Factor, class Rows, class Add>
  void compliance(Factor const& factor, Rows const& rows, Add&& add) {
    order(factor, rows);
    mark(factor, rows);
    if (productsCost(Factor::B) <= solutionsCost(factor))
      addProducts(factor, rows, add);
    else
      addSolutions(factor, rows, add);
  }

 private:
  static constexpr int G = 8, W = std::min(native_width<double>, G), packs = G / W;  // rows of a group
  using Pack = lanes<double, W>;
  struct Eight {
    Pack part[packs];
  };

  std::vector<int> first_{}, order_{};  // of each row the first column of L that it enters; rows sorted by it
  // columns that each group visits, rising: those of group g from begin_[g] on
  std::vector<std::size_t> begin_{};
  std::vector<int> visited_{};
  std::vector<char> mark_{}, all_{};  // of columns: visited by the group, by any
  std::vector<Eight> work_{}, scaled_{},
      kept_{};                // of scalars in the order of elimination, one after the other
  std::vector<int> entry_{};  // of each entry of the rows: its scalar in the order of elimination

  int groups() const { return int(begin_.size()) - 1; }
  int inGroup(int g) const { return std::min(G, int(order_.size()) - g * G); }

  template <class Factor, class Rows>
  void order(Factor const& factor, Rows const& rows) {
    constexpr int B = Factor::B;
    const auto m = std::size_t(rows.rows());
    entry_.resize(rows.dofs.size());
    first_.assign(m, int(factor.inverse.size()));
    order_.resize(m);
    std::iota(order_.begin(), order_.end(), 0);
    for (std::size_t r = 0; r < m; ++r)
      for (auto k = std::size_t(rows.first[r]); k < std::size_t(rows.first[r + 1]); ++k) {
        const int column = factor.newIndex[std::size_t(rows.dofs[k] / B)];
        entry_[k] = column * B + rows.dofs[k] % B;
        if (rows.values[k] != 0) first_[r] = std::min(first_[r], column);
      }
    std::sort(order_.begin(), order_.end(), [&](int a, int b) {
      const int fa = first_[std::size_t(a)], fb = first_[std::size_t(b)];
      return fa != fb ? fa < fb : a < b;
    });
  }
  template <class Factor, class Rows>
  void mark(Factor const& factor, Rows const& rows) {
    constexpr int B = Factor::B;
    const std::size_t n = factor.inverse.size();
    work_.resize(n * B);
    scaled_.resize(n * B);
    mark_.assign(n, 0);
    all_.assign(n, 0);
    begin_.assign(1, 0);
    visited_.clear();
    for (std::size_t from = 0; from < order_.size(); from += G) {
      const std::size_t to = std::min(order_.size(), from + G);
      for (std::size_t i = from; i < to; ++i) {
        const auto r = std::size_t(order_[i]);
        for (auto k = std::size_t(rows.first[r]); k < std::size_t(rows.first[r + 1]); ++k)
          if (rows.values[k] != 0)
            for (int c = entry_[k] / B; c >= 0 && !mark_[std::size_t(c)]; c = factor.parent[std::size_t(c)])
              mark_[std::size_t(c)] = 1;
      }
      for (auto c = std::size_t(first_[std::size_t(order_[from])]); c < n; ++c)
        if (mark_[c]) {
          visited_.push_back(int(c));
          mark_[c] = 0;
          all_[c] = 1;
        }
      begin_.push_back(visited_.size());
    }
  }
  // multiplications of both ways, behind the first half, which is that of both
  double productsCost(int block) const {
    double sum = 0;
    for (int g = 0; g < groups(); ++g)
      sum += double(begin_[std::size_t(g) + 1] - begin_[std::size_t(g)]) * (groups() - g) * G * G * block;
    return sum;
  }
  template <class Factor>
  double solutionsCost(Factor const& factor) const {
    double sum = double(entry_.size()) / 2 * G;
    for (std::size_t c = 0; c < all_.size(); ++c)
      if (all_[c]) sum += double(factor.start[c + 1] - factor.start[c] + 1) * Factor::B * Factor::B * G;
    return sum * groups();
  }

  static double* numbers(Eight& e) { return reinterpret_cast<double*>(&e); }
  static Eight zero() {
    Eight e;
    for (Pack& p : e.part) p = Pack(0.0);
    return e;
  }
  // y += f x
  static void add(Eight& y, double f, Eight const& x) {
    for (int p = 0; p < packs; ++p) y.part[p] += Pack(f) * x.part[p];
  }

  // Y of a group into work_, which is 0 before
  template <class Factor, class Rows>
  void forward(Factor const& factor, Rows const& rows, int g) {
    constexpr int B = Factor::B;
    for (int lane = 0; lane < inGroup(g); ++lane) {
      const auto r = std::size_t(order_[std::size_t(g * G + lane)]);
      for (auto k = std::size_t(rows.first[r]); k < std::size_t(rows.first[r + 1]); ++k)
        if (rows.values[k] != 0) numbers(work_[std::size_t(entry_[k])])[lane] += rows.values[k];
    }
    for (std::size_t v = begin_[std::size_t(g)]; v < begin_[std::size_t(g) + 1]; ++v) {
      const auto c = std::size_t(visited_[v]);
      Eight x[std::size_t(B)];
      for (int i = 0; i < B; ++i) x[i] = work_[c * B + std::size_t(i)];
      for (auto p = std::size_t(factor.start[c]); p < std::size_t(factor.start[c + 1]); ++p) {
        const auto row = std::size_t(factor.row[p]) * B;
        for (int i = 0; i < B; ++i) {
          Eight y = work_[row + std::size_t(i)];
          for (int j = 0; j < B; ++j) add(y, -factor.lower[p](i, j), x[j]);
          work_[row + std::size_t(i)] = y;
        }
      }
    }
  }
  // to = D^-1 Y in a column
  template <class Factor>
  void scale(Factor const& factor, std::size_t c, std::vector<Eight>& to) {
    constexpr int B = Factor::B;
    Eight d[std::size_t(B)];
    for (int i = 0; i < B; ++i) {
      d[i] = zero();
      for (int j = 0; j < B; ++j) add(d[i], factor.inverse[c](i, j), work_[c * B + std::size_t(j)]);
    }
    for (int i = 0; i < B; ++i) to[c * B + std::size_t(i)] = d[i];
  }
  template <class Add>
  void give(double const (&tile)[G][G], int g, int h, Add&& add) const {
    for (int i = 0; i < inGroup(g); ++i)
      for (int j = 0; j < inGroup(h); ++j)
        if (g != h || j <= i) add(order_[std::size_t(g * G + i)], order_[std::size_t(h * G + j)], tile[i][j]);
  }

  template <class Factor, class Rows, class Add>
  void addProducts(Factor const& factor, Rows const& rows, Add&& to) {
    constexpr int B = Factor::B;
    kept_.resize(visited_.size() * B);
    std::fill(work_.begin(), work_.end(), zero());
    for (int g = 0; g < groups(); ++g) {
      forward(factor, rows, g);
      for (std::size_t v = begin_[std::size_t(g)]; v < begin_[std::size_t(g) + 1]; ++v) {
        const auto c = std::size_t(visited_[v]);
        scale(factor, c, scaled_);
        std::copy_n(work_.data() + c * B, B, kept_.data() + v * B);
        std::fill_n(work_.data() + c * B, B, zero());
        mark_[c] = 1;
      }
      for (int h = 0; h <= g; ++h) {
        double tile[G][G];
        product<B>(g, h, tile);
        give(tile, g, h, to);
      }
      for (std::size_t v = begin_[std::size_t(g)]; v < begin_[std::size_t(g) + 1]; ++v)
        mark_[std::size_t(visited_[v])] = 0;
    }
  }
  // tile = (D^-1 Y_g)' Y_h over the columns that both visit
  template <int B>
  void product(int g, int h, double (&tile)[G][G]) {
    const int from = visited_[begin_[std::size_t(g)]];
    const auto end = begin_[std::size_t(h) + 1];
    auto v = std::size_t(std::lower_bound(visited_.begin() + std::ptrdiff_t(begin_[std::size_t(h)]),
                                          visited_.begin() + std::ptrdiff_t(end),
                                          from) -
                         visited_.begin());
    for (int p = 0; p < packs; ++p) {
      Pack sum[G];
      for (Pack& s : sum) s = Pack(0.0);
      for (std::size_t k = v; k < end; ++k) {
        const auto c = std::size_t(visited_[k]);
        if (!mark_[c]) continue;
        for (std::size_t i = 0; i < B; ++i) {
          const Pack y = kept_[k * B + i].part[p];
          double const* const d = numbers(scaled_[c * B + i]);
          for (int r = 0; r < G; ++r) sum[r] += Pack(d[r]) * y;
        }
      }
      for (int r = 0; r < G; ++r)
        for (int l = 0; l < W; ++l) tile[r][p * W + l] = lane(sum[r], l);
    }
  }

  template <class Factor, class Rows, class Add>
  void addSolutions(Factor const& factor, Rows const& rows, Add&& to) {
    constexpr int B = Factor::B;
    std::fill(work_.begin(), work_.end(), zero());
    for (int g = 0; g < groups(); ++g) {
      forward(factor, rows, g);
      for (std::size_t c = all_.size(); c-- > 0;) {
        if (!all_[c]) continue;
        scale(factor, c, work_);
        Eight x[std::size_t(B)];
        for (int i = 0; i < B; ++i) x[i] = work_[c * B + std::size_t(i)];
        for (auto p = std::size_t(factor.start[c]); p < std::size_t(factor.start[c + 1]); ++p)
          for (int j = 0; j < B; ++j) {
            const Eight below = work_[std::size_t(factor.row[p]) * B + std::size_t(j)];
            for (int i = 0; i < B; ++i) add(x[i], -factor.lower[p](j, i), below);
          }
        for (int i = 0; i < B; ++i) work_[c * B + std::size_t(i)] = x[i];
      }
      for (std::size_t o = std::size_t(g) * G; o < order_.size(); ++o) {
        const auto r = std::size_t(order_[o]);
        Eight sum = zero();
        for (auto k = std::size_t(rows.first[r]); k < std::size_t(rows.first[r + 1]); ++k)
          if (rows.values[k] != 0) add(sum, rows.values[k], work_[std::size_t(entry_[k])]);
        for (int l = 0; l < inGroup(g); ++l)
          if (std::size_t(g * G + l) <= o)
            to(int(r), order_[std::size_t(g * G + l)], lane(sum.part[l / W], l % W));
      }
      for (std::size_t c = 0; c < all_.size(); ++c)
        if (all_[c]) std::fill_n(work_.data() + c * B, B, zero());
    }
  }
};

}  // namespace sinew
