// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/core/platform.hpp>
#include <sinew/core/compiled.hpp>

#include <algorithm>
#include <charconv>
#include <concepts>
#include <cstddef>
#include <initializer_list>
#include <stdexcept>
#include <string>
#include <string_view>

namespace sinew {

/// Every failure that Sinew reports. what() reads "<where>: <what is wrong>; <what to do>".
struct Error : std::runtime_error {
  Error(std::string_view where, std::string_view message)
      : std::runtime_error(where.empty() ? std::string(message)
                                         : std::string(where) + ": " + std::string(message)) {}
};

namespace detail {

/// A word, number or character of a message, as text.
struct TextPart {
  char number[40];
  std::size_t size;
  char const* word = nullptr;  // null: the number

  TextPart(std::string_view w) : size(w.size()), word(w.data()) {}
  TextPart(std::string const& w) : TextPart(std::string_view(w)) {}
  TextPart(char const* w) : TextPart(std::string_view(w)) {}
  TextPart(char c) : size(1) { number[0] = c; }
  template <std::integral T>
  TextPart(T value) : size(std::size_t(std::to_chars(number, number + sizeof number, +value).ptr - number)) {}
  TextPart(float value) : TextPart(double(value)) {}
  TextPart(double value) : size(std::size_t(__builtin_snprintf(number, sizeof number, "%.9g", value))) {}
};

std::string joined(std::initializer_list<TextPart> parts);

}  // namespace detail

/// Joins words, numbers and characters into one message.
template <class... Parts>
std::string text(Parts const&... parts) {
  return detail::joined({detail::TextPart(parts)...});
}

/// Number of single-letter edits that turn `a` into `b` (Levenshtein 1966), letter case ignored.
std::size_t edit_distance(std::string_view a, std::string_view b);

/// The known name nearest to a misspelt one; empty when none is near.
template <class Names>
std::string nearest_name(std::string_view word, Names const& known) {
  std::string best;
  std::size_t distance = std::max<std::size_t>(2, word.size() / 3) + 1;
  for (std::string_view name : known)
    if (const std::size_t d = edit_distance(word, name); d < distance) distance = d, best = name;
  return best;
}

}  // namespace sinew

#if SINEW_DEFINES
#include <numeric>
#include <vector>

namespace sinew::detail {

SINEW_ONCE std::string joined(std::initializer_list<TextPart> parts) {
  std::string all;
  for (TextPart const& part : parts)
    all.append(part.size == 0 ? "" : part.word ? part.word : part.number, part.size);
  return all;
}

}  // namespace sinew::detail

namespace sinew {

SINEW_ONCE std::size_t edit_distance(std::string_view a, std::string_view b) {
  auto lower = [](char c) { return c >= 'A' && c <= 'Z' ? char(c - 'A' + 'a') : c; };
  std::vector<std::size_t> row(b.size() + 1);
  std::iota(row.begin(), row.end(), std::size_t{0});
  for (std::size_t i = 0; i < a.size(); ++i) {
    std::size_t diagonal = row[0];
    row[0] = i + 1;
    for (std::size_t j = 0; j < b.size(); ++j) {
      const std::size_t replace = diagonal + (lower(a[i]) != lower(b[j]));
      diagonal = row[j + 1];
      row[j + 1] = std::min({row[j] + 1, row[j + 1] + 1, replace});
    }
  }
  return row.back();
}

}  // namespace sinew
#endif
