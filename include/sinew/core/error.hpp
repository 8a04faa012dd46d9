// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/core/compiled.hpp>
#include <sinew/core/platform.hpp>

#include <algorithm>
#include <charconv>
#include <concepts>
#include <cstddef>
#include <initializer_list>
#include <optional>
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

/// A message in which what is first called `name` is called `label`, which begins with that.
std::string with_label(std::string message, std::string_view name, std::string_view label);

/// Number of letters to insert, remove, replace or exchange with the next that turns `a` into `b` (Damerau
/// 1964), letter case ignored.
std::size_t edit_distance(std::string_view a, std::string_view b);

/// How far a misspelt word is from a known name: edits of the words that they do not share at their ends, as
/// in Triangle|Fem and TriangleFEM. None where these are another word: what was meant is another thing then.
std::optional<std::size_t> misspelt_by(std::string_view word, std::string_view name);

/// The known name nearest to a misspelt one; empty when none is near.
template <class Names>
std::string nearest_name(std::string_view word, Names const& known) {
  std::string best;
  std::optional<std::size_t> minimum;
  for (std::string_view name : known)
    if (const auto d = misspelt_by(word, name); d && (!minimum || *d < *minimum)) minimum = d, best = name;
  return best;
}

}  // namespace sinew

#if SINEW_DEFINES
#include <numeric>
#include <utility>
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

SINEW_ONCE std::string with_label(std::string message, std::string_view name, std::string_view label) {
  const std::size_t at = message.find(name);
  if (at != message.npos && name != label) message.replace(at, name.size(), label);
  return message;
}

SINEW_ONCE std::size_t edit_distance(std::string_view a, std::string_view b) {
  auto lower = [](char c) { return c >= 'A' && c <= 'Z' ? char(c - 'A' + 'a') : c; };
  auto same = [&](std::size_t i, std::size_t j) { return lower(a[i]) == lower(b[j]); };
  // of the first i letters of a and the first 0, 1, ... of b
  std::vector<std::size_t> before, last, row(b.size() + 1);
  std::iota(row.begin(), row.end(), std::size_t{0});
  for (std::size_t i = 0; i < a.size(); ++i) {
    before = std::exchange(last, row);
    row[0] = i + 1;
    for (std::size_t j = 0; j < b.size(); ++j) {
      row[j + 1] = std::min({last[j] + !same(i, j), row[j] + 1, last[j + 1] + 1});
      if (i > 0 && j > 0 && same(i, j - 1) && same(i - 1, j))
        row[j + 1] = std::min(row[j + 1], before[j - 1] + 1);
    }
  }
  return row.back();
}

SINEW_ONCE std::optional<std::size_t> misspelt_by(std::string_view word, std::string_view name) {
  const std::size_t all = word.size();
  auto capital = [](char c) { return c >= 'A' && c <= 'Z'; };
  auto begins = [&](std::string_view w,
                    std::size_t at) {  // a word, at its ends and at Capitals: FEM|Force|Field
    return at == 0 || at >= w.size() ||
           (capital(w[at]) && (!capital(w[at - 1]) || (at + 1 < w.size() && !capital(w[at + 1]))));
  };
  std::size_t same = 0, shared = 0;
  while (same < std::min(word.size(), name.size()) && word[same] == name[same])
    if (++same, begins(word, same) && begins(name, same)) shared = same;
  word.remove_prefix(shared), name.remove_prefix(shared);
  same = shared = 0;
  while (same < std::min(word.size(), name.size()) &&
         word[word.size() - same - 1] == name[name.size() - same - 1])
    if (++same, begins(word, word.size() - same) && begins(name, name.size() - same)) shared = same;
  word.remove_suffix(shared), name.remove_suffix(shared);
  if (word.empty() && name.size() <= all) return name.size();  // the start, or the end, of a name
  const std::size_t edits = edit_distance(word, name);
  if (edits > std::max<std::size_t>(1, std::max(word.size(), name.size()) / 3)) return {};
  return edits;
}

}  // namespace sinew
#endif
