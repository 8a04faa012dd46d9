// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/core/platform.hpp>

#include <Eigen/Core>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <limits>
#include <type_traits>
#include <utility>

namespace sinew {

/// The type of one lane: double of Lanes<double, 8> and of double.
template <class T>
struct lane_traits {
  using Scalar = T;
  static constexpr int width = 1;
};
template <class T>
using lane_scalar = typename lane_traits<T>::Scalar;

/// a where the mask holds, b elsewhere; for scalars, which are one lane, and for lanes.
template <class T>
requires std::is_floating_point_v<T>
SINEW_INLINE T select(bool mask, T a, T b) {
  return mask ? a : b;
}
SINEW_INLINE bool any(bool mask) { return mask; }
SINEW_INLINE bool both(bool a, bool b) { return a && b; }
template <class T>
requires std::is_floating_point_v<T>
SINEW_INLINE T lane(T a, int) {
  return a;
}
template <int N, class T>
SINEW_INLINE void transpose(T const* in, T (&out)[1][std::size_t(N + 3) / 4 * 4]) {
  for (int c = 0; c < (N + 3) / 4 * 4; ++c) out[0][c] = c < N ? in[c] : T(0);
}

#if defined(__CUDACC__)
// Device code has no vector registers, and a thread takes one element: nvcc sees of lanes only the names that
// laws mention.
template <class T, int W>
struct Lanes;
template <class T, int W>
Lanes<T, W> sqrt(Lanes<T, W>);
template <class T, int W>
Lanes<T, W> abs(Lanes<T, W>);
template <int Stride, int N, class T, int W>
void gather(T const*, int const*, Lanes<T, W>*);
#else

/// Mask that a comparison of lanes yields: all bits of a lane set where it holds. `bool` for plain scalars.
template <class T, int W>
struct LaneMask {
  using Integer = std::conditional_t<sizeof(T) == 8, std::int64_t, std::int32_t>;
  typedef Integer Bits __attribute__((vector_size(W * sizeof(T))));
  Bits bits;

  SINEW_INLINE friend LaneMask operator&(LaneMask a, LaneMask b) { return {a.bits & b.bits}; }
  SINEW_INLINE friend LaneMask operator|(LaneMask a, LaneMask b) { return {a.bits | b.bits}; }
  SINEW_INLINE friend LaneMask operator!(LaneMask a) { return {~a.bits}; }
};

/// W values of T that go through arithmetic together, on the compiler's vector extension: the scalar of an
/// element law when the driver packs W elements. Chosen over std::experimental::simd, whose header alone adds
/// 0.6 s to every translation unit.
template <class T, int W>
struct Lanes {
  static_assert(std::is_floating_point_v<T> && W > 1 && (W & (W - 1)) == 0);
  typedef T Vector __attribute__((vector_size(W * sizeof(T))));
  using Mask = LaneMask<T, W>;
  Vector v;

  Lanes() = default;
  SINEW_INLINE Lanes(Vector vector) : v(vector) {}
  template <class S>
  requires std::is_arithmetic_v<S>
  SINEW_INLINE Lanes(S s) : v(T(s) - Vector{}) {}

  SINEW_INLINE T operator[](int lane) const { return v[lane]; }
  SINEW_INLINE void set(int lane, T value) { v[lane] = value; }

