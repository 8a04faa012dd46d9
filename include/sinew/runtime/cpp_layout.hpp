// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/runtime/cpp_text.hpp>

#include <array>
#include <string>
#include <string_view>
#include <vector>

// C++ text that is made by a program: literals that hold whatever a scene file said and nothing else, names,
// and line breaks.
namespace sinew::detail {

inline constexpr std::size_t lineWidth = 110;

/// The place after a string literal that starts at i.
inline std::size_t after_literal(std::string_view cpp, std::size_t i) {
  for (++i; i < cpp.size() && cpp[i] != '"'; ++i)
    if (cpp[i] == '\\') ++i;
  return std::min(i + 1, cpp.size());
}

// characters that a compiler or a reader would take for something else: controls, the second ? of a trigraph,
// and what changes the direction of writing (U+061C, U+200E.., U+202A.., U+2066..), which makes source lie
inline bool hidden_character(std::string_view text_, std::size_t i, std::size_t& bytes) {
  const auto c = static_cast<unsigned char>(text_[i]);
  bytes = 1;
  if (c < 0x20 || c == 0x7F || (c == '?' && i > 0 && text_[i - 1] == '?')) return true;
  const std::string_view three = text_.substr(i, 3), two = text_.substr(i, 2);
  if (two == "\xD8\x9C" || (c == 0xC2 && two.size() == 2 && static_cast<unsigned char>(two[1]) < 0xA0)) {
    bytes = 2;
    return true;
  }
  bytes = 3;
  return three.size() == 3 && c == 0xE2 &&
         ((three[1] == '\x80' &&
           (three[2] == '\x8E' || three[2] == '\x8F' || std::uint8_t(three[2]) >= 0xA8)) ||
          (three[1] == '\x81' && std::uint8_t(three[2]) >= 0xA6));
}

/// The same C++ with string literals that are safe to paste anywhere, and with numbers that keep their bits:
/// -0 is -0.0, and what no int holds is a double.
inline std::string safe_cpp(std::string_view cpp) {
  auto is = [](char c, std::string_view more) {
    return (c >= '0' && c <= '9') || (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_' ||
           more.find(c) != more.npos;
  };
  std::string safe;
  for (std::size_t i = 0; i < cpp.size();) {
    std::size_t end = i + 1;
    if (cpp[i] == '"') {
      end = after_literal(cpp, i);
      for (std::size_t k = i; k < end; ++k) {
        std::size_t bytes = 1;
        if (!hidden_character(cpp.substr(0, end), k, bytes)) {
          safe += cpp[k];
          continue;
        }
        for (; bytes > 0; --bytes, ++k) {
          const auto c = static_cast<unsigned char>(cpp[k]);
          safe += '\\';
          for (const int shift : {6, 3, 0}) safe += char('0' + ((c >> shift) & 7));
        }
        --k;
      }
    } else if (cpp[i] >= '0' && cpp[i] <= '9') {
      while (end < cpp.size() &&
             (is(cpp[end], ".") || ((cpp[end] == '-' || cpp[end] == '+') && cpp[end - 1] == 'e')))
        ++end;
      const std::string_view number = cpp.substr(i, end - i);
      safe += number;
      const bool whole = number.find_first_not_of("0123456789") == number.npos;
      if (whole && (number.size() > 10 || (number == "0" && i > 0 && cpp[i - 1] == '-'))) safe += ".0";
    } else if (is(cpp[i], "")) {
      while (end < cpp.size() && is(cpp[end], "")) ++end;
      safe += cpp.substr(i, end - i);
    } else {
      safe += cpp[i];
    }
    i = end;
  }
  return safe;
}
inline std::string cpp_literal(std::string_view content) { return safe_cpp(quoted_cpp(content)); }

/// "restPosition" for "rest_position", "linearSolver" for "linear solver"; empty where no letter is left.
inline std::string camel_case(std::string_view words) {
  std::string name;
  bool raise = false;
  for (char c : words) {
    const bool small = c >= 'a' && c <= 'z', big = c >= 'A' && c <= 'Z', digit = c >= '0' && c <= '9';
    if (!small && !big && !(digit && !name.empty())) {
      raise = !name.empty();
      continue;
    }
    if (name.empty() && big) c = char(c - 'A' + 'a');
    if (raise && small) c = char(c - 'a' + 'A');
    name += c;
    raise = false;
  }
  return name;
}

inline bool is_identifier(std::string_view name) {
  auto letter = [](char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z'); };
  if (name.empty() || !letter(name[0]) || name.find("__") != name.npos) return false;
  for (const char c : name)
    if (!letter(c) && !(c >= '0' && c <= '9') && c != '_') return false;
  return true;
}

/// Words that no variable of baked text is named by: those of C++, macros of common systems, and what the
/// text itself needs.
inline constexpr auto reservedNames = std::to_array<std::string_view>(
    {"alignas",   "alignof",  "and",       "and_eq",   "asm",      "atomic_cancel", "auto",       "bitand",
     "bitor",     "bool",     "break",     "case",     "catch",    "char",          "char8_t",    "char16_t",
     "char32_t",  "class",    "compl",     "concept",  "const",    "consteval",     "constexpr",  "constinit",
     "continue",  "co_await", "co_return", "co_yield", "decltype", "default",       "delete",     "do",
     "double",    "else",     "enum",      "explicit", "export",   "extern",        "false",      "float",
     "for",       "friend",   "goto",      "if",       "inline",   "int",           "long",       "mutable",
     "namespace", "new",      "noexcept",  "not",      "not_eq",   "nullptr",       "operator",   "or",
     "or_eq",     "private",  "protected", "public",   "register", "requires",      "return",     "short",
     "signed",    "sizeof",   "static",    "struct",   "switch",   "template",      "this",       "throw",
     "true",      "try",      "typedef",   "typeid",   "typename", "union",         "unsigned",   "using",
     "virtual",   "void",     "volatile",  "wchar_t",  "while",    "xor",           "xor_eq",     "final",
     "override",  "import",   "module",    "linux",    "unix",     "i386",          "errno",      "stdin",
     "stdout",    "stderr",   "assert",    "offsetof", "std",      "sinew",         "baked",      "hana",
     "boost",     "node",     "data",      "dt",       "main",     "Eigen",         "Simulation", "Between",
     "Vec",       "Parents",  "Mesh",      "NULL",     "EOF",      "INFINITY",      "NAN",        "list",
     "values"});

/// The parts between the commas of a list, brackets and literals respected.
inline std::vector<std::string_view> split_list(std::string_view cpp) {
  std::vector<std::string_view> parts;
  std::size_t start = 0, i = 0;
  int depth = 0;
  auto add = [&](std::size_t end) {
    while (start < end && cpp[start] == ' ') ++start;
    if (end > start) parts.push_back(cpp.substr(start, end - start));
    start = end + 1;
  };
  while (i < cpp.size()) {
    const char c = cpp[i];
    if (c == '"') {
      i = after_literal(cpp, i);
      continue;
    }
    if (c == '(' || c == '{' || c == '<' || c == '[') ++depth;
    if (c == ')' || c == '}' || c == '>' || c == ']') --depth;
    if (c == ',' && depth == 0) add(i);
    ++i;
  }
  add(cpp.size());
  return parts;
}

/// Where the brackets open that close at the end of a text; npos where it does not end in ) or }.
inline std::size_t last_group(std::string_view cpp) {
  if (!cpp.ends_with(')') && !cpp.ends_with('}')) return cpp.npos;
  std::size_t open = cpp.npos;
  int depth = 0;
  for (std::size_t i = 0; i < cpp.size();) {
    const char c = cpp[i];
    if (c == '"') {
      i = after_literal(cpp, i);
      continue;
    }
    if ((c == '(' || c == '{' || c == '<' || c == '[') && depth++ == 0) open = i;
    if (c == ')' || c == '}' || c == '>' || c == ']') --depth;
    ++i;
  }
  return open;
}

/// Breaks an expression into lines: arguments and designated members one a line, numbers as many as fit.
/// `indent`: of the line on which it starts; `used`: columns of that line before it; `tail`: what follows it.
inline std::string fit(std::string_view cpp, std::size_t indent, std::size_t used, std::size_t tail) {
  const std::size_t open = last_group(cpp);
  if (used + cpp.size() + tail <= lineWidth || open == cpp.npos) return std::string(cpp);
  const auto items = split_list(cpp.substr(open + 1, cpp.size() - open - 2));
  if (items.empty()) return std::string(cpp);
  std::string lines(cpp.substr(0, open + 1));
  if (items.size() == 1 && cpp[open] == '{' && last_group(items[0]) == 0)
    return text(lines, fit(items[0], indent, used + lines.size(), tail + 1), cpp.back());
  const std::string pad = text('\n', std::string(indent + 4, ' '));
  bool pack = cpp[open] == '{';
  for (auto item : items) pack = pack && item.size() <= 48 && !item.starts_with('.');
  std::size_t column = lineWidth;
  for (std::size_t i = 0; i < items.size(); ++i) {
    const std::size_t after = i + 1 == items.size() ? tail + 1 : 1;
    if (pack && column + 1 + items[i].size() + after <= lineWidth) {
      lines += text(' ', items[i]);
      column += items[i].size() + 1;
    } else {
      lines += pad;
      lines += fit(items[i], indent + 4, indent + 4, after);
      column = indent + 4 + items[i].size();
    }
    if (i + 1 < items.size()) lines += ',', ++column;
  }
  return lines + cpp.back();
}

}  // namespace sinew::detail
