// SPDX-License-Identifier: BSL-1.0
#pragma once

// What the threads of multigrid do: the sums of linalg/multigrid.hpp, each thread or team with what it alone
// writes. Matrices keep their values in double for those of the level below, and in float for the cycle.

#include <sinew/core/lane_lists.hpp>
#include <sinew/gpu/data_types.hpp>
#include <sinew/linalg/chebyshev.hpp>
#include <sinew/linalg/held_modes.hpp>
#include <sinew/linalg/unit_blocks.hpp>

#include <Eigen/Core>

#include <cmath>
#include <cstddef>
#include <utility>

namespace sinew::gpu::multigrid {

template <int R>
using Square = Eigen::Matrix<double, R, R, Eigen::RowMajor>;

/// Numbers of a point in the vectors of a cycle.
template <int R>
inline constexpr int stride = R == 3 ? 3 : 8;

/// A matrix as its rows of blocks, with both triangles; f(k, column) for those that a lane of a row has, k
/// the number of a block.
///
/// Of points: slices of 32 rows (BlockRows), component c of block k at (k / 32) 288 + 32 c + k % 32.
template <int R>
struct Rows {
  static_assert(R == 3);
  int const *sliceFirst, *columns;
  static constexpr int slice = 32;

  template <class F>
  SINEW_INLINE void each(int row, int lane, int lanes, F&& f) const {
    const int end = sliceFirst[row / slice + 1];
    for (int k = sliceFirst[row / slice] + row % slice + lane * slice; k < end; k += lanes * slice)
      f(k, columns[k]);
  }
  SINEW_INLINE static std::ptrdiff_t at(int k, int c) {
    return std::ptrdiff_t(k / slice) * (slice * 9) + c * slice + k % slice;
  }
  // a block of values in double, which have the numbers of the rows
  SINEW_INLINE static double value(double const* values, int k, int r, int c) {
    return values[at(k, 3 * r + c)];
  }
};
/// Of aggregates: compressed rows. Block k in double is that of slots[k] / 2 on or above the diagonal,
/// transposed where slots[k] is odd; in float it is row-major, 36 numbers at 36 k.
template <>
struct Rows<6> {
  int const *start, *columns, *slots;

  template <class F>
  SINEW_INLINE void each(int row, int lane, int lanes, F&& f) const {
    for (int k = start[row] + lane; k < start[row + 1]; k += lanes) f(k, columns[k]);
  }
  SINEW_INLINE static std::ptrdiff_t at(int k, int c) { return std::ptrdiff_t(k) * 36 + c; }
  SINEW_INLINE double value(double const* values, int k, int r, int c) const {
    const int code = slots[k];
    return values[std::ptrdiff_t(code / 2) * 36 + (code % 2 ? 6 * c + r : 6 * r + c)];
  }
};

/// sum += A_row v in float, in the part of a lane.
template <int R>
SINEW_INLINE void add_row(Rows<R> const& rows, float const* values, float const* v, int row, int lane,
                          int lanes, float* sum) {
  if constexpr (R == 3) {
    // what is read once goes through the caches first; as many reads at once as registers allow
    auto once = [](auto const* from) {
#if defined(__CUDA_ARCH__)
      return __ldcs(from);
#else
      return *from;
#endif
    };
    constexpr int slice = Rows<3>::slice;
    const int end = rows.sliceFirst[row / slice + 1];
#if defined(__CUDA_ARCH__)
#pragma unroll 4
#endif
    for (int k = rows.sliceFirst[row / slice] + row % slice + lane * slice; k < end; k += lanes * slice) {
      float const* const x = v + 3 * std::ptrdiff_t(once(rows.columns + k));
      const float x0 = x[0], x1 = x[1], x2 = x[2];
      float const* const a = values + Rows<3>::at(k, 0);
      for (int r = 0; r < 3; ++r)
        sum[r] += once(a + 96 * r) * x0 + once(a + 96 * r + 32) * x1 + once(a + 96 * r + 64) * x2;
    }
  } else {
    using Four = FourOf<float>;
    rows.each(row, lane, lanes, [&](int k, int column) {
      Four const* const from = reinterpret_cast<Four const*>(v + 8 * std::ptrdiff_t(column));
      const Four low = from[0], high = from[1];
      const float x[6] = {low.of[0], low.of[1], low.of[2], low.of[3], high.of[0], high.of[1]};
      Four a[9];
      Four const* const block = reinterpret_cast<Four const*>(values + Rows<6>::at(k, 0));
      for (int i = 0; i < 9; ++i) a[i] = block[i];
      for (int r = 0; r < 6; ++r)
        for (int c = 0; c < 6; ++c) sum[r] += a[(6 * r + c) / 4].of[(6 * r + c) % 4] * x[c];
    });
  }
}

// values of the finest level

/// sum += component c of places
template <class D>
struct PlaceOf {
  typename D::Coord const* x;
  int c;
  SINEW_HD double operator()(int i) const { return double(x[i][c]); }
};

/// Of each point W, with a unit block where constraints hold a component, and L' times the translations and
/// rotations about the middle of all: A -> W A W' has L L' as diagonal blocks.
template <class D>
struct UnitPoint {
  Rows<3> rows;
  typename D::Real const* values;
  int const* diagonal;
  unsigned char const* held;  // directions as bits; null where there are none
  typename D::Coord const* x;
  double const* places;  // their sum
  int points;
  double *w, *modes;