  SINEW_INLINE friend Lanes operator+(Lanes a, Lanes b) { return Lanes(a.v + b.v); }
  SINEW_INLINE friend Lanes operator-(Lanes a, Lanes b) { return Lanes(a.v - b.v); }
  SINEW_INLINE friend Lanes operator*(Lanes a, Lanes b) { return Lanes(a.v * b.v); }
  SINEW_INLINE friend Lanes operator/(Lanes a, Lanes b) { return Lanes(a.v / b.v); }
  SINEW_INLINE friend Lanes operator-(Lanes a) { return Lanes(-a.v); }
  SINEW_INLINE Lanes& operator+=(Lanes b) { return v += b.v, *this; }
  SINEW_INLINE Lanes& operator-=(Lanes b) { return v -= b.v, *this; }
  SINEW_INLINE Lanes& operator*=(Lanes b) { return v *= b.v, *this; }
  SINEW_INLINE Lanes& operator/=(Lanes b) { return v /= b.v, *this; }
  SINEW_INLINE friend Mask operator<(Lanes a, Lanes b) { return {a.v < b.v}; }
  SINEW_INLINE friend Mask operator>(Lanes a, Lanes b) { return {a.v > b.v}; }
  SINEW_INLINE friend Mask operator<=(Lanes a, Lanes b) { return {a.v <= b.v}; }
  SINEW_INLINE friend Mask operator>=(Lanes a, Lanes b) { return {a.v >= b.v}; }
  SINEW_INLINE friend Mask operator==(Lanes a, Lanes b) { return {a.v == b.v}; }
  SINEW_INLINE friend Mask operator!=(Lanes a, Lanes b) { return {a.v != b.v}; }
};

template <class T, int W>
SINEW_INLINE Lanes<T, W> select(LaneMask<T, W> mask, Lanes<T, W> a, Lanes<T, W> b) {
  return Lanes<T, W>(mask.bits ? a.v : b.v);
}

template <class T, int W>
SINEW_INLINE bool any(LaneMask<T, W> mask) {
  bool set = false;
  for (int i = 0; i < W; ++i) set |= mask.bits[i] != 0;
  return set;
}

template <class T, int W>
SINEW_INLINE LaneMask<T, W> both(LaneMask<T, W> a, LaneMask<T, W> b) {
  return a & b;
}

/// The mask of lanes whose bit is set, from the lowest on.
template <class L>
SINEW_INLINE typename L::Mask lanes_of_bits(unsigned bits) {
  using Mask = typename L::Mask;
  typename Mask::Bits single{};
  for (int l = 0; l < lane_traits<L>::width; ++l) single[l] = typename Mask::Integer(1) << l;
  return {(single & typename Mask::Integer(bits)) != 0};
}

template <class T, int W>
SINEW_INLINE Lanes<T, W> sqrt(Lanes<T, W> a) {
  using R = Lanes<T, W>;
#if defined(__AVX512F__)
  if constexpr (W * sizeof(T) == 64 && sizeof(T) == 8)
    return R(
        reinterpret_cast<typename R::Vector>(_mm512_maskz_sqrt_pd(0xff, reinterpret_cast<__m512d>(a.v))));
  if constexpr (W * sizeof(T) == 64 && sizeof(T) == 4)
    return R(
        reinterpret_cast<typename R::Vector>(_mm512_maskz_sqrt_ps(0xffff, reinterpret_cast<__m512>(a.v))));
#endif
#if defined(__AVX__)
  if constexpr (W * sizeof(T) == 32 && sizeof(T) == 8)
    return R(reinterpret_cast<typename R::Vector>(_mm256_sqrt_pd(reinterpret_cast<__m256d>(a.v))));
  if constexpr (W * sizeof(T) == 32 && sizeof(T) == 4)
    return R(reinterpret_cast<typename R::Vector>(_mm256_sqrt_ps(reinterpret_cast<__m256>(a.v))));
#endif
#if defined(__SSE2__)
  if constexpr (W * sizeof(T) == 16 && sizeof(T) == 8)
    return R(reinterpret_cast<typename R::Vector>(_mm_sqrt_pd(reinterpret_cast<__m128d>(a.v))));
  if constexpr (W * sizeof(T) == 16 && sizeof(T) == 4)
    return R(reinterpret_cast<typename R::Vector>(_mm_sqrt_ps(reinterpret_cast<__m128>(a.v))));
#endif
  R root;
  for (int i = 0; i < W; ++i) root.v[i] = std::sqrt(a.v[i]);
  return root;
}
template <class T, int W>
SINEW_INLINE Lanes<T, W> abs(Lanes<T, W> a) {
  return select(a < Lanes<T, W>(0), -a, a);
}

template <class T, int W>
struct lane_traits<Lanes<T, W>> {
  using Scalar = T;
  static constexpr int width = W;
};
template <class T, int W>
SINEW_INLINE T lane(Lanes<T, W> a, int i) {
  return a.v[i];
}

namespace detail {

template <class V, int... I>
SINEW_INLINE V shuffle(V a, V b, std::integer_sequence<int, I...>) {
  return __builtin_shufflevector(a, b, I...);
}
// indices that take runs of `Run` lanes from a and b alternately, from lane `From` on
template <int W, int Run, int From, int... I>
constexpr auto interleave(std::integer_sequence<int, I...>) {
  return std::integer_sequence<int, ((I / Run % 2) * W + From + I / (2 * Run) * Run + I % Run)...>{};
}
template <int Run, int From, class T, int W>
SINEW_INLINE typename Lanes<T, W>::Vector interleaved(typename Lanes<T, W>::Vector a,
                                                      typename Lanes<T, W>::Vector b) {
  return shuffle(a, b, interleave<W, Run, From>(std::make_integer_sequence<int, W>{}));
}

}  // namespace detail

namespace detail {

// vectors of four as parts of a wider one; by way of memory they would be stored and loaded in different
// sizes, which processors do slowly
template <class T>
using Four = typename Lanes<T, 4>::Vector;
template <class T, int W, int... I>
SINEW_INLINE Four<T> four_of(typename Lanes<T, W>::Vector const& v, int number,
                             std::integer_sequence<int, I...>) {
  if constexpr (W == 4) {
    return v;
  } else {
    Four<T> part{};
    ((number == I ? void(part = __builtin_shufflevector(v, v, 4 * I, 4 * I + 1, 4 * I + 2, 4 * I + 3))
                  : void()),
     ...);
    return part;
  }
}
template <class T, int W>
SINEW_INLINE typename Lanes<T, W>::Vector join_fours(Four<T> const (&part)[std::size_t(W) / 4]) {
  if constexpr (W == 4) {
    return part[0];
  } else if constexpr (W == 8) {
    return __builtin_shufflevector(part[0], part[1], 0, 1, 2, 3, 4, 5, 6, 7);
  } else {
    static_assert(W == 16);
    const auto low = __builtin_shufflevector(part[0], part[1], 0, 1, 2, 3, 4, 5, 6, 7);
    const auto high = __builtin_shufflevector(part[2], part[3], 0, 1, 2, 3, 4, 5, 6, 7);
    return __builtin_shufflevector(low, high, 0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15);
  }
}

}  // namespace detail

/// out[l] = lane l of the N values `in`, filled up with zeros to a multiple of four: W short vectors from N
/// of lanes.
template <int N, class T, int W>
SINEW_INLINE void transpose(Lanes<T, W> const* in, T (&out)[std::size_t(W)][std::size_t(N + 3) / 4 * 4]) {
  constexpr int groups = (N + 3) / 4;
  using V = typename Lanes<T, W>::Vector;
  if constexpr (W >= 4) {
    for (int g = 0; g < groups; ++g) {
      const V zero{};
      const V a = in[4 * g].v, b = 4 * g + 1 < N ? in[4 * g + 1].v : zero,
              c = 4 * g + 2 < N ? in[4 * g + 2].v : zero, d = 4 * g + 3 < N ? in[4 * g + 3].v : zero;
      const V low0 = detail::interleaved<1, 0, T, W>(a, b), low1 = detail::interleaved<1, 0, T, W>(c, d);
      const V high0 = detail::interleaved<1, W / 2, T, W>(a, b),
              high1 = detail::interleaved<1, W / 2, T, W>(c, d);
      const V rows[4] = {detail::interleaved<2, 0, T, W>(low0, low1),
                         detail::interleaved<2, W / 2, T, W>(low0, low1),
                         detail::interleaved<2, 0, T, W>(high0, high1),
                         detail::interleaved<2, W / 2, T, W>(high0, high1)};
      for (int l = 0; l < W; ++l) {
        const detail::Four<T> row =
            detail::four_of<T, W>(rows[l / (W / 4)], l % (W / 4), std::make_integer_sequence<int, W / 4>{});
        std::memcpy(&out[l][4 * g], &row, sizeof row);
      }
    }
  } else {
    for (int l = 0; l < W; ++l)
      for (int c = 0; c < 4 * groups; ++c) out[l][c] = c < N ? in[c].v[l] : T(0);
  }
}

namespace detail {

// indices of the runs of `Run` lanes in a then b that have number First, First + 2, ...: undoes `interleave`
template <int W, int Run, int First, int... I>
constexpr auto alternate(std::integer_sequence<int, I...>) {
  return std::integer_sequence<int, (I / Run * 2 * Run + First * Run + I % Run)...>{};
}
template <int Run, int First, class T, int W>
SINEW_INLINE typename Lanes<T, W>::Vector alternating(typename Lanes<T, W>::Vector const& a,
                                                      typename Lanes<T, W>::Vector const& b) {
  return shuffle(a, b, alternate<W, Run, First>(std::make_integer_sequence<int, W>{}));
}

}  // namespace detail

/// Point l at to + 3 * index[l] += lane l of the three components `from`; lane after lane, where points are
/// the same.
template <class T, int W>
requires(W >= 4)
SINEW_INLINE void add3(Lanes<T, W> const* from, T* to, int const (&index)[std::size_t(W)]) {
  using V = typename Lanes<T, W>::Vector;
  typedef T Two __attribute__((vector_size(2 * sizeof(T))));
  const V xy0 = detail::interleaved<1, 0, T, W>(from[0].v, from[1].v),
          xy1 = detail::interleaved<1, W / 2, T, W>(from[0].v, from[1].v);
  [&]<int... I>(std::integer_sequence<int, I...>) __attribute__((always_inline)) {
    (
        [&]() __attribute__((always_inline)) {
          constexpr int at = 2 * (I % (W / 2));
          V const& pairs = I < W / 2 ? xy0 : xy1;
          const Two more = __builtin_shufflevector(pairs, pairs, at, at + 1);
          T* const point = to + 3 * index[I];
          Two sum;
          std::memcpy(&sum, point, sizeof sum);
          sum += more;
          std::memcpy(point, &sum, sizeof sum);
          point[2] += from[2].v[I];
        }(),
        ...);
  }
  (std::make_integer_sequence<int, W>{});
}

/// to[c] = lanes of component c < N of W points, point l at from + Stride * index[l]. Four scalars of each
/// point are read, also where N is 3.
template <int Stride, int N, class T, int W>
requires(W >= 4 && (N == 3 || N == 4))
SINEW_INLINE void gather(T const* from, int const* index, Lanes<T, W>* to) {
  using V = typename Lanes<T, W>::Vector;
  constexpr int each = W / 4;  // points a vector holds, four scalars each
  V rows[4];
  for (int r = 0; r < 4; ++r) {
    detail::Four<T> points[std::size_t(each)];
    for (int k = 0; k < each; ++k)
      std::memcpy(&points[k], from + Stride * index[r * each + k], sizeof points[k]);
    rows[r] = detail::join_fours<T, W>(points);
  }
  const V xy0 = detail::alternating<2, 0, T, W>(rows[0], rows[1]),
          zw0 = detail::alternating<2, 1, T, W>(rows[0], rows[1]);
  const V xy1 = detail::alternating<2, 0, T, W>(rows[2], rows[3]),
          zw1 = detail::alternating<2, 1, T, W>(rows[2], rows[3]);
  to[0].v = detail::alternating<1, 0, T, W>(xy0, xy1);
  to[1].v = detail::alternating<1, 1, T, W>(xy0, xy1);
  to[2].v = detail::alternating<1, 0, T, W>(zw0, zw1);
  if constexpr (N == 4) to[3].v = detail::alternating<1, 1, T, W>(zw0, zw1);
}
/// to[c] = lanes of component c of W points, point l at from + 3 * index[l]. One scalar behind each point is
/// read.
template <class T, int W>
requires(W >= 4)
SINEW_INLINE void gather3(T const* from, int const (&index)[std::size_t(W)], Lanes<T, W>* to) {
  gather<3, 3>(from, index, to);
}

namespace detail {

// Where 3 i + c is, modulo W, is lane i of component c: 3 has an inverse modulo W, so that no two are in one
// lane, and what is W or 2 W further comes in the same lane of the next vector.
template <int W, int C, int... I>
constexpr auto spread_by_three(std::integer_sequence<int, I...>) {
  constexpr int inverse = W % 3 == 1 ? (2 * W + 1) / 3 : (W + 1) / 3;
  return std::integer_sequence<int, (I - C + W) * inverse % W...>{};
}
template <int W, int C, int... I>
constexpr auto gather_by_three(std::integer_sequence<int, I...>) {
  return std::integer_sequence<int, (3 * I + C) % W...>{};
}
// lanes of a where I is not from component C, else those of b
template <int W, int C, int From, int... I>
constexpr auto with_component(std::integer_sequence<int, I...>) {
  return std::integer_sequence<int, ((From + I) % 3 == C ? W : 0) + I...>{};
}

}  // namespace detail

/// The three components of W points one behind the other.
template <class T, int W>
SINEW_INLINE void load3(T const* from, Lanes<T, W> (&to)[3]) {
  using V = typename Lanes<T, W>::Vector;
  constexpr auto all = std::make_integer_sequence<int, W>{};
  V a, b, c;
  std::memcpy(&a, from, sizeof a), std::memcpy(&b, from + W, sizeof b);
  std::memcpy(&c, from + 2 * W, sizeof c);
  [&]<int... C>(std::integer_sequence<int, C...>) __attribute__((always_inline)) {
    (
        [&]() __attribute__((always_inline)) {
          const V ab = detail::shuffle(a, b, detail::with_component<W, C, W>(all));
          const V abc = detail::shuffle(ab, c, detail::with_component<W, C, 2 * W>(all));
          to[C].v = detail::shuffle(abc, abc, detail::gather_by_three<W, C>(all));
        }(),
        ...);
  }
  (std::make_integer_sequence<int, 3>{});
}

/// W points one behind the other, from their three components.
template <class T, int W>
SINEW_INLINE void store3(Lanes<T, W> const (&from)[3], T* to) {
  using V = typename Lanes<T, W>::Vector;
  constexpr auto all = std::make_integer_sequence<int, W>{};
  const V x = detail::shuffle(from[0].v, from[0].v, detail::spread_by_three<W, 0>(all)),
          y = detail::shuffle(from[1].v, from[1].v, detail::spread_by_three<W, 1>(all)),
          z = detail::shuffle(from[2].v, from[2].v, detail::spread_by_three<W, 2>(all));
  [&]<int... R>(std::integer_sequence<int, R...>) __attribute__((always_inline)) {
    (
        [&]() __attribute__((always_inline)) {
          const V xy = detail::shuffle(x, y, detail::with_component<W, 1, R * W>(all));
          const V xyz = detail::shuffle(xy, z, detail::with_component<W, 2, R * W>(all));
          std::memcpy(to + R * W, &xyz, sizeof xyz);
        }(),
        ...);
  }
  (std::make_integer_sequence<int, 3>{});
}

#endif

/// Bytes of the widest vector register that the compiler may use here.
inline constexpr int vector_bytes =
#if defined(__CUDACC__)
    0;
#elif defined(__AVX512F__)
    64;
#elif defined(__AVX__)
    32;
#elif defined(__SSE2__) || defined(__ARM_NEON)
    16;
#else
    0;
#endif

/// As many lanes of T as one register holds; T itself where there is no vector register.
template <class T>
inline constexpr int native_width = vector_bytes / int(sizeof(T)) > 1 ? vector_bytes / int(sizeof(T)) : 1;

template <class T, int W>
struct lanes_or_scalar {
  using type = Lanes<T, W>;
};
template <class T>
struct lanes_or_scalar<T, 1> {
  using type = T;
};
template <class T, int W = native_width<T>>
using lanes = typename lanes_or_scalar<T, W>::type;

}  // namespace sinew

template <class T, int W>
struct Eigen::NumTraits<sinew::Lanes<T, W>> : Eigen::NumTraits<T> {
  using Real = sinew::Lanes<T, W>;
  using NonInteger = Real;
  using Nested = Real;
  using Literal = T;
  enum { RequireInitialization = 0 };
};
