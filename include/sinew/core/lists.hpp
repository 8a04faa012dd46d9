// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/core/compiled.hpp>

#include <cstddef>
#include <span>
#include <string_view>
#include <type_traits>

namespace sinew {

// Lists in fields: numbers of things that are somewhere else, and values for things of which there are many.

/// Throws Error unless the numbers in a list are of things of which `owner` has `count`.
void check_numbers(std::string_view where, std::string_view list, std::span<int const> numbers,
                   std::size_t count, std::string_view things, std::string_view owner);
/// The same for points of a state.
inline void check_points(std::string_view where, std::string_view list, std::span<int const> numbers,
                         std::size_t count) {
  check_numbers(where, list, numbers, count, "points", "the state");
}

/// The same, where the component that is named is only known when it has to be: `where()` says it.
template <class Where>
requires std::is_invocable_v<Where const&>
void check_numbers(Where const& where, std::string_view list, std::span<int const> numbers, std::size_t count,
                   std::string_view things, std::string_view owner) {
  for (const int i : numbers)
    if (i < 0 || std::size_t(i) >= count) check_numbers(where(), list, numbers, count, things, owner);
}
template <class Where>
requires std::is_invocable_v<Where const&>
void check_points(Where const& where, std::string_view list, std::span<int const> numbers,
                  std::size_t count) {
  check_numbers(where, list, numbers, count, "points", "the state");
}

/// Throws Error unless a list has one value for all things, or one for each.
void check_one_or_each(std::string_view where, std::string_view list, std::size_t size, std::size_t count,
                       std::string_view things, std::string_view one = "one value");
/// What such a list has for the ith.
template <class List>
decltype(auto) one_or_each(List const& list, std::size_t i) {
  return list[list.size() == 1 ? 0 : i];
}

}  // namespace sinew

#if SINEW_DEFINES
#include <sinew/core/error.hpp>

namespace sinew {

SINEW_ONCE void check_numbers(std::string_view where, std::string_view list, std::span<int const> numbers,
                              std::size_t count, std::string_view things, std::string_view owner) {
  for (const int i : numbers)
    if (i < 0 || std::size_t(i) >= count)
      throw Error(where,
                  text(list,
                       " has ",
                       i,
                       ", but ",
                       owner,
                       " has ",
                       count,
                       ' ',
                       things,
                       ", numbered from 0; correct the index"));
}

SINEW_ONCE void check_one_or_each(std::string_view where, std::string_view list, std::size_t size,
                                  std::size_t count, std::string_view things, std::string_view one) {
  if (size != 1 && size != count)
    throw Error(
        where,
        text(list, " has ", size, " values for ", count, ' ', things, "; give ", one, ", or one for each"));
}

}  // namespace sinew
#endif
