// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/runtime/value_text.hpp>

#include <string>
#include <string_view>
#include <type_traits>

namespace sinew {

namespace detail {

/// "sinew::RotationMethod", as the compiler spells it; "long", which not all spell so.
template <class T>
constexpr std::string_view type_name() {
  if constexpr (std::is_same_v<T, long>) return "long";
  std::string_view whole = __PRETTY_FUNCTION__;
  const std::size_t start = whole.find("T = ") + 4;
  return whole.substr(start, whole.find_first_of(";]", start) - start);
}

inline std::string quoted_cpp(std::string_view text_) {
  std::string literal = "\"";
  for (const char c : text_) {
    if (c == '"' || c == '\\') literal += '\\';
    if (c == '\n')
      literal += "\\n";
    else
      literal += c;
  }
  return literal + '"';
}

template <class List, class F>
std::string joined(List const& list, F&& each) {
  std::string all = "{";
  for (auto const& one : list) {
    if (all.size() > 1) all += ", ";
    all += each(one);
  }
  return all + '}';
}

}  // namespace detail

/// C++ that initialises a field with this very value, bit by bit: "{{0, 0, 0}, {0.1, 0, 0}}".
template <class T>
std::string cpp_value(T const& value) {
  auto each = [](auto const& one) { return cpp_value(one); };
  if constexpr (std::is_same_v<T, bool>) {
    return value ? "true" : "false";
  } else if constexpr (std::is_enum_v<T>) {
    std::string_view type = detail::type_name<T>();
    if (type.starts_with("sinew::")) type.remove_prefix(7);
    return text(type, "::", enum_names(T{})[std::size_t(value)]);
  } else if constexpr (std::is_same_v<T, float>) {
    std::string number = write_value(value);
    return text(number, number.find_first_of(".e") == number.npos ? ".f" : "f");
  } else if constexpr (std::is_arithmetic_v<T>) {
    return write_value(value);
  } else if constexpr (std::is_same_v<T, std::string>) {
    return detail::quoted_cpp(value);
  } else if constexpr (std::is_same_v<T, DataFile>) {
    return text('{', detail::quoted_cpp(value.path), '}');
  } else if constexpr (requires { value.has_value(); }) {
    return value ? cpp_value(*value) : "{}";
  } else if constexpr (requires { value.inertia; }) {
    return text('{', cpp_value(value.mass), ", ", cpp_value(value.inertia), '}');
  } else if constexpr (HasFields<T>) {
    std::string parts;
    for_each_field(value, [&](auto const& fd, auto const& part) {
      if constexpr (requires { part.has_value(); })
        if (!part) return;
      parts += text(parts.empty() ? "" : ", ", '.', fd.name, " = ", cpp_value(part));
    });
    return text('{', parts, '}');
  } else if constexpr (requires {
                         value.center;
                         value.orientation;
                       }) {
    std::string orientation;
    if constexpr (requires { value.orientation.coeffs(); }) {
      auto const& q = value.orientation;
      orientation = text(
          '{', cpp_value(q.w()), ", ", cpp_value(q.x()), ", ", cpp_value(q.y()), ", ", cpp_value(q.z()), '}');
    } else {
      orientation = cpp_value(value.orientation);
    }
    return text("{.center = ", cpp_value(value.center), ", .orientation = ", orientation, '}');
  } else if constexpr (detail::is_eigen<T>) {
    if constexpr (T::ColsAtCompileTime == 1 && T::SizeAtCompileTime > 1) {
      std::string all;
      for (auto const& one : value) all += text(all.empty() ? "" : ", ", cpp_value(one));
      return text('{', all, '}');
    } else {
      // these constructors are explicit
      std::string rows;
      for (Eigen::Index i = 0; i < value.rows(); ++i) {
        std::string row;
        for (Eigen::Index j = 0; j < value.cols(); ++j) row += text(j ? ", " : "", cpp_value(value(i, j)));
        rows += T::SizeAtCompileTime == 1 ? row : text(i ? ", {" : "{", row, '}');
      }
      return text("Eigen::Matrix<",
                  sizeof(typename T::Scalar) == 8 ? "double" : "float",
                  ", ",
                  int(value.rows()),
                  ", ",
                  int(value.cols()),
                  '>',
                  T::SizeAtCompileTime == 1 ? "(" : "{",
                  rows,
                  T::SizeAtCompileTime == 1 ? ")" : "}");
    }
  } else if constexpr (std::is_same_v<T, std::vector<bool>>) {
    return detail::joined(value, [](bool one) { return one ? "true" : "false"; });
  } else {
    return detail::joined(value, each);
  }
}

}  // namespace sinew
