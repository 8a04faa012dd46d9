// SPDX-License-Identifier: BSL-1.0
// Loads of numbers at places and lists of lanes, in registers and scalars, against loops.
#include "catch.hpp"

#include <sinew/core/lane_lists.hpp>

#include <algorithm>
#include <cstdint>
#include <numeric>
#include <vector>

namespace test_lane_lists {

using namespace sinew;

template <class T, int W>
void check() {
  using L = lanes<T, W>;
  std::vector<T> numbers(100);
  std::vector<FourOf<T>> fours(100);
  for (std::size_t i = 0; i < 100; ++i) {
    numbers[i] = T(i) / 7;
    for (int c = 0; c < 4; ++c) fours[i].of[c] = T(10 * i) + T(c);
  }
  CHECK(reinterpret_cast<std::uintptr_t>(fours.data()) % (4 * sizeof(T)) == 0);
  int places[std::size_t(W)];
  for (int l = 0; l < W; ++l) places[l] = (37 * l + 5) % 100;
  const L found = load_at<L>(numbers.data(), places);
  L four[4];
  load_at(fours.data(), places, four);
  T sum = 0;
  for (int l = 0; l < W; ++l) {
    CHECK(lane(found, l) == numbers[std::size_t(places[l])]);
    for (int c = 0; c < 4; ++c) CHECK(lane(four[c], l) == fours[std::size_t(places[l])].of[c]);
    sum += lane(found, l);
  }
  CHECK(sum_of_lanes(found) == sum);
  const T limit = T(sum / W);
  const unsigned bits = bits_of(found < L(limit));
  for (int l = 0; l < W; ++l) CHECK(bool(bits >> l & 1) == (lane(found, l) < limit));
}

// lists of lanes are of numbers of four bytes
template <int W>
void check_lists() {
  using Places = vector_like<lanes<float, W>, int>;
  std::vector<int> numbers(W);
  std::iota(numbers.begin(), numbers.end(), 40);
  for (unsigned k = 0; k < 50; ++k) {
    const unsigned bits = k * 2654435761u >> 7 & (~0u >> (32 - W));
    std::vector<int> expected, found(2 * std::size_t(W), -1);
    for (int l = 0; l < W; ++l)
      if (bits >> l & 1) expected.push_back(40 + l);
    write_lanes(load_from<Places>(numbers.data()), bits, found.data());
    CHECK(std::equal(expected.begin(), expected.end(), found.begin()));
    CHECK(found[std::size_t(W)] == -1);  // behind one vector nothing is written
  }
}

TEST_CASE("numbers at places, masks as bits and lists of lanes are those of loops") {
  check<double, 1>();
  check<float, 1>();
  check<double, native_width<double>>();
  check<float, native_width<float>>();
  check_lists<1>();
  check_lists<native_width<float>>();
}

}  // namespace test_lane_lists
