// SPDX-License-Identifier: BSL-1.0
#pragma once

// What the standard library of emscripten 3.1 (libc++ 14) lacks of C++20; later ones have it, and then this
// header is empty. platform.hpp includes it for emscripten only.
#include <algorithm>
#include <array>
#include <bit>
#include <cerrno>
#include <charconv>
#include <compare>
#include <cstdio>
#include <cstdlib>
#include <limits>
#include <string>
#include <system_error>
#include <type_traits>
#include <version>

namespace std {

#if !defined(__cpp_lib_bit_cast)
template <class To, class From>
requires(sizeof(To) == sizeof(From) && is_trivially_copyable_v<To> && is_trivially_copyable_v<From>)
constexpr To bit_cast(From const& from) noexcept {
  return __builtin_bit_cast(To, from);
}
#endif

#if !defined(__cpp_lib_three_way_comparison) || __cpp_lib_three_way_comparison < 201907L
template <class T, size_t n>
constexpr auto operator<=>(array<T, n> const& a, array<T, n> const& b) -> decltype(a[0] <=> b[0]) {
  for (size_t i = 0; i < n; ++i)
    if (const auto order = a[i] <=> b[i]; order != 0) return order;
  return decltype(a[0] <=> b[0])::equivalent;
}
#endif

#if !defined(__cpp_lib_to_chars)
/// By strtod, which knows no other locale here, for what from_chars takes: no blanks, plus or hexadecimal
/// digits.
template <class T>
requires is_floating_point_v<T>
from_chars_result from_chars(char const* first, char const* last, T& value) {
  char const* end = first;
  auto digits = [&] {
    char const* const begin = end;
    while (end != last && *end >= '0' && *end <= '9') ++end;
    return end != begin;
  };
  if (end != last && *end == '-') ++end;
  auto is_word = [&](char const* word) {
    char const* at = end;
    for (; *word; ++word, ++at)
      if (at == last || (*at | ' ') != *word) return false;
    end = at;
    return true;
  };
  if (!is_word("infinity") && !is_word("inf") && !is_word("nan")) {
    bool number = digits();
    if (end != last && *end == '.') {
      char const* const point = end++;
      const bool fraction = digits();
      if (!number && !fraction) end = point;
      number = number || fraction;
    }
    if (!number) return {first, errc::invalid_argument};
    if (end != last && (*end | ' ') == 'e') {
      char const* const exponent = end++;
      if (end != last && (*end == '-' || *end == '+')) ++end;
      if (!digits()) end = exponent;
    }
  }
  const string text(first, end);
  errno = 0;
  T read;
  if constexpr (is_same_v<T, float>)
    read = strtof(text.c_str(), nullptr);
  else
    read = T(strtod(text.c_str(), nullptr));
  // numbers that have fewer digits since they are small are numbers
  if (errno == ERANGE && (read == 0 || read - read != 0)) return {end, errc::result_out_of_range};
  value = read;
  return {end, errc{}};
}

/// The fewest digits that read back as the same number, without an exponent where that is no longer.
template <class T>
requires is_floating_point_v<T>
to_chars_result to_chars(char* first, char* last, T value) {
  char text[64];
  int size = 0;
  for (int digits = 1; digits <= numeric_limits<T>::max_digits10; ++digits) {
    size = snprintf(text, sizeof text, "%.*e", digits - 1, double(value));
    T back;
    if (from_chars(text, text + size, back).ec == errc{} && back == value) break;
  }
  char* const e = find(text, text + size, 'e');
  if (e != text + size) {
    string number;  // its digits
    for (char const* c = text; c != e; ++c)
      if (*c >= '0' && *c <= '9') number += *c;
    const int point = 1 + atoi(e + 1), count = int(number.size());  // digits before the point
    string fixed(text[0] == '-' ? 1 : 0, '-');
    if (point >= count) {  // with all its digits
      char whole[400];
      fixed.assign(whole, size_t(snprintf(whole, sizeof whole, "%.0f", double(value))));
    } else if (point > 0) {
      fixed += number.substr(0, size_t(point)) + '.' + number.substr(size_t(point));
    } else {
      fixed += "0." + string(size_t(-point), '0') + number;
    }
    if (fixed.size() <= size_t(size)) {
      copy(fixed.begin(), fixed.end(), text);
      size = int(fixed.size());
    }
  }
  if (last - first < size) return {last, errc::value_too_large};
  return {copy(text, text + size, first), errc{}};
}
#endif

}  // namespace std
