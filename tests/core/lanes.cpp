// SPDX-License-Identifier: BSL-1.0
#include "catch.hpp"

#include <sinew/core/lanes.hpp>

namespace test_lanes {

using namespace sinew;

namespace {

template <class T, int W>
void check_lanes() {
  using L = Lanes<T, W>;
  L a(T(0)), b(T(0));
  for (int l = 0; l < W; ++l) {
    a.set(l, T(l + 1));
    b.set(l, T(2 * l) - T(3));
  }
  const L sum = a + b, difference = a - b, product = a * b, ratio = b / a, root = sqrt(a), size = abs(b);
  const L chosen = select(a < b, a, b), byBits = select(lanes_of_bits<L>(0xa5c3), a, b);
  for (int l = 0; l < W; ++l) {
    const T x = T(l + 1), y = T(2 * l) - T(3);
    CHECK(lane(sum, l) == x + y);
    CHECK(lane(difference, l) == x - y);
    CHECK(lane(product, l) == x * y);
    CHECK(lane(ratio, l) == y / x);
    CHECK(lane(root, l) == std::sqrt(x));
    CHECK(lane(size, l) == std::abs(y));
    CHECK(lane(chosen, l) == (x < y ? x : y));
    CHECK(lane(byBits, l) == ((0xa5c3u >> l & 1) != 0 ? x : y));
  }
  CHECK(any(a > L(T(W) - T(0.5))));
  CHECK_FALSE(any(a > L(T(W) + T(0.5))));

  // nine values in lanes become W short vectors of twelve
  L in[9];
  for (int c = 0; c < 9; ++c)
    for (int l = 0; l < W; ++l) in[c].set(l, T(100 * c + l));
  T out[W][12];
  transpose<9>(in, out);
  for (int l = 0; l < W; ++l)
    for (int c = 0; c < 12; ++c) CHECK(out[l][c] == (c < 9 ? T(100 * c + l) : T(0)));

  // points one behind the other, and their components
  T points[3 * W], back[3 * W];
  for (int i = 0; i < 3 * W; ++i) points[i] = T(i);
  L components[3];
  load3(points, components);
  for (int l = 0; l < W; ++l)
    for (int c = 0; c < 3; ++c) CHECK(lane(components[c], l) == T(3 * l + c));
  store3(components, back);
  for (int i = 0; i < 3 * W; ++i) CHECK(back[i] == T(i));
}

}  // namespace

TEST_CASE("lanes do in each lane what the scalar does") {
  check_lanes<double, 2>();
  check_lanes<float, 4>();
#if defined(__AVX512F__)
  check_lanes<double, 8>();
  check_lanes<float, 16>();
#endif
#if defined(__AVX__)
  check_lanes<double, 4>();
  check_lanes<float, 8>();
#endif
}

TEST_CASE("lanes are a scalar that Eigen accepts") {
  using L = lanes<double>;
  Eigen::Matrix<L, 3, 3> m;
  for (int i = 0; i < 9; ++i) m(i) = L(double(i * i % 7));
  const Eigen::Matrix<L, 3, 3> product = m * m.transpose();
  Eigen::Matrix3d scalar;
  for (int i = 0; i < 9; ++i) scalar(i) = i * i % 7;
  const Eigen::Matrix3d expected = scalar * scalar.transpose();
  for (int i = 0; i < 9; ++i) CHECK(lane(product(i), 0) == expected(i));
}

}  // namespace test_lanes
