// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/io/output_file.hpp>

#include <cmath>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

namespace cli {

/// A JSON object (RFC 8259), built member by member. Numbers that are not finite become null.
class Json {
 public:
  template <class T>
  Json& set(std::string_view name, T const& value) {
    text_ += text_.size() > 1 ? ", " : "";
    addText(name);
    text_ += ": ";
    add(value);
    return *this;
  }
  std::string text() const { return text_ + '}'; }

 private:
  std::string text_ = "{";

  template <class T>
  void add(T const& value) {
    if constexpr (std::is_same_v<T, bool>) {
      text_ += value ? "true" : "false";
    } else if constexpr (std::is_floating_point_v<T>) {
      if (std::isfinite(value))
        sinew::io::append_number(text_, value);
      else
        text_ += "null";
    } else if constexpr (std::is_integral_v<T>) {
      text_ += std::to_string(value);
    } else if constexpr (std::is_same_v<T, Json>) {
      text_ += value.text();
    } else if constexpr (std::is_convertible_v<T, std::string_view>) {
      addText(value);
    } else {
      text_ += '[';
      for (std::size_t i = 0; i < value.size(); ++i) {
        if (i > 0) text_ += ", ";
        add(value[i]);
      }
      text_ += ']';
    }
  }
  void addText(std::string_view words) {
    text_ += '"';
    for (const char c : words) {
      if (c == '"' || c == '\\') text_ += '\\';
      if (static_cast<unsigned char>(c) < ' ') {
        constexpr char const* hex = "0123456789abcdef";
        text_ += "\\u00";
        text_ += hex[c / 16];
        text_ += hex[c % 16];
      } else {
        text_ += c;
      }
    }
    text_ += '"';
  }
};

}  // namespace cli