  SINEW_HD void operator()(int i) const {
    const int bits = held ? held[i] : 0;
    Square<3> d, lower, inverse;
    for (int r = 0; r < 3; ++r)
      for (int c = 0; c < 3; ++c) {
        const bool own = (bits >> r & 1) || (bits >> c & 1);
        d(r, c) = own ? double(r == c) : double(values[Rows<3>::at(diagonal[i], 3 * r + c)]);
      }
    unit_block<3>(d, -1, lower, inverse);
    double p[3], m[3][6] = {};
    for (int c = 0; c < 3; ++c) p[c] = double(x[i][c]) - places[c] / points;
    m[0][0] = m[1][1] = m[2][2] = 1;
    m[0][4] = p[2], m[0][5] = -p[1];
    m[1][3] = -p[2], m[1][5] = p[0];
    m[2][3] = p[1], m[2][4] = -p[0];
    for (int r = 0; r < 3; ++r)
      for (int c = 0; c < 6; ++c) {
        double sum = 0;
        for (int k = r; k < 3; ++k) sum += bits >> k & 1 ? 0 : lower(k, r) * m[k][c];
        modes[18 * std::ptrdiff_t(i) + 6 * r + c] = sum;
      }
    for (int k = 0; k < 9; ++k) w[9 * std::ptrdiff_t(i) + k] = inverse.data()[k];
  }
};

/// W A W' of a row, and what is held is taken out of its modes (hold_modes).
template <class D>
struct ScalePoint {
  Rows<3> rows;
  typename D::Real const* values;
  int const* diagonal;
  unsigned char const* held;
  double const* w;
  double* scaled;
  float* product;
  double* modes;

  SINEW_HD void operator()(int i) const {
    const int bits = held ? held[i] : 0;
    double own[9];
    for (int k = 0; k < 9; ++k) own[k] = w[9 * std::ptrdiff_t(i) + k];
    Eigen::Matrix3d s = Eigen::Matrix3d::Zero();
    rows.each(i, 0, 1, [&](int k, int j) {
      const bool onDiagonal = k == diagonal[i];
      const int others = held ? held[j] : 0;
      double a[3][3], half[3][3], b[3][3];
      for (int r = 0; r < 3; ++r)
        for (int c = 0; c < 3; ++c) {
          const bool no = (bits >> r & 1) || (others >> c & 1);
          a[r][c] = no ? double(onDiagonal && r == c) : double(values[Rows<3>::at(k, 3 * r + c)]);
        }
      for (int r = 0; r < 3; ++r)
        for (int c = 0; c < 3; ++c) {
          half[r][c] = 0;
          for (int m = 0; m <= r; ++m) half[r][c] += own[3 * r + m] * a[m][c];
        }
      double const* const other = w + 9 * std::ptrdiff_t(j);
      for (int r = 0; r < 3; ++r)
        for (int c = 0; c < 3; ++c) {
          double sum = 0;
          for (int m = 0; m <= c; ++m) sum += half[r][m] * other[3 * c + m];
          b[r][c] = sum;
          scaled[Rows<3>::at(k, 3 * r + c)] = sum;
          product[Rows<3>::at(k, 3 * r + c)] = float(sum);
        }
      if (j == i) return;
      for (int r = 0; r < 3; ++r)
        for (int c = 0; c < 3; ++c)
          for (int m = 0; m < 3; ++m) s(r, c) += b[r][m] * b[c][m];
    });
    Eigen::Matrix3d p;
    if (!range_projector(s, p)) return;
    double* const m = modes + 18 * std::ptrdiff_t(i);
    for (int c = 0; c < 6; ++c) {
      const double before[3] = {m[c], m[6 + c], m[12 + c]};
      for (int r = 0; r < 3; ++r)
        m[6 * r + c] = p(r, 0) * before[0] + p(r, 1) * before[1] + p(r, 2) * before[2];
    }
  }
};

/// sum of the sizes of the diagonal
template <class D>
struct DiagonalSize {
  typename D::Real const* values;
  int const* diagonal;
  SINEW_HD double operator()(int i) const {
    double sum = 0;
    for (int c = 0; c < 3; ++c) {
      const double a = double(values[Rows<3>::at(diagonal[i], 4 * c)]);
      sum += a < 0 ? -a : a;
    }
    return sum;
  }
};

// from a level to the one below

/// The products of the modes of an aggregate with each other, as a factor L: modes = T L' with T'T = 1. What
/// depends on those before has a pivot of 0. That of the coarse modes, L' so far, goes on: L' before.
template <int R>
struct Gram {
  using Real = double;
  static constexpr int sums = 21;
  int const *memberStart, *members;
  double const* modes;
  double *factor, *coarse;
  bool first;

