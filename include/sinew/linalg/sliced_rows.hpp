// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/core/lanes.hpp>
#include <sinew/core/work_share.hpp>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstring>
#include <map>
#include <utility>
#include <vector>

namespace sinew {

/// A copy of a symmetric matrix of 3 x 3 blocks, for products in lanes where points are numbered as in a
/// grid. W rows of blocks are a slice. For each distance d at which one of them has a block right of its
/// diagonal there is a slab: lane l has the block (row l, row l + d), or zeros. Then what a slab multiplies
/// with, and adds to, are W points one behind the other, and no lane is gathered (the diagonals of Saad,
/// Iterative Methods for Sparse Linear Systems, 2003, 3.4, within slices). A block costs half of what it
/// costs row by row.
template <class Real, int W>
struct SlicedRows {
  static constexpr bool possible = W >= 4;
  using L = lanes<Real, W>;

  struct Source {
    int of[std::size_t(W)];  // three times the slot of the block of each lane of a slab
  };
  std::vector<int> sliceStart{};  // first slab of each slice; none where the pattern does not suit
  std::vector<int> distances{};   // of each slab
  std::vector<Source> sources{};
  std::vector<std::array<L, 9>> blocks{};
  std::vector<Real> x{};  // by components: all x, all y, all z
  std::size_t stride = 0;
  int rows = 0;
  int products = 0;  // since the matrix last changed

  /// Whether the next product should be one of slices. They are filled before the fourth, since that costs as
  /// much as what is gained in three or four.
  bool suits() const { return products >= 3 && !sliceStart.empty(); }

  std::size_t bytes() const {
    return productBytes() + sources.size() * sizeof(Source) + (x.size() + y.size()) * sizeof(Real);
  }
  /// Of the matrix, what a product reads.
  std::size_t productBytes() const {
    return blocks.size() * sizeof blocks[0] + (distances.size() + sliceStart.size()) * sizeof(int);
  }

  /// From the rows of a matrix, which begin with their diagonal blocks; `zero` is the slot of a block of
  /// zeros.
  void init(std::vector<int> const& rowStart, std::vector<int> const& columns, int zero) {
    *this = {};
    rows = int(rowStart.size()) - 1;
    const std::size_t maximum = columns.size() + columns.size() / 5;  // of lanes, with those that are empty
    sliceStart.push_back(0);
    for (int first = 0; first < rows; first += W) {
      std::map<int, Source> slice;
      for (int i = first; i < std::min(first + W, rows); ++i)
        for (int k = rowStart[std::size_t(i)]; k < rowStart[std::size_t(i) + 1]; ++k) {
          const auto [at, added] = slice.try_emplace(columns[std::size_t(k)] - i);
          if (added) std::fill(at->second.of, at->second.of + W, 3 * zero);
          at->second.of[i - first] = 3 * k;
        }
      if ((distances.size() + slice.size()) * std::size_t(W) > maximum + std::size_t(W) * W) {
        *this = {};
        return;
      }
      append({slice.begin(), slice.end()});
      sliceStart.push_back(int(distances.size()));
    }
    blocks.resize(distances.size());
    stride = (std::size_t(rows) / W + 3) * W;
    x.assign(3 * stride, Real(0));
    dots.assign(slices() / strip + 1, 0);
    split(1);
  }

  /// Prepares products by so many threads.
  void split(int threads) {
    chunks.clear();
    std::size_t endCount = 0;
    for (std::size_t k = 0, from = 0; from < slices(); ++k) {
      Chunk chunk{.from = from, .to = slices(), .above = from};
      if (int(k) + 1 < threads) {
        const std::size_t slabs = distances.size() * (k + 1) / std::size_t(threads);
        while (chunk.to > from && std::size_t(sliceStart[chunk.to - 1]) >= slabs) --chunk.to;
        chunk.to = std::min(slices(), std::max(chunk.to / strip, from / strip + 1) * strip);
      }
      int last = int(chunk.to) * W;
      for (std::size_t slice = 0; slice < chunk.to; ++slice)
        for (int s = sliceStart[slice]; s < sliceStart[slice + 1]; ++s) {
          const int end = int(slice) * W + distances[std::size_t(s)] + W;
          if (slice >= from)
            last = std::max(last, end);
          else if (end > int(from) * W)
            chunk.above = std::min(chunk.above, slice);
        }
      chunk.origin = std::max(0, int(from) * W - W);
      chunk.stride = std::size_t(last - chunk.origin + W);
      chunk.ends = endCount;
      endCount += 3 * chunk.stride;
      chunks.push_back(chunk);
      from = chunk.to;
    }
    y.assign(endCount, Real(0));
  }

