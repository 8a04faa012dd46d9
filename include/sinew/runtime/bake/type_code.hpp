// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/runtime/class_table.hpp>
#include <sinew/runtime/cpp_layout.hpp>

#include <string>
#include <tuple>
#include <type_traits>
#include <typeinfo>

namespace sinew {

namespace detail {

/// What C++ text needs of the type of a field.
struct TypeCode {
  std::type_info const* type = nullptr;
  std::type_info const* held = nullptr;  // of what an optional holds; else the same
  bool optional = false;
  // of a list: "Vec<double, 3>", and the array of constants that it is made from: "double values[][3]"
  std::string element{}, array{};
  bool copied = false;  // the constants are the elements
};

/// A type as C++ text names it that is `using namespace sinew`: "std::vector<Vec<double, 3>>".
template <class T>
std::string cpp_type() {
  auto unqualified = [](std::string_view spelled) {
    std::string name(spelled);
    for (std::size_t at = 0; (at = name.find("sinew::", at)) != name.npos;) name.erase(at, 7);
    for (std::size_t at = 0; (at = name.find("> >", at)) != name.npos;) name.erase(at + 1, 1);
    return name;
  };
  if constexpr (std::is_same_v<T, std::string>)
    return "std::string";
  else if constexpr (requires(T value) { value.has_value(); })
    return text("std::optional<", cpp_type<typename T::value_type>(), '>');
  else if constexpr (is_eigen<T>)
    return T::ColsAtCompileTime == 1
               ? text("Vec<", cpp_type<typename T::Scalar>(), ", ", int(T::RowsAtCompileTime), '>')
               : text("Mat<",
                      cpp_type<typename T::Scalar>(),
                      ", ",
                      int(T::RowsAtCompileTime),
                      ", ",
                      int(T::ColsAtCompileTime),
                      '>');
  else if constexpr (DynamicList<T>)
    return text("std::vector<", cpp_type<typename T::value_type>(), '>');
  else if constexpr (requires { std::tuple_size<T>::value; } && !HasFields<T>)
    return text("std::array<", cpp_type<typename T::value_type>(), ", ", std::tuple_size_v<T>, '>');
  else
    return unqualified(type_name<T>());
}

template <class T>
TypeCode const& type_code() {
  static const TypeCode code = [] {
    TypeCode made{.type = &typeid(T), .held = &typeid(T)};
    if constexpr (requires(T value) { value.has_value(); }) {
      made.optional = true;
      made.held = &typeid(typename T::value_type);
    }
    auto number = []<class S>(std::type_identity<S>) -> std::string_view {
      return std::is_same_v<S, bool>  ? "bool"
             : std::is_same_v<S, int> ? "int"
             : sizeof(S) == 8         ? "double"
                                      : "float";
    };
    if constexpr (DynamicList<T>) {
      using E = typename T::value_type;
      if constexpr (std::is_arithmetic_v<E>) {
        made = {made.type, made.held, false, std::string(number(std::type_identity<E>{})), "", true};
      } else if constexpr (is_eigen<E>) {
        constexpr int n = E::SizeAtCompileTime;
        const std::string_view real = number(std::type_identity<typename E::Scalar>{});
        if (E::ColsAtCompileTime == 1 && n > 1)
          made = {made.type,
                  made.held,
                  false,
                  text("Vec<", real, ", ", n, '>'),
                  text(real, " values[][", n, ']'),
                  false};
      } else if constexpr (requires { std::tuple_size<E>::value; } && !HasFields<E>) {
        const std::string_view one = number(std::type_identity<typename E::value_type>{});
        made = {
            made.type, made.held, false, text("std::array<", one, ", ", std::tuple_size_v<E>, '>'), "", true};
      } else {
        made.element = std::string(type_name<E>());
      }
      if (made.copied) made.array = text(made.element, " values[]");
    }
    return made;
  }();
  return code;
}

/// A function that returns a list. Numbers stand in constant arrays, which compile fast however long they
/// are.
inline std::string list_function(TypeCode const& type, std::string const& all, std::string const& name) {
  std::string lines = text("inline auto ", name, "() {\n");
  auto statement = [&](std::string const& cpp) { lines += text("  ", fit(cpp, 2, 2, 1), ";\n"); };
  const std::string vector = text("std::vector<", type.element, '>');
  if (type.array.empty()) {
    statement(text("return ", vector, all));
  } else {
    statement(text("static constexpr ", type.array, " = ", all));
    if (type.copied) {
      statement(text("return ", vector, "(std::begin(values), std::end(values))"));
    } else {
      statement(text(vector, " list"));
      statement(text("for (auto const& v : values) list.push_back(Eigen::Map<", type.element, " const>(v))"));
      statement("return list");
    }
  }
  return lines + "}\n";
}

/// The C++ of a value as FieldInfo gives it, to initialise a member with.
inline std::string initialiser(TypeCode const& type, std::string const& cpp) {
  // an optional takes what it holds as one argument
  const bool wrap = type.optional && cpp.starts_with('{') && cpp != "{}";
  return safe_cpp(wrap ? text('{', cpp, '}') : cpp);
}

}  // namespace detail

}  // namespace sinew