  SINEW_HD void part(int k, int lane, int lanes, double* sum) const {
    for (int m = memberStart[k] + lane; m < memberStart[k + 1]; m += lanes)
      for (int r = 0; r < R; ++r) {
        double const* const b = modes + (std::ptrdiff_t(members[m]) * R + r) * 6;
        double v[6];
        for (int c = 0; c < 6; ++c) v[c] = b[c];
        for (int c = 0, n = 0; c < 6; ++c)
          for (int d = 0; d <= c; ++d, ++n) sum[n] += v[c] * v[d];
      }
  }
  SINEW_HD void finish(int k, double const* sum) const {
    double l[6][6] = {};
    for (int c = 0; c < 6; ++c) {
      double const* const row = sum + c * (c + 1) / 2;
      double pivot = row[c];
      for (int d = 0; d < c; ++d) {
        double s = row[d];
        for (int e = 0; e < d; ++e) s -= l[c][e] * l[d][e];
        l[c][d] = l[d][d] > 0 ? s / l[d][d] : 0;
        pivot -= l[c][d] * l[c][d];
      }
      l[c][c] = pivot > 1e-13 * row[c] ? std::sqrt(pivot) : 0;
    }
    double* const to = factor + 36 * std::ptrdiff_t(k);
    for (int c = 0; c < 6; ++c)
      for (int d = 0; d < 6; ++d) to[6 * c + d] = l[c][d];
    double* const own = coarse + 36 * std::ptrdiff_t(k);
    if (first) {
      for (int r = 0; r < 6; ++r)
        for (int c = 0; c < 6; ++c) own[6 * r + c] = l[c][r];
      return;
    }
    for (int c = 0; c < 6; ++c) {
      double before[6];
      for (int d = 0; d < 6; ++d) before[d] = own[6 * d + c];
      for (int r = 0; r < 6; ++r) {
        double s = 0;
        for (int d = r; d < 6; ++d) s += l[d][r] * before[d];
        own[6 * r + c] = s;
      }
    }
  }
};
/// T = modes L'^-1, in their place, of a row of a point.
template <int R>
struct Orthogonal {
  int const* aggregate;
  double const* factor;
  double* modes;
  SINEW_HD void operator()(int row) const {
    const int k = aggregate[row / R];
    if (k < 0) return;
    double const* const l = factor + 36 * std::ptrdiff_t(k);
    double* const b = modes + 6 * std::ptrdiff_t(row);
    double t[6];
    for (int c = 0; c < 6; ++c) {
      double s = b[c];
      for (int d = 0; d < c; ++d) s -= l[6 * c + d] * t[d];
      t[c] = l[7 * c] > 0 ? s / l[7 * c] : 0;
    }
    for (int c = 0; c < 6; ++c) b[c] = t[c];
  }
};

/// Row r of a block of P = (I - w A) T, w = 4 / (3 bound).
template <int R>
struct SmoothBlock {
  Rows<R> rows;
  double const* values;
  int const *aggregate, *rowOf, *columns;
  double const *tentative, *bound;
  float* p;
  SINEW_HD void operator()(int index) const {
    const int slot = index / R, r = index % R, i = rowOf[slot], k = columns[slot];
    double sum[6] = {};
    rows.each(i, 0, 1, [&](int place, int j) {
      if (aggregate[j] != k) return;
      double const* const t = tentative + 6 * R * std::ptrdiff_t(j);
      for (int m = 0; m < R; ++m) {
        const double a = rows.value(values, place, r, m);
        for (int c = 0; c < 6; ++c) sum[c] += a * t[6 * m + c];
      }
    });
    const double w = 4 / (3 * *bound);
    double const* const own = tentative + 6 * (R * std::ptrdiff_t(i) + r);
    float* const to = p + 6 * std::ptrdiff_t(index);
    for (int c = 0; c < 6; ++c) to[c] = float((aggregate[i] == k ? own[c] : 0) - w * sum[c]);
  }
};

/// Row r of a block of A P: its terms are pairs of a block of A and one of P.
template <int R>
struct ProductBlock {
  struct Term {
    int block, slot;
  };
  Rows<R> rows;
  double const* values;
  int const* first;
  Term const* terms;
  float const* p;
  double* to;
  SINEW_HD void operator()(int index) const {
    const int b = index / R, r = index % R;
    double sum[6] = {};
    for (int t = first[b]; t < first[b + 1]; ++t) {
      const Term term = terms[t];
      float const* const block = p + 6 * R * std::ptrdiff_t(term.slot);
      for (int m = 0; m < R; ++m) {
        const double a = rows.value(values, term.block, r, m);
        for (int c = 0; c < 6; ++c) sum[c] += a * double(block[6 * m + c]);
      }
    }
    double* const out = to + 6 * std::ptrdiff_t(index);
    for (int c = 0; c < 6; ++c) out[c] = sum[c];
  }
};
/// Row r of a block of P' (A P): its terms are pairs of a block of P and one of A P.
template <int R>
struct GalerkinBlock {
  using Real = double;
  static constexpr int sums = 6;
  struct Term {
    int slot, block;
  };
  int const* first;
  Term const* terms;
  float const* p;
  double const* product;
  double* to;
  SINEW_HD void part(int index, int lane, int lanes, double* sum) const {
    const int b = index / 6, r = index % 6;
    for (int t = first[b] + lane; t < first[b + 1]; t += lanes) {
      const Term term = terms[t];
      float const* const left = p + 6 * R * std::ptrdiff_t(term.slot) + r;
      double const* const right = product + 6 * R * std::ptrdiff_t(term.block);
      for (int m = 0; m < R; ++m) {
        const double a = double(left[6 * m]);
        for (int c = 0; c < 6; ++c) sum[c] += a * right[6 * m + c];
      }
    }
  }
  SINEW_HD void finish(int index, double const* sum) const {
    for (int c = 0; c < 6; ++c) to[6 * std::ptrdiff_t(index) + c] = sum[c];
  }
};

/// Of each aggregate W, from its diagonal block, and its modes L' times what they were.
struct UnitAggregate {
  int const* diagonal;  // slots
  double const* raw;
  double *w, *modes;
  SINEW_HD void operator()(int k) const {
    double const* const block = raw + 36 * std::ptrdiff_t(diagonal[k]);
    Square<6> d, lower, inverse;
    for (int r = 0; r < 6; ++r)
      for (int c = 0; c < 6; ++c) d(r, c) = 0.5 * (block[6 * r + c] + block[6 * c + r]);
    unit_block<6>(d, 1e-13, lower, inverse);
    double* const m = modes + 36 * std::ptrdiff_t(k);
    for (int c = 0; c < 6; ++c) {
      double before[6];
      for (int r = 0; r < 6; ++r) before[r] = m[6 * r + c];
      for (int r = 0; r < 6; ++r) {
        double sum = 0;
        for (int e = r; e < 6; ++e) sum += lower(e, r) * before[e];
        m[6 * r + c] = sum;
      }
    }
    for (int e = 0; e < 36; ++e) w[36 * std::ptrdiff_t(k) + e] = inverse.data()[e];
  }
};
/// Row r of a block W_k A W_l' on or above the diagonal.
struct ScaleBlock {
  int const *rowOf, *columnOf;  // of slots
  double const *raw, *w;
  double* to;
  SINEW_HD void operator()(int index) const {
    const int slot = index / 6, r = index % 6, k = rowOf[slot], l = columnOf[slot];
    double const* const a = raw + 36 * std::ptrdiff_t(slot);
    double const* const left = w + 36 * std::ptrdiff_t(k) + 6 * r;
    double const* const right = w + 36 * std::ptrdiff_t(l);
    double half[6] = {};
    for (int m = 0; m <= r; ++m)
      for (int c = 0; c < 6; ++c)
        half[c] += left[m] * (k == l ? 0.5 * (a[6 * m + c] + a[6 * c + m]) : a[6 * m + c]);
    for (int c = 0; c < 6; ++c) {
      double sum = 0;
      for (int m = 0; m <= c; ++m) sum += half[m] * right[6 * c + m];
      if (k == l && r == c && left[r] == 0) sum = 1;
      to[6 * std::ptrdiff_t(index) + c] = sum;
    }
  }
};
/// Row r of a block of P W'.
struct ScaleProlongation {
  int rowsOfBlock;
  int const* columns;
  double const* w;
  float* p;
  SINEW_HD void operator()(int index) const {
    double const* const right = w + 36 * std::ptrdiff_t(columns[index / rowsOfBlock]);
    float* const own = p + 6 * std::ptrdiff_t(index);
    double before[6];
    for (int c = 0; c < 6; ++c) before[c] = double(own[c]);
    for (int c = 0; c < 6; ++c) {
      double sum = 0;
      for (int d = 0; d <= c; ++d) sum += right[6 * c + d] * before[d];
      own[c] = float(sum);
    }
  }
};
/// A row of a block in float.
struct FloatRow {
  Rows<6> rows;
  double const* values;
  float* to;
  SINEW_HD void operator()(int index) const {
    const int k = index / 6, r = index % 6;
    for (int c = 0; c < 6; ++c) to[Rows<6>::at(k, 6 * r + c)] = float(rows.value(values, k, r, c));
  }
};

// the largest eigenvalue, by steps of Lanczos

/// Numbers of both signs, of which each power of a matrix has a part; their squares.
template <int R>
struct StartVector {
  float *d, *x;
  SINEW_HD double operator()(int i) const {
    unsigned seed = unsigned(i) * 2654435761u + 1u;
    seed ^= seed >> 15;
    seed *= 2246822519u;
    seed ^= seed >> 13;
    const bool none = R == 6 && i % 8 > 5;
    const float value = none ? 0.f : float(seed >> 8) * 0x1p-23f - 1.f;
    d[i] = value;
    x[i] = 0;
    return double(value) * double(value);
  }
};
/// 1 / the length of a direction, from its square
SINEW_INLINE float over_length(double square) { return float(1 / std::sqrt(square)); }
/// q = A d / |d| of a row
template <int R>
struct Multiply {
  using Real = float;
  static constexpr int sums = R;
  Rows<R> rows;
  float const *values, *d;
  double const* square;  // d.d
  float* q;
  SINEW_HD void part(int i, int lane, int lanes, float* sum) const {
    add_row<R>(rows, values, d, i, lane, lanes, sum);
  }
  SINEW_HD void finish(int i, float const* sum) const {
    const float over = over_length(*square);
    for (int c = 0; c < R; ++c) q[stride<R> * std::ptrdiff_t(i) + c] = over * sum[c];
  }
};
/// d.q / |d|
struct Dot {
  float const *d, *q;
  double const* square;
  struct OfThread {
    float const *d, *q;
    float over;
    SINEW_HD double operator()(int i) const { return double(over * d[i]) * double(q[i]); }
  };
  SINEW_HD OfThread ofThread() const { return {d, q, over_length(*square)}; }
};
/// With e = d / |d| the next direction q - own e - |d| x, which becomes d, and e the one before, x; its
/// square.
struct NextDirection {
  float *d, *q, *x;
  double const *own, *square;
  bool later;  // there is one before
  struct OfThread {
    float *d, *q, *x;
    float own, over, last;
    SINEW_HD double operator()(int i) const {
      const float e = over * d[i], next = q[i] - (own * e + last * x[i]);
      x[i] = e;
      d[i] = next;
      return double(next) * double(next);
    }
  };
  SINEW_HD OfThread ofThread() const {
    return {d, q, x, float(*own), over_length(*square), later ? float(std::sqrt(*square)) : 0.f};
  }
};
/// 1.05 times the largest eigenvalue of what the steps have found; squares[k] is that before step k.
struct FindBound {
  static constexpr int steps = 8;
  double const *diagonal, *squares;
  double* bound;
  SINEW_HD void operator()(int) const {
    double beside[steps] = {};
    int done = 0;
    for (int k = 0; k < steps; ++k) {
      beside[k] = std::sqrt(squares[k + 1]);
      done = k + 1;
      const double own = diagonal[k] < 0 ? -diagonal[k] : diagonal[k];
      if (!(beside[k] > 1e-5 * own && beside[k] < 1e300)) break;
    }
    const double found = largest_eigenvalue(diagonal, beside, done);
    *bound = found > 0 && found < 1e300 ? 1.05 * found : 1.05;
  }
};

// the cycle

/// One step of the smoother of A x = b: r -= A d, then d = turn d + gain r / bound and x += d. `last`: the
/// residual alone is wanted.
template <int R>
struct Smooth {
  using Real = float;
  static constexpr int sums = R;
  Rows<R> rows;
  float const *values, *d;
  float *next, *x, *r;
  double const* bound;
  float turn, gain;
  bool last;

