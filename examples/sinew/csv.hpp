// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <algorithm>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace cli {

/// A field of a table (CSV, RFC 4180): in quotes where it has what separates fields and lines.
inline std::string csv_field(std::string_view word) {
  if (word.find_first_of(",\"\n\r") == word.npos) return std::string(word);
  std::string quoted = "\"";
  for (const char c : word) {
    if (c == '"') quoted += '"';
    quoted += c;
  }
  return quoted + '"';
}

/// The fields of a line, without quotes; nothing where a quote is not closed, or something stands behind one.
inline std::optional<std::vector<std::string>> csv_fields(std::string_view line) {
  std::vector<std::string> fields;
  for (std::size_t i = 0;; ++i) {
    std::string& field = fields.emplace_back();
    if (i < line.size() && line[i] == '"') {
      for (++i;; ++i) {
        if (i >= line.size()) return {};
        if (line[i] == '"' && (++i >= line.size() || line[i] != '"')) break;
        field += line[i];
      }
    } else {
      const std::size_t end = std::min(line.find(',', i), line.size());
      field = line.substr(i, end - i);
      i = end;
    }
    if (i >= line.size()) return fields;
    if (line[i] != ',') return {};
  }
}

/// The next line of a text, which it loses with what ends it, "\n" or "\r\n".
inline std::string_view next_line(std::string_view& text) {
  const std::size_t end = std::min(text.find('\n'), text.size());
  std::string_view line = text.substr(0, end);
  text.remove_prefix(std::min(end + 1, text.size()));
  if (line.ends_with('\r')) line.remove_suffix(1);
  return line;
}

}  // namespace cli
