// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/core/data_types.hpp>

#include <array>
#include <cstddef>
#include <cstring>
#include <optional>
#include <span>
#include <type_traits>
#include <vector>

namespace sinew {

// Values of fields as plain numbers, in the order in which scene files have them: what one component has made
// becomes the value of another one, whatever the types, with the bits that both can hold. Nothing is
// allocated beyond the capacity that lists have.

namespace detail {

template <class T>
inline constexpr bool is_list = false;
template <class T>
inline constexpr bool is_list<std::vector<T>> = true;
template <class T>
inline constexpr bool is_optional = false;
template <class T>
inline constexpr bool is_optional<std::optional<T>> = true;
template <class T>
inline constexpr std::size_t array_size = 0;
template <class T, std::size_t N>
inline constexpr std::size_t array_size<std::array<T, N>> = N;
template <class T>
concept HasFrame = requires(T frame) {
  frame.center;
  frame.orientation;
};

/// How many numbers any value of a type has; 0 where that depends on the value, or it has others.
template <class T>
constexpr std::size_t count_of_numbers() {
  if constexpr (std::is_arithmetic_v<T>)
    return 1;
  else if constexpr (array_size<T> > 0)
    return array_size<T> * count_of_numbers<typename T::value_type>();
  else if constexpr (HasFrame<T>)
    return count_of_numbers<decltype(T::center)>() +
           (requires(T t) { t.orientation.coeffs(); } ? 4 : std::size_t(1));
  else if constexpr (std::is_base_of_v<Eigen::MatrixBase<T>, T>)
    return T::SizeAtCompileTime > 0 ? std::size_t(T::SizeAtCompileTime) : 0;
  else
    return 0;
}

template <class T>
double* write_numbers(T const& value, double* to) {
  if constexpr (std::is_arithmetic_v<T>) {
    *to++ = double(value);
  } else if constexpr (array_size<T> > 0) {
    for (auto const& one : value) to = write_numbers(one, to);
  } else if constexpr (HasFrame<T>) {
    to = write_numbers(value.center, to);
    if constexpr (requires { value.orientation.coeffs(); })
      for (int i = 0; i < 4; ++i) *to++ = double(value.orientation.coeffs()[i]);
    else
      *to++ = double(value.orientation);
  } else {
    for (Eigen::Index i = 0; i < value.size(); ++i) *to++ = double(value(i / value.cols(), i % value.cols()));
  }
  return to;
}
template <class T>
double const* read_numbers(double const* from, T& value) {
  if constexpr (std::is_same_v<T, bool>) {
    value = *from++ != 0;
  } else if constexpr (std::is_arithmetic_v<T>) {
    value = T(*from++);
  } else if constexpr (array_size<T> > 0) {
    for (auto& one : value) from = read_numbers(from, one);
  } else if constexpr (HasFrame<T>) {
    from = read_numbers(from, value.center);
    if constexpr (requires { value.orientation.coeffs(); })
      for (int i = 0; i < 4; ++i)
        value.orientation.coeffs()[i] = std::decay_t<decltype(value.orientation.x())>(*from++);
    else
      from = read_numbers(from, value.orientation);
  } else {
    for (Eigen::Index i = 0; i < value.size(); ++i)
      value(i / value.cols(), i % value.cols()) = typename T::Scalar(*from++);
  }
  return from;
}

}  // namespace detail

/// A value that is numbers: one or a fixed count of them, a list of such, or such a one that may be missing.
template <class T>
concept OfNumbers =
    detail::count_of_numbers<T>() > 0 ||
    ((detail::is_list<T> || detail::is_optional<T>)&&detail::count_of_numbers<typename std::conditional_t<
         detail::is_list<T> || detail::is_optional<T>, T, std::array<int, 1>>::value_type>() > 0);

namespace detail {
template <class T>
inline constexpr bool is_list_of_lists = false;
template <class T>
inline constexpr bool is_list_of_lists<std::vector<T>> = is_list<T> && OfNumbers<T>;
}  // namespace detail

/// The numbers of a value.
template <OfNumbers T>
void to_numbers(T const& value, std::vector<double>& numbers) {
  if constexpr (std::is_same_v<T, std::vector<bool>>) {
    numbers.assign(value.begin(), value.end());
  } else if constexpr (detail::is_list<T>) {
    numbers.resize(value.size() * detail::count_of_numbers<typename T::value_type>());
    double* to = numbers.data();
    for (auto const& one : value) to = detail::write_numbers(one, to);
  } else if constexpr (detail::is_optional<T>) {
    numbers.resize(value ? detail::count_of_numbers<typename T::value_type>() : 0);
    if (value) detail::write_numbers(*value, numbers.data());
  } else {
    numbers.resize(detail::count_of_numbers<T>());
    detail::write_numbers(value, numbers.data());
  }
}

/// The value with these numbers. False, and the value stays, where they are not as many as it can have.
template <OfNumbers T>
bool from_numbers(std::span<double const> numbers, T& value) {
  if constexpr (std::is_same_v<T, std::vector<bool>>) {
    value.resize(numbers.size());
    for (std::size_t i = 0; i < numbers.size(); ++i) value[i] = numbers[i] != 0;
  } else if constexpr (detail::is_list<T>) {
    constexpr std::size_t each = detail::count_of_numbers<typename T::value_type>();
    if (numbers.size() % each != 0) return false;
    value.resize(numbers.size() / each);
    double const* from = numbers.data();
    for (auto& one : value) from = detail::read_numbers(from, one);
  } else if constexpr (detail::is_optional<T>) {
    constexpr std::size_t each = detail::count_of_numbers<typename T::value_type>();
    if (!numbers.empty() && numbers.size() != each) return false;
    value.reset();
    if (!numbers.empty()) detail::read_numbers(numbers.data(), value.emplace());
  } else {
    if (numbers.size() != detail::count_of_numbers<T>()) return false;
    detail::read_numbers(numbers.data(), value);
  }
  return true;
}

/// Ways to the numbers of a value that is known by its address; of a list of lists, to those of one of them.
/// Null for values that are no numbers.
struct NumberAccess {
  void (*get)(void const* value, int list, std::vector<double>& numbers) = nullptr;
  bool (*set)(void* value, int list, std::span<double const> numbers) = nullptr;
};
template <class T>
constexpr NumberAccess number_access() {
  if constexpr (OfNumbers<T>)
    return {[](void const* value, int, std::vector<double>& numbers) {
              to_numbers(*static_cast<T const*>(value), numbers);
            },
            [](void* value, int, std::span<double const> numbers) {
              return from_numbers(numbers, *static_cast<T*>(value));
            }};
  else if constexpr (detail::is_list_of_lists<T>)
    return {[](void const* value, int list, std::vector<double>& numbers) {
              auto const& all = *static_cast<T const*>(value);
              numbers.clear();
              if (list >= 0 && std::size_t(list) < all.size()) to_numbers(all[std::size_t(list)], numbers);
            },
            [](void* value, int list, std::span<double const> numbers) {
              auto& all = *static_cast<T*>(value);
              if (list < 0) return false;
              if (all.size() <= std::size_t(list)) all.resize(std::size_t(list) + 1);
              return from_numbers(numbers, all[std::size_t(list)]);
            }};
  else
    return {};
}

/// Whether two lists of numbers have the same bits.
inline bool same_bits(std::vector<double> const& a, std::vector<double> const& b) {
  return a.size() == b.size() &&
         (a.empty() || std::memcmp(a.data(), b.data(), a.size() * sizeof(double)) == 0);
}

}  // namespace sinew