  SINEW_HD void part(int i, int lane, int lanes, float* sum) const {
    add_row<R>(rows, values, d, i, lane, lanes, sum);
  }
  SINEW_HD void finish(int i, float const* sum) const {
    const float step = gain / float(*bound);
    for (int c = 0; c < R; ++c) {
      const std::ptrdiff_t k = stride<R> * std::ptrdiff_t(i) + c;
      const float left = r[k] - sum[c];
      r[k] = left;
      if (last) continue;
      const float change = turn * d[k] + step * left;
      next[k] = change;
      x[k] += change;
    }
  }
};
/// The residual of a level, P' that of the one above, and the first step of its smoother.
template <int R>
struct Restrict {
  using Real = float;
  static constexpr int sums = 6;
  int const *start, *from, *slots;  // of the columns of P
  float const *p, *fine;
  double const* bound;
  float gain;
  float *r, *d, *x;
  SINEW_HD void part(int k, int lane, int lanes, float* sum) const {
    for (int t = start[k] + lane; t < start[k + 1]; t += lanes) {
      float const* const v = fine + stride<R> * std::ptrdiff_t(from[t]);
      float const* const block = p + 6 * R * std::ptrdiff_t(slots[t]);
      for (int m = 0; m < R; ++m)
        for (int c = 0; c < 6; ++c) sum[c] += block[6 * m + c] * v[m];
    }
  }
  SINEW_HD void finish(int k, float const* sum) const {
    const float step = gain / float(*bound);
    for (int c = 0; c < 6; ++c) {
      const std::ptrdiff_t n = 8 * std::ptrdiff_t(k) + c;
      r[n] = sum[c];
      d[n] = x[n] = step * sum[c];
    }
  }
};
/// d = P coarse in row r of a point, and x += d.
template <int R>
struct Prolong {
  int const *start, *columns;
  float const *p, *coarse;
  float *d, *x;
  SINEW_HD void operator()(int index) const {
    const int i = index / R, r = index % R;
    float sum = 0;
    for (int s = start[i]; s < start[i + 1]; ++s) {
      float const* const v = coarse + 8 * std::ptrdiff_t(columns[s]);
      float const* const block = p + 6 * (R * std::ptrdiff_t(s) + r);
      for (int c = 0; c < 6; ++c) sum += block[c] * v[c];
    }
    const std::ptrdiff_t k = stride<R> * std::ptrdiff_t(i) + r;
    d[k] = sum;
    x[k] += sum;
  }
};

/// The residual as the cycle has it, scale W r with scale = size / |r|, and the first step of its smoother.
template <class D>
struct Enter {
  double const* w;
  typename D::Deriv const* from;
  double const *diagonal, *square, *bound;  // sum of the diagonal's sizes, r.r
  int points;
  float gain;
  float *r, *d, *x;
  SINEW_HD void operator()(int i) const {
    const double scale = std::sqrt(*diagonal / (3.0 * points) / *square);
    double const* const own = w + 9 * std::ptrdiff_t(i);
    const float step = gain / float(*bound);
    for (int c = 0; c < 3; ++c) {
      double sum = 0;
      for (int k = 0; k <= c; ++k) sum += own[3 * c + k] * double(from[i][k]);
      const std::ptrdiff_t n = 3 * std::ptrdiff_t(i) + c;
      r[n] = float(scale * sum);
      d[n] = x[n] = step * r[n];
    }
  }
};
/// z = W' x / scale; r.z.
template <class D>
struct Leave {
  double const* w;
  float const* x;
  double const *diagonal, *square;
  int points;
  typename D::Deriv const* r;
  typename D::Deriv* z;
  SINEW_HD double operator()(int i) const {
    const double scale = std::sqrt(*square / (*diagonal / (3.0 * points)));
    double const* const own = w + 9 * std::ptrdiff_t(i);
    double along = 0;
    for (int c = 0; c < 3; ++c) {
      double sum = 0;
      for (int k = c; k < 3; ++k) sum += own[3 * k + c] * double(x[3 * std::ptrdiff_t(i) + k]);
      z[i][c] = typename D::Real(sum * scale);
      along += double(r[i][c]) * double(z[i][c]);
    }
    return along;
  }
};

// the coarsest level

/// A row of the matrix as a dense one.
template <int R>
struct DenseRow {
  Rows<R> rows;
  double const* values;
  int n;  // unknowns
  double* to;
  SINEW_HD void operator()(int row) const {
    double* const own = to + std::ptrdiff_t(row) * n;
    for (int c = 0; c < n; ++c) own[c] = 0;
    rows.each(row / R, 0, 1, [&](int k, int j) {
      for (int c = 0; c < R; ++c) own[R * j + c] += rows.value(values, k, row % R, c);
    });
  }
};
/// x = A^-1 r of an unknown
template <int R>
struct Solve {
  using Real = double;
  static constexpr int sums = 1;
  double const* inverse;
  int n;
  float const* r;
  float* x;
  SINEW_HD void part(int i, int lane, int lanes, double* sum) const {
    double const* const own = inverse + std::ptrdiff_t(i) * n;
    for (int j = lane; j < n; j += lanes) *sum += own[j] * double(r[stride<R> * (j / R) + j % R]);
  }
  SINEW_HD void finish(int i, double const* sum) const { x[stride<R> * (i / R) + i % R] = float(*sum); }
};

/// A -> A^-1 for a symmetric positive definite A of n unknowns with unit diagonal, by steps of Gauss and
/// Jordan in its place; unknowns whose pivot is nothing get nothing. each(f): f(k) for the k of a thread in 0
/// .. n n
/// - 1; sync(): all threads are there. `row` has room for 2 n numbers.
template <class Each, class Sync>
SINEW_INLINE void invert_in_place(double* a, int n, double* row, Each&& each, Sync&& sync) {
  for (int k = 0; k < n; ++k) {
    // row k and column k, as all threads read them
    each(2 * n,
         [&](int j) { row[j] = j < n ? a[std::ptrdiff_t(k) * n + j] : a[std::ptrdiff_t(j - n) * n + k]; });
    sync();
    const double pivot = row[k];
    const bool is = pivot > 1e-12;
    const double inverse = is ? 1 / pivot : 0;
    each(n * n, [&](int at) {
      const int i = at / n, j = at % n;
      double& to = a[at];
      if (i == k && j == k)
        to = inverse;
      else if (i == k)
        to = row[j] * inverse;
      else if (j == k)
        to = -row[n + i] * inverse;
      else
        to -= row[n + i] * inverse * row[j];
    });
    sync();
  }
}
#if SINEW_CUDA
namespace detail {
inline constexpr int invertingThreads = 1024;
template <class Number>
__global__ void __launch_bounds__(invertingThreads) invert_kernel(Number* a, int n, Number* row) {
  invert_in_place(
      a,
      n,
      row,
      [](int count, auto&& f) {
        for (int k = int(threadIdx.x); k < count; k += invertingThreads) f(k);
      },
      [] { __syncthreads(); });
}
inline constexpr int sweepingWarps = 16;
/// The same for up to 16 Rows unknowns, with the lower triangle in registers, that of rows from 128 on in
/// shared memory: a warp has each 16th row, a lane each 32nd column. The steps are those of the symmetric
/// sweep, a -> -a^-1 (Beaton 1964): with the pivot d = a_kk, a_ij -= a_ik a_kj / d, a_ik = a_ik / d, a_kk =
/// -1 / d.
template <int Rows>
struct SweptTriangle {
  static constexpr int kept = Rows < 8 ? Rows : 8, tiles = (Rows + 1) / 2;
  double registers[kept][(kept + 1) / 2];
  double* others;  // of this thread, 32 sweepingWarps apart