  /// The blocks anew, from those of the matrix, row-major one behind the other.
  template <class Run>
  void pack(Run const& workers, Real const* values) {
    workers.run([&](WorkShare share) {
      for (std::size_t s = share.begin(sources.size()); s < share.end(sources.size()); ++s)
        for (std::size_t r = 0; r < 3; ++r) gather3(values + 3 * r, sources[s].of, &blocks[s][3 * r]);
    });
  }

  /// out = A in. Returns in.out. One scalar behind `in` is read. The same bits however many threads there
  /// are.
  template <class Run>
  double multiply(Run const& workers, Real const* in, Real* out) {
    workers.run([&](WorkShare share) {
      for (std::size_t k = share.begin(slices()); k < share.end(slices()); ++k) begin(in, int(k) * W);
    });
    workers.run([&](WorkShare share) {
      for (std::size_t k = share.begin(chunks.size()); k < share.end(chunks.size()); ++k)
        multiplyChunk(chunks[k], out);
    });
    double total = 0;
    for (const double dot : dots) total += dot;
    return total;
  }

 private:
  // Slices of one thread. What slices from `above` on add to their rows they find out for themselves, before
  // all else and in the same order; what they add to rows behind is lost.
  struct Chunk {
    std::size_t from, to, above;
    int origin = 0;                    // the row where its part of y begins
    std::size_t stride = 0, ends = 0;  // of that part: from one component to the next, and its place
  };
  std::vector<Chunk> chunks{};
  std::vector<Real> y{};
  static constexpr std::size_t strip = 8;  // slices whose x.y is one sum; sums are added in their order
  std::vector<double> dots{};

  static constexpr std::size_t prefetched = 16;  // slabs ahead

  std::size_t slices() const { return sliceStart.empty() ? 0 : sliceStart.size() - 1; }

  SINEW_INLINE static L load(Real const* from) {
    L lanes;
    std::memcpy(&lanes.v, from, sizeof lanes.v);
    return lanes;
  }
  SINEW_INLINE static void store(Real* to, L lanes) { std::memcpy(to, &lanes.v, sizeof lanes.v); }

