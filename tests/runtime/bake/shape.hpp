// SPDX-License-Identifier: BSL-1.0
#pragma once

#include "catch.hpp"

#include <sinew/runtime/cpp_layout.hpp>

#include <string>

/// Brackets close in order, literals end on their line, no line is wider than the style allows.
inline void check_shape(std::string const& cpp) {
  std::string open;
  std::size_t column = 0;
  for (std::size_t i = 0; i < cpp.size(); ++i) {
    const char c = cpp[i];
    column = c == '\n' ? 0 : column + 1;
    CHECK(column <= 110);
    if (c == '/' && cpp.substr(i, 2) == "//") {
      const std::size_t end = cpp.find('\n', i);
      REQUIRE(end != cpp.npos);
      CHECK(cpp[end - 1] != '\\');
      CHECK(end - i + column - 1 <= 110);
      i = end;
      column = 0;
    } else if (c == '"') {
      const std::size_t end = sinew::detail::after_literal(cpp, i);
      REQUIRE(cpp[end - 1] == '"');
      for (const char inside : cpp.substr(i, end - i)) CHECK(std::uint8_t(inside) >= 0x20);
      column += end - i - 1;
      i = end - 1;
    } else if (c == '(' || c == '{') {
      open += c;
    } else if (c == ')' || c == '}') {
      REQUIRE_FALSE(open.empty());
      CHECK(open.back() == (c == ')' ? '(' : '{'));
      open.pop_back();
    }
    CHECK((c == '\n' || (c >= ' ' && c <= '~') || c == '"'));
  }
  CHECK(open.empty());
}
