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
/// several sources, and of blocks on its diagonal. A slice holds 32 rows, padded to the longest of them;
/// entry k of its rows stands together, component by component, so that 32 threads read neighbouring
/// addresses (sliced ELLPACK, Monakov et al. 2010).
template <class D>
struct BlockRows {
  using Real = typename D::Real;
  using Deriv = typename D::Deriv;
  static constexpr int n = D::size, components = n * n, slice = 32;

  /// Elements whose blocks the matrix has.
  struct Source {
    int arity = 1;
    std::vector<int> points{};  // of the elements, one after the other, until they are planned
    DeviceVector<int> first{}, contribution{};  // of each place: which blocks of elements (BlockOfElement)

    Source() = default;
    template <std::size_t Arity>
    explicit Source(std::vector<std::array<int, Arity>> const& elements) : arity(int(Arity)) {
      points.reserve(elements.size() * Arity);
      for (auto const& e : elements) points.insert(points.end(), e.begin(), e.end());
    }
  };

  bool planned() const { return rows > 0; }
  /// Says which blocks there will be, in rows for so many nodes.
  void plan(std::vector<Source> from, std::size_t nodes) {
    sources = std::move(from);
    rows = nodes;
    place();
  }
  /// The matrix is 0.
  void clear() { for_each_index(places, Clear{values.data()}); }
  /// Adds k K + b B of a source of elements, with the tangents of their last forces; of the first source,
  /// what the matrix was before is gone.
  template <class Law, class View>
  void add(std::size_t source, Law const& law, View const& view, Real k, Real b) {
    Source const& s = sources[source];
    for_each_index(
        places,
        AddBlocks<Law, View>{
            law, view, s.first.device(), s.contribution.device(), values.data(), k, b, source == 0});
  }
  /// Adds column c of the blocks on the diagonal, one a node.
  void addColumn(Deriv const* numbers, int c) {
    for_each_index(rows, AddColumn{diagonal.device(), values.data(), numbers, c});
  }
  /// Adds to the diagonal, one vector a node.
  void addDiagonal(Deriv const* numbers) {
    for_each_index(rows, AddDiagonal{diagonal.device(), values.data(), numbers});
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
  DeviceVector<int> sliceFirst{};  // first place of a slice
  DeviceVector<int> column{};      // of a place; that of the diagonal where a row has no further entry
  DeviceVector<int> diagonal{};    // place of each row's
  DeviceArray<Real> values{};

  BlockRows() = default;
  BlockRows(BlockRows&&) = default;
  BlockRows& operator=(BlockRows&&) = default;
  // a copy of a body plans and assembles anew
  BlockRows(BlockRows const&) {}
  BlockRows& operator=(BlockRows const&) { return *this = BlockRows(); }

  // what threads do

  // component c of the block at a place
  template <class R>
  SINEW_INLINE static R& at(R* values, int place, int c) {
    return values[std::ptrdiff_t(place / slice) * (slice * components) + c * slice + place % slice];
  }
  struct Clear {
    Real* values;
    SINEW_HD void operator()(int place) const {
      for (int c = 0; c < components; ++c) at(values, place, c) = Real(0);
    }
  };
  struct AddColumn {
    int const* diagonal;
    Real* values;
    Deriv const* column;
    int c;
    SINEW_HD void operator()(int row) const {
      for (int r = 0; r < n; ++r) at(values, diagonal[row], r * n + c) += column[row][r];
    }
  };
  struct AddDiagonal {
    int const* diagonal;
    Real* values;
    Deriv const* numbers;
    SINEW_HD void operator()(int row) const {
      for (int c = 0; c < n; ++c) at(values, diagonal[row], c * n + c) += numbers[row][c];
    }
  };
  template <class Law, class View>
  struct AddBlocks {
    Law law;
    View view;
    int const *first, *contribution;
    Real* values;
    Real k, b;
    bool fresh;
    SINEW_HD void operator()(int place) const {
      Mat<Real, n> sum = Mat<Real, n>::Zero();
      for (int i = first[place]; i < first[place + 1]; ++i) {
        const auto of = detail::BlockOfElement<Law::arity>(static_cast<unsigned>(contribution[i]));
        const Mat<Real, n> block =
            law.block(view.rest[of.element], view.tangent[of.element], of.a, of.b, k, b);
        if (of.transposed)
          sum += block.transpose();
        else
          sum += block;
      }
      for (int r = 0; r < n; ++r)
        for (int c = 0; c < n; ++c) {
          Real& to = at(values, place, r * n + c);
          to = fresh ? sum(r, c) : to + sum(r, c);
        }
    }
  };
  struct RowProduct {
    int const *sliceFirst, *column;
    Real const* values;
    Deriv const* x;
    Deriv* r;
    // what is read once goes through the caches first; as many reads at once as registers allow
    template <class T>
    SINEW_INLINE static T once(T const* from) {
#if defined(__CUDA_ARCH__)
      return __ldcs(from);
#else
      return *from;
#endif
    }
    SINEW_INLINE void rowOf(int row, Real (&sum)[n]) const {
      for (Real& s : sum) s = Real(0);
      const int s = row / slice, lane = row % slice, end = sliceFirst[s + 1];
#if defined(__CUDA_ARCH__)
      constexpr int together = n == 3 ? int(16 / sizeof(Real)) : 1;
#pragma unroll together
#endif
      for (int place = sliceFirst[s] + lane; place < end; place += slice) {
        Deriv const& from = x[once(column + place)];
        Real const* const block = values + std::ptrdiff_t(place - lane) * components + lane;
        for (int a = 0; a < n; ++a)
          for (int c = 0; c < n; ++c) sum[a] += once(block + (a * n + c) * slice) * from[c];
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
    return {sliceFirst.device(), column.device(), values.data(), x, r};
  }
  // which blocks of elements a row has, and where
  struct RowEntry {
    int column;
    int source;  // -1: of the diagonal
    int code;
    auto operator<=>(RowEntry const&) const = default;
  };
  void place() {
    std::vector<std::size_t> begin(rows + 1, 0);
    for (Source const& s : sources) {
      if (s.points.size() * std::size_t(s.arity + 1) > std::size_t(std::numeric_limits<int>::max()))
        throw Error("a matrix on a device",
                    text(s.points.size() / std::size_t(s.arity),
                         " elements of ",
                         s.arity,
                         " points have more than 2^30 blocks; split the body"));
      for (const int p : s.points) begin[std::size_t(p) + 1] += std::size_t(s.arity);
    }
    for (std::size_t i = 0; i < rows; ++i) begin[i + 1] += begin[i] + 1;
    // the parts of each row, by columns: those of one place stand together, sources and elements rising
    std::vector<RowEntry> rowEntries(begin[rows]);
    {
      std::vector<std::size_t> next(begin.begin(), begin.end() - 1);
      for (std::size_t i = 0; i < rows; ++i) rowEntries[next[i]++] = {int(i), -1, 0};
      for (std::size_t s = 0; s < sources.size(); ++s) {
        const auto arity = std::size_t(sources[s].arity);
        std::vector<int>& points = sources[s].points;
        int code = 0;
        for (std::size_t e = 0; e < points.size(); e += arity)
          for (std::size_t i = e; i < e + arity; ++i)
            for (std::size_t j = i; j < e + arity; ++j, code += 2) {
              rowEntries[next[std::size_t(points[i])]++] = {points[j], int(s), code};
              if (i != j) rowEntries[next[std::size_t(points[j])]++] = {points[i], int(s), code + 1};
            }
        points = {};
      }
    }
    std::vector<int> length(rows, 0);
    for (std::size_t i = 0; i < rows; ++i) {
      std::sort(rowEntries.begin() + std::ptrdiff_t(begin[i]),
                rowEntries.begin() + std::ptrdiff_t(begin[i + 1]));
      for (std::size_t k = begin[i]; k < begin[i + 1]; ++k)
        length[i] += k == begin[i] || rowEntries[k].column != rowEntries[k - 1].column;
    }
    std::vector<int> firstOfSlice{0};
    for (std::size_t s = 0; s < rows; s += slice) {
      const auto end = std::min(rows, s + slice);
      const int longest =
          *std::max_element(length.begin() + std::ptrdiff_t(s), length.begin() + std::ptrdiff_t(end));
      firstOfSlice.push_back(firstOfSlice.back() + longest * slice);
    }
    places = std::size_t(firstOfSlice.back());
    // f(row, place, part), places of a row rising
    auto forEachRowEntry = [&](auto&& f) {
      for (std::size_t i = 0; i < rows; ++i) {
        int at = firstOfSlice[i / slice] + int(i % slice) - slice;
        for (std::size_t k = begin[i]; k < begin[i + 1]; ++k) {
          if (k == begin[i] || rowEntries[k].column != rowEntries[k - 1].column) at += slice;
          f(i, at, rowEntries[k]);
        }
      }
    };
    std::vector<int> columns(places), diagonals(rows);
    for (std::size_t s = 0; s + 1 < firstOfSlice.size(); ++s)
      for (int p = firstOfSlice[s]; p < firstOfSlice[s + 1]; ++p)
        columns[std::size_t(p)] = int(std::min(rows - 1, s * slice + std::size_t(p % slice)));
    std::vector<std::vector<int>> counts(sources.size(), std::vector<int>(places + 1, 0));
    forEachRowEntry([&](std::size_t row, int at, RowEntry const& entry) {
      columns[std::size_t(at)] = entry.column;
      if (entry.source < 0)
        diagonals[row] = at;
      else
        ++counts[std::size_t(entry.source)][std::size_t(at) + 1];
    });
    std::vector<std::vector<int>> codes(sources.size());
    for (std::size_t s = 0; s < sources.size(); ++s) {
      for (std::size_t p = 0; p < places; ++p) counts[s][p + 1] += counts[s][p];
      codes[s].resize(std::size_t(counts[s].back()));
    }
    auto next = counts;
    forEachRowEntry([&](std::size_t, int at, RowEntry const& entry) {
      if (entry.source < 0) return;
      const auto s = std::size_t(entry.source);
      codes[s][std::size_t(next[s][std::size_t(at)]++)] = entry.code;
    });
    for (std::size_t s = 0; s < sources.size(); ++s) {
      sources[s].first = std::move(counts[s]);
      sources[s].contribution = std::move(codes[s]);
    }
    sliceFirst = std::move(firstOfSlice);
    column = std::move(columns);
    diagonal = std::move(diagonals);
    values.resize(places * components);
  }
};

}  // namespace sinew::gpu
