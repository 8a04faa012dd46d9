// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/core/component.hpp>

#include <string>

namespace sinew {

/// Throws Error where a spring, by its number in the list, ends at a point that the state does not have.
template <class D>
void check_spring_end(std::string const& where, std::size_t spring, InitContext<D> const& end, int point) {
  if (std::size_t(point) >= end.rest.size())
    throw Error(where,
                text("springs[",
                     spring,
                     "] refers to point ",
                     point,
                     " of ",
                     end.where,
                     ", which has ",
                     end.rest.size(),
                     " points, numbered from 0; correct the index"));
}

}  // namespace sinew
