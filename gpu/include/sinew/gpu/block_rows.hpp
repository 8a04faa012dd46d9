// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/gpu/data_types.hpp>
#include <sinew/gpu/element_kernels.hpp>
#include <sinew/gpu/reduction.hpp>

#include <algorithm>
#include <array>
#include <limits>
#include <utility>
#include <vector>

namespace sinew::gpu {

/// A matrix as rows of square blocks, for products on a device: the sum of the blocks of elements, of one or
/// several sources. A slice holds 32 rows, padded to the longest of them; entry k of its rows stands
/// together, component by component, so that 32 threads read neighbouring addresses (sliced ELLPACK, Monakov
/// et al. 2010).
template <class D>
struct BlockRows {
  using Real = typename D::Real;
  using Deriv = typename D::Deriv;
  static constexpr int n = D::size, components = n * n, slice = 32;

  /// Where blocks come from: elements of so many points, which follow each other in `points`.
  struct Source {
    int arity = 1;
    std::size_t count = 0;
    std::vector<int> points{};
    std::size_t first = 0;  // of its blocks among those of all sources

    Source() = default;
    template <std::size_t Arity>
    explicit Source(std::vector<std::array<int, Arity>> const& elements)
        : arity(int(Arity)), count(elements.size()) {
      points.reserve(count * Arity);
      for (auto const& e : elements) points.insert(points.end(), e.begin(), e.end());
    }
    int pairs() const { return arity * (arity + 1) / 2; }
  };

  bool planned() const { return rows > 0; }
  /// Says which blocks there will be, in rows for so many nodes. The points of sources are not kept.
  void plan(std::vector<Source> from, std::size_t nodes) {
    sources = std::move(from);
    place(nodes);
    for (Source& s : sources) s.points = {};
  }
  /// Computes the blocks of a source of elements: k K + b B, with the tangents of the last forces.
  template <class Law, class View>
  void fill(std::size_t source, Law const& law, View const& view, Real k, Real b) {
    for_each_index(std::size_t(view.count), ElementBlocks<Law, View>{law, view, blocksOf(source), k, b});
  }
  /// The blocks of a source, one after the other, row by row.
  Real* blocksOf(std::size_t source) {
    std::size_t all = 0;
    for (Source const& s : sources) all += s.count * std::size_t(s.pairs() * components);
    blocks.resize(all);
    return blocks.data() + sources[source].first * components;
  }
  /// Sums up the blocks of all sources, in the same order each time.
  void sum() {
    for_each_index(
        places, SumBlocks{int(places), first.device(), contribution.device(), blocks.data(), values.data()});
  }
  /// r += A x
  void multiplyAdd(Deriv* r, Deriv const* x) const { for_each_index(rows, product(x, r)); }
  /// r = A x, *to = r.x
  void multiply(Deriv* r, Deriv const* x, double* to) const {
    sum_indices(rows, ProductAndSum{product(x, r)}, to);
  }

  // bytes of memory that a product reads and writes at least
  std::size_t bytes() const { return places * (components * sizeof(Real) + 4) + 3 * rows * sizeof(Deriv); }

  std::size_t rows = 0, places = 0;
  std::vector<Source> sources{};
  DeviceVector<int> sliceFirst{};             // first place of a slice
  DeviceVector<int> column{};                 // of a place; -1 where a row has no further entry
  DeviceVector<int> first{}, contribution{};  // what a place is the sum of: (block, transposed)
  DeviceArray<Real> blocks{}, values{};       // of sources, one after the other; of places, by component

  BlockRows() = default;
  BlockRows(BlockRows&&) = default;
  BlockRows& operator=(BlockRows&&) = default;
  // a copy of a body plans and assembles anew
  BlockRows(BlockRows const&) {}
  BlockRows& operator=(BlockRows const&) { return *this = BlockRows(); }

  // what threads do

