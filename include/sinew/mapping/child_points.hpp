// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/core/error.hpp>

#include <cstddef>
#include <string>
#include <string_view>

namespace sinew {

/// Makes room in the child of a mapping, which has no point, or one for each of `count` things; `things`
/// names them. Throws Error where it has another number.
template <class Positions>
void place_child(Positions& child, std::size_t count, std::string const& where, std::string_view things) {
  if (child.empty()) child.resize(count);
  if (child.size() != count)
    throw Error(where,
                text("the child has ",
                     child.size(),
                     " points for ",
                     count,
                     ' ',
                     things,
                     "; give the child as many, or none"));
}

}  // namespace sinew
