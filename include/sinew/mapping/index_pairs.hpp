// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/core/context.hpp>
#include <sinew/core/error.hpp>

#include <array>
#include <string>
#include <vector>

namespace sinew {

/// Points of several parents: of each the number of its parent, and its own there. Throws Error where there
/// is no such parent or point.
template <class In>
void check_index_pairs(std::string const& where, std::vector<std::array<int, 2>> const& indexPairs,
                       std::vector<InitContext<In>> const& parents) {
  for (std::size_t i = 0; i < indexPairs.size(); ++i) {
    const auto [parent, point] = indexPairs[i];
    if (std::size_t(parent) >= parents.size())
      throw Error(where,
                  text("indexPairs[",
                       i,
                       "] names parent ",
                       parent,
                       ", but there are ",
                       parents.size(),
                       ", numbered from 0; correct the index"));
    InitContext<In> const& of = parents[std::size_t(parent)];
    if (std::size_t(point) >= of.rest.size())
      throw Error(where,
                  text("indexPairs[",
                       i,
                       "] names point ",
                       point,
                       " of ",
                       of.where,
                       ", which has ",
                       of.rest.size(),
                       " points, numbered from 0; correct the index"));
  }
}

}  // namespace sinew