  template <class Law, class View>
  struct ElementBlocks {
    Law law;
    View view;
    Real* to;
    Real k, b;
    SINEW_HD void operator()(int e) const {
      constexpr int arity = Law::arity, pairs = arity * (arity + 1) / 2;
      const auto rest = view.restOf(e);
      const auto tangent = view.tangentOf(e);
      Real* out = to + std::ptrdiff_t(e) * pairs * components;
      for (int i = 0; i < arity; ++i)
        for (int j = i; j < arity; ++j) {
          const Mat<Real, n> block = law.block(rest, tangent, i, j, k, b);
          for (int r = 0; r < n; ++r)
            for (int c = 0; c < n; ++c) *out++ = block(r, c);
        }
    }
  };
  struct SumBlocks {
    int places;
    int const *first, *contribution;
    Real const* from;
    Real* to;
    SINEW_HD void operator()(int place) const {
      Real sum[components] = {};
      for (int i = first[place]; i < first[place + 1]; ++i) {
        const unsigned code = unsigned(contribution[i]);
        Real const* const block = from + std::ptrdiff_t(code >> 1) * components;
        if (code & 1)
          for (int r = 0; r < n; ++r)
            for (int c = 0; c < n; ++c) sum[r * n + c] += block[c * n + r];
        else
          for (int c = 0; c < components; ++c) sum[c] += block[c];
      }
      for (int c = 0; c < components; ++c) to[std::ptrdiff_t(c) * places + place] = sum[c];
    }
  };
  struct RowProduct {
    int places;
    int const *sliceFirst, *column;
    Real const* values;
    Deriv const* x;
    Deriv* r;
    SINEW_INLINE void rowOf(int row, Real (&sum)[n]) const {
      for (Real& s : sum) s = Real(0);
      const int s = row / slice, end = sliceFirst[s + 1];
      for (int place = sliceFirst[s] + row % slice; place < end; place += slice) {
        const int j = column[place];
        if (j < 0) break;
        Deriv const& from = x[j];
        for (int a = 0; a < n; ++a)
          for (int c = 0; c < n; ++c) sum[a] += values[std::ptrdiff_t(a * n + c) * places + place] * from[c];
      }
    }
    SINEW_HD void operator()(int row) const {
      Real sum[n];
      rowOf(row, sum);
      for (int a = 0; a < n; ++a) r[row][a] += sum[a];
    }
  };
  struct ProductAndSum {
    RowProduct product;
    SINEW_HD double operator()(int row) const {
      Real sum[n];
      product.rowOf(row, sum);
      double total = 0;
      for (int a = 0; a < n; ++a) {
        product.r[row][a] = sum[a];
        total += double(sum[a]) * double(product.x[row][a]);
      }
      return total;
    }
  };

 private:
  RowProduct product(Deriv const* x, Deriv* r) const {
    return {int(places), sliceFirst.device(), column.device(), values.data(), x, r};
  }
  void place(std::size_t nodes) {
    rows = nodes;
    std::size_t all = 0;
    for (Source& s : sources) {
      s.first = all;
      all += s.count * std::size_t(s.pairs());
    }
    if (all * 2 > std::size_t(std::numeric_limits<int>::max()))
      throw Error("a matrix on a device",
                  text("its elements have ", all, " blocks, more than 2^30; split the body"));
    // the blocks of each row, by columns: those of one place stand together, sources and elements rising
    std::vector<std::size_t> begin(nodes + 1, 0);
    for (Source const& s : sources)
      for (const int p : s.points) begin[std::size_t(p) + 1] += std::size_t(s.arity);
    for (std::size_t i = 0; i < nodes; ++i) begin[i + 1] += begin[i];
    std::vector<std::pair<int, int>> parts(begin[nodes]);  // column, code
    {
      std::vector<std::size_t> next(begin.begin(), begin.end() - 1);
      for (Source const& s : sources) {
        int code = int(s.first) * 2;
        for (std::size_t e = 0; e < s.count; ++e) {
          int const* const at = s.points.data() + e * std::size_t(s.arity);
          for (int i = 0; i < s.arity; ++i)
            for (int j = i; j < s.arity; ++j, code += 2) {
              parts[next[std::size_t(at[i])]++] = {at[j], code};
              if (i != j) parts[next[std::size_t(at[j])]++] = {at[i], code + 1};
            }
        }
      }
    }
    std::vector<int> length(nodes, 0);
    for (std::size_t i = 0; i < nodes; ++i) {
      std::sort(parts.begin() + std::ptrdiff_t(begin[i]), parts.begin() + std::ptrdiff_t(begin[i + 1]));
      for (std::size_t k = begin[i]; k < begin[i + 1]; ++k)
        length[i] += k == begin[i] || parts[k].first != parts[k - 1].first;
    }
    std::vector<int> firstOfSlice{0};
    for (std::size_t s = 0; s < nodes; s += slice) {
      const auto end = std::min(nodes, s + slice);
      const int longest =
          *std::max_element(length.begin() + std::ptrdiff_t(s), length.begin() + std::ptrdiff_t(end));
      firstOfSlice.push_back(firstOfSlice.back() + longest * slice);
    }
    places = std::size_t(firstOfSlice.back());
    std::vector<int> columns(places, -1), counts(places + 1, 0), codes(parts.size());
    auto forEachPart = [&](auto&& f) {
      for (std::size_t i = 0; i < nodes; ++i) {
        int place = firstOfSlice[i / slice] + int(i % slice) - slice;
        for (std::size_t k = begin[i]; k < begin[i + 1]; ++k) {
          if (k == begin[i] || parts[k].first != parts[k - 1].first) place += slice;
          f(std::size_t(place), parts[k]);
        }
      }
    };
    forEachPart([&](std::size_t place, auto const& part) {
      columns[place] = part.first;
      ++counts[place + 1];
    });
    for (std::size_t p = 0; p < places; ++p) counts[p + 1] += counts[p];
    std::vector<int> next(counts.begin(), counts.end() - 1);
    forEachPart(
        [&](std::size_t place, auto const& part) { codes[std::size_t(next[place]++)] = part.second; });
    sliceFirst = std::move(firstOfSlice);
    column = std::move(columns);
    first = std::move(counts);
    contribution = std::move(codes);
    values.resize(places * components);
  }
};

}  // namespace sinew::gpu