  void multiplyChunk(Chunk const& chunk, Real* out) {
    using Doubles = typename Lanes<double, W>::Vector;
    Real const *const x0 = x.data(), *const x1 = x0 + stride, *const x2 = x1 + stride;
    Real* const own = y.data() + chunk.ends;
    std::memset(own, 0, 3 * chunk.stride * sizeof(Real));
    Real *const y0 = own - chunk.origin, *const y1 = y0 + chunk.stride, *const y2 = y1 + chunk.stride;
    for (std::size_t slice = chunk.above; slice < chunk.from; ++slice) {
      const int first = int(slice) * W;
      const L own0 = load(x0 + first), own1 = load(x1 + first), own2 = load(x2 + first);
      for (int s = sliceStart[slice] + 1; s < sliceStart[slice + 1]; ++s) {
        const int j = first + distances[std::size_t(s)];
        if (j + W <= int(chunk.from) * W) continue;
        L const* const a = blocks[std::size_t(s)].data();
        store(y0 + j, load(y0 + j) + a[0] * own0 + a[3] * own1 + a[6] * own2);
        store(y1 + j, load(y1 + j) + a[1] * own0 + a[4] * own1 + a[7] * own2);
        store(y2 + j, load(y2 + j) + a[2] * own0 + a[5] * own1 + a[8] * own2);
      }
    }
    int const* const starts = sliceStart.data();
    Doubles dot{};
    for (std::size_t slice = chunk.from; slice < chunk.to; ++slice) {
      const int first = int(slice) * W;
      const L own0 = load(x0 + first), own1 = load(x1 + first), own2 = load(x2 + first);
      int s = starts[slice];
      L const* a = blocks[std::size_t(s)].data();
      L sum0 = a[0] * own0 + a[1] * own1 + a[2] * own2, sum1 = a[3] * own0 + a[4] * own1 + a[5] * own2,
        sum2 = a[6] * own0 + a[7] * own1 + a[8] * own2;
      for (++s, a += 9; s < starts[slice + 1]; ++s, a += 9) {
        // blocks are read once, in their order; the processor alone does not ask for them early enough
        for (std::size_t byte = 0; byte < sizeof blocks[0]; byte += 64)
          __builtin_prefetch(reinterpret_cast<char const*>(a) + prefetched * sizeof blocks[0] + byte);
        const int j = first + distances[std::size_t(s)];
        const L other0 = load(x0 + j), other1 = load(x1 + j), other2 = load(x2 + j);
        const L a00 = a[0], a01 = a[1], a02 = a[2], a10 = a[3], a11 = a[4], a12 = a[5], a20 = a[6],
                a21 = a[7], a22 = a[8];
        const L b0 = load(y0 + j) + a00 * own0 + a10 * own1 + a20 * own2,
                b1 = load(y1 + j) + a01 * own0 + a11 * own1 + a21 * own2,
                b2 = load(y2 + j) + a02 * own0 + a12 * own1 + a22 * own2;
        sum0 += a00 * other0 + a01 * other1 + a02 * other2;
        sum1 += a10 * other0 + a11 * other1 + a12 * other2;
        sum2 += a20 * other0 + a21 * other1 + a22 * other2;
        store(y0 + j, b0), store(y1 + j, b1), store(y2 + j, b2);
      }
      sum0 += load(y0 + first), sum1 += load(y1 + first), sum2 += load(y2 + first);
      const L product = own0 * sum0 + own1 * sum1 + own2 * sum2;
      dot += __builtin_convertvector(product.v, Doubles);
      join(sum0, sum1, sum2, out + 3 * first, std::min(W, rows - first));
      if ((slice + 1) % strip == 0 || slice + 1 == chunk.to) {
        double& sum = dots[slice / strip];
        sum = 0;
        for (int l = 0; l < W; ++l) sum += dot[l];
        dot = Doubles{};
      }
    }
  }

  // Slabs of nearly the same distance add to nearly the same points: what one has written cannot be read at
  // once in other vectors, so that those come far apart. The diagonal stays first.
  void append(std::vector<std::pair<int, Source>> const& slice) {
    auto add = [&](std::size_t k) {
      distances.push_back(slice[k].first);
      sources.push_back(slice[k].second);
    };
    add(0);
    const std::size_t n = slice.size(), step = n / 4 + 1;
    for (std::size_t from = 1; from <= step; ++from)
      for (std::size_t k = from; k < n; k += step) add(k);
  }

  // x of W points by components
  SINEW_INLINE void begin(Real const* in, int first) {
    L of[3];
    if (first + W <= rows) {
      gather3(in + 3 * first, inRow.of, of);
    } else {
      for (L& component : of) component = L(0);
      for (int i = first; i < rows; ++i)
        for (int c = 0; c < 3; ++c) of[c].set(i - first, in[3 * i + c]);
    }
    for (std::size_t c = 0; c < 3; ++c) store(&x[c * stride + std::size_t(first)], of[c]);
  }
  static constexpr Source inRow = [] {
    Source all{};
    for (int l = 0; l < W; ++l) all.of[l] = l;
    return all;
  }();

  SINEW_INLINE static void join(L a, L b, L c, Real* out, int n) {
    const L in[3] = {a, b, c};
    alignas(64) Real points[std::size_t(W)][4];
    transpose<3>(in, points);
    if (n == W)
      for (int l = 0; l < W; ++l) std::memcpy(out + 3 * l, points[l], 3 * sizeof(Real));
    else
      for (int l = 0; l < n; ++l) std::memcpy(out + 3 * l, points[l], 3 * sizeof(Real));
  }
};

}  // namespace sinew
