// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/core/compiled.hpp>
#include <sinew/core/component.hpp>

#include <string_view>
#include <type_traits>
#include <vector>

namespace sinew {

// What engines share that are over any values: numbers, points, frames. They have the numbers of all values
// one after the other, and `size`, how many a value has. In scene files that is the number of what the first
// link leads to, or of the DataTypes that `template` names.

/// The field `size` of such an engine, whose other fields come first.
template <class E>
constexpr auto size_of_values() {
  return field("size", &E::size, "", "numbers of one value", range::closed(1, 64));
}

/// How many values a list has. Throws Error unless its numbers are whole values.
std::size_t count_values(std::string_view where, std::string_view list, std::vector<double> const& numbers,
                         int size);
/// The same, where the engine that is named is only known when it has to be: `where()` says it.
template <class Where>
requires std::is_invocable_v<Where const&>
std::size_t count_values(Where const& where, std::string_view list, std::vector<double> const& numbers,
                         int size) {
  return numbers.size() % std::size_t(size) == 0 ? numbers.size() / std::size_t(size)
                                                 : count_values(where(), list, numbers, size);
}

}  // namespace sinew

#if SINEW_DEFINES
namespace sinew {

SINEW_ONCE std::size_t count_values(std::string_view where, std::string_view list,
                                    std::vector<double> const& numbers, int size) {
  if (numbers.size() % std::size_t(size) != 0)
    throw Error(where,
                text(list,
                     " has ",
                     numbers.size(),
                     " numbers, which are no values of ",
                     size,
                     " each; give whole values, or another size"));
  return numbers.size() / std::size_t(size);
}

}  // namespace sinew
#endif