  // f(entry, c) for the entries of its row R, or C alone
  template <int R, class F>
  __device__ void ofRow(F&& f) {
    [&]<int... C>(std::integer_sequence<int, C...>) {
      (f(entry<R, C>(), C), ...);
    }(std::make_integer_sequence<int, R / 2 + 1>{});
  }
  template <int R, int C>
  __device__ double& entry() {
    if constexpr (R < kept)
      return registers[R][C];
    else
      return others[((R / 2 + R % 2) * (R / 2 + 1) - kept / 2 * (kept / 2 + 1) + C) * 32 * sweepingWarps];
  }
  // f.operator()<R>() for all its rows from First on
  template <int First = 0, class F>
  __device__ static void eachRow(F&& f) {
    [&]<int... R>(std::integer_sequence<int, R...>) {
      (f.template operator()<First + R>(), ...);
    }(std::make_integer_sequence<int, Rows - First>{});
  }
};
template <int Rows>
__global__ void __launch_bounds__(32 * sweepingWarps, 1) sweep_kernel(double* a, int n) {
  constexpr int warps = sweepingWarps, tiles = (Rows + 1) / 2;
  __shared__ double columns[2][32 * tiles];  // column k, as all threads read it, of two steps in turn
  extern __shared__ double shared[];
  const int warp = int(threadIdx.x) / 32, lane = int(threadIdx.x) % 32;
  using Triangle = SweptTriangle<Rows>;
  Triangle own;
  own.others = shared + threadIdx.x;
  Triangle::eachRow([&]<int R>() {
    const int i = warp + warps * R;
    own.template ofRow<R>([&](double& entry, int c) {
      const int j = lane + 32 * c;
      entry = i < n && j <= i ? a[std::ptrdiff_t(i) * n + j] : 0;
    });
  });
  Triangle::eachRow([&]<int Strip>() {
#pragma unroll 1
    for (int k = warps * Strip; k < min(n, warps * Strip + warps); ++k) {
      double* const column = columns[k % 2];
      if (warp == k % warps)
        own.template ofRow<Strip>([&](double& entry, int c) {
          if (lane + 32 * c <= k) column[lane + 32 * c] = entry;
        });
      if (lane == k % 32)
        Triangle::template eachRow<Strip>([&]<int R>() {
          if (warp + warps * R > k) column[warp + warps * R] = own.template entry<R, Strip / 2>();
        });
      __syncthreads();
      const double pivot = column[k];
      const double inverse = pivot > 1e-12 ? 1 / pivot : 0;
      double other[tiles];
#pragma unroll
      for (int c = 0; c < tiles; ++c) other[c] = column[lane + 32 * c];
      Triangle::eachRow([&]<int R>() {
        const int i = warp + warps * R;
        const double scaled = column[i] * inverse;
        own.template ofRow<R>([&](double& entry, int c) {
          const bool across = lane + 32 * c == k;
          entry = i == k ? (across ? -inverse : other[c] * inverse)
                         : (across ? scaled : entry - scaled * other[c]);
        });
      });
    }
  });
  Triangle::eachRow([&]<int R>() {
    const int i = warp + warps * R;
    own.template ofRow<R>([&](double& entry, int c) {
      const int j = lane + 32 * c;
      if (i < n && j <= i) a[std::ptrdiff_t(i) * n + j] = a[std::ptrdiff_t(j) * n + i] = -entry;
    });
  });
}
}  // namespace detail
#endif
/// The same by one block of a GPU, or on the host.
inline void invert(double* a, int n, double* row) {
#if SINEW_CUDA
  constexpr int threads = 32 * detail::sweepingWarps, others = (56 - 7 - 20) * threads * int(sizeof(double));
  if (n <= 64) {
    detail::sweep_kernel<4><<<1, threads, 0, stream()>>>(a, n);
  } else if (n <= 128) {
    detail::sweep_kernel<8><<<1, threads, 0, stream()>>>(a, n);
  } else if (n <= 208) {
    auto* const kernel = detail::sweep_kernel<13>;
    check(cudaFuncSetAttribute(kernel, cudaFuncAttributeMaxDynamicSharedMemorySize, others),
          "a factor on the GPU");
    kernel<<<1, threads, others, stream()>>>(a, n);
  } else {
    detail::invert_kernel<<<1, detail::invertingThreads, 0, stream()>>>(a, n, row);
  }
  check(cudaGetLastError(), "a factor on the GPU");
#else
  invert_in_place(
      a,
      n,
      row,
      [](int count, auto&& f) {
        for (int k = 0; k < count; ++k) f(k);
      },
      [] {});
#endif
}

}  // namespace sinew::gpu::multigrid
